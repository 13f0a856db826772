"""Facts of graphics pipelines."""

from __future__ import annotations

import math

from ..document.records import ColorBlendState, Pipeline
from ..finding import Span
from ..vulkan.formats import Format, format_of
from .facts import Facts
from .frame import Frame, Pass, PassSubpass
from .subpass import samples_of

SAMPLES_DYNAMIC = "RASTERIZATION_SAMPLES_EXT"


def subpass_of(pipeline: Pipeline, within: Pass | None) -> PassSubpass | None:
    """The subpass that a pipeline is made for; None where it is not stated or is for dynamic rendering."""
    if within is None or pipeline.subpass is None or pipeline.subpass >= len(within.subpasses):
        return None
    return within.subpasses[pipeline.subpass]


def pipeline_facts(pipeline: Pipeline, subpass: PassSubpass | None, frame: Frame) -> Facts:
    """What is known of a pipeline and of what it draws to."""
    facts = Facts()
    facts.put("pipeline.name", pipeline.key, pipeline.head)
    state = pipeline.multisampleState
    dynamic = set(pipeline.dynamicState)
    samples: int | None = None
    if state is not None:
        if SAMPLES_DYNAMIC not in dynamic:
            samples = state.rasterizationSamples
        facts.put("pipeline.rasterization_samples", samples, state.place("rasterizationSamples"))
        facts.put("pipeline.sample_shading", state.sampleShadingEnable, state.place("sampleShadingEnable"))
        fraction = float(state.minSampleShading) if state.minSampleShading is not None else None
        facts.put("pipeline.min_sample_shading", fraction, state.place("minSampleShading"))
        if fraction is not None and samples is not None and 0 <= fraction <= 1:
            facts.put("pipeline.shaded_samples", max(math.ceil(fraction * samples), 1), state.place("minSampleShading"))
        if "ALPHA_TO_COVERAGE_ENABLE_EXT" not in dynamic:
            facts.put("pipeline.alpha_to_coverage", state.alphaToCoverageEnable, state.place("alphaToCoverageEnable"))
        if samples is not None and "SAMPLE_MASK_EXT" not in dynamic:
            facts.put("pipeline.dropped_samples", _dropped(state.sampleMask, samples), state.place("sampleMask"))
    raster = pipeline.rasterizationState
    if raster is not None and "RASTERIZER_DISCARD_ENABLE" not in dynamic:
        facts.put("pipeline.rasterizer_discard", raster.rasterizerDiscardEnable, raster.place("rasterizerDiscardEnable"))
    blend = pipeline.colorBlendState
    if blend is not None and "COLOR_BLEND_ENABLE_EXT" not in dynamic:
        if blend.attachments:
            first = blend.attachments[0]
            facts.put("pipeline.blends_first", first.blendEnable, first.place("blendEnable"))
        floats, at = _blended_floats(blend, _formats(pipeline, subpass))
        if floats is not None:
            facts.put("pipeline.blended_float_formats", floats, at)
    drawn = samples_of(subpass) if subpass is not None else _drawn_samples(pipeline, frame)
    facts.put("pipeline.attachment_samples", drawn, subpass.record.head if subpass is not None else None)
    return facts


def _dropped(mask: tuple[int, ...], samples: int) -> int:
    """How many bits below the count a mask clears. No mask lets all through (VkPipelineMultisampleStateCreateInfo::pSampleMask)."""
    if not mask:
        return 0
    bits = sum(word << (32 * n) for n, word in enumerate(mask))
    return samples - (bits & ((1 << samples) - 1)).bit_count()


def _formats(pipeline: Pipeline, subpass: PassSubpass | None) -> list[Format | None]:
    if subpass is not None:
        return [attachment.format if attachment is not None else None for attachment in subpass.color]
    if pipeline.rendering is not None:
        return [format_of(name) if name is not None else None for name in pipeline.rendering.colorAttachmentFormats]
    return []


def _blended_floats(blend: ColorBlendState, formats: list[Format | None]) -> tuple[list[str] | None, Span | None]:
    """The float formats blended into and written; None where blending or a format is unknown and it could be one."""
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


def _drawn_samples(pipeline: Pipeline, frame: Frame) -> int | None:
    """For dynamic rendering: the count that every rendering the frame's commands draw in with this pipeline has; else None."""
    counts: set[int | None] = set()
    current: PassSubpass | None = None
    begins = {position: each for each in frame.passes for position in each.begun}
    for position, command in enumerate(frame.commands):
        if position in begins:
            current = begins[position].subpasses[0] if begins[position].subpasses else None
        elif command.kind in ("endRendering", "endRenderPass"):
            current = None
        elif command.kind == "draw" and getattr(command.body, "pipeline", None) == pipeline.key and current is not None:
            counts.add(samples_of(current))
    return counts.pop() if len(counts) == 1 else None
