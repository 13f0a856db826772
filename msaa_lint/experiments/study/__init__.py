"""Accuracy against time: scenes, the samples that techniques take of them, the exact picture, and
the error between the two.
"""
