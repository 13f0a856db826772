"""What happens to every image of a frame, in order, the frame being a loop.

Where the description records commands, they are the order. Where it does not, every pass runs once,
in order. Who asks what follows or precedes an event decides which events matter: see `readers`,
`contents` and `resolve_uses`.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterator
from functools import cached_property
from operator import attrgetter
from typing import NamedTuple

from msaa_lint.core.text.span import Span
from msaa_lint.frame.description.models import (
    AttachmentDescription,
    BeginRenderPass,
    Command,
    ImageBarrier,
    PipelineBarrier,
)

from .commands import CLEAR, COMMAND_WRITES, READ, RESOLVE_READ, RESOLVE_WRITE, accesses
from .frame import Frame
from .parts import RESUMED, SUSPENDED, Attachment, Pass, Resolve, Target, sizes_differ
from .pass_begin import BegunArea, begun_area, is_followed, one_surface, targets_at
from .walk import PassRun, Walk, once_each

LOAD = "load"
BEGIN = "begin"
"""A load operation that ends what was there: CLEAR or DONT_CARE."""
DRAW = "draw"
INPUT = "input"
STORE = "store"
DISCARD = "discard"
"""What is there ends: a store operation that does not store, a barrier from UNDEFINED."""
ELSEWHERE = "elsewhere"
"""A rendering goes on in, or comes from, commands that are not described."""

MAX_FRAMES = 12
"""How many frames are laid out for framebuffers that alternate: what two, three or four together
take.
"""

Frames = tuple[int, frozenset[int]]
"""Of how many frames, and in which of them."""

SOME_FRAMES: Frames = (0, frozenset())
"""In some frames, and it is unknown in which."""


class Event(NamedTuple):
    """One thing that happens to an image.

    `kind` is one of this module's, or an effect of `commands`. `aspect` is None where it may be
    all; `whole` says that it concerns all texels and layers; `certain` is False where what decides
    whether it happens is not stated. `source` is what does it: an attachment with the `member` that
    states it, a resolve, a barrier; None for other commands. `frames` are those in which it happens
    (None: in every one).
    """

    time: int
    kind: str
    aspect: str | None
    whole: bool
    certain: bool = True
    source: Attachment | Resolve | ImageBarrier | None = None
    member: str = ""
    run: PassRun | None = None
    command: Command | None = None
    frames: Frames | None = None

    @property
    def position(self) -> int:
        """The position of the command that it belongs to; of what a pass does, of the command at or
        before it.
        """
        return self.time // 2

    @property
    def place(self) -> Span:
        """Where it is stated."""
        if isinstance(self.source, Attachment):
            return self.source.record.place(self.member)
        if isinstance(self.source, ImageBarrier):
            return self.source.place("oldLayout")
        if self.command is not None:
            return self.command.head
        assert self.source is not None
        return self.source.target_at

    @property
    def name(self) -> str:
        """The pass, or the command."""
        if self.run is not None:
            return self.run.render_pass.name
        return self.command.kind if self.command is not None else ""


class EventRef(NamedTuple):
    """A place in the events of an image."""

    image: str
    number: int


class Timeline:
    """The events of a frame's images. They are laid out when they are first asked for."""

    def __init__(self, frame: Frame, walk: Walk | None = None) -> None:
        self.frame = frame
        self.walk = walk if walk is not None else Walk(frame)
        self.followed = is_followed(frame)
        """False where passes use images more often than is followed: nothing is known then."""
        self.ordered = self.followed and frame.document.ordered
        """Whether what happens first is known."""
        self._resolves = dict(frame.resolve_commands)
        self._areas: dict[tuple[int, int | None], BegunArea] = {}
        self._bound: dict[tuple[int, int], dict[int, list[Attachment]]] = {}

    @cached_property
    def of(self) -> dict[str, list[Event]]:
        """The events by image, in order. An attachment without an image has those of its path."""
        found: dict[str, list[Event]] = {}
        for key, event in self._all() if self.followed else ():
            found.setdefault(key, []).append(event)
        for events in found.values():
            events.sort(key=attrgetter("time"))
        return found

    @cached_property
    def idle(self) -> dict[str, list[Event]]:
        """The events of passes that the commands never begin, were they to run."""
        found: dict[str, list[Event]] = {}
        never = (
            [each for each in self.frame.passes if not each.begun]
            if self.frame.has_commands and self.followed
            else []
        )
        for run in once_each(never):
            for key, event in self._run_events(run):
                found.setdefault(key, []).append(event)
        return found

    @cached_property
    def writes(self) -> bool:
        """Whether commands outside of passes write to images."""
        return any(
            access.effect in COMMAND_WRITES
            for command in self.frame.commands
            for _, access in accesses(command)
        )

    @cached_property
    def presents(self) -> bool:
        """Whether the commands go on to where a picture is shown."""
        return any(command.kind == "present" for command in self.frame.commands)

    # Who wrote an image last.

    def last_writer(self, image: Target, position: int) -> tuple[int, Pass | None] | None:
        """What wrote to an image last before a command, round the loop: its position and the pass
        that draws, None for a command.

        Where the order is unknown: the only pass that draws to the image, before all else.
        """
        writers = self._writers.get(image.name, [])
        return (
            writers[bisect_left(writers, position, key=lambda writer: writer[0]) - 1]
            if writers
            else None
        )

    def area(self, render_pass: Pass, position: int | None) -> BegunArea:
        """What a pass writes to where the command at a position begins it."""
        key = (id(render_pass), position)
        if key not in self._areas:
            self._areas[key] = begun_area(self.frame, render_pass, position)
        return self._areas[key]

    def drawn_by(self, image: Target, writer: tuple[int, Pass]) -> list[Attachment]:
        """The attachments that an image is bound to in a pass that a command at a position
        begins.
        """
        begin, render_pass = writer
        key = (begin, id(render_pass))
        if key not in self._bound:
            bound: dict[int, list[Attachment]] = {}
            for attachment in render_pass.attachments:
                for target in targets_at(self.frame, attachment, begin if begin >= 0 else None):
                    bound.setdefault(id(target), []).append(attachment)
            self._bound[key] = bound
        return self._bound[key].get(id(image), [])

    @cached_property
    def _writers(self) -> dict[str, list[tuple[int, Pass | None]]]:
        found: dict[str, list[tuple[int, Pass | None]]] = {}
        for name, events in self.of.items():
            if not self.frame.document.ordered:
                passes = {
                    id(e.run.render_pass): e.run.render_pass
                    for e in events
                    if e.kind == DRAW and e.run is not None
                }
                if len(passes) == 1:
                    found[name] = [(-1, render_pass) for render_pass in passes.values()]
                continue
            for event in events:
                if event.kind == DRAW and event.run is not None and event.run.position is not None:
                    writer: tuple[int, Pass | None] = (event.run.position, event.run.render_pass)
                elif event.command is not None and event.kind in COMMAND_WRITES:
                    writer = (event.position, None)
                else:
                    continue
                if not found.get(name) or found[name][-1] != writer:
                    found.setdefault(name, []).append(writer)
        return found

    # The events.

    def _all(self) -> Iterator[tuple[str, Event]]:
        before: PassRun | None = None
        for run in self.walk.runs:
            yield from self._seams(before, run, run.begin_time - 1)
            yield from self._run_events(run)
            before = run
        yield from self._seams(before, None, 2 * len(self.frame.commands))
        for position, command in enumerate(self.frame.commands if self.frame.has_commands else ()):
            yield from self._command_events(2 * position, command)

    def _seams(
        self, before: PassRun | None, run: PassRun | None, time: int
    ) -> Iterator[tuple[str, Event]]:
        """What is not described between two runs: where a rendering suspends and none resumes, or
        one resumes and none suspended.
        """
        suspended = (
            before
            if before is not None and before.render_pass.suspends and self.frame.has_commands
            else None
        )
        resumes = run is not None and run.render_pass.resumes and self.frame.has_commands
        if resumes == (suspended is not None):
            return
        unseen = suspended or run
        assert unseen is not None
        for attachment in unseen.render_pass.attachments:
            for target in attachment.targets:
                for aspect in attachment.aspects:
                    source = (attachment, aspect.load_member, unseen)
                    yield key_of(target), Event(time, ELSEWHERE, aspect.name, False, True, *source)

    def _run_events(self, run: PassRun) -> Iterator[tuple[str, Event]]:
        stores: list[tuple[str, Event]] = []
        covered: dict[str, bool] = {}
        begin_command = (
            run.position if run.position is not None else next(iter(run.render_pass.begun), None)
        )
        if begin_command is not None:
            command = self.frame.commands[begin_command]
            for target in run.render_pass.rates:
                yield (
                    key_of(target),
                    Event(run.begin_time, READ, None, True, True, None, "", run, command),
                )
        for attachment in run.render_pass.attachments:
            if not (attachment.used or run.render_pass.unread):
                continue
            for target, frames in self._images(attachment, run):
                key = key_of(target)
                if key not in covered:
                    covered[key] = self.area(run.render_pass, run.position).covers(target)
                whole = covered[key] and frames is not SOME_FRAMES
                for aspect in attachment.aspects:
                    if not attachment.used:
                        # A structure that was not read may use it.
                        source = (attachment, aspect.load_member, run)
                        yield key, Event(run.begin_time, LOAD, aspect.name, whole, False, *source)
                        stores.append(
                            (
                                key,
                                Event(
                                    run.end_time,
                                    STORE,
                                    aspect.name,
                                    whole,
                                    False,
                                    attachment,
                                    aspect.store_member,
                                    run,
                                ),
                            )
                        )
                        continue
                    begin = _BEGINS.get(aspect.load)
                    if aspect.load == "NONE" and (attachment.drawn or attachment.input):
                        # Nothing is left inside the pass of what was there, though a pass that
                        # tests or blends with it means it.
                        begin = LOAD, False
                    # A render pass that begins with layout UNDEFINED keeps nothing of the image,
                    # outside of its render area too.
                    undefined = aspect.load != "LOAD" and _is_undefined(attachment, aspect.name)
                    if undefined and aspect.load is not None:
                        begin = BEGIN, True
                    if begin is not None and not (attachment.only_rate and begin[0] == BEGIN):
                        kind, certain = begin
                        all_of_it = whole or (
                            undefined and one_surface(target.image) and frames is not SOME_FRAMES
                        )
                        yield (
                            key,
                            Event(
                                run.begin_time,
                                kind,
                                aspect.name,
                                all_of_it,
                                certain,
                                attachment,
                                aspect.load_member,
                                run,
                                None,
                                frames,
                            ),
                        )
                    for index in attachment.color | attachment.depth_stencil:
                        yield (
                            key,
                            Event(
                                run.starts[index],
                                DRAW,
                                aspect.name,
                                whole,
                                True,
                                attachment,
                                "",
                                run,
                                None,
                                frames,
                            ),
                        )
                    # The suspended rendering states the same, and performed it.
                    load = attachment.record.loadOp if aspect.load == RESUMED else aspect.load
                    # A pass does not write its density map, whose storeOp is DONT_CARE
                    # (VUID-VkRenderPassFragmentDensityMapCreateInfoEXT-fragmentDensityMapAttachment-02551).  # noqa: E501
                    end = None if attachment.only_rate else _end(attachment, load, aspect.store)
                    if end is not None:
                        kind, certain = end
                        event = Event(
                            run.end_time,
                            kind,
                            aspect.name,
                            whole,
                            certain,
                            attachment,
                            aspect.store_member,
                            run,
                            None,
                            frames,
                        )
                        stores.append((key, event))
                for index in attachment.input | attachment.rate:
                    yield (
                        key,
                        Event(
                            run.starts[index],
                            INPUT,
                            None,
                            whole,
                            True,
                            attachment,
                            "",
                            run,
                            None,
                            frames,
                        ),
                    )
        if not run.render_pass.suspends:
            for resolve in run.render_pass.resolves:
                yield from self._resolve_events(resolve, run)
        # Store operations come after resolves.
        yield from stores

    def _resolve_events(self, resolve: Resolve, run: PassRun) -> Iterator[tuple[str, Event]]:
        if resolve.mode == "NONE":
            return
        time = run.ends[resolve.subpass]
        ends = (
            (RESOLVE_READ, resolve.source, resolve.source_image),
            (RESOLVE_WRITE, resolve.target, resolve.target_image),
        )
        for kind, attachment, image in ends:
            images = (
                self._images(attachment, run)
                if attachment is not None
                else [(image, None)]
                if image is not None
                else []
            )
            for target, frames in images:
                whole = frames is not SOME_FRAMES and self.area(
                    run.render_pass, run.position
                ).covers(target)
                yield (
                    key_of(target),
                    Event(
                        time,
                        kind,
                        resolve.aspect,
                        whole,
                        resolve.mode is not None,
                        resolve,
                        "",
                        run,
                        None,
                        frames,
                    ),
                )

    def _images(self, attachment: Attachment, run: PassRun) -> list[tuple[Target, Frames | None]]:
        """The images of an attachment in a run, each with the frames in which it is the
        attachment's.
        """
        targets = targets_at(self.frame, attachment, run.position)
        if len(targets) <= 1:
            return [(target, None) for target in targets]
        body = self.frame.commands[run.position].body if run.position is not None else None
        names = body.framebuffer if isinstance(body, BeginRenderPass) else None
        frames: dict[str, set[int]] = {}
        if isinstance(names, tuple) and len(names) <= MAX_FRAMES:
            for number, name in enumerate(names):
                framebuffer = self.frame.description.framebuffers.get(name)
                images = framebuffer.attachments if framebuffer is not None else ()
                image = images[attachment.index] if attachment.index < len(images) else None
                if image is not None:
                    frames.setdefault(image, set()).add(number)
        count = len(names) if isinstance(names, tuple) else 0
        return [
            (t, (count, frozenset(frames[t.name])) if t.name in frames else SOME_FRAMES)
            for t in targets
        ]

    def _command_events(self, time: int, command: Command) -> Iterator[tuple[str, Event]]:
        resolve = self._resolves.get(time // 2)
        read: Target | None = None
        for name, access in accesses(command):
            target = self.frame.target(name)
            if target is None:
                continue
            whole = False
            if access.effect == RESOLVE_READ:
                whole = one_surface(target.image)
            elif access.effect in (CLEAR, RESOLVE_WRITE):
                whole = self._writes_all(command, target) and not sizes_differ(read, target)
            read = target
            yield name, Event(time, access.effect, None, whole, True, resolve, "", None, command)
        body = command.body
        for barrier in body.images if isinstance(body, PipelineBarrier) else ():
            target = (
                self.frame.target(barrier.image)
                if isinstance(barrier, ImageBarrier) and barrier.oldLayout == "UNDEFINED"
                else None
            )
            if target is not None and isinstance(barrier, ImageBarrier):
                yield (
                    target.name,
                    Event(
                        time,
                        DISCARD,
                        None,
                        one_surface(target.image),
                        plain(target),
                        barrier,
                        "",
                        None,
                        command,
                    ),
                )

    @staticmethod
    def _writes_all(command: Command, target: Target) -> bool:
        """Whether a clear or a resolve by command, which names no part of an image, writes all of
        it.
        """
        if command.kind == "clearDepthStencilImage":
            # Depth and stencil may be cleared apart.
            return plain(target)
        return one_surface(target.image)


def key_of(target: Target) -> str:
    """What events are kept by: the name of an image, the path of an attachment that names none."""
    return target.name if target.image is not None else target.path


def discards_all(event: Event) -> bool:
    """Whether an event is a barrier from layout UNDEFINED, after which nothing of an image is
    left.
    """
    return event.kind == DISCARD and event.command is not None and event.whole and event.certain


def plain(target: Target | None) -> bool:
    """Whether a command that names an image and no part of it means all of it: one level, layer and
    aspect.
    """
    if target is None or not one_surface(target.image):
        return False
    return target.format is not None and len(target.format.aspects) == 1


def _is_undefined(attachment: Attachment, aspect: str | None) -> bool:
    """Whether the initial layout of an aspect says that nothing is kept of it."""
    record = attachment.record
    if not isinstance(record, AttachmentDescription):
        return False
    separate = aspect == "stencil" and record.stencilInitialLayout is not None
    return (record.stencilInitialLayout if separate else record.initialLayout) == "UNDEFINED"


_BEGINS = {
    None: (LOAD, False),
    "LOAD": (LOAD, True),
    "CLEAR": (BEGIN, True),
    "DONT_CARE": (BEGIN, True),
}
"""What a load operation does to what was there, and whether that is certain; others do nothing."""


def _end(attachment: Attachment, load: str | None, store: str | None) -> tuple[str, bool] | None:
    """What a store operation leaves, and whether that is certain; None where it leaves what was in
    memory, and nothing wrote to it, and where the rendering goes on in another one.
    """
    if store == "STORE":
        return STORE, True
    if store == "DONT_CARE":
        return DISCARD, True
    if store is None:
        return STORE, False
    if store == SUSPENDED:
        return None
    # NONE keeps what was in memory: of what the pass overwrote as it began, nothing is left.
    if load in ("CLEAR", "DONT_CARE"):
        return DISCARD, True
    return (STORE, False) if attachment.drawn or attachment.resolve else None
