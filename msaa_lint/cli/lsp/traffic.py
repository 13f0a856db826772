"""What parts of a description move between the GPU and memory: the lines of the cost model by the structures that state them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, NamedTuple

from msaa_lint.core.text.node import Node
from msaa_lint.core.text.span import Span
from msaa_lint.frame.cost.amounts import FrameCost, Line, PassCost
from msaa_lint.frame.cost.power import Rates
from msaa_lint.frame.facts.frame import Frame
from msaa_lint.frame.facts.parts import RENDERING

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
    """A pass, the key or structure that stands for it, and its attachments with their lines; `known` says that all of it is counted."""

    head: Span
    end: int
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
        attachments = []
        for attachment in each.attachments:
            record = attachment.record
            node = record.node.anchor or record.node
            inside = [line for line in cost.lines if line.place is not None and node.start <= line.place.start < node.end]
            if each.kind != RENDERING:
                inside = [line for line in inside if line.attachment == attachment.name]
            attachments.append((record.head, node, tuple(inside)))
        yield PassTraffic(each.record.head, (each.record.node.anchor or each.record.node).end, cost, tuple(attachments))


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
