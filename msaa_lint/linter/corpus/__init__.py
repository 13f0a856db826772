"""Corpora: the results of runs as tables, which `msaa-lint check` writes and `msaa-lint corpus`
summarizes.
"""
