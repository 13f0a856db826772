"""From spans to the fragments of triangles, with their sample masks."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .coverage import Rows

MAX_SAMPLES = 16
"""Bits of a mask."""


class Fragments(NamedTuple):
    """A fragment for each pixel in which a triangle covers a sample: `triangle`, `y`, `x` (F,)
    int32, `mask` (F,) uint16.

    Bit n of a mask is set where sample n is covered. Ordered by triangle, then row from the top,
    then column from the left.
    """

    triangle: NDArray[np.int32]
    y: NDArray[np.int32]
    x: NDArray[np.int32]
    mask: NDArray[np.uint16]


def fragments(rows: Rows, samples: int) -> Fragments:
    """The fragments of spans. ValueError for more than 16 samples, and for spans of another sample
    count.
    """
    if rows.left.shape[1] != samples:
        raise ValueError(f"expected spans of {samples} samples, found {rows.left.shape[1]}")
    if samples > MAX_SAMPLES:
        raise ValueError(f"a mask holds at most {MAX_SAMPLES} samples, found {samples}")
    covers = rows.left < rows.right
    low = np.where(covers, rows.left, np.iinfo(np.int32).max).min(
        axis=1, initial=np.iinfo(np.int32).max
    )
    widths = rows.right.max(axis=1, initial=0) - low
    ends = np.cumsum(widths, dtype=np.int64)
    total = int(ends[-1]) if len(ends) else 0
    shift = ends - widths - low

    # A sample has one span per row: adding its bit at the start and subtracting it at the end never
    # carries.
    steps = np.zeros(total + 1, dtype=np.uint16)
    for n in range(samples):
        covered = covers[:, n]
        np.add.at(steps, (rows.left[:, n] + shift)[covered], np.uint16(1 << n))
        np.subtract.at(steps, (rows.right[:, n] + shift)[covered], np.uint16(1 << n))
    mask = np.cumsum(steps[:total], dtype=np.uint16)
    x = (np.arange(total) - np.repeat(shift, widths)).astype(np.int32)
    found = Fragments(np.repeat(rows.triangle, widths), np.repeat(rows.row, widths), x, mask)
    # There may be gaps between the spans of a narrow triangle's samples.
    nonempty = mask != 0
    return found if nonempty.all() else Fragments(*(column[nonempty] for column in found))
