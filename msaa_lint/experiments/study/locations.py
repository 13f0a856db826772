"""Sample locations: the standard patterns, and grid, jittered and random patterns to compare them with."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from msaa_lint.frame.vulkan.sample_locations import STANDARD

SUBPIXELS = 256
"""Steps per pixel: coordinates are integers in units of 1/256 pixel."""


def standard(samples: int) -> NDArray[np.int64]:
    """The standard pattern of a sample count: (samples, 2), x and y in 1/256 pixel, in sample order.

    ValueError for a count without a standard pattern, such as 32 and 64.
    """
    if samples not in STANDARD:
        raise ValueError(f"there are no standard sample locations for {samples} samples, only for {', '.join(map(str, STANDARD))}")
    return np.array(STANDARD[samples], dtype=np.int64) * (SUBPIXELS // 16)


def grid(side: int) -> NDArray[np.int64]:
    """The centers of `side` x `side` equal cells of a pixel, row by row: (side * side, 2), in 1/(256 * side) pixel.

    The centers of three cells are not integers in 1/256 pixel; the finer step makes all of them exact. `rows(triangles * side, width,
    height, grid(side), SUBPIXELS * side)` takes exactly the samples of a picture `side` times as wide and as high with one sample per
    pixel.
    """
    _at_least_one(side, "side")
    return _pairs(SUBPIXELS * np.arange(side, dtype=np.int64) + SUBPIXELS // 2)


def jittered(side: int, seed: int, subpixels: int = SUBPIXELS) -> NDArray[np.int64]:
    """One random sample in each of `side` x `side` equal cells: (side * side, 2), in 1/subpixels pixel, the same for the same seed.

    Positions are rounded down to the step, which moves them by half a step on average: choose a step much finer than the sample spacing.
    """
    _at_least_one(side, "side")
    cells = _pairs(np.arange(side, dtype=np.int64))
    return _stepped((cells + np.random.default_rng(seed).random(cells.shape)) / side, subpixels)


def random(count: int, seed: int, subpixels: int = SUBPIXELS) -> NDArray[np.int64]:
    """`count` independent random samples in the pixel: (count, 2), in 1/subpixels pixel, the same for the same seed."""
    _at_least_one(count, "count")
    return _stepped(np.random.default_rng(seed).random((count, 2)), subpixels)


def _pairs(steps: NDArray[np.int64]) -> NDArray[np.int64]:
    """Every (x, y) of the steps, with x varying fastest."""
    y, x = np.meshgrid(steps, steps, indexing="ij")
    return np.stack((x.ravel(), y.ravel()), axis=1)


def _stepped(positions: NDArray[np.float64], subpixels: int) -> NDArray[np.int64]:
    """Positions in pixels as integer steps, inside the pixel even where a position rounded up to 1."""
    return np.minimum((positions * subpixels).astype(np.int64), subpixels - 1)


def _at_least_one(number: int, name: str) -> None:
    if number < 1:
        raise ValueError(f"{name} must be at least 1, found {number}")
