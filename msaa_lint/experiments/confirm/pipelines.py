"""Graphics pipelines on a device, with the described SPIR-V or with built-in shaders."""

from __future__ import annotations

import os
from typing import Any

from msaa_lint.core.text.files import read
from msaa_lint.frame.spirv.module import MAX_BYTES, Module

from . import parts, plan_shaders
from .binding import chain
from .opening import DeviceObjects
from .parts import MASK_DYNAMIC, SCISSOR, VIEWPORT, Blend, Pass, Pipeline, unpacked
from .scene import DRAWN_STENCIL, VERTEX_BYTES

KINDS = {"UINT": "uint", "SINT": "sint", "": ""}
"""Kinds of fragment shader outputs by the numeric type of the color; others are `float`."""

VERTEX, FRAGMENT = 1, 16
POSITION_FORMAT = 106
"""R32G32B32_SFLOAT."""

TRIANGLE_LIST, TRIANGLE_FAN = 3, 5
"""VkPrimitiveTopology."""

ALWAYS, REPLACE = 7, 2
"""VkShaderStageFlagBits; VkCompareOp and VkStencilOp."""


def create_pipeline(
    objects: DeviceObjects,
    frame_pass: Pass,
    pipeline: Pipeline,
    render_pass: Any,
    layout: Any = None,
) -> Any:
    """A pipeline of a pass as planned, with the layout of its stages if it has any. VulkanError
    where the driver fails to create it.
    """
    opened = objects.opened
    kinds = outputs(pipeline)
    stages = {stage.stage: _described(objects, stage) for stage in pipeline.stages}
    # A generated vertex shader has no file, and the input of the built-in one.
    draws_scene = not pipeline.has_vertex_shader
    if VERTEX not in stages:
        stages[VERTEX] = _stage(objects, VERTEX, opened.module("scene.vert"))
    if FRAGMENT not in stages and any(kinds) and not pipeline.discard:
        stages[FRAGMENT] = _stage(
            objects,
            FRAGMENT,
            opened.module("shaded.frag" if pipeline.shaded else "scene.frag", kinds),
        )
    layout = layout or opened.layout("shaded" if pipeline.shaded else "scene")[0]
    return _create(
        objects,
        frame_pass,
        pipeline,
        render_pass,
        list(stages.values()),
        layout,
        draws_scene=draws_scene,
    )


def create_reader(
    objects: DeviceObjects, frame_pass: Pass, like: Pipeline, render_pass: Any, shader: str
) -> Any:
    """A pipeline that fills the targets of another with what `shader` reads."""
    plain = tuple(Blend() for _ in like.blends)
    pipeline = like._replace(
        sample_shading=-1.0, mask=(), alpha_to_coverage=False, alpha_to_one=False,
        dynamic=(VIEWPORT, SCISSOR), depth_test=False,
        depth_write=False, stencil_test=False, blends=plain, stages=(), depth_bias=False,
        polygon_mode=0, shaded=False,
    )  # fmt: skip
    opened = objects.opened
    stages = [
        _stage(objects, VERTEX, opened.module("cover.vert")),
        _stage(objects, FRAGMENT, opened.module(shader, outputs(like))),
    ]
    return _create(objects, frame_pass, pipeline, render_pass, stages, opened.layout("read")[0])


def outputs(pipeline: Pipeline) -> tuple[str, ...]:
    """The kinds of a pipeline's fragment shader outputs, by attachment."""
    return tuple(KINDS.get(numeric, "float") for numeric in pipeline.numerics)


def _stage(
    objects: DeviceObjects, stage: int, module: Any, name: str = "main", specialization: Any = None
) -> Any:
    return objects.vk.VkPipelineShaderStageCreateInfo(
        stage=stage, module=module, pName=name, pSpecializationInfo=specialization
    )


def _described(objects: DeviceObjects, stage: parts.Stage) -> Any:
    vk = objects.vk
    code = (
        unpacked(stage.code)
        if stage.code
        else read(stage.path, MAX_BYTES, os.path.dirname(stage.path))
    )
    module = objects.own(vk.vkDestroyShaderModule, objects.opened.compiled(code))
    specialization = None
    if stage.constants:
        data, entries = b"", []
        for number, value in plan_shaders.specialization(Module(code), stage.constants):
            entries.append(
                vk.VkSpecializationMapEntry(constantID=number, offset=len(data), size=len(value))
            )
            data += value
        specialization = vk.VkSpecializationInfo(
            pMapEntries=entries, dataSize=len(data), pData=vk.ffi.from_buffer("char[]", data)
        )
    return _stage(objects, stage.stage, module, stage.name, specialization)


def _create(
    objects: DeviceObjects,
    frame_pass: Pass,
    pipeline: Pipeline,
    render_pass: Any,
    stages: list[Any],
    layout: Any,
    draws_scene: bool = False,
) -> Any:
    vk = objects.vk
    # Patches need tessellation, which is not described.
    topology = (
        TRIANGLE_LIST if draws_scene or pipeline.topology > TRIANGLE_FAN else pipeline.topology
    )
    # A single attribute: the scene's positions.
    bindings = (
        [vk.VkVertexInputBindingDescription(binding=0, stride=VERTEX_BYTES)] if draws_scene else []
    )
    inputs = [vk.VkVertexInputAttributeDescription(format=POSITION_FORMAT)] if draws_scene else []
    # A pipeline without a subpass is for dynamic rendering, whichever pass it is created with.
    is_dynamic = render_pass is None or pipeline.subpass == parts.NONE
    uses_depth = pipeline.depth_test or pipeline.stencil_test or _has_depth(frame_pass, pipeline)
    create = vk.VkGraphicsPipelineCreateInfo(
        pStages=stages,
        pVertexInputState=vk.VkPipelineVertexInputStateCreateInfo(pVertexBindingDescriptions=bindings, pVertexAttributeDescriptions=inputs),  # noqa: E501
        pInputAssemblyState=vk.VkPipelineInputAssemblyStateCreateInfo(topology=topology),
        pViewportState=vk.VkPipelineViewportStateCreateInfo(viewportCount=1, scissorCount=1),
        pRasterizationState=vk.VkPipelineRasterizationStateCreateInfo(
            rasterizerDiscardEnable=pipeline.discard, depthClampEnable=pipeline.depth_clamp,
            depthBiasEnable=pipeline.depth_bias,
            polygonMode=pipeline.polygon_mode, lineWidth=1.0,
        ),
        pMultisampleState=_multisample(objects, pipeline),
        pDepthStencilState=_depth_stencil(objects, pipeline) if uses_depth else None,
        pColorBlendState=_blend(objects, pipeline) if pipeline.blends else None,
        pDynamicState=vk.VkPipelineDynamicStateCreateInfo(pDynamicStates=list(pipeline.dynamic)),
        layout=layout,
        renderPass=render_pass if not is_dynamic else None,
        subpass=pipeline.subpass if not is_dynamic else 0,
    )  # fmt: skip
    if is_dynamic:
        rendering_info = vk.VkPipelineRenderingCreateInfo(
            viewMask=pipeline.view_mask, colorAttachmentCount=len(pipeline.formats),
            pColorAttachmentFormats=list(pipeline.formats),
            depthAttachmentFormat=pipeline.depth_format,
            stencilAttachmentFormat=pipeline.stencil_format,
        )  # fmt: skip
        create = chain(create, rendering_info)
    create_infos = [create]
    if (
        is_dynamic
        and pipeline.samples > 1
        and "arm" in objects.opened.session.vendors
        and objects.opened.session.layer is not None
    ):
        create_infos.insert(0, _shield(objects))
    handles = vk.vkCreateGraphicsPipelines(
        objects.opened.handle, None, len(create_infos), create_infos, None
    )
    owned_handles = [
        objects.own(vk.vkDestroyPipeline, handles[number]) for number in range(len(create_infos))
    ]
    return owned_handles[-1]


def _shield(objects: DeviceObjects) -> Any:
    """A single-sampled pipeline that draws nothing, created in the same call as a multisampled
    pipeline for dynamic rendering.

    Arm's check of multisampled blending looks up the render pass of every pipeline and dereferences
    a null pointer without one, which kills the process (layers up to 1.3.239 at least); it stops at
    a single-sampled pipeline.
    """
    vk = objects.vk
    return chain(
        vk.VkGraphicsPipelineCreateInfo(
            pStages=[_stage(objects, VERTEX, objects.opened.module("cover.vert"))],
            pVertexInputState=vk.VkPipelineVertexInputStateCreateInfo(),
            pInputAssemblyState=vk.VkPipelineInputAssemblyStateCreateInfo(topology=3),
            pRasterizationState=vk.VkPipelineRasterizationStateCreateInfo(
                rasterizerDiscardEnable=1, lineWidth=1.0
            ),
            layout=objects.opened.layout("scene")[0],
        ),
        vk.VkPipelineRenderingCreateInfo(),
    )


def _has_depth(frame_pass: Pass, pipeline: Pipeline) -> bool:
    if frame_pass.kind == parts.RENDER_PASS and pipeline.subpass != parts.NONE:
        return bool(frame_pass.subpasses[pipeline.subpass].depth_stencil)
    return bool(pipeline.depth_format or pipeline.stencil_format)


def _multisample(objects: DeviceObjects, pipeline: Pipeline) -> Any:
    vk = objects.vk
    text = -(-pipeline.samples // 32)
    sample_mask = (
        [*pipeline.mask, *[0xFFFFFFFF] * text][:text]
        if pipeline.mask and MASK_DYNAMIC not in pipeline.dynamic
        else None
    )
    return vk.VkPipelineMultisampleStateCreateInfo(
        rasterizationSamples=pipeline.samples,
        sampleShadingEnable=pipeline.sample_shading >= 0,
        minSampleShading=max(pipeline.sample_shading, 0.0),
        pSampleMask=sample_mask,
        alphaToCoverageEnable=pipeline.alpha_to_coverage,
        alphaToOneEnable=pipeline.alpha_to_one,
    )


def _depth_stencil(objects: DeviceObjects, pipeline: Pipeline) -> Any:
    vk = objects.vk
    face = vk.VkStencilOpState(
        failOp=0, passOp=REPLACE, depthFailOp=0, compareOp=ALWAYS, compareMask=0xFF,
        writeMask=0xFF, reference=DRAWN_STENCIL
    )  # fmt: skip
    return vk.VkPipelineDepthStencilStateCreateInfo(
        depthTestEnable=pipeline.depth_test,
        depthWriteEnable=pipeline.depth_write,
        depthCompareOp=pipeline.depth_compare,
        stencilTestEnable=pipeline.stencil_test,
        front=face,
        back=face,
    )


def _blend(objects: DeviceObjects, pipeline: Pipeline) -> Any:
    vk = objects.vk
    states = [
        vk.VkPipelineColorBlendAttachmentState(
            blendEnable=blend.enable, srcColorBlendFactor=blend.source,
            dstColorBlendFactor=blend.target, colorBlendOp=blend.operation,
            srcAlphaBlendFactor=blend.source_alpha, dstAlphaBlendFactor=blend.target_alpha,
            alphaBlendOp=blend.alpha_operation,
            colorWriteMask=blend.mask,
        )
        for blend in pipeline.blends
    ]  # fmt: skip
    return vk.VkPipelineColorBlendStateCreateInfo(pAttachments=states)
