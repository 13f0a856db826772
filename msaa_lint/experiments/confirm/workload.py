"""The work of shaders/shaded.frag: how many operations and texture fetches an invocation does, and
the texture that it fetches from.
"""

from __future__ import annotations

import random
import struct
from typing import Any

from .device_images import create_image, fill
from .opening import DeviceObjects, OpenDevice
from .parts import COLOR, READ_LAYOUT, SAMPLED, TRANSFER_TARGET, Descriptor, Image
from .shader_resources import SAMPLER, resources
from .timed import Work

TEXEL = 4
"""Bytes of a texel, R8G8B8A8_UNORM."""

FORMAT = 37

MIN_SIDE = 16


def side(footprint: int) -> int:
    """The side of the largest square texture, a power of two, that has at most `footprint`
    bytes.
    """
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
        vk.vkCmdPushConstants(
            buffer, layout, 16, 16, len(pushed), vk.ffi.from_buffer("char[]", pushed)
        )

    def _descriptor(self, texels: int) -> Any:
        vk, handle = self.vk, self.opened.handle
        pool_size = vk.VkDescriptorPoolSize(type=1, descriptorCount=1)
        pool = vk.vkCreateDescriptorPool(
            handle, vk.VkDescriptorPoolCreateInfo(maxSets=1, pPoolSizes=[pool_size]), None
        )
        self.own(vk.vkDestroyDescriptorPool, pool)
        layouts = [self.opened.layout("shaded")[1]]
        descriptor_set = vk.vkAllocateDescriptorSets(
            handle, vk.VkDescriptorSetAllocateInfo(descriptorPool=pool, pSetLayouts=layouts)
        )[0]
        sampler = resources(self.opened).sampler(Descriptor(0, 0, SAMPLER))
        image = vk.VkDescriptorImageInfo(
            sampler=sampler, imageView=self._texture(texels), imageLayout=READ_LAYOUT
        )
        write = vk.VkWriteDescriptorSet(
            dstSet=descriptor_set,
            dstBinding=0,
            descriptorCount=1,
            descriptorType=1,
            pImageInfo=[image],
        )
        vk.vkUpdateDescriptorSets(handle, 1, [write], 0, None)
        return descriptor_set

    def _texture(self, texels: int) -> Any:
        """A view of a texture of random texels, which no hardware compresses."""
        vk = self.vk
        image = Image(
            "",
            FORMAT,
            1,
            SAMPLED | TRANSFER_TARGET,
            texels,
            texels,
            1,
            1,
            1,
            1,
            0,
            0,
            False,
            COLOR,
            "UNORM",
            TEXEL,
        )
        created = create_image(self, image)
        fill(
            self.opened,
            created,
            image,
            random.Random(texels).randbytes(texels * texels * TEXEL),
            READ_LAYOUT,
        )
        whole = vk.VkImageSubresourceRange(aspectMask=COLOR, levelCount=1, layerCount=1)
        view = vk.VkImageViewCreateInfo(
            image=created, viewType=1, format=FORMAT, subresourceRange=whole
        )
        return self.own(vk.vkDestroyImageView, vk.vkCreateImageView(self.opened.handle, view, None))
