"""Frames that are not described but reckoned: the same description with other commands, images or sample counts.

A frame belongs to whoever joined it from its document and may be changed in place: passes, attachments, targets. Records are shared by all
frames of a document and are copied instead.
"""

from __future__ import annotations

from typing import TypeVar

from msaa_lint.frame.description.models import BeginRendering, BeginRenderPass, Command, Image
from msaa_lint.frame.description.record import Record
from msaa_lint.frame.facts.commands import accesses
from msaa_lint.frame.facts.frame import Frame
from msaa_lint.frame.facts.parts import Attachment, Pass, Resolve, Target

Kind = TypeVar("Kind", bound=Record)
Order = list[tuple[Command, Pass | None]]
"""Commands, each with the pass that it begins."""


def blank(kind: type[Kind], like: Record, key: str) -> Kind:
    """A record of which nothing is stated, at the place of another."""
    return kind(like.node, like.path, key, like.head)


def copied(record: Kind) -> Kind:
    """A record with the members of another."""
    kind = type(record)
    made = kind.__new__(kind)
    vars(made).update(vars(record))
    return made


def command(kind: str, body: Record | None, like: Record) -> Command:
    """A command that the description does not record."""
    made = Command(like.node, like.path, kind, like.head)
    made.kind, made.body = kind, body
    return made


def recorded(frame: Frame) -> Order:
    """The commands of a frame; where none are stated, those that run every pass once."""
    if frame.has_commands:
        begins = {position: each for each in frame.passes for position in each.begun}
        return [(each, begins.get(position)) for position, each in enumerate(frame.commands)]
    order: Order = []
    for each in frame.passes:
        body = blank(BeginRenderPass, each.record, "beginRenderPass")
        body.renderPass = each.name
        order += [(command("beginRenderPass", body, each.record), each), (command("endRenderPass", None, each.record), None)]
    return order


def record(frame: Frame, order: Order) -> None:
    """Gives a frame other commands, which begin the same passes."""
    for each in frame.passes:
        each.begun = []
    for position, (_, begun) in enumerate(order):
        if begun is not None:
            begun.begun.append(position)
    frame.commands = tuple(each for each, _ in order)
    frame.description = copied(frame.description)
    frame.description.commands = frame.commands
    frame.resolve_commands = []


def image_of(target: Target) -> Image | None:
    """The image of a target, as one that may be changed without another frame seeing it."""
    if target.image is not None:
        target.image = copied(target.image)
    return target.image


def suspended(each: Pass) -> bool:
    """Whether a rendering goes on in another one: it then stores and resolves nothing."""
    return isinstance(each.record, BeginRendering) and "SUSPENDING" in each.record.flags


def resolved(each: Pass) -> list[Resolve]:
    """What a pass resolves itself, of more than one sample and into a target; one whose mode is not stated may resolve nothing."""
    return [
        found
        for subpass in each.subpasses
        for found in subpass.resolves
        if found.mode not in (None, "NONE") and found.source is not None and found.source.samples != 1
        and (found.target is not None or found.target_image is not None)
    ] if not suspended(each) else []  # fmt: skip


def users(frame: Frame) -> dict[int, list[Attachment]]:
    """By the identity of a target: the attachments that have it, of those that a subpass refers to."""
    found: dict[int, list[Attachment]] = {}
    for each in frame.passes:
        for attachment in each.attachments:
            for target in attachment.targets if attachment.used else ():
                found.setdefault(id(target), []).append(attachment)
    return found


def mentioned(frame: Frame) -> set[str]:
    """The images that commands outside of passes' begins and barriers name."""
    return {name for command in frame.commands for name, _ in accesses(command)}


def renamed(found: Command, names: dict[str, str]) -> Command:
    """A command with other images in place of some."""
    body = found.body
    stated = {access.member: names[name] for name, access in accesses(found) if name in names}
    if not stated or not isinstance(body, Record):
        return found
    made, inner = copied(found), copied(body)
    for member, name in stated.items():
        setattr(inner, member, name)
    made.body = inner
    return made
