"""Which samples a triangle covers, exactly: the spans of columns that are covered in each row, by whole numbers alone."""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .locations import SUBPIXELS

LIMIT = 2**60
"""Steps from the origin that a corner may have."""

EXACT = 9.2e18
"""Sums whose terms stay below this cannot leave int64, with room for how the bound itself is rounded."""

CHUNK = 1 << 14
"""Rows solved at a time, so that what is in work stays in the cache."""


class Rows(NamedTuple):
    """The spans of triangles: `triangle` and `row` (R,), `left` and `right` (R, samples), all int32.

    In row `row` triangle `triangle` covers sample n of the columns from `left[:, n]` up to, not including, `right[:, n]`; both are 0 where
    it covers none. Clipped to the picture, without rows that have no coverage, by triangle and then from the top.
    """

    triangle: NDArray[np.int32]
    row: NDArray[np.int32]
    left: NDArray[np.int32]
    right: NDArray[np.int32]


def rows(triangles: NDArray[np.int64], width: int, height: int, locations: NDArray[np.int64], subpixels: int = SUBPIXELS) -> Rows:
    """The spans that triangles (T, 3, 2) cover in a picture of `width` x `height` pixels with samples at `locations` (N, 2) of each.

    Corners and locations are whole numbers of 1/subpixels pixel. A sample on an edge is covered by the top-left rule: on a left edge or
    on a horizontal edge along the top it is, on others it is not, whatever the winding. Triangles without area cover nothing. The
    answer is exact for corners up to 2^60 steps from the origin: in int64 where no term can leave it, in Python's integers beyond.
    ValueError for corners farther away or no integers, and for locations outside of the pixel.
    """
    corners, places = _checked(triangles, locations, subpixels)
    x, y = corners[..., 0], corners[..., 1]
    inside = (x.max(axis=1) > 0) & (x.min(axis=1) < subpixels * width) & (y.max(axis=1) > 0) & (y.min(axis=1) < subpixels * height)
    fits = _fits(corners, subpixels, width, height)
    parts: list[Rows] = []
    for chosen, number in ((fits, np.int64), (~fits, object)):
        names = np.flatnonzero(inside & chosen)
        if len(names):
            parts += _spans(corners[names], names, places, width, height, subpixels, number)
    if len(parts) == 1:
        return parts[0]
    if not parts:
        return Rows(*np.zeros((2, 0), np.int32), *np.zeros((2, 0, len(places)), np.int32))
    found = Rows(*(np.concatenate(column) for column in zip(*parts, strict=True)))
    order = np.argsort(found.triangle, kind="stable")
    return Rows(*(column[order] for column in found)) if not fits.all() else found


def _spans(
    corners: NDArray[np.int64], names: NDArray[np.int64], places: NDArray[np.int64], width: int, height: int, subpixels: int, number: type
) -> list[Rows]:
    """The spans of triangles, some at a time, in arithmetic of type `number`: int64, or Python's integers as objects.

    A triangle is cut at the height of its middle corner. Each half lies between the edge from the topmost corner to the lowest and one
    of the other two; it has its own top and not its bottom.
    """
    order = np.argsort(corners[..., 1], axis=1)
    which = np.arange(len(corners))[:, None]
    x, y = corners[which, order, 0], corners[which, order, 1]
    # A row has samples at or below a height where its lowest sample is, and samples above it where its highest is.
    first = _clipped(-((int(places[:, 1].max()) - y[:, :2]) // subpixels), height)
    count = _clipped(-((int(places[:, 1].min()) - y[:, 1:]) // subpixels), height) - first
    triangle, half = np.nonzero((count > 0) & (y[:, :2] < y[:, 1:]))
    first, count = first[triangle, half], count[triangle, half]

    x, y, places = x.astype(number), y.astype(number), places.astype(number)
    top, bottom = y[triangle, half], y[triangle, half + 1]
    long = _edge(x[triangle, 0], y[triangle, 0], x[triangle, 2], y[triangle, 2], places, subpixels)
    short = _edge(x[triangle, half], top, x[triangle, half + 1], bottom, places, subpixels)

    ends = np.cumsum(count)
    parts = []
    begin = 0
    while begin < len(ends):
        end = max(int(np.searchsorted(ends, ends[begin] + CHUNK)), begin + 1)
        # Both halves of a triangle stay together.
        end += int(end < len(ends) and triangle[end] == triangle[end - 1])
        part, number_of = slice(begin, end), count[begin:end]
        row = np.repeat(first[part] - ends[part] + number_of + ends[begin] - count[begin], number_of)
        row += np.arange(len(row))
        start: NDArray[Any] = row.astype(number) * subpixels
        low = start + places[:, 1:]
        outside = np.logical_or(low < np.repeat(top[part], number_of), low >= np.repeat(bottom[part], number_of))
        one, other = (_column(edge, part, number_of, start, width) for edge in (long, short))
        own = np.repeat(names[triangle[part]], number_of)
        parts.append(_joined(own, row, np.minimum(one, other), np.maximum(one, other), outside))
        begin = end
    return parts


class _Edge(NamedTuple):
    """What is needed to solve edges: `base`, `run` and `below` (P,), `offset` (N, P).

    An edge that goes down from (x0, y0) is at x0 + (Y - y0) * run / rise at the height Y. Sample (sx, sy) of a column in row r is at or
    right of it from column ceil(((x0 - sx) * rise + (r * subpixels + sy - y0) * run) / (subpixels * rise)) on.
    """

    base: NDArray[Any]
    run: NDArray[Any]
    offset: NDArray[Any]
    below: NDArray[Any]


def _edge(x0: NDArray[Any], y0: NDArray[Any], x1: NDArray[Any], y1: NDArray[Any], places: NDArray[Any], subpixels: int) -> _Edge:
    """Edges from (x0, y0) down to (x1, y1), which is lower."""
    run, rise = x1 - x0, y1 - y0
    return _Edge(x0 * rise - y0 * run, run, places[:, 1:] * run - places[:, :1] * rise, rise * subpixels)


def _column(edge: _Edge, part: slice, counts: NDArray[np.int64], start: NDArray[Any], width: int) -> NDArray[Any]:
    """The first columns, 0 to width, whose samples are at or right of the edges of a part: (N, R), with `counts` rows of each edge.

    `start` is the height at which each row begins.
    """
    above = np.repeat(edge.offset[:, part], counts, axis=1)
    above += np.repeat(edge.base[part], counts) + start * np.repeat(edge.run[part], counts)
    below = np.repeat(edge.below[part], counts)
    if above.dtype == object:
        return _clipped(-(-above // below), width)
    # The quotient in double precision gives the column sought or a neighbour of it, wherever that lies in the picture: which, the
    # remainder tells. It takes a third of the time that a division of int64 does.
    guess = above / below
    found: NDArray[np.int64] = np.ceil(np.clip(guess, 0.0, float(width), out=guess), out=guess).astype(np.int64)
    above -= found * below
    found += above > 0
    found -= above <= -below
    return _clipped(found, width)


def _clipped(numbers: NDArray[Any], most: int) -> NDArray[Any]:
    """Whole numbers brought to 0 to `most`, in their place: np.clip takes longer than the arithmetic does."""
    found: NDArray[Any] = np.minimum(np.maximum(numbers, 0, out=numbers), most, out=numbers)
    return found


def _joined(
    triangle: NDArray[np.int64], row: NDArray[np.int64], left: NDArray[Any], right: NDArray[Any], outside: NDArray[np.bool_]
) -> Rows:
    """Rows of the spans (N, R) of halves: where both halves of a triangle have samples in a row, they are of one row."""
    nothing = np.logical_or(outside, left >= right)
    left[nothing] = 0
    right[nothing] = 0
    kept = np.asarray(~nothing.all(axis=0))
    again = np.flatnonzero((triangle[1:] == triangle[:-1]) & (row[1:] == row[:-1]))
    if len(again):
        left[:, again] += left[:, again + 1]
        right[:, again] += right[:, again + 1]
        kept[again] |= kept[again + 1]
        kept[again + 1] = False
    if not kept.all():
        triangle, row, left, right = triangle[kept], row[kept], left[:, kept], right[:, kept]
    return Rows(*(np.ascontiguousarray(column.T, dtype=np.int32) for column in (triangle, row, left, right)))


def _fits(corners: NDArray[np.int64], subpixels: int, width: int, height: int) -> NDArray[np.bool_]:
    """Whether every sum made of a triangle's edges stays in int64, by the sum of the sizes of its terms."""
    sides = np.ptp(corners, axis=1).astype(np.float64)
    far = np.abs(corners).max(axis=1).astype(np.float64)
    room = float(subpixels) * np.array((width + 3, height + 1))
    terms = sides[:, 1] * (far[:, 0] + 2 * room[0]) + sides[:, 0] * (far[:, 1] + room[1])
    fits: NDArray[np.bool_] = terms < EXACT
    return fits


def _checked(triangles: NDArray[np.int64], locations: NDArray[np.int64], subpixels: int) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Triangles and locations as int64 arrays of the right shape."""
    corners, places = np.asarray(triangles), np.asarray(locations)
    if corners.dtype.kind not in "iu" or places.dtype.kind not in "iu":
        raise ValueError("corners and sample locations are whole numbers of steps: snap them first")
    if corners.ndim != 3 or corners.shape[1:] != (3, 2) or places.ndim != 2 or places.shape[1] != 2 or not len(places):
        raise ValueError(f"triangles are (T, 3, 2) and sample locations (N, 2), not {corners.shape} and {places.shape}")
    if places.min() < 0 or places.max() >= subpixels:
        raise ValueError(f"a sample location lies outside of its pixel, which is 0 up to {subpixels}")
    if corners.size and (corners.max() > LIMIT or corners.min() < -LIMIT):
        raise ValueError("a corner is farther than 2^60 steps from the origin")
    return corners.astype(np.int64), places.astype(np.int64)
