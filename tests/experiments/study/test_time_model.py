"""The model of times: what it is fitted to, and what it predicts."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from msaa_lint.experiments.study.invocations import Invocations, count
from msaa_lint.experiments.study.points import MSAA, SAMPLE_SHADING, SSAA, Technique, techniques
from msaa_lint.experiments.study.scenes import scene
from msaa_lint.experiments.study.time_model import TERMS, MeasuredTime, Terms, _time, fit

SIZE = (160, 96)
COSTS = (0.0, 2e6, 6e6)
"""Nanoseconds of a million invocations."""

COEFFICIENTS = (0.02, 15.0, 19.0, 0.1, 0.03, 0.05, 0.1, 0.02, 1.2, 0.8, 0.7, 1.5, 0.9)
"""Of a GPU, in the order of TERMS."""

TRIANGLES = scene("edge-fan", *SIZE).triangles
ALL = techniques(counts=(1, 2, 4, 8))


def terms_of(technique: Technique) -> Terms:
    pixels = SIZE[0] * SIZE[1]
    resolved = pixels * 4e-9 if technique.samples > 1 else 0.0
    return Terms(
        pixels * technique.samples * 4e-9,
        resolved,
        *(number / 1e6 for number in count(TRIANGLES, SIZE, technique)),
    )


KNOWN = {technique: terms_of(technique) for technique in ALL}


def times(
    coefficients: tuple[float, ...], of: list[Technique] = ALL, costs: tuple[float, ...] = COSTS
) -> list[MeasuredTime]:
    return [
        MeasuredTime(technique, cost, _time(coefficients, KNOWN[technique], cost))
        for technique in of
        for cost in costs
    ]


@given(
    st.lists(st.floats(0.1, 10), min_size=len(TERMS) - 1, max_size=len(TERMS) - 1), st.floats(0, 1)
)
def test_times_without_noise_are_fitted(factors: list[float], hidden: float) -> None:
    coefficients = (
        0.01 * factors[0],
        20 * factors[1],
        20 * factors[2],
        *(0.1 * factor for factor in factors[3:8]),
        *factors[8:],
        hidden,
    )
    model = fit("edges", times(coefficients), KNOWN)
    assert model is not None and model.residual < 0.02
    for each in times(coefficients):
        predicted = model.predict(each.technique, each.nanoseconds)
        assert predicted is not None and predicted.time_ms == pytest.approx(
            each.time_ms, rel=1e-6
        ), "measured times are predicted as they are"
        assert predicted.low_ms <= predicted.time_ms <= predicted.high_ms


def test_between_measured_costs_the_prediction_lies_between() -> None:
    coefficients = COEFFICIENTS
    model = fit("edges", times(coefficients), KNOWN)
    assert model is not None
    for technique in ALL:
        low, middle, high = (model.predict(technique, cost) for cost in (2e6, 4e6, 6e6))
        assert low is not None and middle is not None and high is not None
        assert low.time_ms < middle.time_ms < high.time_ms
        true = _time(coefficients, KNOWN[technique], 4e6)
        assert middle.low_ms <= true * 1.01 and true <= middle.high_ms * 1.01


def test_a_technique_that_was_not_timed_has_no_prediction() -> None:
    model = fit("edges", times((*COEFFICIENTS[:-1], 0.0), ALL[:3]), KNOWN)
    assert model is not None
    assert model.predict(Technique(SSAA, 4, grid=2), 1e6) is None


def test_few_times_give_no_model() -> None:
    coefficients = (*COEFFICIENTS[:-1], 0.0)
    assert fit("edges", times(coefficients, ALL[:1]), KNOWN) is None
    assert fit("edges", [], KNOWN) is None
    assert fit("edges", [each._replace(time_ms=0.0) for each in times(coefficients)], KNOWN) is None
    assert (
        fit("edges", [each._replace(time_ms=math.inf) for each in times(coefficients)], KNOWN)
        is None
    )


def test_times_that_cannot_check_a_model_give_none() -> None:
    coefficients = COEFFICIENTS
    assert fit("edges", times(coefficients, costs=(2e6,)), KNOWN) is None, "one cost of shading"
    assert (
        fit("edges", times(coefficients, [Technique(MSAA, 1), Technique(MSAA, 4)]), KNOWN) is None
    ), "as many times as coefficients"
    empty = {technique: Terms() for technique in ALL}
    model = fit("edges", times(coefficients), empty)
    assert model is None or model.predict(ALL[0], 0.0) is not None


def test_noise_is_reported_beside_the_residual() -> None:
    noisy = [each._replace(noise=0.03) for each in times((*COEFFICIENTS[:-1], 0.0))]
    model = fit("edges", noisy, KNOWN)
    assert model is not None and model.noise == 0.03
    predicted = model.predict(ALL[0], 3e6)
    assert predicted is not None and predicted.high_ms / predicted.time_ms == pytest.approx(1.03)


def by_pixel(technique: Technique) -> Invocations:
    """The invocations counted pixel by pixel."""
    from msaa_lint.experiments.study import coverage, locations, snap
    from msaa_lint.experiments.study.fragments import fragments
    from msaa_lint.experiments.study.shade import groups

    grid, samples = (technique.grid, 1) if technique.kind == SSAA else (1, technique.samples)
    rows = coverage.rows(
        snap.snapped(TRIANGLES * grid, 8),
        SIZE[0] * grid,
        SIZE[1] * grid,
        locations.standard(samples),
    )
    drawn = fragments(rows, samples)

    def counted(masks: tuple[int, ...]) -> tuple[int, int]:
        pixels = quads = 0
        for mask in masks:
            covered = (drawn.mask & np.uint16(mask)) != 0
            pixels += int(covered.sum())
            quads += len(
                {
                    (int(t), int(y) // 2, int(x) // 2)
                    for t, y, x in zip(*(c[covered] for c in drawn[:3]), strict=True)
                }
            )
        return pixels, 4 * quads

    pixels, lanes = counted(groups(samples, 1))
    every, every_lane = counted(
        groups(samples, technique.shaded if technique.kind == SAMPLE_SHADING else 1)
    )
    covered = sum(int(mask).bit_count() for mask in drawn.mask)
    return Invocations(
        covered, pixels, lanes - pixels, every - pixels, every_lane - every - lanes + pixels
    )


@pytest.mark.parametrize("technique", techniques(), ids=lambda technique: technique.name)
def test_invocations_and_helpers_are_those_of_each_pixel(technique: Technique) -> None:
    assert count(TRIANGLES, SIZE, technique) == by_pixel(technique)


def test_a_full_screen_has_an_invocation_for_each_pixel_and_no_helpers() -> None:
    whole = np.array([[(-1.0, -1.0), (1000.0, -1.0), (-1.0, 1000.0)]])
    assert count(whole, SIZE, Technique(MSAA, 4)) == Invocations(
        4 * SIZE[0] * SIZE[1], SIZE[0] * SIZE[1]
    )
    assert count(whole, SIZE, Technique(SAMPLE_SHADING, 4, 1.0)).total == 4 * SIZE[0] * SIZE[1]
    assert count(whole[:0], SIZE, Technique(MSAA, 4)) == Invocations()
    assert math.isfinite(count(whole + 1e6, SIZE, Technique(MSAA, 4)).total)
