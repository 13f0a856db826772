"""Resolves against the answer of rational arithmetic: order, rounding, overflow, infinities,
subnormals, light and codes.
"""

from __future__ import annotations

import math
import os
from collections.abc import Sequence
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from docs import study_numbers
from docs.study_cases.alpha_cases import THRESHOLDS, exact_count
from docs.study_cases.picture_cases import TECHNIQUES, half_plane
from docs.study_cases.resolve_cases import exact_weighted
from docs.study_cases.row import Row
from msaa_lint.experiments.study.effects import alpha_coverage, store_half, store_srgb
from msaa_lint.experiments.study.flicker import flicker
from msaa_lint.experiments.study.points import Technique
from msaa_lint.experiments.study.resolve import (
    DEPTH_MODES,
    average,
    decode,
    encode,
    from_srgb,
    resolve_depth,
    to_srgb,
    to_unorm,
    tone_map,
    weighted,
)

SINGLES = st.floats(
    width=32, allow_nan=False, allow_infinity=False, min_value=-(2.0**100), max_value=2.0**100
)
LIGHTS = st.floats(width=32, min_value=0, max_value=65504)
COUNTS = (1, 2, 4, 8, 16)


def single(value: Fraction) -> np.float32:
    """The nearest single-precision number, ties to even. Of a sum of two singles the way by double
    precision changes nothing.
    """
    return np.float32(float(value))


def one(values: Sequence[float]) -> NDArray[np.float32]:
    """The samples of one pixel."""
    return np.array(values, np.float32)[:, None]


def exact(value: Fraction) -> float:
    return float(value)


@given(
    st.sampled_from(COUNTS).flatmap(lambda count: st.lists(SINGLES, min_size=count, max_size=count))
)
def test_an_average_adds_in_order_and_rounds_each_sum_once(samples: list[float]) -> None:
    total = np.float32(samples[0])
    for sample in samples[1:]:
        total = single(Fraction(float(total)) + Fraction(sample))
    # A power of two scales exactly, but where the result is subnormal: there it is rounded to a
    # multiple of the least one.
    due = single(Fraction(float(total)) / len(samples))
    (found,) = average(one(samples))
    assert found == due


def test_the_order_is_that_of_the_samples_and_not_pairwise() -> None:
    samples = [1.0, 2.0**-24, 2.0**-24, 2.0**-24]
    (found,) = average(one(samples))
    pairwise = (np.float32(1 + 2.0**-24) + np.float32(2 * 2.0**-24)) / 4
    assert (found, pairwise) == (np.float32(0.25), np.float32(0.25 + 2.0**-25))


@given(st.lists(st.integers(0, 2**20), min_size=16, max_size=16), st.sampled_from(COUNTS))
def test_whole_numbers_average_exactly(numbers: list[int], count: int) -> None:
    (found,) = average(one([float(each) for each in numbers[:count]]))
    assert Fraction(float(found)) == single(Fraction(sum(numbers[:count]), count))


def test_nine_samples_are_divided_and_ones_stay_one() -> None:
    assert average(one([1.0] * 9))[0] == 1.0
    totals = [float(each) for each in range(1, 100)]
    due = [single(Fraction(int(each), 9)) for each in totals]
    assert average(np.array([totals] + [[0.0] * 99] * 8, np.float32)).tolist() == due
    assert (np.array(totals, np.float32) * np.float32(1 / 9)).tolist() != due


@pytest.mark.parametrize(
    ("value", "count"), [(65504.0, 4), (65504.0, 16), (20000.0, 4), (5000.0, 16)]
)
def test_half_precision_samples_do_not_overflow(value: float, count: int) -> None:
    samples = np.full((count, 1), value, np.float16)
    in_half = samples[0]
    with np.errstate(over="ignore"):
        for sample in samples[1:]:
            in_half = in_half + sample
    assert np.isinf(in_half[0] / np.float16(count))
    found = average(samples)
    assert found.dtype == np.float32 and found[0] == value
    assert store_half(found)[0] == value


def test_what_half_precision_keeps_is_rounded_to_even_and_overflows_from_65520_on() -> None:
    below = np.nextafter(np.float32(65520), np.float32(0))
    given = np.array(
        [
            512.75,
            2049.0,
            2051.0,
            below,
            65520.0,
            70000.0,
            -70000.0,
            np.inf,
            2.0**-25,
            2.0**-24 * 1.5,
        ],
        np.float32,
    )
    due = [513.0, 2048.0, 2052.0, 65504.0, math.inf, math.inf, -math.inf, math.inf, 0.0, 2.0**-23]
    assert store_half(given).tolist() == due
    assert np.isnan(store_half(np.array([np.nan], np.float32))[0])


@pytest.mark.parametrize("dtype", [np.float16, np.float32])
def test_subnormals_are_averaged_and_not_lost(dtype: type[np.floating]) -> None:
    least = float(np.finfo(dtype).smallest_subnormal)
    assert dtype(least) * dtype(0.25) == 0.0
    (found,) = average(np.full((4, 1), least, dtype))
    assert Fraction(float(found)) == Fraction(least)
    (mixed,) = average(np.array([least, 2 * least, 3 * least, 2 * least], dtype)[:, None])
    assert Fraction(float(mixed)) == 2 * Fraction(least)


@pytest.mark.parametrize(
    ("samples", "due"),
    [
        ([math.inf, 1, 2, 3], math.inf),
        ([1, -math.inf, 2, 3], -math.inf),
        ([math.inf, math.inf, 0, 0], math.inf),
        ([math.inf, -math.inf, 0, 0], math.nan),
        ([0, math.nan, 0, 0], math.nan),
        ([3e38, 3e38, -3e38, -3e38], math.inf),
    ],
)
def test_infinity_and_nan_are_carried_as_ieee_754_says(samples: list[float], due: float) -> None:
    (found,) = average(one(samples))
    assert found == due or (math.isnan(found) and math.isnan(due))


def light(values: Sequence[float]) -> NDArray[np.float32]:
    """Samples of one pixel of grey light, (N, 1, 4)."""
    made = np.ones((len(values), 1, 4), np.float32)
    made[..., :3] = np.array(values, np.float32)[:, None, None]
    return made


def reinhard(value: Fraction) -> Fraction:
    return value / (1 + value)


@given(st.lists(LIGHTS, min_size=4, max_size=4))
def test_the_weighted_resolve_of_grey_is_the_average_of_what_is_displayed(
    samples: list[float],
) -> None:
    due = sum(reinhard(Fraction(each)) for each in samples) / 4
    found = tone_map(weighted(light(samples)))[0, 0]
    assert abs(Fraction(float(found)) - due) < Fraction(1, 10**6)


def test_a_firefly_fills_the_pixel_after_the_resolve_and_not_before() -> None:
    samples = [60000.0, 0.1, 0.1, 0.1]
    shares = [Fraction(float(np.float32(each))) for each in samples]
    after = exact(reinhard(sum(shares, Fraction(0)) / 4))
    before = exact(sum((reinhard(each) for each in shares), Fraction(0)) / 4)
    assert after > 0.9999 and before < 0.32
    assert tone_map(average(light(samples)))[0, 0] == pytest.approx(after, abs=1e-6)
    assert average(tone_map(light(samples)))[0, 0] == pytest.approx(before, abs=1e-6)
    assert tone_map(weighted(light(samples)))[0, 0] == pytest.approx(before, abs=1e-6)


def test_infinite_light_is_displayed_as_white_and_weighs_nothing() -> None:
    assert tone_map(light([math.inf]))[0, 0].tolist() == [1, 1, 1, 1]
    assert np.isnan(tone_map(light([math.nan]))[0, 0, 0])
    assert weighted(light([math.inf, 1, 1, 1]))[0].tolist() == [1, 1, 1, 1]
    assert weighted(light([math.inf] * 4))[0].tolist() == [math.inf] * 3 + [1]
    assert np.isnan(weighted(light([math.nan, 1, 1, 1]))[0, 0])
    red = light([math.inf] * 4)
    red[..., 1:3] = 0
    assert weighted(red)[0].tolist() == [math.inf, 0, 0, 1]


@given(
    st.lists(st.floats(width=32, allow_nan=False, allow_infinity=False), min_size=1, max_size=16)
)
def test_weights_neither_overflow_nor_vanish(values: list[float]) -> None:
    found = weighted(light(values))[0, 0]
    due = exact_weighted([(value, value, value) for value in values])[0]
    assert abs(Fraction(float(found)) - due) <= due / 10**5 + Fraction(1, 2**148)


def test_negative_light_counts_as_none_in_the_weighted_resolve() -> None:
    assert weighted(light([-1, 0, 0, 0]))[0].tolist() == [0, 0, 0, 1]
    for value in (-0.5, -1, -2, -65504, -math.inf):
        found = tone_map(weighted(light([value, 1, 1, 1])))[0, 0]
        assert found == pytest.approx(average(tone_map(light([value, 1, 1, 1])))[0, 0], abs=1e-6)


def test_tone_mapping_leaves_alpha_and_takes_negative_light_as_none() -> None:
    made = tone_map(np.array([[3.0, -1.0, 0.0, 0.25]], np.float32))
    assert made.tolist() == [[0.75, 0.0, 0.0, 0.25]]


@given(st.lists(st.integers(0, 255), min_size=4, max_size=4))
def test_unorm_averages_round_to_the_nearest_code(codes: list[int]) -> None:
    samples = one([code / 255 for code in codes])
    (found,) = to_unorm(average(samples))
    mean = Fraction(sum(codes), 4)
    assert abs(round(float(found) * 255) - mean) <= Fraction(1, 2)


def test_unorm_clips_and_takes_nan_as_zero() -> None:
    given = np.array([-1.0, 0.0, 1.0, 2.0, np.nan, np.inf, -np.inf, 0.5], np.float32)
    # 127.5 is halfway: to the even code.
    assert (to_unorm(given) * 255).round().tolist() == [0, 0, 255, 255, 0, 255, 0, 128]
    assert to_unorm(np.array([0.3], np.float32), bits=2)[0] == np.float32(1 / 3)


def test_srgb_averages_light() -> None:
    white, black = [1.0, 1.0, 1.0, 1.0], [0.0, 0.0, 0.0, 1.0]
    samples = np.array([[white], [black]], np.float32)
    codes = to_srgb(average(samples)[..., :3]) * 255
    assert np.rint(codes).tolist() == [[188, 188, 188]]
    encoded = average(encode(samples))
    assert encoded[0].tolist() == [0.5, 0.5, 0.5, 1.0]
    assert decode(encoded)[0, 0] == pytest.approx(0.2140411, abs=1e-6)


def test_srgb_codes_are_where_the_standard_says() -> None:
    codes = np.arange(256) / 255
    light = from_srgb(codes)
    for code, found in zip(range(256), light, strict=True):
        value = Fraction(code, 255)
        due = (
            float(value) / 12.92
            if value <= Fraction(4045, 100000)
            else ((float(value) + 0.055) / 1.055) ** 2.4
        )
        assert float(found) == pytest.approx(due, rel=1e-7)
    assert np.rint(to_srgb(light) * 255).tolist() == list(range(256))
    assert (
        store_srgb(np.stack([light, light, light, codes.astype(np.float32)], axis=-1))[
            :, 0
        ].tolist()
        == light.tolist()
    )
    assert to_srgb(np.array([-1.0, 2.0])).tolist() == [0.0, 1.0]


def test_depth_modes_at_a_silhouette() -> None:
    near, far = 0.25, 0.75
    samples = np.array([[far], [near], [near], [far]], np.float32)
    found = {mode: float(resolve_depth(samples, mode)[0]) for mode in DEPTH_MODES}
    assert found == {"SAMPLE_ZERO": far, "AVERAGE": exact(Fraction(1, 2)), "MIN": near, "MAX": far}
    assert found["AVERAGE"] not in (near, far)


def test_a_depth_mode_that_is_none_is_named() -> None:
    with pytest.raises(ValueError, match="MEDIAN is not a depth resolve mode"):
        resolve_depth(np.zeros((4, 1), np.float32), "MEDIAN")


def test_resolved_depth_is_a_copy() -> None:
    samples = np.zeros((4, 3), np.float32)
    resolve_depth(samples, "SAMPLE_ZERO")[:] = 1
    assert not samples.any()


@given(st.floats(width=32), st.sampled_from([None, *THRESHOLDS.tolist()]), st.sampled_from(COUNTS))
def test_alpha_covers_as_many_samples_as_rational_arithmetic_says(
    alpha: float, threshold: float | None, samples: int
) -> None:
    thresholds = None if threshold is None else np.array([threshold], np.float32)
    (mask,) = alpha_coverage(np.array([alpha], np.float32), thresholds, samples)
    assert mask == (1 << exact_count(alpha, threshold, samples)) - 1


@pytest.mark.parametrize("samples", COUNTS)
def test_the_mean_of_a_dithered_block_has_no_bias(samples: int) -> None:
    steps = np.arange(1, 16 * samples) / np.float32(16 * samples)
    every, each = np.repeat(steps.astype(np.float32), 16), np.tile(THRESHOLDS, len(steps))
    counts = np.bitwise_count(alpha_coverage(every, each, samples)).reshape(-1, 16).sum(axis=1)
    assert counts.tolist() == list(range(1, 16 * samples))


@pytest.mark.parametrize("technique", TECHNIQUES, ids=[technique.name for technique in TECHNIQUES])
def test_flicker_is_the_same_wherever_the_edge_is_and_along_both_axes(technique: Technique) -> None:
    due = flicker(half_plane(), technique)
    for place in (33.0, 33 + 1 / 64, 33.5, 34 - 1 / 64):
        for upright in (False, True):
            assert flicker(half_plane(place, upright), technique) == pytest.approx(due, rel=1e-14)


@pytest.fixture(scope="module")
def rows() -> list[Row]:
    return study_numbers.rows()


def test_ours_is_exact_in_every_hard_case(rows: list[Row]) -> None:
    assert [row for row in rows if not row.right(row.ours)] == []


def test_the_tables_have_cases_that_naive_arithmetic_gets_wrong(rows: list[Row]) -> None:
    wrong = [row for row in rows if not row.right(row.naive)]
    assert len(wrong) >= len(rows) * 2 // 3
    assert any(not row.right(row.double) for row in rows)


def test_the_tables_are_fresh(rows: list[Row]) -> None:
    page = study_numbers.PAGE.read_text(encoding="utf-8")
    fresh = study_numbers.fresh(page, rows)
    if os.environ.get("UPDATE"):
        study_numbers.PAGE.write_text(fresh, encoding="utf-8")
    assert page == fresh or os.environ.get("UPDATE"), (
        "python -m docs.study_numbers writes them anew"
    )
