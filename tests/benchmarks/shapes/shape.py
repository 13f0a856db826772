"""What a shape is."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import NamedTuple


class Shape(NamedTuple):
    """An input of one structure at any size."""

    name: str
    write: Callable[[Path, int], None]
    """Writes the input of a size (a count of what is repeated) to a folder."""
    arguments: Sequence[str] = ("check", "--isolated", ".")
    """Of the command, which runs in that folder."""
    codes: Sequence[int] = (0, 1)
    """Exit codes of a run that did its work; 2 belongs to shapes that a stated limit ends, or whose
    input is wrong.
    """
    most: int = 1 << 20
    """No size above this is measured."""


def text(name: str, content: Callable[[int], str]) -> Callable[[Path, int], None]:
    """Writes one file with the text of a size."""

    def write(folder: Path, size: int) -> None:
        (folder / name).write_text(content(size), encoding="utf-8")

    return write
