"""Plans of frames, what a device does not support of them, and how the layer agrees with the rules,
as a trial asks for them.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from typing import Any, NamedTuple

from msaa_lint.frame.facts.frame import Frame

from . import gate, plan, resolve_check, shader_support
from .agreement import agreement
from .defined_contents import aspect_name, read_later
from .frame_results import FrameRun
from .inputs import Input
from .layer_scope import layer_scope, pass_kind
from .messages import Message
from .outcome import AgreementRow
from .parts import (
    COLOR,
    DEPTH,
    RENDER_PASS,
    SAMPLED,
    STENCIL,
    STORAGE,
    TRANSFER_SOURCE,
    TRANSIENT,
    Pass,
    Plan,
)
from .session import Session


class PlannedFrame(NamedTuple):
    """A frame's plan, its passes, and the defaults that were assumed, in words; the commands that
    were left out because Vulkan forbids them, by the number of their pass, in words; and the
    images, by the names of results, that something may read after the frame.
    """

    plan: Plan
    passes: Sequence[Pass]
    defaults: Sequence[str] = ()
    left_out: Sequence[tuple[int, str]] = ()
    read: Collection[str] = ()


class Planner:
    """Makes plans. `api` is the version of the structures that create render passes; None selects
    the one that the description allows.
    """

    def __init__(self, api: int | None = None) -> None:
        self.api = api
        self._deviations: resolve_check.Cache = {}

    def plan(
        self, frame: Frame, file: str, size: tuple[int, int] | None, samples: int | None
    ) -> PlannedFrame:
        """The plan of a frame. It never raises for what the frame contains."""
        frame_plan = plan.plan(frame, file=file, size=size, samples=samples, api=self.api)
        defaults = (*_metal_notes(frame), *frame_plan.defaults)
        return PlannedFrame(
            frame_plan, frame_plan.passes, defaults, frame_plan.left_out, _read(frame, frame_plan)
        )

    def supported(self, planned: PlannedFrame, device: Mapping[str, Any]) -> PlannedFrame:
        """A plan with built-in shaders in place of those that a device does not support."""
        found = shader_support.supported(planned.plan, device)
        defaults = (*planned.defaults, *found.defaults[len(planned.plan.defaults) :])
        return planned._replace(plan=found, passes=found.passes, defaults=defaults)

    def gate(self, planned: PlannedFrame, device: Mapping[str, Any]) -> dict[int, str]:
        """The passes that a device does not support, by number, and why."""
        return gate.gate(planned.plan, device)

    def deviations(
        self, session: Session, planned: PlannedFrame, device: Mapping[str, Any], color: bool
    ) -> Mapping[int, Sequence[str]]:
        """How the resolves of passes deviate from the correct result, in words by pass; those of
        color only on request.
        """
        found = resolve_check.deviations(session, planned.plan, device, self._deviations, color)
        numbers = range(len(planned.passes)) if found else ()
        return {
            number: [
                deviation.text for deviation in resolve_check.of_pass(planned.plan, number, found)
            ]
            for number in numbers
        }

    def agreement(
        self, source: Input, planned: PlannedFrame, run: FrameRun, session: Session
    ) -> Mapping[int, Sequence[AgreementRow]]:
        """How the layer of a session and the rules agree about each pass that ran."""
        passes = {number: planned.passes[number] for number in run.passes}
        kinds = {
            number: pass_kind(ran.api, ran.kind != RENDER_PASS) for number, ran in passes.items()
        }
        names = {number: ran.name for number, ran in passes.items()}
        events = [
            *run.messages,
            *(event for outcome in run.passes.values() for event in outcome.messages),
        ]
        messages = [
            Message(event["id"], event["text"], event.get("pass"), event.get("image") or "")
            for event in events
        ]
        scope = layer_scope(session.layer, session.device, kinds, session.vendors)
        findings, undecided = source.by_vulkan or (
            [*source.findings, *source.silenced],
            source.undecided,
        )
        return agreement(
            source.frame,
            names,
            findings,
            messages,
            scope,
            undecided,
            source.device,
            source.subjects,
        )


def _read(frame: Frame, frame_plan: Plan) -> set[str]:
    """The images whose contents something may read after the frame. Without commands, those are all
    whose usage allows it.
    """
    names = {
        aspect_name(frame_plan.images[number], aspect) for number, aspect in read_later(frame_plan)
    }
    for image in frame_plan.images if not frame.has_commands else ():
        target = frame.targets.get(image.name)
        stated = target.image.usage if target is not None and target.image is not None else None
        if not image.usage & TRANSIENT and (stated is None or image.usage & READABLE):
            names |= {
                aspect_name(image, aspect)
                for aspect in (COLOR, DEPTH, STENCIL)
                if image.aspects & aspect
            }
    return names


READABLE = SAMPLED | STORAGE | TRANSFER_SOURCE
"""The usages of an image with which something may read it that is not a pass."""


def _metal_notes(frame: Frame) -> list[str]:
    """Notes on the Vulkan frame that stands for a frame in Metal's words."""
    metal = frame.document.metal
    if metal is None:
        return []
    notes = ["the frame is described in terms of Metal: the equivalent Vulkan pass is drawn"]
    if metal.stencils:
        notes.append(
            "stencil in a different texture than depth is ignored: an attachment of a Vulkan "
            "render pass holds both"
        )
    return notes
