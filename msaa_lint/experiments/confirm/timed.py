"""What is timed in turn, and the times of it, as requested from a child process and collected from
its events.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from statistics import median
from typing import NamedTuple

from .parts import Plan
from .protocol import Event


class Work(NamedTuple):
    """The work of an invocation of a built-in fragment shader (shaders/shaded.frag): `operations`
    multiply-adds, each of which needs the previous one, and `fetches` of four bytes from a texture
    of at most `footprint` bytes.
    """

    operations: int = 0
    fetches: int = 0
    footprint: int = 0


class Item(NamedTuple):
    """A plan, and the work of its `shaded` pipelines to time it with."""

    plan: Plan
    works: tuple[Work, ...]


class TimingOptions(NamedTuple):
    """The options of a request: the number of `rounds`, of `frames` of each item in a round, and of
    seconds after which warming ends. After `seconds`, if not 0, there are no more rounds, once
    there are `least_rounds`.
    """

    rounds: int
    frames: int = 3
    warm_seconds: float = 3.0
    seconds: float = 0.0
    least_rounds: int = 3


class TimedItem(NamedTuple):
    """The times of an item: for each of its works the median of every round, in milliseconds.
    `counts` are the fragment shader invocations of each pass of a frame, by its number, None where
    the device does not count them. `reason` says why there are no times.
    """

    times: tuple[tuple[float, ...], ...] = ()
    counts: Mapping[int, int] | None = None
    reason: str = ""

    def invocations(self, passes: Collection[int] | None = None) -> int | None:
        """The fragment shader invocations of a frame, or of some of its passes."""
        if self.counts is None:
            return None
        return sum(
            count for number, count in self.counts.items() if passes is None or number in passes
        )


class TimedRun(NamedTuple):
    """The times of all items. `source` is `timestamp`, the GPU's clock, or `wall`; `stable` says
    whether times settled before the first round.
    """

    items: Sequence[TimedItem]
    source: str
    stable: bool

    @property
    def rounds(self) -> int:
        """The number of rounds; 0 without times."""
        return max((len(times) for item in self.items for times in item.times), default=0)


class TimedCollector:
    """Collects the events of a request. `at` is the last item that the child announced, as numbered
    in the request.
    """

    def __init__(self, numbers: Sequence[int], ended: Mapping[int, str]) -> None:
        self.at: int | None = None
        self.numbers = numbers
        self.reasons = dict(ended)
        self.source, self.stable = "", False
        self._times: dict[tuple[int, int], dict[int, list[float]]] = {}
        self._counts: dict[int, dict[int, int]] = {}

    def add(self, event: Event) -> None:
        """Takes up an event."""
        kind = event["event"]
        if kind == "failed":
            self.reasons |= dict.fromkeys(self.numbers, str(event["reason"]))
        elif kind == "warmed":
            self.stable = event["stable"]
        number = event.get("pass")
        if not isinstance(number, int) or number >= len(self.numbers):
            return
        item = self.numbers[number]
        if kind == "pass":
            self.at = number
        elif kind == "created" and not event["ok"]:
            self.reasons[item] = f"the driver does not create it: {event.get('error')}"
        elif kind == "invocations":
            counts = self._counts.setdefault(item, {})
            number = event.get("of", 0)
            counts[number] = counts.get(number, 0) + event["count"]
        elif kind == "time":
            rounds = self._times.setdefault((item, int(event.get("work", 0))), {})
            rounds.setdefault(int(event.get("round", 0)), []).append(float(event["ms"]))
            self.source = str(event.get("source", ""))

    def run(self, count: int) -> TimedRun:
        """The times of `count` items."""
        return TimedRun([self._item(number) for number in range(count)], self.source, self.stable)

    def _item(self, item: int) -> TimedItem:
        if item in self.reasons:
            return TimedItem(reason=self.reasons[item])
        works = sorted(work for number, work in self._times if number == item)
        times = tuple(
            tuple(median(frames) for frames in self._times[item, work].values()) for work in works
        )
        return TimedItem(times, self._counts.get(item), "" if times else "no time was measured")
