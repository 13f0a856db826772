"""Images with their memory on a device, and their contents."""

from __future__ import annotations

from typing import Any

from .opening import DeviceObjects, OpenDevice
from .parts import DEPTH, TARGET_LAYOUT, UNDEFINED, Image
from .submit import Submitter

DEVICE_LOCAL, HOST_VISIBLE, COHERENT, CACHED, LAZY = 0x1, 0x2, 0x4, 0x8, 0x10
"""VkMemoryPropertyFlagBits."""

COMMANDS = 0x10000
"""VK_PIPELINE_STAGE_ALL_COMMANDS_BIT."""

STAGING = 0x1
"""VK_BUFFER_USAGE_TRANSFER_SRC_BIT."""


def create_image(objects: DeviceObjects, image: Image, more_usage: int = 0) -> Any:
    """An image with its memory."""
    vk, handle = objects.vk, objects.opened.handle
    create = vk.VkImageCreateInfo(
        flags=image.flags,
        imageType=image.type,
        format=image.format,
        extent=vk.VkExtent3D(image.width, image.height, image.depth),
        mipLevels=image.levels,
        arrayLayers=image.layers,
        samples=image.samples,
        tiling=image.tiling,
        usage=image.usage | more_usage,
    )
    created = objects.own(vk.vkDestroyImage, vk.vkCreateImage(handle, create, None))
    needs = vk.vkGetImageMemoryRequirements(handle, created)
    properties = (LAZY, DEVICE_LOCAL) if image.lazy else (DEVICE_LOCAL,)
    kind = objects.opened.memory_type(needs.memoryTypeBits, *properties)
    allocate = vk.VkMemoryAllocateInfo(allocationSize=needs.size, memoryTypeIndex=kind)
    memory = objects.own(vk.vkFreeMemory, vk.vkAllocateMemory(handle, allocate, None))
    # Memory must be freed after the image that is bound to it is destroyed.
    objects._created[-2:] = reversed(objects._created[-2:])
    vk.vkBindImageMemory(handle, created, memory, 0)
    return created


def fill(opened: OpenDevice, created: Any, image: Image, texels: bytes | None, layout: int) -> None:
    """Writes the texels of the first mip level of a layer to every level and layer of an image,
    each from the start; without texels, 0.5, or the integer 1. The image is then in a layout. It
    submits.
    """
    vk, staging = opened.vk, DeviceObjects(opened)
    submitter = Submitter(opened)
    try:
        buffer = submitter.begin()
        _transition(vk, buffer, created, image, UNDEFINED, TARGET_LAYOUT)
        whole = vk.VkImageSubresourceRange(
            aspectMask=image.aspects, levelCount=image.levels, layerCount=image.layers
        )
        if texels is not None:
            source, memory = opened.buffer(texels, STAGING)
            staging.own(vk.vkFreeMemory, memory)
            staging.own(vk.vkDestroyBuffer, source)
            regions = [
                _region(vk, image, level, layer)
                for level in range(image.levels)
                for layer in range(image.layers)
            ]
            vk.vkCmdCopyBufferToImage(buffer, source, created, TARGET_LAYOUT, len(regions), regions)
        elif image.aspects & DEPTH:
            vk.vkCmdClearDepthStencilImage(
                buffer, created, TARGET_LAYOUT, vk.VkClearDepthStencilValue(0.5, 0), 1, [whole]
            )
        else:
            clear = _clear_value(vk, image)
            vk.vkCmdClearColorImage(buffer, created, TARGET_LAYOUT, clear, 1, [whole])
        _transition(vk, buffer, created, image, TARGET_LAYOUT, layout)
        submitter.end()
    finally:
        submitter.close()
        staging.close()


def _transition(vk: Any, buffer: Any, created: Any, image: Image, before: int, after: int) -> None:
    whole = vk.VkImageSubresourceRange(
        aspectMask=image.aspects, levelCount=image.levels, layerCount=image.layers
    )
    barrier = vk.VkImageMemoryBarrier(
        srcAccessMask=0x1000 if before else 0, dstAccessMask=0x18000, oldLayout=before,
        newLayout=after,
        srcQueueFamilyIndex=0xFFFFFFFF, dstQueueFamilyIndex=0xFFFFFFFF, image=created,
        subresourceRange=whole,
    )  # fmt: skip
    vk.vkCmdPipelineBarrier(buffer, COMMANDS, COMMANDS, 0, 0, None, 0, None, 1, [barrier])


def _clear_value(vk: Any, image: Image) -> Any:
    if image.numeric in ("SINT", "UINT"):
        return vk.VkClearColorValue(**{"uint32" if image.numeric == "UINT" else "int32": [1] * 4})
    return vk.VkClearColorValue(float32=[0.5] * 4)


def _region(vk: Any, image: Image, level: int, layer: int) -> Any:
    return vk.VkBufferImageCopy(
        bufferRowLength=image.width,
        bufferImageHeight=image.height,
        imageSubresource=vk.VkImageSubresourceLayers(
            aspectMask=image.aspects, mipLevel=level, baseArrayLayer=layer, layerCount=1
        ),
        imageExtent=vk.VkExtent3D(
            max(image.width >> level, 1),
            max(image.height >> level, 1),
            max(image.depth >> level, 1),
        ),
    )
