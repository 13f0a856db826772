"""What becomes of a resolve's result: whether anything reads it, whether it is only copied on, whether the samples are resolved again."""

from __future__ import annotations

from typing import NamedTuple

from msaa_lint.core.text.span import Span
from msaa_lint.frame.description.models import Command, ImageBarrier, PipelineBarrier
from msaa_lint.frame.devices import DeviceProfile

from .barriers import Waits
from .events import CLEAR, COPY, DRAW, PRESENT, READS, RESOLVE, STORE, TAKE, UNKNOWN, WRITE, Event, Events, Spot
from .facts import Facts, known
from .frame import Frame, Resolve, Target
from .timeline import READING_USAGES, Timeline

SAME, DIFFERENT, NOT_STATED = "SAME", "DIFFERENT", "NOT_STATED"

_COPIES = ("copyImage", "blitImage")


class Results:
    """The results of a frame's resolves. What happens to the images is laid out when it is first asked."""

    def __init__(self, frame: Frame, timeline: Timeline, device: DeviceProfile | None = None) -> None:
        self.frame = frame
        self.timeline = timeline
        self.device = device
        self._events: Events | None = None
        self._again: dict[int, _Again] | None = None
        self._waits: Waits | None = None
        self._presented: set[str] = set()
        self._barred: set[str] | None = None

    @property
    def events(self) -> Events:
        if self._events is None:
            self._events = Events(self.frame)
            self._presented = {name for name, target in self.frame.targets.items() if target.image and target.image.presentable}
            self._presented.update(name for name, events in self._events.of.items() if any(event.kind == PRESENT for event in events))
        return self._events

    def put(self, facts: Facts, resolve: Resolve) -> None:
        """Adds what is known of what becomes of a resolve. Of one that resolves nothing, or may not, nothing is."""
        if resolve.mode in (None, "NONE") and resolve.kind != "command":
            return
        self._read(facts, resolve)
        self._copied(facts, resolve)
        self._repeated(facts, resolve)
        if self._waits is None:
            self._waits = Waits(self.frame, self.events)
        self._waits.put(facts, resolve)

    # Whether anything reads it.

    def _read(self, facts: Facts, resolve: Resolve) -> None:
        target = resolve.target
        kept: bool | None = True
        if target is not None:
            stores = [aspect.store for aspect in target.aspects if aspect.name in (resolve.aspect, None)]
            kept = None if not stores or None in stores else "STORE" in stores
        facts.put("resolve.target_stored", kept)
        facts.put("resolve.target_read", self.is_read(resolve), resolve.target_at)
        facts.put("resolve.may_be_none", self._may_be_none(resolve))
        image = resolve.target_image.image if resolve.target_image is not None else None
        if image is not None and image.usage is not None:
            readable = not READING_USAGES.isdisjoint(image.usage)
            facts.put("resolve.target_readable", readable, image.flag_place("usage", READING_USAGES) if readable else None)

    def _may_be_none(self, resolve: Resolve) -> bool | None:
        """Whether the aspect may go unresolved: beside one that is resolved for a reader, that takes independentResolveNone."""
        pair = resolve.pair
        if pair is None or pair.mode == "NONE" or pair.within is None or self.is_read(pair) is False:
            return True
        offered = self.device is not None and (self.device.independent_resolve or self.device.independent_resolve_none)
        if offered or self.device is None:
            return True if offered else None
        return None if self.device.minimum or self.device.independent_resolve_none is None else False

    def is_read(self, resolve: Resolve) -> bool | None:
        """Whether something reads what a resolve writes, before it is overwritten."""
        target, within = resolve.target, resolve.within
        if target is not None and within is not None:
            used = (target.color if resolve.aspect == "color" else target.depth_stencil) | target.input
            if any(index > resolve.subpass for index in used) or target.input:
                return True
            aspect = next((aspect for aspect in target.aspects if aspect.name in (resolve.aspect, None)), None)
            return self.timeline.read_later(within, target, aspect) if aspect is not None else None
        answers = [self._read_at(spot) for spot in self.events.written.get(id(resolve), ())]
        return True if True in answers else None if not answers or None in answers else False

    def _read_at(self, spot: Spot) -> bool | None:
        """Whether something reads what is written at a place, as far as commands say."""
        event, _ = self.events.use_of(spot)
        if event is None:
            return None if self.events.left < 0 else False
        return None if event.kind == UNKNOWN else event.kind in READS

    # Whether it is only copied on.

    def _copied(self, facts: Facts, resolve: Resolve) -> None:
        found = [self._copy_of(spot) for spot in self._spots(resolve)] if resolve.aspect == "color" and self.frame.has_commands else []
        copies = [each for each in found if each is not None]
        facts.put("resolve.only_copied", bool(copies) and len(copies) == len(found))
        if not copies or len(copies) < len(found):
            return
        command, source, target = copies[0]
        facts.put("resolve.copied_by", command.kind, command.head)
        facts.put("resolve.copied_to", target.title, command.head)
        facts.put("resolve.copied_from", source.title)
        facts.put("resolve.copy_fits", _fits(source, target))
        if self._barred is None:
            self._barred = _barred(self.frame)
        facts.put("resolve.copy_barred", not self._barred.isdisjoint((source.name, target.name)))

    def _spots(self, resolve: Resolve) -> list[Spot]:
        return self.events.written.get(id(resolve), [])

    def _copy_of(self, spot: Spot) -> tuple[Command, Target, Target] | None:
        """The command that copies what is written at a place to a presentable image, the image and that one, if nothing else uses it."""
        events = self.events
        at = events.of[spot.image][spot.at]
        if not at.whole or spot.image in self._presented:
            return None
        copy: Command | None = None
        for event, later in events.after(spot, at.aspect):
            if event.kind == STORE:
                continue
            if event.kind == UNKNOWN or (copy is None and (later or event.kind != COPY)):
                return None
            if copy is None and isinstance(event.of, Command):
                copy = event.of
            elif event.kind in READS:
                return None
            elif event.whole and event.kind in (CLEAR, RESOLVE):
                break
        if copy is None or copy.kind not in _COPIES or events.left < 0:
            return None
        source, target = self.frame.target(spot.image), self.frame.target(getattr(copy.body, "dstImage", None))
        if source is None or target is None or target.name not in self._presented or not self._fills(target, copy):
            return None
        return copy, source, target

    def _fills(self, target: Target, copy: Command) -> bool:
        """Whether a presentable image is written by one copy alone, before anything is drawn over it, each time until it is presented."""
        events = self.events.of.get(target.name, [])
        self.events.left -= len(events)
        own = next((index for index, event in enumerate(events) if event.kind == WRITE and event.of is copy), None)
        if self.events.left < 0 or own is None or target.image is None or (target.image.arrayLayers or 1) > 1:
            return False
        for step in range(1, len(events)):
            event = events[own - step]
            if event.kind == PRESENT:
                break
            # A clear by command leaves a border, where the copy is smaller.
            if event.kind != CLEAR or (isinstance(event.of, Command) and event.of.kind != "pipelineBarrier"):
                return False
        for event in events[own + 1 :]:
            if event.kind == PRESENT:
                break
            if event.kind in (CLEAR, RESOLVE, UNKNOWN) or (event.kind == WRITE and isinstance(event.of, Command)):
                return False
        return True

    # Whether the samples are resolved again.

    def unread(self, resolve: Resolve, taken: Event) -> bool | None:
        """Whether nothing reads what a resolve wrote, the time that it took the samples so."""
        answers = [self._unread_at(s) for s in self._spots(resolve) if self.events.of[s.image][s.at].run is taken.run]
        return False if False in answers else None if not answers or None in answers else True

    def _unread_at(self, spot: Spot) -> bool | None:
        own = self.events.of[spot.image][spot.at]
        event, later = self.events.use_of(spot)
        if event is None and self.events.left < 0:
            return None
        if event is not None and event.run is own.run and own.run is not None and not later:
            # What the pass throws away itself is another mistake.
            return None if event.kind == UNKNOWN else event.kind == RESOLVE
        target = self.frame.target(spot.image)
        image = target.image if target is not None else None
        if event is None and image is not None and image.presentable:
            return False
        if event is not None and (event.kind in READS or event.kind == UNKNOWN):
            return None if event.kind == UNKNOWN else False
        if self.frame.has_commands:
            return True
        # Without commands a usage that allows reading is taken as used.
        usage = image.usage if image is not None else None
        return None if usage is None else READING_USAGES.isdisjoint(usage)

    def _repeated(self, facts: Facts, resolve: Resolve) -> None:
        if self._again is None:
            self._again = _again(self)
        found = self._again.get(id(resolve))
        repeats, drawn = (found.repeats, found.drawn_on) if found is not None else (False, False)
        facts.put("resolve.repeats", repeats, found.first_at if found is not None and repeats else None)
        facts.put("resolve.resolved_anew", drawn, found.next_at if found is not None and drawn else None)
        if found is not None:
            facts.put("resolve.again_by_command", found.by_command)
            facts.put("resolve.again_to_same_target", found.same_target)
            facts.put("resolve.again_on_tile", known(found.one_pass, found.same_target))


class _Again(NamedTuple):
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

    def happens(self, event: Event) -> None:
        self.drawn |= event.kind in (DRAW, WRITE)
        self.ended |= event.kind in (CLEAR, RESOLVE)
        self.unknown |= event.kind == UNKNOWN


def _again(results: Results) -> dict[int, _Again]:
    """By the identity of a resolve: what the next and the last resolve of the same samples in the frame make of it."""
    found: dict[int, _Again] = {}
    for events in results.events.of.values():
        since: dict[str, _Since] = {}
        for event in events:
            if event.kind != TAKE or not isinstance(event.of, Resolve):
                for aspect, state in since.items():
                    if event.aspect in (None, aspect):
                        state.happens(event)
                continue
            before = since.get(event.of.aspect)
            if before is not None and not before.ended:
                _pair(results, before, event, found)
            since[event.of.aspect] = _Since(event)
    return found


def _pair(results: Results, since: _Since, event: Event, found: dict[int, _Again]) -> None:
    first, second = since.taken.of, event.of
    assert isinstance(first, Resolve) and isinstance(second, Resolve)
    # Of a part each, they may be of different parts; by different modes they are different pictures.
    if not (since.taken.whole and event.whole) or first.mode is None or first.mode != second.mode:
        return
    by_command = "command" in (first.kind, second.kind)
    one_pass = event.run is not None and event.run is since.taken.run
    same = first.target_image is second.target_image if None not in (first.target_image, second.target_image) else None
    if not since.drawn:
        answer = None if since.unknown else True
        known_of = found.get(id(second), _Again())._replace(repeats=answer, first_at=first.target_at)
        found[id(second)] = known_of._replace(by_command=by_command, same_target=same, one_pass=one_pass)
        return
    unread = None if since.unknown else results.unread(first, since.taken)
    if unread is not False:
        known_of = found.get(id(first), _Again())._replace(drawn_on=unread, next_at=second.target_at)
        found[id(first)] = known_of._replace(by_command=by_command, same_target=same, one_pass=one_pass)


def _barred(frame: Frame) -> set[str]:
    """The images that barriers name."""
    named = (each for command in frame.commands if isinstance(command.body, PipelineBarrier) for each in command.body.images)
    return {name for each in named if (name := each.image if isinstance(each, ImageBarrier) else each) is not None}


def _fits(source: Target, target: Target) -> str:
    """Whether two images have the same format, width and height, so that a resolve can write the one in place of the other."""
    one = source.image.extent if source.image is not None else None
    other = target.image.extent if target.image is not None else None
    sizes = [(extent.width, extent.height) if extent is not None else (None, None) for extent in (one, other)]
    pairs = [(source.format, target.format), *zip(*sizes, strict=True)]
    if any(a is not None and b is not None and a != b for a, b in pairs):
        return DIFFERENT
    return NOT_STATED if any(None in pair for pair in pairs) else SAME
