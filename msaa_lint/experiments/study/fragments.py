"""From spans to samples: the fragments of triangles with their sample masks, and the covered samples of a picture."""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .coverage import Rows

MAX_SAMPLES = 16
"""Bits of a mask."""


class Fragments(NamedTuple):
    """A fragment for each pixel in which a triangle covers a sample: `triangle`, `y`, `x` (F,) int32, `mask` (F,) uint16.

    Bit n of a mask is set where sample n is covered. Ordered by triangle, then row from the top, then column from the left.
    """

    triangle: NDArray[np.int32]
    y: NDArray[np.int32]
    x: NDArray[np.int32]
    mask: NDArray[np.uint16]


def fragments(rows: Rows, samples: int) -> Fragments:
    """The fragments of spans. ValueError for more than 16 samples, and for spans of another sample count."""
    _check_samples(rows, samples)
    if samples > MAX_SAMPLES:
        raise ValueError(f"a mask holds at most {MAX_SAMPLES} samples, found {samples}")
    covers = rows.left < rows.right
    low = np.where(covers, rows.left, np.iinfo(np.int32).max).min(axis=1, initial=np.iinfo(np.int32).max)
    widths = rows.right.max(axis=1, initial=0) - low
    ends = np.cumsum(widths, dtype=np.int64)
    total = int(ends[-1]) if len(ends) else 0
    shift = ends - widths - low

    # A sample has one span per row: adding its bit at the start and subtracting it at the end never carries.
    steps = np.zeros(total + 1, dtype=np.uint16)
    for n in range(samples):
        covered = covers[:, n]
        np.add.at(steps, (rows.left[:, n] + shift)[covered], np.uint16(1 << n))
        np.subtract.at(steps, (rows.right[:, n] + shift)[covered], np.uint16(1 << n))
    mask = np.cumsum(steps[:total], dtype=np.uint16)
    all_fragments = Fragments(
        np.repeat(rows.triangle, widths),
        np.repeat(rows.row, widths),
        (np.arange(total) - np.repeat(shift, widths)).astype(np.int32),
        mask,
    )
    # There may be gaps between the spans of a narrow triangle's samples.
    nonempty = mask != 0
    return (
        all_fragments
        if bool(nonempty.all())
        else Fragments(all_fragments.triangle[nonempty], all_fragments.y[nonempty], all_fragments.x[nonempty], mask[nonempty])
    )


def masks(rows: Rows, width: int, height: int, samples: int) -> NDArray[np.bool_]:
    """The samples of the picture that any triangle covers: (height, width, samples)."""
    _check_samples(rows, samples)
    max_count = int(np.bincount(rows.row, minlength=1).max())
    lane = np.dtype(np.uint8) if max_count < 1 << 8 else np.dtype(np.uint16) if max_count < 1 << 16 else np.dtype(np.uint32)
    # Several samples are counted in one word, each in a lane that the triangles of a row cannot overflow.
    lanes = 1
    while lanes < samples and lanes * lane.itemsize < 8:
        lanes *= 2
    word = np.dtype(f"<u{lanes * lane.itemsize}")
    planes = []
    for n in range(0, samples, lanes):
        counted = _summed(rows, range(n, min(n + lanes, samples)), 8 * lane.itemsize, width, height, word)
        # Counts of 0 and 1, one byte each, are already booleans.
        lanes_covered = counted.view(np.bool_) if max_count <= 1 else counted.view(lane.newbyteorder("<")) != 0
        planes.append(lanes_covered.reshape(height, width, lanes))
    if len(planes) == 1:
        return np.ascontiguousarray(planes[0][..., :samples])
    joined = np.empty((height, width, len(planes) * lanes), dtype=np.bool_)
    for n, plane in enumerate(planes):
        joined.view(f"u{lanes}")[..., n] = plane.view(f"u{lanes}")[..., 0]
    return np.ascontiguousarray(joined[..., :samples])


def hits(rows: Rows, width: int, height: int) -> NDArray[np.int64]:
    """The number of covered samples of every pixel, each counted once per triangle: (height, width)."""
    return _summed(rows, range(rows.left.shape[1]), 0, width, height, np.dtype(np.int64))


def _summed(rows: Rows, which: range, shift: int, width: int, height: int, word: np.dtype[Any]) -> NDArray[Any]:
    """The sum in every pixel of the spans of samples, where the n-th of `which` adds 2^(n * shift)."""
    # A span that ends at the end of a row ends where the next row begins: the running sum covers all rows, and is 0 between them.
    steps = np.zeros(height * width + 1, dtype=word)
    start = rows.row.astype(np.int64) * width
    for n, sample in enumerate(which):
        one = word.type(1 << n * shift)
        np.add.at(steps, start + rows.left[:, sample], one)
        np.subtract.at(steps, start + rows.right[:, sample], one)
    np.cumsum(steps, dtype=word, out=steps)
    return steps[:-1].reshape(height, width)


def _check_samples(rows: Rows, samples: int) -> None:
    if rows.left.shape[1] != samples:
        raise ValueError(f"expected spans of {samples} samples, found {rows.left.shape[1]}")
