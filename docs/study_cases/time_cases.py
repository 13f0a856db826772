"""Cases of times: the interval of their median, how often it contains the true median, and how
often equal techniques seem to differ.
"""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from statistics import median
from typing import Any

import numpy as np

from msaa_lint.experiments.confirm.timing import ranks, timing

from .row import Row

TRIALS = 10_000
"""Simulated sets of times."""


QUANTILES = {2: 12.706, 5: 2.776, 7: 2.447, 15: 2.145, 31: 2.042}
"""The 97.5th percentile of Student's t, by the number of values."""

Interval = Callable[[Sequence[float]], tuple[float, float]]


def student(
    values: Sequence[float], kind: type[np.floating[Any]] = np.float64
) -> tuple[float, float]:
    """The 95 % interval of the mean by Student's t in a precision, with sums in order."""
    times = np.array(values, kind)
    with np.errstate(all="ignore"):
        mean = np.add.accumulate(times)[-1] / kind(len(times))
        variance = np.add.accumulate((times - mean) ** 2)[-1] / kind(len(times) - 1)
        half = kind(QUANTILES.get(len(times), math.nan)) * np.sqrt(variance / kind(len(times)))
        return float(mean - half), float(mean + half)


def ours(values: Sequence[float]) -> tuple[float, float]:
    found = timing(values)
    return found.low, found.high


def resampled_ranks(count: int) -> tuple[int, int]:
    """The ranks (from 0) of the 2.5th and 97.5th percentile of the median of resamples of an odd
    number of values, in rational arithmetic: the bootstrap with infinitely many resamples (Efron
    1979, section 3).
    """
    # The median of a resample is at most the k-th value where more than half of its draws are:
    # those of a binomial distribution.
    shares = [
        sum(
            math.comb(count, n) * Fraction(k, count) ** n * (1 - Fraction(k, count)) ** (count - n)
            for n in range(count // 2 + 1, count + 1)
        )
        for k in range(1, count + 1)
    ]
    low, high = (
        next(k for k, share in enumerate(shares) if share >= level)
        for level in (Fraction(1, 40), Fraction(39, 40))
    )
    return low, high


def contained(low: int, high: int, count: int) -> Fraction:
    """How often the values of two ranks (from 0) are on both sides of the true median."""
    return Fraction(sum(math.comb(count, n) for n in range(low + 1, high + 1)), 2**count)


def disjoint(low: int, high: int, count: int) -> Fraction:
    """How often the intervals of two sets of times from the same distribution do not overlap: all
    orders of the 2 * count times are equally likely, so that the times of one set that are below
    the upper bound of the other have a hypergeometric distribution.
    """
    orders = math.comb(2 * count, count)
    # The bound is the time high + 1 of its set; before it are `high` of its set and at most `low`
    # of the other.
    below = sum(
        math.comb(high + other, high) * math.comb(2 * count - high - other - 1, count - high - 1)
        for other in range(low + 1)
    )
    return 2 * Fraction(below, orders)


def intervals() -> Iterator[Row]:
    """The intervals of a few times, in milliseconds, and how often they are right."""
    for values, words in (
        ([0.1] * 15, "15 times of 0.1 ms"),
        ([0.1] * 5, "5 times of 0.1 ms"),
        ([0.1], "one time"),
    ):
        widths = [
            high - low for low, high in (student(values, np.float32), student(values), ours(values))
        ]
        yield Row(
            "times", f"width of the interval of {words}; naive: Student's t of the mean", 0, *widths
        )
    for values, end, words in (
        ([1.0, 2.0], 0, "lower bound of the interval of 1 and 2 ms, which is a time"),
        (
            [1.0] * 14 + [1000.0],
            1,
            "upper bound of the interval of 14 times of 1 ms and an outlier of 1,000",
        ),
    ):
        bounds = [
            found[end] for found in (student(values, np.float32), student(values), ours(values))
        ]
        yield Row("times", f"{words}; naive: Student's t of the mean", 1, *bounds)
    for count in (7, 15, 31):
        due, resampled = (
            float(contained(low, high, count))
            for low, high in (ranks(count)[:2], resampled_ranks(count))
        )
        case = (
            f"how often the interval of {count} times contains the true median; naive: of "
            "resampled medians; float64: Student's t"
        )
        yield Row(
            "times", case, due, resampled, simulated(student, count), simulated(ours, count), 0.01
        )
    for count in (7, 15):
        low, high, _ = ranks(count)
        results = (
            simulated_difference(lambda times: (median(times), median(times)), count),
            simulated_difference(student, count),
        )
        case = (
            f"how often two sets of {count} times of the same technique seem to differ; naive: "
            "their medians differ; float64: Student's t"
        )
        yield Row(
            "times",
            case,
            float(disjoint(low, high, count)),
            *results,
            simulated_difference(ours, count),
            0.5,
        )


def drawn(chance: random.Random, count: int) -> list[float]:
    """Times of a skewed distribution, whose median is 1.25."""
    return [1 + chance.random() ** 2 for _ in range(count)]


def simulated(interval: Interval, count: int) -> float:
    """How often an interval contained the true median."""
    chance = random.Random(count)
    found = [interval(drawn(chance, count)) for _ in range(TRIALS)]
    return sum(low <= 1.25 <= high for low, high in found) / TRIALS


def simulated_difference(interval: Interval, count: int) -> float:
    """How often the intervals of two sets from the same distribution did not overlap."""
    chance = random.Random(count)
    pairs = [
        (interval(drawn(chance, count)), interval(drawn(chance, count))) for _ in range(TRIALS)
    ]
    return sum(one[1] < other[0] or other[1] < one[0] for one, other in pairs) / TRIALS
