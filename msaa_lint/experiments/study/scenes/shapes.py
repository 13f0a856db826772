"""Shapes as triangles, in pixels."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Point = tuple[float, float]

GOLDEN = (math.sqrt(5) - 1) / 2
"""Its multiples, without the whole part, spread evenly: numbers that look random and are the same everywhere."""


def spread(number: int, start: float = 0.5) -> float:
    """The number-th of a sequence that fills [0, 1) evenly (Weyl, with the golden ratio)."""
    return (start + number * GOLDEN) % 1.0


def fan(polygon: Sequence[Point]) -> list[list[Point]]:
    """The triangles of a convex polygon, all from its first corner."""
    return [[polygon[0], polygon[n], polygon[n + 1]] for n in range(1, len(polygon) - 1)]


def triangles(polygons: Iterable[Sequence[Point]]) -> Floats:
    """The triangles (T, 3, 2) of convex polygons."""
    return np.array([each for polygon in polygons for each in fan(polygon)], np.float64).reshape(-1, 3, 2)


def bar(start: Point, end: Point, width: float) -> list[Point]:
    """The rectangle around a line."""
    (x0, y0), (x1, y1) = start, end
    length = math.hypot(x1 - x0, y1 - y0)
    across, down = -(y1 - y0) / length * width / 2, (x1 - x0) / length * width / 2
    return [(x0 + across, y0 + down), (x1 + across, y1 + down), (x1 - across, y1 - down), (x0 - across, y0 - down)]


def around(center: Point, radius: float, angle: float) -> Point:
    """The point at an angle (radians, from x towards y) and a distance."""
    return center[0] + radius * math.cos(angle), center[1] + radius * math.sin(angle)


def rectangle(x0: float, y0: float, x1: float, y1: float) -> list[Point]:
    return [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]


def painted(count: int, color: Sequence[float]) -> Floats:
    """One colour for that many triangles."""
    return np.tile(np.asarray(color, np.float64), (count, 1))
