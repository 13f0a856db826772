"""`do: drop-resolve`, `do: resolve-by-sample-zero`, `do: resolve-to-copy` and `do:
wait-for-resolve`: changes to existing resolves.
"""

from __future__ import annotations

import re
from collections.abc import Iterable

from msaa_lint.frame.description.models import (
    AttachmentDescription,
    DepthStencilResolve,
    Image,
    RenderingAttachment,
    Subpass,
    TwoImages,
)
from msaa_lint.frame.description.record import Record
from msaa_lint.frame.facts.facts import Subject
from msaa_lint.frame.facts.missing_keys import resolve_mode
from msaa_lint.frame.facts.parts import Attachment, Resolve
from msaa_lint.frame.facts.pipeline_stages import includes_access, stated_stages

from .changes import Change, NoFix
from .context import FixContext
from .resolve_targets import next_use, target_usage
from .subject_parts import copied_images, present, resolve_of

_SLOT = re.compile(r"\.resolveAttachments\[(\d+)\]$")
_DEPTH_OPS, _STENCIL_OPS = ("loadOp", "storeOp"), ("stencilLoadOp", "stencilStoreOp")
_FINAL_LAYOUTS = {
    "present": "PRESENT_SRC_KHR",
    "beginRenderPass": "COLOR_ATTACHMENT_OPTIMAL",
    "beginRendering": "COLOR_ATTACHMENT_OPTIMAL",
}


def drop_resolve(subject: Subject, context: FixContext) -> list[Change]:
    """Removes a resolve, and the loads and stores of a target that nothing else uses."""
    resolve = resolve_of(subject)
    record = resolve.record
    if resolve.kind == "command":
        position = context.uses.positions.get(id(record))
        return [
            context.drop_command(present(position, "the frame has more commands than are analyzed"))
        ]
    pair = resolve.pair if resolve.pair is not None and resolve.pair.mode != "NONE" else None
    if pair is not None and not _is_unread(pair, context):
        if subject.facts.values.get("resolve.may_be_none") is not True:
            raise NoFix(
                "the same structure resolves the other aspect, and the device may not support "
                "independentResolveNone"
            )
        return _drop_one_aspect(resolve)
    if isinstance(record, RenderingAttachment):
        records = [end.record for end in (resolve, pair) if end is not None]
        return [change for rendering in records for change in _drop_from_rendering(rendering)]
    return [
        *_drop_from_subpass(resolve),
        *(_drop_target(resolve.target) if resolve.target is not None else []),
    ]


def _is_unread(resolve: Resolve, context: FixContext) -> bool:
    # The finding's subject belongs to another instance of the frame than the results.
    counterpart = context.resolves.get((id(resolve.record), resolve.aspect))
    return counterpart is not None and context.analysis.resolve_uses.is_read(counterpart) is False


def _drop_one_aspect(resolve: Resolve) -> list[Change]:
    """Removes the resolve of one aspect; the other aspect's stays."""
    if isinstance(resolve.record, RenderingAttachment):
        return _drop_from_rendering(resolve.record)
    source = present(
        resolve_mode(resolve), "the description does not state the mode of the resolve"
    )
    changes = [Change(*source, "set", "NONE")]
    target = resolve.target
    if (
        target is not None
        and not (target.depth_stencil or target.input)
        and len(target.resolve) == 1
    ):
        changes += _without_ops(
            target.record, _STENCIL_OPS if resolve.aspect == "stencil" else _DEPTH_OPS
        )
    return changes


def _drop_from_rendering(record: Record) -> list[Change]:
    unset = [member for member in ("resolveImage", "resolveImageLayout") if record.states(member)]
    return [
        Change(record, "resolveMode", "set", "NONE"),
        *(Change(record, member, "unset") for member in unset),
    ]


def _drop_from_subpass(resolve: Resolve) -> list[Change]:
    record, slot = resolve.record, _SLOT.search(resolve.path)
    if isinstance(record, DepthStencilResolve) and resolve.render_pass is not None:
        return [
            Change(
                resolve.render_pass.subpasses[resolve.subpass].record,
                "depthStencilResolve",
                "unset",
            )
        ]
    if not isinstance(record, Subpass) or slot is None:
        raise NoFix("the resolve is not stated in a subpass")
    index = int(slot[1])
    if all(
        reference.attachment is None
        for n, reference in enumerate(record.resolveAttachments)
        if n != index
    ):
        return [Change(record, "resolveAttachments", "unset")]
    return [Change(record, "resolveAttachments", "replace", (index, None))]


def _drop_target(target: Attachment) -> list[Change]:
    """Drops the loads and stores of an attachment that only one resolve used."""
    used = target.color or target.depth_stencil or target.input or len(target.resolve) > 1
    return [] if used else _without_ops(target.record, (*_DEPTH_OPS, *_STENCIL_OPS))


def _without_ops(record: Record, members: Iterable[str]) -> list[Change]:
    if not isinstance(record, AttachmentDescription):
        return []
    return [
        Change(record, member, "set", "DONT_CARE")
        for member in members
        if getattr(record, member) in ("LOAD", "CLEAR", "STORE")
    ]


def resolve_by_sample_zero(subject: Subject, _: FixContext) -> list[Change]:
    """Sets SAMPLE_ZERO, which every device supports. An aspect that is not resolved stays so if the
    device allows it.
    """
    resolve = resolve_of(subject)
    both = subject.facts.values.get("resolve.pair_supported") is False
    ends = [
        end for end in (resolve, resolve.pair) if end is not None and (both or end.mode != "NONE")
    ]
    if any(end.target is None and end.target_image is None for end in ends):
        raise NoFix("one of the two aspects has no image to resolve to")
    return [
        Change(*source, "set", "SAMPLE_ZERO")
        for end in ends
        if (source := resolve_mode(end)) is not None
    ]


def resolve_to_copy(subject: Subject, context: FixContext) -> list[Change]:
    """Resolves to the image that the result is copied to, and removes the copy and, if nothing else
    uses it, the image in between.
    """
    resolve, frame, description = resolve_of(subject), context.frame, context.document.description
    between, target = map(frame.target, copied_images(subject))
    if between is None or between.image is None or target is None or target.image is None:
        raise NoFix("the description does not declare both images of the copy")
    copies = [
        record
        for record in context.references.records(between.name)
        if isinstance(record, TwoImages)
        and (record.srcImage, record.dstImage) == (between.name, target.name)
    ]
    position = context.uses.positions.get(id(copies[0])) if len(copies) == 1 else None
    if position is None:
        raise NoFix(
            "the image is copied more than once, or the frame has more commands than are analyzed"
        )
    changes = _redirect(resolve, target.image, position, context)
    if resolve.kind != "command":
        changes += target_usage(target.image, frame.commands[position], context)
    changes.append(context.drop_command(position))
    if not context.references.has_others(
        between.name, [copies[0], *(change.record for change in changes)]
    ):
        changes.append(
            Change(description, "images", "drop", list(description.images).index(between.name))
        )
    return changes


def _redirect(resolve: Resolve, target: Image, copy: int, context: FixContext) -> list[Change]:
    """Makes an image the target of a resolve, in place of the copy at a position."""
    record = resolve.record
    if resolve.kind == "command":
        return [Change(record, "dstImage", "set", target.key)]
    if isinstance(record, RenderingAttachment):
        return [Change(record, "resolveImage", "set", target.key)]
    attachment = resolve.target
    if (
        attachment is None
        or not isinstance(attachment.record, AttachmentDescription)
        or resolve.render_pass is None
    ):
        raise NoFix("the resolve is not stated in a subpass")
    framebuffers = context.framebuffers.get(resolve.render_pass.name, [])
    if len(framebuffers) > 1:
        raise NoFix("the pass has several framebuffers")
    changes = [
        Change(framebuffer, "attachments", "replace", (attachment.index, target.key))
        for framebuffer in framebuffers
    ]
    if attachment.record.states("image"):
        changes.append(Change(attachment.record, "image", "set", target.key))
    if attachment.record.states("finalLayout"):
        layout = present(
            _FINAL_LAYOUTS.get(next_use(target, copy, context)),
            "the layout that the image needs next is not known",
        )
        changes.append(Change(attachment.record, "finalLayout", "set", layout))
    return changes


def wait_for_resolve(subject: Subject, context: FixContext) -> list[Change]:
    """Adds to the wait that a finding points at what its scopes lack: the stages and accesses of
    the write and of its reader.
    """
    facts = subject.facts.values
    place = subject.facts.places.get("resolve.waiting_stages")
    waits = context.waits.get(place, []) if place is not None else []
    if not waits:
        raise NoFix("no dependency or barrier is stated for the read")
    changes: list[Change] = []
    for ends, stages, accesses in (
        ("src", "resolve.stage", "resolve.access"),
        ("dst", "resolve.reader_stage", "resolve.reader_access"),
    ):
        stage, access = facts.get(stages), facts.get(accesses)
        if not isinstance(stage, str) or not isinstance(access, str):
            continue
        for wait in waits:
            stage_mask, access_mask = (
                getattr(wait, f"{ends}StageMask") or (),
                getattr(wait, f"{ends}AccessMask") or (),
            )
            needed = (
                {"RESOLVE"} if (ends, stage) == ("src", "TRANSFER") else stated_stages((stage,))
            )
            if not needed <= stated_stages(stage_mask):
                changes.append(Change(wait, f"{ends}StageMask", "add", stage))
            if not includes_access(access_mask, access):
                changes.append(Change(wait, f"{ends}AccessMask", "add", access))
    return changes
