"""What `msaa-lint cost` has to show: frames of inputs with their costs, or two inputs side by side."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from .amounts import FrameCost
from .compare import Comparison, compare
from .variants import Variant


class Costed(NamedTuple):
    """A frame of an input and what it costs: as it is written, with other sample counts, and with its findings mended (None: it has none
    that a fix would mend).

    `number` is the document's place in the input, of `documents`.
    """

    file: str
    number: int
    documents: int
    cost: FrameCost
    variants: Sequence[Variant] = ()
    fixed: FrameCost | None = None


class Compared(NamedTuple):
    """Two inputs, each with its frames, and what the new one costs more: one comparison for each document, in their order."""

    old_file: str
    new_file: str
    old: Sequence[Costed]
    new: Sequence[Costed]
    frames: Sequence[Comparison]


def compared(old_file: str, old: Sequence[Costed], new_file: str, new: Sequence[Costed]) -> Compared:
    """Two inputs side by side, the first document with the first; one that only one of them has is added, or removed."""
    before, after = ({each.number: each.cost for each in side} for side in (old, new))
    numbers = sorted(before.keys() | after.keys())
    return Compared(old_file, new_file, old, new, [compare(before.get(number), after.get(number)) for number in numbers])
