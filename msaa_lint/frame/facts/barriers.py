"""What a frame states between a resolve and the first reader of what it wrote: dependencies of passes, and recorded barriers.

A resolve at the end of a subpass or a rendering runs in COLOR_ATTACHMENT_OUTPUT, of depth and stencil too (Vulkan specification, Render
Pass: Render Pass Multisample Resolve Operations).
"""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from typing import NamedTuple

from msaa_lint.frame.description.models import ImageBarrier, PipelineBarrier, ReadImage, RenderPass, SubpassDependency
from msaa_lint.frame.description.record import Record

from .commands import COPY_READ, READ, RESOLVE_READ
from .event_search import EventSearch, reads
from .facts import Facts
from .parts import Resolve
from .timeline import DRAW, INPUT, LOAD, Event, EventRef
from .walk import PassRun

_ALL = frozenset({"ALL_COMMANDS"})
_RESOLVES = frozenset({"COLOR_ATTACHMENT_OUTPUT", "ALL_GRAPHICS", "ALL_COMMANDS", "BOTTOM_OF_PIPE"})
_RESOLVES_BY_COMMAND = frozenset({"RESOLVE", "TRANSFER", "ALL_COMMANDS", "BOTTOM_OF_PIPE"})

_ORDER = {
    name: number
    for number, names in enumerate((
        ("DRAW_INDIRECT",), ("VERTEX_INPUT", "INDEX_INPUT", "VERTEX_ATTRIBUTE_INPUT"),
        ("VERTEX_SHADER", "PRE_RASTERIZATION_SHADERS", "TASK_SHADER_EXT"), ("TESSELLATION_CONTROL_SHADER",),
        ("TESSELLATION_EVALUATION_SHADER",), ("GEOMETRY_SHADER", "MESH_SHADER_EXT"), ("EARLY_FRAGMENT_TESTS",), ("FRAGMENT_SHADER",),
        ("LATE_FRAGMENT_TESTS",), ("COLOR_ATTACHMENT_OUTPUT",),
    ))
    for name in names
}  # fmt: skip
"""The stages of drawing in their logical order: who waits for one waits for those before it, who is waited for by one holds back those
after it."""

_TRANSFERS = frozenset({"TRANSFER", "COPY", "RESOLVE", "BLIT", "CLEAR"})
_DEPTH_STAGES = frozenset({"EARLY_FRAGMENT_TESTS", "LATE_FRAGMENT_TESTS"})
_DEPTH_WRITES = frozenset({"DEPTH_STENCIL_ATTACHMENT_WRITE", "COLOR_ATTACHMENT_WRITE", "MEMORY_WRITE"})
_COLOR_WRITES = frozenset({"COLOR_ATTACHMENT_WRITE", "MEMORY_WRITE"})
_TRANSFER_WRITES = frozenset({"TRANSFER_WRITE", "MEMORY_WRITE"})

_SHADERS = {
    "FRAGMENT": "FRAGMENT_SHADER", "VERTEX": "VERTEX_SHADER", "COMPUTE": "COMPUTE_SHADER", "GEOMETRY": "GEOMETRY_SHADER",
    "TESSELLATION_CONTROL": "TESSELLATION_CONTROL_SHADER", "TESSELLATION_EVALUATION": "TESSELLATION_EVALUATION_SHADER",
    "TASK_EXT": "TASK_SHADER_EXT", "MESH_EXT": "MESH_SHADER_EXT", "ALL": "ALL_COMMANDS",
}  # fmt: skip
_RAYS = ("RAYGEN_KHR", "ANY_HIT_KHR", "CLOSEST_HIT_KHR", "MISS_KHR", "INTERSECTION_KHR", "CALLABLE_KHR")


class Wait(NamedTuple):
    """One stated wait: a dependency of a run of a pass, or a recorded barrier (`run` is None)."""

    time: int
    record: SubpassDependency | PipelineBarrier
    run: PassRun | None = None
    images: frozenset[str | None] = frozenset()
    """The images that a barrier names."""


class Between(NamedTuple):
    """The waits between a resolve and its first reader: the source stages of those that are meant for it, and whether one waits for it."""

    waits: bool
    stages: tuple[str, ...]
    record: Record
    in_pass: bool
    later: bool
    """The reader is in the next frame."""


class Waits:
    """The waits of a frame, in order."""

    def __init__(self, search: EventSearch) -> None:
        self.search = search
        self._every: list[Wait] = []
        for run in search.timeline.walk.runs if search.timeline.ordered else ():
            self._every += _of_run(run)
        self._every += (Wait(2 * position, body, None, _images(body)) for position, body in search.frame.recorded(PipelineBarrier))
        self._every.sort(key=lambda wait: wait.time)
        self._times = [wait.time for wait in self._every]

    def put(self, facts: Facts, resolve: Resolve) -> None:
        """Adds what is known of the waits between a resolve and the first reader of what it wrote."""
        found = [self._between(resolve, ref) for ref in self.search.written_at(resolve)]
        known = [each for each in found if each is not None]
        facts.put("resolve.stage", "TRANSFER" if resolve.kind == "command" else "COLOR_ATTACHMENT_OUTPUT")
        between = next((each for each in known if not each.waits), known[0] if known else None)
        if between is not None:
            facts.put("resolve.waited_for", between.waits)
            facts.put("resolve.waiting_stages", list(between.stages) or ["NONE"], between.record.place("srcStageMask"))
            facts.put("resolve.read_in_pass", between.in_pass)
            facts.put("resolve.read_next_frame", between.later)

    def _between(self, resolve: Resolve, ref: EventRef) -> Between | None:
        """None where nothing is known to read it, or nothing is stated that is meant for the reader."""
        own = self.search.event(ref)
        event, later = self.search.first_use(ref)
        if event is None or not reads(event) or (own.aspect == "color" and event.kind == DRAW):
            return None
        wanted = _stages(event)
        in_pass = event.run is not None and event.run is own.run and not later
        if wanted is None or not (in_pass or self.search.frame.has_commands):
            return None
        waits = self._within(own.time, event.time, later)
        self.search.steps_left -= len(waits)
        if self.search.steps_left < 0:
            return None
        meant: Wait | None = None
        stages: dict[str, None] = {}
        done = _RESOLVES_BY_COMMAND if resolve.kind == "command" else _RESOLVES
        reached = wanted
        for wait in reversed(waits):
            source, target = wait.record.srcStageMask, wait.record.dstStageMask
            concerns = _concerns(wait, resolve, ref.image, own, event)
            if concerns is False:
                continue
            if source is None or target is None or not wait.record.states("srcStageMask"):
                return None
            exact = concerns is True and (not target or _names_images(wait) or _meets(target, wanted))
            if not exact and not _reaches(target, reached):
                continue
            if exact:
                meant = wait
            reached = reached | frozenset(source)
            stages.update(dict.fromkeys(source))
            if not done.isdisjoint(source):
                return Between(True, tuple(stages), wait.record, in_pass, later)
        return Between(False, tuple(stages), meant.record, in_pass, later) if meant is not None else None

    def _within(self, start: int, end: int, later: bool) -> list[Wait]:
        """The waits from one time up to another, round the loop where that is in the next frame."""
        first, last = bisect_left(self._times, start), bisect_right(self._times, end)
        return [*self._every[first:], *self._every[:last]] if later else self._every[first:last]


def _of_run(run: PassRun) -> list[Wait]:
    """The dependencies of a pass, where they take effect."""
    record = run.render_pass.record
    found = []
    for dependency in record.dependencies if isinstance(record, RenderPass) else ():
        into = dependency.dstSubpass
        if into == "EXTERNAL":
            found.append(Wait(run.end_time, dependency, run))
        elif isinstance(into, int) and into < len(run.starts):
            found.append(Wait(run.starts[into] if into else run.begin_time, dependency, run))
    return found


def _concerns(wait: Wait, resolve: Resolve, image: str, own: Event, reader: Event) -> bool | None:
    """Whether a wait is meant for what a resolve wrote and its reader; None where it is not, and may have a part in it all the same."""
    record = wait.record
    if isinstance(record, PipelineBarrier):
        return image in wait.images if record.images else (True if _of_aspect(record, resolve) else None)
    if wait.run is own.run and record.srcSubpass == resolve.subpass and own.run is not None:
        leads = record.dstSubpass == "EXTERNAL" or (reader.run is own.run and reader.time == wait.time)
        return True if leads and _of_aspect(record, resolve) else None
    into = wait.run is not None and wait.run.begin_time <= reader.time <= wait.run.end_time and record.srcSubpass == "EXTERNAL"
    return True if into and _of_aspect(record, resolve) else None


def _images(barrier: PipelineBarrier) -> frozenset[str | None]:
    return frozenset(each.image if isinstance(each, ImageBarrier) else each for each in barrier.images)


def _names_images(wait: Wait) -> bool:
    return isinstance(wait.record, PipelineBarrier) and bool(wait.record.images)


def _of_aspect(record: SubpassDependency | PipelineBarrier, resolve: Resolve) -> bool:
    """Whether what a global wait makes available is what somebody takes the resolve to write."""
    accesses, stages = frozenset(record.srcAccessMask or ()), frozenset(record.srcStageMask or ())
    if resolve.kind == "command":
        return not accesses.isdisjoint(_TRANSFER_WRITES | _COLOR_WRITES)
    if resolve.aspect == "color":
        return not accesses.isdisjoint(_COLOR_WRITES)
    return not accesses.isdisjoint(_DEPTH_WRITES) or (not accesses and not stages.isdisjoint(_DEPTH_STAGES))


def _stages(event: Event) -> frozenset[str] | None:
    """The stages in which an event reads; None where nothing waits for it that a frame states."""
    if event.kind == READ and event.command is not None and isinstance(event.command.body, ReadImage):
        stage = event.command.body.stage
        if stage is None:
            return _ALL
        return frozenset({"RAY_TRACING_SHADER_KHR" if stage in _RAYS else _SHADERS.get(stage, stage)})
    if event.kind == INPUT:
        return frozenset({"FRAGMENT_SHADER"})
    if event.kind in (COPY_READ, RESOLVE_READ):
        return _TRANSFERS
    if event.kind in (LOAD, DRAW):
        return frozenset({"COLOR_ATTACHMENT_OUTPUT"}) if event.aspect in ("color", None) else _DEPTH_STAGES
    return None


def _meets(stages: tuple[str, ...], wanted: frozenset[str]) -> bool:
    """Whether a wait's stages have, by name or as part of all, one of those."""
    named = frozenset(stages)
    if "ALL_COMMANDS" in named or "ALL_COMMANDS" in wanted or not named.isdisjoint(wanted):
        return True
    if "ALL_GRAPHICS" in named:
        return not wanted.isdisjoint(_ORDER) or "ALL_GRAPHICS" in wanted
    return "ALL_GRAPHICS" in wanted and not named.isdisjoint(_ORDER)


def _reaches(stages: tuple[str, ...], wanted: frozenset[str]) -> bool:
    """Whether what is held back until a wait is over has a part in some stages: those after its own too."""
    if _meets(stages, wanted) or "TOP_OF_PIPE" in stages or "BOTTOM_OF_PIPE" in wanted:
        return True
    if not _TRANSFERS.isdisjoint(stages) and not _TRANSFERS.isdisjoint(wanted):
        return True
    earliest = min((_ORDER[stage] for stage in stages if stage in _ORDER), default=None)
    latest = max((_ORDER[stage] for stage in wanted if stage in _ORDER), default=None)
    return earliest is not None and latest is not None and earliest <= latest
