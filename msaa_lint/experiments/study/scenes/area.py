"""The exact picture of triangles that do not overlap: their areas within each pixel times their colors."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from msaa_lint.experiments.study.exact_area import areas_of

Floats = NDArray[np.float64]

TOLERANCE = 1e-9
"""Areas below this, in pixels, are rounding errors of double precision."""


def disjoint(colors: Floats, width: int, height: int) -> Callable[[Floats], Floats]:
    """A function from triangles that do not overlap, each in its color, to their exact picture (H, W, 4) on black."""
    distinct, index = _distinct(colors)

    def exact(triangles: Floats) -> Floats:
        picture = np.zeros((height, width, 4))
        for number, color in enumerate(distinct):
            picture += areas_of(triangles[index == number], width, height)[..., None] * color
        return picture

    return exact


def edges_between(colors: Floats, width: int, height: int) -> Callable[[Floats], NDArray[np.bool_]]:
    """A function from triangles to the pixels (H, W) that neither a single color nor the background fills."""
    distinct, index = _distinct(colors)

    def edge_pixels(triangles: Floats) -> NDArray[np.bool_]:
        covered, whole = np.zeros((height, width)), np.zeros((height, width), bool)
        for number in range(len(distinct)):
            area = areas_of(triangles[index == number], width, height)
            covered += area
            whole |= area > 1 - TOLERANCE
        return ~whole & (covered > TOLERANCE)

    return edge_pixels


def partly_covered(coverage: Floats) -> NDArray[np.bool_]:
    """The pixels whose coverage is between 0 and 1."""
    edge: NDArray[np.bool_] = (coverage > TOLERANCE) & (coverage < 1 - TOLERANCE)
    return edge


def _distinct(colors: Floats) -> tuple[Floats, NDArray[np.intp]]:
    """The distinct colors, and each triangle's index among them."""
    distinct, index = np.unique(colors, axis=0, return_inverse=True)
    return distinct, index.reshape(-1)
