"""The times of a pass: their median with a distribution-free confidence interval, and whether two
of them differ.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from statistics import median
from typing import Any, NamedTuple

CONFIDENCE = 0.95

NOTHING = 0.10
"""Relative differences below this are not significant on a software driver: identical work differed
by 5.5 % depending on where a buffer was placed in memory.
"""

PROCESSES = 3
"""Fresh processes over which the repeats are distributed, so that an unlucky memory placement does
not decide.
"""


class Timing(NamedTuple):
    """Milliseconds of a pass: the median of `n` repeats, and the interval that contains the true
    median with probability `confidence`.

    The interval lies between two of the repeats (order statistics). Fewer than six repeats do not
    reach 95 %; `confidence` states what they reach. `source` is `timestamp`, the GPU's clock, or
    `wall`, from submission to the fence.
    """

    median: float
    low: float
    high: float
    n: int
    confidence: float
    source: str

    def json(self) -> dict[str, Any]:
        """The JSON of reports: milliseconds, rounded to nanoseconds."""
        rounded = {name: round(getattr(self, name), 6) for name in ("median", "low", "high")}
        return {
            **rounded,
            "n": self.n,
            "confidence": round(self.confidence, 4),
            "source": self.source,
        }


def ranks(count: int, confidence: float = CONFIDENCE) -> tuple[int, int, float]:
    """The ranks (from 0) among `count` ordered values that bound the median with at least that
    confidence, and the confidence they reach.

    The number of values below the true median has a binomial distribution, whatever the
    distribution of the values. The narrowest symmetric pair is chosen; if even the first and the
    last value do not reach the confidence, those.

    This is the calibrated bootstrap without resampling: the distribution of the median of resamples
    is known in closed form (Efron 1979, "Bootstrap methods: another look at the jackknife", section
    3), and its percentiles are ordered values. For 15 values those of 2.5 and 97.5 % are the same
    ranks. For some counts they are one rank closer to the median, and contain it less often than
    stated: 87.5 % of the time for 7 values.
    """
    if count < 1:
        raise ValueError("no values to take the median of")
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
    """The timing of the repeats of a pass. ValueError without values, and for NaN and infinity."""
    ordered = sorted(values)
    if not all(map(math.isfinite, ordered)):
        raise ValueError("a time is not a finite number")
    low, high, covered = ranks(len(ordered), confidence)
    return Timing(median(ordered), ordered[low], ordered[high], len(ordered), covered, source)


class Difference(NamedTuple):
    """The relative difference of the fixed version's time: a `share` of -0.2 is 20 % less. `real`
    says that it exceeds chance and noise.
    """

    share: float
    real: bool
    text: str


def difference(as_written: Timing, fixed: Timing, software: bool) -> Difference:
    """Compares two timings: they differ if their intervals do not overlap and, on a software
    driver, their medians differ by at least 10 %.
    """
    if as_written.median <= 0:
        return Difference(0.0, False, "no time was measured")
    share = fixed.median / as_written.median - 1
    disjoint = fixed.high < as_written.low or as_written.high < fixed.low
    if software and abs(share) < NOTHING:
        return Difference(
            share, False, "no difference: less than 10 % is not significant on a software driver"
        )
    if not disjoint:
        return Difference(share, False, "no difference: the intervals overlap")
    if as_written.n < 6 or fixed.n < 6:
        return Difference(share, False, "fewer than 6 repeats cannot show a difference")
    return Difference(share, True, f"{abs(share):.0%} {'less' if share < 0 else 'more'} time")


def rounds(repeats: int) -> Iterator[tuple[int, tuple[str, str], int]]:
    """The rounds in which the repeats of the two versions alternate: the process, the order of the
    versions, and the repeats of each.

    The order changes from process to process, and each process runs `A B B A`, so that a machine
    that slows down affects both versions.
    """
    processes = min(PROCESSES, repeats)
    for number in range(processes):
        process_repeats = repeats // processes + (number < repeats % processes)
        first, second = ("as written", "fixed") if number % 2 == 0 else ("fixed", "as written")
        half = process_repeats - process_repeats // 2
        yield number, (first, second), half
        if process_repeats - half:
            yield number, (second, first), process_repeats - half


def cannot_show(device: Mapping[str, Any], tiler: bool | None) -> str:
    """What the times on this device do not show about the cost of multisampling, in words; empty
    for a tile-based GPU.
    """
    if is_software(device):
        return (
            "a software driver has neither tiles nor external memory: loads, stores and "
            "resolves cost what they cost the CPU"
        )
    if tiler is False:
        return (
            "an immediate-mode GPU has no tiles: its times do not show the memory traffic that "
            "a tile-based GPU would save"
        )
    if tiler is None:
        return (
            "it is unknown whether this device renders by tiles: its times may not show the "
            "memory traffic that a tile-based GPU saves"
        )
    return ""


def is_software(device: Mapping[str, Any]) -> bool:
    """Whether a device is the CPU (VK_PHYSICAL_DEVICE_TYPE_CPU)."""
    return str(device.get("type", "")).upper().removeprefix("VK_PHYSICAL_DEVICE_TYPE_") == "CPU"
