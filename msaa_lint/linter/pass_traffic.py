"""What the passes of a linted input move, for outputs that have a row for each pass."""

from __future__ import annotations

from collections.abc import Iterator

from msaa_lint.core.finding import PassTraffic
from msaa_lint.frame.cost.amounts import PassCost
from msaa_lint.frame.cost.compare import title
from msaa_lint.frame.cost.model import frame_cost
from msaa_lint.frame.facts.frame import Frame

from .results import FileResult


def pass_traffic(result: FileResult) -> list[PassTraffic]:
    """The traffic of the passes of each frame of an input, in their order; none of a document with
    errors.
    """
    return list(_pass_traffic(result))


def _pass_traffic(result: FileResult) -> Iterator[PassTraffic]:
    for document in result.documents:
        if not document.checked:
            continue
        cost = frame_cost(Frame(document.document), document.device)
        for each in cost.passes:
            yield PassTraffic(
                result.file,
                document.number,
                title(each),
                each.path,
                each.kind,
                each.width,
                each.height,
                each.times,
                _samples(each),
                *each.amount,
                "; ".join(each.unknown),
            )


def _samples(each: PassCost) -> int | None:
    """The most samples that an attachment of a pass has, or that a command moves."""
    return (
        each.shading.samples
        if each.shading is not None
        else max((line.samples for line in each.lines), default=None)
    )
