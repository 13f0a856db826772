"""A described frame's own passes under each technique: what a device is asked to time in place of a
made-up frame.

A frame with multisampled passes keeps its attachments, formats, draws, and resolves; only their
sample counts change. With one sample, what they resolve to is drawn to directly. In a frame without
multisampled passes, those that draw geometry get multisampled attachments.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping
from typing import Any, NamedTuple

from msaa_lint.experiments.confirm import plan as planning
from msaa_lint.experiments.confirm.meshes import Sizes, with_meshes
from msaa_lint.experiments.confirm.parts import (
    LOAD,
    NONE,
    RENDER_PASS,
    SAMPLED,
    STORAGE,
    Pass,
    PassCommand,
    Pipeline,
    Plan,
    Step,
)
from msaa_lint.experiments.confirm.plan_images import Images
from msaa_lint.experiments.confirm.resample import resampled, resized
from msaa_lint.experiments.confirm.shader_support import supported
from msaa_lint.frame.description.models import ReadImage, WriteImage
from msaa_lint.frame.facts.frame import Frame

from .plan_samples import attached, multisampled, supersampled, unresolved
from .points import SAMPLE_SHADING, SSAA, Technique

GREATER = (4, 6)
"""VkCompareOp: GREATER and GREATER_OR_EQUAL."""


class FramePlan(NamedTuple):
    """The plan of a frame under a technique; `bare` is the same without resolves and without
    scaling down, None where it has none. `reason` says why there is no plan.
    """

    plan: Plan
    bare: Plan | None = None
    reason: str = ""


def stated_sizes(frame: Frame) -> Sizes:
    """How large the triangles of a frame are, as its description states it."""
    scene = frame.description.scene
    if scene is None:
        return Sizes()
    return Sizes(float(scene.overdraw or 1.0), float(scene.triangleSize or 0.0))


class FramePlans:
    """The plans of a frame at a size in pixels. `file` is the description's, whose shader modules
    are next to it; `sizes` are used in place of those that the description states.

    `passes` are the numbers of the passes to which techniques apply, and `notes` say what is
    assumed. `as_described` says that all draws of these passes have fragment shaders of the frame,
    so that a cost of shading does not apply; with `built_in`, built-in shaders draw these passes
    instead, and one applies. Built-in shaders also stand in for those that a `device`
    (confirm/opening.py) does not support.
    """

    def __init__(
        self,
        frame: Frame,
        file: str,
        size: tuple[int, int],
        sizes: Sizes | None = None,
        device: Mapping[str, Any] | None = None,
        built_in: bool = False,
    ) -> None:
        plan = planning.plan(frame, file)
        plan = supported(plan, device) if device is not None else plan
        plan = _without_fills(_nearer_as_tested(plan))
        self.passes = _multisampled_passes(plan)
        self.is_multisampled = bool(self.passes)
        if not self.passes:
            self.passes = _geometry_passes(plan)
        drawn = [pipeline for number in self.passes for pipeline in _drawn(plan, number)]
        self.as_described = bool(drawn) and all(pipeline.has_fragment_shader for pipeline in drawn)
        replaced = self.as_described and built_in
        if replaced:
            self.as_described = False
            plan = _with_built_in_shaders(plan, self.passes)
        plan = with_meshes(plan, sizes or stated_sizes(frame))
        self.base = resized(plan, size, self.passes)
        self.notes = (
            *plan.defaults,
            *(
                ["the frame's own shaders are replaced by those of a stated cost"]
                if replaced
                else []
            ),
            *self._notes(frame),
        )

    @property
    def triangle_area(self) -> float | None:
        """The mean area in pixels of the triangles of the passes to which techniques apply; None if
        no number of vertices is known.
        """
        triangles, covered = 0, 0.0
        for step in self.base.steps:
            meshes = [
                mesh
                for inner in step.inner
                for mesh in inner.mesh
                if mesh.columns and not inner.full_screen
            ]
            if step.number in self.passes and meshes:
                number = sum(mesh.triangles * mesh.draws for mesh in meshes)
                triangles += number
                covered += (
                    number * step.area[2] * step.area[3] / (2 * meshes[0].columns * meshes[0].rows)
                )
        return covered / triangles if triangles else None

    def _notes(self, frame: Frame) -> list[str]:
        begun = dict.fromkeys(step.number for step in self.base.steps if step.kind == "begin")
        names = [self.base.passes[number].name for number in begun if number in self.passes]
        notes = (
            [f"the techniques apply to {', '.join(names)}"]
            if names and len(names) < len(begun)
            else []
        )
        notes += [
            f"{each.name} is not timed: {each.refused or each.failed}"
            for each in self.base.passes
            if each.refused or each.failed
        ]
        stages = [body.stage for _, body in frame.recorded(ReadImage)] + [
            body.stage for _, body in frame.recorded(WriteImage)
        ]
        if "COMPUTE" in stages:
            notes.append("compute work is not timed")
        return notes

    def of(self, technique: Technique) -> FramePlan:
        """The plan under a technique."""
        if not self.base.passes:
            return FramePlan(self.base, reason="the frame has no passes")
        numbers = self.passes or range(len(self.base.passes))
        refused = [
            each
            for each in (self.base.passes[number] for number in numbers)
            if each.refused or each.failed
        ]
        if refused:
            return FramePlan(
                self.base,
                reason=f"{refused[0].name} cannot be drawn: "
                f"{refused[0].refused or refused[0].failed}",
            )
        side = technique.grid if technique.kind == SSAA else 1
        samples = 1 if technique.kind == SSAA else technique.samples
        if not self.passes and (samples > 1 or side > 1):
            return FramePlan(
                self.base,
                reason="no pass of the frame draws geometry to color attachments that it clears",
            )
        plan = self.base
        if self.is_multisampled:
            plan = resampled(plan, samples)
        elif samples > 1:
            plan = multisampled(plan, self.passes, samples)
        if side > 1:
            plan = supersampled(plan, self.passes, side)
        whole = self._shaded(plan, technique)
        return FramePlan(whole, unresolved(whole, self.passes))

    def _shaded(self, plan: Plan, technique: Technique) -> Plan:
        """The plan with sample shading on its pipelines if the technique has it, and with shading
        of a cost where they have no shader.
        """
        fraction = technique.fraction if technique.kind == SAMPLE_SHADING else -1.0

        def pipeline(each: Pipeline) -> Pipeline:
            shading = max(each.sample_shading, fraction)
            return each._replace(
                sample_shading=shading, shaded=not each.has_fragment_shader and any(each.numerics)
            )

        passes = [
            each._replace(pipelines=tuple(map(_without_color, each.pipelines)))
            for each in plan.passes
        ]
        for number in self.passes:
            passes[number] = passes[number]._replace(
                pipelines=tuple(map(pipeline, passes[number].pipelines))
            )
        without = tuple(
            name for name in plan.without if fraction < 0 or name != "sampleRateShading"
        )
        return plan._replace(passes=tuple(passes), without=without)


def _drawn(plan: Plan, number: int) -> list[Pipeline]:
    """The pipelines with color that draw in a pass."""
    used = {
        inner.pipeline
        for step in plan.steps
        if step.number == number
        for inner in step.inner
        if inner.kind == "draw"
    }
    return [
        plan.passes[number].pipelines[index]
        for index in used
        if any(plan.passes[number].pipelines[index].numerics)
    ]


def _with_built_in_shaders(plan: Plan, passes: Collection[int]) -> Plan:
    """The plan, some of whose passes have no shaders of the frame."""
    changed = list(plan.passes)
    for number in passes:
        changed[number] = changed[number]._replace(
            pipelines=tuple(each._replace(stages=()) for each in changed[number].pipelines)
        )
    return plan._replace(passes=tuple(changed))


def described_size(frame: Frame) -> tuple[int, int] | None:
    """The size in pixels of the largest pass to which techniques apply, or of all if they apply to
    none; None if it is not stated.
    """
    if not Images(frame).sized:
        return None
    plan = planning.plan(frame)
    passes = _multisampled_passes(plan) or _geometry_passes(plan) or range(len(plan.passes))
    sizes = [
        (framebuffer.width, framebuffer.height)
        for number in passes
        for framebuffer in plan.passes[number].framebuffers
    ]
    return max(sizes, key=math.prod, default=None)


def _without_color(pipeline: Pipeline) -> Pipeline:
    """A pipeline without a fragment shader if it writes no color, as that of a depth prepass."""
    writes = (
        any(blend.mask for blend in pipeline.blends)
        or pipeline.alpha_to_coverage
        or pipeline.has_fragment_shader
    )
    return pipeline if writes else pipeline._replace(numerics=("",) * len(pipeline.numerics))


def _nearer_as_tested(plan: Plan) -> Plan:
    """A plan in which greater depths are nearer if its pipelines test for them."""
    pipelines = [
        pipeline for each in plan.passes for pipeline in each.pipelines if pipeline.depth_test
    ]
    return plan._replace(
        reversed=plan.reversed or any(pipeline.depth_compare in GREATER for pipeline in pipelines)
    )


def _without_fills(plan: Plan) -> Plan:
    """A plan whose passes either draw geometry or fill the screen with what they read.

    What geometry reads is part of the cost of shading, and a pass that reads an image and draws no
    geometry is a full-screen one.
    """

    def commands(frame_pass: Pass, inner: tuple[PassCommand, ...]) -> list[PassCommand]:
        draws = [each for each in inner if each.kind == "draw"]
        geometry = any(each.draws and not each.full_screen for each in draws)
        own = any(frame_pass.pipelines[each.pipeline].has_fragment_shader for each in draws)
        reads = any(
            each.kind == "read" and plan.images[each.image].usage & SAMPLED for each in inner
        )
        if geometry or own or not reads:
            return [each for each in inner if each.kind != "read"]
        return [each for each in inner if each.kind != "draw"]

    steps = []
    for step in plan.steps:
        if step.kind == "begin":
            subpasses = dict.fromkeys(each.subpass for each in step.inner)
            kept = [
                commands(
                    plan.passes[step.number], tuple(i for i in step.inner if i.subpass == subpass)
                )
                for subpass in subpasses
            ]
            step = step._replace(inner=tuple(each for part in kept for each in part))
        steps.append(step)
    return plan._replace(steps=tuple(steps))


def _multisampled_passes(plan: Plan) -> frozenset[int]:
    """The passes of the frame that are drawn with more than one sample."""
    found = set()
    for number in {step.number for step in plan.steps if step.kind == "begin"}:
        each = plan.passes[number]
        images = {
            image
            for framebuffer in range(len(each.framebuffers))
            for part in attached(each, framebuffer)
            for image in part
        }
        counts = [plan.images[image].samples for image in images] + [
            attachment.samples for attachment in each.attachments
        ]
        single = each.single_sampled or any(subpass.single_sampled for subpass in each.subpasses)
        if (
            max(counts, default=1) > 1
            or single
            or any(pipeline.samples > 1 for pipeline in each.pipelines)
        ):
            found.add(number)
    return frozenset(found)


def _geometry_passes(plan: Plan) -> frozenset[int]:
    """The passes of a frame without multisampling that an engine would multisample: those that draw
    geometry to color attachments that they clear, with depth if any such pass has depth; and those
    that draw on.
    """
    begun = {step.number: step for step in reversed(plan.steps) if step.kind == "begin"}
    order = dict.fromkeys(step.number for step in plan.steps if step.kind == "begin")
    candidates = [
        number
        for number in order
        if _draws_geometry(plan, begun[number]) and _clears(plan.passes[number])
    ]
    with_depth = [number for number in candidates if attached(plan.passes[number])[1]]
    found = set(with_depth or candidates)
    colors = {image for number in found for image in attached(plan.passes[number])[0]}
    depths = {image for number in found for image in attached(plan.passes[number])[1]}
    for number in order:
        own_colors, own_depths = attached(plan.passes[number])
        if (
            own_colors
            and own_depths
            and set(own_colors) <= colors
            and set(own_depths) <= depths
            and _draws_geometry(plan, begun[number])
        ):
            found.add(number)
    return frozenset(found)


def _draws_geometry(plan: Plan, step: Step) -> bool:
    """Whether a pass draws more than the whole screen to color attachments that may have several
    samples.
    """
    frame_pass = plan.passes[step.number]
    colors, depths = attached(frame_pass, step.framebuffer)
    images = [plan.images[image] for image in (*colors, *depths)]
    plain = all(
        image.type == 1 and image.levels == image.layers == 1 and not image.usage & STORAGE
        for image in images
    )
    simple = frame_pass.kind != RENDER_PASS or (
        len(frame_pass.subpasses) == 1 and not frame_pass.subpasses[0].inputs
    )
    geometry = any(inner.kind == "draw" and not inner.full_screen for inner in step.inner)
    return bool(colors) and plain and simple and geometry


def _clears(frame_pass: Pass) -> bool:
    """Whether a pass loads none of its color attachments."""
    if frame_pass.kind != RENDER_PASS:
        return all(
            rendered.load != LOAD
            for rendered in frame_pass.rendered
            if rendered.role == "color" and rendered.image != NONE
        )
    references = [
        reference
        for subpass in frame_pass.subpasses
        for reference in subpass.colors
        if reference.attachment != NONE
    ]
    return all(
        frame_pass.attachments[reference.attachment].load != LOAD for reference in references
    )
