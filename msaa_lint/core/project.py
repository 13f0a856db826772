"""The project that a path lies in, and paths as outputs name them.

The project is the nearest folder upwards that a version control system keeps its data in; without one, the outermost folder upwards that
has a configuration file; without any, the folder itself. What an untrusted file names must not lead out of it.
"""

from __future__ import annotations

import os

NAMES = ("msaa-lint.toml", "pyproject.toml")
"""Of configuration files, the first wins in one folder."""

_KEPT_BY = (".git", ".hg", ".jj", ".svn", ".bzr", "_darcs", ".fslckout")


def project_root(folder: str) -> str:
    """The folder that the files named by a configuration (or linked to) must stay in, for a configuration or an input in `folder`."""
    at = outermost = os.path.abspath(folder)
    while True:
        if any(os.path.lexists(os.path.join(at, name)) for name in _KEPT_BY):
            return at
        if any(os.path.isfile(os.path.join(at, name)) for name in NAMES):
            outermost = at
        above = os.path.dirname(at)
        if above == at:
            return outermost
        at = above


def inside(path: str, root: str) -> bool:
    """Whether a path lies in a folder, with all symbolic links followed."""
    try:
        full, base = os.path.realpath(path), os.path.realpath(root)
    except (OSError, ValueError):
        return False
    return full == base or full.startswith(base if base.endswith(os.sep) else base + os.sep)


def shown(path: str) -> str:
    """A path as outputs name it, with `/`: from the current folder where it is in it or was given so, else absolute."""
    here = os.getcwd()
    below = here if here.endswith(os.sep) else here + os.sep
    full = os.path.abspath(path)
    if full.startswith(below):
        full = full[len(below) :]
    elif not os.path.isabs(path):
        full = os.path.normpath(path)
    return full.replace(os.sep, "/")
