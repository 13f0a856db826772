"""What happens to each image of a frame, in order: loads, draws, resolves, reads, copies; within a pass, subpass by subpass.

`timeline` says who reads what a pass stored. This is finer, for what becomes of a resolve: it tells what happens at the end of a subpass
from what happens at its beginning, and keeps who does it.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from msaa_lint.frame.description.models import BeginRendering, Command, ImageBarrier

from .frame import Attachment, Frame, Pass, Resolve
from .pass_begin import MAX_USES, covers, one_surface, targets_at, uses_at_most

LOAD = "load"
DRAW = "draw"
INPUT = "input"
TAKE = "take"
"""A resolve reads the samples."""
RESOLVE = "resolve"
"""A resolve writes its target."""
READ = "read"
COPY = "copy"
WRITE = "write"
CLEAR = "clear"
"""What was there ends: a clear, a load operation that does not load, a store operation that does not store."""
PRESENT = "present"
STORE = "store"
UNKNOWN = "unknown"

READS = frozenset({LOAD, DRAW, INPUT, TAKE, READ, COPY, PRESENT})
"""What makes use of what was there. A draw without a load is of what an earlier subpass made: it blends or tests with it."""

_READ_FROM = {"readImage": (READ, "image"), "present": (PRESENT, "image"), "copyImage": (COPY, "srcImage"),
              "blitImage": (COPY, "srcImage"), "copyImageToBuffer": (COPY, "srcImage")}  # fmt: skip
_LEFT = {"STORE": STORE, "DONT_CARE": CLEAR}
_WRITTEN = {"copyImage": "dstImage", "blitImage": "dstImage", "copyBufferToImage": "dstImage", "writeImage": "image"}

MAX_STEPS = 200_000
"""How many events are looked at to find who reads what. A frame of some thousand passes takes some ten thousand."""


class Begun(NamedTuple):
    """One run of a pass. `position` is the command that begins it (None without commands); `starts` and `ends` are of its subpasses."""

    within: Pass
    position: int | None
    starts: list[int]
    ends: list[int]


class Event(NamedTuple):
    """One thing that happens to an image, or to an aspect of it (None: to all).

    `time` grows along the frame: twice the position of a command, and one more for what comes behind it. `whole` says that it concerns
    all of the image, each time that the frame runs. `of` is who does it.
    """

    time: int
    aspect: str | None
    kind: str
    whole: bool
    of: Resolve | Attachment | Command
    run: Begun | None = None


class Spot(NamedTuple):
    """A place in the events of an image."""

    image: str
    at: int


class Events:
    """The events of a frame's images. `followed` is false where there are more than are followed, or their order is not known: nothing is
    known then."""

    def __init__(self, frame: Frame) -> None:
        self.frame = frame
        self.followed = uses_at_most(frame) <= MAX_USES and frame.document.ordered
        self.runs = list(_runs(frame)) if self.followed else []
        self.of: dict[str, list[Event]] = {}
        self.written: dict[int, list[Spot]] = {}
        """By the identity of a resolve: where it writes."""
        self.stored: dict[tuple[int, str | None], list[Spot]] = {}
        """By the identity of an attachment, and an aspect: where it is stored."""
        self.left = MAX_STEPS
        """How many events may still be looked at for all answers together."""
        self._used: dict[Spot, tuple[Event | None, bool]] = {}
        self._commanded = dict(frame.resolve_commands)
        for name, event in self._all() if self.followed else ():
            self.of.setdefault(name, []).append(event)
        for name, events in self.of.items():
            events.sort(key=_time)
            for index, event in enumerate(events):
                if event.kind == RESOLVE and isinstance(event.of, Resolve):
                    self.written.setdefault(id(event.of), []).append(Spot(name, index))
                elif event.kind == STORE:
                    self.stored.setdefault((id(event.of), event.aspect), []).append(Spot(name, index))

    def after(self, spot: Spot, aspect: str | None) -> Iterator[tuple[Event, bool]]:
        """What happens to an image after a place, round the loop up to that place; the second says whether that is in the next frame."""
        events = self.of[spot.image]
        count = len(events)
        for step in range(1, count + 1):
            event = events[(spot.at + step) % count]
            self.left -= 1
            if self.left < 0:
                return
            if event.aspect is None or aspect is None or event.aspect == aspect:
                yield event, spot.at + step >= count

    def use_of(self, spot: Spot) -> tuple[Event | None, bool]:
        """What first reads what was written at a place, or ends it, or leaves that unknown; whether in the next frame. None where nothing
        does, or more happens than is looked at: see `left`."""
        if spot not in self._used:
            at = self.of[spot.image][spot.at]
            every = self.after(spot, at.aspect)
            self._used[spot] = next(((event, later) for event, later in every if _decides(event)), (None, False))
        return self._used[spot]

    def _all(self) -> Iterator[tuple[str, Event]]:
        for run in self.runs:
            yield from self._of_run(run)
        for position, command in enumerate(self.frame.commands):
            yield from self._of_command(2 * position, command)

    def _of_run(self, run: Begun) -> Iterator[tuple[str, Event]]:
        each = run.within
        flags = each.record.flags if isinstance(each.record, BeginRendering) else ()
        resumes, suspends = "RESUMING" in flags, "SUSPENDING" in flags
        first, last = run.starts[0] - 1, run.ends[-1]
        left: list[tuple[str, Event]] = []
        for attachment in each.attachments:
            if not attachment.used:
                continue
            targets = [target for target in targets_at(self.frame, attachment, run.position) if target.image is not None]
            for target in targets:
                # Of images that alternate from frame to frame, each is left as it was in every other frame.
                whole = len(targets) == 1 and covers(self.frame, each, run.position, target)
                name = target.name
                for aspect in attachment.aspects:
                    kind = None if resumes else _loaded(aspect.load)
                    if kind is not None:
                        yield name, Event(first, aspect.name, kind, whole, attachment, run)
                    for index in attachment.color | attachment.depth_stencil:
                        yield name, Event(run.starts[index], aspect.name, DRAW, whole, attachment, run)
                    if aspect.store in _LEFT and not suspends:
                        left.append((name, Event(last, aspect.name, _LEFT[aspect.store], whole, attachment, run)))
                for index in attachment.input:
                    yield name, Event(run.starts[index], None, INPUT, whole, attachment, run)
        if not suspends:
            for subpass in each.subpasses:
                for resolve in subpass.resolves:
                    yield from self._of_resolve(resolve, run)
        # The store operation comes after the resolves.
        yield from left

    def _of_resolve(self, resolve: Resolve, run: Begun) -> Iterator[tuple[str, Event]]:
        if resolve.mode == "NONE":
            return
        time = run.ends[resolve.subpass]
        for kind, attachment, image in ((TAKE, resolve.source, resolve.source_image), (RESOLVE, resolve.target, resolve.target_image)):
            targets = targets_at(self.frame, attachment, run.position) if attachment is not None else [image] if image is not None else []
            targets = [target for target in targets if target.image is not None]
            for target in targets:
                whole = len(targets) == 1 and covers(self.frame, run.within, run.position, target)
                yield target.name, Event(time, resolve.aspect, kind if resolve.mode is not None else UNKNOWN, whole, resolve, run)

    def _of_command(self, time: int, command: Command) -> Iterator[tuple[str, Event]]:
        kind, body = command.kind, command.body
        if kind == "resolveImage":
            resolve = self._commanded.get(time // 2)
            if resolve is not None:
                for end, image in ((TAKE, resolve.source_image), (RESOLVE, resolve.target_image)):
                    if image is not None:
                        yield image.name, Event(time, None, end, one_surface(image.image), resolve)
            return
        if kind in _READ_FROM:
            how, member = _READ_FROM[kind]
            name = getattr(body, member, None)
            if isinstance(name, str):
                yield name, Event(time, None, how, False, command)
        if kind in _WRITTEN:
            name = getattr(body, _WRITTEN[kind], None)
            if isinstance(name, str):
                yield name, Event(time, None, WRITE, False, command)
        elif kind in ("clearColorImage", "clearDepthStencilImage"):
            name = getattr(body, "image", None)
            cleared = self.frame.target(name)
            if cleared is not None:
                # Depth and stencil may be cleared apart.
                one = cleared.format is not None and len(cleared.format.aspects) == 1
                yield cleared.name, Event(time, None, CLEAR, one_surface(cleared.image) and (one or kind == "clearColorImage"), command)
        for barrier in getattr(body, "images", ()) if kind == "pipelineBarrier" else ():
            if isinstance(barrier, ImageBarrier) and barrier.oldLayout == "UNDEFINED":
                dropped = self.frame.target(barrier.image)
                if dropped is not None:
                    yield dropped.name, Event(time, None, CLEAR, one_surface(dropped.image), command)


def _decides(event: Event) -> bool:
    """Whether an event reads what was there, ends it, or may do either."""
    return event.kind in READS or event.kind == UNKNOWN or (event.whole and event.kind in (CLEAR, RESOLVE))


def _time(event: Event) -> int:
    return event.time


def _loaded(load: str | None) -> str | None:
    """What a load operation is to what was there."""
    if load is None:
        return UNKNOWN
    return {"LOAD": LOAD, "CLEAR": CLEAR, "DONT_CARE": CLEAR}.get(load)


def _runs(frame: Frame) -> Iterator[Begun]:
    """Every time that a pass runs. Without commands each runs once, in order."""
    if not frame.has_commands:
        position = 0
        for each in frame.passes:
            count = len(each.subpasses)
            if count:
                times = range(2 * position, 2 * (position + count), 2)
                yield Begun(each, None, [time + 1 for time in times], [time + 2 for time in times])
            position += count + 1
        return
    begins = {position: each for each in frame.passes for position in each.begun}
    within: Begun | None = None
    for position, command in enumerate(frame.commands):
        if position in begins:
            if within is not None:
                yield _ended(within, 2 * position - 1)
            within = Begun(begins[position], position, [2 * position + 1], [])
        elif within is not None and command.kind == "nextSubpass":
            within.ends.append(2 * position)
            within.starts.append(2 * position + 1)
        elif within is not None and command.kind in ("endRenderPass", "endRendering"):
            yield _ended(within, 2 * position)
            within = None
    if within is not None:
        yield _ended(within, 2 * len(frame.commands))


def _ended(run: Begun, time: int) -> Begun:
    """A run that ends at a time, with as many subpasses as its pass has."""
    count = max(len(run.within.subpasses), 1)
    starts = [*run.starts, *[time] * (count - len(run.starts))][:count]
    ends = [*run.ends, *[time] * (count - len(run.ends))][:count]
    return Begun(run.within, run.position, starts, ends)
