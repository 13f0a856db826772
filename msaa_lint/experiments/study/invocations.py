"""How often a fragment shader runs: its invocations, and the helper invocations that complete quads
of 2x2 pixels.

GPUs shade quads, as derivatives need neighbors (specification 29.5, Helper Invocations): a quad in
which a triangle covers one pixel takes the time of four. Helpers are not among the invocations that
a device counts.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from . import coverage, locations, snap
from .points import SAMPLE_SHADING, SSAA, Technique
from .shade import groups


class Invocations(NamedTuple):
    """The samples of a frame that triangles cover; its invocations with one per covered pixel of a
    triangle, and their helpers; and those that sample shading adds, and theirs. Depth, stencil, and
    discarding are not considered.
    """

    covered: int = 0
    pixels: int = 0
    pixel_helpers: int = 0
    samples: int = 0
    sample_helpers: int = 0

    @property
    def total(self) -> int:
        """Those that a device counts."""
        return self.pixels + self.samples


def count(
    triangles: NDArray[np.float64], size: tuple[int, int], technique: Technique, bits: int = 8
) -> Invocations:
    """The invocations of a technique that draws triangles (T, 3, 2), in pixels, into a picture of a
    size.
    """
    grid = technique.grid if technique.kind == SSAA else 1
    samples = 1 if technique.kind == SSAA else technique.samples
    places = locations.standard(samples)
    rows = coverage.rows(
        snap.snapped(triangles * grid, bits), size[0] * grid, size[1] * grid, places
    )
    every_sample, shared = (
        groups(samples, 1),
        groups(samples, technique.shaded if technique.kind == SAMPLE_SHADING else 1),
    )
    pixels, lanes = _counted(rows, every_sample)
    invocations, all_lanes = _counted(rows, shared) if shared != every_sample else (pixels, lanes)
    covered = int((rows.right - rows.left).sum(dtype=np.int64))
    return Invocations(
        covered,
        pixels,
        lanes - pixels,
        invocations - pixels,
        max(all_lanes - invocations - (lanes - pixels), 0),
    )


def _counted(rows: coverage.Rows, sample_groups: tuple[int, ...]) -> tuple[int, int]:
    """The invocations of spans, and the lanes of their quads, which are four for each quad of a
    triangle.
    """
    count = rows.left.shape[1]
    # The rows of a triangle follow each other: those of a quad are next to each other.
    starts = np.concatenate(
        ([True], (np.diff(rows.triangle) != 0) | (np.diff(rows.row >> 1) != 0))
    )[: len(rows.row)]
    pair, second = np.cumsum(starts) - 1, (~starts).astype(np.intp)
    invocations = lanes = 0
    for bits in sample_groups:
        members = [number for number in range(count) if bits >> number & 1]
        left, right = rows.left[:, members], rows.right[:, members]
        invocations += _union(left, right)
        quads = np.zeros((2, int(pair[-1]) + 1 if len(pair) else 0, 2, len(members)), np.int32)
        quads[0, pair, second], quads[1, pair, second] = left >> 1, (right + 1) >> 1
        # An empty span from 0 to 0 is an empty span of quads too.
        lanes += 4 * _union(*quads.reshape(2, quads.shape[1], 2 * len(members)))
    return invocations, lanes


def _union(left: NDArray[np.int32], right: NDArray[np.int32]) -> int:
    """The number of columns that are in any of the spans of each row, (R, N), in total."""
    order = np.argsort(left, axis=1)
    begins, ends = np.take_along_axis(left, order, axis=1), np.take_along_axis(right, order, axis=1)
    reached = np.maximum.accumulate(ends, axis=1)
    begins[:, 1:] = np.maximum(begins[:, 1:], reached[:, :-1])
    return int(np.maximum(ends - begins, 0).sum(dtype=np.int64))
