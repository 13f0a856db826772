"""Where the samples of a pixel lie: the standard patterns, and grids, jittered and random ones to compare them with."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from msaa_lint.frame.vulkan.sample_locations import STANDARD

SUBPIXELS = 256
"""Steps to a pixel: coordinates are whole numbers of 1/256 pixel."""


def standard(samples: int) -> NDArray[np.int64]:
    """The standard pattern of a sample count: (samples, 2), x and y in 1/256 pixel, in sample order.

    ValueError for a count that has no standard pattern, 32 and 64 among them.
    """
    if samples not in STANDARD:
        raise ValueError(f"no standard sample locations for a sample count of {samples}: the counts are {', '.join(map(str, STANDARD))}")
    return np.array(STANDARD[samples], dtype=np.int64) * (SUBPIXELS // 16)


def grid(side: int) -> NDArray[np.int64]:
    """The centres of `side` x `side` equal cells of a pixel, row by row: (side * side, 2), in 1/(256 * side) pixel.

    In 1/256 pixel the centres of three cells would be no whole numbers. The finer step makes all exact: `rows(triangles * side, width,
    height, grid(side), SUBPIXELS * side)` takes the very samples of a picture `side` times as wide and as high with one sample a pixel.
    """
    _at_least_one(side, "side")
    centres = SUBPIXELS * np.arange(side, dtype=np.int64) + SUBPIXELS // 2
    return _pairs(centres)


def jittered(side: int, seed: int, subpixels: int = SUBPIXELS) -> NDArray[np.int64]:
    """One sample anywhere in each of `side` x `side` equal cells: (side * side, 2), in 1/subpixels pixel, the same for the same seed.

    A position is rounded down to the step, which moves all by half of it on average: choose it fine against the spacing of samples.
    """
    _at_least_one(side, "side")
    cells = _pairs(np.arange(side, dtype=np.int64))
    return _stepped((cells + np.random.default_rng(seed).random(cells.shape)) / side, subpixels)


def random(count: int, seed: int, subpixels: int = SUBPIXELS) -> NDArray[np.int64]:
    """`count` samples anywhere in the pixel, independent of each other: (count, 2), in 1/subpixels pixel, the same for the same seed."""
    _at_least_one(count, "count")
    return _stepped(np.random.default_rng(seed).random((count, 2)), subpixels)


def _pairs(steps: NDArray[np.int64]) -> NDArray[np.int64]:
    """Every (x, y) of the steps, y the slower."""
    y, x = np.meshgrid(steps, steps, indexing="ij")
    return np.stack((x.ravel(), y.ravel()), axis=1)


def _stepped(positions: NDArray[np.float64], subpixels: int) -> NDArray[np.int64]:
    """Positions in pixels as whole steps, inside the pixel even where a position rounded up to 1."""
    return np.minimum((positions * subpixels).astype(np.int64), subpixels - 1)


def _at_least_one(number: int, name: str) -> None:
    if number < 1:
        raise ValueError(f"{name} is {number}: at least 1")
