"""Cases of the model of times: fitted to exact times of techniques whose quantities are nearly in
proportion to each other.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

from msaa_lint.experiments.study.points import SAMPLE_SHADING, SSAA, Technique, techniques
from msaa_lint.experiments.study.time_model import MeasuredTime, Terms, fit

from .row import Row

MEGAPIXELS = Fraction(1920 * 1080, 10**6)
COSTS = (0, 2_000_000, 6_000_000)
"""Nanoseconds of a million invocations."""

ASKED = 4_000_000
COEFFICIENTS = tuple(
    Fraction(text) for text in ("0.02", "5", "3", "0.05", "0.02", "1", "0.8", "1", "0.7")
)
"""Of a time in the order of time_model.TERMS, where nothing is hidden."""


def quantities(technique: Technique) -> tuple[Fraction, ...]:
    """The terms of a technique: 8 bytes per sample, and edges in a tenth of the pixels."""
    grid, samples = (technique.grid, 1) if technique.kind == SSAA else (1, technique.samples)
    pixels = MEGAPIXELS * grid * grid
    resolved = pixels * samples if samples > 1 else pixels if grid > 1 else Fraction(0)
    fragments = pixels * (1 + Fraction(samples - 1, 10 * samples))
    shaded = fragments * (technique.shaded - 1) if technique.kind == SAMPLE_SHADING else Fraction(0)
    gigabytes = Fraction(8, 1000)
    return (
        gigabytes * pixels * samples,
        gigabytes * resolved,
        fragments,
        fragments / 10,
        shaded,
        shaded / 10,
    )


def columns(technique: Technique, nanoseconds: int) -> list[Fraction]:
    """What the coefficients are multiplied by, in milliseconds."""
    written, resolved, fragments, helpers, shaded, shaded_helpers = quantities(technique)
    cost = Fraction(nanoseconds, 10**6)
    return [
        Fraction(1),
        written,
        resolved,
        fragments,
        shaded,
        fragments * cost,
        helpers * cost,
        shaded * cost,
        shaded_helpers * cost,
    ]


def exact_time(technique: Technique, nanoseconds: int) -> Fraction:
    return sum(
        (
            each * column
            for each, column in zip(COEFFICIENTS, columns(technique, nanoseconds), strict=True)
        ),
        Fraction(0),
    )


def models() -> Iterator[Row]:
    """The times at a cost that was not measured, in milliseconds. The helpers of quads are in
    proportion to fragments here, so that their coefficients have no single answer, but times do.
    """
    every = techniques()
    known = {technique: Terms(*map(float, quantities(technique))) for technique in every}
    measured = [
        MeasuredTime(technique, float(cost), float(exact_time(technique, cost)))
        for technique in every
        for cost in COSTS
    ]
    model = fit("", measured, known)
    assert model is not None
    one = float(exact_time(every[0], ASKED))
    for name in ("2x", "8x", "4x, each shaded", "SSAA 4x4"):
        technique = next(each for each in every if each.name == name)
        found = model.predict(technique, ASKED)
        assert found is not None
        between = sum(float(exact_time(technique, cost)) for cost in COSTS[1:]) / 2
        case = (
            f"milliseconds of {name} at a cost between those of {len(measured)} exact times; "
            "naive: 1x times its samples; float64: a line"
        )
        yield Row(
            "times",
            case,
            float(exact_time(technique, ASKED)),
            technique.samples * one,
            between,
            found.time_ms,
            1e-9,
        )
    equal = [each._replace(time_ms=0.1, noise=0.01) for each in measured]
    model = fit("", equal, known)
    assert model is not None
    found = model.predict(every[2], ASKED)
    assert found is not None
    case = (
        "milliseconds of 4x where all techniques take 0.1 ms under all costs; naive: 1x times "
        "its samples"
    )
    yield Row("times", case, 0.1, 0.4, 0.1, found.time_ms, 1e-9)
