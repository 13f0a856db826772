"""Changes to resolves: one that is not needed goes, one that is copied on writes where the copy did, one is waited for."""

from __future__ import annotations

import re

from msaa_lint.frame.description.models import (
    AttachmentDescription,
    Command,
    DepthStencilResolve,
    Image,
    RenderingAttachment,
    Subpass,
    TwoImages,
)
from msaa_lint.frame.description.record import Record
from msaa_lint.frame.facts.facts import Subject
from msaa_lint.frame.facts.frame import Attachment, Resolve

from .changes import Change, FixContext, Refused
from .fact_sources import mode_place

_SLOT = re.compile(r"\.resolveAttachments\[(\d+)\]$")
_MOVING = ("LOAD", "CLEAR", "STORE")
_LAYOUTS = {"present": "PRESENT_SRC_KHR", "beginRenderPass": "COLOR_ATTACHMENT_OPTIMAL", "beginRendering": "COLOR_ATTACHMENT_OPTIMAL"}


def drop_resolve(subject: Subject, mending: FixContext) -> list[Change] | Refused:
    """Takes a resolve away: its command, its image in a rendering, its slot in a subpass. What no other use is left of is not stored."""
    resolve = subject.of
    if not isinstance(resolve, Resolve):
        return Refused("it is about no resolve")
    record = resolve.record
    if resolve.kind == "command":
        position = mending.usages.positions.get(id(record))
        return [_without(mending, position)] if position is not None else Refused("there are more commands than are followed")
    pair = resolve.pair if resolve.pair is not None and resolve.pair.mode != "NONE" else None
    if pair is not None and not _unread(pair, mending):
        if subject.facts.values.get("resolve.may_be_none") is not True:
            return Refused("the other aspect is resolved with it: to leave one out, a device must offer independentResolveNone")
        return _one_of_two(resolve)
    if isinstance(record, RenderingAttachment):
        return [change for each in (resolve, pair) if each is not None for change in _of_rendering(each.record)]
    if isinstance(record, DepthStencilResolve):
        subpass = mending.mentions.subpasses.get(id(record))
        made = [Change(subpass, "depthStencilResolve", "unset")] if subpass is not None else []
    elif isinstance(record, Subpass):
        made = _without_slot(record, resolve)
    else:
        made = []
    if not made:
        return Refused("where it is stated is not understood")
    return [*made, *(_left_alone(resolve.target) if resolve.target is not None else [])]


def _without(mending: FixContext, position: int) -> Change:
    # A document whose commands are judged has none that could not be read: positions are indices.
    return Change(mending.document.description, "commands", "drop", position)


def _one_of_two(resolve: Resolve) -> list[Change] | Refused:
    """One aspect left out, where the other stays."""
    place = mode_place(resolve)
    if isinstance(resolve.record, RenderingAttachment):
        return _of_rendering(resolve.record)
    if place is None:
        return Refused("where it is stated is not understood")
    made = [Change(place[0], place[1], "set", "NONE")]
    target = resolve.target
    if target is not None and not (target.depth_stencil or target.input) and len(target.resolve) == 1:
        members = ("stencilLoadOp", "stencilStoreOp") if resolve.aspect == "stencil" else ("loadOp", "storeOp")
        record = target.record
        made += [Change(record, member, "set", "DONT_CARE") for member in members if getattr(record, member) in _MOVING]
    return made


def _unread(resolve: Resolve, mending: FixContext) -> bool:
    """Whether nothing reads what a resolve writes."""
    own = mending.mentions.resolves.get((id(resolve.record), resolve.aspect))
    return own is not None and mending.results.is_read(own) is False


def _of_rendering(record: Record) -> list[Change]:
    made = [Change(record, "resolveMode", "set", "NONE")]
    return [*made, *(Change(record, member, "unset") for member in ("resolveImage", "resolveImageLayout") if record.states(member))]


def _without_slot(record: Subpass, resolve: Resolve) -> list[Change]:
    slot = _SLOT.search(resolve.path)
    if slot is None:
        return []
    index = int(slot[1])
    others = [each.attachment for n, each in enumerate(record.resolveAttachments) if n != index]
    if all(other is None for other in others):
        return [Change(record, "resolveAttachments", "unset")]
    return [Change(record, "resolveAttachments", "item", (index, None))]


def _left_alone(target: Attachment) -> list[Change]:
    """An attachment that one resolve alone used: nothing of it is worth a load or a store."""
    record = target.record
    uses = (target.color, target.depth_stencil, target.input)
    if not isinstance(record, AttachmentDescription) or any(uses) or len(target.resolve) > 1:
        return []
    members = ("loadOp", "storeOp", "stencilLoadOp", "stencilStoreOp")
    return [Change(record, member, "set", "DONT_CARE") for member in members if getattr(record, member) in _MOVING]


def resolve_to_copy(subject: Subject, mending: FixContext) -> list[Change] | Refused:
    """Resolves to the image that the result is copied to, and takes the copy and the image between away."""
    resolve, frame, description = subject.of, mending.frame, mending.document.description
    if not isinstance(resolve, Resolve):
        return Refused("it is about no resolve")
    between = frame.target(_text(subject, "resolve.copied_from"))
    target = frame.target(_text(subject, "resolve.copied_to"))
    if between is None or target is None or between.image is None or target.image is None:
        return Refused("an image of it is not described")
    copies = [record for record in mending.mentions.of.get(between.name, ()) if _is_copy(record, between.name, target.name)]
    position = mending.usages.positions.get(id(copies[0])) if len(copies) == 1 else None
    if position is None:
        return Refused("it is copied more than once, or there are more commands than are followed")
    made = _to(resolve, target.image, position, mending)
    if isinstance(made, Refused):
        return made
    made += _usage(resolve, target.image, frame.commands[position], mending)
    made.append(_without(mending, position))
    if not mending.mentions.beside(between.name, [copies[0], *(change.record for change in made)]):
        made.append(Change(description, "images", "drop", list(description.images).index(between.name)))
    return made


def _text(subject: Subject, fact: str) -> str | None:
    value = subject.facts.values.get(fact)
    return value if isinstance(value, str) else None


def _is_copy(record: Record, source: str, target: str) -> bool:
    return isinstance(record, TwoImages) and (record.srcImage, record.dstImage) == (source, target)


def _to(resolve: Resolve, target: Image, copy: int, mending: FixContext) -> list[Change] | Refused:
    record = resolve.record
    if resolve.kind == "command":
        return [Change(record, "dstImage", "set", target.key)]
    if isinstance(record, RenderingAttachment):
        return [Change(record, "resolveImage", "set", target.key)]
    attachment = resolve.target
    if attachment is None or not isinstance(attachment.record, AttachmentDescription) or resolve.within is None:
        return Refused("where it is stated is not understood")
    made: list[Change] = []
    buffers = mending.framebuffers.get(resolve.within.name, [])
    if len(buffers) > 1:
        return Refused("the pass has several framebuffers")
    if buffers:
        made.append(Change(buffers[0], "attachments", "item", (attachment.index, target.key)))
    if attachment.record.states("image"):
        made.append(Change(attachment.record, "image", "set", target.key))
    if attachment.record.states("finalLayout"):
        following = mending.usages.next_named(target.key, copy)
        kind = mending.frame.commands[following].kind if following is not None else "present" if target.presentable else ""
        if kind not in _LAYOUTS:
            return Refused("the layout that comes next is not known")
        made.append(Change(attachment.record, "finalLayout", "set", _LAYOUTS[kind]))
    return made


def _usage(resolve: Resolve, target: Image, copy: Command, mending: FixContext) -> list[Change]:
    if target.usage is None or resolve.kind == "command":
        return []
    spare = "TRANSFER_DST" not in mending.usages.needed(target.key, copy)
    gone = [Change(target, "usage", "remove", "TRANSFER_DST")] if spare else []
    return [*gone, Change(target, "usage", "add", "COLOR_ATTACHMENT")]


def wait_for_resolve(subject: Subject, mending: FixContext) -> list[Change] | Refused:
    """The stage and the write of a resolve, among the source stages and accesses of the wait that its finding points at."""
    place = subject.facts.places.get("resolve.waiting_stages")
    by_command = subject.facts.values.get("resolve.kind") == "command"
    stage, access = ("TRANSFER", "TRANSFER_WRITE") if by_command else ("COLOR_ATTACHMENT_OUTPUT", "COLOR_ATTACHMENT_WRITE")
    found = mending.mentions.waits.get(place, []) if place is not None else []
    made = [Change(each, "srcStageMask", "add", stage) for each in found]
    made += [Change(each, "srcAccessMask", "add", access) for each in found if "MEMORY_WRITE" not in (each.srcAccessMask or ())]
    return made or Refused("the wait is not found again")


def share_image(subject: Subject, mending: FixContext) -> list[Change] | Refused:
    """One image in all framebuffers, in place of several that take turns; the others go."""
    names = subject.facts.values.get("image.taking_turns")
    description = mending.document.description
    if not isinstance(names, list) or len(names) < 2:
        return Refused("no other image takes turns with it")
    first, others = str(names[0]), {str(name) for name in names[1:]}
    made = [
        Change(framebuffer, "attachments", "item", (index, first))
        for framebuffer in description.framebuffers.values()
        for index, name in enumerate(framebuffer.attachments)
        if name in others
    ]
    buffers: list[Record] = [*description.framebuffers.values()]
    if any(mending.mentions.beside(name, buffers) for name in others):
        return Refused("commands or attachments name the others")
    drops = [Change(description, "images", "drop", n) for n, name in enumerate(description.images) if name in others]
    return [*made, *drops]
