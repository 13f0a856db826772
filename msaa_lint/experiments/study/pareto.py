"""Pareto-optimal choices: those that no other choice dominates. A difference within the noise of a
clock is none.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence

from .measures import ERROR, Measure
from .points import Point

SAME = 1.05
"""Times without an interval count as equal within this factor."""

REPEATED = 1.001
"""Measured times are not more certain than this factor: repeated on another machine of a kind,
medians differ by up to 0.16 % although their intervals are narrower, as where buffers lie in memory
differs.
"""

Vector = tuple[float, ...]
"""Quantities of which less is better: the error, then costs."""


def mark_best(
    points: Iterable[Point], measures: Mapping[str, Measure] | None = None, *, timed: bool = True
) -> list[Point]:
    """The points, with `best` set on those that no other point of their scene, shading cost, and
    size dominates.

    `measures` are the errors that decide, by scene: the RMSE where it has none. Without `timed`,
    times are disregarded. Points without a time are not on the front where others have one.
    """
    all_points = list(points)
    best = [False] * len(all_points)
    for (scene, *_), group in _groups(all_points).items():
        measure = (measures or {}).get(scene, ERROR)
        # Some devices do not draw every technique.
        drawn = [n for n in group if has_time(all_points[n])]
        group_points = [all_points[n] for n in drawn or group]
        optimal = (
            fastest(group_points, measure)
            if timed and drawn
            else front(vectors(group_points, measure))
        )
        for n, is_best in zip(drawn or group, optimal, strict=True):
            best[n] = is_best
    return [point._replace(best=optimal) for point, optimal in zip(all_points, best, strict=True)]


def _groups(points: Sequence[Point]) -> dict[tuple[str, str, int, int], list[int]]:
    groups: dict[tuple[str, str, int, int], list[int]] = {}
    for n, point in enumerate(points):
        groups.setdefault((point.scene, point.shading, point.width, point.height), []).append(n)
    return groups


def interval(point: Point) -> tuple[float, float]:
    """The bounds of a point's time, in milliseconds: those measured, at least the factor REPEATED
    on both sides, else its time within half of the factor SAME; NaN where there is no time.
    """
    if not has_time(point):
        return math.nan, math.nan
    time, low, high = point.time_ms or 0.0, point.low_ms, point.high_ms
    if low is None or high is None or not low <= time <= high:
        return time / math.sqrt(SAME), time * math.sqrt(SAME)
    return min(low, time / REPEATED), max(high, time * REPEATED)


def has_time(point: Point) -> bool:
    """Whether a point has a time: a positive number."""
    return point.time_ms is not None and 0 < point.time_ms < math.inf


def as_fast(one: Point, other: Point) -> bool:
    """Whether a point is not slower than another beyond the noise: its interval begins no later
    than the other's ends.
    """
    return interval(one)[0] <= interval(other)[1] * (1 + 1e-12)


def tie(one: Point, other: Point) -> bool:
    """Whether the times of two points are equal within the noise: their intervals overlap."""
    return as_fast(one, other) and as_fast(other, one)


def fastest(points: Sequence[Point], measure: Measure = ERROR) -> list[bool]:
    """For each point of a scene whether no other has less error and is as fast, or the same error
    and is faster or does less work in the same time.

    Ties are not transitive, so points are taken in the order of their errors: a point is dominated
    by one on the front alone, and every point that is not on the front is dominated by one that is.
    """
    best: list[int] = []
    errors = [measure.rounded(point) if has_time(point) else math.nan for point in points]
    for error in sorted({error for error in errors if not math.isnan(error)}):
        left = [
            n
            for n, other in enumerate(errors)
            if other == error and not any(as_fast(points[m], points[n]) for m in best)
        ]
        if left:
            first = min(left, key=lambda n: points[n].time_ms or 0.0)
            chosen: list[int] = []
            for n in sorted(left, key=lambda n: _work(points[n])):
                simpler = any(
                    beats(_work(points[m]), _work(points[n])) and as_fast(points[m], points[n])
                    for m in chosen
                )
                if as_fast(points[n], points[first]) and not simpler:
                    chosen.append(n)
            best += chosen
    return [n in best for n in range(len(points))]


def _work(point: Point) -> Vector:
    return float(point.technique.samples), float(point.technique.shaded)


def vectors(points: Sequence[Point], measure: Measure = ERROR) -> list[Vector]:
    """The quantities that points of a scene without times are compared by: the error, samples and
    shader invocations per pixel, and the model's bytes if it has them for every point.
    """
    known = all(point.bytes_per_frame is not None for point in points)
    return [
        (measure.rounded(point), *_work(point), (point.bytes_per_frame or 0.0) if known else 0.0)
        for point in points
    ]


def front(vectors: Sequence[Vector]) -> list[bool]:
    """For each vector whether no other dominates it. Equal vectors do not dominate each other;
    those with NaN are never on the front.
    """
    usable = [None if any(map(math.isnan, vector)) else vector for vector in vectors]
    distinct = {vector for vector in usable if vector is not None}
    best = {vector for vector in distinct if not any(beats(other, vector) for other in distinct)}
    return [vector in best for vector in usable]


def beats(one: Vector, other: Vector) -> bool:
    """Whether a vector is nowhere greater than another, and somewhere less."""
    return one != other and all(a <= b for a, b in zip(one, other, strict=True))
