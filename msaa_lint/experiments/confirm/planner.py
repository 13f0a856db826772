"""Plans, the gate and the agreement, as a trial asks for them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from msaa_lint.frame.facts.frame import Frame

from . import gate, plan
from . import resolve_check as resolving
from .agreement import agreement
from .inputs import Input
from .layer_scope import kind, looking
from .messages import Message
from .planning import Planned, PlannedPass, Planner, Told
from .session import Session
from .verdict import Said


class Plans:
    """Plans by `plan.plan`; `api` is the version of the structures of render passes, None the one that a description can have."""

    def __init__(self, api: int | None = None) -> None:
        self.api = api
        self._known: resolving.Cache = {}

    def plan(self, frame: Frame, file: str, size: tuple[int, int] | None, samples: int | None) -> Planned:
        made = plan.plan(frame, file=file, size=size, samples=samples, api=self.api)
        passes = [PlannedPass(each.name, each.path, each.refused, kind(each.api, each.kind != "renderPass")) for each in made.passes]
        return Planned(plan.to_json(made), made, passes, (*_of_metal(frame), *made.defaults))

    def gate(self, planned: Planned, device: Mapping[str, Any]) -> dict[int, str]:
        return gate.gate(planned.own, device)

    def deviations(self, session: Session, planned: Planned, device: Mapping[str, Any], color: bool) -> Mapping[int, Sequence[str]]:
        found = resolving.deviations(session, planned.own, device, self._known, color)
        numbers = range(len(planned.passes)) if found else ()
        return {number: [each.words for each in resolving.of_pass(planned.own, number, found)] for number in numbers}

    def rows(self, input: Input, planned: Planned, told: Told) -> Mapping[int, Sequence[Said]]:
        kinds = {number: planned.passes[number].kind for number in told.numbers}
        names = {number: planned.passes[number].name for number in told.numbers}
        messages = [Message(each["id"], each["text"], str(each.get("severity", "warning")), each.get("pass")) for each in told.messages]
        at = looking(told.layer, told.device, kinds, told.vendors)
        found, undecided = input.by_vulkan or ([*input.findings, *input.silenced], input.undecided)
        return agreement(input.frame, names, found, messages, at, undecided, input.device)


def _of_metal(frame: Frame) -> list[str]:
    """What is to be said of what is drawn of a frame in Metal's words."""
    metal = frame.document.metal
    if metal is None:
        return []
    told = ["the frame is in Metal's words: what is drawn is the Vulkan pass of the same meaning"]
    if metal.stencils:
        told.append("stencil with a texture that is not depth's is left out: an attachment of a Vulkan render pass has both")
    return told


PLANNER: Planner = Plans()
