"""The transfers and clears of a plan, and which transfers cannot be recorded because descriptions do not state their regions."""

from __future__ import annotations

from .parts import COLOR, Image, PassCommand
from .plan_integers import mask

TRANSFERS = {
    "resolveImage": "resolve", "copyImage": "copy", "blitImage": "blit", "clearColorImage": "clear", "clearDepthStencilImage": "clear",
    "copyImageToBuffer": "copyOut", "copyBufferToImage": "copyIn", "present": "present", "pipelineBarrier": "barrier",
}  # fmt: skip
"""The kinds of steps by command."""


WHOLE = 1 << 30
"""A width or height beyond that of any image."""


def clears(body: object, subpass: int) -> list[PassCommand]:
    """The clears of vkCmdClearAttachments in a subpass."""
    rects = tuple((rect.x or 0, rect.y or 0, rect.width or WHOLE, rect.height or WHOLE) for rect in getattr(body, "rects", ()))
    return [
        PassCommand("clear", subpass, value=c.colorAttachment or 0, aspects=mask("VkImageAspectFlagBits", c.aspect), rects=rects)
        for c in getattr(body, "attachments", ())
    ]


def ignored_transfer(kind: str, source: Image, target: Image) -> str:
    """What keeps a transfer between the first levels of two images from being recorded, in words; empty if nothing does. Descriptions do
    not state the levels, layers, and regions of a transfer."""
    if source is target:
        return f"from {source.name} to itself, between levels or layers that are not stated,"
    if not source.aspects & target.aspects:
        return "between color and depth"
    depth_differs = source.format != target.format and not source.aspects & COLOR
    if kind == "copy" and (source.samples != target.samples or source.bytes != target.bytes or depth_differs):
        return f"from {source.name} to {target.name}, whose formats or sample counts are not compatible,"
    kinds = {numeric if numeric in ("UINT", "SINT") else "" for numeric in (source.numeric, target.numeric)}
    if kind == "blit" and (max(source.samples, target.samples) > 1 or len(kinds) > 1 or depth_differs):
        return f"from {source.name} to {target.name}, whose formats or sample counts are not compatible,"
    return ""
