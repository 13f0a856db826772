"""Medians, the intervals that hold them, and when two times differ."""

from __future__ import annotations

import itertools
import math
import random
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from docs.study_cases.time_cases import contained, disjoint, resampled_ranks
from msaa_lint.experiments.confirm.timing import (
    Timing,
    cannot_show,
    difference,
    is_software,
    ranks,
    rounds,
    timing,
)

TIMES = st.lists(st.floats(0, 1e6), min_size=1, max_size=60)


@given(TIMES)
def test_interval_holds_the_median_and_is_of_the_repeats_themselves(values: list[float]) -> None:
    found = timing(values)
    assert found.low <= found.median <= found.high
    assert found.low in values and found.high in values


@pytest.mark.parametrize(
    ("count", "low", "high", "covered"),
    [(1, 0, 0, 0.0), (5, 0, 4, 0.9375), (6, 0, 5, 0.96875), (9, 1, 7, 0.9609375), (10, 1, 8,
    0.978515625), (15, 3, 11, 0.96484375),
     (30, 9, 20, 0.9572260547429323)],
)  # fmt: skip
def test_ranks_are_those_of_the_tables_of_the_sign_test(
    count: int, low: int, high: int, covered: float
) -> None:
    assert ranks(count) == (low, high, pytest.approx(covered, abs=1e-12))


def test_interval_holds_the_true_median_as_often_as_it_says() -> None:
    # A skewed distribution, whose median is ln 2.
    chance = random.Random(7)
    held = 0
    for _ in range(2000):
        found = timing([chance.expovariate(1) for _ in range(15)])
        held += found.low <= 0.6931471805599453 <= found.high
    # 0.965 is what ranks(15) says; three standard deviations are 0.012.
    assert held / 2000 == pytest.approx(0.965, abs=0.0125)


@pytest.mark.parametrize("count", [1, 3, 5, 7, 9, 11, 15, 21, 25, 31, 51, 63])
def test_interval_is_that_of_the_bootstrap_or_one_rank_wider_where_that_falls_short(
    count: int,
) -> None:
    low, high = resampled_ranks(count)
    found = ranks(count)[:2]
    if contained(low, high, count) >= Fraction(95, 100) or (low, high) == (0, count - 1):
        assert found == (low, high)
    else:
        assert found == (low - 1, high + 1)


def test_percentiles_in_closed_form_are_those_of_resamples() -> None:
    chance = random.Random(11)
    medians = sorted(sorted(chance.choices(range(11), k=11))[5] for _ in range(20000))
    assert (medians[500], medians[19500]) == resampled_ranks(11)


@pytest.mark.parametrize("count", [3, 4, 6])
def test_the_chance_of_disjoint_intervals_is_the_share_of_the_orders(count: int) -> None:
    low, high, _ = ranks(count)
    orders = [
        (chosen, sorted(set(range(2 * count)) - set(chosen)))
        for chosen in itertools.combinations(range(2 * count), count)
    ]
    apart = sum(one[high] < other[low] or other[high] < one[low] for one, other in orders)
    assert Fraction(apart, len(orders)) == disjoint(low, high, count)


@pytest.mark.parametrize("count", [1, 2, 3, 5, 6, 15, 100])
def test_interval_of_equal_values_is_the_value(count: int) -> None:
    found = timing([0.1] * count)
    assert (found.low, found.median, found.high) == (0.1, 0.1, 0.1)
    assert 0.0 <= found.confidence <= 1.0


def test_outliers_do_not_widen_the_interval() -> None:
    assert timing([1.0] * 12 + [1000.0, 1e9, 1e300])[:3] == (1.0, 1.0, 1.0)


@given(TIMES, st.randoms(use_true_random=False))
def test_the_order_of_the_repeats_does_not_matter(
    values: list[float], chance: random.Random
) -> None:
    shuffled = list(values)
    chance.shuffle(shuffled)
    assert timing(shuffled) == timing(values)


def test_nothing_has_no_median() -> None:
    with pytest.raises(ValueError):
        timing([])


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
def test_what_is_not_a_time_has_no_median(value: float) -> None:
    with pytest.raises(ValueError, match="a time is not a finite number"):
        timing([1.0, value, 2.0])


def of(middle: float, spread: float = 0.01, n: int = 15) -> Timing:
    return Timing(middle, middle * (1 - spread), middle * (1 + spread), n, 0.96, "timestamp")


@pytest.mark.parametrize(
    ("fixed", "software", "real", "words"),
    [
        (of(8.0), False, True, "20% less time"),
        (of(12.5), False, True, "25% more time"),
        (of(9.5), False, True, "5% less time"),
        (
            of(9.5),
            True,
            False,
            "no difference: less than 10 % is not significant on a software driver",
        ),
        (of(8.0), True, True, "20% less time"),
        (of(8.0, 0.5), False, False, "no difference: the intervals overlap"),
        (of(8.0, n=5), False, False, "fewer than 6 repeats cannot show a difference"),
    ],
)
def test_difference(fixed: Timing, software: bool, real: bool, words: str) -> None:
    found = difference(of(10.0), fixed, software)
    assert (found.real, found.text) == (real, words)


@given(st.floats(0.1, 100), st.floats(0.1, 100), st.booleans())
def test_difference_of_the_same_is_none_and_it_is_antisymmetric(
    one: float, other: float, software: bool
) -> None:
    assert not difference(of(one), of(one), software).real
    there, back = difference(of(one), of(other), False), difference(of(other), of(one), False)
    assert there.real == back.real and (not there.real or there.share * back.share < 0)


@given(st.integers(1, 100))
def test_rounds_alternate_and_give_each_version_all_its_repeats(repeats: int) -> None:
    made = list(rounds(repeats))
    assert sum(count for _, _, count in made) == repeats
    assert all(sorted(order) == ["as written", "fixed"] for _, order, _ in made)
    by_process = [
        [order for _, order, _ in group]
        for _, group in itertools.groupby(made, lambda each: each[0])
    ]
    assert all(len(group) < 2 or group[0] == group[1][::-1] for group in by_process)
    assert all(one[0] != other[0] for one, other in itertools.pairwise(by_process))


def test_what_a_device_cannot_show() -> None:
    assert cannot_show({"type": "CPU"}, None).startswith("a software driver has neither tiles")
    assert cannot_show({"type": "DISCRETE_GPU"}, False).startswith(
        "an immediate-mode GPU has no tiles"
    )
    assert cannot_show({"type": "INTEGRATED_GPU"}, None).startswith(
        "it is unknown whether this device renders by tiles"
    )
    assert cannot_show({"type": "INTEGRATED_GPU"}, True) == ""
    assert is_software({"type": "VK_PHYSICAL_DEVICE_TYPE_CPU"}) and not is_software({})


def test_json_is_rounded_to_the_nanosecond() -> None:
    found = timing([1.23456789, 2, 3, 4, 5, 6], "timestamp").json()
    assert found == {
        "median": 3.5,
        "low": 1.234568,
        "high": 6,
        "n": 6,
        "confidence": 0.9688,
        "source": "timestamp",
    }
