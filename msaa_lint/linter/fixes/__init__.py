"""Fixes: from a rule page's fix to changes of the description, to edits of its text, to the file.

A run that neither applies fixes nor reports them imports nothing of this.
"""
