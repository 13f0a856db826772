"""From spans to samples: the fragments of triangles with their sample masks, and the samples of a picture that are covered."""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .coverage import Rows

MOST = 16
"""Samples that a mask holds."""


class Fragments(NamedTuple):
    """A fragment for each pixel of each triangle with a covered sample: `triangle`, `y`, `x` (F,) int32, `mask` (F,) uint16.

    Bit n of a mask: sample n is covered. In the order of triangles, rows from the top, columns from the left.
    """

    triangle: NDArray[np.int32]
    y: NDArray[np.int32]
    x: NDArray[np.int32]
    mask: NDArray[np.uint16]


def fragments(rows: Rows, samples: int) -> Fragments:
    """The fragments of spans. ValueError for more than 16 samples, and where the spans are of another count."""
    _same(rows, samples)
    if samples > MOST:
        raise ValueError(f"a mask holds {MOST} samples, not {samples}")
    covers = rows.left < rows.right
    low = np.where(covers, rows.left, np.iinfo(np.int32).max).min(axis=1, initial=np.iinfo(np.int32).max)
    widths = rows.right.max(axis=1, initial=0) - low
    ends = np.cumsum(widths, dtype=np.int64)
    total = int(ends[-1]) if len(ends) else 0
    shift = ends - widths - low

    # Within a row a sample has one span: adding its bit where that begins and taking it away where it ends never carries.
    steps = np.zeros(total + 1, dtype=np.uint16)
    for n in range(samples):
        own = covers[:, n]
        np.add.at(steps, (rows.left[:, n] + shift)[own], np.uint16(1 << n))
        np.subtract.at(steps, (rows.right[:, n] + shift)[own], np.uint16(1 << n))
    mask = np.cumsum(steps[:total], dtype=np.uint16)
    found = Fragments(
        np.repeat(rows.triangle, widths),
        np.repeat(rows.row, widths),
        (np.arange(total) - np.repeat(shift, widths)).astype(np.int32),
        mask,
    )
    # The spans of a narrow triangle's samples may leave a gap between them.
    full = mask != 0
    return found if bool(full.all()) else Fragments(found.triangle[full], found.y[full], found.x[full], mask[full])


def masks(rows: Rows, width: int, height: int, samples: int) -> NDArray[np.bool_]:
    """The samples of the picture that any triangle covers: (height, width, samples)."""
    _same(rows, samples)
    most = int(np.bincount(rows.row, minlength=1).max())
    lane = np.dtype(np.uint8) if most < 1 << 8 else np.dtype(np.uint16) if most < 1 << 16 else np.dtype(np.uint32)
    # Several samples are counted in one word, each in a lane that as many triangles as a row has cannot overflow.
    lanes = 1
    while lanes < samples and lanes * lane.itemsize < 8:
        lanes *= 2
    word = np.dtype(f"<u{lanes * lane.itemsize}")
    planes = []
    for n in range(0, samples, lanes):
        counted = _summed(rows, range(n, min(n + lanes, samples)), 8 * lane.itemsize, width, height, word)
        # Counts of 0 and 1, a byte each, are truth values as they are.
        each = counted.view(np.bool_) if most <= 1 else counted.view(lane.newbyteorder("<")) != 0
        planes.append(each.reshape(height, width, lanes))
    if len(planes) == 1:
        return np.ascontiguousarray(planes[0][..., :samples])
    found = np.empty((height, width, len(planes) * lanes), dtype=np.bool_)
    for n, plane in enumerate(planes):
        found.view(f"u{lanes}")[..., n] = plane.view(f"u{lanes}")[..., 0]
    return np.ascontiguousarray(found[..., :samples])


def hits(rows: Rows, width: int, height: int) -> NDArray[np.int64]:
    """How many samples of every pixel are covered, once for each triangle that covers them: (height, width)."""
    return _summed(rows, range(rows.left.shape[1]), 0, width, height, np.dtype(np.int64))


def _summed(rows: Rows, which: range, shift: int, width: int, height: int, word: np.dtype[Any]) -> NDArray[Any]:
    """What the spans of samples add up to in every pixel, where the n-th of `which` adds 2^(n * shift)."""
    # A span that ends with the picture's row ends where the next row begins: the sum goes on over all rows, and is 0 between them.
    steps = np.zeros(height * width + 1, dtype=word)
    start = rows.row.astype(np.int64) * width
    for n, sample in enumerate(which):
        one = word.type(1 << n * shift)
        np.add.at(steps, start + rows.left[:, sample], one)
        np.subtract.at(steps, start + rows.right[:, sample], one)
    np.cumsum(steps, dtype=word, out=steps)
    return steps[:-1].reshape(height, width)


def _same(rows: Rows, samples: int) -> None:
    if rows.left.shape[1] != samples:
        raise ValueError(f"the spans are of {rows.left.shape[1]} samples, not of {samples}")
