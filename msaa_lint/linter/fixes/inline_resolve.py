"""`do: resolve-in-pass`: a vkCmdResolveImage becomes a resolve at the end of the pass that drew the samples.

Refused wherever the frame leaves a doubt: other uses in between, barriers, several framebuffers, sizes and formats that are not known.
"""

from __future__ import annotations

from bisect import bisect_left
from typing import Any, NamedTuple

from msaa_lint.frame.description.models import AttachmentDescription, Command, Image, RenderingAttachment, RenderPass, Subpass
from msaa_lint.frame.facts.facts import Subject
from msaa_lint.frame.facts.frame import RENDERING, Attachment, Pass, Resolve, Target
from msaa_lint.frame.facts.pass_begin import targets_at
from msaa_lint.frame.facts.timeline import READ

from .changes import Change, FixContext, Refused
from .transient import memory_changes, usage_changes

MAX_ATTACHMENTS = 64
"""Of a pass: more than any device takes."""


class Site(NamedTuple):
    """What is resolved where: the command, the pass before it, the attachment in it."""

    command: Command
    position: int
    within: Pass
    begin: int
    attachment: Attachment
    source: Image
    target: Image
    integer: bool


def resolve_in_pass(subject: Subject, mending: FixContext) -> list[Change] | Refused:
    """The changes that move a resolve into its pass."""
    site = _site(subject, mending)
    if isinstance(site, Refused):
        return site
    made = into_pass(site, mending)
    if isinstance(made, Refused):
        return made
    source = _source(site, mending, subject.facts.values.get("device.lazy_memory"))
    if isinstance(source, Refused):
        return source
    # A document whose commands are judged has none that could not be read: positions are indices.
    return [*made, *source, *_target(site, mending), Change(mending.document.description, "commands", "drop", site.position)]


def _site(subject: Subject, mending: FixContext) -> Site | Refused:
    resolve, frame, usages = subject.of, mending.frame, mending.usages
    position = usages.positions.get(id(resolve.record)) if isinstance(resolve, Resolve) else None
    if not isinstance(resolve, Resolve) or position is None or resolve.aspect != "color":
        return Refused("how depth is to be resolved is a choice")
    source, target = frame.target(_name(resolve.source_image)), frame.target(_name(resolve.target_image))
    if source is None or target is None or source.image is None or target.image is None:
        return Refused("an image of it is not described")
    if source.samples is None or source.samples < 2 or target.samples != 1 or source.format is None or source.format != target.format:
        return Refused("sample counts and formats do not show that a pass can resolve it")
    drew = mending.writers.get(source.name, [])
    last = bisect_left(drew, position, key=lambda writer: writer[0]) - 1
    begin, within = drew[last] if last >= 0 else (0, None)
    if within is not None and len(within.attachments) > MAX_ATTACHMENTS:
        return Refused("the pass has more attachments than are looked through")
    if within is None or len(within.begun) != 1 or within.custom_resolve or suspended(within):
        return Refused("the pass that draws it does not come once, just before it")
    drawn = [each for each in within.attachments if any(own.record is source.record for own in targets_at(frame, each, begin))]
    if len(drawn) != 1 or drawn[0].target is None or not drawn[0].color or drawn[0].input:
        return Refused("it is no plain colour attachment of that pass")
    if usages.named_between(target.name, begin, position) or not usages.barred.isdisjoint((source.name, target.name)):
        return Refused("the images have other uses, or barriers, in between")
    integer = source.format.numeric in ("UINT", "SINT")
    return Site(frame.commands[position], position, within, begin, drawn[0], source.image, target.image, integer)


def _name(target: Target | None) -> str | None:
    return target.name if target is not None else None


def suspended(within: Pass) -> bool:
    return within.kind == RENDERING and not {"SUSPENDING", "RESUMING"}.isdisjoint(getattr(within.record, "flags", ()))


def into_pass(site: Site, mending: FixContext) -> list[Change] | Refused:
    """The resolve, in the pass that draws its source."""
    return into_rendering(site) if site.within.kind == RENDERING else into_render_pass(site, mending)


def into_rendering(site: Site) -> list[Change] | Refused:
    record = site.attachment.record
    if not isinstance(record, RenderingAttachment) or record.resolveImage is not None:
        return Refused("the pass resolves it to something else")
    mode = "SAMPLE_ZERO" if site.integer else "AVERAGE"
    made = [Change(record, "resolveMode", "set", mode), Change(record, "resolveImage", "set", site.target.key)]
    if record.states("imageLayout"):
        made.append(Change(record, "resolveImageLayout", "set", "COLOR_ATTACHMENT_OPTIMAL"))
    return made


def into_render_pass(site: Site, mending: FixContext) -> list[Change] | Refused:
    """A new attachment, a reference to it at the colour attachment's index, and its image in the framebuffer."""
    record = site.within.record
    last = site.within.subpasses[max(site.attachment.color)]
    if not isinstance(record, RenderPass) or not isinstance(last.record, Subpass) or last.color.count(site.attachment) != 1:
        return Refused("it is no plain colour attachment of that pass")
    index = last.color.index(site.attachment)
    listed = record.spelled["attachments"][1].kind == "sequence"
    taken = {attachment.key for attachment in record.attachments}
    key = next(name for name in (site.target.key, *(f"{site.target.key}_{n}" for n in range(2, 2 + len(taken)))) if name not in taken)
    reference: object = len(record.attachments) if listed else key
    data = _description(site, mending)
    buffers = mending.framebuffers.get(site.within.name, [])
    made = [Change(record, "attachments", "entry", (key, data))]
    if buffers:
        if len(buffers) != 1 or not buffers[0].states("attachments") or "IMAGELESS" in buffers[0].flags:
            return Refused("the pass has several framebuffers, or one that names no images")
        made.append(Change(buffers[0], "attachments", "append", site.target.key))
    stated = last.record.resolveAttachments
    if index < len(stated):
        if stated[index].attachment is not None or stated[index].node.kind != "scalar":
            return Refused("the pass resolves it to something else")
        return [*made, Change(last.record, "resolveAttachments", "item", (index, reference))]
    new = [*(None for _ in range(len(stated), index)), reference]
    return [*made, *(Change(last.record, "resolveAttachments", "append", each) for each in new)]


def _description(site: Site, mending: FixContext) -> dict[str, Any]:
    """The new attachment: by its image, or by format and samples where a framebuffer binds it."""
    own = site.attachment.record
    assert isinstance(own, AttachmentDescription) and site.attachment.format is not None
    bound = own.image is not None
    data: dict[str, Any] = {"image": site.target.key} if bound else {"format": site.attachment.format.name, "samples": 1}
    data |= {"loadOp": "DONT_CARE", "storeOp": "STORE"}
    if own.states("initialLayout"):
        data["initialLayout"] = "UNDEFINED"
    layout = _final_layout(site, mending)
    if own.states("finalLayout") and layout is not None:
        data["finalLayout"] = layout
    return data


def _final_layout(site: Site, mending: FixContext) -> str | None:
    """The layout of what comes next; None where that is another pass, or nothing."""
    following = mending.usages.next_named(site.target.key, site.position)
    kind = mending.frame.commands[following].kind if following is not None else "present" if site.target.presentable else ""
    return {"present": "PRESENT_SRC_KHR", "readImage": "SHADER_READ_ONLY_OPTIMAL"}.get(kind)


def _source(site: Site, mending: FixContext, lazy_memory: object) -> list[Change] | Refused:
    """Without the command, what nothing else reads is not stored, and takes no memory."""
    uses = mending.timeline.uses.get(site.source.key, [])
    read = any(use.kind == READ and use.position != site.position for use in uses)
    usage = site.source.usage
    if read or not mending.timeline.followed:
        spare = usage is not None and "TRANSFER_SRC" not in mending.usages.needed(site.source.key, site.command)
        return [Change(site.source, "usage", "remove", "TRANSFER_SRC")] if spare else []
    record = site.attachment.record
    made = [Change(record, "storeOp", "set", "DONT_CARE")] if record.storeOp == "STORE" else []
    if getattr(record, "finalLayout", None) == "TRANSFER_SRC_OPTIMAL":
        made.append(Change(record, "finalLayout", "set", "COLOR_ATTACHMENT_OPTIMAL"))
    if usage is None:
        return made
    changed = usage_changes(site.source, mending, site.command)
    return changed if isinstance(changed, Refused) else [*made, *changed, *memory_changes(site.source, lazy_memory)]


def _target(site: Site, mending: FixContext) -> list[Change]:
    if site.target.usage is None:
        return []
    spare = "TRANSFER_DST" not in mending.usages.needed(site.target.key, site.command)
    gone = [Change(site.target, "usage", "remove", "TRANSFER_DST")] if spare else []
    return [*gone, Change(site.target, "usage", "add", "COLOR_ATTACHMENT")]
