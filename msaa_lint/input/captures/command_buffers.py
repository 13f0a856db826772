"""What command buffers record, as far as images and passes go."""

from __future__ import annotations

from collections.abc import Hashable, Mapping
from typing import Any, NamedTuple

from . import values
from .call import Call, Place
from .objects import DescriptorSet, Framebuffer, Image, Pipeline, RenderPass

FEW = 6
"""So many vertices are a full-screen triangle or quad."""

MAX_RECORDED = 200_000
"""So many commands of one command buffer are kept: draws and reads are noted once a subpass, the rest are passes and transfers."""

MAX_KNOWN = 100_000
"""So many commands are remembered, to be known again."""


class Recorded:
    """One recorded command: its name in a description, what it is about (objects and plain values), and the call that recorded it first.

    Two that are alike, `kind` and `key` the same, are one object. `detail` is what tells the first of them from the others.
    """

    __slots__ = ("at", "by", "detail", "key", "kind")

    def __init__(self, kind: str, key: Hashable, at: Place, by: str, detail: tuple[int | None, int | None] | None = None) -> None:
        self.kind = kind
        self.key = key
        self.at = at
        self.by = by
        self.detail = detail


class Reads(NamedTuple):
    """Descriptor sets that a draw or a dispatch may read; what they hold is looked up when the commands are submitted."""

    sets: tuple[DescriptorSet, ...]
    stage: str


class Begin(NamedTuple):
    """vkCmdBeginRenderPass: `images` are those of the framebuffer, or of the begin where that is imageless."""

    render_pass: RenderPass
    framebuffer: Framebuffer | None
    images: tuple[Image | None, ...]
    area: tuple[int, int, int, int] | None
    clear_values: int | None


class Commands:
    """The commands that were recorded so far, each once."""

    def __init__(self) -> None:
        self._known: dict[tuple[str, Hashable], Recorded] = {}

    def command(self, kind: str, key: Hashable, call: Call, detail: tuple[int | None, int | None] | None = None) -> Recorded:
        """The command of a kind and key."""
        known = self._known.get((kind, key))
        if known is None:
            if len(self._known) > MAX_KNOWN:
                self._known.clear()
            known = self._known[kind, key] = Recorded(kind, key, call.at, call.name, detail)
        return known


class CommandBuffer:
    """A command buffer while it is recorded, and what it holds then. `seen` are the draws and clears of the subpass that is recorded."""

    __slots__ = ("bound", "compute_bound", "fresh", "many", "pipeline", "reads", "recorded", "samples", "seen")

    def __init__(self) -> None:
        self.recorded: list[Recorded] = []
        self.reads = False
        """Whether descriptor sets are among what is recorded."""
        self.pipeline: Pipeline | None = None
        self.bound: dict[int, DescriptorSet] = {}
        self.compute_bound: dict[int, DescriptorSet] = {}
        self.seen: set[Recorded] = set()
        self.many: set[Pipeline | None] = set()
        """The pipelines with which many vertices were drawn in the subpass."""
        self.fresh = True
        """Whether descriptor sets were bound since the last draw of the subpass."""
        self.samples: int | None = None

    @property
    def dynamic_samples(self) -> int | None:
        """The sample count that was set, where the pipeline leaves it to the commands."""
        return self.samples if self.pipeline is not None and self.pipeline.dynamic_samples else None

    def record(self, command: Recorded) -> None:
        """Adds a command."""
        if len(self.recorded) < MAX_RECORDED:
            self.recorded.append(command)

    def once(self, command: Recorded) -> None:
        """Adds a command unless its like was added since the subpass began."""
        if command not in self.seen:
            self.seen.add(command)
            self.record(command)

    def boundary(self) -> None:
        """A pass or a subpass begins or ends: what is drawn from here on is noted anew."""
        self.seen.clear()
        self.many.clear()
        self.fresh = True


def drawn(counted: str, args: Mapping[str, Any]) -> tuple[int | None, int | None]:
    """How many vertices or indices a draw has, and how many instances."""
    return (values.count(args.get(counted)), values.count(args.get("instanceCount"))) if counted else (None, None)


def draw_key(pipeline: Pipeline | None, counted: str, count: int | None, instances: int | None) -> tuple[Any, ...]:
    """A draw, as far as rules tell draws apart: the few vertices of a full-screen triangle or quad, or many."""
    few = count is not None and count <= FEW and instances == 1
    return (pipeline, counted, count if few else None)
