"""The project that contains a path, and paths as outputs show them.

The project is the nearest folder upward with the data of a version control system; if there is
none, the outermost folder upward with a configuration file, or else the folder itself. A path that
a file or a link of the project states must stay in it.
"""

from __future__ import annotations

import errno
import os

from .urls import is_url, name_of, root_of

NAMES = ("msaa-lint.toml", "pyproject.toml")
"""The names of configuration files; in a folder with both, the first is used."""

MAX_PATH = 1 << 15
"""Characters of a path, as in Windows; other systems have less. Resolving a longer one takes time
that grows with its square.
"""

MAX_LINKS = 40
"""Symbolic links that are followed to resolve a path, as in Linux."""

_VCS_DATA = (".git", ".hg", ".jj", ".svn", ".bzr", "_darcs", ".fslckout")


class Outside(OSError):
    """A path that content states leads out of the project. Nothing there is looked at, not even
    whether it exists.
    """

    def __init__(self) -> None:
        super().__init__("it is outside the project")


def project_root(folder: str) -> str:
    """The project of a configuration or an input in `folder`, with all symbolic links resolved; of
    a URL, the folder that is named.
    """
    if is_url(folder):
        return root_of(folder)
    at = outermost = os.path.realpath(folder)
    while True:
        if any(os.path.lexists(os.path.join(at, name)) for name in _VCS_DATA):
            return at
        if any(os.path.lexists(os.path.join(at, name)) for name in NAMES):
            outermost = at
        above = os.path.dirname(at)
        if above == at:
            return outermost
        at = above


def folder_of(file: str) -> str:
    """The folder that the paths in an input are relative to: the file's; the current one for
    standard input, a pipe, and a device.
    """
    is_stream = os.path.exists(file) and not os.path.isfile(file)
    return os.curdir if is_stream else os.path.dirname(file) or os.curdir


def resolved(path: str) -> str:
    """A path with all symbolic links resolved. Raises OSError for a path that no file can have."""
    if len(path) > MAX_PATH:
        raise OSError(errno.ENAMETOOLONG, os.strerror(errno.ENAMETOOLONG))
    try:
        return (
            os.path.realpath(path)
            if os.name == "nt"
            else _resolved(os.path.join(os.getcwd(), path))
        )
    except ValueError as error:
        raise OSError(f"invalid file name: {error}") from None


def _resolved(path: str) -> str:
    """An absolute path with all symbolic links resolved. `os.path.realpath` follows any number of
    links, and recurses for each.
    """
    real, links = os.sep, 0
    rest = path.split(os.sep)[::-1]
    while rest:
        name = rest.pop()
        if name == "..":
            real = os.path.dirname(real)
        elif name not in ("", os.curdir):
            real = os.path.join(real, name)
            try:
                target = os.readlink(real)
            except OSError:
                continue  # It is not a link, does not exist, or cannot be read.
            links += 1
            if links > MAX_LINKS:
                raise OSError(errno.ELOOP, os.strerror(errno.ELOOP))
            rest += target.split(os.sep)[::-1]
            real = os.sep if os.path.isabs(target) else os.path.dirname(real)
    return real


def real_path(path: str, project: str) -> str:
    """A path that content states, with all symbolic links resolved. Raises Outside if it leaves the
    project, and OSError for a URL.
    """
    if "://" in path:
        raise OSError("it is a URL, not a path")
    real, root = resolved(path), os.path.realpath(project)
    below = root if root.endswith(os.sep) else root + os.sep
    if real != root and not os.path.normcase(real).startswith(os.path.normcase(below)):
        raise Outside
    return real


def is_inside(path: str, project: str) -> bool:
    """Whether a path that content states stays in the project."""
    try:
        real_path(path, project)
    except OSError:
        return False
    return True


def leaving_link(path: str) -> str | None:
    """The first part of a path that is a link in a project and leads out of it; None if there is
    none.

    Such a link may come from a stranger's branch. Links that are in no project, such as `/tmp` on
    macOS, are the system's or the user's.
    """
    parts = path.split(os.sep)
    for number in range(1, len(parts) + 1):
        link = os.sep.join(parts[:number])
        if os.path.islink(link) and any(
            not is_inside(link, root) for root in _projects(os.path.dirname(link) or os.curdir)
        ):
            return link
    return None


def _projects(folder: str) -> list[str]:
    """The roots of the projects that a folder is in: that of the current folder, and its own."""
    here, own = project_root(os.curdir), project_root(folder)
    is_project = any(os.path.lexists(os.path.join(own, name)) for name in (*_VCS_DATA, *NAMES))
    return [*([here] if is_inside(folder, here) else []), *([own] if is_project else [])]


def shown(path: str) -> str:
    """A path as outputs show it, with `/`: relative if it is in the current folder or was relative,
    else absolute. A URL stays one.
    """
    path = name_of(path)
    if is_url(path):
        return path
    here = os.getcwd()
    below = here if here.endswith(os.sep) else here + os.sep
    full = os.path.abspath(path)
    if full.startswith(below):
        full = full[len(below) :]
    elif not os.path.isabs(path):
        full = os.path.normpath(path)
    return full.replace(os.sep, "/")
