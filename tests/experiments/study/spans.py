"""Pictures of spans, and sample patterns that no device has, to compare the standard ones with."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from msaa_lint.experiments.study.coverage import Rows
from msaa_lint.experiments.study.locations import SUBPIXELS


def hits(rows: Rows, width: int, height: int) -> NDArray[np.int64]:
    """The number of covered samples of every pixel, each counted once per triangle: (height,
    width).
    """
    steps = np.zeros((height, width + 1), np.int64)
    row = np.repeat(rows.row[:, None], rows.left.shape[1], axis=1)
    np.add.at(steps, (row, rows.left), 1)
    np.subtract.at(steps, (row, rows.right), 1)
    return steps.cumsum(axis=1)[:, :-1]


def masks(rows: Rows, width: int, height: int, samples: int) -> NDArray[np.bool_]:
    """The samples of the picture that any triangle covers: (height, width, samples)."""
    assert rows.left.shape[1] == samples
    planes = [
        rows._replace(left=rows.left[:, n : n + 1], right=rows.right[:, n : n + 1])
        for n in range(samples)
    ]
    return np.stack([hits(plane, width, height) > 0 for plane in planes], axis=-1)


def grid(side: int) -> NDArray[np.int64]:
    """The centers of `side` x `side` equal cells of a pixel, row by row: (side * side, 2), in
    1/(256 * side) pixel.
    """
    return _pairs(SUBPIXELS * np.arange(side, dtype=np.int64) + SUBPIXELS // 2)


def jittered(side: int, seed: int, subpixels: int = SUBPIXELS) -> NDArray[np.int64]:
    """One random sample in each of `side` x `side` equal cells: (side * side, 2), in 1/subpixels
    pixel, the same for the same seed.
    """
    cells = _pairs(np.arange(side, dtype=np.int64))
    return _stepped((cells + np.random.default_rng(seed).random(cells.shape)) / side, subpixels)


def random(count: int, seed: int, subpixels: int = SUBPIXELS) -> NDArray[np.int64]:
    """`count` independent random samples in the pixel: (count, 2), in 1/subpixels pixel, the same
    for the same seed.
    """
    return _stepped(np.random.default_rng(seed).random((count, 2)), subpixels)


def _pairs(steps: NDArray[np.int64]) -> NDArray[np.int64]:
    """Every (x, y) of the steps, with x varying fastest."""
    y, x = np.meshgrid(steps, steps, indexing="ij")
    return np.stack((x.ravel(), y.ravel()), axis=1)


def _stepped(positions: NDArray[np.float64], subpixels: int) -> NDArray[np.int64]:
    """Positions in pixels as integer steps, inside the pixel even where a position rounded up to
    1.
    """
    return np.minimum((positions * subpixels).astype(np.int64), subpixels - 1)
