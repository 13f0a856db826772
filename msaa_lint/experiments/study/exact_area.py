"""The exact picture of coverage: the area of a polygon within every pixel, in closed form by its
edges.

Each pixel contains part of the area to the right of an edge, over the heights that the edge spans.
With the sign of the edge's direction, the parts of all edges of a polygon add up to its area in the
pixel (the divergence theorem: Catmull 1978, Duff 1989).
"""

from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

ACCURACY = 1e-12
"""Maximum error of areas. Values this close to an integer are rounded to it, so that pixels that no
edge crosses are exactly 0 or 1.
"""

CHUNK = 1 << 18
"""Crossed pixels computed at a time."""

BAND = 32
"""Rows summed at a time."""

Floats = NDArray[np.float64]


def areas(polygon_px: Floats, width: int, height: int) -> Floats:
    """The area of a simple polygon (V, 2), in pixels, within every pixel of a picture: (height,
    width), 0 to 1, whatever the winding.

    Within ACCURACY for corners up to 2^23 pixels away that lie on the grid of 1/256 pixel, and for
    others up to 2^10 pixels. ValueError for corners that are not finite.
    """
    corners = np.asarray(polygon_px, dtype=np.float64)
    if corners.ndim != 2 or corners.shape[1] != 2:
        raise ValueError(f"expected a polygon (V, 2), found {corners.shape}")
    turns = np.full(len(corners), _turn(corners[None])[0])
    return _within(
        corners,
        np.roll(corners, -1, axis=0),
        turns,
        (0, 0, width, height),
        np.broadcast_to((0, height), (len(corners), 2)),
    )


def areas_of(
    triangles_px: Floats,
    width: int,
    height: int,
    origin: tuple[int, int] = (0, 0),
    rows: NDArray[np.int64] | None = None,
) -> Floats:
    """The total area of disjoint triangles (T, 3, 2) within every pixel of a window whose left
    column and top row are `origin`: (height, width). Overlaps count twice. `rows` (T, 2) are the
    first row and the end of the rows in which each triangle counts.

    An edge that two triangles share is not an edge of their union: pixels that only such edges
    cross are exactly 1. As accurate as areas().
    """
    corners = np.asarray(triangles_px, dtype=np.float64)
    if corners.ndim != 3 or corners.shape[1:] != (3, 2):
        raise ValueError(f"expected triangles (T, 3, 2), found {corners.shape}")
    begins, ends = corners.reshape(-1, 2), np.roll(corners, -1, axis=1).reshape(-1, 2)
    left, top = origin
    limits = np.broadcast_to((top, top + height), (len(corners), 2)) if rows is None else rows
    return _within(
        begins,
        ends,
        np.repeat(_turn(corners), 3),
        (left, top, width, height),
        np.repeat(limits, 3, axis=0),
    )


def _turn(polygons: Floats) -> Floats:
    """The winding of each polygon (P, V, 2): 1 clockwise on the screen, -1 counterclockwise, 0
    without area.
    """
    if not bool(np.isfinite(polygons).all()):
        raise ValueError("a corner is not finite")
    relative = polygons - polygons[:, :1]
    x, y = relative[..., 0], relative[..., 1]
    turns: Floats = np.sign((x * np.roll(y, -1, axis=1) - np.roll(x, -1, axis=1) * y).sum(axis=1))
    return turns


class _Edges(NamedTuple):
    """Edges that go down from (x0, y0) to (x1, y1), (E,) each; the area to the right of an edge
    counts with `sign`, 1 or -1, from row `first` up to but not including row `end`.
    """

    x0: Floats
    y0: Floats
    x1: Floats
    y1: Floats
    first: Floats
    end: Floats
    sign: Floats


def _within(
    begins: Floats,
    ends: Floats,
    turns: Floats,
    window: tuple[int, int, int, int],
    rows: NDArray[np.int64],
) -> Floats:
    """The sum in every pixel of a window (left, top, width, height) of the areas to the right of
    edges, signed by the winding of the polygons that they belong to.
    """
    first_column, first_row, width, height = window
    picture = np.zeros((height, width))
    edges = _merged(begins, ends, turns, rows)
    if not len(edges.sign):
        return picture
    top, bottom = (
        min(max(int(limit), first_row), first_row + height)
        for limit in (np.floor(edges.y0.min()), np.ceil(edges.y1.max()))
    )
    left, right = (
        min(max(int(limit), first_column), first_column + width)
        for limit in (
            np.floor(min(edges.x0.min(), edges.x1.min())),
            np.ceil(max(edges.x0.max(), edges.x1.max())),
        )
    )
    if top >= bottom or left >= right:
        return picture
    covered = picture[
        top - first_row : bottom - first_row, left - first_column : right - first_column
    ]
    whole, partly = _summed(edges, top, bottom, left, right)
    for band in (slice(row, row + BAND) for row in range(0, bottom - top, BAND)):
        row_sums = np.cumsum(whole[band], axis=1)[:, :-1]
        row_sums += partly[band]
        nearest = np.rint(row_sums)
        covered[band] = np.where(np.abs(row_sums - nearest) < ACCURACY, nearest + 0.0, row_sums)
    return picture


def _merged(begins: Floats, ends: Floats, turns: Floats, rows: NDArray[np.int64]) -> _Edges:
    """The edges, each pair of corners once with its total sign. Edges whose signs cancel out are
    omitted.
    """
    down = ends[:, 1] > begins[:, 1]
    upper, lower = np.where(down[:, None], begins, ends), np.where(down[:, None], ends, begins)
    # A polygon that is clockwise on the screen has its area left of an edge that goes down.
    sign = np.where(down, -turns, turns)
    corners = np.concatenate((upper, lower, rows), axis=1) + 0.0
    counted = (corners[:, 1] < corners[:, 3]) & (sign != 0)
    corners, sign = corners[counted], sign[counted]
    if not len(sign):
        return _Edges(sign, sign, sign, sign, sign, sign, sign)
    order = np.lexsort(corners.T)
    corners, sign = corners[order], sign[order]
    starts = np.flatnonzero(np.concatenate(([True], (corners[1:] != corners[:-1]).any(axis=1))))
    total = np.add.reduceat(sign, starts)
    x0, y0, x1, y1, first, end = corners[starts[total != 0]].T
    return _Edges(x0, y0, x1, y1, first, end, total[total != 0])


def _summed(edges: _Edges, top: int, bottom: int, left: int, right: int) -> tuple[Floats, Floats]:
    """The areas to the right of edges in rows `top` to `bottom` and columns `left` to `right`:
    those that count from a column on, and those that count in one column alone.
    """
    rows, columns = bottom - top, right - left
    highest, lowest = np.clip(edges.first, top, bottom), np.clip(edges.end, top, bottom)
    first = np.clip(np.floor(edges.y0), highest, lowest).astype(np.int64)
    count = np.maximum(np.clip(np.ceil(edges.y1), highest, lowest).astype(np.int64) - first, 0)
    partly, whole = np.zeros(rows * columns), np.zeros((rows, columns + 1))
    # The pieces of edges within one row each.
    edge = np.repeat(np.arange(len(count)), count)
    row = np.arange(len(edge)) - np.repeat(np.cumsum(count) - count - first, count)
    high, low = np.maximum(edges.y0[edge], row), np.minimum(edges.y1[edge], row + 1.0)
    rise = (low - high) * edges.sign[edge]
    crossings = np.stack((_across(edges, edge, high), _across(edges, edge, low)))
    first_x, last_x = crossings.min(axis=0), crossings.max(axis=0)
    begin = np.clip(np.floor(first_x), left, right).astype(np.int64) - left
    end = np.clip(np.ceil(last_x), left, right).astype(np.int64) - left
    row -= top
    # Pixels to the right of a piece have its whole height; those that it crosses have part of it.
    np.add.at(whole.reshape(-1), row * (columns + 1) + end, rise)
    crossed = end - begin
    for chunk in _split(crossed):
        numbers = crossed[chunk]
        column = np.arange(int(numbers.sum())) - np.repeat(
            np.cumsum(numbers) - numbers - begin[chunk], numbers
        )
        a, b, height = (np.repeat(each[chunk], numbers) for each in (first_x, last_x, rise))
        np.add.at(
            partly,
            np.repeat(row[chunk] * columns, numbers) + column,
            height * _share(a, b, column + float(left)),
        )
    return whole, partly.reshape(rows, columns)


def _split(counts: NDArray[np.int64]) -> list[slice]:
    """Slices whose counts each sum to about CHUNK."""
    total = np.cumsum(counts)
    cuts = [
        0,
        *np.searchsorted(
            total, np.arange(CHUNK, int(total[-1]) if len(total) else 0, CHUNK)
        ).tolist(),
        len(counts),
    ]
    return [slice(start, end) for start, end in pairwise(cuts) if start < end]


def _share(a: Floats, b: Floats, column: Floats) -> Floats:
    """The share of the pixels in a column that lies to the right of a line from `a` to `b`, a <= b,
    over the pixel's height: 0 to 1.

    The part of the line left of the column leaves the whole pixel to its right; the part within the
    column leaves what is right of its midpoint.
    """
    length = b - a
    within_a, within_b = np.clip(a, column, column + 1), np.clip(b, column, column + 1)
    upright = length == 0
    length = np.where(upright, 1.0, length)
    inside = np.where(upright, 1.0, (within_b - within_a) / length)
    left_share = np.where(upright, 0.0, np.maximum(within_a - a, 0.0) / length)
    return left_share + inside * ((column + 1 - within_a) + (column + 1 - within_b)) / 2


def _across(edges: _Edges, edge: NDArray[np.int64], y: Floats) -> Floats:
    """The x of the edges `edge` at heights y within them. Products and quotients carry their
    rounding errors along, so that an edge from far outside the picture is as accurate within it as
    a near one.
    """
    x0, y0, x1, y1 = edges.x0[edge], edges.y0[edge], edges.x1[edge], edges.y1[edge]
    height, run, rise = y - y0, x1 - x0, y1 - y0
    product, product_low = _product(height, run)
    quotient = product / rise
    back_product, back_product_low = _product(quotient, rise)
    remainder = ((product - back_product) - back_product_low + product_low) / rise
    total = x0 + quotient
    difference = total - x0
    lost = (x0 - (total - difference)) + (quotient - difference)
    x: Floats = np.where(y == y1, x1, total + (lost + remainder))
    return x


def _product(a: Floats, b: Floats) -> tuple[Floats, Floats]:
    """A product and its rounding error (Dekker 1971)."""
    product = a * b
    (a_high, a_low), (b_high, b_low) = _halves(a), _halves(b)
    return product, a_low * b_low - (
        ((product - a_high * b_high) - a_low * b_high) - a_high * b_low
    )


def _halves(a: Floats) -> tuple[Floats, Any]:
    """A number as the sum of two with half the digits each (Veltkamp)."""
    scaled = a * 134217729.0
    high = scaled - (scaled - a)
    return high, a - high
