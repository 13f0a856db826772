"""`do: hand-over-depth`: depth is resolved in the pass that draws it, and its readers have the result in place of the samples."""

from __future__ import annotations

from typing import Any

from msaa_lint.frame.description.models import (
    AttachmentDescription,
    Framebuffer,
    Image,
    ReadImage,
    RenderingAttachment,
    RenderPass,
    Subpass,
)
from msaa_lint.frame.facts.facts import Subject
from msaa_lint.frame.facts.frame import Aspect, Attachment, Pass
from msaa_lint.frame.facts.image import BESIDE_TRANSIENT

from .changes import Change, FixContext, Refused
from .transient import memory_changes

_MODE = "SAMPLE_ZERO"
"""What every device offers."""


def hand_over_depth(subject: Subject, mending: FixContext) -> list[Change] | Refused:
    """A single-sampled image beside the multisampled one, a resolve to it, readers of it; the samples are not stored."""
    attachment, aspect = subject.of if isinstance(subject.of, tuple) else (None, None)
    if not isinstance(attachment, Attachment) or not isinstance(aspect, Aspect) or attachment.target is None:
        return Refused("it is not one image each time")
    source = attachment.target.image
    owners = mending.attachments.get(id(source), [])
    if source is None or attachment.format is None or len(owners) != 1:
        return Refused("its image is not described, or other passes use it")
    within, own = owners[0]
    if len(own.depth_stencil) == 0 or len(within.subpasses) == 0:
        return Refused("no subpass draws to it")
    readers = [each for each in mending.mentions.of.get(source.key, ()) if isinstance(each, ReadImage)]
    resolved = _resolved(within, own, aspect)
    if resolved is not None:
        made, name = [], resolved
    else:
        images = mending.document.description.images
        name = _free(f"{source.key}_resolved", set(images))
        put = _to(name, within, own, mending)
        if isinstance(put, Refused):
            return put
        made = [Change(mending.document.description, "images", "entry", (name, _image(source, attachment.format.name))), *put]
    made.append(Change(attachment.record, aspect.store_member, "set", "DONT_CARE"))
    for reader in readers:
        made.append(Change(reader, "image", "set", name))
        made += [Change(reader, "samples", "unset")] if reader.states("samples") else []
    return [*made, *_transient(source, own, aspect, subject)]


def _transient(source: Image, attachment: Attachment, aspect: Aspect, subject: Subject) -> list[Change]:
    """What the image of the samples then may be, where its readers alone kept it from that."""
    others = [each for each in attachment.aspects if each.name != aspect.name]
    if source.usage is None or set(source.usage) - BESIDE_TRANSIENT != {"SAMPLED"} or aspect.load != "CLEAR":
        return []
    if any(each.load == "LOAD" or each.store != "DONT_CARE" for each in others):
        return []
    usage = [Change(source, "usage", "remove", "SAMPLED"), Change(source, "usage", "add", "TRANSIENT_ATTACHMENT")]
    return [*usage, *memory_changes(source, subject.facts.values.get("device.lazy_memory"))]


def _resolved(within: Pass, attachment: Attachment, aspect: Aspect) -> str | None:
    """The image that the pass resolves it to already."""
    found = [resolve for subpass in within.subpasses for resolve in subpass.resolves if resolve.source is attachment]
    images = [resolve.target_image for resolve in found if resolve.aspect == aspect.name and resolve.mode not in (None, "NONE")]
    return next((image.name for image in images if image is not None and image.image is not None), None)


def _free(name: str, taken: set[str]) -> str:
    return next(each for each in (name, *(f"{name}_{n}" for n in range(2, 3 + len(taken)))) if each not in taken)


def _image(source: Image, format_name: str) -> dict[str, Any]:
    data: dict[str, Any] = {"format": format_name, "samples": 1, "usage": ["DEPTH_STENCIL_ATTACHMENT", "SAMPLED"]}
    if source.extent is not None:
        sides = {side: getattr(source.extent, side) for side in ("width", "height", "depth")}
        data["extent"] = {side: length for side, length in sides.items() if length is not None}
    return data


def _to(name: str, within: Pass, attachment: Attachment, mending: FixContext) -> list[Change] | Refused:
    """A resolve to an image that the pass does not have yet."""
    record = within.record
    if not isinstance(record, RenderPass):
        info = attachment.record
        if not isinstance(info, RenderingAttachment) or info.resolveImage is not None:
            return Refused("the pass resolves it otherwise")
        return [Change(info, "resolveMode", "set", _MODE), Change(info, "resolveImage", "set", name)]
    subpass = within.subpasses[max(attachment.depth_stencil)].record
    buffers: list[Framebuffer] = mending.framebuffers.get(within.name, [])
    if not isinstance(subpass, Subpass) or subpass.depthStencilResolve is not None or len(buffers) > 1:
        return Refused("the pass resolves it otherwise, or has several framebuffers")
    listed = record.spelled["attachments"][1].kind == "sequence"
    key = _free(name, {each.key for each in record.attachments})
    own = attachment.record
    data: dict[str, Any] = {"image": name, "loadOp": "DONT_CARE", "storeOp": "STORE"}
    if isinstance(own, AttachmentDescription) and own.states("initialLayout"):
        data["initialLayout"] = "UNDEFINED"
    if isinstance(own, AttachmentDescription) and own.states("finalLayout"):
        data["finalLayout"] = "DEPTH_STENCIL_READ_ONLY_OPTIMAL"
    resolve = {"attachment": len(record.attachments) if listed else key, "depthResolveMode": _MODE, "stencilResolveMode": "NONE"}
    made = [Change(record, "attachments", "entry", (key, data)), Change(subpass, "depthStencilResolve", "set", resolve)]
    return [*made, *(Change(buffer, "attachments", "append", name) for buffer in buffers)]
