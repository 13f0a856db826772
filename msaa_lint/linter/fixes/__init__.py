"""Fixes: from what a rule's page says to changes of the document, to edits of its text, to the file.

Nothing here is imported by a run that neither fixes nor needs to say what a fix would be.
"""
