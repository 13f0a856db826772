"""Shapes as triangles, in pixels."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Point = tuple[float, float]

GOLDEN = (math.sqrt(5) - 1) / 2
"""The fractional parts of its multiples are spread evenly over [0, 1) and look random, but are the
same everywhere.
"""


def spread(number: int, start: float = 0.5) -> float:
    """The number-th value of a sequence that fills [0, 1) evenly (Weyl, with the golden ratio)."""
    return (start + number * GOLDEN) % 1.0


def fan(polygon: Sequence[Point]) -> list[list[Point]]:
    """The triangles of a convex polygon, all with its first corner."""
    return [[polygon[0], polygon[n], polygon[n + 1]] for n in range(1, len(polygon) - 1)]


def triangles(polygons: Iterable[Sequence[Point]]) -> Floats:
    """The triangles (T, 3, 2) of convex polygons."""
    return np.array(
        [triangle for polygon in polygons for triangle in fan(polygon)], np.float64
    ).reshape(-1, 3, 2)


def bar(start: Point, end: Point, width: float) -> list[Point]:
    """The rectangle around a line segment."""
    (x0, y0), (x1, y1) = start, end
    length = math.hypot(x1 - x0, y1 - y0)
    dx, dy = -(y1 - y0) / length * width / 2, (x1 - x0) / length * width / 2
    return [(x0 + dx, y0 + dy), (x1 + dx, y1 + dy), (x1 - dx, y1 - dy), (x0 - dx, y0 - dy)]


def polar(center: Point, radius: float, angle: float) -> Point:
    """The point at a distance and an angle (radians, from x toward y) from a center."""
    return center[0] + radius * math.cos(angle), center[1] + radius * math.sin(angle)


def rectangle(x0: float, y0: float, x1: float, y1: float) -> list[Point]:
    return [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]


def uniform_colors(count: int, color: Sequence[float]) -> Floats:
    """One color for `count` triangles."""
    return np.tile(np.asarray(color, np.float64), (count, 1))


def depth_planes(corners: Floats, depths: Floats) -> Floats:
    """Each triangle's depth as a plane a*x + b*y + c in pixels (T, 3), from corners (T, 3, 2) and
    their depths (T, 3); a and b are 0 for a triangle without area.
    """
    (x0, y0), (x1, y1), (x2, y2) = (corners[:, n].T for n in range(3))
    z0, z1, z2 = depths.T
    area = (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)
    has_area = area != 0
    divisor = np.where(has_area, area, 1.0)
    a = np.where(has_area, ((z1 - z0) * (y2 - y0) - (z2 - z0) * (y1 - y0)) / divisor, 0.0)
    b = np.where(has_area, ((z2 - z0) * (x1 - x0) - (z1 - z0) * (x2 - x0)) / divisor, 0.0)
    return np.stack([a, b, z0 - a * x0 - b * y0], axis=1)
