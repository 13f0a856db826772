"""The samples that triangles cover, exactly: the spans of covered columns in each row, in integer
arithmetic.
"""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .locations import SUBPIXELS

MAX_DISTANCE = 2**60
"""Maximum distance of a corner from the origin, in steps."""

MAX_SUM = 9.2e18
"""Sums whose terms stay below this fit int64, with a margin for the rounding of the bound
itself.
"""

CHUNK = 1 << 14
"""Rows solved at a time, so that the working set stays in the cache."""


class Rows(NamedTuple):
    """The spans of triangles: `triangle` and `row` (R,), `left` and `right` (R, samples), all
    int32.

    In row `row`, triangle `triangle` covers sample n of the columns from `left[:, n]` up to but not
    including `right[:, n]`; both are 0 where it covers none. Spans are clipped to the picture,
    without empty rows, ordered by triangle and then from the top.
    """

    triangle: NDArray[np.int32]
    row: NDArray[np.int32]
    left: NDArray[np.int32]
    right: NDArray[np.int32]


def rows(
    triangles: NDArray[np.int64],
    width: int,
    height: int,
    locations: NDArray[np.int64],
    subpixels: int = SUBPIXELS,
    limits: NDArray[np.int64] | None = None,
) -> Rows:
    """The spans that triangles (T, 3, 2) cover in a picture of `width` x `height` pixels with
    samples at `locations` (N, 2) of each pixel.

    Corners and locations are integers in units of 1/subpixels pixel. A sample on an edge follows
    the top-left rule: it is covered on a left edge and on a horizontal top edge, and not on others,
    whatever the winding. Triangles without area cover nothing. `limits` (T, 2), where given, are
    the first row and the end of the rows in which each triangle is drawn. The result is exact for
    corners up to 2^60 steps from the origin, in int64 where all terms fit it and in Python's
    integers otherwise. ValueError for corners farther away or not integers, and for locations
    outside the pixel.
    """
    corners, sample_places = _checked(triangles, locations, subpixels)
    x, y = corners[..., 0], corners[..., 1]
    if limits is None:
        limits = np.broadcast_to((0, height), (len(corners), 2))
    inside = (
        (x.max(axis=1) > 0)
        & (x.min(axis=1) < subpixels * width)
        & (y.max(axis=1) > 0)
        & (y.min(axis=1) < subpixels * height)
    )
    fits_int64 = _fits(corners, subpixels, width, height)
    parts: list[Rows] = []
    for selected, arithmetic in ((fits_int64, np.int64), (~fits_int64, object)):
        indices = np.flatnonzero(inside & selected)
        if len(indices):
            parts += _spans(
                corners[indices],
                indices,
                sample_places,
                width,
                limits[indices],
                subpixels,
                arithmetic,
            )
    if len(parts) == 1:
        return parts[0]
    if not parts:
        return Rows(*np.zeros((2, 0), np.int32), *np.zeros((2, 0, len(sample_places)), np.int32))
    joined = Rows(*(np.concatenate(column) for column in zip(*parts, strict=True)))
    order = np.argsort(joined.triangle, kind="stable")
    return Rows(*(column[order] for column in joined)) if not fits_int64.all() else joined


def _spans(
    corners: NDArray[np.int64],
    indices: NDArray[np.int64],
    places: NDArray[np.int64],
    width: int,
    limits: NDArray[np.int64],
    subpixels: int,
    number: type,
) -> list[Rows]:
    """The spans of triangles, in chunks, in arithmetic of type `number`: int64, or Python's
    integers as objects.

    A triangle is split at the height of its middle corner. Each half lies between the edge from the
    top corner to the bottom corner and one of the other two edges; it includes its top and excludes
    its bottom.
    """
    order = np.argsort(corners[..., 1], axis=1)
    triangles = np.arange(len(corners))[:, None]
    x, y = corners[triangles, order, 0], corners[triangles, order, 1]
    # A row has samples at or below a height if its lowest sample does, and samples above it if its
    # highest does.
    first_row, end_row = limits[:, :1], limits[:, 1:]
    first = np.clip(-((int(places[:, 1].max()) - y[:, :2]) // subpixels), first_row, end_row)
    count = (
        np.clip(-((int(places[:, 1].min()) - y[:, 1:]) // subpixels), first_row, end_row) - first
    )
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
        # Keep both halves of a triangle together.
        end += int(end < len(ends) and triangle[end] == triangle[end - 1])
        part, number_of = slice(begin, end), count[begin:end]
        row = np.repeat(
            first[part] - ends[part] + number_of + ends[begin] - count[begin], number_of
        )
        row += np.arange(len(row))
        start: NDArray[Any] = row.astype(number) * subpixels
        low = start + places[:, 1:]
        outside = np.logical_or(
            low < np.repeat(top[part], number_of), low >= np.repeat(bottom[part], number_of)
        )
        one, other = (_column(edge, part, number_of, start, width) for edge in (long, short))
        triangle_index = np.repeat(indices[triangle[part]], number_of)
        parts.append(
            _joined(triangle_index, row, np.minimum(one, other), np.maximum(one, other), outside)
        )
        begin = end
    return parts


class _Edge(NamedTuple):
    """The terms for solving edges: `base`, `run` and `below` (P,), `offset` (N, P).

    An edge that goes down from (x0, y0) is at x0 + (Y - y0) * run / rise at height Y. Sample (sx,
    sy) of a column in row r is on or right of it from column ceil(((x0 - sx) * rise + (r *
    subpixels + sy - y0) * run) / (subpixels * rise)) on.
    """

    base: NDArray[Any]
    run: NDArray[Any]
    offset: NDArray[Any]
    below: NDArray[Any]


def _edge(
    x0: NDArray[Any],
    y0: NDArray[Any],
    x1: NDArray[Any],
    y1: NDArray[Any],
    places: NDArray[Any],
    subpixels: int,
) -> _Edge:
    """Edges from (x0, y0) down to (x1, y1), which is lower."""
    run, rise = x1 - x0, y1 - y0
    return _Edge(
        x0 * rise - y0 * run, run, places[:, 1:] * run - places[:, :1] * rise, rise * subpixels
    )


def _column(
    edge: _Edge, part: slice, counts: NDArray[np.int64], start: NDArray[Any], width: int
) -> NDArray[Any]:
    """The first columns, 0 to width, whose samples are on or right of the edges of a part: (N, R),
    with `counts` rows of each edge.

    `start` is the height of the top of each row.
    """
    above = np.repeat(edge.offset[:, part], counts, axis=1)
    above += np.repeat(edge.base[part], counts) + start * np.repeat(edge.run[part], counts)
    below = np.repeat(edge.below[part], counts)
    if above.dtype == object:
        return _clipped(-(-above // below), width)
    # The quotient in double precision gives the column or a neighbor of it, and the remainder tells
    # which. It takes a third of the time of an int64 division.
    guess = above / below
    column: NDArray[np.int64] = np.ceil(
        np.clip(guess, 0.0, float(width), out=guess), out=guess
    ).astype(np.int64)
    above -= column * below
    column += above > 0
    column -= above <= -below
    return _clipped(column, width)


def _clipped(numbers: NDArray[Any], limit: int) -> NDArray[Any]:
    """Integers clamped to 0 to `limit`, in place: np.clip takes longer than the arithmetic."""
    clamped: NDArray[Any] = np.minimum(np.maximum(numbers, 0, out=numbers), limit, out=numbers)
    return clamped


def _joined(
    triangle: NDArray[np.int64],
    row: NDArray[np.int64],
    left: NDArray[Any],
    right: NDArray[Any],
    outside: NDArray[np.bool_],
) -> Rows:
    """Rows of the spans (N, R) of halves: where both halves of a triangle have samples in a row,
    the row is merged.
    """
    empty = np.logical_or(outside, left >= right)
    left[empty] = 0
    right[empty] = 0
    used = np.asarray(~empty.all(axis=0))
    duplicates = np.flatnonzero((triangle[1:] == triangle[:-1]) & (row[1:] == row[:-1]))
    if len(duplicates):
        left[:, duplicates] += left[:, duplicates + 1]
        right[:, duplicates] += right[:, duplicates + 1]
        used[duplicates] |= used[duplicates + 1]
        used[duplicates + 1] = False
    if not used.all():
        triangle, row, left, right = triangle[used], row[used], left[:, used], right[:, used]
    return Rows(
        *(np.ascontiguousarray(column.T, dtype=np.int32) for column in (triangle, row, left, right))
    )


def _fits(corners: NDArray[np.int64], subpixels: int, width: int, height: int) -> NDArray[np.bool_]:
    """For each triangle whether all sums of its edges fit int64, judging by the sum of the
    magnitudes of their terms.
    """
    extents = np.ptp(corners, axis=1).astype(np.float64)
    distance = np.abs(corners).max(axis=1).astype(np.float64)
    margin = float(subpixels) * np.array((width + 3, height + 1))
    terms = extents[:, 1] * (distance[:, 0] + 2 * margin[0]) + extents[:, 0] * (
        distance[:, 1] + margin[1]
    )
    fits: NDArray[np.bool_] = terms < MAX_SUM
    return fits


def _checked(
    triangles: NDArray[np.int64], locations: NDArray[np.int64], subpixels: int
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Triangles and locations as int64 arrays of the right shape."""
    corners, places = np.asarray(triangles), np.asarray(locations)
    if corners.dtype.kind not in "iu" or places.dtype.kind not in "iu":
        raise ValueError("corners and sample locations must be integers: snap them first")
    if (
        corners.ndim != 3
        or corners.shape[1:] != (3, 2)
        or places.ndim != 2
        or places.shape[1] != 2
        or not len(places)
    ):
        raise ValueError(
            f"expected triangles (T, 3, 2) and sample locations (N, 2), found {corners.shape} and "
            f"{places.shape}"
        )
    if places.min() < 0 or places.max() >= subpixels:
        raise ValueError(
            f"a sample location lies outside its pixel, which goes from 0 up to {subpixels}"
        )
    if corners.size and (corners.max() > MAX_DISTANCE or corners.min() < -MAX_DISTANCE):
        raise ValueError("a corner is farther than 2^60 steps from the origin")
    return corners.astype(np.int64), places.astype(np.int64)
