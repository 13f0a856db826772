"""The contents of command buffers that concern images and passes."""

from __future__ import annotations

from collections.abc import Hashable
from copy import copy
from typing import Any, NamedTuple

from .call import Call, Place, without_vendor
from .labels import BufferLabels
from .objects import (
    DescriptorSet,
    Framebuffer,
    Image,
    Pipeline,
    ReadableBindings,
    RenderPass,
    SetBindings,
)

PASS_BEGINS = ("beginRenderPass", "beginRendering")
PASS_ENDS = ("endRenderPass", "endRendering")

MAX_FULLSCREEN_VERTICES = 6
"""A draw with at most this many vertices may be a full-screen triangle or quad."""

MAX_COMMANDS = 200_000
"""Maximum number of commands per command buffer: equal draws and reads are stored once per subpass,
the rest are passes and transfers.
"""

MAX_CACHED_COMMANDS = 32_768
"""Maximum number of distinct commands in the cache."""


Parts = tuple[tuple[int, int], ...]

ANY_SET = -1
"""The number of a set that stands for all sets of a pipeline: their contents are in buffers."""


class DrawCounts:
    """The counts of a draw and of those after it that are equal but for their counts: how many
    (`draws`), their `vertices` in total over all instances, and the `count` of vertices or indices
    and the `instances` of the first. None where a count is in a buffer.
    """

    __slots__ = ("count", "draws", "instances", "vertices")

    def __init__(self, count: int | None, instances: int | None, draws: int = 1) -> None:
        self.count, self.instances, self.draws = count, instances, draws
        self.vertices = count * instances if count is not None and instances is not None else None

    def add(self, count: object, instances: object, draws: int = 1) -> None:
        """Adds a draw."""
        self.draws += draws
        if self.vertices is not None:
            self.vertices = (
                self.vertices + count * instances
                if type(count) is int and type(instances) is int
                else None
            )


class RecordedCommand:
    """A recorded command: its name in a description (`kind`), its objects and values (`key`), and
    the first call that recorded it.

    Equal commands, with the same `kind`, `key` and `parts`, are one object. `detail` holds the
    counts of a draw, in the subpass that had the first of them, and `parts` the first mip level and
    layer of each attachment of a pass, empty if all are 0.
    """

    __slots__ = ("at", "by", "detail", "identity", "key", "kind", "layouts", "parts", "written")

    def __init__(
        self, kind: str, key: Hashable, at: Place, by: str, detail: DrawCounts | None = None
    ) -> None:
        self.kind = kind
        self.key = key
        self.at = at
        self.by = by
        self.detail = detail
        self.parts: Parts = ()
        self.identity: Any = None
        """The PassIdentity of a pass that it begins, without pipelines; None until that is
        asked.
        """
        self.written: tuple[Image | None, ...] | None = None
        """The images that it writes; None until that is asked."""
        self.layouts: Any = None
        """What it does to layouts, as `layouts.command_layouts` determines it."""


class DescriptorReads(NamedTuple):
    """Descriptor sets that a draw or dispatch may read, each with the bindings that its pipeline
    can read (None if that is unknown).

    Their contents are looked up when the commands are submitted.
    """

    sets: tuple[tuple[DescriptorSet, ReadableBindings | None], ...]
    stage: str


class Execution(NamedTuple):
    """The first `length` commands of a list: what a secondary command buffer had recorded when
    vkCmdExecuteCommands was recorded.
    """

    commands: list[RecordedCommand | Execution]
    length: int


class RenderPassBegin(NamedTuple):
    """vkCmdBeginRenderPass. `images` come from the framebuffer, or from the call if the framebuffer
    is imageless.
    """

    render_pass: RenderPass
    framebuffer: Framebuffer | None
    images: tuple[Image | None, ...]
    area: tuple[int, int, int, int] | None
    clear_values: int | None


class CommandCache:
    """The distinct commands of a capture that were used last."""

    def __init__(self) -> None:
        self._commands: dict[tuple[str, Hashable, Parts], RecordedCommand] = {}
        self._older: dict[tuple[str, Hashable, Parts], RecordedCommand] = {}
        self.forgotten = 0
        """How often commands were forgotten: a command that is recorded again may be another
        object.
        """

    def command(
        self,
        kind: str,
        key: Hashable,
        call: Call,
        detail: DrawCounts | None = None,
        parts: Parts = (),
    ) -> RecordedCommand:
        """The command with a kind, key and parts, created on first use."""
        identity = (kind, key, parts)
        command = self._commands.get(identity)
        if command is None:
            command = self._older.pop(identity, None)
            if command is None:
                command = RecordedCommand(kind, key, call.at, call.name, detail)
                command.parts = parts
            if len(self._commands) >= MAX_CACHED_COMMANDS // 2:
                self._commands, self._older = {}, self._commands
                self.forgotten += 1
            self._commands[identity] = command
        return command


class BindPoint:
    """What is bound for draws, dispatches, or traced rays: descriptor sets by number, and what the
    pipeline can read of them.
    """

    __slots__ = ("bindings", "sets")

    def __init__(self) -> None:
        self.sets: dict[int, DescriptorSet] = {}
        self.bindings: SetBindings | None = None

    def copy(self) -> BindPoint:
        """What is bound, which changes on its own."""
        point = copy(self)
        point.sets = self.sets.copy()
        return point

    def reads(self) -> tuple[tuple[DescriptorSet, ReadableBindings | None], ...]:
        """The sets that the pipeline can read, as in DescriptorReads."""
        if self.bindings is None:
            return tuple((descriptors, None) for _, descriptors in sorted(self.sets.items()))
        pairs: list[tuple[DescriptorSet, ReadableBindings | None]] = []
        for number, descriptors in sorted(self.sets.items()):
            of_set = self.bindings[number : number + 1] if number != ANY_SET else self.bindings
            pairs += [
                (descriptors, bindings) for bindings in of_set if bindings is None or bindings.kinds
            ]
        return tuple(pairs)


class CommandBuffer:
    """A command buffer: its state during recording, and its commands."""

    __slots__ = (
        "commands",
        "compute",
        "counted",
        "draws",
        "executes",
        "fresh",
        "graphics",
        "label_depth",
        "labels",
        "many",
        "omitted",
        "pipeline",
        "ray_tracing",
        "reads",
        "samples",
        "submission",
        "submitted_length",
        "subpass_commands",
    )  # fmt: skip

    def __init__(self) -> None:
        self.commands: list[RecordedCommand | Execution] = []
        self.reads = False
        """Whether `commands` contains DescriptorReads."""
        self.executes = False
        """Whether `commands` contains Executions."""
        self.omitted = False
        """Whether commands were left out, or those of a secondary command buffer."""
        self.counted = False
        """Whether it was submitted."""
        self.submission: Any = None
        """The Submission of its first `submitted_length` commands, if it does not depend on the
        frame.
        """
        self.submitted_length = 0
        self.pipeline: Pipeline | None = None
        self.graphics = BindPoint()
        self.compute = BindPoint()
        self.ray_tracing = BindPoint()
        self.subpass_commands: set[RecordedCommand] = set()
        """The draws and clears of the current subpass."""
        self.draws: set[RecordedCommand] = set()
        """The draws of the current subpass that no other subpass had before: theirs are the
        counts.
        """
        self.many: dict[Pipeline | None, DrawCounts | None] = {}
        """The pipelines that drew many vertices in the current subpass, each with the counts to add
        to.
        """
        self.fresh = True
        """Whether descriptor sets, or a pipeline that reads others, were bound since the last draw
        of the current subpass.
        """
        self.samples: int | None = None
        self.label_depth: Any = None
        """How many labels are open, if one of them ends frames."""
        self.labels = BufferLabels()

    def copy(self) -> CommandBuffer:
        """A command buffer that recorded the same."""
        buffer = copy(self)
        buffer.commands = self.commands.copy()
        buffer.graphics, buffer.compute, buffer.ray_tracing = (
            self.graphics.copy(),
            self.compute.copy(),
            self.ray_tracing.copy(),
        )
        buffer.subpass_commands, buffer.many, buffer.draws = (
            self.subpass_commands.copy(),
            self.many.copy(),
            self.draws.copy(),
        )
        buffer.label_depth, buffer.labels = copy(self.label_depth), self.labels.copy()
        return buffer

    @property
    def dynamic_samples(self) -> int | None:
        """The sample count that commands set, if the pipeline leaves it dynamic."""
        return self.samples if self.pipeline is not None and self.pipeline.dynamic_samples else None

    def record(self, command: RecordedCommand | Execution) -> None:
        """Adds a command."""
        if len(self.commands) < MAX_COMMANDS:
            self.commands.append(command)
        else:
            self.omitted = True

    def record_once(self, command: RecordedCommand) -> None:
        """Adds a command unless the current subpass already has it."""
        if command not in self.subpass_commands:
            self.subpass_commands.add(command)
            self.record(command)

    def record_boundary(self, command: RecordedCommand) -> None:
        """Adds a command that begins or ends a pass or subpass."""
        self.start_section()
        if command.kind != "nextSubpass" and len(self.commands) < MAX_COMMANDS:
            self.labels.boundary(command.kind in PASS_BEGINS)
        self.record(command)

    def start_section(self) -> None:
        """Starts a new subpass, or the space between passes: later draws are recorded again."""
        self.subpass_commands.clear()
        self.many.clear()
        self.draws.clear()
        self.fresh = True


def kind_of(call: Call) -> str:
    """The name in a description of the command that a call records: `copyImage` for
    vkCmdCopyImage2KHR.
    """
    name = without_vendor(call.name).removeprefix("vkCmd").removesuffix("2")
    return name[:1].lower() + name[1:]
