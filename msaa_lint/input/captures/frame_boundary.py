"""What a frame does with an image first, and what it leaves there: enough to tell what one frame has of another.

Within a frame the facts of its description say who reads what. From frame to frame a description only knows that the frame comes again; a
capture knows what truly came next.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

from .command_buffers import Begin, Recorded
from .objects import Image

READ = "read"
OVERWRITE = "overwrite"
STORE = "store"
DISCARD = "discard"


class Ends(NamedTuple):
    """Of one aspect of an image in a frame: `first` is how it is first used, `read` or `overwrite`, None where neither; `last` what is left
    of it: `unread` (stored, and not read since), `read`, or `discarded`; None where the frame does not write it."""

    first: str | None
    last: str | None


def ends_of(recorded: list[Recorded]) -> dict[Image, dict[str, Ends]]:
    """What the commands of a frame do to every aspect of the images that they use."""
    found: dict[Image, dict[str, Ends]] = {}
    for image, aspect, use in _uses(recorded):
        for each in image.aspects if aspect is None else (aspect,):
            first, last = found.setdefault(image, {}).get(each, (None, None))
            if first is None and use in (READ, OVERWRITE):
                first = use
            if use == READ:
                last = "read" if last is not None else None
            elif use == STORE:
                last = "unread"
            elif use == DISCARD:
                last = "discarded"
            found[image][each] = Ends(first, last)
    return found


_SOURCES = ("readImage", "present", "copyImageToBuffer")


def _uses(recorded: list[Recorded]) -> Iterator[tuple[Image, str | None, str]]:
    """The uses of images in the order of the commands; what a pass leaves comes where it begins."""
    for each in recorded:
        key: Any = each.key
        if isinstance(key, Begin):
            yield from _render_pass(key)
        elif each.kind == "beginRendering":
            yield from _rendering(key)
        elif each.kind in _SOURCES:
            yield _image(key), None, READ
        elif each.kind in ("resolveImage", "copyImage", "blitImage"):
            yield key[0], None, READ
            if each.kind == "resolveImage":
                yield key[1], None, OVERWRITE
            yield key[1], None, STORE
        elif each.kind in ("clearColorImage", "clearDepthStencilImage", "copyBufferToImage", "writeImage"):
            yield _image(key), None, STORE


def _image(key: Any) -> Image:
    return key if isinstance(key, Image) else key[0]


def _render_pass(begin: Begin) -> Iterator[tuple[Image, str | None, str]]:
    attachments = begin.render_pass.tree.get("attachments", [])
    resolved = _resolve_targets(begin.render_pass.tree)
    pairs = [(index, tree, begin.images[index]) for index, tree in enumerate(attachments) if index < len(begin.images)]
    whole = begin.framebuffer is not None
    for index, tree, image in pairs:
        if image is None:
            continue
        covered = whole and _covers(image, begin)
        for aspect in image.aspects:
            member = "stencilLoadOp" if aspect == "stencil" else "loadOp"
            yield from _load(image, aspect, tree.get(member), covered or (index in resolved and covered))
    for _, tree, image in pairs:
        for aspect in image.aspects if image is not None else ():
            assert image is not None
            member = "stencilStoreOp" if aspect == "stencil" else "storeOp"
            yield image, aspect, STORE if tree.get(member) in ("STORE", None) else DISCARD


def _load(image: Image, aspect: str, load: object, covered: bool) -> Iterator[tuple[Image, str | None, str]]:
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
    for aspect, given in members:
        attachment = dict(given or ())
        image = attachment.get("image")
        if image is None:
            continue
        yield from _load(image, aspect, "LOAD" if "RESUMING" in flags else attachment.get("loadOp"), _plain(image))
        stored = attachment.get("storeOp") in ("STORE", None) or "SUSPENDING" in flags
        stores.append((image, aspect, STORE if stored else DISCARD))
        target = attachment.get("resolveImage")
        if target is not None and attachment.get("resolveMode") not in (None, "NONE"):
            if _plain(target):
                yield target, aspect, OVERWRITE
            stores.append((target, aspect, STORE))
    yield from stores


def _resolve_targets(tree: dict[str, Any]) -> set[int]:
    found: set[int] = set()
    for subpass in tree.get("subpasses", []):
        for reference in subpass.get("resolveAttachments", []):
            index = reference.get("attachment") if isinstance(reference, dict) else reference
            if isinstance(index, int):
                found.add(index)
    return found


def _plain(image: Image) -> bool:
    """Whether an image has one mip level and one layer, so that a pass can write all of it."""
    return all(count == 1 for count in (image.tree.get("mipLevels", 1), image.tree.get("arrayLayers", 1), _depth(image)))


def _depth(image: Image) -> int:
    """How many slices an image of three dimensions has."""
    count: int = image.tree.get("extent", {}).get("depth", 1)
    return count


def _covers(image: Image, begin: Begin) -> bool:
    framebuffer = begin.framebuffer
    if framebuffer is None or image.tree.get("mipLevels", 1) > 1 or _depth(image) > 1:
        return False
    if image.tree.get("arrayLayers", 1) > (framebuffer.layers or 1):
        return False
    extent = image.tree.get("extent", {})
    for number, side in ((2, "width"), (3, "height")):
        whole = extent.get(side)
        sizes = [getattr(framebuffer, side), begin.area[number] if begin.area is not None else None]
        if whole is not None and any(size is not None and size < whole for size in sizes):
            return False
    return begin.area is None or begin.area[:2] == (0, 0)
