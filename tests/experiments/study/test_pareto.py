"""The front: what nothing beats, whatever the order, and only that."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from msaa_lint.experiments.study.measures import FLICKER
from msaa_lint.experiments.study.pareto import (
    SAME,
    Vector,
    as_fast,
    beats,
    front,
    interval,
    mark_best,
    tie,
)
from msaa_lint.experiments.study.points import (
    MSAA,
    SAMPLE_SHADING,
    SSAA,
    Point,
    Technique,
    techniques,
)
from tests.experiments.study.fakes import point, timed

FEW = st.integers(0, 6).map(float)
VECTORS = st.lists(st.tuples(FEW, FEW), max_size=12)


@given(VECTORS)
def test_no_member_is_beaten_and_every_other_is_by_a_member(vectors: list[Vector]) -> None:
    on = front(vectors)
    members = [vector for vector, best in zip(vectors, on, strict=True) if best]
    for vector, best in zip(vectors, on, strict=True):
        assert best == (not any(beats(other, vector) for other in vectors))
        if not best:
            assert any(beats(member, vector) for member in members)
    assert bool(members) == bool(vectors)


@given(st.lists(st.tuples(FEW, FEW), min_size=1, max_size=8), st.randoms())
def test_order_and_repetition_change_nothing(vectors: list[Vector], random: object) -> None:
    once = dict(zip(vectors, front(vectors), strict=True))
    again = [*vectors, *vectors]
    random.shuffle(again)  # type: ignore[attr-defined]
    assert front(again) == [once[vector] for vector in again]


@given(st.lists(st.tuples(FEW, FEW), min_size=1, max_size=8), FEW, FEW)
def test_what_is_beaten_takes_nothing_from_the_front(
    vectors: list[Vector], more: float, dearer: float
) -> None:
    worse = (vectors[0][0] + more + 1, vectors[0][1] + dearer)
    assert front([*vectors, worse]) == [*front(vectors), False]


@given(st.tuples(FEW, FEW, FEW), st.tuples(FEW, FEW, FEW), st.tuples(FEW, FEW, FEW))
def test_beating_is_a_strict_order(a: Vector, b: Vector, c: Vector) -> None:
    assert not beats(a, a)
    assert not (beats(a, b) and beats(b, a))
    if beats(a, b) and beats(b, c):
        assert beats(a, c)


def test_what_is_no_number_is_on_no_front() -> None:
    assert front([(math.nan, 1.0), (2.0, 2.0), (1.0, math.nan)]) == [False, True, False]
    assert front([]) == []


def best(points: list[Point]) -> list[str]:
    return [each.technique.name for each in mark_best(points) if each.best]


def test_error_against_time() -> None:
    assert best([timed(technique) for technique in techniques()]) == ["1x", "2x", "4x", "8x"]


def test_without_a_time_samples_invocations_and_bytes_count() -> None:
    assert best([point(technique) for technique in techniques()]) == ["1x", "2x", "4x", "8x"]
    dear = [
        point(technique, bytes_per_frame=9.0 if technique.samples > 4 else 1.0)
        for technique in techniques((MSAA,))
    ]
    assert best(dear) == ["1x", "2x", "4x", "8x"]
    cheap = [
        point(Technique(MSAA, 4), bytes_per_frame=2.0, rmse=0.1),
        point(Technique(SSAA, 4, grid=2), bytes_per_frame=1.0, rmse=0.1),
    ]
    assert best(cheap) == ["4x", "SSAA 2x2"]
    half = [cheap[0], cheap[1]._replace(bytes_per_frame=None)]
    assert best(half) == ["4x"], "bytes that are not known of all are compared of none"


def test_what_a_device_does_not_draw_is_not_on_its_front() -> None:
    points = [timed(technique) for technique in techniques((MSAA,))]
    points[3] = points[3]._replace(time_ms=None, time_from="")
    assert best(points) == ["1x", "2x", "4x", "16x"]


def test_errors_that_differ_by_rounding_are_the_same() -> None:
    four, eight = point(Technique(MSAA, 4), rmse=0.17606), point(Technique(MSAA, 8), rmse=0.17605)
    assert best([four, eight]) == ["4x"]
    assert best([four, eight._replace(rmse=0.1754)]) == ["4x", "8x"]


def test_scenes_have_fronts_of_their_own() -> None:
    points = [point(Technique(MSAA, 1), "a", rmse=0.1), point(Technique(MSAA, 1), "b", rmse=0.2)]
    assert [each.best for each in mark_best(points)] == [True, True]
    assert [
        each.best
        for each in mark_best([each._replace(best=True, rmse=math.nan) for each in points])
    ] == [False, False]


@pytest.mark.parametrize(
    ("time", "names"),
    [(2.0 * SAME, ["4x"]), (2.0 * SAME + 0.01, ["4x", "4x, half of them shaded"])],
)
def test_what_does_the_same_with_less_work_in_the_same_time_takes_the_place(
    time: float, names: list[str]
) -> None:
    """A clock's noise puts no shader invocations on the front that change nothing."""
    plain, half, each = (
        Technique(MSAA, 4),
        Technique(SAMPLE_SHADING, 4, 0.5),
        Technique(SAMPLE_SHADING, 4, 1.0),
    )
    points = [timed(plain, time_ms=time), timed(half, time_ms=2.0), timed(each, time_ms=2.2)]
    assert best(points) == (names if len(names) == 1 else names[1:])
    better = [points[0], points[1]._replace(rmse=0.07)]
    assert best(better) == ["4x, half of them shaded"]


@pytest.mark.parametrize(("time", "name"), [(0.920896, "2x"), (0.9235, "2x, each shaded")])
def test_a_difference_that_another_machine_would_not_show_decides_nothing(
    time: float, name: str
) -> None:
    """A GPU's times of work that is the same, whose intervals are apart."""
    plain, each = Technique(MSAA, 2), Technique(SAMPLE_SHADING, 2, 1.0)
    points = [
        timed(plain, time_ms=time, low_ms=time - 6e-5, high_ms=time + 6e-5),
        timed(each, time_ms=0.920736, low_ms=0.920704, high_ms=0.9208),
    ]
    assert best(points) == [name]


TIMES = st.tuples(st.integers(1, 9), st.integers(0, 3), st.integers(0, 3))
NOISY = st.lists(
    st.tuples(st.sampled_from(techniques()), TIMES, st.sampled_from([0.1, 0.2, 0.3])),
    min_size=1,
    max_size=9,
)


def noisy(rows: list[tuple[Technique, tuple[int, int, int], float]]) -> list[Point]:
    return [
        timed(
            technique,
            time_ms=float(time),
            low_ms=float(time - low),
            high_ms=float(time + high),
            rmse=error,
        )
        for technique, (time, low, high), error in rows
    ]


def work(one: Point) -> Vector:
    return float(one.technique.samples), float(one.technique.shaded)


@given(NOISY)
def test_within_the_noise_every_point_that_is_not_on_the_front_gives_way_to_one_that_is(
    rows: list[tuple[Technique, tuple[int, int, int], float]],
) -> None:
    points = mark_best(noisy(rows))
    members = [one for one in points if one.best]
    assert members
    for one in points:
        better = [other for other in members if as_fast(other, one) and other.rmse < one.rmse]
        assert not (one.best and better)
        if not one.best:
            equal = [other for other in members if as_fast(other, one) and other.rmse == one.rmse]
            assert better or any(
                beats(work(other), work(one)) or (other.time_ms or 0) <= (one.time_ms or 0)
                for other in equal
            )


@given(NOISY, st.randoms())
def test_the_front_does_not_depend_on_the_order(
    rows: list[tuple[Technique, tuple[int, int, int], float]], random: object
) -> None:
    points = noisy(
        [row for row in rows if row[0] not in [other[0] for other in rows if other is not row]]
    )
    mixed = list(points)
    random.shuffle(mixed)  # type: ignore[attr-defined]
    assert sorted(best(points)) == sorted(best(mixed))


def test_a_difference_within_the_intervals_is_a_tie() -> None:
    four = timed(Technique(MSAA, 4), time_ms=2.0, low_ms=1.9, high_ms=2.1)
    eight = timed(Technique(MSAA, 8), time_ms=2.15, low_ms=2.1, high_ms=2.2)
    later = eight._replace(low_ms=2.11)
    assert tie(four, eight) and tie(eight, four)
    assert not tie(four, later) and as_fast(four, later) and not as_fast(later, four)
    assert best([four, eight]) == ["8x"], "less error in the same time"
    assert best([four, later]) == ["4x", "8x"]
    low, high = interval(four._replace(low_ms=None))
    assert low * high == pytest.approx(4.0) and high / low == pytest.approx(SAME)
    assert not tie(four, eight._replace(time_ms=None))


def test_each_cost_of_shading_has_a_front_of_its_own() -> None:
    counts = techniques((MSAA,), (4, 8))
    points = [timed(technique, shading="none") for technique in counts]
    points += [timed(technique, shading="heavy", time_ms=9.0) for technique in counts]
    assert [(each.shading, each.technique.name) for each in mark_best(points) if each.best] == [
        ("none", "4x"), ("none", "8x"), ("heavy", "8x"),
    ]  # fmt: skip


def test_the_error_that_counts_decides() -> None:
    four, eight = timed(Technique(MSAA, 4), flicker=0.1), timed(Technique(MSAA, 8), flicker=0.1)
    assert [each.best for each in mark_best([four, eight], {"edges": FLICKER})] == [True, False]
    assert [each.best for each in mark_best([four, eight], {"wires": FLICKER})] == [True, True]


def test_times_that_do_not_count_put_nothing_on_the_front() -> None:
    """A software driver's."""
    slow = [
        timed(technique, time_ms=10.0 / technique.samples)
        for technique in techniques((MSAA,), (4, 8))
    ]
    assert best(slow) == ["8x"]
    assert [each.technique.name for each in mark_best(slow, timed=False) if each.best] == [
        "4x",
        "8x",
    ]
    assert [
        each.best for each in mark_best([slow[0], slow[1]._replace(time_ms=None)], timed=False)
    ] == [True, False], "it does not draw it"
