"""Coverage and area by their definitions, in Python's integers and fractions, a sample or a pixel
at a time; and as is often written.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from msaa_lint.experiments.study.coverage import Rows

Point = tuple[int, int]
Corners = list[tuple[Any, Any]]
"""Of fractions, or floating-point numbers of some precision."""


def edge(a: Point, b: Point, at: Point) -> int:
    """The edge function: twice the area of (a, b, at), above 0 where `at` lies on the right of a
    walk from a to b, y down.
    """
    return (b[0] - a[0]) * (at[1] - a[1]) - (b[1] - a[1]) * (at[0] - a[0])


def covers(triangle: Sequence[Point], at: Point) -> bool:
    """Whether a sample is covered: inside of all edges, or on those that are top or left."""
    a, b, c = triangle
    area = edge(a, b, c)
    if area == 0:
        return False
    walk = (a, b, c) if area > 0 else (a, c, b)
    for start, end in zip(walk, (*walk[1:], walk[0]), strict=True):
        side = edge(start, end, at)
        top = start[1] == end[1] and end[0] > start[0]
        left = end[1] < start[1]
        if side < 0 or (side == 0 and not (top or left)):
            return False
    return True


def covered(
    triangle: NDArray[np.int64],
    width: int,
    height: int,
    locations: NDArray[np.int64],
    subpixels: int = 256,
) -> NDArray[np.bool_]:
    """The samples (height, width, samples) that one triangle covers."""
    corners = [(int(x), int(y)) for x, y in triangle]
    return np.array(
        [
            [
                [
                    covers(corners, (column * subpixels + int(x), row * subpixels + int(y)))
                    for x, y in locations
                ]
                for column in range(width)
            ]
            for row in range(height)
        ],
        dtype=np.bool_,
    ).reshape(height, width, len(locations))


def hit(rows: Rows, triangle: int, row: int, column: int, sample: int = 0) -> bool:
    """Whether spans cover a sample."""
    own = (rows.triangle == triangle) & (rows.row == row)
    return bool(((rows.left[own, sample] <= column) & (column < rows.right[own, sample])).any())


def exact_area(polygon: NDArray[np.float64], column: int, row: int) -> Fraction:
    """The area of a polygon within a pixel."""
    return Fraction(clipped_area(polygon.tolist(), column, row, Fraction))


def clipped_area(
    polygon: Sequence[Sequence[float]], column: int, row: int, number: Callable[[float], Any]
) -> Any:
    """The area of a polygon within a pixel, in numbers of a kind: clipped at its four sides, by the
    shoelace formula.
    """
    corners = [(number(x), number(y)) for x, y in polygon]
    for axis, side, keep in ((0, column, 1), (0, column + 1, -1), (1, row, 1), (1, row + 1, -1)):
        corners = _clipped(corners, axis, number(side), number(keep))
    return abs(shoelace(corners))


def shoelace(corners: Corners) -> Any:
    """The signed area of a polygon."""
    return (
        sum(
            a[0] * b[1] - b[0] * a[1]
            for a, b in zip(corners, (*corners[1:], *corners[:1]), strict=True)
        )
        / 2
    )


def _clipped(corners: Corners, axis: int, side: Any, keep: Any) -> Corners:
    found: Corners = []
    for a, b in zip((*corners[-1:], *corners[:-1]), corners, strict=True):
        near, far = (a[axis] - side) * keep, (b[axis] - side) * keep
        if near * far < 0:
            share = near / (near - far)
            found.append((a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])))
        if far >= 0:
            found.append(b)
    return found


def naive(
    triangles: NDArray[np.int64], samples: NDArray[np.int64], number: type
) -> NDArray[np.bool_]:
    """Whether triangles (T, 3, 2), clockwise on the screen, cover a sample (T, 2) each, as is often
    written: edge functions in floating point, from pixels, with the top-left rule. What it says is
    wrong where the product of two differences is rounded.
    """
    corners, at = (triangles / 256).astype(number), (samples / 256).astype(number)
    inside = np.ones(len(triangles), dtype=np.bool_)
    for n in range(3):
        start, end = corners[:, n], corners[:, (n + 1) % 3]
        run, rise = (end - start).T
        side = run * (at[:, 1] - start[:, 1]) - rise * (at[:, 0] - start[:, 0])
        inside &= (side > 0) | ((side == 0) & ((rise < 0) | ((rise == 0) & (run > 0))))
    return inside
