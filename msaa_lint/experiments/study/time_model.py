"""A model of the times of techniques on a device, fitted to measured times.

A frame takes a fixed time, plus the bytes of its attachments and those that it resolves. Its draws
write samples while they shade: the longer of the two hides the shorter one, or a part of it.
Shading is invocations times their cost, where the pixels at edges have more invocations, and
helpers that complete quads.
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
    "ms_per_million_samples_drawn",
    "ms_per_million_fragments",
    "ms_per_million_fragment_helpers",
    "ms_per_million_samples_shaded",
    "ms_per_million_sample_helpers",
    "fragments",
    "fragment_helpers",
    "samples_shaded",
    "sample_helpers",
    "hidden",
)
"""The coefficients. Those from `fragments` to `sample_helpers` are times relative to those of a
full screen; `hidden` is the share of the shorter one of writing samples and shading that the longer
one hides.
"""

_WRITING = TERMS.index("ms_per_million_samples_drawn")
_SHADING = slice(_WRITING + 1, TERMS.index("hidden"))

STARTS = (-2.0, 0.0, 2.0)
"""Logits of the share that is hidden from which the fit starts: which of writing and shading is
longer changes with the coefficients, so that there are several minima.
"""

STEPS = 300
"""Steps of the solver from a start; it takes some tens."""

POWERS = (1, 3)
"""The powers of residuals of which the fit makes the squares small, one after another: 1 their mean
square, and 3 nearly the greatest.
"""

TOLERANCE = 0.05
"""The relative residual whose powers are 1."""

FAR = 12.0
"""Logarithms of coefficients, and the logit, stay within this: beyond it there is no slope."""

NEGLIGIBLE = 1e-5
"""A coefficient that adds at most this share to each time is 0."""

MIN_TIMES = 6
"""Fewer times give no model."""


class Terms(NamedTuple):
    """What the time of a technique depends on: gigabytes (10^9) of attachments written and of
    pixels resolved or downscaled; and millions (study/invocations.py) of samples that draws
    write, and of invocations: one per fragment, those that sample shading adds, and the helpers
    of both.
    """

    gb_written: float = 0.0
    gb_resolved: float = 0.0
    samples_drawn: float = 0.0
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
    """A measured time of a technique where a million invocations take `nanoseconds`, and the
    relative half-width of its interval.
    """

    technique: Technique
    nanoseconds: float
    time_ms: float
    noise: float = 0.0


class TimeModel(NamedTuple):
    """The model of one scene's times.

    `coefficients` are in the order of TERMS. `ratios` are those of measured to modeled times by
    technique, each with the nanoseconds of a million invocations, in ascending order. `residual` is
    the greatest relative residual of the fit, `rms` their root mean square, and `noise` the
    greatest relative half-width of the intervals of the measured times.
    """

    scene: str
    coefficients: tuple[float, ...]
    terms: Mapping[Technique, Terms]
    ratios: Mapping[Technique, Sequence[tuple[float, float]]]
    residual: float
    rms: float
    noise: float

    def predict(self, technique: Technique, nanoseconds: float) -> Prediction | None:
        """The time where a million invocations take `nanoseconds`; None for a technique that was
        not timed.

        It is the model's, corrected by the residuals at the nearest measured costs, between which
        they change in proportion. It is uncertain by half of the difference between these two
        residuals, or the noise; beyond the measured costs by the greatest residual.
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
            ratio, uncertainty = (
                (below[-1] if below else above[0])[1],
                max(self.residual, self.noise),
            )
        time = modeled * ratio
        return Prediction(time, time * (1 - uncertainty), time * (1 + uncertainty))


def fit(
    scene: str, measured: Sequence[MeasuredTime], terms: Mapping[Technique, Terms]
) -> TimeModel | None:
    """The model with small relative residuals, and with coefficients that are not negative; None
    where the times cannot check it: for fewer than MIN_TIMES, for no more than coefficients, and
    under a single cost, where writing and shading look alike.
    """
    import numpy as np

    known = [each for each in measured if each.technique in terms and 0 < each.time_ms < math.inf]
    if len(known) < MIN_TIMES or len({each.nanoseconds for each in known}) < 2:
        return None
    times = np.array([each.time_ms for each in known])
    coefficients = _coefficients(
        np.array([_columns(terms[each.technique], each.nanoseconds) for each in known])
        / times[:, None]
    )
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
        scene, fitted, {technique: terms[technique] for technique in ratios}, ratios, max(map(abs,
        residuals)), rms,
        max(each.noise for each in known),
    )  # fmt: skip


def model_of(
    scene: str, costs: Mapping[tuple[Technique, str], Any], shadings: Sequence[Shading]
) -> TimeModel | None:
    """The model of the measured costs of a scene (study/times.py) under calibrated costs of
    shading; None for too few of them.
    """
    terms = {technique: Terms(*cost.terms) for (technique, _), cost in costs.items() if cost.terms}
    return fit(scene, _measured_times(costs, shadings), terms)


def _measured_times(
    costs: Mapping[tuple[Technique, str], Any], shadings: Sequence[Shading]
) -> list[MeasuredTime]:
    found = []
    for (technique, name), cost in costs.items():
        shading = next((each for each in shadings if each.name == name), None)
        if shading is not None and shading.nanoseconds is not None and cost.time_ms:
            noise = (
                (cost.high_ms - cost.low_ms) / (2 * cost.time_ms)
                if cost.high_ms is not None and cost.low_ms is not None
                else 0.0
            )
            found.append(MeasuredTime(technique, shading.nanoseconds, cost.time_ms, noise))
    return found


def _columns(terms: Terms, nanoseconds: float) -> list[float]:
    """What the coefficients but `hidden` are multiplied by."""
    # Nanoseconds of a million invocations, times millions of them, in milliseconds.
    cost = nanoseconds * 1e-6
    invocations = terms[Terms._fields.index("fragments") :]
    return [
        1.0,
        terms.gb_written,
        terms.gb_resolved,
        terms.samples_drawn,
        *invocations,
        *(number * cost for number in invocations),
    ]


def _time(coefficients: Sequence[float], terms: Terms, nanoseconds: float) -> float:
    parts = [
        column * coefficient
        for column, coefficient in zip(_columns(terms, nanoseconds), coefficients[:-1], strict=True)
    ]
    return sum(parts) - coefficients[-1] * min(parts[_WRITING], sum(parts[_SHADING]))


def _coefficients(columns: Any) -> Any:
    """Coefficients, none of them negative, whose greatest relative residual is small. `columns` (N,
    terms - 1) are divided by times.
    """
    import numpy as np

    # Scaled, so that the result does not depend on units.
    scale = np.linalg.norm(columns, axis=0)
    scale[scale == 0] = 1
    columns = columns / scale
    found = []
    for hidden in STARTS:
        place = np.append(np.full(columns.shape[1], -1.0), hidden)
        for power in POWERS:
            place = _solved(columns, np.clip(place, -FAR, FAR), power)
        found.append(_values(place))
    best = min(found, key=lambda values: float(np.abs(_residuals(columns, values)).max()))
    best[:-1] *= columns.max(axis=0) * best[:-1] > NEGLIGIBLE
    return best / np.append(scale, 1.0)


def _solved(columns: Any, place: Any, power: int) -> Any:
    """The logarithms of the coefficients, and the logit of the share that is hidden, at which the
    squares of a power of the residuals have their least sum, from a place on: the method of
    Levenberg and Marquardt (J. SIAM 11, 1963).
    """
    import numpy as np

    def residuals(place: Any) -> Any:
        return (_residuals(columns, _values(place)) / TOLERANCE) ** power

    damping, current = 1.0, residuals(place)
    for _ in range(STEPS):
        values = _values(place)
        inner = power * (_residuals(columns, values) / TOLERANCE) ** (power - 1) / TOLERANCE
        slopes = (
            _slopes(columns, values)
            * np.append(values[:-1], values[-1] * (1 - values[-1]))
            * inner[:, None]
        )
        curvature = slopes.T @ slopes
        step = np.linalg.solve(
            curvature + damping * np.diag(np.diag(curvature) + 1e-9), -slopes.T @ current
        )
        following = np.clip(place + np.clip(step, -2, 2), -2 * FAR, 2 * FAR)
        after = residuals(following)
        gain = 1 - (after @ after) / (current @ current) if current.any() else 0.0
        if gain > 0:
            place, current, damping = following, after, max(damping / 3, 1e-9)
        else:
            damping *= 3
        if 0 <= gain < 1e-9 or damping > 1e12:
            break
    return place


def _values(place: Any) -> Any:
    import numpy as np

    return np.append(np.exp(place[:-1]), 1 / (1 + np.exp(-place[-1])))


def _residuals(columns: Any, values: Any) -> Any:
    import numpy as np

    return columns @ values[:-1] - values[-1] * np.minimum(*_alternatives(columns, values)) - 1


def _slopes(columns: Any, values: Any) -> Any:
    """The derivatives of the residuals with respect to the coefficients."""
    import numpy as np

    writing, shading = _alternatives(columns, values)
    result = np.column_stack((columns, -np.minimum(writing, shading)))
    result[:, _WRITING] *= 1 - values[-1] * (writing < shading)
    result[:, _SHADING] *= 1 - values[-1] * (writing >= shading)[:, None]
    return result


def _alternatives(columns: Any, values: Any) -> tuple[Any, Any]:
    """The times of writing samples and of shading, of which the longer one hides the shorter
    one.
    """
    return columns[:, _WRITING] * values[_WRITING], columns[:, _SHADING] @ values[_SHADING]
