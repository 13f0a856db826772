"""The project that contains a path, and paths as outputs show them.

The project is the nearest folder upward with the data of a version control system; if there is none, the outermost folder upward with a
configuration file, or else the folder itself. A path from an untrusted file must stay in the project.
"""

from __future__ import annotations

import os

NAMES = ("msaa-lint.toml", "pyproject.toml")
"""The names of configuration files; in a folder with both, the first is used."""

_VCS_DATA = (".git", ".hg", ".jj", ".svn", ".bzr", "_darcs", ".fslckout")


def project_root(folder: str) -> str:
    """The project of a configuration or an input in `folder`: files that it names, and targets of links, must be inside."""
    at = outermost = os.path.abspath(folder)
    while True:
        if any(os.path.lexists(os.path.join(at, name)) for name in _VCS_DATA):
            return at
        if any(os.path.isfile(os.path.join(at, name)) for name in NAMES):
            outermost = at
        above = os.path.dirname(at)
        if above == at:
            return outermost
        at = above


def inside(path: str, root: str) -> bool:
    """Whether a path is in a folder, with all symbolic links resolved."""
    try:
        full, base = os.path.realpath(path), os.path.realpath(root)
    except (OSError, ValueError):
        return False
    return full == base or full.startswith(base if base.endswith(os.sep) else base + os.sep)


def shown(path: str) -> str:
    """A path as outputs show it, with `/`: relative if it is in the current folder or was relative, else absolute."""
    here = os.getcwd()
    below = here if here.endswith(os.sep) else here + os.sep
    full = os.path.abspath(path)
    if full.startswith(below):
        full = full[len(below) :]
    elif not os.path.isabs(path):
        full = os.path.normpath(path)
    return full.replace(os.sep, "/")
