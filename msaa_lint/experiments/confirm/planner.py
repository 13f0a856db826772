"""Plans of frames, what a device does not support of them, and how the layer agrees with the rules, as a trial asks for them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from msaa_lint.frame.facts.frame import Frame

from . import gate, plan, resolve_check
from .agreement import agreement
from .inputs import Input
from .layer_scope import layer_scope, pass_kind
from .messages import Message
from .outcome import AgreementRow
from .parts import Plan, to_json
from .protocol import Event
from .session import Session


class PlannedPass(NamedTuple):
    """A pass of a plan. `refused` says why no device can run it, empty where one can. `kind` is `renderPass`, `renderPass2` or `rendering`,
    by the call that creates it."""

    name: str
    path: str
    refused: str = ""
    kind: str = ""


class PlannedFrame(NamedTuple):
    """A frame's plan, in the form that the child process takes (`data`); its passes; and the defaults that were assumed, in words."""

    data: Mapping[str, Any]
    plan: Plan
    passes: Sequence[PlannedPass]
    defaults: Sequence[str] = ()


class LayerReport(NamedTuple):
    """The layer's messages about the passes of a frame that ran, the layer, and the device that it ran on."""

    numbers: Sequence[int]
    messages: Sequence[Event]
    layer: Mapping[str, Any]
    vendors: Sequence[str]
    device: Mapping[str, Any]


class Planner:
    """Makes plans. `api` is the version of the structures that create render passes; None selects the one that the description allows."""

    def __init__(self, api: int | None = None) -> None:
        self.api = api
        self._deviations: resolve_check.Cache = {}

    def plan(self, frame: Frame, file: str, size: tuple[int, int] | None, samples: int | None) -> PlannedFrame:
        """The plan of a frame. It never raises for what the frame contains."""
        frame_plan = plan.plan(frame, file=file, size=size, samples=samples, api=self.api)
        passes = [
            PlannedPass(frame_pass.name, frame_pass.path, frame_pass.refused, pass_kind(frame_pass.api, frame_pass.kind != "renderPass"))
            for frame_pass in frame_plan.passes
        ]
        return PlannedFrame(to_json(frame_plan), frame_plan, passes, (*_metal_notes(frame), *frame_plan.defaults))

    def gate(self, planned: PlannedFrame, device: Mapping[str, Any]) -> dict[int, str]:
        """The passes that a device does not support, by number, and why."""
        return gate.gate(planned.plan, device)

    def deviations(self, session: Session, planned: PlannedFrame, device: Mapping[str, Any], color: bool) -> Mapping[int, Sequence[str]]:
        """How the resolves of passes deviate from the correct result, in words by pass; those of color only on request."""
        found = resolve_check.deviations(session, planned.plan, device, self._deviations, color)
        numbers = range(len(planned.passes)) if found else ()
        return {number: [deviation.text for deviation in resolve_check.of_pass(planned.plan, number, found)] for number in numbers}

    def agreement(self, source: Input, planned: PlannedFrame, report: LayerReport) -> Mapping[int, Sequence[AgreementRow]]:
        """How the layer and the rules agree about each pass that ran."""
        kinds = {number: planned.passes[number].kind for number in report.numbers}
        names = {number: planned.passes[number].name for number in report.numbers}
        messages = [
            Message(event["id"], event["text"], str(event.get("severity", "warning")), event.get("pass")) for event in report.messages
        ]
        scope = layer_scope(report.layer, report.device, kinds, report.vendors)
        findings, undecided = source.by_vulkan or ([*source.findings, *source.silenced], source.undecided)
        return agreement(source.frame, names, findings, messages, scope, undecided, source.device)


def _metal_notes(frame: Frame) -> list[str]:
    """Notes on the Vulkan frame that stands for a frame in Metal's words."""
    metal = frame.document.metal
    if metal is None:
        return []
    notes = ["the frame is described in terms of Metal: the equivalent Vulkan pass is drawn"]
    if metal.stencils:
        notes.append("stencil in a different texture than depth is ignored: an attachment of a Vulkan render pass holds both")
    return notes
