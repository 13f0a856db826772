"""Medians, the intervals that hold them, and when two times differ."""

from __future__ import annotations

import itertools
import random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from msaa_lint.experiments.confirm.timing import Timing, cannot_show, difference, is_software, ranks, rounds, timing

TIMES = st.lists(st.floats(0, 1e6), min_size=1, max_size=60)


@given(TIMES)
def test_interval_holds_the_median_and_is_of_the_repeats_themselves(values: list[float]) -> None:
    found = timing(values)
    assert found.low <= found.median <= found.high
    assert found.low in values and found.high in values


@pytest.mark.parametrize(
    ("count", "low", "high", "covered"),
    [(1, 0, 0, 0.0), (5, 0, 4, 0.9375), (6, 0, 5, 0.96875), (9, 1, 7, 0.9609375), (10, 1, 8, 0.978515625), (15, 3, 11, 0.96484375),
     (30, 9, 20, 0.9572260547429323)],
)  # fmt: skip
def test_ranks_are_those_of_the_tables_of_the_sign_test(count: int, low: int, high: int, covered: float) -> None:
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


def test_nothing_has_no_median() -> None:
    with pytest.raises(ValueError):
        timing([])


def of(middle: float, spread: float = 0.01, n: int = 15) -> Timing:
    return Timing(middle, middle * (1 - spread), middle * (1 + spread), n, 0.96, "timestamp")


@pytest.mark.parametrize(
    ("fixed", "software", "real", "words"),
    [
        (of(8.0), False, True, "20% less time"),
        (of(12.5), False, True, "25% more time"),
        (of(9.5), False, True, "5% less time"),
        (of(9.5), True, False, "no difference: less than 10 % is not significant on a software driver"),
        (of(8.0), True, True, "20% less time"),
        (of(8.0, 0.5), False, False, "no difference: the intervals overlap"),
        (of(8.0, n=5), False, False, "fewer than 6 repeats cannot show a difference"),
    ],
)
def test_difference(fixed: Timing, software: bool, real: bool, words: str) -> None:
    found = difference(of(10.0), fixed, software)
    assert (found.real, found.text) == (real, words)


@given(st.floats(0.1, 100), st.floats(0.1, 100), st.booleans())
def test_difference_of_the_same_is_none_and_it_is_antisymmetric(one: float, other: float, software: bool) -> None:
    assert not difference(of(one), of(one), software).real
    there, back = difference(of(one), of(other), False), difference(of(other), of(one), False)
    assert there.real == back.real and (not there.real or there.share * back.share < 0)


@given(st.integers(1, 100))
def test_rounds_alternate_and_give_each_version_all_its_repeats(repeats: int) -> None:
    made = list(rounds(repeats))
    assert sum(count for _, _, count in made) == repeats
    assert all(sorted(order) == ["as written", "fixed"] for _, order, _ in made)
    by_process = [[order for _, order, _ in group] for _, group in itertools.groupby(made, lambda each: each[0])]
    assert all(len(group) < 2 or group[0] == group[1][::-1] for group in by_process)
    assert all(one[0] != other[0] for one, other in itertools.pairwise(by_process))


def test_what_a_device_cannot_show() -> None:
    assert cannot_show({"type": "CPU"}, None).startswith("a software driver has neither tiles")
    assert cannot_show({"type": "DISCRETE_GPU"}, False).startswith("an immediate-mode GPU has no tiles")
    assert cannot_show({"type": "INTEGRATED_GPU"}, None).startswith("it is unknown whether this device renders by tiles")
    assert cannot_show({"type": "INTEGRATED_GPU"}, True) == ""
    assert is_software({"type": "VK_PHYSICAL_DEVICE_TYPE_CPU"}) and not is_software({})


def test_json_is_rounded_to_the_nanosecond() -> None:
    found = timing([1.23456789, 2, 3, 4, 5, 6], "timestamp").json()
    assert found == {"median": 3.5, "low": 1.234568, "high": 6, "n": 6, "confidence": 0.9688, "source": "timestamp"}
