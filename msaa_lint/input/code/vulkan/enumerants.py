"""The members of structures that are enumerants or flags, which code may state as numbers."""

from __future__ import annotations

from typing import Any

from msaa_lint.core.text.span import Span
from msaa_lint.frame.vulkan.enums import VALUES
from msaa_lint.input.code.core.values import UNKNOWN, Flags

ENUMS = {
    "format": "VkFormat", "loadOp": "VkAttachmentLoadOp", "storeOp": "VkAttachmentStoreOp",
    "stencilLoadOp": "VkAttachmentLoadOp",
    "stencilStoreOp": "VkAttachmentStoreOp", "initialLayout": "VkImageLayout",
    "finalLayout": "VkImageLayout", "imageType": "VkImageType",
    "tiling": "VkImageTiling", "sharingMode": "VkSharingMode",
    "depthResolveMode": "VkResolveModeFlagBits",
    "stencilResolveMode": "VkResolveModeFlagBits", "resolveMode": "VkResolveModeFlagBits",
}  # fmt: skip

FLAGS = {
    "usage": "VkImageUsageFlagBits", "srcStageMask": "VkPipelineStageFlagBits2",
    "dstStageMask": "VkPipelineStageFlagBits2",
    "srcAccessMask": "VkAccessFlagBits2", "dstAccessMask": "VkAccessFlagBits2",
    "memory": "VkMemoryPropertyFlagBits",
    "renderingFlags": "VkRenderingFlagBits",
}  # fmt: skip


def named(member: str, value: Any, at: Span) -> Any:
    """Returns what a number above 0 stands for in a member, an enumerant or flags; any other value
    as it is.
    """
    if type(value) is not int or value <= 0:
        return value
    if member in FLAGS:
        bits = {
            name: bit
            for name, bit in VALUES[FLAGS[member]].items()
            if bit & (bit - 1) == 0 and value & bit
        }
        return Flags(tuple((name, at) for name in bits)) if sum(bits.values()) == value else UNKNOWN
    if member in ENUMS:
        return next(
            (name for name, number in VALUES[ENUMS[member]].items() if number == value), value
        )
    return value
