"""Tracks clears, copies, resolves and barriers in command buffers."""

from __future__ import annotations

from collections.abc import Hashable
from typing import Any

from msaa_lint.frame.description.models import (
    PipelineBarrier,
    Rect,
    ResolveImage,
    SubpassDependency,
)

from . import values
from .call import Call
from .command_buffers import kind_of
from .command_tracker import CommandTracker, area_of
from .objects import Image, freeze
from .structures import to_tree

MAX_MASKS = 512
"""Maximum number of cached combinations of stages and accesses."""

_MASKS = ("srcStageMask", "dstStageMask", "srcAccessMask", "dstAccessMask")


class Transfers(CommandTracker):
    """Tracks the transfers and barriers of a capture."""

    def __init__(self) -> None:
        super().__init__()
        self._masks_cache: dict[Hashable, Hashable] = {}

    def on_CmdClearAttachments(self, call: Call) -> None:
        attachments: list[dict[str, Any]] = []
        for item in values.items(call.args.get("pAttachments"))[:64]:
            clear = values.record(item)
            aspects = values.flags("VkImageAspectFlagBits", clear.get("aspectMask"))
            attachment: dict[str, Any] = {"aspect": aspects[0] if aspects is not None else []}
            number = values.count(clear.get("colorAttachment"))
            if "COLOR" in attachment["aspect"] and number is not None:
                attachment["colorAttachment"] = number
            attachments.append(attachment)
        rects = []
        for item in values.items(call.args.get("pRects"))[:64]:
            area = area_of(values.record(values.record(item).get("rect")))
            if area is not None:
                rects.append(
                    to_tree(Rect, dict(zip(("x", "y", "width", "height"), area, strict=True)))
                )
        key = freeze({"attachments": attachments, "rects": rects})
        self.buffer(call).record_once(self.commands.command("clearAttachments", key, call))

    def on_CmdClearColorImage(self, call: Call) -> None:
        image = self.images.get(values.handle(call.args.get("image")))
        if image is not None and image.attachable:
            self.buffer(call).record(self.commands.command(kind_of(call), (image,), call))

    on_CmdClearDepthStencilImage = on_CmdClearColorImage

    def on_CmdResolveImage(self, call: Call) -> None:
        info, source, target = self._transfer(call)
        if source is None or target is None:
            return
        buffer = self.buffer(call)
        if _covers_target(values.items(info.get("pRegions")), target):
            modes = tuple(sorted(to_tree(ResolveImage, {"pNext": info.get("pNext")}).items()))
            buffer.record(self.commands.command("resolveImage", (source, target, *modes), call))
        else:
            # Resolving a part does not overwrite the whole image.
            buffer.record(self.commands.command("readImage", (source, "RESOLVE"), call))
            buffer.record(self.commands.command("writeImage", (target, "RESOLVE"), call))

    on_CmdResolveImage2 = on_CmdResolveImage

    def on_CmdCopyImage(self, call: Call) -> None:
        _, source, target = self._transfer(call)
        kind = kind_of(call)
        images = (
            (source,)
            if kind == "copyImageToBuffer"
            else (target,)
            if kind == "copyBufferToImage"
            else (source, target)
        )
        if None not in images and any(image is not None and image.attachable for image in images):
            self.buffer(call).record(self.commands.command(kind, images, call))

    on_CmdCopyImage2 = on_CmdBlitImage = on_CmdBlitImage2 = on_CmdCopyImage
    on_CmdCopyImageToBuffer = on_CmdCopyImageToBuffer2 = on_CmdCopyBufferToImage = (
        on_CmdCopyBufferToImage2
    ) = on_CmdCopyImage

    def _transfer(self, call: Call) -> tuple[dict[str, Any], Image | None, Image | None]:
        """The parameters of a transfer, which some calls have in a structure, and its source and
        target images.
        """
        kind = kind_of(call)
        info = values.record(call.args.get(f"p{kind[:1].upper()}{kind[1:]}Info")) or call.args
        return (
            info,
            self.images.get(values.handle(info.get("srcImage"))),
            self.images.get(values.handle(info.get("dstImage"))),
        )

    # Barriers.

    def on_CmdPipelineBarrier(self, call: Call) -> None:
        args = call.args
        stages = {
            "srcStageMask": args.get("srcStageMask"),
            "dstStageMask": args.get("dstStageMask"),
        }
        self._barriers(call, args, stages)

    on_CmdWaitEvents = on_CmdPipelineBarrier

    def on_CmdPipelineBarrier2(self, call: Call) -> None:
        for info in (
            call.args.get("pDependencyInfo"),
            *values.items(call.args.get("pDependencyInfos"))[:64],
        ):
            self._barriers(call, values.record(info), {})

    on_CmdWaitEvents2 = on_CmdPipelineBarrier2

    def _barriers(self, call: Call, info: dict[str, Any], stages: dict[str, Any]) -> None:
        buffer = self.buffer(call)
        for name in ("pMemoryBarriers", "pImageMemoryBarriers"):
            for item in values.items(info.get(name))[:4096]:
                barrier = values.record(item)
                image = self.images.get(values.handle(barrier.get("image")))
                if name == "pImageMemoryBarriers" and (image is None or not image.attachable):
                    continue
                layouts = tuple(
                    values.enum("VkImageLayout", barrier.get(each))
                    for each in ("oldLayout", "newLayout")
                )
                is_whole = image is not None and _is_whole(
                    image, values.record(barrier.get("subresourceRange"))
                )
                key = (self._masks({**barrier, **stages}), image, layouts, is_whole)
                buffer.record(self.commands.command("pipelineBarrier", key, call))

    def _masks(self, barrier: dict[str, Any]) -> Hashable:
        """The stages and accesses of a barrier, frozen. A program has few different ones."""
        given = tuple(barrier.get(member) for member in _MASKS)
        key = given if not barrier.get("pNext") and all(map(_is_small, given)) else None
        masks = self._masks_cache.get(key)
        if masks is None:
            # The mask members have the same names in a subpass dependency.
            tree = to_tree(SubpassDependency, barrier)
            masks = freeze(
                {member: tree[member] for member in PipelineBarrier.SHAPE if member in tree}
            )
            if key is not None and len(self._masks_cache) < MAX_MASKS:
                self._masks_cache[key] = masks
        return masks


def _is_small(value: object) -> bool:
    """Whether a value may be kept as a key."""
    return (
        value is None
        or type(value) is int
        or (type(value) is str and len(value) <= values.MAX_TEXT)
    )


_ASPECTS = {"color": 1, "depth": 2, "stencil": 4}
"""VkImageAspectFlagBits."""

_REMAINING = 0xFFFFFFFF


def _is_whole(image: Image, range: dict[str, Any]) -> bool:
    """Whether a VkImageSubresourceRange is certainly all of an image."""
    aspects = values.bits("VkImageAspectFlagBits", range.get("aspectMask")) or 0
    if not image.aspects or any(not aspects & _ASPECTS[aspect] for aspect in image.aspects):
        return False
    for base, count, total in (
        ("baseMipLevel", "levelCount", "mipLevels"),
        ("baseArrayLayer", "layerCount", "arrayLayers"),
    ):
        number, size = values.count(range.get(count)), image.tree.get(total)
        if (
            values.count(range.get(base)) != 0
            or number is None
            or (number != _REMAINING and (size is None or number < size))
        ):
            return False
    return True


def _covers_target(regions: list[Any], target: Image) -> bool:
    """Whether the regions of a resolve cover its target; True if the sizes are unknown."""
    extent = target.tree.get("extent", {})
    for item in regions[:1024]:
        region = values.record(item)
        offset, size = values.record(region.get("dstOffset")), values.record(region.get("extent"))
        origin = [values.integer(offset.get(axis)) or 0 for axis in ("x", "y")]
        sides = [(values.integer(size.get(side)), extent.get(side)) for side in ("width", "height")]
        if origin == [0, 0] and all(
            size_ is None or full is None or size_ >= full for size_, full in sides
        ):
            return True
    return not regions
