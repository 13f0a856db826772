"""The results of `msaa-lint cost`: frames of inputs with their costs, or two inputs side by side."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from .amounts import FrameCost
from .compare import Comparison, compare
from .variants import Variant


class CostedFrame(NamedTuple):
    """A frame of an input and its costs: as written, with other sample counts, and with all fixes applied (None if no fix applies).

    `number` is the index of its document in the input, of `documents`.
    """

    file: str
    number: int
    documents: int
    cost: FrameCost
    variants: Sequence[Variant] = ()
    fixed: FrameCost | None = None


class CostComparison(NamedTuple):
    """Two inputs with their frames, and one comparison for each document, in order."""

    old_file: str
    new_file: str
    old: Sequence[CostedFrame]
    new: Sequence[CostedFrame]
    frames: Sequence[Comparison]


def compare_inputs(old_file: str, old: Sequence[CostedFrame], new_file: str, new: Sequence[CostedFrame]) -> CostComparison:
    """Compares two inputs document by document. A document that only one of them has counts as added or removed."""
    before, after = ({frame.number: frame.cost for frame in frames} for frames in (old, new))
    numbers = sorted(before.keys() | after.keys())
    return CostComparison(old_file, new_file, old, new, [compare(before.get(number), after.get(number)) for number in numbers])
