"""Times plans in turn, frame by frame, so that a device that slows down or speeds up affects all of
them. Only `worker` calls this.
"""

from __future__ import annotations

import random
import time
from collections.abc import Iterator, Mapping, Sequence
from statistics import median
from typing import Any, NamedTuple

from .build import FrameObjects, SharedImages
from .draw import Recorder
from .execute import segments
from .opening import Emit, OpenDevice, Session
from .parts import Step, from_json
from .submit import Submitter
from .timed import Item, TimingOptions, Work
from .vulkan_errors import VulkanError
from .workload import Workload

STEADY = 0.01
"""Clocks are stable when the medians of two successive groups of frames differ by less than this
share.
"""

GROUP = 8
"""Frames in a group."""

MIN_SPAN = 0.5
"""Milliseconds that a measurement takes at least on a GPU: shorter frames are repeated within it,
as clocks tick in microseconds.
"""

MAX_LOOPS = 32

LONG = 4.0
"""Milliseconds from which one frame of an item in a round is enough, without one before it that is
not counted.
"""

FRAGMENT_INVOCATIONS = 0x80
"""VK_QUERY_PIPELINE_STATISTIC_FRAGMENT_SHADER_INVOCATIONS_BIT."""

PIPELINE_STATISTICS = 1
"""VK_QUERY_TYPE_PIPELINE_STATISTICS."""


class _Built(NamedTuple):
    """An item on the device. `segments` are the steps of its passes, by the number of the pass."""

    number: int
    objects: FrameObjects
    segments: list[tuple[int, list[Step]]]
    works: tuple[Work, ...]


def run(session: Session, items: Sequence[Any], want: Mapping[str, Any], emit: Emit) -> None:
    """Times items in their JSON form: pairs of a plan and its costs of shading."""
    restored = [
        Item(from_json(plan), tuple(Work(*work) for work in works)) for plan, works in items
    ]
    measure(session, restored, TimingOptions(**want), emit)


def measure(session: Session, items: Sequence[Item], want: TimingOptions, emit: Emit) -> None:
    """Times items in rounds; each round times every item under each of its costs, in another order.

    The events are `pass` with the number of an item before it is touched, `created`, `warmed`,
    `invocations` (those of fragment shaders in a pass of the frame, whose number is `of`, where the
    device counts them), `time` with the item, the cost, the round, and milliseconds, and `done`.
    """
    session.at = None
    session.telling(emit)
    opened = session.opened(items[0].plan) if items else None
    if opened is None:
        emit({"event": "done"})
        return
    shared, workload = SharedImages(opened), Workload(opened)
    built: list[_Built] = []
    timer: _Timer | None = None
    try:
        for work in {work for item in items for work in item.works}:
            workload.prepare(work)
        built += _built(opened, items, shared, emit)
        timer = _Timer(opened, workload)
        if built:
            timer.warm(built, want.warm_seconds, emit)
        for each in built:
            timer.prepare(each, emit)
        # Always in the same sequence of orders.
        orders = random.Random(1)
        end = time.monotonic() + want.seconds
        for turn in range(want.rounds):
            if want.seconds and turn >= want.least_rounds and time.monotonic() >= end:
                break
            pairs = [(each, number) for each in built for number in range(len(each.works))]
            orders.shuffle(pairs)
            for each, number in pairs:
                emit({"event": "pass", "pass": each.number})
                for ms in timer.times(each, number, want.frames):
                    emit(
                        {
                            "event": "time",
                            "pass": each.number,
                            "work": number,
                            "round": turn,
                            "ms": ms,
                            "source": timer.source,
                        }
                    )
    finally:
        if timer is not None:
            timer.close()
        for each in built:
            each.objects.close()
        workload.close()
        shared.close()
    emit({"event": "done"})


def _built(
    opened: OpenDevice, items: Sequence[Item], shared: SharedImages, emit: Emit
) -> Iterator[_Built]:
    """The items that the device can create."""
    for number, item in enumerate(items):
        emit({"event": "pass", "pass": number})
        objects = FrameObjects(opened, item.plan, shared=shared)
        passes = [
            n
            for n, frame_pass in enumerate(item.plan.passes)
            if not (frame_pass.refused or frame_pass.failed)
        ]
        try:
            for each in passes:
                objects.create_pass(each)
        except VulkanError as error:
            objects.close()
            emit({"event": "created", "pass": number, "ok": False, "error": error.name})
            continue
        emit({"event": "created", "pass": number, "ok": True, "error": ""})
        yield _Built(number, objects, list(segments(item.plan, passes)), item.works)


class _Timer:
    """Draws frames and measures their time. Each is recorded once, as that takes longer than many a
    frame.
    """

    def __init__(self, opened: OpenDevice, workload: Workload) -> None:
        self.vk, self.opened, self.workload = opened.vk, opened, workload
        self.source = "timestamp" if opened.device.timestamp_bits else "wall"
        self.software = (
            opened.session.device["properties"]["deviceType"] == self.vk.VK_PHYSICAL_DEVICE_TYPE_CPU
        )
        self.recorded: dict[tuple[int, int], tuple[Submitter, int]] = {}
        """The commands of an item under one of its costs, and how many frames they draw."""
        self.long: set[tuple[int, int]] = set()

    def frame(self, each: _Built, number: int) -> float:
        """The milliseconds of one frame of an item under one of its costs, as the mean of those
        that are recorded.
        """
        if (each.number, number) not in self.recorded:
            self._record(each, number, 1)
        submitter, loops = self.recorded[each.number, number]
        return submitter.submit(timed=True) / loops

    def _record(self, each: _Built, number: int, loops: int) -> None:
        """Records some frames of an item under one of its costs, in place of those that were."""
        submitter, _ = self.recorded.get((each.number, number)) or (
            Submitter(self.opened, timed=True),
            0,
        )
        self.recorded[each.number, number] = submitter, loops
        buffer = submitter.begin(once=False)
        submitter.start()
        for _ in range(loops):
            self._steps(buffer, each, number)
        submitter.stop()
        submitter.finish()

    def _steps(self, buffer: Any, each: _Built, number: int) -> None:
        recorder = self._recorder(buffer, each, number)
        for _, steps in each.segments:
            for step in steps:
                recorder.step(buffer, step)

    def _recorder(self, buffer: Any, each: _Built, number: int) -> Recorder:
        """What records the steps of an item under one of its costs."""
        recorder = Recorder(each.objects, (self.workload, each.works[number]))
        recorder.layouts.fence(buffer)
        return recorder

    def warm(self, built: Sequence[_Built], seconds: float, emit: Emit) -> None:
        """Draws the first item until its times are stable, or for `seconds`. A CPU needs no
        warming.
        """
        first = built[0]
        if self.software:
            emit({"event": "warmed", "stable": True})
            return
        emit({"event": "pass", "pass": first.number})
        end = time.monotonic() + seconds
        before, stable = 0.0, False
        while not stable and time.monotonic() < end:
            group = median(self.frame(first, 0) for _ in range(GROUP))
            stable = abs(group - before) < STEADY * group
            before = group
        emit({"event": "warmed", "stable": stable})

    def prepare(self, each: _Built, emit: Emit) -> None:
        """Counts the invocations of an item. On a GPU, draws it under each cost twice, and decides
        how often a frame is repeated.
        """
        emit({"event": "pass", "pass": each.number})
        for number in range(len(each.works)):
            if self.software:
                break
            self.frame(each, number)
            span = self.frame(each, number)
            if span > LONG:
                self.long.add((each.number, number))
            if 0 < span < MIN_SPAN:
                self._record(each, number, min(int(MIN_SPAN / span) + 1, MAX_LOOPS))
        if self.opened.session.device["features"].get("pipelineStatisticsQuery"):
            for (frame_pass, _), count in zip(each.segments, self._invocations(each), strict=True):
                emit(
                    {"event": "invocations", "pass": each.number, "of": frame_pass, "count": count}
                )

    def times(self, each: _Built, number: int, frames: int) -> Iterator[float]:
        """The milliseconds of some frames in succession, on a GPU after one that is not counted; of
        one frame if it is long.
        """
        is_long = (each.number, number) in self.long
        if not (self.software or is_long):
            self.frame(each, number)
        for _ in range(1 if is_long else frames):
            ms = self.frame(each, number)
            yield round(ms, 6)
            if ms > LONG:
                break

    def _invocations(self, each: _Built) -> list[int]:
        """The invocations of fragment shaders in each segment of an item."""
        vk, handle, size = self.vk, self.opened.handle, len(each.segments)
        if not size:
            return []
        create = vk.VkQueryPoolCreateInfo(
            queryType=PIPELINE_STATISTICS, queryCount=size, pipelineStatistics=FRAGMENT_INVOCATIONS
        )
        queries = vk.vkCreateQueryPool(handle, create, None)
        submitter = Submitter(self.opened)
        buffer = submitter.begin()
        vk.vkCmdResetQueryPool(buffer, queries, 0, size)
        recorder = self._recorder(buffer, each, 0)
        for place, (_, steps) in enumerate(each.segments):
            vk.vkCmdBeginQuery(buffer, queries, place, 0)
            for step in steps:
                recorder.step(buffer, step)
            vk.vkCmdEndQuery(buffer, queries, place)
        submitter.end()
        submitter.close()
        read = vk.ffi.new(f"uint64_t[{size}]")
        # VK_QUERY_RESULT_64_BIT and VK_QUERY_RESULT_WAIT_BIT.
        vk.vkGetQueryPoolResults(handle, queries, 0, size, 8 * size, read, 8, 3)
        vk.vkDestroyQueryPool(handle, queries, None)
        return [int(count) for count in read]

    def close(self) -> None:
        """Destroys its objects."""
        for submitter, _ in self.recorded.values():
            submitter.close()
