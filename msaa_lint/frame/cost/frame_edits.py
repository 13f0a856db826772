"""Edits of a joined frame: other commands, images or sample counts than the description states.

A frame belongs to the caller that joined it: its passes, attachments and targets may be changed in
place. Records are shared by all frames of a document and are copied instead.
"""

from __future__ import annotations

from typing import TypeVar

from msaa_lint.frame.description.models import BeginRenderPass, Command, Image
from msaa_lint.frame.description.record import Record
from msaa_lint.frame.facts.commands import accesses
from msaa_lint.frame.facts.frame import Frame
from msaa_lint.frame.facts.parts import Attachment, Pass, Resolve, Target

RecordType = TypeVar("RecordType", bound=Record)
CommandOrder = list[tuple[Command, Pass | None]]
"""Commands, each with the pass that it begins."""


def blank_record(kind: type[RecordType], like: Record, key: str) -> RecordType:
    """A record that states nothing, at the place of another."""
    return kind(like.node, like.path, key, like.head)


def copy_record(record: RecordType) -> RecordType:
    """A record with the members of another."""
    kind = type(record)
    copy = kind.__new__(kind)
    vars(copy).update(vars(record))
    return copy


def make_command(kind: str, body: Record | None, like: Record) -> Command:
    """A command that the description does not record."""
    command = Command(like.node, like.path, kind, like.head)
    command.kind, command.body = kind, body
    return command


def command_order(frame: Frame) -> CommandOrder:
    """The commands of a frame; if it states none, commands that run every pass once."""
    if frame.has_commands:
        begins = {
            position: render_pass for render_pass in frame.passes for position in render_pass.begun
        }
        return [(command, begins.get(position)) for position, command in enumerate(frame.commands)]
    order: CommandOrder = []
    for render_pass in frame.passes:
        record = render_pass.record
        body = blank_record(BeginRenderPass, record, "beginRenderPass")
        body.renderPass = render_pass.name
        order += [
            (make_command("beginRenderPass", body, record), render_pass),
            (make_command("endRenderPass", None, record), None),
        ]
    return order


def set_commands(frame: Frame, order: CommandOrder) -> None:
    """Replaces the commands of a frame by others, which begin the same passes."""
    for render_pass in frame.passes:
        render_pass.begun = []
    for position, (_, render_pass_begun) in enumerate(order):
        if render_pass_begun is not None:
            render_pass_begun.begun.append(position)
    frame.commands = tuple(command for command, _ in order)
    frame.description = copy_record(frame.description)
    frame.description.commands = frame.commands
    frame.resolve_commands = []


def own_image(target: Target) -> Image | None:
    """The image of a target, as a copy that may be changed without affecting other frames."""
    if target.image is not None:
        target.image = copy_record(target.image)
    return target.image


def effective_resolves(render_pass: Pass) -> list[Resolve]:
    """The resolves of a pass that certainly take effect: with a stated mode, of more than one
    sample and with a target.
    """
    if render_pass.suspends:
        return []
    return [
        resolve
        for resolve in render_pass.resolves
        if resolve.is_certain
        and resolve.source is not None
        and resolve.source.samples != 1
        and resolve.written_part is not None
    ]


def attachments_by_target(frame: Frame) -> dict[int, list[Attachment]]:
    """The attachments that a subpass references, by the identity of each target that they have."""
    found: dict[int, list[Attachment]] = {}
    for render_pass in frame.passes:
        for attachment in render_pass.attachments:
            for target in attachment.targets if attachment.used else ():
                found.setdefault(id(target), []).append(attachment)
    return found


def images_of_commands(frame: Frame) -> set[str]:
    """The images that commands name, apart from the beginning of passes and barriers."""
    return {name for command in frame.commands for name, _ in accesses(command)}


def rename_images(command: Command, names: dict[str, str]) -> Command:
    """A command with other images in place of some."""
    body = command.body
    stated = {access.member: names[name] for name, access in accesses(command) if name in names}
    if not stated or not isinstance(body, Record):
        return command
    renamed, renamed_body = copy_record(command), copy_record(body)
    for member, name in stated.items():
        setattr(renamed_body, member, name)
    renamed.body = renamed_body
    return renamed
