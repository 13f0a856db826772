"""Pareto-optimal choices: those that no other choice dominates."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

from .points import Point

SAME = 1.05
"""Times within this factor count as equal: clocks are not more precise."""

FIGURES = 3
"""Significant digits of an error that are compared: smaller differences are rounding."""

Vector = tuple[float, ...]
"""Quantities of which less is better: the error, then one or more costs."""


def mark_best(points: Iterable[Point]) -> list[Point]:
    """The points, with `best` set on those that no other point of their scene and size dominates."""
    all_points = list(points)
    best = [False] * len(all_points)
    for group in _groups(all_points):
        group_points = [all_points[n] for n in group]
        for n, optimal in zip(group, _simplest(group_points, front(vectors(group_points))), strict=True):
            best[n] = optimal
    return [point._replace(best=optimal) for point, optimal in zip(all_points, best, strict=True)]


def _simplest(points: Sequence[Point], best: Sequence[bool]) -> list[bool]:
    """The Pareto front of a scene, where a point gives way to one that does less work for the same error in the same time."""
    chosen = set()
    for n, optimal in enumerate(best):
        while optimal:
            simpler = [m for m, other in enumerate(points) if _less_work(other, points[n]) and _as_fast(other, points[n])]
            if not simpler:
                chosen.add(n)
                break
            n = min(simpler, key=lambda m: (points[m].technique.samples, points[m].technique.shaded))
    return [n in chosen for n in range(len(points))]


def _as_fast(one: Point, other: Point) -> bool:
    return one.time_ms is not None and other.time_ms is not None and one.time_ms <= SAME * other.time_ms


def _less_work(one: Point, other: Point) -> bool:
    """Whether a point has the same error as another with fewer samples or shader invocations, and no more of either."""
    work = (one.technique.samples, one.technique.shaded), (other.technique.samples, other.technique.shaded)
    return _error(one) == _error(other) and beats(*work)


def _error(point: Point) -> float:
    return float(f"{point.rmse:.{FIGURES}g}")


def _groups(points: Sequence[Point]) -> list[list[int]]:
    groups: dict[tuple[str, int, int], list[int]] = {}
    for n, point in enumerate(points):
        groups.setdefault((point.scene, point.width, point.height), []).append(n)
    return list(groups.values())


def vectors(points: Sequence[Point]) -> list[Vector | None]:
    """The quantities that the points of a scene are compared by; None for a point that cannot be compared.

    They are error and time if the time of any point is known. Otherwise they are the error and the known costs: samples per pixel, shader
    invocations per pixel, and the model's bytes if it has them for every point.
    """
    if any(point.time_ms is not None for point in points):
        return [(_error(point), point.time_ms) if point.time_ms is not None else None for point in points]
    known = all(point.bytes_per_frame is not None for point in points)
    return [
        (_error(point), float(point.technique.samples), float(point.technique.shaded), (point.bytes_per_frame or 0.0) if known else 0.0)
        for point in points
    ]


def front(vectors: Sequence[Vector | None]) -> list[bool]:
    """For each vector whether no other dominates it. Equal vectors do not dominate each other; unknown vectors and those with NaN are never
    on the front."""
    usable = [vector if vector is not None and not any(map(math.isnan, vector)) else None for vector in vectors]
    distinct = {vector for vector in usable if vector is not None}
    best = {vector for vector in distinct if not any(beats(other, vector) for other in distinct)}
    return [vector in best for vector in usable]


def beats(one: Vector, other: Vector) -> bool:
    """Whether a vector is nowhere greater than another, and somewhere less."""
    return one != other and all(a <= b for a, b in zip(one, other, strict=True))
