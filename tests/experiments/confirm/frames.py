"""Frames and their plans, from descriptions as texts."""

from __future__ import annotations

from typing import Any

from msaa_lint.core.text.source import Source
from msaa_lint.core.text.tree import Limits, parse
from msaa_lint.experiments.confirm.parts import Image, Pass, Plan, Step
from msaa_lint.experiments.confirm.plan import plan
from msaa_lint.frame.facts.frame import Frame
from msaa_lint.input import readers


def frame(text: str) -> Frame:
    """A description without problems as a frame."""
    (found,) = frames(text)
    return found


def frames(text: str) -> list[Frame]:
    """The frames of a stream of descriptions."""
    source = Source("frame.msaa.yaml", text)
    parsed = parse(source, Limits())
    assert not parsed.problems, parsed.problems
    found = [readers.read(source, root) for root in parsed.documents]
    assert not any(each.problems for each in found), [each.problems for each in found]
    return [Frame(each) for each in found]


def planned(text: str, **arguments: Any) -> Plan:
    """The plan of a description."""
    return plan(frame(text), **arguments)


def image(made: Plan, name: str) -> Image:
    """An image of a plan by its name."""
    (found,) = [each for each in made.images if each.name == name]
    return found


def one(made: Plan) -> Pass:
    """The only pass of a plan."""
    (found,) = made.passes
    return found


def begins(made: Plan) -> list[Step]:
    """The steps that begin a pass."""
    return [step for step in made.steps if step.kind == "begin"]
