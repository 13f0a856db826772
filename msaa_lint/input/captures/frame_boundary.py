"""How a frame first uses an image and what it leaves in it, to follow contents from one frame to
the next.

A description covers a single frame, which is assumed to repeat. A capture shows which frame
actually follows.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

from .command_buffers import RecordedCommand, RenderPassBegin
from .objects import Image

READ = "read"
FETCH = "fetch"
"""A shader reads."""
OVERWRITE = "overwrite"
STORE = "store"
DISCARD = "discard"


class AspectUse(NamedTuple):
    """The use of one aspect of an image in a frame.

    `first` is its first use: `read`, `overwrite`, or None; `is_fetched` says whether that is a
    shader's read. `last` is its state at the end: `unread` (stored and not read since), `read`,
    `discarded`, or None if the frame does not write it.
    """

    first: str | None
    last: str | None
    is_fetched: bool = False


def aspect_uses(commands: list[RecordedCommand]) -> dict[Image, dict[str, AspectUse]]:
    """The use of each aspect of each image by the commands of a frame."""
    uses: dict[Image, dict[str, AspectUse]] = {}
    for image, aspect, use in _uses(commands):
        for used_aspect in image.aspects if aspect is None else (aspect,):
            first, last, is_fetched = uses.setdefault(image, {}).get(
                used_aspect, AspectUse(None, None)
            )
            if first is None and use in (READ, FETCH, OVERWRITE):
                first, is_fetched = OVERWRITE if use == OVERWRITE else READ, use == FETCH
            if use in (READ, FETCH):
                last = "read" if last is not None else None
            elif use == STORE:
                last = "unread"
            elif use == DISCARD:
                last = "discarded"
            uses[image][used_aspect] = AspectUse(first, last, is_fetched)
    return uses


_SOURCES = ("present", "copyImageToBuffer")


def _uses(commands: list[RecordedCommand]) -> Iterator[tuple[Image, str | None, str]]:
    """The uses of images in command order: image, aspect (None for all) and use. The stores of a
    pass come at its beginning.
    """
    for command in commands:
        key: Any = command.key
        if isinstance(key, RenderPassBegin):
            yield from _render_pass(key)
        elif command.kind == "beginRendering":
            yield from _rendering(key)
        elif command.kind == "readImage":
            yield key[0], None, READ if key[1] in ("RESOLVE", "TRANSFER") else FETCH
        elif command.kind in _SOURCES:
            yield _image(key), None, READ
        elif command.kind in ("resolveImage", "copyImage", "blitImage"):
            yield key[0], None, READ
            if command.kind == "resolveImage":
                yield key[1], None, OVERWRITE
            yield key[1], None, STORE
        elif command.kind in (
            "clearColorImage",
            "clearDepthStencilImage",
            "copyBufferToImage",
            "writeImage",
        ):
            yield _image(key), None, STORE


def _image(key: Any) -> Image:
    return key if isinstance(key, Image) else key[0]


def _render_pass(begin: RenderPassBegin) -> Iterator[tuple[Image, str | None, str]]:
    attachments = begin.render_pass.tree.get("attachments", [])
    pairs = [
        (tree, image)
        for tree, image in zip(attachments, begin.images, strict=False)
        if image is not None
    ]
    for tree, image in pairs:
        covered = _covers(image, begin)
        for aspect in image.aspects:
            yield from _load(
                image,
                aspect,
                tree.get("stencilLoadOp" if aspect == "stencil" else "loadOp"),
                covered,
            )
    for tree, image in pairs:
        for aspect in image.aspects:
            store = tree.get("stencilStoreOp" if aspect == "stencil" else "storeOp")
            yield image, aspect, STORE if store in ("STORE", None) else DISCARD


def _load(
    image: Image, aspect: str, load: object, covered: bool
) -> Iterator[tuple[Image, str | None, str]]:
    if load in ("LOAD", None):
        yield image, aspect, READ
    elif covered:
        yield image, aspect, OVERWRITE


def _rendering(key: Any) -> Iterator[tuple[Image, str | None, str]]:
    tree = dict(key)
    flags = tree.get("flags", ())
    members = [("color", each) for each in tree.get("colorAttachments", ())]
    members += [("depth", tree.get("depthAttachment")), ("stencil", tree.get("stencilAttachment"))]
    stores: list[tuple[Image, str | None, str]] = []
    for aspect, info in members:
        attachment = dict(info or ())
        image = attachment.get("image")
        if image is None:
            continue
        yield from _load(
            image,
            aspect,
            "LOAD" if "RESUMING" in flags else attachment.get("loadOp"),
            image.is_single_level,
        )
        stored = attachment.get("storeOp") in ("STORE", None) or "SUSPENDING" in flags
        stores.append((image, aspect, STORE if stored else DISCARD))
        target = attachment.get("resolveImage")
        if target is not None and attachment.get("resolveMode") not in (None, "NONE"):
            if target.is_single_level:
                yield target, aspect, OVERWRITE
            stores.append((target, aspect, STORE))
    yield from stores


def _depth(image: Image) -> int:
    """The depth of an image in texels; 1 unless it is 3D."""
    count: int = image.tree.get("extent", {}).get("depth", 1)
    return count


def _covers(image: Image, begin: RenderPassBegin) -> bool:
    framebuffer = begin.framebuffer
    if framebuffer is None or image.tree.get("mipLevels", 1) > 1 or _depth(image) > 1:
        return False
    if image.tree.get("arrayLayers", 1) > framebuffer.tree.get("layers", 1):
        return False
    extent = image.tree.get("extent", {})
    for number, side in ((2, "width"), (3, "height")):
        full = extent.get(side)
        sizes = [framebuffer.tree.get(side), begin.area[number] if begin.area is not None else None]
        if full is not None and any(size is not None and size < full for size in sizes):
            return False
    return begin.area is None or begin.area[:2] == (0, 0)
