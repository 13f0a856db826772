"""The results of `msaa-lint cost`: frames of inputs with their costs, or two inputs side by
side.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import groupby
from operator import attrgetter
from typing import NamedTuple

from msaa_lint.core.finding import Finding

from .amounts import Amount, FrameCost
from .compare import Comparison, compare
from .graph import FrameGraph
from .variants import Variant


class InputTotal(NamedTuple):
    """The cost of all frames of an input, and whether some of it is unknown."""

    amount: Amount
    unknown: bool


def input_total(costs: Sequence[FrameCost]) -> InputTotal:
    """The cost of an input.

    Its frames are separate, and their costs add up, unless they state their `share`: then they are
    the kinds of frame of one program, whose images are the same if their names are. The traffic of
    such a kind is already weighted by its share.
    """
    total = added(cost.total for cost in costs)
    memory = total.memory_mib
    shared: dict[str, float] = {}
    for cost in costs:
        if cost.share is not None:
            for image in cost.images:
                size = (image.committed or 0) / 2**20
                memory -= size
                shared[image.name] = max(shared.get(image.name, 0.0), size)
    return InputTotal(
        total._replace(memory_mib=memory + sum(shared.values())),
        any(cost.unknown for cost in costs),
    )


def added(amounts: Iterable[Amount]) -> Amount:
    """The sum of amounts."""
    return Amount(
        *(sum(column) for column in zip(Amount(0.0, 0.0, 0.0, 0.0), *amounts, strict=True))
    )


class FixStep(NamedTuple):
    """What the fix of a finding changes of a frame's cost after the fixes before it: negative where
    it saves.
    """

    finding: Finding
    change: Amount


class CostedFrame(NamedTuple):
    """A frame of an input and its costs: as written, and with other sample counts (`variants`).

    `safely_fixed` is its cost after `--fix`, and `fixed` after `--fix --unsafe-fixes`, None if they
    fix nothing of the input; `fixed_variants` are other sample counts after the latter. `number` is
    the index of its document in the input, of `documents`. `graph` and `fixed_graph` are those of
    `cost` and `fixed`; `fix_steps` lead from `cost` to `fixed`, if they are computed.
    """

    file: str
    number: int
    documents: int
    cost: FrameCost
    variants: Sequence[Variant] = ()
    safely_fixed: FrameCost | None = None
    fixed: FrameCost | None = None
    fixed_variants: Sequence[Variant] = ()
    graph: FrameGraph | None = None
    fixed_graph: FrameGraph | None = None
    fix_steps: Sequence[FixStep] = ()

    @property
    def states(self) -> list[tuple[str, FrameCost]]:
        """The frame as written and after fixes, with titles."""
        fixes = (("with --fix", self.safely_fixed), ("with --fix --unsafe-fixes", self.fixed))
        distinct = (
            self.fixed is None
            or self.safely_fixed is None
            or self.safely_fixed.total != self.fixed.total
        )
        fixed = [
            (title, cost) for title, cost in (fixes if distinct else fixes[:1]) if cost is not None
        ]
        return [("as written", self.cost), *fixed]

    @property
    def counts(self) -> Sequence[Variant]:
        """The frame with other sample counts, after the fixes if there are any: counts are only
        comparable after the same fixes.
        """
        return self.variants if self.fixed is None else self.fixed_variants


def inputs_total(frames: Sequence[CostedFrame]) -> Amount:
    """The cost of all frames of several inputs, which are separate programs. The frames of an input
    follow each other.
    """
    return added(
        input_total([frame.cost for frame in group]).amount
        for _, group in groupby(frames, attrgetter("file"))
    )


class CostComparison(NamedTuple):
    """Two inputs with their frames, and one comparison for each document, in order."""

    old_file: str
    new_file: str
    old: Sequence[CostedFrame]
    new: Sequence[CostedFrame]
    frames: Sequence[Comparison]


def compare_inputs(
    old_file: str, old: Sequence[CostedFrame], new_file: str, new: Sequence[CostedFrame]
) -> CostComparison:
    """Compares two inputs document by document. A document that only one of them has counts as
    added or removed.
    """
    before, after = ({frame.number: frame.cost for frame in frames} for frames in (old, new))
    numbers = sorted(before.keys() | after.keys())
    return CostComparison(
        old_file,
        new_file,
        old,
        new,
        [compare(before.get(number), after.get(number)) for number in numbers],
    )
