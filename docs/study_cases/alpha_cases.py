"""Cases of alpha to coverage: the number of samples at every alpha where it changes and beside it,
and its bias.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from msaa_lint.experiments.study.effects import BAYER, alpha_coverage
from msaa_lint.experiments.study.points import COUNTS

from .row import Row

Alphas = NDArray[np.float32]

GROUP = "alpha to coverage"

THRESHOLDS = BAYER.ravel()
"""Of the 16 pixels of a block."""

SPECIAL = (0.0, -0.0, 2.0**-149, 2.0**-126, math.nan, math.inf, -math.inf, -0.5, -1.0, 1.5, 65504.0)
CODES: Alphas = (np.arange(256) / 255).astype(np.float32)


def alphas(samples: int) -> Alphas:
    """Every alpha at which a pixel of a block takes one sample more, or all take one more, and the
    single-precision numbers beside it; the 256 codes of 8 bits, and numbers that are no share:
    negative ones, those above 1, infinities, NaN.
    """
    steps = (np.arange(32 * samples + 1) / (32 * samples)).astype(np.float32)
    beside = [np.nextafter(steps, np.float32(toward)) for toward in (-1, 2)]
    return np.concatenate([steps, *beside, CODES, np.array(SPECIAL, np.float32)])


def exact_count(alpha: float, threshold: float | None, samples: int) -> int:
    """The number of samples, in rational arithmetic: alpha * samples plus the threshold, rounded
    down; rounded up without one.
    """
    if math.isnan(alpha) or alpha <= 0:
        return 0
    share = Fraction(min(alpha, 1.0)) * samples
    return min(
        math.ceil(share) if threshold is None else math.floor(share + Fraction(threshold)), samples
    )


def grid(samples: int, threshold: Alphas | None) -> tuple[Alphas, Alphas | None, NDArray[Any]]:
    """Each alpha with each threshold, and the exact numbers of samples."""
    values = alphas(samples)
    if threshold is None:
        return (
            values,
            None,
            np.array([exact_count(float(alpha), None, samples) for alpha in values], np.float64),
        )
    every = np.repeat(values, len(threshold))
    each = np.tile(threshold, len(values))
    return (
        every,
        each,
        np.array(
            [exact_count(float(a), float(t), samples) for a, t in zip(every, each, strict=True)],
            np.float64,
        ),
    )


def ours(alpha: Alphas, threshold: Alphas | None, samples: int) -> NDArray[Any]:
    """The numbers of samples of the study."""
    return np.bitwise_count(alpha_coverage(alpha, threshold, samples)).astype(np.float64)


def floating(
    alpha: Alphas, threshold: Alphas | None, samples: int, kind: type[np.floating]
) -> NDArray[Any]:
    """The numbers of samples as shaders often have them, in a precision: a sum rounded down, or the
    next integer without thresholds.
    """
    share = np.fmin(np.fmax(alpha.astype(kind), kind(0)), kind(1)) * kind(samples)
    count = np.floor(share) + 1 if threshold is None else np.floor(share + threshold.astype(kind))
    return np.asarray(np.minimum(count, samples), np.float64)


def block_error(counts: NDArray[Any], samples: int) -> float:
    """The greatest difference of the coverage of a 4x4 block from alpha, over the 256 codes;
    `counts` (256, 16).
    """
    return float(
        max(
            abs(Fraction(int(sum(row)), 16 * samples) - Fraction(float(alpha)))
            for row, alpha in zip(counts, CODES, strict=True)
        )
    )


def bias(counts: NDArray[Any], samples: int) -> float:
    """The mean coverage of the 256 codes minus their mean; `counts` (256,)."""
    return float(
        Fraction(int(sum(counts)), 256 * samples)
        - sum((Fraction(float(alpha)) for alpha in CODES), Fraction(0)) / 256
    )


def alpha_to_coverage() -> Iterator[Row]:
    """The number of wrong counts of samples, the greatest error of a block, and the bias."""
    for samples in COUNTS:
        case = f"dithered, {samples}x: wrong counts, naive: floor(alpha * {samples} + threshold)"
        yield _counts(case, samples, THRESHOLDS)
    for samples in COUNTS:
        yield _counts(
            f"ceil, {samples}x: wrong counts, naive: floor(alpha * {samples}) + 1", samples, None
        )
    for samples in COUNTS:
        case = (
            f"dithered, {samples}x: greatest error of a 4x4 block over 256 alphas; naive: the "
            "nearest count in every pixel"
        )
        every, each = np.repeat(CODES, 16), np.tile(THRESHOLDS, 256)
        exact = np.array(
            [exact_count(float(a), float(t), samples) for a, t in zip(every, each, strict=True)]
        )
        nearest, double = (
            np.rint(every * np.float32(samples)),
            floating(every, each, samples, np.float64),
        )
        results = (exact, nearest, double, ours(every, each, samples))
        yield Row(
            GROUP, case, *(block_error(counts.reshape(256, 16), samples) for counts in results)
        )
    for samples in COUNTS:
        up = np.array([exact_count(float(alpha), None, samples) for alpha in CODES])
        nearest, double = (
            np.rint(CODES * np.float32(samples)),
            floating(CODES, None, samples, np.float64),
        )
        results = (up, nearest, double, ours(CODES, None, samples))
        case = (
            f"ceil, {samples}x: bias over 256 alphas; naive: the nearest count; float64: "
            f"floor(alpha * {samples}) + 1"
        )
        yield Row(GROUP, case, *(bias(counts, samples) for counts in results))


def _counts(case: str, samples: int, thresholds: Alphas | None) -> Row:
    alpha, threshold, exact = grid(samples, thresholds)
    results = (
        floating(alpha, threshold, samples, np.float32),
        floating(alpha, threshold, samples, np.float64),
    )
    found = [
        float(np.count_nonzero(counts != exact))
        for counts in (*results, ours(alpha, threshold, samples))
    ]
    return Row(GROUP, case.replace("counts,", f"counts of {len(alpha):,};"), 0, *found)
