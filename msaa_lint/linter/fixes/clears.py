"""`do: clear-on-load` and `do: draw-the-copy`: a command before or in a pass becomes a load
operation or a draw.
"""

from __future__ import annotations

from msaa_lint.frame.description.models import BeginRenderPass, ClearAttachments
from msaa_lint.frame.facts.facts import Subject
from msaa_lint.frame.facts.parts import Attachment

from .changes import Change, NoFix
from .context import FixContext
from .subject_parts import aspect_of, present, text_fact


def clear_on_load(subject: Subject, context: FixContext) -> list[Change]:
    """Clears the attachment when the pass loads it and removes the command that clears it."""
    position, entry = _command(subject, "aspect.clear_command", context)
    attachment, aspect = aspect_of(subject)
    begin = _only_begin(attachment, context)
    changes = [_drop_clear(position, entry, context)]
    if aspect.load == "LOAD" or entry is not None:
        changes.append(Change(attachment.record, aspect.load_member, "set", "CLEAR"))
        body = context.frame.commands[begin].body
        if (
            isinstance(body, BeginRenderPass)
            and body.clearValueCount is not None
            and body.clearValueCount <= attachment.index
        ):
            # VUID-VkRenderPassBeginInfo-clearValueCount-00902
            changes.append(Change(body, "clearValueCount", "set", attachment.index + 1))
    return changes


def draw_the_copy(subject: Subject, context: FixContext) -> list[Change]:
    """Reads the source of a copy in a shader of the pass, in place of the copy and the load."""
    position, _ = _command(subject, "aspect.copy_command", context)
    attachment, aspect = aspect_of(subject)
    begin = _only_begin(attachment, context)
    source = present(
        text_fact(subject, "aspect.copy_source"), "the source of the copy is not an image"
    )
    read = {"readImage": {"image": source, "stage": "FRAGMENT", "access": "SHADER_READ"}}
    return [
        context.drop_command(position),
        Change(context.document.description, "commands", "insert-after", (begin, read)),
        Change(attachment.record, aspect.load_member, "set", "DONT_CARE"),
    ]


def _command(subject: Subject, fact: str, context: FixContext) -> tuple[int, int | None]:
    """The only command at the place of a fact: its position and, for vkCmdClearAttachments, the
    entry.
    """
    place = subject.facts.places.get(fact)
    commands = context.commands_at.get(place, []) if place is not None else []
    if len(commands) != 1:
        raise NoFix("an alias repeats the command")
    return commands[0]


def _only_begin(attachment: Attachment, context: FixContext) -> int:
    """The position of the only command that begins an attachment's pass."""
    candidates = (
        candidate
        for target in attachment.targets
        for candidate in context.attachments.get(id(target.record), ())
    )
    render_pass = next(
        (
            render_pass
            for render_pass, candidate in candidates
            if candidate.record is attachment.record
        ),
        None,
    )
    begins = present(render_pass, "the pass of the attachment is not known").begun
    if len(begins) != 1:
        raise NoFix("the pass begins more than once")
    return begins[0]


def _drop_clear(position: int, entry: int | None, context: FixContext) -> Change:
    body = context.frame.commands[position].body
    if entry is not None and isinstance(body, ClearAttachments) and len(body.attachments) > 1:
        return Change(body, "attachments", "drop", entry)
    return context.drop_command(position)
