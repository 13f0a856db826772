"""The exact picture of triangles that do not overlap: their areas within every pixel, times their colours."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from msaa_lint.experiments.study.exact_area import areas_of

from .scene import RGBA

Floats = NDArray[np.float64]

NOTHING = 1e-9
"""Areas below it, in pixels, are none: they are the rounding of double precision."""


def disjoint(colors: Floats, background: RGBA, width: int, height: int) -> Callable[[Floats], Floats]:
    """What gives the exact picture (H, W, 4) of triangles that do not overlap, each in its colour."""
    behind = np.asarray(background, np.float64)
    kinds, number = _kinds(colors)

    def exact(triangles: Floats) -> Floats:
        picture = np.empty((height, width, 4))
        picture[:] = behind
        for kind, color in enumerate(kinds):
            picture += areas_of(triangles[number == kind], width, height)[..., None] * (color - behind)
        return picture

    return exact


def edges_between(colors: Floats, width: int, height: int) -> Callable[[Floats], NDArray[np.bool_]]:
    """What gives the pixels (H, W) that no colour, nor the background, fills whole."""
    kinds, number = _kinds(colors)

    def crossed(triangles: Floats) -> NDArray[np.bool_]:
        covered, whole = np.zeros((height, width)), np.zeros((height, width), bool)
        for kind in range(len(kinds)):
            area = areas_of(triangles[number == kind], width, height)
            covered += area
            whole |= area > 1 - NOTHING
        return ~whole & (covered > NOTHING)

    return crossed


def _kinds(colors: Floats) -> tuple[Floats, NDArray[np.intp]]:
    """The colours that there are, and each triangle's number of them."""
    kinds, number = np.unique(colors, axis=0, return_inverse=True)
    return kinds, number.reshape(-1)
