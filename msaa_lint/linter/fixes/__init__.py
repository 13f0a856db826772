"""Turns the fix of a rule page into changes of the description, edits of its text, and a fixed
file.

A run that neither applies nor reports fixes imports nothing from here.
"""
