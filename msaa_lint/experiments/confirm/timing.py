"""Times of a pass: their median with an interval that supposes no distribution, and whether two of them differ at all."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple

CONFIDENCE = 0.95

NOTHING = 0.10
"""Share below which a difference on a software driver is none: identical work showed 5.5 % there, where a buffer lies being enough."""

PROCESSES = 3
"""Fresh processes that the repeats are spread over, so that one unlucky placement of memory does not decide."""


class Timing(NamedTuple):
    """Milliseconds of a pass: the median of `n` repeats, and the interval that holds the true median with `confidence`.

    The interval is between two of the repeats themselves (order statistics). Fewer than six repeats do not reach 95 %; what they do reach
    is stated. `source` is `timestamp`, the GPU's own clock, or `wall`, from submission to the fence.
    """

    median: float
    low: float
    high: float
    n: int
    confidence: float
    source: str

    def json(self) -> dict[str, Any]:
        """As the report has it: milliseconds, to the nanosecond."""
        rounded = {name: round(getattr(self, name), 6) for name in ("median", "low", "high")}
        return {**rounded, "n": self.n, "confidence": round(self.confidence, 4), "source": self.source}


def median(values: Sequence[float]) -> float:
    """The middle one, or the mean of the two in the middle. ValueError of none."""
    if not values:
        raise ValueError("the median of nothing")
    ordered = sorted(values)
    half = len(ordered) // 2
    return ordered[half] if len(ordered) % 2 else (ordered[half - 1] + ordered[half]) / 2


def ranks(count: int, confidence: float = CONFIDENCE) -> tuple[int, int, float]:
    """Which of `count` ordered values (from 0) bound the median with at least that confidence, and with which they do.

    The number of values below the true median is binomial, whatever they are distributed like. The narrowest symmetric pair is taken;
    where even the first and the last do not do, those.
    """
    if count < 1:
        raise ValueError("the median of nothing")
    outside = 0
    best = 0, count - 1, max(1 - 2 * 0.5**count, 0.0)
    for below in range(count // 2):
        outside += math.comb(count, below)
        covered = 1 - outside / 2 ** (count - 1)
        if covered < confidence:
            break
        best = below, count - 1 - below, covered
    return best


def timing(values: Sequence[float], source: str = "wall", confidence: float = CONFIDENCE) -> Timing:
    """The repeats of a pass as its timing."""
    ordered = sorted(values)
    low, high, covered = ranks(len(ordered), confidence)
    return Timing(median(ordered), ordered[low], ordered[high], len(ordered), covered, source)


class Difference(NamedTuple):
    """What the fixed version's time is to that as written: `share` -0.2 is 20 % less. `real` where it is more than chance and noise."""

    share: float
    real: bool
    text: str


def difference(as_written: Timing, fixed: Timing, software: bool) -> Difference:
    """Compares two timings: they differ where their intervals lie apart and, on a software driver, the medians by 10 % at least."""
    if as_written.median <= 0:
        return Difference(0.0, False, "no time was measured")
    share = fixed.median / as_written.median - 1
    apart = fixed.high < as_written.low or as_written.high < fixed.low
    if software and abs(share) < NOTHING:
        return Difference(share, False, "no difference: less than 10 % is nothing on a software driver")
    if not apart:
        return Difference(share, False, "no difference: the intervals overlap")
    if as_written.n < 6 or fixed.n < 6:
        return Difference(share, False, "no difference can be told of fewer than 6 repeats")
    return Difference(share, True, f"{abs(share):.0%} {'less' if share < 0 else 'more'} time")


def rounds(repeats: int) -> Iterator[tuple[int, tuple[str, str], int]]:
    """How the repeats of the two versions alternate: by process, the order of the versions in it, and how many each.

    The order changes from process to process, and each is run twice in it as `A B B A`, so that a machine that slows down slows both.
    """
    processes = min(PROCESSES, repeats)
    for number in range(processes):
        own = repeats // processes + (number < repeats % processes)
        first, second = ("as written", "fixed") if number % 2 == 0 else ("fixed", "as written")
        half = own - own // 2
        yield number, (first, second), half
        if own - half:
            yield number, (second, first), own - half


def cannot_show(device: Mapping[str, Any], tiler: bool | None) -> str:
    """What of the cost of multisampling this device's times do not show, in words; empty for a tile-based GPU."""
    if is_software(device):
        return "a software driver has neither tiles nor external memory: loads, stores and resolves cost here what they cost the CPU"
    if tiler is False:
        return "an immediate-mode GPU has no tiles: what a tile-based one would save of memory traffic does not show in its times"
    if tiler is None:
        return "whether this device renders by tiles is not known: its times may not show what a tile-based one saves of memory traffic"
    return ""


def is_software(device: Mapping[str, Any]) -> bool:
    """Whether a device is the CPU (VK_PHYSICAL_DEVICE_TYPE_CPU)."""
    return str(device.get("type", "")).upper().removeprefix("VK_PHYSICAL_DEVICE_TYPE_") == "CPU"
