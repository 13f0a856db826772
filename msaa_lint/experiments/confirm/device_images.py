"""Images with their memory on a device."""

from __future__ import annotations

from typing import Any

from .opening import DeviceObjects
from .parts import Image

DEVICE_LOCAL, HOST_VISIBLE, COHERENT, CACHED, LAZY = 0x1, 0x2, 0x4, 0x8, 0x10
"""VkMemoryPropertyFlagBits."""


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
