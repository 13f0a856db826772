"""Frames and their cost, from descriptions as texts."""

from __future__ import annotations

from msaa_lint.core.text.source import Source
from msaa_lint.core.text.tree import Limits, parse
from msaa_lint.frame.cost.amounts import FrameCost, Line, PassCost, Terms
from msaa_lint.frame.cost.model import frame_cost
from msaa_lint.frame.description.document import Document
from msaa_lint.frame.devices import DeviceProfile, builtin
from msaa_lint.frame.facts.frame import Frame
from msaa_lint.frame.facts.global_facts import profile
from msaa_lint.input import readers
from tests.paths import ROOT

EXAMPLES = ROOT / "examples"


def document(text: str) -> Document:
    """A description as a document without problems."""
    source = Source("frame.msaa.yaml", text)
    parsed = parse(source, Limits())
    assert not parsed.problems
    (root,) = parsed.documents
    found = readers.read(source, root)
    assert not found.problems, found.problems
    return found


def cost(
    text: str, device: str | DeviceProfile | None = None, terms: Terms | None = None
) -> FrameCost:
    """What a description costs on its own device, else on the named one."""
    found = document(text)
    default = builtin(device) if isinstance(device, str) else device
    return frame_cost(Frame(found), profile(found.description, default), terms)


def example(name: str, terms: Terms | None = None) -> FrameCost:
    """What an example costs."""
    return cost((EXAMPLES / name).read_text(encoding="utf-8"), terms=terms)


def lines(found: PassCost) -> list[tuple[str, str, str, str, int]]:
    """A pass's lines without places and corrected bytes: attachment, aspect, action, direction,
    bytes of a frame.
    """
    return [
        (line.attachment, line.aspect, line.action, line.direction, line.bytes)
        for line in found.lines
    ]


def of_pass(found: FrameCost, name: str) -> PassCost:
    """The pass of a name."""
    return next(each for each in found.passes if each.name == name)


__all__ = ["Line", "cost", "document", "example", "lines", "of_pass"]
