"""`do: clear-on-load`, `do: draw-the-copy`: what a command did before a pass, its load operation does, or a draw in it."""

from __future__ import annotations

from msaa_lint.core.text.span import Span
from msaa_lint.frame.description.models import BeginRenderPass, ClearAttachments
from msaa_lint.frame.facts.facts import Subject
from msaa_lint.frame.facts.frame import Aspect, Attachment, Pass

from .changes import Change, FixContext, Refused

Recorded = dict[Span, list[tuple[int, int | None]]]
"""By place: the commands that stand there, and of a vkCmdClearAttachments which entry."""


def recorded_at(mending: FixContext) -> Recorded:
    """The commands of a frame by the places that facts name."""
    found: Recorded = {}
    for position, command in enumerate(mending.frame.commands):
        found.setdefault(command.head, []).append((position, None))
        if isinstance(command.body, ClearAttachments):
            for entry, cleared in enumerate(command.body.attachments):
                found.setdefault(cleared.place("aspect"), []).append((position, entry))
    return found


def clear_on_load(subject: Subject, mending: FixContext) -> list[Change] | Refused:
    """CLEAR in place of the command that clears, which goes."""
    found = _ends(subject, "aspect.clear_command", mending)
    if isinstance(found, Refused):
        return found
    (position, entry), (each, attachment, aspect) = found
    if len(each.begun) != 1:
        return Refused("the pass is begun several times")
    made = [_dropped(position, entry, mending)]
    if aspect.load == "LOAD" or entry is not None:
        made.append(Change(attachment.record, aspect.load_member, "set", "CLEAR"))
        begin = mending.frame.commands[each.begun[0]].body
        if isinstance(begin, BeginRenderPass) and begin.clearValueCount is not None and begin.clearValueCount <= attachment.index:
            # VUID-VkRenderPassBeginInfo-clearValueCount-00902.
            made.append(Change(begin, "clearValueCount", "set", attachment.index + 1))
    return made


def draw_the_copy(subject: Subject, mending: FixContext) -> list[Change] | Refused:
    """A shader in the pass reads what was copied: no copy, no load."""
    found = _ends(subject, "aspect.copy_command", mending)
    if isinstance(found, Refused):
        return found
    (position, _), (each, attachment, aspect) = found
    source = subject.facts.values.get("aspect.copy_source")
    if len(each.begun) != 1 or not isinstance(source, str):
        return Refused("the pass is begun several times, or what is copied is no image")
    read = {"readImage": {"image": source, "stage": "FRAGMENT", "access": "SHADER_READ"}}
    return [
        Change(mending.document.description, "commands", "drop", position),
        Change(mending.document.description, "commands", "behind", (each.begun[0], read)),
        Change(attachment.record, aspect.load_member, "set", "DONT_CARE"),
    ]


Site = tuple[Pass, Attachment, Aspect]


def _ends(subject: Subject, fact: str, mending: FixContext) -> tuple[tuple[int, int | None], Site] | Refused:
    """The one command that stands where a fact says, and the aspect of the pass that it is for."""
    at, passed = _only(subject, fact, mending), _aspect(subject, mending)
    if isinstance(at, Refused):
        return at
    return passed if isinstance(passed, Refused) else (at, passed)


def _only(subject: Subject, fact: str, mending: FixContext) -> tuple[int, int | None] | Refused:
    """The one command that stands where a fact says."""
    place = subject.facts.places.get(fact)
    at = mending.recorded_at.get(place, []) if place is not None else []
    return at[0] if len(at) == 1 else Refused("the command is written once for several")


def _aspect(subject: Subject, mending: FixContext) -> Site | Refused:
    """The pass of an aspect, as the frame of the fixes has it."""
    of = subject.of
    if not (isinstance(of, tuple) and isinstance(of[0], Attachment) and isinstance(of[1], Aspect)):
        return Refused("it is not about one aspect of an attachment")
    for target in of[0].targets:
        for each, attachment in mending.attachments.get(id(target.record), ()):
            if attachment.record is of[0].record:
                return each, attachment, of[1]
    return Refused("it is not about one aspect of an attachment")


def _dropped(position: int, entry: int | None, mending: FixContext) -> Change:
    body = mending.frame.commands[position].body
    if entry is not None and isinstance(body, ClearAttachments) and len(body.attachments) > 1:
        return Change(body, "attachments", "drop", entry)
    return Change(mending.document.description, "commands", "drop", position)
