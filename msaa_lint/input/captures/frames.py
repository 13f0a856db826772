"""Frames: the submitted commands from one present to the next, grouped into kinds.

Frames are of the same kind if they begin the same passes in the same order on equally created images. The contents of a pass are merged
over all frames of a kind; between passes, the most frequent sequence of commands represents the kind.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable
from typing import Any, NamedTuple

from .command_buffers import RecordedCommand, RenderPassBegin
from .frame_boundary import aspect_uses
from .objects import Image, freeze

MAX_KINDS = 32
"""Maximum number of frame kinds."""

MAX_ALTERNATES = 8
"""Maximum number of framebuffers that a pass alternates between."""

MAX_GAP_VARIANTS = 8
"""Maximum number of different command sequences between two passes."""

MAX_PASS_COMMANDS = 4096
"""Maximum number of different draws, reads and clears in a pass."""

MAX_SIMILAR_SUBMISSIONS = 8
"""Maximum number of similar submissions, each on other images, that count as one frame if nothing marks the end of a frame."""

MAX_DISTINCT_FRAMES = 1024
"""Maximum number of different frames in the cache."""

MAX_STORED_COMMANDS = 1_000_000
"""Maximum total number of commands of these frames."""

MAX_FRAME_COMMANDS = 1_000_000
"""Maximum number of commands per frame."""

PASS_BEGINS = ("beginRenderPass", "beginRendering")
PASS_ENDS = ("endRenderPass", "endRendering")


class Role(int):
    """Stands for the image that a frame's passes use at this position, in order of first use."""

    __slots__ = ()


Segment = tuple[RecordedCommand | None, list[RecordedCommand]]
"""The commands within a pass, after the command that begins it, or between two passes, after None."""


class GapVariant:
    """A command sequence between two passes, and the number of frames that contain it."""

    def __init__(self, items: list[RecordedCommand]) -> None:
        self.items = items
        self.count = 0


class FrameKind:
    """Frames of the same kind: the passes and images of the first, the number of frames, and the merged contents."""

    def __init__(self, number: int, images: list[Image], passes: list[RecordedCommand]) -> None:
        self.number = number
        self.count = 0
        self.images = images
        self.passes = passes
        self.alternates: list[dict[Hashable, RenderPassBegin]] = [{} for _ in passes]
        self.pass_commands: list[dict[Hashable, RecordedCommand]] = [{} for _ in passes]
        self.gaps: list[dict[Hashable, GapVariant]] = [{} for _ in range(len(passes) + 1)]
        self.later: set[tuple[Hashable, str]] = set()
        """Images and aspects whose contents a later frame reads."""
        self.defined: set[tuple[Hashable, str]] = set()
        self.undefined: set[tuple[Hashable, str]] = set()
        """Images and aspects that the frame reads first: `defined` if an earlier frame stored them, `undefined` if it discarded them."""


class AspectState(NamedTuple):
    """The state in which a frame left an aspect of an image, with the frame's kind and the image's role in it."""

    state: str
    kind: FrameKind
    role: Hashable


class DistinctFrame:
    """A frame with a distinct command sequence: its kind (None above MAX_KINDS), and how often it occurred since the last count."""

    def __init__(
        self, kind: FrameKind | None, commands: list[RecordedCommand], roles: Iterable[Image], gaps: list[list[RecordedCommand]]
    ) -> None:
        self.kind = kind
        self.gaps = gaps
        self.commands = commands
        self.count = 0
        self.images = list(roles)
        begins = [command.key for command in commands if isinstance(command.key, RenderPassBegin)]
        pipelines = [command.key[0] for command in commands if command.kind == "draw" and isinstance(command.key, tuple)]
        self.used: list[Any] = list(dict.fromkeys((*roles, *(begin.render_pass for begin in begins), *filter(None, pipelines))))
        """The images, render passes and pipelines."""


class Frames:
    """Collects the frames of a capture."""

    def __init__(self) -> None:
        self.current: list[RecordedCommand] = []
        self.kinds: dict[Hashable, FrameKind] = {}
        self.total = 0
        self.dropped = 0
        """The number of frames whose kind was not kept."""
        self.presents = False
        self.frameless = False
        self.truncated = False
        self._submissions: dict[Hashable, int] = {}
        """How often the current frame submitted the same passes, or similar ones."""
        self._shapes: dict[Hashable, Hashable] = {}
        self._distinct: dict[Hashable, DistinctFrame] = {}
        self._stored_commands = 0
        """The number of commands in the cached frames."""
        self._last: DistinctFrame | None = None
        self._repetitions = 0
        """How often the last frame repeated in a row."""

    def mark(self, kind: str) -> None:
        """Processes a mark."""
        if kind == "frameless":
            self.frameless = True
        elif kind == "truncated":
            self.truncated = True
        elif kind == "frame" and not self.presents:
            self.end()

    def submit(self, commands: list[RecordedCommand]) -> None:
        """Adds the submitted commands of a command buffer."""
        if not self.presents and not self.frameless:
            self._split_frames(commands)
        if len(self.current) < MAX_FRAME_COMMANDS:
            self.current.extend(commands)

    def _split_frames(self, commands: list[RecordedCommand]) -> None:
        """Ends the frame if this submission starts a new one. Without presents, that is a submission that repeats the frame's passes on the
        same images, or repeatedly on new images."""
        begins = [command for command in commands if command.kind in PASS_BEGINS]
        if not begins:
            return
        same = tuple(map(id, begins))
        similar = self._shapes.get(same)
        if similar is None:
            if len(self._shapes) > MAX_DISTINCT_FRAMES:
                self._shapes.clear()
            similar = self._shapes[same] = tuple(_shape(command, {}) for command in begins)
        if same in self._submissions or self._submissions.get(similar, 0) >= MAX_SIMILAR_SUBMISSIONS:
            self.end()
        for shape in (same, similar):
            self._submissions[shape] = self._submissions.get(shape, 0) + 1

    def end_of_capture(self) -> None:
        """Ends the capture. The remaining commands are a frame if they begin a pass."""
        if any(command.kind in PASS_BEGINS for command in self.current):
            self.end()
        for frame in self._distinct.values():
            _add_counts(frame)

    def end(self) -> None:
        """Ends the frame."""
        commands, self.current = self.current, []
        self._submissions.clear()
        self.total += 1
        key = tuple(map(id, commands))
        frame = self._distinct.get(key)
        if frame is None:
            frame = self._classify(commands)
            if frame is None:
                return
            self._stored_commands += len(commands)
            if len(self._distinct) >= MAX_DISTINCT_FRAMES or self._stored_commands > MAX_STORED_COMMANDS:
                for other in self._distinct.values():
                    _add_counts(other)
                self._distinct.clear()
                self._stored_commands = len(commands)
            self._distinct[key] = frame
        elif frame.kind is not None and self._repetitions < 2:
            self._track_contents(frame.kind, commands, {image: Role(number) for number, image in enumerate(frame.images)})
        frame.count += 1
        self.dropped += frame.kind is None
        self._repetitions = self._repetitions + 1 if frame is self._last else 0
        self._last = frame

    def _classify(self, commands: list[RecordedCommand]) -> DistinctFrame | None:
        """Classifies a new frame; None if it has no pass."""
        segments = _segments(commands)
        passes = [begin for begin, _ in segments if begin is not None]
        if not passes:
            return None
        self._repetitions = 0
        roles: dict[Image, Role] = {}
        shape = tuple(_shape(begin, roles) for begin in passes)
        kind = self.kinds.get(shape)
        if kind is None and len(self.kinds) < MAX_KINDS:
            kind = self.kinds[shape] = FrameKind(len(self.kinds), list(roles), passes)
        gaps: list[list[RecordedCommand]] = []
        if kind is not None:
            gaps = _merge(kind, segments, roles)
            self._track_contents(kind, commands, roles)
        return DistinctFrame(kind, commands, roles, gaps)

    def _track_contents(self, kind: FrameKind, commands: list[RecordedCommand], roles: dict[Image, Role]) -> None:
        """Updates what frames read from earlier ones, and the state in which this one leaves its images."""
        for image, uses in aspect_uses(commands).items():
            role = roles.get(image, image)
            for aspect, use in uses.items():
                state: AspectState | None = image.aspect_states.get(aspect)
                if use.first == "read":
                    if state is not None and state.state == "unread":
                        state.kind.later.add((state.role, aspect))
                    if state is not None and state.state == "discarded":
                        kind.undefined.add((role, aspect))
                    else:
                        kind.defined.add((role, aspect))
                if use.last is not None:
                    image.aspect_states[aspect] = AspectState(use.last, kind, role)
                elif use.first == "read" and state is not None and state.state == "unread":
                    image.aspect_states[aspect] = state._replace(state="read")


def _add_counts(frame: DistinctFrame) -> None:
    """Adds a frame's count to its kind, its images, render passes and pipelines."""
    for used in frame.used:
        used.frames += frame.count
    if frame.kind is not None:
        frame.kind.count += frame.count
        for variants, items in zip(frame.kind.gaps, frame.gaps, strict=True):
            sequence = tuple((command.kind, command.key) for command in items)
            if sequence in variants or len(variants) < MAX_GAP_VARIANTS:
                variants.setdefault(sequence, GapVariant(items)).count += frame.count
    frame.count = 0


def _merge(kind: FrameKind, segments: list[Segment], roles: dict[Image, Role]) -> list[list[RecordedCommand]]:
    """Merges the contents of a frame's passes into its kind, and returns the commands between them."""
    number = 0
    gaps: list[list[RecordedCommand]] = []
    for begin, items in segments:
        if begin is None:
            gaps.append([_with_roles(command, roles) for command in items])
            continue
        if isinstance(begin.key, RenderPassBegin):
            alternates = kind.alternates[number]
            imageless = begin.key.framebuffer is None or begin.key.framebuffer.images is None
            if len(alternates) < MAX_ALTERNATES:
                alternates.setdefault(begin.key.images if imageless else begin.key.framebuffer, begin.key)
        pass_commands = kind.pass_commands[number]
        subpass = 0
        for command in items:
            subpass += command.kind == "nextSubpass"
            command_with_roles = _with_roles(command, roles)
            identity = (subpass, command_with_roles.kind, command_with_roles.key)
            if identity not in pass_commands and len(pass_commands) < MAX_PASS_COMMANDS:
                pass_commands[identity] = command_with_roles
        number += 1
    return gaps


def _segments(commands: list[RecordedCommand]) -> list[Segment]:
    """The commands before, within, between and after the passes of a frame."""
    segments: list[Segment] = [(None, [])]
    in_pass = False
    for command in commands:
        if command.kind in PASS_BEGINS:
            if in_pass:
                # The capture lacks the end of this pass.
                segments.append((None, []))
            segments.append((command, []))
            in_pass = True
        elif command.kind in PASS_ENDS:
            if in_pass:
                segments.append((None, []))
            in_pass = False
        elif in_pass or command.kind != "nextSubpass":
            segments[-1][1].append(command)
    if in_pass:
        segments.append((None, []))
    return segments


def _shape(begin: RecordedCommand, roles: dict[Image, Role]) -> Hashable:
    """The properties of a pass that define the kind of a frame. Images are replaced by their roles and creation parameters."""
    if isinstance(begin.key, RenderPassBegin):
        size = tuple(begin.key.framebuffer.tree.items()) if begin.key.framebuffer is not None else None
        images = tuple(_role(image, roles) if image is not None else None for image in begin.key.images)
        return ("renderPass", id(begin.key.render_pass), images, size, begin.key.area)
    return ("rendering", _rendering_shape(begin.key, roles))


def _role(image: Image, roles: dict[Image, Role]) -> Hashable:
    if image not in roles:
        roles[image] = Role(len(roles))
    return (roles[image], image.swapchain is not None, freeze(image.tree))


def _rendering_shape(key: Hashable, roles: dict[Image, Role]) -> Hashable:
    """The key of a beginRendering command with images replaced by their roles and creation parameters."""
    if isinstance(key, Image):
        return _role(key, roles)
    return tuple(_rendering_shape(item, roles) for item in key) if isinstance(key, tuple) else key


def _with_roles(command: RecordedCommand, roles: dict[Image, Role]) -> RecordedCommand:
    """A command with the images of passes replaced by their roles."""
    key: Hashable
    if isinstance(command.key, tuple) and not isinstance(command.key, RenderPassBegin):
        key = tuple(roles.get(item, item) if isinstance(item, Image) else item for item in command.key)
    elif isinstance(command.key, Image):
        key = roles.get(command.key, command.key)
    else:
        return command
    return RecordedCommand(command.kind, key, command.at, command.by, command.detail)
