"""Facts of what becomes of an aspect's contents: whether a store is for anybody, whether a load finds anything, what came just before it.

All instances of a pass are looked at: every time that a frame begins it, with every framebuffer.
"""

from __future__ import annotations

from msaa_lint.frame.description.models import Command, ReadImage

from .facts import Facts
from .frame import Aspect, Attachment, Pass, Target
from .moment import BEGUN, CLEARED, COPIED, DISCARDED, ELSEWHERE, LOADED, READ, STORED, UNKNOWN, WRITTEN, Line, Moment
from .moments import Moments, flags_of
from .timeline import READING_USAGES

_WRITING_USAGES = frozenset({"TRANSFER_DST", "STORAGE"})


def lifetime_facts(facts: Facts, each: Pass, attachment: Attachment, aspect: Aspect, moments: Moments) -> None:
    """Adds what the frame says of an aspect's contents before and after the pass."""
    lines: list[tuple[Target, Line]] = []
    if attachment.used and aspect.name is not None:
        lines = [(target, moments.line(target.name, aspect.name)) for target in attachment.targets if target.image is not None]
        _store(facts, each, attachment, aspect, lines, moments)
        _undefined(facts, attachment, aspect, lines, moments)
    if moments.writes and lines:
        _commands_before(facts, attachment, lines, moments)
    else:
        facts.put("aspect.copied_before", False)


def _store(facts: Facts, each: Pass, attachment: Attachment, aspect: Aspect, lines: list[tuple[Target, Line]], moments: Moments) -> None:
    """Whether anything reads what the pass stores, before it is overwritten or the frame comes round."""
    if aspect.store in ("DONT_CARE", "NONE") or "SUSPENDING" in flags_of(each):
        facts.put("aspect.store_wasted", False)
        return
    wasted: list[bool | None] = []
    certain = True
    ended: Moment | None = None
    for target, line in lines:
        if line.of(attachment, UNKNOWN):
            wasted.append(None)
        for index in line.of(attachment, STORED):
            decisive = line.decisive(index)
            end = line.moments[decisive] if decisive is not None else None
            if end is not None and end.kind in (READ, LOADED, UNKNOWN, ELSEWHERE):
                wasted.append(False if end.kind in (READ, LOADED) else None)
                continue
            within = decisive is not None and line.within_frame(index, decisive)
            sure = _unread_outside(target, attachment, aspect, within, moments)
            wasted.append(True if sure is not None else None)
            certain = certain and sure is True
            ended = ended or end
    answer = None if not wasted or None in wasted else True
    if False in wasted:
        answer = False
    facts.put("aspect.store_wasted", answer)
    if answer:
        facts.put("aspect.waste_certain", certain)
        if ended is not None:
            facts.put("aspect.overwritten_by", ended.name, ended.at)


def _unread_outside(target: Target, attachment: Attachment, aspect: Aspect, within: bool, moments: Moments) -> bool | None:
    """Whether nothing that is not described reads what is left in an image: True by its usage, or as the commands leave no time for it;
    False where only the commands of a whole frame speak for it; None where something may.

    `within`: it is overwritten in the frame that stored it. Images that change places from frame to frame, a history and what becomes it,
    look in one frame like one that nobody reads and one that nobody writes.
    """
    image = target.image
    assert image is not None
    commands = moments.frame.has_commands
    if commands and within:
        return True
    if moments.read_when_idle(target.name) or image.presentable:
        return None
    # Its own pass reads an input attachment before it stores it; others of the frame are described.
    reading = READING_USAGES - {"INPUT_ATTACHMENT"} if attachment.input else READING_USAGES
    unread = image.usage is not None and reading.isdisjoint(image.usage)
    # A picture that is stored last may be what the frame is for.
    shown = aspect.name == "color" and image.presentable is None and not (within or moments.presents)
    if unread and not shown:
        return True
    return False if commands and moments.presents and not moments.has_twin(target) else None


def _undefined(facts: Facts, attachment: Attachment, aspect: Aspect, lines: list[tuple[Target, Line]], moments: Moments) -> None:
    """Whether the pass loads contents that were thrown away, or something reads what it throws away."""
    loads = _loaded(attachment, lines, moments)
    if loads is not None:
        facts.put("aspect.reads_undefined", True, attachment.record.place(aspect.load_member))
        facts.put("aspect.loads_discarded", True)
        facts.put("aspect.discarded_by", loads[0].name, loads[0].at)
        facts.put("aspect.undefined_within_frame", loads[1])
        return
    reader = _reader_of_nothing(attachment, lines, moments)
    facts.put("aspect.reads_undefined", reader is not None)
    facts.put("aspect.loads_discarded", False)
    if reader is not None:
        facts.places["aspect.reads_undefined"] = attachment.record.place(aspect.store_member)
        facts.put("aspect.discard_reader", reader[0].name, reader[0].at)
        facts.put("aspect.undefined_within_frame", reader[1])


def _loaded(attachment: Attachment, lines: list[tuple[Target, Line]], moments: Moments) -> tuple[Moment, bool] | None:
    """What threw away the contents that an attachment loads, in some frame, and whether in the same one."""
    found: tuple[Moment, bool] | None = None
    for target, line in lines:
        for index in line.of(attachment, LOADED):
            before = line.written(index)
            if before is None or line.moments[before].kind != DISCARDED or not line.moments[before].whole:
                continue
            within = line.within_frame(before, index)
            if (found is None or within) and _unwritten_outside(target, within, moments):
                found = line.moments[before], within
                if within:
                    return found
    return found


def _reader_of_nothing(attachment: Attachment, lines: list[tuple[Target, Line]], moments: Moments) -> tuple[Moment, bool] | None:
    """The command that reads what an attachment throws away, in some frame, and whether in the same one."""
    for target, line in lines:
        # A command does not say whether it reads depth or stencil.
        one = target.format is not None and len(target.format.aspects) == 1
        for index in line.of(attachment, DISCARDED) if one else ():
            after = (index + 1) % len(line.moments)
            within = line.within_frame(index, after)
            if line.moments[index].whole and _certainly_reads(line, after) and _unwritten_outside(target, within, moments):
                return line.moments[after], within
    return None


def _certainly_reads(line: Line, index: int) -> bool:
    """Whether a command reads, and not only may: a shader whose access is not stated, or that writes the image next, need not."""
    moment = line.moments[index]
    if moment.kind != READ or not isinstance(moment.of, Command):
        return False
    if not isinstance(moment.of.body, ReadImage):
        return True
    return moment.of.body.access is not None and line.moments[(index + 1) % len(line.moments)].kind != WRITTEN


def _unwritten_outside(target: Target, within: bool, moments: Moments) -> bool:
    """Whether nothing that is not described can have written to an image between two moments."""
    if moments.frame.has_commands and (within or moments.presents):
        return True
    image = target.image
    assert image is not None
    return image.usage is not None and _WRITING_USAGES.isdisjoint(image.usage) and (within or moments.frame.has_commands)


def _commands_before(facts: Facts, attachment: Attachment, lines: list[tuple[Target, Line]], moments: Moments) -> None:
    """The clear before every time that the pass begins with the image, the copy before some time that it loads it."""
    cleared: list[Moment | None] = []
    copied: Moment | None = None
    for target, line in lines:
        if line.of(attachment, UNKNOWN):
            cleared.append(None)
        for index in (*line.of(attachment, LOADED), *line.of(attachment, BEGUN)):
            before, own = line.moments[line.before(index)], line.moments[index]
            cleared.append(before if before.kind == CLEARED and before.whole and own.whole else None)
            if own.kind == LOADED and before.kind == COPIED and moments.plain(target.name):
                copied = copied or before
    first = cleared[0] if cleared and None not in cleared else None
    if first is not None and facts.values.get("aspect.cleared_by_command") is False:
        facts.put("aspect.cleared_by_command", True, first.at)
        facts.put("aspect.clear_command", first.name, first.at)
    facts.put("aspect.copied_before", copied is not None)
    if copied is not None and isinstance(copied.of, Command):
        facts.put("aspect.copy_command", copied.name, copied.at)
        facts.put("aspect.copy_source", getattr(copied.of.body, "srcImage", None))
