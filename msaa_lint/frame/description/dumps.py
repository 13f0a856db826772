"""How tools dump Vulkan's structures, where that differs from the description format.

They keep C's names (`pAttachments`, `attachmentCount`, `pNext`), write "NULL", "VK_TRUE" and
numbers as strings, and have members that descriptions do not have.
"""

from __future__ import annotations

import re

from msaa_lint.core.text.node import Node

from .models import AttachmentDescription, RenderPass, ResolveImage, Subpass, SubpassDependency
from .record import Record

PNEXT = {
    "SUBPASS_DESCRIPTION_DEPTH_STENCIL_RESOLVE": "depthStencilResolve",
    "MULTISAMPLED_RENDER_TO_SINGLE_SAMPLED_INFO": "multisampledRenderToSingleSampled",
    "PIPELINE_RENDERING_CREATE_INFO": "rendering",
    "RENDERING_FRAGMENT_DENSITY_MAP_ATTACHMENT_INFO": "fragmentDensityMapAttachment",
    "RENDERING_FRAGMENT_SHADING_RATE_ATTACHMENT_INFO": "fragmentShadingRateAttachment",
}
"""Structures of a pNext chain, by sType without its prefix and vendor suffix, and the member that a
description has for each.
"""

WITHIN: dict[str, type[Record]] = {
    "ATTACHMENT_DESCRIPTION_STENCIL_LAYOUT": AttachmentDescription,
    "MEMORY_BARRIER_2": SubpassDependency,
    "RESOLVE_IMAGE_MODE_INFO": ResolveImage,
    "RENDER_PASS_FRAGMENT_DENSITY_MAP_CREATE_INFO": RenderPass,
    "FRAGMENT_SHADING_RATE_ATTACHMENT_INFO": Subpass,
}
"""Structures of a pNext chain whose members belong, in a description, to the structure itself and
override its own.
"""

WITHOUT_USES = frozenset({
    # VkRenderPassCreateInfo, VkRenderPassCreateInfo2, VkSubpassDescription2
    "RENDER_PASS_MULTIVIEW_CREATE_INFO", "RENDER_PASS_INPUT_ATTACHMENT_ASPECT_CREATE_INFO",
    "RENDER_PASS_CREATION_CONTROL",
    "RENDER_PASS_CREATION_FEEDBACK_CREATE_INFO", "RENDER_PASS_SUBPASS_FEEDBACK_CREATE_INFO",
    "TILE_MEMORY_SIZE_INFO_QCOM",
    # VkRenderPassBeginInfo, VkRenderingInfo
    "DEVICE_GROUP_RENDER_PASS_BEGIN_INFO", "RENDER_PASS_SAMPLE_LOCATIONS_BEGIN_INFO",
    "RENDER_PASS_TRANSFORM_BEGIN_INFO_QCOM",
    "RENDER_PASS_STRIPE_BEGIN_INFO_ARM",
    "RENDER_PASS_PERFORMANCE_COUNTERS_BY_REGION_BEGIN_INFO_ARM",
    "MULTIVIEW_PER_VIEW_ATTRIBUTES_INFO_NVX",
    # VkImageCreateInfo
    "IMAGE_FORMAT_LIST_CREATE_INFO", "DEDICATED_ALLOCATION_IMAGE_CREATE_INFO_NV",
    "IMAGE_DRM_FORMAT_MODIFIER_LIST_CREATE_INFO",
    "IMAGE_DRM_FORMAT_MODIFIER_EXPLICIT_CREATE_INFO", "VIDEO_PROFILE_LIST_INFO",
    "OPAQUE_CAPTURE_DESCRIPTOR_DATA_CREATE_INFO",
    "IMAGE_COMPRESSION_CONTROL", "IMAGE_ALIGNMENT_CONTROL_CREATE_INFO_MESA",
    # Captures read them as `mayBeRead`.
    "EXTERNAL_MEMORY_IMAGE_CREATE_INFO", "EXTERNAL_MEMORY_IMAGE_CREATE_INFO_NV",
    "NATIVE_BUFFER_ANDROID",
})  # fmt: skip
"""Structures of a pNext chain that are not read, and that neither name an attachment or image nor
change how one is used.
"""

DECISIVE = (
    "VkAccessFlagBits2",
    "VkPipelineStageFlagBits2",
    "VkColorComponentFlagBits",
    "VkImageUsageFlagBits",
    "VkMemoryPropertyFlagBits",
)
"""Flags that are unknown as a whole if one of them is: rules ask for any of them. An unknown flag
of other types is ignored.
"""

OTHER_NAMES = {"pDepthStencilResolveAttachment": "attachment"}
"""Members that C names otherwise than descriptions do, beside the prefix `p`."""

_NULLS = ("NULL", "VK_NULL_HANDLE")
_BOOLEANS = {
    "VK_TRUE": True,
    "1": True,
    "true": True,
    "VK_FALSE": False,
    "0": False,
    "false": False,
}
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
    """The member that a name in C states; None for counts, sType and members that descriptions do
    not have.
    """
    name = OTHER_NAMES.get(key)
    if name is None:
        name = (
            key[1].lower() + key[2:] if len(key) > 1 and key[0] == "p" and key[1].isupper() else key
        )
    return name if name in kind.SHAPE else None


def is_unread(structure: str, kind: type[Record]) -> bool:
    """Whether a structure of a pNext chain, by sType as `structure_type` returns it, may use what a
    record describes in a way not read.
    """
    is_read = (
        structure in WITHOUT_USES
        or WITHIN.get(structure) is kind
        or PNEXT.get(structure) in kind.SHAPE
    )
    return "pNext" in kind.SHAPE and not is_read


def structure_type(node: Node) -> str:
    """The sType of a structure in a pNext chain, without its prefix and vendor suffix; empty if it
    has none.
    """
    kind = node.value.get("sType")
    return (
        kind.text.removeprefix("VK_STRUCTURE_TYPE_").removesuffix("_KHR").removesuffix("_EXT")
        if kind is not None
        else ""
    )
