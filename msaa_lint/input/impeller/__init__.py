"""Impeller's render targets: a few words of Flutter's engine, and the frame that it builds of
them.
"""
