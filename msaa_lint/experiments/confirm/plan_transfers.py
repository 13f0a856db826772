"""The transfers and clears of a plan, and which transfers cannot be recorded because descriptions
do not state their regions.
"""

from __future__ import annotations

from collections.abc import Sequence

from .parts import COLOR, Image, PassCommand
from .plan_integers import mask

TRANSFERS = {
    "resolveImage": "resolve", "copyImage": "copy", "blitImage": "blit",
    "clearColorImage": "clear", "clearDepthStencilImage": "clear",
    "copyImageToBuffer": "copyOut", "copyBufferToImage": "copyIn", "present": "present",
    "pipelineBarrier": "barrier",
}  # fmt: skip
"""The kinds of steps by command."""


WHOLE = 1 << 30
"""A width or height beyond that of any image."""


def clears(body: object, subpass: int) -> list[PassCommand]:
    """The clears of vkCmdClearAttachments in a subpass."""
    rects = tuple(
        (rect.x or 0, rect.y or 0, rect.width or WHOLE, rect.height or WHOLE)
        for rect in getattr(body, "rects", ())
    )
    return [
        PassCommand(
            "clear",
            subpass,
            value=c.colorAttachment or 0,
            aspects=mask("VkImageAspectFlagBits", c.aspect),
            rects=rects,
        )
        for c in getattr(body, "attachments", ())
    ]


def forbidden_samples(kind: str, images: Sequence[Image]) -> str:
    """Why Vulkan forbids a command because of the sample counts of its images, in words; empty if
    it does not.
    """
    multisampled = [image.name for image in images if image.samples > 1]
    if kind == "copy" and len({image.samples for image in images}) > 1:
        return f"from {images[0].name} to {images[-1].name}, whose sample counts differ,"
    if kind in ("blit", "copyOut", "copyIn", "present") and multisampled:
        return f"of {multisampled[0]}, which is multisampled,"
    return ""


def ignored_transfer(kind: str, source: Image, target: Image) -> str:
    """What keeps a transfer between the first levels of two images from being recorded, in words;
    empty if nothing does.
    """
    if not source.aspects & target.aspects:
        return "between color and depth"
    depth_differs = source.format != target.format and not source.aspects & COLOR
    if kind == "copy" and (source.bytes != target.bytes or depth_differs):
        return f"from {source.name} to {target.name}, whose formats are not compatible,"
    kinds = {
        numeric if numeric in ("UINT", "SINT") else ""
        for numeric in (source.numeric, target.numeric)
    }
    if kind == "blit" and (len(kinds) > 1 or depth_differs):
        return f"from {source.name} to {target.name}, whose formats are not compatible,"
    return ""
