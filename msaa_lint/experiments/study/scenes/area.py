"""The exact picture of triangles that do not overlap: their areas within each pixel times their
colors.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from .view import Truth, View

Floats = NDArray[np.float64]

TOLERANCE = 1e-9
"""Areas below this, in pixels, are rounding errors of double precision."""


def disjoint(colors: Floats, *, covered: bool = True) -> Callable[[View], Truth]:
    """A function from triangles that do not overlap, each in its color, to their exact picture on
    black.

    Edge pixels are those with an alpha between 0 and 1, or without `covered` those that neither a
    single color nor the background fills.
    """
    distinct, index = np.unique(colors, axis=0, return_inverse=True)
    index = index.reshape(-1)

    def exact(view: View) -> Truth:
        first = view.parts[0]
        size = (len(view.parts), first.height, first.width)
        picture, total, whole = np.zeros((*size, 4)), np.zeros(size), np.zeros(size, bool)
        color_of = index[view.triangle]
        for number in np.unique(color_of):
            area = view.only(color_of == number).areas()
            picture += area[..., None] * distinct[number]
            total += area
            whole |= area > 1 - TOLERANCE
        return Truth(
            picture, partly_covered(picture[..., 3]) if covered else ~whole & (total > TOLERANCE)
        )

    return exact


def partly_covered(coverage: Floats) -> NDArray[np.bool_]:
    """The pixels whose coverage is between 0 and 1."""
    edge: NDArray[np.bool_] = (coverage > TOLERANCE) & (coverage < 1 - TOLERANCE)
    return edge
