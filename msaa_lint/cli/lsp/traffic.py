"""What parts of a description move between the GPU and memory: the lines of the cost model by the
structures that state them.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, NamedTuple

from msaa_lint.core.text.node import Node
from msaa_lint.core.text.span import Span
from msaa_lint.frame.cost.amounts import FrameCost, Line, PassCost
from msaa_lint.frame.cost.power import Rates
from msaa_lint.frame.description.record import Record
from msaa_lint.frame.facts.frame import Frame
from msaa_lint.frame.facts.parts import RENDERING, Pass

if TYPE_CHECKING:
    from .view import Costs, View


class Moved(NamedTuple):
    """Traffic in MB/s and the power that it takes in mW."""

    read: float
    write: float
    milliwatts: float

    @property
    def total(self) -> float:
        return self.read + self.write


def moved(lines: Iterable[Line], cost: FrameCost) -> Moved:
    """What some lines move, by plain arithmetic."""
    lines = list(lines)
    read = sum(line.bytes for line in lines if line.direction == "read")
    write = sum(line.bytes for line in lines if line.direction == "write")
    amount = Rates(cost.fps, cost.milliwatts_per_gbps).amount(read, write, 0)
    return Moved(amount.read_mb_per_s, amount.write_mb_per_s, amount.milliwatts)


class PassTraffic(NamedTuple):
    """A pass, the key or structure that stands for it, and the heads, structures and lines of its
    attachments.
    """

    head: Span
    cost: PassCost
    attachments: tuple[tuple[Span, Node, tuple[Line, ...]], ...]


def passes(costs: Costs) -> Iterator[PassTraffic]:
    """The passes that the frame runs, in order."""
    document = costs.result.document
    by_path = {each.path: each for each in costs.written.passes if each.kind != "command"}
    for each in Frame(document).passes:
        cost = by_path.get(each.path)
        if cost is None:
            continue
        lines = _lines_by_attachment(each, cost)
        attachments = tuple(
            (one.record.head, _written(one.record), tuple(lines[n]))
            for n, one in enumerate(each.attachments)
        )
        yield PassTraffic(each.record.head, cost, attachments)


def _written(record: Record) -> Node:
    return record.node.anchor or record.node


def _lines_by_attachment(each: Pass, cost: PassCost) -> list[list[Line]]:
    """The lines of a pass by its attachments: by their names, or of a rendering, whose lines have
    those of images, by their places.
    """
    found: list[list[Line]] = [[] for _ in each.attachments]
    if each.kind != RENDERING:
        numbers = {one.name: n for n, one in enumerate(each.attachments)}
        for line in cost.lines:
            if line.attachment in numbers:
                found[numbers[line.attachment]].append(line)
        return found
    places = sorted((_written(one.record).start, n) for n, one in enumerate(each.attachments))
    for line in cost.lines:
        at = (
            bisect_right(places, (line.place.start, len(places))) - 1
            if line.place is not None
            else -1
        )
        if (
            at >= 0
            and line.place is not None
            and line.place.start < _written(each.attachments[places[at][1]].record).end
        ):
            found[places[at][1]].append(line)
    return found


def image_lines(cost: FrameCost, image: str) -> Iterator[tuple[str, Line]]:
    """What the frame moves of an image, with the pass or command that does."""
    for each in cost.passes:
        yield from ((each.name, line) for line in each.lines if line.image == image)


def costs_at(view: View, offset: int) -> Costs | None:
    """The costs of the document at an offset."""
    for costs in view.costs:
        if costs.root.start <= offset <= costs.root.end:
            return costs
    return None
