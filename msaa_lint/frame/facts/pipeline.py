"""Facts of graphics pipelines."""

from __future__ import annotations

import math
from collections.abc import Container, Sequence
from typing import NamedTuple

from msaa_lint.core.text.span import Span
from msaa_lint.frame.description.models import (
    ColorBlendAttachment,
    ColorBlendState,
    MultisampleState,
    Pipeline,
)
from msaa_lint.frame.description.models import Draw as DrawCommand
from msaa_lint.frame.vulkan.formats import Format, format_of

from .facts import Facts
from .frame import Frame
from .global_facts import AMD_MIXED_SAMPLES, NV_MIXED_SAMPLES
from .parts import Pass, PassSubpass
from .subpass import samples_of
from .walk import Walk

SAMPLES_DYNAMIC = "RASTERIZATION_SAMPLES_EXT"


class Draw(NamedTuple):
    """A recorded draw: the first subpass of the pass around it, and what
    vkCmdSetRasterizationSamples set before it.
    """

    subpass: PassSubpass | None
    samples: int | None
    samples_at: Span | None


def subpass_of(pipeline: Pipeline, render_pass: Pass | None) -> PassSubpass | None:
    """The subpass that a pipeline is made for, the only one if there is one; None where it is not
    stated or is for dynamic rendering.
    """
    if render_pass is None:
        return None
    index = (
        pipeline.subpass if pipeline.subpass is not None or len(render_pass.subpasses) != 1 else 0
    )
    return (
        render_pass.subpasses[index]
        if index is not None and index < len(render_pass.subpasses)
        else None
    )


def unshaded(frame: Frame) -> frozenset[tuple[str | None, int]]:
    """The subpasses, and as (None, 0) dynamic rendering, for which some multisampled pipeline
    states sampleShadingEnable off.
    """
    found = set()
    for pipeline, _ in frame.pipelines:
        state = pipeline.multisampleState
        if (
            state is not None
            and state.sampleShadingEnable is False
            and state.rasterizationSamples != 1
            and not discards(pipeline)
        ):
            found.add(_subpass_key(pipeline))
    return frozenset(found)


def _subpass_key(pipeline: Pipeline) -> tuple[str | None, int]:
    return pipeline.renderPass, pipeline.subpass or 0


def pipeline_facts(
    pipeline: Pipeline,
    subpass: PassSubpass | None,
    draws: Sequence[Draw],
    chosen_in: frozenset[tuple[str | None, int]],
    extensions: Container[str] = (),
) -> Facts:
    """What is known of a pipeline and of what it draws to. `draws` are the recorded ones with it,
    `extensions` those that are enabled.
    """
    facts = Facts()
    facts.put("pipeline.name", pipeline.key, pipeline.head)
    # Vulkan ignores both where rasterization is disabled.
    state = pipeline.multisampleState if not discards(pipeline) else None
    blend = pipeline.colorBlendState if not discards(pipeline) else None
    dynamic = set(pipeline.dynamicState)
    samples, at = _rasterization_samples(pipeline, draws)
    facts.put("pipeline.rasterization_samples", samples, at)
    facts.put("pipeline.samples_dynamic", SAMPLES_DYNAMIC in pipeline.dynamicState)
    if state is not None:
        facts.put(
            "pipeline.sample_shading", state.sampleShadingEnable, state.place("sampleShadingEnable")
        )
        facts.put("pipeline.sample_shading_chosen", _subpass_key(pipeline) in chosen_in)
        fraction = float(state.minSampleShading) if state.minSampleShading is not None else None
        facts.put("pipeline.min_sample_shading", fraction, state.place("minSampleShading"))
        if fraction is not None and samples is not None and 0 <= fraction <= 1:
            facts.put(
                "pipeline.shaded_samples",
                max(math.ceil(fraction * samples), 1),
                state.place("minSampleShading"),
            )
        if "ALPHA_TO_COVERAGE_ENABLE_EXT" not in dynamic:
            facts.put(
                "pipeline.alpha_to_coverage",
                state.alphaToCoverageEnable,
                state.place("alphaToCoverageEnable"),
            )
        if "ALPHA_TO_ONE_ENABLE_EXT" not in dynamic:
            facts.put(
                "pipeline.alpha_to_one", state.alphaToOneEnable, state.place("alphaToOneEnable")
            )
        if samples is not None and "SAMPLE_MASK_EXT" not in dynamic:
            facts.put(
                "pipeline.dropped_samples",
                _dropped(state.sampleMask, samples),
                state.place("sampleMask"),
            )
    raster = pipeline.rasterizationState
    if raster is not None and "RASTERIZER_DISCARD_ENABLE" not in dynamic:
        facts.put(
            "pipeline.rasterizer_discard",
            raster.rasterizerDiscardEnable,
            raster.place("rasterizerDiscardEnable"),
        )
    formats = _formats(pipeline, subpass)
    if blend is not None and "COLOR_BLEND_ENABLE_EXT" not in dynamic:
        if blend.attachments:
            first = blend.attachments[0]
            facts.put(
                "pipeline.blends_first",
                _blends_by_alpha(first, state, dynamic),
                first.place("blendEnable"),
            )
        floats, blended_at = _blended_floats(blend, formats)
        if floats is not None:
            facts.put("pipeline.blended_float_formats", floats, blended_at)
    elif formats and not any(format is None or format.arm_float_blend for format in formats):
        facts.put("pipeline.blended_float_formats", [])
    drawn_in = (
        [subpass]
        if subpass is not None
        else [draw.subpass for draw in draws if draw.subpass is not None]
    )
    required = {
        _required(pipeline, each, extensions) if not _resolves_itself(each) else (None, False)
        for each in drawn_in
    }
    count, or_more = required.pop() if len(required) == 1 else (None, False)
    facts.put("pipeline.attachment_samples", count, drawn_in[0].record.head if drawn_in else None)
    facts.put("pipeline.may_exceed_attachments", or_more)
    return facts


def _required(
    pipeline: Pipeline, subpass: PassSubpass, extensions: Container[str]
) -> tuple[int | None, bool]:
    """The count that a pipeline must have for a subpass, and whether it may have a higher one.

    With VK_AMD_mixed_attachment_samples it is the highest of the attachments
    (VUID-VkGraphicsPipelineCreateInfo-subpass-01505), with VK_NV_framebuffer_mixed_samples that of
    the depth-stencil attachment where the pipeline tests, else at least that of the color
    attachments (subpass-01411, subpass-01412).
    """
    if NV_MIXED_SAMPLES in extensions:
        tests = [attachment.samples for attachment in subpass.depth_stencil[:1]]
        colors = {attachment.samples for attachment in subpass.color if attachment is not None}
        tested = _tests(pipeline) if tests else False
        if tested is True:
            return tests[0], False
        return (colors.pop() if len(colors) == 1 else None), True
    if AMD_MIXED_SAMPLES in extensions and not subpass.single_sampled:
        attachments = [
            *(each for each in subpass.color if each is not None),
            *subpass.depth_stencil,
        ]
        counts = [each.samples for each in attachments if each.samples is not None]
        return (max(counts) if counts and len(counts) == len(attachments) else None), False
    return samples_of(subpass), False


def _tests(pipeline: Pipeline) -> bool | None:
    """Whether a depth, stencil, or depth bounds test is enabled; None where that is dynamic or not
    stated.
    """
    state, dynamic = pipeline.depthStencilState, pipeline.dynamicState
    stated = [
        None if name in dynamic else getattr(state, member, None)
        for name, member in (
            ("DEPTH_TEST_ENABLE", "depthTestEnable"),
            ("STENCIL_TEST_ENABLE", "stencilTestEnable"),
            ("DEPTH_BOUNDS_TEST_ENABLE", "depthBoundsTestEnable"),
        )
    ]
    return True if True in stated else None if None in stated else False


def _rasterization_samples(pipeline: Pipeline, draws: Sequence[Draw]) -> tuple[int | None, Span]:
    """The count that a pipeline rasterizes with, and where it is stated.

    Vulkan ignores pMultisampleState where rasterization is disabled, and its rasterizationSamples
    where that is dynamic state.
    """
    state, dynamic = pipeline.multisampleState, pipeline.dynamicState
    at = state.place("rasterizationSamples") if state is not None else pipeline.head
    if discards(pipeline):
        return None, at
    if SAMPLES_DYNAMIC not in dynamic:
        return state.rasterizationSamples if state is not None else None, at
    if not draws or len({draw.samples for draw in draws}) != 1 or draws[0].samples is None:
        return None, at
    return draws[0].samples, draws[0].samples_at or at


def draws_of(walk: Walk) -> dict[str, list[Draw]]:
    """The recorded draws by the names of their pipelines."""
    pipelines = walk.frame.description.pipelines
    draws: dict[str, list[Draw]] = {}
    samples: int | None = None
    at: Span | None = None
    for step in walk.steps:
        command = step.command
        if command.kind == "setRasterizationSamples" and isinstance(command.body, int):
            samples, at = command.body, command.head
        elif isinstance(command.body, DrawCommand) and command.body.pipeline in pipelines:
            name = command.body.pipeline
            subpasses = step.run.render_pass.subpasses if step.run is not None else []
            draws.setdefault(name, []).append(
                Draw(subpasses[0] if subpasses else None, samples, at)
            )
            # What was set before ends where a pipeline is bound whose count is static.
            if SAMPLES_DYNAMIC not in pipelines[name].dynamicState:
                samples, at = None, None
    return draws


def _resolves_itself(subpass: PassSubpass) -> bool:
    """Whether a subpass or rendering resolves by a shader: the pipeline that does has the targets'
    count.
    """
    return any(
        flag.startswith(("CUSTOM_RESOLVE", "SHADER_RESOLVE", "FRAGMENT_REGION"))
        for flag in subpass.record.flags
    )


def discards(pipeline: Pipeline) -> bool:
    """Whether rasterization is stated to be disabled, for all draws."""
    raster = pipeline.rasterizationState
    return (
        raster is not None
        and raster.rasterizerDiscardEnable is True
        and "RASTERIZER_DISCARD_ENABLE" not in pipeline.dynamicState
    )


def _blends_by_alpha(
    blended: ColorBlendAttachment, state: MultisampleState | None, dynamic: Container[str]
) -> bool | None:
    """Whether blending is on and uses the shader's alpha, as far as the factors and
    alphaToOneEnable are stated.
    """
    one = state is not None and state.alphaToOneEnable and "ALPHA_TO_ONE_ENABLE_EXT" not in dynamic
    factors = (blended.srcColorBlendFactor, blended.dstColorBlendFactor)
    known = None not in factors and "COLOR_BLEND_EQUATION_EXT" not in dynamic
    without = known and not any("SRC_ALPHA" in factor for factor in factors if factor is not None)
    return False if one or without or blended.colorWriteMask == () else blended.blendEnable


def _dropped(mask: tuple[int, ...], samples: int) -> int:
    """How many bits below the count a mask clears. No mask lets all through
    (VkPipelineMultisampleStateCreateInfo::pSampleMask).
    """
    if not mask:
        return 0
    bits = sum(word << (32 * n) for n, word in enumerate(mask))
    return samples - (bits & ((1 << samples) - 1)).bit_count()


def _formats(pipeline: Pipeline, subpass: PassSubpass | None) -> list[Format | None]:
    if subpass is not None:
        return [
            attachment.format if attachment is not None else None for attachment in subpass.color
        ]
    if pipeline.rendering is not None:
        return [
            format_of(name) if name is not None else None
            for name in pipeline.rendering.colorAttachmentFormats
        ]
    return []


def _blended_floats(
    blend: ColorBlendState, formats: list[Format | None]
) -> tuple[list[str] | None, Span | None]:
    """The float formats blended into and written; None where blending or a format is unknown and it
    could be one.
    """
    found: list[str] = []
    at: Span | None = None
    unknown = False
    for state, format in zip(blend.attachments, formats, strict=False):
        if format is None or not format.arm_float_blend or state.colorWriteMask == ():
            continue
        if state.blendEnable:
            found.append(format.name)
            at = at or state.place("blendEnable")
        unknown = unknown or state.blendEnable is None
    return (found, at) if found or not unknown else (None, None)
