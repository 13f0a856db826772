"""The work of shaders/shaded.frag: how many operations and texture fetches an invocation does, and the texture that it fetches from."""

from __future__ import annotations

import random
import struct
from typing import Any

from .layouts import COLOR_OUTPUT, SHADERS, TRANSFER
from .opening import DeviceObjects, OpenDevice
from .parts import COLOR, READ_LAYOUT, SAMPLED, TARGET_LAYOUT, TRANSFER_TARGET, UNDEFINED
from .submit import Submitter
from .timed import Work

TEXEL = 4
"""Bytes of a texel, R8G8B8A8_UNORM."""

FORMAT = 37

MIN_SIDE = 16

SOURCE_BUFFER = 0x1
"""VK_BUFFER_USAGE_TRANSFER_SRC_BIT."""


def side(footprint: int) -> int:
    """The side of the largest square texture, a power of two, that has at most `footprint` bytes."""
    texels = MIN_SIDE
    while (2 * texels) ** 2 * TEXEL <= footprint:
        texels *= 2
    return texels


class Workload(DeviceObjects):
    """The textures of a device to fetch from, by their side, and how to bind them."""

    def __init__(self, opened: OpenDevice) -> None:
        super().__init__(opened)
        self._sets: dict[int, Any] = {}

    def prepare(self, work: Work) -> None:
        """Creates what some work needs. It submits, so nothing else may be recorded meanwhile."""
        texels = side(work.footprint)
        if texels not in self._sets:
            self._sets[texels] = self._descriptor(texels)

    def bind(self, buffer: Any, work: Work) -> None:
        """Records the bindings of shaded.frag."""
        vk, layout = self.vk, self.opened.layout("shaded")[0]
        texels = side(work.footprint)
        vk.vkCmdBindDescriptorSets(buffer, 0, layout, 0, 1, [self._sets[texels]], 0, None)
        pushed = struct.pack("=iif", work.operations, work.fetches, 1 / texels)
        # The caller keeps the bytes alive until the call returns.
        vk.vkCmdPushConstants(buffer, layout, 16, 16, len(pushed), vk.ffi.from_buffer("char[]", pushed))

    def _descriptor(self, texels: int) -> Any:
        vk, handle = self.vk, self.opened.handle
        pool_size = vk.VkDescriptorPoolSize(type=1, descriptorCount=1)
        pool = vk.vkCreateDescriptorPool(handle, vk.VkDescriptorPoolCreateInfo(maxSets=1, pPoolSizes=[pool_size]), None)
        self.own(vk.vkDestroyDescriptorPool, pool)
        layouts = [self.opened.layout("shaded")[1]]
        descriptor_set = vk.vkAllocateDescriptorSets(handle, vk.VkDescriptorSetAllocateInfo(descriptorPool=pool, pSetLayouts=layouts))[0]
        sampler = self.own(
            vk.vkDestroySampler, vk.vkCreateSampler(handle, vk.VkSamplerCreateInfo(magFilter=1, minFilter=1, maxLod=0.0), None)
        )
        image = vk.VkDescriptorImageInfo(sampler=sampler, imageView=self._texture(texels), imageLayout=READ_LAYOUT)
        write = vk.VkWriteDescriptorSet(dstSet=descriptor_set, dstBinding=0, descriptorCount=1, descriptorType=1, pImageInfo=[image])
        vk.vkUpdateDescriptorSets(handle, 1, [write], 0, None)
        return descriptor_set

    def _texture(self, texels: int) -> Any:
        """A view of a texture of random texels, which no hardware compresses."""
        vk, handle = self.vk, self.opened.handle
        create = vk.VkImageCreateInfo(
            imageType=1, format=FORMAT, extent=vk.VkExtent3D(texels, texels, 1), mipLevels=1, arrayLayers=1, samples=1,
            usage=SAMPLED | TRANSFER_TARGET,
        )  # fmt: skip
        image = vk.vkCreateImage(handle, create, None)
        needs = vk.vkGetImageMemoryRequirements(handle, image)
        kind = self.opened.memory_type(needs.memoryTypeBits, 0x1)
        memory = self.own(
            vk.vkFreeMemory, vk.vkAllocateMemory(handle, vk.VkMemoryAllocateInfo(allocationSize=needs.size, memoryTypeIndex=kind), None)
        )
        self.own(vk.vkDestroyImage, image)
        vk.vkBindImageMemory(handle, image, memory, 0)
        self._fill(image, texels)
        whole = vk.VkImageSubresourceRange(aspectMask=COLOR, levelCount=1, layerCount=1)
        view = vk.VkImageViewCreateInfo(image=image, viewType=1, format=FORMAT, subresourceRange=whole)
        return self.own(vk.vkDestroyImageView, vk.vkCreateImageView(handle, view, None))

    def _fill(self, image: Any, texels: int) -> None:
        vk = self.vk
        data = random.Random(texels).randbytes(texels * texels * TEXEL)
        source, memory = self.opened.buffer(data, SOURCE_BUFFER)
        submitter = Submitter(self.opened)
        buffer = submitter.begin()
        self._barrier(buffer, image, (UNDEFINED, 0, 0x1), (TARGET_LAYOUT, 0x1000, TRANSFER))
        region = vk.VkBufferImageCopy(
            imageSubresource=vk.VkImageSubresourceLayers(aspectMask=COLOR, layerCount=1), imageExtent=vk.VkExtent3D(texels, texels, 1)
        )
        vk.vkCmdCopyBufferToImage(buffer, source, image, TARGET_LAYOUT, 1, [region])
        self._barrier(buffer, image, (TARGET_LAYOUT, 0x1000, TRANSFER), (READ_LAYOUT, 0x20, SHADERS | COLOR_OUTPUT))
        submitter.end()
        submitter.close()
        vk.vkDestroyBuffer(self.opened.handle, source, None)
        vk.vkFreeMemory(self.opened.handle, memory, None)

    def _barrier(self, buffer: Any, image: Any, before: tuple[int, int, int], after: tuple[int, int, int]) -> None:
        """A transition between two states: layout, accesses, and stages."""
        vk = self.vk
        whole = vk.VkImageSubresourceRange(aspectMask=COLOR, levelCount=1, layerCount=1)
        barrier = vk.VkImageMemoryBarrier(
            srcAccessMask=before[1], dstAccessMask=after[1], oldLayout=before[0], newLayout=after[0], srcQueueFamilyIndex=0xFFFFFFFF,
            dstQueueFamilyIndex=0xFFFFFFFF, image=image, subresourceRange=whole,
        )  # fmt: skip
        vk.vkCmdPipelineBarrier(buffer, before[2], after[2], 0, 0, None, 0, None, 1, [barrier])
