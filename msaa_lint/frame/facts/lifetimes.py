"""Facts of an aspect's contents over time: whether anything reads what is stored, whether a load
finds anything, what came before.

Every run of a pass counts, with every framebuffer.
"""

from __future__ import annotations

from msaa_lint.frame.description.models import Command, ReadImage

from .commands import CLEAR, COMMAND_READS, COPY_WRITE, RESOLVE_WRITE, WRITE
from .contents import READS, AspectEvents, Contents, is_known
from .facts import Facts
from .parts import SUSPENDED, Aspect, Attachment, Target
from .readers import READING_USAGES
from .timeline import BEGIN, DISCARD, LOAD, STORE, Event, plain

_WRITING_USAGES = frozenset({"TRANSFER_DST", "STORAGE"})

Bound = list[tuple[Target, AspectEvents]]
"""The images of an attachment, each with what happens to the aspect."""


def lifetime_facts(
    facts: Facts, attachment: Attachment, aspect: Aspect, contents: Contents
) -> None:
    """Adds what the frame says of an aspect's contents before and after the pass."""
    bound: Bound = []
    if attachment.used and aspect.name is not None:
        bound = [
            (target, contents.of(target.name, aspect.name))
            for target in attachment.targets
            if target.image is not None
        ]
        _put_store(facts, attachment, aspect, bound, contents)
        _put_undefined(facts, attachment, aspect, bound, contents)
    elif facts.values.get("attachment.used") is False:
        # Vulkan ignores its operations.
        facts.put("aspect.store_wasted", False)
        facts.put("aspect.reads_undefined", False)
    if contents.timeline.writes and bound:
        _put_commands_before(facts, attachment, bound)
    else:
        facts.put("aspect.copied_before", False)


def _put_store(
    facts: Facts, attachment: Attachment, aspect: Aspect, bound: Bound, contents: Contents
) -> None:
    """Whether anything reads what the pass stores, before it is overwritten or the frame comes
    round.
    """
    if aspect.store in ("DONT_CARE", "NONE", SUSPENDED):
        facts.put("aspect.store_wasted", False)
        return
    wasted: list[bool | None] = []
    certain = True
    first_end: Event | None = None
    for target, line in bound:
        if line.has_unknown(attachment):
            wasted.append(None)
        for index in line.of(attachment, STORE):
            decisive = line.next_decisive(index)
            end = line.events[decisive] if decisive is not None else None
            if end is not None and (not is_known(end) or end.kind in READS):
                wasted.append(False if is_known(end) else None)
                continue
            same_frame = decisive is not None and line.same_frame(index, decisive)
            unread = _unread_outside(target, attachment, aspect, same_frame, contents)
            wasted.append(True if unread is not None else None)
            certain = certain and unread is True
            first_end = first_end or end
    answer = None if not wasted or None in wasted else True
    if False in wasted:
        answer = False
    facts.put("aspect.store_wasted", answer)
    if answer:
        facts.put("aspect.waste_certain", certain)
        if first_end is not None:
            facts.put("aspect.overwritten_by", first_end.name, first_end.place)


def _unread_outside(
    target: Target, attachment: Attachment, aspect: Aspect, same_frame: bool, contents: Contents
) -> bool | None:
    """Whether nothing that is not described reads what is left in an image: True by its usage, or
    as the commands leave no time for it; False where only the commands of a whole frame speak for
    it; None where something may.

    `same_frame`: it is overwritten in the frame that stored it. Images that change places from
    frame to frame, a history and what becomes it, look in one frame like one that nothing reads and
    one that nothing writes.
    """
    image = target.image
    assert image is not None
    commands, presents = contents.frame.has_commands, contents.timeline.presents
    if image.mayBeRead:
        return None
    if commands and same_frame:
        return True
    if contents.read_when_idle(target.name) or image.presentable:
        return None
    # Its own pass reads an input attachment before it stores it; others of the frame are described.
    reading = READING_USAGES - {"INPUT_ATTACHMENT"} if attachment.input else READING_USAGES
    unread = image.usage is not None and reading.isdisjoint(image.usage)
    # A picture that is stored last may be what the frame is for.
    shown = aspect.name == "color" and image.presentable is None and not (same_frame or presents)
    if unread and not shown:
        return True
    return False if commands and presents and not contents.has_twin(target) else None


def _put_undefined(
    facts: Facts, attachment: Attachment, aspect: Aspect, bound: Bound, contents: Contents
) -> None:
    """Whether the pass loads contents that were thrown away, or something reads what it throws
    away.
    """
    loads = _discard_before_load(attachment, bound, contents)
    if loads is not None:
        discard, same_frame = loads
        facts.put("aspect.reads_undefined", True, attachment.record.place(aspect.load_member))
        facts.put("aspect.loads_discarded", True)
        facts.put("aspect.discarded_by", discard.name, discard.place)
        facts.put("aspect.undefined_within_frame", same_frame)
        return
    reader = _reader_of_discarded(attachment, bound, contents)
    facts.put("aspect.reads_undefined", reader is not None)
    facts.put("aspect.loads_discarded", False)
    if reader is not None:
        event, same_frame = reader
        facts.places["aspect.reads_undefined"] = attachment.record.place(aspect.store_member)
        facts.put("aspect.discard_reader", event.name, event.place)
        facts.put("aspect.undefined_within_frame", same_frame)


def _discard_before_load(
    attachment: Attachment, bound: Bound, contents: Contents
) -> tuple[Event, bool] | None:
    """What threw away the contents that an attachment loads, in some frame, and whether in the same
    one.
    """
    found: tuple[Event, bool] | None = None
    for target, line in bound:
        for index in line.of(attachment, LOAD):
            before = line.last_write(index)
            event = line.events[before] if before is not None else None
            if (
                before is None
                or event is None
                or event.kind != DISCARD
                or not is_known(event)
                or not event.whole
            ):
                continue
            same_frame = line.same_frame(before, index)
            if (found is None or same_frame) and _unwritten_outside(target, same_frame, contents):
                found = event, same_frame
                if same_frame:
                    return found
    return found


def _reader_of_discarded(
    attachment: Attachment, bound: Bound, contents: Contents
) -> tuple[Event, bool] | None:
    """The command that reads what an attachment throws away, in some frame, and whether in the same
    one.
    """
    for target, line in bound:
        # A command does not say whether it reads depth or stencil.
        one_aspect = target.format is not None and len(target.format.aspects) == 1
        for index in line.of(attachment, DISCARD) if one_aspect else ():
            after = (index + 1) % len(line.events)
            same_frame = line.same_frame(index, after)
            if (
                line.events[index].whole
                and _certainly_reads(line, after)
                and _unwritten_outside(target, same_frame, contents)
            ):
                return line.events[after], same_frame
    return None


def _certainly_reads(line: AspectEvents, index: int) -> bool:
    """Whether a command reads, and not only may: a shader whose access is not stated, or that
    writes the image next, need not.
    """
    event = line.events[index]
    if event.kind not in COMMAND_READS or event.command is None:
        return False
    if not isinstance(event.command.body, ReadImage):
        return True
    return (
        event.command.body.access is not None
        and line.events[(index + 1) % len(line.events)].kind != WRITE
    )


def _unwritten_outside(target: Target, same_frame: bool, contents: Contents) -> bool:
    """Whether nothing that is not described can have written to an image between two events."""
    commands = contents.frame.has_commands
    if commands and (same_frame or contents.timeline.presents):
        return True
    image = target.image
    assert image is not None
    return (
        image.usage is not None
        and _WRITING_USAGES.isdisjoint(image.usage)
        and (same_frame or commands)
    )


def _put_commands_before(facts: Facts, attachment: Attachment, bound: Bound) -> None:
    """The clear before every run of the pass with the image, the copy before some run that loads
    it.
    """
    clears: list[Event | None] = []
    copy: Event | None = None
    for target, line in bound:
        if line.has_unknown(attachment):
            clears.append(None)
        for index in (*line.of(attachment, LOAD), *line.of(attachment, BEGIN)):
            before, begin = line.before(index), line.events[index]
            clears.append(before if before.kind == CLEAR and before.whole and begin.whole else None)
            if (
                begin.kind == LOAD
                and before.command is not None
                and before.kind in (COPY_WRITE, RESOLVE_WRITE)
                and plain(target)
            ):
                copy = copy or before
    first = clears[0] if clears and None not in clears else None
    if first is not None and facts.values.get("aspect.cleared_by_command") is False:
        facts.put("aspect.cleared_by_command", True, first.place)
        facts.put("aspect.clear_command", first.name, first.place)
    facts.put("aspect.copied_before", copy is not None)
    if copy is not None and isinstance(copy.command, Command):
        facts.put("aspect.copy_command", copy.name, copy.place)
        facts.put("aspect.copy_source", getattr(copy.command.body, "srcImage", None))
