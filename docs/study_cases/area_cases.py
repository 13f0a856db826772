"""Cases of the exact picture: areas of triangles within a pixel."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from msaa_lint.experiments.study.exact_area import ACCURACY, areas
from tests.experiments.study.rational import exact_area

from .row import Row

Corner = tuple[float, float]


def clipped_area(polygon: Sequence[Corner], kind: type[np.floating[Any]]) -> float:
    """The area of a polygon within the pixel (0, 0) as is often computed, in a precision: clipped at its four sides, by the shoelace
    formula."""
    corners = [(kind(x), kind(y)) for x, y in polygon]
    for axis, side, keep in ((0, kind(0), kind(1)), (0, kind(1), kind(-1)), (1, kind(0), kind(1)), (1, kind(1), kind(-1))):
        kept: list[tuple[Any, Any]] = []
        for a, b in zip((*corners[-1:], *corners[:-1]), corners, strict=True):
            near, far = (a[axis] - side) * keep, (b[axis] - side) * keep
            if near * far < 0:
                share = near / (near - far)
                kept.append((a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])))
            if far >= 0:
                kept.append(b)
        corners = kept
    total = kind(0)
    for a, b in zip(corners, (*corners[1:], *corners[:1]), strict=True):
        total += a[0] * b[1] - b[0] * a[1]
    return abs(float(total)) / 2


def exact_areas() -> Iterator[Row]:
    """Areas within a pixel of triangles that reach far beyond it, to 12 digits."""
    step = 1 / 256
    for triangle, words in (
        ([(-4096.0, -4095.5), (4096.0, 4096.0), (4096.0, 4096.0 + step)], "a sliver 1/256 pixel wide and 11,585 long"),
        ([(-(2.0**20), -(2.0**20) + 0.25), (2.0**20, 2.0**20), (-(2.0**20), 2.0**20)], "a triangle whose corners are 2^20 pixels away"),
        ([(-(2.0**23), 0.5), (2.0**23, 0.5 + step), (0.0, 2.0**23)], "a triangle whose corners are 2^23 pixels away"),
    ):
        exact = float(exact_area(np.array(triangle), 0, 0))
        found = clipped_area(triangle, np.float32), clipped_area(triangle, np.float64), float(areas(np.array(triangle), 1, 1)[0, 0])
        yield Row("exact picture", f"area in a pixel of {words}; naive: clipped and added in float32", exact, *found, ACCURACY / exact)
