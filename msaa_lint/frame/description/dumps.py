"""How tools dump Vulkan's structures, where that differs from the description format.

They keep C's names (`pAttachments`, `attachmentCount`, `pNext`), write "NULL", "VK_TRUE" and numbers as strings, and have members that
descriptions do not have.
"""

from __future__ import annotations

import re

from msaa_lint.core.text.node import Node

from .models import AttachmentDescription, ResolveImage, SubpassDependency
from .record import Record

PNEXT = {
    "SUBPASS_DESCRIPTION_DEPTH_STENCIL_RESOLVE": "depthStencilResolve",
    "MULTISAMPLED_RENDER_TO_SINGLE_SAMPLED_INFO": "multisampledRenderToSingleSampled",
    "PIPELINE_RENDERING_CREATE_INFO": "rendering",
}
"""Structures of a pNext chain, by sType without its prefix and vendor suffix, and the member that a description has for each."""

WITHIN: dict[str, type[Record]] = {
    "ATTACHMENT_DESCRIPTION_STENCIL_LAYOUT": AttachmentDescription,
    "MEMORY_BARRIER_2": SubpassDependency,
    "RESOLVE_IMAGE_MODE_INFO": ResolveImage,
}
"""Structures of a pNext chain whose members belong, in a description, to the structure itself and override its own."""

DECISIVE = ("VkAccessFlagBits2", "VkPipelineStageFlagBits2", "VkColorComponentFlagBits", "VkImageUsageFlagBits", "VkMemoryPropertyFlagBits")
"""Flags that are unknown as a whole if one of them is: rules ask for any of them. An unknown flag of other types is ignored."""

OTHER_NAMES = {"pDepthStencilResolveAttachment": "attachment"}
"""Members that C names otherwise than descriptions do, beside the prefix `p`."""

_NULLS = ("NULL", "VK_NULL_HANDLE")
_BOOLEANS = {"VK_TRUE": True, "1": True, "true": True, "VK_FALSE": False, "0": False, "false": False}
_HEXADECIMAL = re.compile(r"0[xX][0-9a-fA-F]{1,16}")


def is_null(node: Node) -> bool:
    """Whether a value is a null pointer."""
    return node.kind == "scalar" and (node.value is None or node.text in _NULLS)


def is_number(text: str) -> bool:
    """Whether a text is a decimal integer of at most 64 bits, give or take a digit."""
    return text.isascii() and text.isdigit() and len(text) <= 20


def boolean(node: Node) -> bool | None:
    """The value of a VkBool32; None if it is none."""
    return _BOOLEANS.get(node.text) if node.kind == "scalar" else None


def integer(text: str) -> int | None:
    """A decimal or hexadecimal integer; None for another text."""
    if _HEXADECIMAL.fullmatch(text):
        return int(text, 16)
    return int(text) if is_number(text) else None


def number(node: Node) -> float | None:
    """The number that a scalar states; None for another value."""
    try:
        return float(node.text) if node.kind == "scalar" else None
    except ValueError:
        return None


def member_name(kind: type[Record], key: str) -> str | None:
    """The member that a name in C states; None for counts, sType and members that descriptions do not have."""
    name = OTHER_NAMES.get(key)
    if name is None:
        name = key[1].lower() + key[2:] if len(key) > 1 and key[0] == "p" and key[1].isupper() else key
    return name if name in kind.SHAPE else None


def structure_type(node: Node) -> str:
    """The sType of a structure in a pNext chain, without its prefix and vendor suffix; empty if it has none."""
    kind = node.value.get("sType")
    return kind.text.removeprefix("VK_STRUCTURE_TYPE_").removesuffix("_KHR").removesuffix("_EXT") if kind is not None else ""
