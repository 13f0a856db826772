"""The version, the folder, and the documentation of the installed package."""

import os

VERSION = "0.1.0"
FOLDER = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))

DOCUMENTATION = ""
"""The address of the published documentation, as `[project.urls]` in pyproject.toml states it,
which takes 50 ms to look up; empty if it is not published. Links to the pages of rules begin with
it, unless a configuration states `docs-url`.
"""
