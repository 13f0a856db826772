"""Finds the files that source files include and that are not among the inputs: beside them, and in
the folders above them in their project.

Only files of the project are looked at, and no link is followed.
"""

from __future__ import annotations

import os
import stat
from collections.abc import Iterable, Iterator

from msaa_lint.core.project import is_inside

from .index import SOURCES

INCLUDE_FOLDERS = ("", "include", "inc", "src", "source", "Source", "Include")
"""The folders in a folder above a file in which includes are searched."""

MAX_LOOKUPS = 20_000
"""The maximum number of paths that are looked up."""

_PARALLEL = {
    "include": ("src", "source", "lib"),
    "inc": ("src",),
    "Include": ("Source", "Src"),
    "headers": ("src", "source", "sources"),
}
"""The folders that have the sources of headers."""


class Nearby:
    """Looks up files of one project. `root` is its folder."""

    def __init__(self, root: str) -> None:
        self.root = root
        self.lookups = 0
        self._known: dict[str, bool] = {}
        self._inside: dict[str, bool] = {}
        """By folder: whether it is in the project."""

    def included(self, path: str, names: Iterable[str]) -> Iterator[str]:
        """Yields the files that a file includes by these names, as paths like its own."""
        folders = list(self._folders_above(path))
        for name in names:
            found = next(
                (
                    other
                    for folder in folders
                    for other in _candidates(folder, name)
                    if self.exists(other)
                ),
                None,
            )
            if found is not None:
                yield found

    def sources(self, header: str) -> Iterator[str]:
        """Yields the sources that have the name of a header, beside it or in the folder for
        sources.
        """
        folder, name = os.path.split(header)
        stem = name.partition(".")[0]
        folders = [folder]
        parts = folder.split(os.sep)
        for number, part in enumerate(parts):
            folders += [
                os.path.join(*parts[:number], other, *parts[number + 1 :])
                for other in _PARALLEL.get(part, ())
            ]
        for other in folders:
            for ending in SOURCES:
                path = os.path.join(other, stem + ending)
                if self.exists(path):
                    yield path

    def exists(self, path: str) -> bool:
        """Whether a path is a regular file of the project."""
        known = self._known.get(path)
        if known is None and self.lookups < MAX_LOOKUPS:
            self.lookups += 1
            folder = os.path.dirname(path)
            if folder not in self._inside:
                self._inside[folder] = is_inside(folder, self.root)
            try:
                known = self._inside[folder] and stat.S_ISREG(os.lstat(path).st_mode)
            except (OSError, ValueError):
                known = False
            self._known[path] = known
        return bool(known)

    def _folders_above(self, path: str) -> Iterator[str]:
        """Yields the folder of a file and those above it in the project."""
        folder = os.path.dirname(path)
        while True:
            yield folder
            real = os.path.realpath(folder or os.curdir)
            if real == self.root or not real.startswith(self.root.rstrip(os.sep) + os.sep):
                return
            folder = os.path.normpath(os.path.join(folder, os.pardir))


def _candidates(folder: str, name: str) -> Iterable[str]:
    """Returns where a file may be that an include names."""
    return (os.path.normpath(os.path.join(folder, inner, name)) for inner in INCLUDE_FOLDERS)
