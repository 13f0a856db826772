"""What a frame states between a write and its first reader: dependencies of passes, and recorded
barriers.

The writes are a resolve, and for vkCmdResolveImage also the rendering whose samples it reads. A
resolve at the end of a subpass or a rendering runs in COLOR_ATTACHMENT_OUTPUT with
COLOR_ATTACHMENT_WRITE, of depth and stencil too (Vulkan specification, Render Pass: Render Pass
Multisample Resolve Operations).
"""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Iterator
from typing import NamedTuple

from msaa_lint.core.text.span import Span
from msaa_lint.frame.description.models import (
    ImageBarrier,
    PipelineBarrier,
    ReadImage,
    RenderPass,
    SubpassDependency,
)

from .commands import COPY_READ, READ, RESOLVE_READ
from .event_search import EventSearch, reads
from .facts import Facts
from .parts import Attachment, Resolve
from .pipeline_stages import (
    ALL_STAGES,
    Stages,
    first_scope,
    includes_access,
    second_scope,
    stated_stages,
)
from .timeline import DRAW, INPUT, LOAD, STORE, Event
from .walk import PassRun

Region = tuple[int, int] | None
"""The commands of one subpass, by the identity of its run and its start; None: all commands, before
or after.
"""

COLOR = ("COLOR_ATTACHMENT_OUTPUT", "COLOR_ATTACHMENT_WRITE")
DEPTH = ("LATE_FRAGMENT_TESTS", "DEPTH_STENCIL_ATTACHMENT_WRITE")
TRANSFER = ("TRANSFER", "TRANSFER_WRITE")

_SHADERS = {
    "FRAGMENT": "FRAGMENT_SHADER", "VERTEX": "VERTEX_SHADER", "COMPUTE": "COMPUTE_SHADER",
    "GEOMETRY": "GEOMETRY_SHADER",
    "TESSELLATION_CONTROL": "TESSELLATION_CONTROL_SHADER",
    "TESSELLATION_EVALUATION": "TESSELLATION_EVALUATION_SHADER",
    "TASK_EXT": "TASK_SHADER_EXT", "MESH_EXT": "MESH_SHADER_EXT", "ALL": "ALL_COMMANDS",
}  # fmt: skip
_RAYS = (
    "RAYGEN_KHR",
    "ANY_HIT_KHR",
    "CLOSEST_HIT_KHR",
    "MISS_KHR",
    "INTERSECTION_KHR",
    "CALLABLE_KHR",
)
_COPIES = {
    "copyImage": "COPY",
    "copyImageToBuffer": "COPY",
    "blitImage": "BLIT",
    "resolveImage": "RESOLVE",
}


class Wait(NamedTuple):
    """One stated wait: a dependency of a run of a pass, or a recorded barrier (`run` is None), and
    the commands that it orders.
    """

    time: int
    record: SubpassDependency | PipelineBarrier
    run: PassRun | None = None
    images: frozenset[str | None] = frozenset()
    """The images that a barrier names."""
    source: Region = None
    target: Region = None

    def concerns(self, image: str) -> bool:
        """Whether its access scopes include an image; its synchronization scopes include every
        command.
        """
        return not self.images or image in self.images

    @property
    def states_accesses(self) -> bool:
        """Whether it says anything of memory: a wait that states neither access mask is taken to
        leave them out.
        """
        return self.record.states("srcAccessMask") or self.record.states("dstAccessMask")

    def covers_write(self, write: Write) -> bool:
        """Whether it waits for a write and makes it available."""
        return self._covers_stage(write) and self._covers_access(write)

    def _covers_stage(self, write: Write) -> bool:
        stages = stated_stages(self.record.srcStageMask or ())
        return ("RESOLVE" if write.stage == "TRANSFER" else write.stage) in stages

    def _covers_access(self, write: Write) -> bool:
        mask = self.record.srcAccessMask
        return mask is None or not self.states_accesses or includes_access(mask, write.access)

    def covers_reader_stage(self, reader: Reader) -> bool:
        """Whether its second access scope includes a reader's stage."""
        mask = self.record.dstStageMask
        if mask is None or not self.record.states("dstStageMask") or reader.stages is None:
            return True
        return not stated_stages(mask).isdisjoint(reader.stages)

    def covers_reader_access(self, reader: Reader) -> bool:
        """Whether its second access scope includes a reader's access."""
        mask = self.record.dstAccessMask
        if mask is None or not self.states_accesses or reader.accesses is None:
            return True
        return any(includes_access(mask, access) for access in reader.accesses)

    def makes_visible_to(self, reader: Reader) -> bool:
        """Whether its second access scope includes a reader."""
        return self.covers_reader_stage(reader) and self.covers_reader_access(reader)

    def lacks(self, write: Write, reader: Reader) -> tuple[str, str, Span]:
        """Why it does not order a reader after a write: in words, what to add to it, and where."""
        place = self.record.place
        if not self._covers_stage(write):
            stages = ", ".join(self.record.srcStageMask or ()) or "NONE"
            found = f"after waiting for {stages}, but its {write.word} runs in {write.stage}"
            return found, f"{write.stage} to srcStageMask", place("srcStageMask")
        if not self._covers_access(write):
            found = f"after a wait that does not make its {write.word} available"
            return found, f"{write.access} to srcAccessMask", place("srcAccessMask", "srcStageMask")
        found = f"in {reader.stage}, to which its {write.word} is not made visible"
        if not self.covers_reader_stage(reader):
            access = (
                ""
                if self.covers_reader_access(reader)
                else f" and {reader.access} to dstAccessMask"
            )
            return found, f"{reader.stage} to dstStageMask{access}", place("dstStageMask")
        return found, f"{reader.access} to dstAccessMask", place("dstAccessMask", "dstStageMask")


class Write(NamedTuple):
    """A write: its event, the stage and the access that it runs with, the commands that it is
    among, and what messages call it.
    """

    event: Event
    stage: str
    access: str
    region: Region
    word: str


class Reader(NamedTuple):
    """A reader: its event, and the stages and accesses of which it has at least one each; None
    where it may have any.

    `stage` and `access` are those that a wait is to be given.
    """

    event: Event
    region: Region
    stages: Stages | None
    accesses: tuple[str, ...] | None
    stage: str = ""
    access: str = ""


class Pair(NamedTuple):
    """A write, its first reader, and whether it is stated that the reader waits for the write.

    `meant` is the first wait that is stated for the two, if there is one.
    """

    image: str
    write: Write
    reader: Reader
    waits: bool
    meant: Wait | None
    in_pass: bool
    later: bool
    """The reader is in the next frame."""


class Waits:
    """The waits of a frame, in order."""

    def __init__(self, search: EventSearch) -> None:
        self.search = search
        self._runs = (
            sorted(search.timeline.walk.runs, key=lambda run: run.begin_time)
            if search.timeline.ordered
            else []
        )
        self._begins = [run.begin_time for run in self._runs]
        self._barriers = [
            Wait(2 * position, body, None, _images(body))
            for position, body in search.frame.recorded(PipelineBarrier)
        ]
        self._every = [wait for run in self._runs for wait in _of_run(run)] + self._barriers
        self._every.sort(key=lambda wait: wait.time)
        self._times = [wait.time for wait in self._every]
        self._captured = search.frame.document.source.origins is not None
        """Whether the frame is from a capture: it states all dependencies and barriers, but a
        shader may not read what is bound to it.
        """

    def put(self, facts: Facts, resolve: Resolve) -> None:
        """Adds what is known of the waits between a resolve and the first reader of what it
        wrote.
        """
        stage, access = TRANSFER if resolve.kind == "command" else COLOR
        facts.put("resolve.stage", stage)
        facts.put("resolve.access", access)
        known = [pair for pair in self._pairs(resolve) if pair is not None]
        if not known:
            return
        # A stated wait that is wrong is surer than one that is missing.
        pair = min(known, key=lambda pair: (pair.waits, pair.meant is None))
        write, reader = pair.write, pair.reader
        facts.put("resolve.waited_for", pair.waits)
        facts.put("resolve.read_in_pass", pair.in_pass)
        facts.put("resolve.read_next_frame", pair.later)
        facts.put("resolve.stage", write.stage)
        facts.put("resolve.access", write.access)
        facts.put("resolve.wait_stated", pair.meant is not None)
        if reader.stage:
            facts.put("resolve.reader_stage", reader.stage)
            facts.put("resolve.reader_access", reader.access)
        if pair.meant is not None:
            record = pair.meant.record
            facts.put(
                "resolve.waiting_stages",
                list(record.srcStageMask or ()) or ["NONE"],
                record.place("srcStageMask"),
            )
        if pair.waits:
            return
        target = self.search.frame.target(pair.image)
        facts.put("resolve.read_early", target.title if target is not None else pair.image)
        if pair.meant is not None:
            found, lacks, at = pair.meant.lacks(write, reader)
        else:
            wait = "dependency" if pair.in_pass else "barrier"
            found = f"without a {wait} after its {write.word}"
            lacks = f"one from {write.stage} and {write.access}"
            lacks += f" to {reader.stage} and {reader.access}" if reader.stage else ""
            at = reader.event.place
        facts.put("resolve.wait_found", found)
        facts.put("resolve.wait_lacks", lacks, at)

    def _pairs(self, resolve: Resolve) -> Iterator[Pair | None]:
        if resolve.kind == "command":
            yield self._rendered(resolve)
        stage, access = TRANSFER if resolve.kind == "command" else COLOR
        for ref in self.search.written_at(resolve):
            event = self.search.event(ref)
            region = (
                (id(event.run), event.run.starts[resolve.subpass])
                if event.run is not None
                else None
            )
            reader, later = self.search.first_use(ref)
            if (
                reader is not None
                and reads(reader)
                and not (event.aspect == "color" and reader.kind == DRAW)
            ):
                yield self._pair(
                    ref.image, Write(event, stage, access, region, "resolve"), reader, later
                )

    def _rendered(self, resolve: Resolve) -> Pair | None:
        """The rendering that wrote the samples that a resolve command reads; None where something
        else did, or in the last frame.
        """
        image = resolve.source_image
        events = self.search.of.get(image.name, []) if image is not None else []
        number = next(
            (
                n
                for n, event in enumerate(events)
                if event.kind == RESOLVE_READ and event.source is resolve
            ),
            None,
        )
        if image is None or not number:
            return None
        event = events[number - 1]
        if (
            event.kind != STORE
            or not event.certain
            or event.run is None
            or not isinstance(event.source, Attachment)
        ):
            return None
        attachment = event.source
        stage, access = COLOR if event.aspect == "color" else DEPTH
        used = [*attachment.color, *attachment.depth_stencil]
        if not used:
            return None
        write = Write(
            event, stage, access, (id(event.run), event.run.starts[max(used)]), "rendering"
        )
        return self._pair(image.name, write, events[number], False)

    def _pair(self, image: str, write: Write, event: Event, later: bool) -> Pair | None:
        """None where too little is known of the reader, or of what is stated for it."""
        in_pass = event.run is not None and event.run is write.event.run and not later
        reader = self._reader(event)
        if reader is None or not (in_pass or self.search.frame.has_commands):
            return None
        waits = self._between(write.event.time, event.time, later)
        self.search.steps_left -= len(waits)
        if self.search.steps_left < 0:
            return None
        synchronized = _synchronized(waits, image, write, reader)
        meant = next((wait for wait in waits if _is_meant(wait, image, write, reader)), None)
        if (
            synchronized is False
            and meant is None
            and not self._states_waits(in_pass, later, write, reader)
        ):
            return None
        return (
            Pair(image, write, reader, synchronized, meant, in_pass, later)
            if synchronized is not None
            else None
        )

    def _states_waits(self, in_pass: bool, later: bool, write: Write, reader: Reader) -> bool:
        """Whether a wait that is not stated is known to be missing: within a pass that states
        dependencies, in commands with barriers.
        """
        if in_pass:
            record = write.event.run.render_pass.record if write.event.run is not None else None
            return isinstance(record, RenderPass) and (
                self._captured or record.states("dependencies")
            )
        if reader.event.kind == RESOLVE_READ and not self._captured:
            # A description may begin where a resolve command does.
            return False
        certain = (
            not self._captured
            or reader.event.kind != READ
            or _stated_access(reader.event) is not None
        )
        return bool(self._barriers) and not later and certain

    def _reader(self, event: Event) -> Reader | None:
        """None where nothing waits for it that a frame states."""
        region = self._region(event.time)
        if (
            event.kind == READ
            and event.command is not None
            and isinstance(event.command.body, ReadImage)
        ):
            stage, access = _shader_read(event.command.body, self._captured)
            if stage == "":
                return Reader(event, region, None, access)
            return Reader(
                event,
                region,
                stated_stages((stage,)),
                access,
                stage,
                "SHADER_READ" if access is None else access[0],
            )
        if event.kind == INPUT:
            return _one(event, region, "FRAGMENT_SHADER", "INPUT_ATTACHMENT_READ")
        if event.kind in (COPY_READ, RESOLVE_READ) and event.command is not None:
            stage = _COPIES.get(event.command.kind, "TRANSFER")
            return Reader(
                event, region, frozenset({stage}), ("TRANSFER_READ",), "TRANSFER", "TRANSFER_READ"
            )
        if event.kind == LOAD:
            if event.aspect in ("color", None):
                return _one(event, region, "COLOR_ATTACHMENT_OUTPUT", "COLOR_ATTACHMENT_READ")
            return _one(event, region, "EARLY_FRAGMENT_TESTS", "DEPTH_STENCIL_ATTACHMENT_READ")
        if event.kind == DRAW:
            stages = frozenset({"EARLY_FRAGMENT_TESTS", "LATE_FRAGMENT_TESTS"})
            accesses = ("DEPTH_STENCIL_ATTACHMENT_READ", "DEPTH_STENCIL_ATTACHMENT_WRITE")
            return Reader(event, region, stages, accesses, "EARLY_FRAGMENT_TESTS", accesses[0])
        return None

    def _region(self, time: int) -> Region:
        """The subpass that runs at a time."""
        number = bisect_right(self._begins, time) - 1
        if number < 0 or time > self._runs[number].end_time:
            return None
        run = self._runs[number]
        starts = [start for start in run.starts if start <= time]
        return (id(run), starts[-1] if starts else run.starts[0])

    def _between(self, start: int, end: int, later: bool) -> list[Wait]:
        """The waits from one time up to another, round the loop where that is in the next frame."""
        first, last = bisect_left(self._times, start), bisect_right(self._times, end)
        return [*self._every[first:], *self._every[:last]] if later else self._every[first:last]


def _synchronized(waits: list[Wait], image: str, write: Write, reader: Reader) -> bool | None:
    """Whether waits make a write visible to a reader; None where the stages of one that may are not
    stated.

    The first wait of a chain includes the write's stage and access in what is stated; each further
    one waits for what the one before holds back; the last one includes the reader's stage and
    access in what is stated. (Vulkan specification, Execution and Memory Dependencies)
    """
    unknown = False
    held_back: list[tuple[Region, Stages]] = []
    for wait in waits:
        record = wait.record
        if record.srcStageMask is None or not record.states("srcStageMask"):
            unknown |= wait.concerns(image)
            continue
        direct = (
            wait.concerns(image)
            and wait.source in (None, write.region)
            and wait.covers_write(write)
        )
        scope = first_scope(record.srcStageMask)
        if not direct and not any(
            _meets(region, wait.source) and stages & scope for region, stages in held_back
        ):
            continue
        stated = record.dstStageMask is not None and record.states("dstStageMask")
        held_back.append(
            (wait.target, second_scope(record.dstStageMask or ()) if stated else ALL_STAGES)
        )
        if (
            wait.concerns(image)
            and wait.target in (None, reader.region)
            and wait.makes_visible_to(reader)
        ):
            return True
    return None if unknown else False


def _meets(one: Region, other: Region) -> bool:
    return one is None or other is None or one == other


def _is_meant(wait: Wait, image: str, write: Write, reader: Reader) -> bool:
    """Whether a wait is stated for a write and its reader, by its image, or by its subpasses,
    stages and accesses.
    """
    if wait.source not in (None, write.region) or wait.target not in (None, reader.region):
        return False
    if wait.images:
        return image in wait.images
    return _is_of_write(wait.record, write) and wait.covers_reader_stage(reader)


def _is_of_write(record: SubpassDependency | PipelineBarrier, write: Write) -> bool:
    """Whether what a wait for all memory makes available is what somebody takes a write to be."""
    taken = [
        (write.stage, write.access),
        DEPTH if write.event.aspect in ("depth", "stencil") else COLOR,
    ]
    accesses, stages = record.srcAccessMask or (), stated_stages(record.srcStageMask or ())
    if any(access.endswith("_WRITE") for access in accesses):
        return any(includes_access(accesses, access) for _, access in taken)
    tests = {"EARLY_FRAGMENT_TESTS"} if DEPTH in taken else set()
    return not stages.isdisjoint(
        tests.union(*(stated_stages((stage,)) for stage, _ in taken))
    ) or "BOTTOM_OF_PIPE" in (record.srcStageMask or ())


def _of_run(run: PassRun) -> Iterator[Wait]:
    """The dependencies of a pass, where they take effect."""
    record = run.render_pass.record
    for dependency in record.dependencies if isinstance(record, RenderPass) else ():
        source, into = (
            _subpass(run, number) for number in (dependency.srcSubpass, dependency.dstSubpass)
        )
        if dependency.dstSubpass == "EXTERNAL":
            yield Wait(run.end_time, dependency, run, source=source)
        elif into is not None:
            yield Wait(
                run.begin_time if dependency.srcSubpass == "EXTERNAL" else into[1],
                dependency,
                run,
                source=source,
                target=into,
            )


def _subpass(run: PassRun, number: int | str | None) -> Region:
    return (
        (id(run), run.starts[number])
        if isinstance(number, int) and number < len(run.starts)
        else None
    )


def _images(barrier: PipelineBarrier) -> frozenset[str | None]:
    return frozenset(
        each.image if isinstance(each, ImageBarrier) else each for each in barrier.images
    )


def _one(event: Event, region: Region, stage: str, access: str) -> Reader:
    return Reader(event, region, frozenset({stage}), (access,), stage, access)


def _stated_access(event: Event) -> str | None:
    return (
        event.command.body.access
        if event.command is not None and isinstance(event.command.body, ReadImage)
        else None
    )


def _shader_read(body: ReadImage, captured: bool) -> tuple[str, tuple[str, ...] | None]:
    """The stage of a read, empty where it is not known, and the accesses of which it has one; None
    where it may have any.

    A capture names a stage for everything that the bound descriptors hold, and states an access
    where both are certain.
    """
    stage = body.stage
    if stage is not None:
        stage = "RAY_TRACING_SHADER_KHR" if stage in _RAYS else _SHADERS.get(stage, stage)
    if stage is None or (captured and body.access is None):
        return "", None
    if body.access in (None, "MEMORY_READ"):
        transfer = not stated_stages((stage,)).isdisjoint(stated_stages(("TRANSFER",)))
        shader = ("SHADER_SAMPLED_READ", "SHADER_STORAGE_READ", "INPUT_ATTACHMENT_READ")
        return stage, None if stage == "ALL_COMMANDS" else (
            "TRANSFER_READ",
        ) if transfer else shader
    return stage, (
        "SHADER_SAMPLED_READ",
        "SHADER_STORAGE_READ",
    ) if body.access == "SHADER_READ" else (body.access,)
