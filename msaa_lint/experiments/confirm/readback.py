"""Reads images back: their texels as stored, and the samples of multisampled images."""

from __future__ import annotations

import os
from typing import Any

from .build import FrameObjects
from .defined_contents import aspect_name
from .device_images import CACHED, COHERENT, HOST_VISIBLE
from .draw import Recorder
from .opening import Emit
from .parts import (
    COLOR,
    DEPTH,
    DEPTH_READ_LAYOUT,
    READ_LAYOUT,
    SOURCE_LAYOUT,
    STENCIL,
    TRANSFER_SOURCE,
    Image,
)
from .submit import Submitter

MAX_BYTES = 1 << 30
"""Maximum size in bytes of an image that is read back."""

DEPTH_BYTES = {124: 2, 128: 2, 125: 4, 126: 4, 129: 4, 130: 4}
"""Bytes of a texel's depth in a buffer, by the VkFormat's number."""

NAMES = {COLOR: "", DEPTH: "", STENCIL: "stencil"}


class Buffer:
    """Memory that the device writes and the host reads."""

    def __init__(self, built: FrameObjects, size: int, usage: int) -> None:
        self.built, self.size = built, size
        vk, handle = built.vk, built.opened.handle
        self.handle = vk.vkCreateBuffer(handle, vk.VkBufferCreateInfo(size=size, usage=usage), None)
        needs = vk.vkGetBufferMemoryRequirements(handle, self.handle)
        visible = HOST_VISIBLE | COHERENT
        kind = built.opened.memory_type(needs.memoryTypeBits, visible | CACHED, visible)
        self.memory = vk.vkAllocateMemory(
            handle, vk.VkMemoryAllocateInfo(allocationSize=needs.size, memoryTypeIndex=kind), None
        )
        vk.vkBindBufferMemory(handle, self.handle, self.memory, 0)

    def write_to(self, path: str) -> None:
        """Writes its bytes to a file."""
        vk, handle = self.built.vk, self.built.opened.handle
        mapped = vk.vkMapMemory(handle, self.memory, 0, self.size, 0)
        try:
            with open(path, "wb") as file:
                file.write(mapped)
        finally:
            vk.vkUnmapMemory(handle, self.memory)

    def close(self) -> None:
        """Destroys it."""
        vk, handle = self.built.vk, self.built.opened.handle
        vk.vkDestroyBuffer(handle, self.handle, None)
        vk.vkFreeMemory(handle, self.memory, None)


def texel_bytes(image: Image, aspect: int) -> int:
    """Bytes of a texel's aspect in a buffer; 0 if unknown."""
    if aspect == STENCIL:
        return 1
    return DEPTH_BYTES.get(image.format, 0) if aspect == DEPTH else image.bytes


def bring_back(recorder: Recorder, submitter: Submitter, folder: str, emit: Emit) -> None:
    """Writes every image with defined contents, or with poisoned ones, to a file and reports it; of
    other images with defined contents it reports that. Nothing may use the images afterwards.
    """
    built, vk = recorder.built, recorder.vk
    taken: list[tuple[int, int, Buffer]] = []
    buffer = submitter.begin()
    recorder.layouts.fence(buffer)
    for number, aspect in recorder.contents.outputs(poisoned=True):
        image = built.plan.images[number]
        size = texel_bytes(image, aspect) * image.width * image.height * image.layers
        if (
            not size
            or size > MAX_BYTES
            or number not in built.images
            or not built.has_usage(number, TRANSFER_SOURCE)
        ):
            continue
        target = Buffer(built, size, 2)
        taken.append((number, aspect, target))
        recorder.layouts.into(buffer, [(number, SOURCE_LAYOUT, None)])
        layers = vk.VkImageSubresourceLayers(
            aspectMask=aspect, mipLevel=0, baseArrayLayer=0, layerCount=image.layers
        )
        region = vk.VkBufferImageCopy(
            imageSubresource=layers, imageExtent=vk.VkExtent3D(image.width, image.height, 1)
        )
        vk.vkCmdCopyImageToBuffer(
            buffer, built.image(number), SOURCE_LAYOUT, target.handle, 1, [region]
        )
    submitter.end()
    for number, aspect, target in taken:
        image = built.plan.images[number]
        path = os.path.join(folder, f"{number}{'-stencil' if aspect == STENCIL else ''}.raw")
        target.write_to(path)
        target.close()
        found = {
            "event": "pixels",
            "image": aspect_name(image, aspect),
            "format": image.format,
            "path": path,
            "aspect": NAMES[aspect],
        }
        contents, key = recorder.contents, (number, aspect)
        states = {"defined": key in contents.known, "discarded": key in contents.discarded}
        emit({**found, "width": image.width, "height": image.height * image.layers, **states})
    for number, aspect in sorted(
        recorder.contents.known - {(number, aspect) for number, aspect, _ in taken}
    ):
        emit({"event": "defined", "image": aspect_name(built.plan.images[number], aspect)})


def bring_samples(
    recorder: Recorder, submitter: Submitter, number: int, folder: str, emit: Emit
) -> None:
    """Writes the samples of a multisampled image to a file: four 32-bit floats per sample, sample
    by sample, in rows from the top.
    """
    built, vk, opened = recorder.built, recorder.vk, recorder.built.opened
    image = built.plan.images[number]
    target = Buffer(built, image.width * image.height * image.samples * 16, 0x20)
    layout, set_layout = opened.layout("samples")
    stage = vk.VkPipelineShaderStageCreateInfo(
        stage=32, module=opened.module("samples.comp"), pName="main"
    )
    create = vk.VkComputePipelineCreateInfo(stage=stage, layout=layout)
    pipeline = built.own(
        vk.vkDestroyPipeline, vk.vkCreateComputePipelines(opened.handle, None, 1, [create], None)[0]
    )
    buffer = submitter.begin()
    recorder.layouts.fence(buffer)
    recorder.layouts.into(
        buffer, [(number, READ_LAYOUT if image.aspects & COLOR else DEPTH_READ_LAYOUT, None)]
    )
    vk.vkCmdBindPipeline(buffer, 1, pipeline)
    descriptor: Any = recorder.descriptor(set_layout, number, target.handle)
    vk.vkCmdBindDescriptorSets(buffer, 1, layout, 0, 1, [descriptor], 0, None)
    vk.vkCmdDispatch(buffer, -(-image.width // 8), -(-image.height // 8), 1)
    submitter.end()
    path = os.path.join(folder, f"{number}-samples.raw")
    target.write_to(path)
    target.close()
    own = {
        "width": image.width,
        "height": image.height,
        "samples": image.samples,
        "format": image.format,
        "path": path,
    }
    emit({"event": "sample", "image": image.name, **own})
