"""The pipelines of a plan: as described, and one for each subpass that has none."""

from __future__ import annotations

import os
from collections.abc import Sequence

from msaa_lint.frame.description.models import ColorBlendAttachment
from msaa_lint.frame.description.models import Pipeline as Described
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
    """A pipeline that fits what a subpass draws to."""
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
        numerics=tuple(each.numeric if each is not None else "" for each in colors),
        formats=tuple(each.format if each is not None else 0 for each in colors) if rendering else (),
        depth_format=depth.format if depth is not None and rendering and aspects & DEPTH else 0,
        stencil_format=depth.format if depth is not None and rendering and aspects & STENCIL else 0,
    )


def described(record: Described, fitting: Pipeline, folder: str, text: list[str]) -> Pipeline:
    """A pipeline as it is described, on top of one that fits what it draws to."""
    made = fitting._replace(name=record.key)
    state = record.multisampleState
    if state is not None:
        samples = state.rasterizationSamples or made.samples
        shading = (state.minSampleShading if state.minSampleShading is not None else 1.0) if state.sampleShadingEnable else -1.0
        made = made._replace(
            samples=samples,
            sample_shading=float(shading),
            mask=tuple(state.sampleMask),
            alpha_to_coverage=bool(state.alphaToCoverageEnable),
            alpha_to_one=bool(state.alphaToOneEnable),
        )
    depth = record.depthStencilState
    if depth is not None:
        compare = depth.depthCompareOp
        made = made._replace(
            depth_test=made.depth_test if depth.depthTestEnable is None else depth.depthTestEnable,
            depth_write=made.depth_write if depth.depthWriteEnable is None else depth.depthWriteEnable,
            depth_compare=made.depth_compare if compare is None else number("VkCompareOp", compare),
            stencil_test=made.stencil_test if depth.stencilTestEnable is None else depth.stencilTestEnable,
        )
    raster = record.rasterizationState
    if raster is not None:
        made = made._replace(
            discard=bool(raster.rasterizerDiscardEnable),
            depth_clamp=bool(raster.depthClampEnable),
            depth_bias=bool(raster.depthBiasEnable),
            polygon_mode=number("VkPolygonMode", raster.polygonMode) if raster.polygonMode is not None else 0,
        )
    if record.colorBlendState is not None:
        blends = [_blend(each) for each in record.colorBlendState.attachments][: len(made.blends)]
        made = made._replace(blends=(*blends, *made.blends[len(blends) :]))
    return _dynamic(record, _shaders(record, _formats(record, made), folder, text), text)


def _formats(record: Described, made: Pipeline) -> Pipeline:
    if record.rendering is None:
        return made
    stated = record.rendering
    formats = tuple(VALUES["VkFormat"][each] if each is not None else 0 for each in stated.colorAttachmentFormats)
    # Absent depth and stencil formats are unknown, and those of what it draws to.
    return made._replace(
        formats=formats or made.formats,
        blends=(*made.blends, *(Blend() for _ in formats))[: len(formats)] if formats else made.blends,
        numerics=tuple(map(_numeric, stated.colorAttachmentFormats)) if formats else made.numerics,
        depth_format=VALUES["VkFormat"][stated.depthAttachmentFormat] if stated.depthAttachmentFormat else made.depth_format,
        stencil_format=VALUES["VkFormat"][stated.stencilAttachmentFormat] if stated.stencilAttachmentFormat else made.stencil_format,
        view_mask=stated.viewMask or 0,
    )


def _numeric(name: str | None) -> str:
    found = format_of(name) if name is not None else None
    return found.numeric if found is not None else ""


def _dynamic(record: Described, made: Pipeline, text: list[str]) -> Pipeline:
    kept = []
    for name in record.dynamicState:
        value = VALUES["VkDynamicState"][name]
        if value in KEPT_DYNAMIC:
            kept.append(value)
        elif value not in (VIEWPORT, SCISSOR):
            text.append(f"the dynamic state {name} of {record.key} is left out")
    return made._replace(dynamic=(VIEWPORT, SCISSOR, *kept))


def _shaders(record: Described, made: Pipeline, folder: str, text: list[str]) -> Pipeline:
    """The described SPIR-V of a vertex and a fragment stage, where its files are there; it is the driver's to judge, in its own process."""
    stages: list[Stage] = []
    described = {each.stage for each in record.stages}
    for each in record.stages:
        path = os.path.join(folder, each.module) if each.module is not None else ""
        if each.stage is not None and each.stage not in ("VERTEX", "FRAGMENT"):
            text.append(f"the {each.stage.lower()} shader of {record.key} is left out: only vertices and fragments are shaded here")
            continue
        if not path or each.stage is None or not os.path.isfile(path):
            if path or each.stage is not None:
                text.append(f"the {(each.stage or 'unnamed').lower()} shader of {record.key} is not there: a built-in one is taken")
            continue
        reason = _undrivable(path, each.stage, "VERTEX" in described)
        if reason:
            text.append(f"the {each.stage.lower()} shader of {record.key} {reason}: a built-in one is taken")
            continue
        constants = tuple((int(constant), float(value)) for constant, value in (each.specialization or {}).items())
        stages.append(Stage(number("VkShaderStageFlagBits", each.stage), path, each.name or "main", constants))
    if record.vertexInputState is not None and not any(stage.stage == 1 for stage in stages):
        text.append(f"the vertex input of {record.key} is left out: the built-in shader makes its own vertices")
    return made._replace(stages=tuple(stages))


MAX_SPIRV = 4 << 20
"""Bytes of a shader that are read."""


def _undrivable(path: str, stage: str, with_vertices: bool) -> str:
    """Why a described shader cannot be run here; empty where it can. What a driver makes of it is seen in its own process."""
    try:
        with open(path, "rb") as file:
            found = needs(file.read(MAX_SPIRV + 1)[:MAX_SPIRV])
    except (OSError, ValueError) as error:
        return f"cannot be read ({error.strerror if isinstance(error, OSError) else error})"
    if "descriptors" in found:
        return "reads descriptors, which are not described"
    if "inputs" in found and (stage == "VERTEX" or not with_vertices):
        return "has inputs, which are not described"
    return ""


def _blend(record: ColorBlendAttachment) -> Blend:
    usual = Blend()

    def factor(name: str | None, default: int) -> int:
        return number("VkBlendFactor", name) if name is not None else default

    return Blend(
        bool(record.blendEnable),
        15 if record.colorWriteMask is None else mask("VkColorComponentFlagBits", record.colorWriteMask),
        factor(record.srcColorBlendFactor, usual.source),
        factor(record.dstColorBlendFactor, usual.target),
        number("VkBlendOp", record.colorBlendOp) if record.colorBlendOp is not None else usual.operation,
        factor(record.srcAlphaBlendFactor, usual.source_alpha),
        factor(record.dstAlphaBlendFactor, usual.target_alpha),
        number("VkBlendOp", record.alphaBlendOp) if record.alphaBlendOp is not None else usual.alpha_operation,
    )
