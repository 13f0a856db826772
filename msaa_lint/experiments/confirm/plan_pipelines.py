"""The pipelines of a plan: those described, and a built-in one for each subpass without any."""

from __future__ import annotations

import os
from collections.abc import Sequence

from msaa_lint.frame.description.models import ColorBlendAttachment
from msaa_lint.frame.description.models import Pipeline as DescribedPipeline
from msaa_lint.frame.vulkan.enums import VALUES
from msaa_lint.frame.vulkan.formats import format_of

from .parts import DEPTH, KEPT_DYNAMIC, SCISSOR, STENCIL, VIEWPORT, Blend, Image, Pipeline, Stage
from .plan_integers import mask, number
from .shaders.spirv import needs

LESS, GREATER = 1, 4
"""VkCompareOp."""


def built_in(
    name: str,
    subpass: int,
    samples: int,
    colors: Sequence[Image | None],
    depth: Image | None,
    *,
    read_only: bool,
    nearer: int,
    rendering: bool,
) -> Pipeline:
    """A pipeline compatible with the attachments of a subpass."""
    aspects = depth.aspects if depth is not None else 0
    return Pipeline(
        name,
        subpass,
        samples,
        dynamic=(VIEWPORT, SCISSOR),
        depth_test=bool(aspects & DEPTH),
        depth_write=bool(aspects & DEPTH) and not read_only,
        depth_compare=nearer,
        stencil_test=bool(aspects & STENCIL) and not read_only,
        blends=tuple(Blend() for _ in colors),
        numerics=tuple(image.numeric if image is not None else "" for image in colors),
        formats=tuple(image.format if image is not None else 0 for image in colors) if rendering else (),
        depth_format=depth.format if depth is not None and rendering and aspects & DEPTH else 0,
        stencil_format=depth.format if depth is not None and rendering and aspects & STENCIL else 0,
    )


def described(record: DescribedPipeline, fitting: Pipeline, folder: str, text: list[str]) -> Pipeline:
    """A described pipeline, based on one that is compatible with its attachments."""
    pipeline = fitting._replace(name=record.key)
    state = record.multisampleState
    if state is not None:
        samples = state.rasterizationSamples or pipeline.samples
        shading = (state.minSampleShading if state.minSampleShading is not None else 1.0) if state.sampleShadingEnable else -1.0
        pipeline = pipeline._replace(
            samples=samples,
            sample_shading=float(shading),
            mask=tuple(state.sampleMask),
            alpha_to_coverage=bool(state.alphaToCoverageEnable),
            alpha_to_one=bool(state.alphaToOneEnable),
        )
    depth = record.depthStencilState
    if depth is not None:
        compare = depth.depthCompareOp
        pipeline = pipeline._replace(
            depth_test=pipeline.depth_test if depth.depthTestEnable is None else depth.depthTestEnable,
            depth_write=pipeline.depth_write if depth.depthWriteEnable is None else depth.depthWriteEnable,
            depth_compare=pipeline.depth_compare if compare is None else number("VkCompareOp", compare),
            stencil_test=pipeline.stencil_test if depth.stencilTestEnable is None else depth.stencilTestEnable,
        )
    rasterization = record.rasterizationState
    if rasterization is not None:
        pipeline = pipeline._replace(
            discard=bool(rasterization.rasterizerDiscardEnable),
            depth_clamp=bool(rasterization.depthClampEnable),
            depth_bias=bool(rasterization.depthBiasEnable),
            polygon_mode=number("VkPolygonMode", rasterization.polygonMode) if rasterization.polygonMode is not None else 0,
        )
    if record.colorBlendState is not None:
        blends = [_blend(blend) for blend in record.colorBlendState.attachments][: len(pipeline.blends)]
        pipeline = pipeline._replace(blends=(*blends, *pipeline.blends[len(blends) :]))
    return _dynamic(record, _shaders(record, _formats(record, pipeline), folder, text), text)


def _formats(record: DescribedPipeline, pipeline: Pipeline) -> Pipeline:
    if record.rendering is None:
        return pipeline
    stated = record.rendering
    formats = tuple(VALUES["VkFormat"][name] if name is not None else 0 for name in stated.colorAttachmentFormats)
    # Unstated depth and stencil formats are unknown: use those of the attachments.
    return pipeline._replace(
        formats=formats or pipeline.formats,
        blends=(*pipeline.blends, *(Blend() for _ in formats))[: len(formats)] if formats else pipeline.blends,
        numerics=tuple(map(_numeric, stated.colorAttachmentFormats)) if formats else pipeline.numerics,
        depth_format=VALUES["VkFormat"][stated.depthAttachmentFormat] if stated.depthAttachmentFormat else pipeline.depth_format,
        stencil_format=VALUES["VkFormat"][stated.stencilAttachmentFormat] if stated.stencilAttachmentFormat else pipeline.stencil_format,
        view_mask=stated.viewMask or 0,
    )


def _numeric(name: str | None) -> str:
    format = format_of(name) if name is not None else None
    return format.numeric if format is not None else ""


def _dynamic(record: DescribedPipeline, pipeline: Pipeline, notes: list[str]) -> Pipeline:
    states = []
    for name in record.dynamicState:
        value = VALUES["VkDynamicState"][name]
        if value in KEPT_DYNAMIC:
            states.append(value)
        elif value not in (VIEWPORT, SCISSOR):
            notes.append(f"the dynamic state {name} of {record.key} is ignored")
    return pipeline._replace(dynamic=(VIEWPORT, SCISSOR, *states))


def _shaders(record: DescribedPipeline, pipeline: Pipeline, folder: str, notes: list[str]) -> Pipeline:
    """Adds the described SPIR-V of the vertex and fragment stages if the files exist. It is not validated here: the driver runs in its own
    process."""
    stages: list[Stage] = []
    stated_stages = {stage_record.stage for stage_record in record.stages}
    for stage_record in record.stages:
        path = os.path.join(folder, stage_record.module) if stage_record.module is not None else ""
        if stage_record.stage is not None and stage_record.stage not in ("VERTEX", "FRAGMENT"):
            notes.append(
                f"the {stage_record.stage.lower()} shader of {record.key} is ignored: only vertex and fragment shaders are supported"
            )
            continue
        if not path or stage_record.stage is None or not os.path.isfile(path):
            if path or stage_record.stage is not None:
                notes.append(
                    f"the {(stage_record.stage or 'unnamed').lower()} shader of {record.key} does not exist: a built-in one is used"
                )
            continue
        reason = _undrivable(path, stage_record.stage, "VERTEX" in stated_stages)
        if reason:
            notes.append(f"the {stage_record.stage.lower()} shader of {record.key} {reason}: a built-in one is used")
            continue
        constants = tuple((int(constant), float(value)) for constant, value in (stage_record.specialization or {}).items())
        stages.append(Stage(number("VkShaderStageFlagBits", stage_record.stage), path, stage_record.name or "main", constants))
    if record.vertexInputState is not None and not any(stage.stage == 1 for stage in stages):
        notes.append(f"the vertex input of {record.key} is ignored: the built-in shader has its own vertices")
    return pipeline._replace(stages=tuple(stages))


MAX_SPIRV = 4 << 20
"""Maximum size of a shader in bytes."""


def _undrivable(path: str, stage: str, has_vertex_stage: bool) -> str:
    """Why a described shader cannot be run; empty where it can."""
    try:
        with open(path, "rb") as file:
            inputs = needs(file.read(MAX_SPIRV + 1)[:MAX_SPIRV])
    except (OSError, ValueError) as error:
        return f"cannot be read ({error.strerror if isinstance(error, OSError) else error})"
    if "descriptors" in inputs:
        return "reads descriptors, which are not described"
    if "inputs" in inputs and (stage == "VERTEX" or not has_vertex_stage):
        return "has inputs, which are not described"
    return ""


def _blend(record: ColorBlendAttachment) -> Blend:
    default = Blend()

    def factor(name: str | None, default: int) -> int:
        return number("VkBlendFactor", name) if name is not None else default

    return Blend(
        bool(record.blendEnable),
        15 if record.colorWriteMask is None else mask("VkColorComponentFlagBits", record.colorWriteMask),
        factor(record.srcColorBlendFactor, default.source),
        factor(record.dstColorBlendFactor, default.target),
        number("VkBlendOp", record.colorBlendOp) if record.colorBlendOp is not None else default.operation,
        factor(record.srcAlphaBlendFactor, default.source_alpha),
        factor(record.dstAlphaBlendFactor, default.target_alpha),
        number("VkBlendOp", record.alphaBlendOp) if record.alphaBlendOp is not None else default.alpha_operation,
    )
