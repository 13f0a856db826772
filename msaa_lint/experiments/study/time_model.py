"""A model of the times of techniques on a device, fitted to measured times.

A frame takes a fixed time, plus the bytes of samples that it writes, the bytes that it resolves, and its invocations times their cost,
where the pixels at edges have more invocations, and helpers that complete quads. Some of the writing is hidden behind shading.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from .points import Technique
from .shading import Shading

TERMS = (
    "fixed_ms",
    "ms_per_gb_written",
    "ms_per_gb_resolved",
    "ms_per_million_fragments",
    "ms_per_million_samples_shaded",
    "fragments",
    "fragment_helpers",
    "samples_shaded",
    "sample_helpers",
    "hidden",
)
"""The coefficients. Those from `fragments` to `sample_helpers` are times relative to those of a full screen; `hidden` is the share of the
shorter one of writing and shading that the longer one hides."""

_SHADING = slice(TERMS.index("fragments"), TERMS.index("hidden"))
_WRITING = slice(TERMS.index("ms_per_gb_written"), TERMS.index("fragments"))
ROUNDS = 80
"""Rounds in which the fit settles: what is hidden depends on the other coefficients, and weights on residuals."""

POWER = 6
"""The power of residuals whose sum the fit makes small: a high one makes the greatest residual small, and 2 their mean square."""

EXACT = 1e-9
"""Relative residuals below this are rounding."""

MIN_TIMES = 6
"""Fewer times give no model."""


class Terms(NamedTuple):
    """What the time of a technique depends on: gigabytes (10^9) of samples written and of pixels resolved or downscaled; and millions of
    invocations (study/invocations.py): one per fragment, those that sample shading adds, and the helpers of both."""

    gb_written: float = 0.0
    gb_resolved: float = 0.0
    fragments: float = 0.0
    fragment_helpers: float = 0.0
    samples_shaded: float = 0.0
    sample_helpers: float = 0.0


class Prediction(NamedTuple):
    """A time in milliseconds, and the bounds within which the residuals of the fit leave it."""

    time_ms: float
    low_ms: float
    high_ms: float


class MeasuredTime(NamedTuple):
    """A measured time of a technique where a million invocations take `nanoseconds`, and the relative half-width of its interval."""

    technique: Technique
    nanoseconds: float
    time_ms: float
    noise: float = 0.0


class TimeModel(NamedTuple):
    """The model of one scene's times.

    `coefficients` are in the order of TERMS. `ratios` are those of measured to modeled times by technique, each with the nanoseconds of a
    million invocations, in ascending order. `residual` is the greatest relative residual of the fit, `rms` their root mean square, and
    `noise` the greatest relative half-width of the intervals of the measured times.
    """

    scene: str
    coefficients: tuple[float, ...]
    terms: Mapping[Technique, Terms]
    ratios: Mapping[Technique, Sequence[tuple[float, float]]]
    residual: float
    rms: float
    noise: float

    def predict(self, technique: Technique, nanoseconds: float) -> Prediction | None:
        """The time where a million invocations take `nanoseconds`; None for a technique that was not timed.

        It is the model's, corrected by the residuals at the nearest measured costs, between which they change in proportion. It is
        uncertain by half of the difference between these two residuals, or the noise; beyond the measured costs by the greatest residual.
        """
        ratios = self.ratios.get(technique, ())
        if not ratios:
            return None
        modeled = _time(self.coefficients, self.terms[technique], nanoseconds)
        below = [each for each in ratios if each[0] <= nanoseconds]
        above = [each for each in ratios if each[0] >= nanoseconds]
        if below and above:
            (low, one), (high, other) = below[-1], above[0]
            share = (nanoseconds - low) / (high - low) if high > low else 0.0
            ratio, uncertainty = one + share * (other - one), max(abs(other - one) / 2, self.noise)
        else:
            ratio, uncertainty = (below[-1] if below else above[0])[1], max(self.residual, self.noise)
        time = modeled * ratio
        return Prediction(time, time * (1 - uncertainty), time * (1 + uncertainty))


def fit(scene: str, measured: Sequence[MeasuredTime], terms: Mapping[Technique, Terms]) -> TimeModel | None:
    """The model with small relative residuals, and with coefficients that are not negative; None where the times cannot
    check it: for fewer than MIN_TIMES, for no more than coefficients, and under a single cost, where writing and shading look alike."""
    import numpy as np

    known = [each for each in measured if each.technique in terms and 0 < each.time_ms < math.inf]
    if len(known) < MIN_TIMES or len({each.nanoseconds for each in known}) < 2:
        return None
    times = np.array([each.time_ms for each in known])
    columns = np.array([_columns(terms[each.technique], each.nanoseconds) for each in known])
    coefficients, weights = np.zeros(len(TERMS)), np.ones(len(times))
    for _ in range(ROUNDS):
        writing = columns[:, _WRITING] @ coefficients[_WRITING]
        shading = columns[:, _SHADING] @ coefficients[_SHADING]
        # Half of the way, as the coefficients would otherwise alternate.
        columns[:, -1] = (columns[:, -1] - np.minimum(writing, shading)) / 2
        coefficients = _nonnegative(columns / times[:, None] * weights[:, None], weights)
        # Iteratively reweighted least squares.
        off = np.abs(columns @ coefficients / times - 1)
        weights = 0.7 * weights + 0.3 * np.maximum(off / max(off.max(), EXACT), 1e-3) ** (POWER / 2 - 1)
    coefficients[-1] = min(coefficients[-1], 1.0)
    fitted = tuple(float(value) for value in coefficients)
    if len(known) <= sum(value > 0 for value in fitted) or not all(
        _time(fitted, terms[each.technique], each.nanoseconds) for each in known
    ):
        return None
    ratios: dict[Technique, list[tuple[float, float]]] = {}
    for each in sorted(known, key=lambda each: each.nanoseconds):
        modeled = _time(fitted, terms[each.technique], each.nanoseconds)
        ratios.setdefault(each.technique, []).append((each.nanoseconds, each.time_ms / modeled))
    residuals = [1 / ratio - 1 for curve in ratios.values() for _, ratio in curve]
    rms = float(np.sqrt(np.mean(np.square(residuals))))
    return TimeModel(
        scene, fitted, {technique: terms[technique] for technique in ratios}, ratios, max(map(abs, residuals)), rms,
        max(each.noise for each in known),
    )  # fmt: skip


def model_of(scene: str, costs: Mapping[tuple[Technique, str], Any], shadings: Sequence[Shading]) -> TimeModel | None:
    """The model of the measured costs of a scene (study/times.py) under calibrated costs of shading; None for too few of them."""
    terms = {technique: Terms(*cost.terms) for (technique, _), cost in costs.items() if cost.terms}
    return fit(scene, _measured_times(costs, shadings), terms)


def _measured_times(costs: Mapping[tuple[Technique, str], Any], shadings: Sequence[Shading]) -> list[MeasuredTime]:
    found = []
    for (technique, name), cost in costs.items():
        shading = next((each for each in shadings if each.name == name), None)
        if shading is not None and shading.nanoseconds is not None and cost.time_ms:
            noise = (cost.high_ms - cost.low_ms) / (2 * cost.time_ms) if cost.high_ms is not None and cost.low_ms is not None else 0.0
            found.append(MeasuredTime(technique, shading.nanoseconds, cost.time_ms, noise))
    return found


def _columns(terms: Terms, nanoseconds: float) -> list[float]:
    """What the coefficients are multiplied by; what is hidden depends on them and is 0 here."""
    # Nanoseconds of a million invocations, times millions of them, in milliseconds.
    cost = nanoseconds * 1e-6
    return [
        1.0, terms.gb_written, terms.gb_resolved, terms.fragments, terms.samples_shaded, terms.fragments * cost,
        terms.fragment_helpers * cost, terms.samples_shaded * cost, terms.sample_helpers * cost, 0.0,
    ]  # fmt: skip


def _time(coefficients: Sequence[float], terms: Terms, nanoseconds: float) -> float:
    parts = [column * coefficient for column, coefficient in zip(_columns(terms, nanoseconds), coefficients, strict=True)]
    return sum(parts) - coefficients[-1] * min(sum(parts[_WRITING]), sum(parts[_SHADING]))


def _nonnegative(columns: Any, wanted: Any) -> Any:
    """Coefficients, none of them negative, with nearly the least squares: those that would be negative are 0, the most negative one
    first. Columns are scaled, so that the result does not depend on units; of dependent columns it is the smallest one."""
    import numpy as np

    scale = np.linalg.norm(columns, axis=0)
    usable = scale > 0
    while True:
        result = np.zeros(columns.shape[1])
        if not usable.any():
            return result
        result[usable] = np.linalg.lstsq(columns[:, usable] / scale[usable], wanted, rcond=1e-9)[0]
        if result.min() >= 0:
            return result / np.where(scale > 0, scale, 1)
        usable[int(result.argmin())] = False
