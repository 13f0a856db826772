"""Which choices are worth looking at: those that no other one beats."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

from .points import Point

SAME = 1.05
"""What takes up to so many times the time of another takes the same: clocks say no more."""

FIGURES = 3
"""Figures of an error that are compared: what differs by less differs by rounding."""

Vector = tuple[float, ...]
"""What is better the less there is of it: the error first, then one cost or several."""


def marked(points: Iterable[Point]) -> list[Point]:
    """The points, `best` set on each that no other of its scene and size beats."""
    found = list(points)
    best = [False] * len(found)
    for group in _groups(found):
        own = [found[n] for n in group]
        for n, on in zip(group, _simplest(own, front(vectors(own))), strict=True):
            best[n] = on
    return [point._replace(best=on) for point, on in zip(found, best, strict=True)]


def _simplest(points: Sequence[Point], best: Sequence[bool]) -> list[bool]:
    """The front of a scene, with what does less work for the same error in the same time in the place of what does more."""
    chosen = set()
    for n, on in enumerate(best):
        while on:
            less = [m for m, other in enumerate(points) if _less_work(other, points[n]) and _as_fast(other, points[n])]
            if not less:
                chosen.add(n)
                break
            n = min(less, key=lambda m: (points[m].technique.samples, points[m].technique.shaded))
    return [n in chosen for n in range(len(points))]


def _as_fast(one: Point, other: Point) -> bool:
    return one.time_ms is not None and other.time_ms is not None and one.time_ms <= SAME * other.time_ms


def _less_work(one: Point, other: Point) -> bool:
    """Whether a point has the very error of another by fewer samples or shader invocations, and no more of either."""
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
    """What the points of a scene are compared by; None for one that cannot be.

    Error and time where a time is known of any of them. Else what is known of the cost: the samples of a pixel, the shader invocations of
    one, and the model's bytes where it has them of all.
    """
    if any(point.time_ms is not None for point in points):
        return [(_error(point), point.time_ms) if point.time_ms is not None else None for point in points]
    known = all(point.bytes_per_frame is not None for point in points)
    return [
        (_error(point), float(point.technique.samples), float(point.technique.shaded), (point.bytes_per_frame or 0.0) if known else 0.0)
        for point in points
    ]


def front(vectors: Sequence[Vector | None]) -> list[bool]:
    """For each vector whether no other beats it: is nowhere more and somewhere less. Equal ones do not beat each other; what is no number,
    or not known, is on no front."""
    usable = [vector if vector is not None and not any(map(math.isnan, vector)) else None for vector in vectors]
    distinct = {vector for vector in usable if vector is not None}
    best = {vector for vector in distinct if not any(beats(other, vector) for other in distinct)}
    return [vector in best for vector in usable]


def beats(one: Vector, other: Vector) -> bool:
    """Whether a vector is nowhere more than another, and somewhere less."""
    return one != other and all(a <= b for a, b in zip(one, other, strict=True))
