"""Finds the files of a project that a file includes, by name: no include paths are known."""

from __future__ import annotations

import posixpath
from collections.abc import Iterable, Sequence

MAX_CANDIDATES = 200
"""The maximum number of files of the same name that are compared for one include."""


class Includes:
    """The files of a project, by their names."""

    def __init__(self, paths: Sequence[str]) -> None:
        self.paths = paths
        self._folders = [posixpath.dirname(path) for path in paths]
        self._numbers = {path: number for number, path in enumerate(paths)}
        self._by_name: dict[str, list[int]] = {}
        for number, path in enumerate(paths):
            self._by_name.setdefault(posixpath.basename(path), []).append(number)

    def of(self, number: int, names: Iterable[str]) -> list[int]:
        """Returns the files that a file includes, each once, in order. A name that several files
        fit equally well stands for none.
        """
        found = (self._find(number, name) for name in names)
        return list(
            dict.fromkeys(other for other in found if other is not None and other != number)
        )

    def _find(self, number: int, name: str) -> int | None:
        """Returns the file that an include names: the one beside the file that includes it, else
        the nearest one whose path ends so.
        """
        folder = self._folders[number]
        beside = self._numbers.get(posixpath.normpath(posixpath.join(folder, name)))
        if beside is not None:
            return beside
        stated = posixpath.normpath(name)
        while stated.startswith("../"):
            stated = stated[3:]
        named = self._by_name.get(posixpath.basename(stated), ())
        if not named or len(named) > MAX_CANDIDATES:
            return None
        fitting = [other for other in named if f"/{self.paths[other]}".endswith(f"/{stated}")]
        if not fitting:
            return None
        ranked = sorted(
            (-_shared(folder, self._folders[other]), len(self._folders[other]), other)
            for other in fitting
        )
        return None if len(ranked) > 1 and ranked[0][:2] == ranked[1][:2] else ranked[0][2]


def _shared(folder: str, other: str) -> int:
    """Returns the length of the path that two folders have in common."""
    common = posixpath.commonpath((f"/{folder}", f"/{other}"))
    return len(common)
