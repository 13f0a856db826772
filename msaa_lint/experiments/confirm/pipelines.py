"""Graphics pipelines on a device: with the described SPIR-V, else built-in shaders."""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING, Any

from . import parts
from .binding import chain
from .parts import MASK_DYNAMIC, Blend, Pass, Pipeline
from .scene import DRAWN_STENCIL, VERTEX_BYTES

if TYPE_CHECKING:
    from .build import Built

KINDS = {"UINT": "uint", "SINT": "sint", "": ""}
"""By the numeric type of a colour: the kind of a shader's output to it; the others are `float`."""

VERTEX, FRAGMENT = 1, 16
POSITION_FORMAT = 106
"""R32G32B32_SFLOAT."""

ALWAYS, REPLACE = 7, 2
"""VkShaderStageFlagBits; VkCompareOp and VkStencilOp."""


def made(built: Built, each: Pass, pipeline: Pipeline, render_pass: Any) -> Any:
    """A pipeline of a pass as it is planned. VulkanError where the driver does not create it."""
    opened = built.opened
    kinds = outputs(pipeline)
    stages = {stage.stage: _described(built, stage) for stage in pipeline.stages}
    own = VERTEX not in stages
    if own:
        stages[VERTEX] = _stage(built, VERTEX, opened.module("scene.vert"))
    if FRAGMENT not in stages and any(kinds) and not pipeline.discard:
        stages[FRAGMENT] = _stage(built, FRAGMENT, opened.module("scene.frag", kinds))
    return _create(built, each, pipeline, render_pass, list(stages.values()), opened.layout("scene")[0], scene=own)


def reader(built: Built, each: Pass, like: Pipeline, render_pass: Any, shader: str) -> Any:
    """A pipeline that fills what another draws to with what `shader` reads."""
    plain = tuple(Blend() for _ in like.blends)
    pipeline = like._replace(
        sample_shading=-1.0, mask=(), alpha_to_coverage=False, alpha_to_one=False, dynamic=like.dynamic, depth_test=False,
        depth_write=False, stencil_test=False, blends=plain, stages=(), depth_bias=False, polygon_mode=0,
    )  # fmt: skip
    opened = built.opened
    stages = [_stage(built, VERTEX, opened.module("cover.vert")), _stage(built, FRAGMENT, opened.module(shader, outputs(like)))]
    return _create(built, each, pipeline, render_pass, stages, opened.layout("read")[0])


def outputs(pipeline: Pipeline) -> tuple[str, ...]:
    """The kinds of the outputs of a pipeline's fragment shader, by the number of the attachment."""
    return tuple(KINDS.get(numeric, "float") for numeric in pipeline.numerics)


def _stage(built: Built, stage: int, module: Any, name: str = "main", specialization: Any = None) -> Any:
    return built.vk.VkPipelineShaderStageCreateInfo(stage=stage, module=module, pName=name, pSpecializationInfo=specialization)


def _described(built: Built, stage: parts.Stage) -> Any:
    vk = built.vk
    with open(stage.path, "rb") as file:
        module = built.own(vk.vkDestroyShaderModule, built.opened.compiled(file.read()))
    specialization = None
    if stage.constants:
        # An integer's bits, a float's where it has a fraction: the constant's type is not described.
        data = b"".join(_packed(value) for _, value in stage.constants)
        entries = [vk.VkSpecializationMapEntry(constantID=n, offset=4 * at, size=4) for at, (n, _) in enumerate(stage.constants)]
        specialization = vk.VkSpecializationInfo(pMapEntries=entries, dataSize=len(data), pData=vk.ffi.from_buffer("char[]", data))
    return _stage(built, stage.stage, module, stage.name, specialization)


def _packed(value: float) -> bytes:
    return struct.pack("<i", int(value)) if value == int(value) else struct.pack("<f", value)


def _create(built: Built, each: Pass, pipeline: Pipeline, render_pass: Any, stages: list[Any], layout: Any, scene: bool = False) -> Any:
    vk = built.vk
    # One attribute, the scene's positions.
    bindings = [vk.VkVertexInputBindingDescription(binding=0, stride=VERTEX_BYTES)] if scene else []
    inputs = [vk.VkVertexInputAttributeDescription(format=POSITION_FORMAT)] if scene else []
    # A pipeline of no subpass is of dynamic rendering, whatever pass it is created with.
    rendering = render_pass is None or pipeline.subpass == parts.NONE
    depth = pipeline.depth_test or pipeline.stencil_test or _has_depth(each, pipeline)
    create = vk.VkGraphicsPipelineCreateInfo(
        pStages=stages,
        pVertexInputState=vk.VkPipelineVertexInputStateCreateInfo(pVertexBindingDescriptions=bindings, pVertexAttributeDescriptions=inputs),
        pInputAssemblyState=vk.VkPipelineInputAssemblyStateCreateInfo(topology=3),
        pViewportState=vk.VkPipelineViewportStateCreateInfo(viewportCount=1, scissorCount=1),
        pRasterizationState=vk.VkPipelineRasterizationStateCreateInfo(
            rasterizerDiscardEnable=pipeline.discard, depthClampEnable=pipeline.depth_clamp, depthBiasEnable=pipeline.depth_bias,
            polygonMode=pipeline.polygon_mode, lineWidth=1.0,
        ),
        pMultisampleState=_multisample(built, pipeline),
        pDepthStencilState=_depth_stencil(built, pipeline) if depth else None,
        pColorBlendState=_blend(built, pipeline) if pipeline.blends else None,
        pDynamicState=vk.VkPipelineDynamicStateCreateInfo(pDynamicStates=list(pipeline.dynamic)),
        layout=layout,
        renderPass=render_pass if not rendering else None,
        subpass=pipeline.subpass if not rendering else 0,
    )  # fmt: skip
    if rendering:
        following = vk.VkPipelineRenderingCreateInfo(
            viewMask=pipeline.view_mask, colorAttachmentCount=len(pipeline.formats), pColorAttachmentFormats=list(pipeline.formats),
            depthAttachmentFormat=pipeline.depth_format, stencilAttachmentFormat=pipeline.stencil_format,
        )  # fmt: skip
        create = chain(create, following)
    created = [create]
    if rendering and pipeline.samples > 1 and "arm" in built.opened.session.vendors and built.opened.session.layer is not None:
        created.insert(0, _shield(built))
    found = vk.vkCreateGraphicsPipelines(built.opened.handle, None, len(created), created, None)
    own = [built.own(vk.vkDestroyPipeline, found[number]) for number in range(len(created))]
    return own[-1]


def _shield(built: Built) -> Any:
    """A pipeline of one sample that draws nothing, created in one call with a multisampled one of dynamic rendering.

    Arm's check of multisampled blending looks for the render pass of every pipeline and reads what is not there (the layer up to 1.3.239
    at least, which ends the process); at a pipeline of one sample it stops looking.
    """
    vk = built.vk
    return chain(
        vk.VkGraphicsPipelineCreateInfo(
            pStages=[_stage(built, VERTEX, built.opened.module("cover.vert"))],
            pVertexInputState=vk.VkPipelineVertexInputStateCreateInfo(),
            pInputAssemblyState=vk.VkPipelineInputAssemblyStateCreateInfo(topology=3),
            pRasterizationState=vk.VkPipelineRasterizationStateCreateInfo(rasterizerDiscardEnable=1, lineWidth=1.0),
            layout=built.opened.layout("scene")[0],
        ),
        vk.VkPipelineRenderingCreateInfo(),
    )


def _has_depth(each: Pass, pipeline: Pipeline) -> bool:
    if each.kind == parts.RENDER_PASS and pipeline.subpass != parts.NONE:
        return bool(each.subpasses[pipeline.subpass].depth_stencil)
    return bool(pipeline.depth_format or pipeline.stencil_format)


def _multisample(built: Built, pipeline: Pipeline) -> Any:
    vk = built.vk
    words = -(-pipeline.samples // 32)
    stated = [*pipeline.mask, *[0xFFFFFFFF] * words][:words] if pipeline.mask and MASK_DYNAMIC not in pipeline.dynamic else None
    return vk.VkPipelineMultisampleStateCreateInfo(
        rasterizationSamples=pipeline.samples,
        sampleShadingEnable=pipeline.sample_shading >= 0,
        minSampleShading=max(pipeline.sample_shading, 0.0),
        pSampleMask=stated,
        alphaToCoverageEnable=pipeline.alpha_to_coverage,
        alphaToOneEnable=pipeline.alpha_to_one,
    )


def _depth_stencil(built: Built, pipeline: Pipeline) -> Any:
    vk = built.vk
    face = vk.VkStencilOpState(
        failOp=0, passOp=REPLACE, depthFailOp=0, compareOp=ALWAYS, compareMask=0xFF, writeMask=0xFF, reference=DRAWN_STENCIL
    )  # fmt: skip
    return vk.VkPipelineDepthStencilStateCreateInfo(
        depthTestEnable=pipeline.depth_test,
        depthWriteEnable=pipeline.depth_write,
        depthCompareOp=pipeline.depth_compare,
        stencilTestEnable=pipeline.stencil_test,
        front=face,
        back=face,
    )


def _blend(built: Built, pipeline: Pipeline) -> Any:
    vk = built.vk
    states = [
        vk.VkPipelineColorBlendAttachmentState(
            blendEnable=each.enable, srcColorBlendFactor=each.source, dstColorBlendFactor=each.target, colorBlendOp=each.operation,
            srcAlphaBlendFactor=each.source_alpha, dstAlphaBlendFactor=each.target_alpha, alphaBlendOp=each.alpha_operation,
            colorWriteMask=each.mask,
        )
        for each in pipeline.blends
    ]  # fmt: skip
    return vk.VkPipelineColorBlendStateCreateInfo(pAttachments=states)
