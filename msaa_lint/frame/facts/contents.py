"""All that happens to one aspect of an image, round the loop of the frame.

Where framebuffers alternate, as many frames are laid out as it takes for all of them to come round.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cached_property
from math import lcm

from .commands import CLEAR, COMMAND_READS, COMMAND_WRITES, RESOLVE_WRITE, WRITE
from .frame import Frame
from .parts import RENDERING, Attachment, Resolve, Target
from .timeline import (
    BEGIN,
    DISCARD,
    ELSEWHERE,
    INPUT,
    LOAD,
    MAX_FRAMES,
    SOME_FRAMES,
    STORE,
    Event,
    Timeline,
    discards_all,
)

READS = frozenset({LOAD, *COMMAND_READS})


def is_known(event: Event) -> bool:
    """Whether what an event does to the contents is known."""
    return event.kind != ELSEWHERE and event.certain and event.frames is not SOME_FRAMES


class AspectEvents:
    """The events of one aspect of an image that load, write or end its contents, and to which of
    the frames laid out each belongs.

    What passes do between their load and store operations is left out.
    """

    def __init__(self, events: list[Event]) -> None:
        periods = [
            event.frames[0] for event in events if event.frames and event.frames is not SOME_FRAMES
        ]
        self.events = events
        self.frames = [0] * len(events)
        if periods:
            self._lay_out(lcm(*periods))

    def _lay_out(self, count: int) -> None:
        stated, self.events, self.frames = self.events, [], []
        for frame in range(count if count <= MAX_FRAMES else 0):
            for event in stated:
                if (
                    event.frames is None
                    or event.frames is SOME_FRAMES
                    or frame % event.frames[0] in event.frames[1]
                ):
                    self.events.append(event)
                    self.frames.append(frame)

    @cached_property
    def _of_attachments(self) -> dict[int, list[int]]:
        found: dict[int, list[int]] = {}
        for index, event in enumerate(self.events):
            if isinstance(event.source, Attachment) and event.kind != ELSEWHERE:
                found.setdefault(id(event.source), []).append(index)
        return found

    def of(self, attachment: Attachment, *kinds: str) -> Sequence[int]:
        """The known events of some kinds that an attachment has."""
        indices = self._of_attachments.get(id(attachment), ())
        return [
            index
            for index in indices
            if self.events[index].kind in kinds and is_known(self.events[index])
        ]

    def has_unknown(self, attachment: Attachment) -> bool:
        """Whether what an attachment does to the contents is unknown, some time."""
        return any(
            not is_known(self.events[index])
            for index in self._of_attachments.get(id(attachment), ())
        )

    @cached_property
    def never_loads(self) -> bool:
        """Whether all of them are known, and none is a load."""
        return all(is_known(event) and event.kind != LOAD for event in self.events)

    def _is_decisive(self, index: int) -> bool:
        """Whether an event ends the life of what was there, reads it, or may do either; what writes
        after a barrier from UNDEFINED does.
        """
        event, before = self.events[index], self.before(index)
        return _decides(event) or (
            _overwrites_in_part(event) and is_known(before) and discards_all(before)
        )

    def before(self, index: int) -> Event:
        """The event before one, round the loop."""
        return self.events[(index - 1) % len(self.events)]

    def same_frame(self, first: int, second: int) -> bool:
        """Whether the second of two events follows the first before the frame ends."""
        return first < second and self.frames[first] == self.frames[second]

    def next_decisive(self, index: int) -> int | None:
        """The next event, round the loop, that ends the life of what was there, reads it, or may do
        either.
        """
        return self._decisive[index]

    def last_write(self, index: int) -> int | None:
        """The last event before, round the loop, that does not read."""
        return self._writes[index]

    @cached_property
    def _decisive(self) -> list[int | None]:
        return self._nearest([*reversed(range(len(self.events)))], self._is_decisive)

    @cached_property
    def _writes(self) -> list[int | None]:
        return self._nearest(
            [*range(len(self.events))], lambda index: not _is_known_read(self.events[index])
        )

    def _nearest(self, order: list[int], accepts: Callable[[int], bool]) -> list[int | None]:
        """For each event the accepted one that comes nearest before it in an order that goes round;
        itself, where there is no other.
        """
        found: list[int | None] = [None] * len(order)
        nearest: int | None = None
        for index in order * 2:
            found[index] = nearest
            if accepts(index):
                nearest = index
        return found


class Contents:
    """The contents of a frame's images over time."""

    def __init__(self, timeline: Timeline) -> None:
        self.timeline = timeline
        self.frame: Frame = timeline.frame
        self._aspects: dict[tuple[str, str], AspectEvents] = {}

    def of(self, image: str, aspect: str) -> AspectEvents:
        """What happens to one aspect of an image; nothing where the order is unknown."""
        key = (image, aspect)
        if key not in self._aspects:
            events = self.timeline.of.get(image, ()) if self.timeline.ordered else ()
            self._aspects[key] = AspectEvents(
                [event for event in events if event.aspect in (None, aspect) and _counts(event)]
            )
        return self._aspects[key]

    def read_when_idle(self, image: str) -> bool:
        """Whether a pass that the commands never begin would read it."""
        return image in self._idle_reads

    @cached_property
    def _idle_reads(self) -> set[str]:
        return {
            image
            for image, events in self.timeline.idle.items()
            if any(event.kind in (LOAD, INPUT) for event in events)
        }

    def has_twin(self, target: Target) -> bool:
        """Whether the frame reads an image of the same format, samples and size that it never
        writes.
        """
        return _likeness(target) in self._unwritten

    @cached_property
    def _unwritten(self) -> set[object]:
        found: set[object] = set()
        for name, events in self.timeline.of.items() if self.timeline.ordered else ():
            target = self.frame.target(name)
            counted = [event for event in events if _counts(event)]
            if (
                target is not None
                and counted
                and all(event.kind in READS and is_known(event) for event in counted)
            ):
                found.add(_likeness(target))
        return found


def _counts(event: Event) -> bool:
    """Whether an event loads, writes or ends contents that outlive a pass."""
    if isinstance(event.source, Resolve) and event.command is None:
        # In a render pass the target's load and store operations say it.
        return event.kind == RESOLVE_WRITE and event.source.kind == RENDERING
    return event.command is not None or event.kind in (LOAD, BEGIN, STORE, DISCARD, ELSEWHERE)


def _decides(event: Event) -> bool:
    if not is_known(event) or event.kind in READS:
        return True
    if event.kind == DISCARD and event.command is not None:
        # After a barrier from UNDEFINED the next use tells: a load that finds nothing was to find
        # what was stored.
        return False
    return event.whole and event.kind in (
        BEGIN,
        CLEAR,
        DISCARD,
        RESOLVE_WRITE,
        *(COMMAND_WRITES - {WRITE}),
    )


def _is_known_read(event: Event) -> bool:
    return event.kind in READS and is_known(event)


def _overwrites_in_part(event: Event) -> bool:
    return is_known(event) and event.kind in (BEGIN, *COMMAND_WRITES)


def _likeness(target: Target) -> object:
    """What two images have alike that change places from frame to frame."""
    return target.format, target.samples, target.size
