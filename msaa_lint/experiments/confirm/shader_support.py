"""Which shaders from outside a device and a pass support; the others are replaced by built-in
ones.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from . import parts
from .parts import COLOR, NONE, STENCIL, Descriptor, Pass, Pipeline, Plan, Stage, unpacked
from .plan_notes import Notes
from .shader_features import SUBGROUPS, lacking, max_spirv
from .shader_resources import (
    COMBINED,
    IMAGES,
    INPUT_ATTACHMENT,
    SAMPLED_IMAGE,
    SAMPLER,
    STORAGE_BUFFER,
    STORAGE_IMAGE,
    STORAGE_TEXELS,
    TEXELS,
    UNIFORM_BUFFER,
    UNIFORM_TEXELS,
)
from .texels import format_name

_PER_STAGE = {
    "maxPerStageDescriptorSamplers": (SAMPLER, COMBINED),
    "maxPerStageDescriptorSampledImages": (COMBINED, SAMPLED_IMAGE, UNIFORM_TEXELS),
    "maxPerStageDescriptorStorageImages": (STORAGE_IMAGE, STORAGE_TEXELS),
    "maxPerStageDescriptorUniformBuffers": (UNIFORM_BUFFER,),
    "maxPerStageDescriptorStorageBuffers": (STORAGE_BUFFER,),
    "maxPerStageDescriptorInputAttachments": (INPUT_ATTACHMENT,),
    "maxPerStageResources": (
        COMBINED,
        SAMPLED_IMAGE,
        STORAGE_IMAGE,
        *TEXELS,
        UNIFORM_BUFFER,
        STORAGE_BUFFER,
        INPUT_ATTACHMENT,
    ),
}
"""The descriptor types that a limit of VkPhysicalDeviceLimits counts."""

_SIZES = {UNIFORM_BUFFER: "maxUniformBufferRange", STORAGE_BUFFER: "maxStorageBufferRange"}

_FORMAT_FEATURES = {
    COMBINED: 0x1,
    SAMPLED_IMAGE: 0x1,
    STORAGE_IMAGE: 0x2,
    UNIFORM_TEXELS: 0x8,
    STORAGE_TEXELS: 0x10,
}
"""VkFormatFeatureFlagBits by descriptor type."""


def unsupported(
    stages: Sequence[Stage], device: Mapping[str, Any], without: Sequence[str] = ()
) -> str:
    """Why a device (`opening.Session.device`) does not support the shaders of a pipeline, as the
    end of a sentence that begins with the shader: `needs ...`; empty if it does. Features `without`
    are disabled anyway, so they are not asked for.
    """
    return next((reason for stage in stages for reason in _reasons(stage, device, without)), "")


def _reasons(stage: Stage, device: Mapping[str, Any], without: Sequence[str]) -> Iterator[str]:
    feature = lacking(device, [name for name in stage.features if name not in without])
    if feature:
        kind = "the subgroup operations of" if feature in SUBGROUPS else "the feature"
        yield f"needs {kind} {feature}, which the device does not have"
    if stage.version > max_spirv(device):
        yield (
            f"is SPIR-V {stage.version[0]}.{stage.version[1]}, and the device takes at most "
            f"{'.'.join(map(str, max_spirv(device)))}"
        )
    limits: Mapping[str, Any] = device.get("properties", {}).get("limits", {})
    for name, types in _PER_STAGE.items():
        count = sum(each.length for each in stage.descriptors if each.type in types)
        if count > int(limits.get(name, count)):
            yield f"needs {count} descriptors, and the device has {name} {limits[name]}"
    sets = 1 + max((each.set for each in stage.descriptors), default=-1)
    if sets > int(limits.get("maxBoundDescriptorSets", sets)):
        yield (
            f"uses set {sets - 1}, and the device has maxBoundDescriptorSets "
            f"{limits['maxBoundDescriptorSets']}"
        )
    pushed = len(unpacked(stage.pushed)) if stage.pushed else 0
    if pushed > int(limits.get("maxPushConstantsSize", pushed)):
        yield (
            f"needs {pushed} bytes of push constants, and the device has maxPushConstantsSize "
            f"{limits['maxPushConstantsSize']}"
        )
    for descriptor in stage.descriptors:
        yield from _descriptor(descriptor, device, limits)


def _descriptor(
    descriptor: Descriptor, device: Mapping[str, Any], limits: Mapping[str, Any]
) -> Iterator[str]:
    where = f"set {descriptor.set}, binding {descriptor.binding}"
    limit = _SIZES.get(descriptor.type)
    if limit is not None and descriptor.size > int(limits.get(limit, descriptor.size)):
        yield (
            f"needs a buffer of {descriptor.size} bytes at {where}, and the device has {limit} "
            f"{limits[limit]}"
        )
    bit = _FORMAT_FEATURES.get(descriptor.type, 0)
    support = device.get("formats", {}).get(str(descriptor.format), {})
    if (
        bit
        and not support.get(
            "buffer" if descriptor.type in TEXELS else "features",
            bit if not device.get("formats") else 0,
        )
        & bit
    ):
        kind = (
            "texel buffers"
            if descriptor.type in TEXELS
            else "storage images"
            if descriptor.type == STORAGE_IMAGE
            else "sampled images"
        )
        yield (
            f"needs {format_name(descriptor.format)} at {where}, which the device does not "
            f"support for {kind}"
        )
    if descriptor.samples > 1 and descriptor.type in IMAGES:
        name = _count_limit(descriptor)
        if not int(limits.get(name, descriptor.samples)) & descriptor.samples:
            yield (
                f"needs an image with {descriptor.samples} samples at {where}, which the device "
                f"does not have ({name})"
            )


def _count_limit(descriptor: Descriptor) -> str:
    """The member of VkPhysicalDeviceLimits with the sample counts of an image."""
    if descriptor.type == STORAGE_IMAGE:
        return "storageImageSampleCounts"
    name = format_name(descriptor.format)
    kind = "Depth" if name.startswith("D") else "Integer" if name.endswith("INT") else "Color"
    return f"sampledImage{kind}SampleCounts"


def unsupported_in(
    plan: Plan, frame_pass: Pass, pipeline: Pipeline, device: Mapping[str, Any]
) -> str:
    """Why a device or a pass does not support the shaders of a pipeline, as `unsupported` says it;
    empty if both do.
    """
    return unsupported(pipeline.stages, device, plan.without) or _unfitting(
        plan, frame_pass, pipeline
    )


def supported(plan: Plan, device: Mapping[str, Any]) -> Plan:
    """A plan with built-in shaders in place of those that the device or their pass does not
    support; `defaults` says which.
    """
    notes = Notes()
    passes = []
    for frame_pass in plan.passes:
        pipelines = []
        for pipeline in frame_pass.pipelines:
            reason = unsupported_in(plan, frame_pass, pipeline, device)
            if reason:
                notes.append(f"the shader of {{}} {reason}: a built-in one is used", pipeline.name)
            pipelines.append(pipeline._replace(stages=()) if reason else pipeline)
        passes.append(frame_pass._replace(pipelines=tuple(pipelines)))
    return plan._replace(passes=tuple(passes), defaults=(*plan.defaults, *notes.lines()))


def _unfitting(plan: Plan, frame_pass: Pass, pipeline: Pipeline) -> str:
    """Why the input attachments of a pipeline's shaders are not those of its subpass; empty if they
    are.
    """
    for descriptor in (
        each
        for stage in pipeline.stages
        for each in stage.descriptors
        if each.type == INPUT_ATTACHMENT
    ):
        where = (
            f"input attachment {descriptor.attachment} at set {descriptor.set}, binding "
            f"{descriptor.binding}"
        )
        first, count = descriptor.attachment, descriptor.length
        inputs = (
            frame_pass.subpasses[pipeline.subpass].inputs
            if 0 <= pipeline.subpass < len(frame_pass.subpasses)
            else ()
        )
        if (
            frame_pass.kind != parts.RENDER_PASS
            or first + count > len(inputs)
            or inputs[first].attachment == NONE
        ):
            return f"reads {where}, which the pass does not have"
        if count > 1:
            return (
                f"reads an array of input attachments at set {descriptor.set}, binding "
                f"{descriptor.binding}, which is not created"
            )
        for framebuffer in frame_pass.framebuffers:
            image = plan.images[framebuffer.images[inputs[first].attachment]]
            integer = (
                image.numeric in ("SINT", "UINT")
                if image.aspects & COLOR
                else bool(image.aspects & STENCIL) and descriptor.nearest
            )
            if (image.samples > 1) != (descriptor.samples > 1):
                return f"reads {where}, whose image has {image.samples} samples"
            if integer != descriptor.nearest or not image.usage & parts.INPUT_ATTACHMENT:
                return f"reads {where}, whose image {image.name} is of another type"
    return ""
