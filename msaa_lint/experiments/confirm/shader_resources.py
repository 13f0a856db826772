"""Images, samplers, and buffers for the descriptors of shaders, with defined contents; they live as
long as the device.

Sampled images are a pattern of 32x32 texels, repeated in every layer and mip level, in R8G8B8A8
(integers are 0 and 1) or, for comparisons, D32_SFLOAT. Storage images and multisampled images are
0.5 or 1 everywhere.
"""

from __future__ import annotations

import re
import struct
from collections.abc import Callable
from typing import Any

from msaa_lint.frame.vulkan.formats import format_of

from .device_images import create_image, fill
from .opening import DeviceObjects, OpenDevice
from .parts import (
    COLOR,
    DEPTH,
    READ_LAYOUT,
    SAMPLED,
    STORAGE,
    TRANSFER_TARGET,
    Descriptor,
    Image,
    unpacked,
)
from .parts import GENERAL as GENERAL_LAYOUT
from .texels import format_name

(
    SAMPLER,
    COMBINED,
    SAMPLED_IMAGE,
    STORAGE_IMAGE,
    UNIFORM_TEXELS,
    STORAGE_TEXELS,
    UNIFORM_BUFFER,
    STORAGE_BUFFER,
) = range(8)
INPUT_ATTACHMENT = 10
"""VkDescriptorType."""

IMAGES = (COMBINED, SAMPLED_IMAGE, STORAGE_IMAGE)
TEXELS = (UNIFORM_TEXELS, STORAGE_TEXELS)

_BUFFER_USAGE = {
    UNIFORM_TEXELS: 0x4,
    STORAGE_TEXELS: 0x8,
    UNIFORM_BUFFER: 0x10,
    STORAGE_BUFFER: 0x20,
}
_NEAR_THE_DEVICE = 0x7
"""VkBufferUsageFlagBits; memory that is device-local, visible to the host, and coherent."""

SIZES = {
    0: (1024, 1, 1, 1), 1: (1024, 1024, 1, 1), 2: (64, 64, 64, 1), 3: (512, 512, 1, 6), 4: (1024,
    1, 1, 4), 5: (512, 512, 1, 4),
    6: (256, 256, 1, 12),
}  # fmt: skip
"""Width, height, depth, and layers of images by VkImageViewType."""

CUBE_COMPATIBLE = 0x10
_TYPES = {0: 0, 4: 0, 2: 2}
"""VkImageType by VkImageViewType; 2D for the others."""

TILE = 32
LINEAR_FILTER = 0x1000
"""VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT."""

LESS_OR_EQUAL, ALL_LEVELS, WHOLE = 3, 1000.0, 0xFFFFFFFFFFFFFFFF


class ShaderResources(DeviceObjects):
    """What descriptors refer to. Equal descriptors of one pipeline, told apart by `number`, have
    resources of their own.
    """

    def __init__(self, opened: OpenDevice) -> None:
        super().__init__(opened)
        self._known: dict[tuple[Any, ...], Any] = {}

    def _once(self, key: tuple[Any, ...], create: Callable[[], Any]) -> Any:
        if key not in self._known:
            with self.opened.session.unheard():
                self._known[key] = create()
        return self._known[key]

    def sampler(self, descriptor: Descriptor) -> Any:
        """A repeating sampler, linear where the device filters the format linearly."""
        return self._once(
            ("sampler", descriptor.compares, descriptor.nearest), lambda: self._sampler(descriptor)
        )

    def view(self, descriptor: Descriptor, number: int) -> Any:
        """The view of an image."""
        kind = descriptor.type == STORAGE_IMAGE
        key = (descriptor.view, descriptor.format, descriptor.samples, kind, number)
        return self._once(key, lambda: self._view(descriptor))

    def buffer(self, descriptor: Descriptor, number: int) -> Any:
        """A buffer."""
        key = ("buffer", descriptor.type, descriptor.size, descriptor.contents, number)
        return self._once(key, lambda: self._buffer(descriptor))

    def texels(self, descriptor: Descriptor, number: int) -> Any:
        """The view of a texel buffer."""
        create = self.vk.VkBufferViewCreateInfo
        handle = self.opened.handle
        return self._once(
            ("texels", descriptor.type, descriptor.format, number),
            lambda: self.own(
                self.vk.vkDestroyBufferView,
                self.vk.vkCreateBufferView(
                    handle,
                    create(
                        buffer=self.buffer(descriptor, number),
                        format=descriptor.format,
                        offset=0,
                        range=WHOLE,
                    ),
                    None,
                ),
            ),
        )

    def _sampler(self, descriptor: Descriptor) -> Any:
        support = self.opened.session.device["formats"].get(str(FORMAT_D32), {}).get("features", 0)
        linear = not descriptor.nearest and (
            not descriptor.compares or bool(support & LINEAR_FILTER)
        )
        create = self.vk.VkSamplerCreateInfo(
            magFilter=int(linear), minFilter=int(linear), mipmapMode=int(linear),
            maxLod=ALL_LEVELS, compareEnable=int(descriptor.compares),
            compareOp=LESS_OR_EQUAL,
        )  # fmt: skip
        return self.own(
            self.vk.vkDestroySampler, self.vk.vkCreateSampler(self.opened.handle, create, None)
        )

    def _buffer(self, descriptor: Descriptor) -> Any:
        stated = (
            unpacked(descriptor.contents)
            if descriptor.contents
            else texel(descriptor.format) * descriptor.size
        )
        data = stated[: descriptor.size].ljust(descriptor.size, b"\0")
        return self._filled(data, _BUFFER_USAGE[descriptor.type])

    def _filled(self, data: bytes, usage: int) -> Any:
        buffer, memory = self.opened.buffer(data, usage, _NEAR_THE_DEVICE)
        self.own(self.vk.vkFreeMemory, memory)
        return self.own(self.vk.vkDestroyBuffer, buffer)

    def _view(self, descriptor: Descriptor) -> Any:
        vk = self.vk
        image = _image(descriptor)
        created = create_image(self, image)
        cleared = bool(image.usage & STORAGE) or image.samples > 1
        fill(
            self.opened,
            created,
            image,
            None if cleared else pattern(image),
            GENERAL_LAYOUT if image.usage & STORAGE else READ_LAYOUT,
        )
        whole = vk.VkImageSubresourceRange(
            aspectMask=image.aspects, levelCount=image.levels, layerCount=image.layers
        )
        create = vk.VkImageViewCreateInfo(
            image=created, viewType=descriptor.view, format=image.format, subresourceRange=whole
        )
        return self.own(
            vk.vkDestroyImageView, vk.vkCreateImageView(self.opened.handle, create, None)
        )


FORMAT_D32 = 126
"""VK_FORMAT_D32_SFLOAT."""


def resources(opened: OpenDevice) -> ShaderResources:
    """The resources of a device."""
    if opened.resources is None:
        opened.resources = ShaderResources(opened)
    assert isinstance(opened.resources, ShaderResources)
    return opened.resources


def _image(descriptor: Descriptor) -> Image:
    width, height, depth, layers = SIZES[descriptor.view]
    stored = descriptor.type == STORAGE_IMAGE
    several = descriptor.samples > 1
    if several:
        width, height = width // 2, height // 2
    format = format_of(format_name(descriptor.format))
    return Image(
        "", descriptor.format, descriptor.samples,
        (STORAGE if stored else SAMPLED) | TRANSFER_TARGET, width, height, depth, layers,
        1 if stored or several else max(width, height, depth).bit_length(),
        _TYPES.get(descriptor.view, 1), 0,
        CUBE_COMPATIBLE if descriptor.view in (3, 6) else 0, False,
        DEPTH if descriptor.format == FORMAT_D32 else COLOR,
        format.numeric if format is not None else "", format.bytes if format is not None else 4,
    )  # fmt: skip


def pattern(image: Image) -> bytes:
    """The texels of the first mip level of a layer, in a format of four bytes: 32x32 texels,
    repeated.
    """
    tile = [b"".join(_pattern_texel(image, x, y) for x in range(TILE)) for y in range(TILE)]
    rows = [row * -(-image.width // TILE) for row in tile]
    rows = [row[: 4 * image.width] for row in rows]
    return b"".join(rows[y % TILE] for y in range(image.height)) * image.depth


def _pattern_texel(image: Image, x: int, y: int) -> bytes:
    if image.aspects & DEPTH:
        return struct.pack("=f", 0.25 + (x ^ y) / (2 * TILE))
    if image.numeric in ("SINT", "UINT"):
        return bytes((x & 1, y & 1, (x ^ y) & 1, 1))
    return bytes((x * 255 // (TILE - 1), y * 255 // (TILE - 1), (x ^ y) * 255 // (TILE - 1), 255))


def texel(format: int) -> bytes:
    """A texel of 0.5 or 1 in a format without packed components."""
    name = format_name(format)
    described = format_of(name)
    widths = [int(bits) for bits in re.findall(r"[RGBA](\d+)", name.partition("_")[0])]
    if described is None or any(bits not in (8, 16, 32) for bits in widths):
        return b"\x80" * (described.bytes if described is not None else 4)
    if described.numeric == "SFLOAT":
        return b"".join(struct.pack("=e" if bits == 16 else "=f", 0.5) for bits in widths)
    value = 1 if described.numeric in ("SINT", "UINT") else 0
    return b"".join((value or 1 << bits - 2).to_bytes(bits // 8, "little") for bits in widths)
