"""The files that a text may name, relative to its folder."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from itertools import islice

from msaa_lint.input.folder_search import SKIPPED_FOLDERS

MAX_ENTRIES = 5000
"""Files and folders that are looked at for one completion."""

MAX_DEPTH = 5
"""Folders below that of the text."""


def paths(folder: str, endings: Sequence[str]) -> list[str]:
    """The files below a folder whose names end so, as the text names them, in order. Hidden ones
    and links are left out.
    """
    return sorted(_paths(folder, tuple(endings)))


def _paths(folder: str, endings: tuple[str, ...]) -> Iterator[str]:
    pending, left = [("", 0)], MAX_ENTRIES
    while pending and left:
        inner, depth = pending.pop(0)
        try:
            with os.scandir(os.path.join(folder, inner)) as listed:
                entries = sorted(islice(listed, left), key=lambda entry: entry.name)
        except OSError:
            continue
        left -= len(entries)
        for entry in entries:
            path = f"{inner}{entry.name}"
            if entry.name.startswith(".") or entry.name in SKIPPED_FOLDERS or entry.is_symlink():
                continue
            if entry.is_dir():
                pending += [(f"{path}/", depth + 1)] if depth < MAX_DEPTH else []
            elif entry.name.lower().endswith(endings):
                yield path
