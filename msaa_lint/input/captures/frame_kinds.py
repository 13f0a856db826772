"""Kinds of frames: the passes that a frame begins, their contents merged over all of its frames,
and what is between them.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable
from typing import Any, NamedTuple

from .command_buffers import PASS_BEGINS, PASS_ENDS, RecordedCommand, RenderPassBegin
from .labels import Path
from .objects import MAX_ROTATION, Image, freeze

MAX_ALTERNATES = 8
"""Maximum number of framebuffers, each with other images, that a pass alternates between."""

MAX_GAP_VARIANTS = 8
"""Maximum number of different command sequences between two passes."""

MAX_VARIANT_COMMANDS = 20_000
"""Maximum number of commands in these sequences for a kind, beyond one sequence each."""

MAX_MERGED = 32_768
"""Maximum number of commands that are added to the passes of all kinds after their first frames."""

MAX_PASS_COMMANDS = 4096
"""Maximum number of different draws, reads and clears in a pass."""


class Role(int):
    """Stands for the image that a frame's passes use at this position, in order of first use."""

    __slots__ = ()


Segment = tuple[RecordedCommand | None, list[RecordedCommand]]
"""The commands within a pass, after the command that begins it, or between two passes, after
None.
"""


class GapVariant:
    """A command sequence between two passes, and the number of frames that contain it."""

    def __init__(self, items: list[RecordedCommand]) -> None:
        self.items = items
        self.count = 0


class FrameKind:
    """Frames of the same kind: the passes and images of the first, the number of frames, and the
    merged contents.
    """

    def __init__(
        self, number: int, images: list[Image], passes: list[RecordedCommand], length: int
    ) -> None:
        self.number = number
        self.length = length
        """The number of commands of the first frame."""
        self.variant_commands = 0
        """The number of commands in `gaps`."""
        self.count = 0
        self.images = images
        self.passes = passes
        self.labels: list[Path] = []
        """The debug labels of the passes in the first frame."""
        self.alternates: list[dict[Hashable, RenderPassBegin]] = [{} for _ in passes]
        self.pass_commands: list[dict[Hashable, RecordedCommand]] = [{} for _ in passes]
        self.gaps: list[dict[Hashable, GapVariant]] = [{} for _ in range(len(passes) + 1)]
        self.rotations: dict[int, dict[Image, None]] = {}
        """The multisampled images that have a role in some frame, by role."""
        self.is_complete = True
        """Whether the passes have all of their commands."""
        self.later: dict[tuple[Hashable, str], bool] = {}
        """Images and aspects whose contents a later frame reads, and whether a shader of it
        does.
        """
        self.defined: set[tuple[Hashable, str]] = set()
        self.undefined: set[tuple[Hashable, str]] = set()
        """Images and aspects that the frame reads first: `defined` if an earlier frame stored them,
        `undefined` if it discarded them.
        """


class Merged:
    """The number of commands that were added to the passes of all kinds after their first
    frames.
    """

    def __init__(self) -> None:
        self.count = 0


class AspectState(NamedTuple):
    """The state in which a frame left an aspect of an image, with the frame's kind and the image's
    role in it.
    """

    state: str
    kind: FrameKind
    role: Hashable


class DistinctFrame:
    """A frame with a distinct command sequence: its kind (None above MAX_KINDS), and how often it
    occurred since the last count.
    """

    def __init__(
        self,
        kind: FrameKind | None,
        commands: list[RecordedCommand],
        roles: Iterable[Image],
        gaps: list[list[RecordedCommand]],
    ) -> None:
        self.kind = kind
        self.gaps = gaps
        self.commands = commands
        self.weight = 0
        """The number of its commands; those that keep much memory count for several."""
        self.count = 0
        self.images = list(roles)
        begins = [command.key for command in commands if isinstance(command.key, RenderPassBegin)]
        pipelines = [
            command.key[0]
            for command in commands
            if command.kind == "draw" and isinstance(command.key, tuple)
        ]
        self.used: list[Any] = list(
            dict.fromkeys(
                (*roles, *(begin.render_pass for begin in begins), *filter(None, pipelines))
            )
        )
        """The images, render passes and pipelines."""


def add_counts(frame: DistinctFrame) -> None:
    """Adds a frame's count to its kind, its images, render passes and pipelines."""
    for used in frame.used:
        used.frames += frame.count
    if frame.kind is not None:
        frame.kind.count += frame.count
        for variants, items in zip(frame.kind.gaps, frame.gaps, strict=True):
            sequence = tuple((command.kind, command.key) for command in items)
            if sequence not in variants:
                if variants and (
                    len(variants) >= MAX_GAP_VARIANTS
                    or frame.kind.variant_commands + len(items) > MAX_VARIANT_COMMANDS
                ):
                    continue
                frame.kind.variant_commands += len(items)
                variants[sequence] = GapVariant(items)
            variants[sequence].count += frame.count
    frame.count = 0


def merge(
    kind: FrameKind, segments: list[Segment], roles: dict[Image, Role], merged: Merged
) -> list[list[RecordedCommand]]:
    """Merges the contents of a frame's passes into its kind, and returns the commands between
    them.
    """
    number = 0
    is_first = not any(kind.pass_commands)
    for image, role in roles.items():
        if image.samples > 1:
            rotation = kind.rotations.setdefault(role, {})
            if len(rotation) <= MAX_ROTATION:
                rotation[image] = None
    gaps: list[list[RecordedCommand]] = []
    for begin, items in segments:
        if begin is None:
            gaps.append([_with_roles(command, roles) for command in items])
            continue
        if isinstance(begin.key, RenderPassBegin):
            alternates = kind.alternates[number]
            if len(alternates) < MAX_ALTERNATES:
                alternates.setdefault(begin.key.images, begin.key)
        pass_commands = kind.pass_commands[number]
        subpass = 0
        for command in items:
            subpass += command.kind == "nextSubpass"
            command_with_roles = _with_roles(command, roles)
            identity = (subpass, command_with_roles.kind, command_with_roles.key)
            if identity in pass_commands:
                continue
            if len(pass_commands) < MAX_PASS_COMMANDS and merged.count < MAX_MERGED:
                pass_commands[identity] = command_with_roles
                merged.count += not is_first
            else:
                kind.is_complete = False
        number += 1
    return gaps


def segments_of(commands: list[RecordedCommand]) -> list[Segment]:
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


def shape_of(begin: RecordedCommand, roles: dict[Image, Role]) -> Hashable:
    """The properties of a pass that define the kind of a frame. Images are replaced by their roles
    and creation parameters.
    """
    if isinstance(begin.key, RenderPassBegin):
        size = (
            tuple(begin.key.framebuffer.tree.items()) if begin.key.framebuffer is not None else None
        )
        images = tuple(
            _role(image, roles) if image is not None else None for image in begin.key.images
        )
        return ("renderPass", begin.key.render_pass.number, images, size, begin.key.area)
    return ("rendering", _rendering_shape(begin.key, roles))


def _role(image: Image, roles: dict[Image, Role]) -> Hashable:
    if image not in roles:
        roles[image] = Role(len(roles))
    return (roles[image], image.swapchain is not None, freeze(image.tree))


def _rendering_shape(key: Hashable, roles: dict[Image, Role]) -> Hashable:
    """The key of a beginRendering command with images replaced by their roles and creation
    parameters.
    """
    if isinstance(key, Image):
        return _role(key, roles)
    return tuple(_rendering_shape(item, roles) for item in key) if isinstance(key, tuple) else key


def _with_roles(command: RecordedCommand, roles: dict[Image, Role]) -> RecordedCommand:
    """A command with the images of passes replaced by their roles."""
    key: Hashable
    if isinstance(command.key, tuple) and not isinstance(command.key, RenderPassBegin):
        key = tuple(
            roles.get(item, item) if isinstance(item, Image) else item for item in command.key
        )
    elif isinstance(command.key, Image):
        key = roles.get(command.key, command.key)
    else:
        return command
    return RecordedCommand(command.kind, key, command.at, command.by, command.detail)
