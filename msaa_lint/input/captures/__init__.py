"""Captures: the calls of a program, followed to the frames they draw, and written as a
description.
"""
