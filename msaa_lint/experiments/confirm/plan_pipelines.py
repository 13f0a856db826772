"""The pipelines of a plan: those described, and a built-in one for each subpass without any."""

from __future__ import annotations

from collections.abc import Sequence

from msaa_lint.frame.description.models import ColorBlendAttachment
from msaa_lint.frame.description.models import Pipeline as DescribedPipeline
from msaa_lint.frame.vulkan.enums import VALUES
from msaa_lint.frame.vulkan.formats import format_of

from .parts import DEPTH, KEPT_DYNAMIC, SCISSOR, STENCIL, VIEWPORT, Blend, Image, Pipeline
from .plan_integers import mask, number
from .plan_notes import Notes
from .plan_shaders import stages

LESS, GREATER = 1, 4
"""VkCompareOp."""

VIEWPORTS = (
    VIEWPORT,
    SCISSOR,
    VALUES["VkDynamicState"]["VIEWPORT_WITH_COUNT"],
    VALUES["VkDynamicState"]["SCISSOR_WITH_COUNT"],
)
"""VkDynamicState: a single viewport and scissor are always dynamic."""


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
        formats=tuple(image.format if image is not None else 0 for image in colors)
        if rendering
        else (),
        depth_format=depth.format if depth is not None and rendering and aspects & DEPTH else 0,
        stencil_format=depth.format if depth is not None and rendering and aspects & STENCIL else 0,
    )


def described(record: DescribedPipeline, fitting: Pipeline, folder: str, text: Notes) -> Pipeline:
    """A described pipeline, based on one that is compatible with its attachments. UnusableShader if
    a shader of it cannot be used.
    """
    pipeline = fitting._replace(name=record.key)
    state = record.multisampleState
    if state is not None:
        samples = state.rasterizationSamples or pipeline.samples
        shading = (
            (state.minSampleShading if state.minSampleShading is not None else 1.0)
            if state.sampleShadingEnable
            else -1.0
        )
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
            depth_test=pipeline.depth_test
            if depth.depthTestEnable is None
            else depth.depthTestEnable,
            depth_write=pipeline.depth_write
            if depth.depthWriteEnable is None
            else depth.depthWriteEnable,
            depth_compare=pipeline.depth_compare
            if compare is None
            else number("VkCompareOp", compare),
            stencil_test=pipeline.stencil_test
            if depth.stencilTestEnable is None
            else depth.stencilTestEnable,
        )
    rasterization = record.rasterizationState
    if rasterization is not None:
        pipeline = pipeline._replace(
            discard=bool(rasterization.rasterizerDiscardEnable),
            depth_clamp=bool(rasterization.depthClampEnable),
            depth_bias=bool(rasterization.depthBiasEnable),
            polygon_mode=number("VkPolygonMode", rasterization.polygonMode)
            if rasterization.polygonMode is not None
            else 0,
        )
    if record.inputAssemblyState is not None and record.inputAssemblyState.topology is not None:
        pipeline = pipeline._replace(
            topology=number("VkPrimitiveTopology", record.inputAssemblyState.topology)
        )
    if record.colorBlendState is not None:
        blends = [_blend(blend) for blend in record.colorBlendState.attachments][
            : len(pipeline.blends)
        ]
        pipeline = pipeline._replace(blends=(*blends, *pipeline.blends[len(blends) :]))
    return _dynamic(record, _shaders(record, _formats(record, pipeline), folder, text), text)


def _formats(record: DescribedPipeline, pipeline: Pipeline) -> Pipeline:
    if record.rendering is None:
        return pipeline
    stated = record.rendering
    formats = tuple(
        VALUES["VkFormat"][name] if name is not None else 0
        for name in stated.colorAttachmentFormats
    )
    # Unstated depth and stencil formats are unknown: use those of the attachments.
    return pipeline._replace(
        formats=formats or pipeline.formats,
        blends=(*pipeline.blends, *(Blend() for _ in formats))[: len(formats)]
        if formats
        else pipeline.blends,
        numerics=tuple(map(_numeric, stated.colorAttachmentFormats))
        if formats
        else pipeline.numerics,
        depth_format=VALUES["VkFormat"][stated.depthAttachmentFormat]
        if stated.depthAttachmentFormat
        else pipeline.depth_format,
        stencil_format=VALUES["VkFormat"][stated.stencilAttachmentFormat]
        if stated.stencilAttachmentFormat
        else pipeline.stencil_format,
        view_mask=stated.viewMask or 0,
    )


def _numeric(name: str | None) -> str:
    format = format_of(name) if name is not None else None
    return format.numeric if format is not None else ""


def _dynamic(record: DescribedPipeline, pipeline: Pipeline, notes: Notes) -> Pipeline:
    values = {name: VALUES["VkDynamicState"][name] for name in record.dynamicState}
    ignored = [name for name, value in values.items() if value not in (*KEPT_DYNAMIC, *VIEWPORTS)]
    if ignored:
        states = f"state {ignored[0]}" if len(ignored) == 1 else f"states {', '.join(ignored)}"
        notes.append(
            f"the dynamic {states} of {{}} {'is' if len(ignored) == 1 else 'are'} ignored",
            record.key,
        )
    return pipeline._replace(
        dynamic=(VIEWPORT, SCISSOR, *(value for value in values.values() if value in KEPT_DYNAMIC))
    )


def _shaders(record: DescribedPipeline, pipeline: Pipeline, folder: str, notes: Notes) -> Pipeline:
    """Adds the described SPIR-V of the vertex and fragment stages."""
    described_stages = stages(record, folder, notes)
    if record.vertexInputState is not None and not any(
        stage.stage == 1 and stage.path for stage in described_stages
    ):
        notes.append(
            "the vertex input of {} is ignored: the built-in shader has its own vertices",
            record.key,
        )
    return pipeline._replace(stages=described_stages)


def _blend(record: ColorBlendAttachment) -> Blend:
    default = Blend()

    def factor(name: str | None, default: int) -> int:
        return number("VkBlendFactor", name) if name is not None else default

    return Blend(
        bool(record.blendEnable),
        15
        if record.colorWriteMask is None
        else mask("VkColorComponentFlagBits", record.colorWriteMask),
        factor(record.srcColorBlendFactor, default.source),
        factor(record.dstColorBlendFactor, default.target),
        number("VkBlendOp", record.colorBlendOp)
        if record.colorBlendOp is not None
        else default.operation,
        factor(record.srcAlphaBlendFactor, default.source_alpha),
        factor(record.dstAlphaBlendFactor, default.target_alpha),
        number("VkBlendOp", record.alphaBlendOp)
        if record.alphaBlendOp is not None
        else default.alpha_operation,
    )
