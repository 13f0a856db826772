"""Declares the images and attachments that a pass resolves to."""

from __future__ import annotations

from collections.abc import Container
from typing import Any

from msaa_lint.frame.description.models import (
    AttachmentDescription,
    Command,
    Image,
    RenderingAttachment,
    RenderPass,
)
from msaa_lint.frame.description.record import Record
from msaa_lint.frame.facts.parts import Attachment

from .changes import Change, NoFix
from .context import FixContext


def unused_name(name: str, taken: Container[str]) -> str:
    """The name itself if it is not taken, else the name with the first suffix `_2`, `_3`, ... that
    is free.
    """
    number, candidate = 1, name
    while candidate in taken:
        number += 1
        candidate = f"{name}_{number}"
    return candidate


def rendering_resolve(
    record: Record, mode: str, image: str, layout: str | None = None
) -> list[Change]:
    """Resolves an attachment of a dynamic rendering to an image, in the given layout if the
    attachment states its own.
    """
    if not isinstance(record, RenderingAttachment) or record.resolveImage is not None:
        raise NoFix("the pass already resolves the attachment to another image")
    changes = [
        Change(record, "resolveMode", "set", mode),
        Change(record, "resolveImage", "set", image),
    ]
    if layout is not None and record.states("imageLayout"):
        changes.append(Change(record, "resolveImageLayout", "set", layout))
    return changes


def new_image(
    name: str, source: Image, format: str, usage: list[str] | None, context: FixContext
) -> Change:
    """Declares an image with one sample and the extent of another."""
    data: dict[str, Any] = {"format": format, "samples": 1}
    if usage is not None:
        data["usage"] = usage
    if source.extent is not None:
        sides = {side: getattr(source.extent, side) for side in ("width", "height", "depth")}
        data["extent"] = {side: length for side, length in sides.items() if length is not None}
    return Change(context.document.description, "images", "entry", (name, data))


def new_attachment(
    record: RenderPass,
    image: str,
    source: Attachment,
    final_layout: str | None,
    context: FixContext,
) -> tuple[list[Change], int | str]:
    """Adds an attachment, the target of a resolve of another one, to a render pass and to its
    framebuffer.

    It states the same members as the other one: its image or, if a framebuffer binds that, its
    format and samples; and its layouts. Also returns the reference for subpasses: its index, or its
    name if attachments are named.
    """
    source_record = source.record
    assert isinstance(source_record, AttachmentDescription) and source.format is not None
    data: dict[str, Any] = (
        {"image": image}
        if source_record.image is not None
        else {"format": source.format.name, "samples": 1}
    )
    data |= {"loadOp": "DONT_CARE", "storeOp": "STORE"}
    if source_record.states("initialLayout"):
        data["initialLayout"] = "UNDEFINED"
    if source_record.states("finalLayout") and final_layout is not None:
        data["finalLayout"] = final_layout
    is_list = record.spelled["attachments"][1].kind == "sequence"
    key = unused_name(image, {attachment.key for attachment in record.attachments})
    changes = [Change(record, "attachments", "entry", (key, data))]
    framebuffers = context.framebuffers.get(record.key, [])
    if framebuffers:
        if (
            len(framebuffers) > 1
            or not framebuffers[0].states("attachments")
            or "IMAGELESS" in framebuffers[0].flags
        ):
            raise NoFix("the pass has several framebuffers, or one that names no images")
        changes.append(Change(framebuffers[0], "attachments", "append", image))
    return changes, len(record.attachments) if is_list else key


def target_usage(image: Image, command: Command, context: FixContext) -> list[Change]:
    """The usage of an image that a pass resolves to in place of a command that wrote it."""
    if image.usage is None:
        return []
    unneeded = "TRANSFER_DST" not in context.uses.needed_usages(image.key, command)
    removed = [Change(image, "usage", "remove", "TRANSFER_DST")] if unneeded else []
    return [*removed, Change(image, "usage", "add", "COLOR_ATTACHMENT")]


def next_use(image: Image, position: int, context: FixContext, barriers: bool = True) -> str:
    """The kind of the first command after a position that uses an image: `present` for an unused
    presentable image, else empty.

    Without `barriers`, those are skipped.
    """
    uses = context.uses
    following = (
        uses.next_use(image.key, position)
        if barriers
        else uses.next_use_of_commands(image.key, position)
    )
    if following is None:
        return "present" if image.presentable else ""
    return context.frame.commands[following].kind
