"""What follows an event of an image, round the loop of the frame, within and between passes: who
uses what was written there.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property

from .commands import CLEAR, COPY_READ, PRESENT, READ, RESOLVE_READ, RESOLVE_WRITE
from .frame import Frame
from .parts import Attachment, Resolve
from .timeline import BEGIN, DISCARD, DRAW, ELSEWHERE, INPUT, LOAD, STORE, Event, EventRef, Timeline
from .walk import PassRun

_READS = frozenset({LOAD, DRAW, INPUT, RESOLVE_READ, READ, COPY_READ, PRESENT})
"""What makes use of what was there. A draw without a load uses what an earlier subpass made: it
blends or tests with it.
"""

ENDS = frozenset({BEGIN, CLEAR, DISCARD})
"""What ends what was there; a resolve that overwrites it aside."""

MIN_STEPS = 50_000
STEPS_PER_STRUCTURE = 32
"""How many events are looked at to find what follows: so many, and more by the structures of a
frame. A frame of some thousand passes takes some ten thousand.
"""


def is_unknown(event: Event) -> bool:
    """Whether it is unknown if a load, or a resolve, is one."""
    return not event.certain and event.kind in (LOAD, RESOLVE_READ, RESOLVE_WRITE)


def reads(event: Event) -> bool:
    """Whether an event certainly makes use of what was there."""
    return event.kind in _READS and event.certain


def every_time(event: Event) -> bool:
    """Whether an event concerns all of the image, each time that the frame runs."""
    # Of images that alternate from frame to frame, each is left as it was in every other frame.
    return event.whole and event.frames is None


class EventSearch:
    """Searches in the events of a frame's images, with a limit on all of them together."""

    def __init__(self, timeline: Timeline) -> None:
        self.timeline = timeline
        self.frame: Frame = timeline.frame
        self.steps_left = MIN_STEPS + STEPS_PER_STRUCTURE * self.frame.structures
        """How many events may still be looked at. Below 0, nothing more is known."""
        self._written_in: dict[int, dict[int, list[EventRef]]] = {}
        self._first_uses: dict[EventRef, tuple[Event | None, bool]] = {}

    @cached_property
    def of(self) -> dict[str, list[Event]]:
        """The events by image; none where their order is unknown."""
        if not self.timeline.ordered:
            return {}
        return {
            name: [event for event in events if event.kind != ELSEWHERE]
            for name, events in self.timeline.of.items()
            if name in self.frame.targets
        }

    @cached_property
    def _written(self) -> dict[tuple[int, str | None], list[EventRef]]:
        found: dict[tuple[int, str | None], list[EventRef]] = {}
        for name, events in self.of.items():
            for index, event in enumerate(events):
                if event.kind in (STORE, RESOLVE_WRITE) and event.certain:
                    aspect = event.aspect if event.kind == STORE else None
                    found.setdefault((id(event.source), aspect), []).append(EventRef(name, index))
        return found

    def written_at(self, source: Attachment | Resolve, aspect: str | None = None) -> list[EventRef]:
        """Where a resolve writes, or an aspect of an attachment is stored."""
        return self._written.get((id(source), aspect), [])

    def written_in(self, resolve: Resolve, run: PassRun | None) -> list[EventRef]:
        """Where a resolve writes in one run."""
        if id(resolve) not in self._written_in:
            by_run: dict[int, list[EventRef]] = {}
            for ref in self.written_at(resolve):
                by_run.setdefault(id(self.event(ref).run), []).append(ref)
            self._written_in[id(resolve)] = by_run
        return self._written_in[id(resolve)].get(id(run), [])

    def event(self, ref: EventRef) -> Event:
        """The event at a place."""
        return self.of[ref.image][ref.number]

    def after(self, ref: EventRef, aspect: str | None) -> Iterator[tuple[Event, bool]]:
        """What happens to an image after a place, round the loop up to that place; the second says
        whether that is in the next frame.
        """
        events = self.of[ref.image]
        count = len(events)
        for step in range(1, count + 1):
            event = events[(ref.number + step) % count]
            self.steps_left -= 1
            if self.steps_left < 0:
                return
            if event.aspect is None or aspect is None or event.aspect == aspect:
                yield event, ref.number + step >= count

    def first_use(self, ref: EventRef) -> tuple[Event | None, bool]:
        """What first reads what was written at a place, or ends it, or leaves that unknown; whether
        in the next frame.

        None where nothing does, or more happens than is looked at: see `steps_left`.
        """
        if ref not in self._first_uses:
            following = self.after(ref, self.event(ref).aspect)
            self._first_uses[ref] = next(
                ((event, later) for event, later in following if _decides(event)), (None, False)
            )
        return self._first_uses[ref]


def ends_contents(event: Event) -> bool:
    """Whether an event certainly ends all of what was there."""
    return every_time(event) and (
        event.kind in ENDS or (event.kind == RESOLVE_WRITE and event.certain)
    )


def _decides(event: Event) -> bool:
    return reads(event) or is_unknown(event) or ends_contents(event)
