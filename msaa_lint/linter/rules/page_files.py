"""Where rule pages are."""

from __future__ import annotations

import os

from msaa_lint.core import package


def folder() -> str:
    """The folder of the built-in pages: in the installed package, or at the top of a checkout."""
    installed = os.path.join(package.FOLDER, "rules")
    return (
        installed
        if os.path.isdir(installed)
        else os.path.join(os.path.dirname(package.FOLDER), "rules")
    )


def pages(path: str) -> list[str]:
    """The rule pages at a path: the file itself, or the pages of the folder except its README,
    sorted.
    """
    try:
        names = sorted(os.listdir(path))
    except OSError:
        # Either a file, or a folder that cannot be read, which is then reported as an unreadable
        # page.
        return [path]
    return [
        os.path.join(path, name) for name in names if name.endswith(".md") and name != "README.md"
    ]
