"""What becomes of a resolve's result: whether anything reads it, whether it is only copied on,
whether the samples are resolved again.
"""

from __future__ import annotations

from functools import cached_property
from typing import NamedTuple

from msaa_lint.core.text.span import Span
from msaa_lint.frame.description.models import Command
from msaa_lint.frame.devices import DeviceProfile

from .barriers import Waits
from .commands import (
    COPY_READ,
    COPY_WRITE,
    PRESENT,
    RESOLVE_READ,
    RESOLVE_WRITE,
    WRITE,
    image_of,
    naming_records,
)
from .event_search import ENDS, EventSearch, ends_contents, every_time, is_unknown, reads
from .facts import Facts, known
from .frame import Frame
from .parts import Resolve, Target
from .readers import READING_USAGES, Readers
from .timeline import DRAW, STORE, Event, EventRef

SAME, DIFFERENT, NOT_STATED = "SAME", "DIFFERENT", "NOT_STATED"

_COPIES = ("copyImage", "blitImage")


class ResolveUses:
    """What becomes of the results of a frame's resolves."""

    def __init__(
        self, search: EventSearch, readers: Readers, device: DeviceProfile | None = None
    ) -> None:
        self.search = search
        self.frame: Frame = search.frame
        self.readers = readers
        self.device = device

    @cached_property
    def _presented(self) -> set[str]:
        stated = {
            name
            for name, target in self.frame.targets.items()
            if target.image and target.image.presentable
        }
        return stated | {
            name
            for name, events in self.search.of.items()
            if any(event.kind == PRESENT for event in events)
        }

    @cached_property
    def _waits(self) -> Waits:
        return Waits(self.search)

    @cached_property
    def _barred(self) -> set[str]:
        """The images that barriers name."""
        return {
            name
            for command in self.frame.commands
            if command.kind == "pipelineBarrier"
            for _, name in naming_records(command)
        }

    @cached_property
    def _repetitions(self) -> dict[int, _Repetition]:
        return _repetitions(self)

    def put(self, facts: Facts, resolve: Resolve) -> None:
        """Adds what is known of what becomes of a resolve: of one that may resolve nothing, nothing
        is.
        """
        if resolve.mode == "NONE":
            for name in ("resolve.target_stored", "resolve.repeats", "resolve.resolved_anew"):
                facts.put(name, False)
        if resolve.mode in (None, "NONE") and resolve.kind != "command":
            return
        self._put_read(facts, resolve)
        self._put_copied(facts, resolve)
        self._put_repeated(facts, resolve)
        self._waits.put(facts, resolve)

    # Whether anything reads it.

    def _put_read(self, facts: Facts, resolve: Resolve) -> None:
        target = resolve.target
        kept: bool | None = True
        if target is not None:
            stores = [
                aspect.store for aspect in target.aspects if aspect.name in (resolve.aspect, None)
            ]
            unread = resolve.render_pass is not None and resolve.render_pass.unread
            kept = "STORE" in stores or (None if not stores or None in stores or unread else False)
        facts.put("resolve.target_stored", kept)
        facts.put("resolve.target_read", self.is_read(resolve), resolve.target_at)
        facts.put("resolve.may_be_none", self._may_be_none(resolve))
        image = resolve.target_image.image if resolve.target_image is not None else None
        if image is not None and image.usage is not None:
            readable = not READING_USAGES.isdisjoint(image.usage)
            facts.put(
                "resolve.target_readable",
                readable,
                image.flag_place("usage", READING_USAGES) if readable else None,
            )

    def _may_be_none(self, resolve: Resolve) -> bool | None:
        """Whether the aspect may go unresolved: beside one that is resolved for a reader, that
        takes independentResolveNone.
        """
        pair = resolve.pair
        if (
            pair is None
            or pair.mode == "NONE"
            or pair.render_pass is None
            or self.is_read(pair) is False
        ):
            return True
        offered = self.device is not None and (
            self.device.independent_resolve or self.device.independent_resolve_none
        )
        if offered or self.device is None:
            return True if offered else None
        return (
            None if self.device.minimum or self.device.independent_resolve_none is None else False
        )

    def is_read(self, resolve: Resolve) -> bool | None:
        """Whether something reads what a resolve writes, before it is overwritten."""
        target, render_pass = resolve.target, resolve.render_pass
        if target is not None and render_pass is not None:
            used = (
                target.color if resolve.aspect == "color" else target.depth_stencil
            ) | target.input
            if any(index > resolve.subpass for index in used) or target.input:
                return True
            aspect = next(
                (aspect for aspect in target.aspects if aspect.name in (resolve.aspect, None)), None
            )
            return (
                self.readers.read_later(render_pass, target, aspect) if aspect is not None else None
            )
        answers = [self._read_at(ref) for ref in self.search.written_at(resolve)]
        return True if True in answers else None if not answers or None in answers else False

    def _read_at(self, ref: EventRef) -> bool | None:
        """Whether something reads what is written at a place, as far as commands say."""
        event, _ = self.search.first_use(ref)
        if event is not None and reads(event):
            return True
        unknown = self.search.steps_left < 0 if event is None else is_unknown(event)
        return None if unknown or self.frame.may_be_read(ref.image) else False

    # Whether it is only copied on.

    def _put_copied(self, facts: Facts, resolve: Resolve) -> None:
        written = (
            self.search.written_at(resolve)
            if resolve.aspect == "color" and self.frame.has_commands
            else []
        )
        copies = [copy for copy in map(self._copy_of, written) if copy is not None]
        facts.put("resolve.only_copied", bool(copies) and len(copies) == len(written))
        if not copies or len(copies) < len(written):
            return
        command, source, target = copies[0]
        facts.put("resolve.copied_by", command.kind, command.head)
        facts.put("resolve.copied_to", target.title, command.head)
        facts.put("resolve.copied_from", source.title)
        facts.put("resolve.copy_fits", _fits(source, target))
        facts.put("resolve.copy_barred", not self._barred.isdisjoint((source.name, target.name)))

    def _copy_of(self, ref: EventRef) -> tuple[Command, Target, Target] | None:
        """The command that copies what is written at a place to a presentable image, the image and
        that one, if nothing else uses it.
        """
        written = self.search.event(ref)
        if (
            not every_time(written)
            or ref.image in self._presented
            or self.frame.may_be_read(ref.image)
        ):
            return None
        copy: Command | None = None
        for event, next_frame in self.search.after(ref, written.aspect):
            if event.kind == STORE:
                continue
            if is_unknown(event) or (copy is None and (next_frame or event.kind != COPY_READ)):
                return None
            if copy is None:
                copy = event.command
            elif reads(event):
                return None
            elif ends_contents(event):
                break
        if copy is None or copy.kind not in _COPIES or self.search.steps_left < 0:
            return None
        source, target = self.frame.target(ref.image), self.frame.target(image_of(copy, COPY_WRITE))
        if (
            source is None
            or target is None
            or target.name not in self._presented
            or not self._fills(target, copy)
        ):
            return None
        return copy, source, target

    def _fills(self, target: Target, copy: Command) -> bool:
        """Whether a presentable image is written by one copy alone, before anything is drawn over
        it, each time until it is presented.
        """
        events = self.search.of.get(target.name, [])
        self.search.steps_left -= len(events)
        write = next(
            (
                index
                for index, event in enumerate(events)
                if event.kind == COPY_WRITE and event.command is copy
            ),
            None,
        )
        if (
            self.search.steps_left < 0
            or write is None
            or target.image is None
            or (target.image.arrayLayers or 1) > 1
        ):
            return False
        for step in range(1, len(events)):
            event = events[write - step]
            if event.kind == PRESENT:
                break
            # A clear by command leaves a border, where the copy is smaller.
            if event.kind not in ENDS or (
                event.command is not None and event.command.kind != "pipelineBarrier"
            ):
                return False
        for event in events[write + 1 :]:
            if event.kind == PRESENT:
                break
            if event.kind in (*ENDS, RESOLVE_WRITE, COPY_WRITE, WRITE) or is_unknown(event):
                return False
        return True

    # Whether the samples are resolved again.

    def unread(self, resolve: Resolve, taken: Event) -> bool | None:
        """Whether nothing reads what a resolve wrote, the time that it took the samples so."""
        answers = [self._unread_at(ref) for ref in self.search.written_in(resolve, taken.run)]
        return False if False in answers else None if not answers or None in answers else True

    def _unread_at(self, ref: EventRef) -> bool | None:
        written = self.search.event(ref)
        event, next_frame = self.search.first_use(ref)
        if (event is None and self.search.steps_left < 0) or self.frame.may_be_read(ref.image):
            return None
        if (
            event is not None
            and event.run is written.run
            and written.run is not None
            and not next_frame
        ):
            # What the pass throws away itself is another mistake.
            return None if is_unknown(event) else event.kind == RESOLVE_WRITE
        target = self.frame.target(ref.image)
        image = target.image if target is not None else None
        if event is None and image is not None and image.presentable:
            return False
        if event is not None and (reads(event) or is_unknown(event)):
            return None if is_unknown(event) else False
        if self.frame.has_commands:
            return True
        # Without commands a usage that allows reading is taken as used.
        usage = image.usage if image is not None else None
        return None if usage is None else READING_USAGES.isdisjoint(usage)

    def _put_repeated(self, facts: Facts, resolve: Resolve) -> None:
        found = self._repetitions.get(id(resolve), _Repetition())
        facts.put("resolve.repeats", found.repeats, found.first_at if found.repeats else None)
        facts.put(
            "resolve.resolved_anew", found.drawn_on, found.next_at if found.drawn_on else None
        )
        if id(resolve) in self._repetitions:
            facts.put("resolve.again_by_command", found.by_command)
            facts.put("resolve.again_to_same_target", found.same_target)
            facts.put("resolve.again_on_tile", known(found.one_pass, found.same_target))


class _Repetition(NamedTuple):
    """What other resolves of the same samples make of one. None where that is not known."""

    repeats: bool | None = False
    """An earlier one of the frame took the same samples, with nothing drawn since."""
    drawn_on: bool | None = False
    """A later one takes them with more drawn on them, and nothing reads what this one wrote."""
    by_command: bool = False
    same_target: bool | None = None
    one_pass: bool = False
    first_at: Span | None = None
    next_at: Span | None = None


class _Since:
    """What happened to samples since they were resolved."""

    __slots__ = ("drawn", "ended", "taken", "unknown")

    def __init__(self, taken: Event) -> None:
        self.taken = taken
        self.drawn = self.ended = self.unknown = False

    def add(self, event: Event) -> None:
        self.drawn |= event.kind in (DRAW, COPY_WRITE, WRITE)
        self.ended |= event.kind in ENDS or (event.kind == RESOLVE_WRITE and event.certain)
        self.unknown |= is_unknown(event)


def _repetitions(uses: ResolveUses) -> dict[int, _Repetition]:
    """By the identity of a resolve: what the next and the last resolve of the same samples in the
    frame make of it.
    """
    found: dict[int, _Repetition] = {}
    for events in uses.search.of.values():
        since: dict[str, _Since] = {}
        for event in events:
            resolve = event.source
            if event.kind != RESOLVE_READ or not event.certain or not isinstance(resolve, Resolve):
                for aspect, state in since.items():
                    if event.aspect in (None, aspect):
                        state.add(event)
                continue
            before = since.get(resolve.aspect)
            if before is not None and not before.ended:
                _pair(uses, before, event, found)
            since[resolve.aspect] = _Since(event)
    return found


def _pair(uses: ResolveUses, since: _Since, event: Event, found: dict[int, _Repetition]) -> None:
    first, second = since.taken.source, event.source
    assert isinstance(first, Resolve) and isinstance(second, Resolve)
    # Of a part each, they may be of different parts; by different modes they are different
    # pictures.
    if (
        not (every_time(since.taken) and every_time(event))
        or first.mode is None
        or first.mode != second.mode
    ):
        return
    same = (
        first.target_image is second.target_image
        if None not in (first.target_image, second.target_image)
        else None
    )
    by_command = "command" in (first.kind, second.kind)
    one_pass = event.run is not None and event.run is since.taken.run
    if not since.drawn:
        repeats = None if since.unknown else True
        repetition = found.get(id(second), _Repetition())._replace(
            repeats=repeats, first_at=first.target_at
        )
        found[id(second)] = repetition._replace(
            by_command=by_command, same_target=same, one_pass=one_pass
        )
        return
    if first.aspect != "color" and uses.is_read(first) is False and uses.is_read(second) is False:
        # Each of them is one too many: not the first alone.
        return
    unread = None if since.unknown else uses.unread(first, since.taken)
    if unread is not False:
        repetition = found.get(id(first), _Repetition())._replace(
            drawn_on=unread, next_at=second.target_at
        )
        found[id(first)] = repetition._replace(
            by_command=by_command, same_target=same, one_pass=one_pass
        )


def _fits(source: Target, target: Target) -> str:
    """Whether two images have the same format, width and height, so that a resolve can write the
    one in place of the other.
    """
    sizes = zip(source.size or (None, None), target.size or (None, None), strict=True)
    pairs = [(source.format, target.format), *sizes]
    if any(a is not None and b is not None and a != b for a, b in pairs):
        return DIFFERENT
    return NOT_STATED if any(None in pair for pair in pairs) else SAME
