"""The exact picture of coverage: the area of a polygon within every pixel, in closed form by its edges.

Right of an edge, over the heights that it spans, lies an area that each pixel has a part of; with the edge's sign, downwards or upwards,
the parts of all edges of a polygon add up to its area in the pixel (the divergence theorem: Catmull 1978, Duff 1989).
"""

from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

ACCURACY = 1e-12
"""Areas are within this of the true ones. What is as near to a whole number is that number: pixels that no edge crosses are 0 or 1."""

CHUNK = 1 << 18
"""Pixels crossed that are worked out at a time."""

BAND = 32
"""Rows added up at a time."""

Floats = NDArray[np.float64]


def areas(polygon_px: Floats, width: int, height: int) -> Floats:
    """The area of a simple polygon (V, 2), in pixels, within every pixel of a picture: (height, width), 0 to 1, whatever the winding.

    Within ACCURACY for corners up to 2^23 pixels away that lie on the grid of 1/256 pixel, and for others up to 2^10 pixels.
    ValueError for corners that are no finite numbers.
    """
    corners = np.asarray(polygon_px, dtype=np.float64)
    if corners.ndim != 2 or corners.shape[1] != 2:
        raise ValueError(f"a polygon is (V, 2), not {corners.shape}")
    return _within(corners, np.roll(corners, -1, axis=0), np.full(len(corners), _turn(corners[None])[0]), width, height)


def areas_of(triangles_px: Floats, width: int, height: int) -> Floats:
    """The areas of disjoint triangles (T, 3, 2) within every pixel, together: (height, width). Where they overlap, it counts twice.

    An edge that two of them share is no edge of their union: pixels that only such edges cross are 1 exactly. As accurate as areas().
    """
    corners = np.asarray(triangles_px, dtype=np.float64)
    if corners.ndim != 3 or corners.shape[1:] != (3, 2):
        raise ValueError(f"triangles are (T, 3, 2), not {corners.shape}")
    begins, ends = corners.reshape(-1, 2), np.roll(corners, -1, axis=1).reshape(-1, 2)
    return _within(begins, ends, np.repeat(_turn(corners), 3), width, height)


def _turn(polygons: Floats) -> Floats:
    """The winding of each polygon (P, V, 2): 1 clockwise on the screen, -1 the other way, 0 without an area."""
    if not bool(np.isfinite(polygons).all()):
        raise ValueError("a corner is no finite number")
    own = polygons - polygons[:, :1]
    x, y = own[..., 0], own[..., 1]
    turns: Floats = np.sign((x * np.roll(y, -1, axis=1) - np.roll(x, -1, axis=1) * y).sum(axis=1))
    return turns


class _Edges(NamedTuple):
    """Edges that go down from (x0, y0) to (x1, y1), (E,) each; `sign` is 1 where what is right of one counts, -1 where it counts off."""

    x0: Floats
    y0: Floats
    x1: Floats
    y1: Floats
    sign: Floats


def _within(begins: Floats, ends: Floats, turns: Floats, width: int, height: int) -> Floats:
    """What the areas right of edges, counted by the winding of the polygons that they belong to, add up to in every pixel."""
    picture = np.zeros((height, width))
    edges = _merged(begins, ends, turns)
    if not len(edges.sign):
        return picture
    top, bottom = (min(max(int(each), 0), height) for each in (np.floor(edges.y0.min()), np.ceil(edges.y1.max())))
    left = min(max(int(np.floor(min(edges.x0.min(), edges.x1.min()))), 0), width)
    right = min(max(int(np.ceil(max(edges.x0.max(), edges.x1.max()))), 0), width)
    if top >= bottom or left >= right:
        return picture
    found = picture[top:bottom, left:right]
    whole, partly = _summed(edges, top, bottom, left, right)
    for band in (slice(row, row + BAND) for row in range(0, bottom - top, BAND)):
        own = np.cumsum(whole[band], axis=1)[:, :-1]
        own += partly[band]
        near = np.rint(own)
        found[band] = np.where(np.abs(own - near) < ACCURACY, near + 0.0, own)
    return picture


def _merged(begins: Floats, ends: Floats, turns: Floats) -> _Edges:
    """The edges, each pair of corners once, with what they count together. Those that count for nothing are left out."""
    down = ends[:, 1] > begins[:, 1]
    upper, lower = np.where(down[:, None], begins, ends), np.where(down[:, None], ends, begins)
    # A polygon that is clockwise on the screen has its area left of an edge that goes down.
    sign = np.where(down, -turns, turns)
    corners = np.concatenate((upper, lower), axis=1) + 0.0
    slanted = (corners[:, 1] < corners[:, 3]) & (sign != 0)
    corners, sign = corners[slanted], sign[slanted]
    if not len(sign):
        return _Edges(sign, sign, sign, sign, sign)
    order = np.lexsort(corners.T)
    corners, sign = corners[order], sign[order]
    new = np.flatnonzero(np.concatenate(([True], (corners[1:] != corners[:-1]).any(axis=1))))
    total = np.add.reduceat(sign, new)
    x0, y0, x1, y1 = corners[new[total != 0]].T
    return _Edges(x0, y0, x1, y1, total[total != 0])


def _summed(edges: _Edges, top: int, bottom: int, left: int, right: int) -> tuple[Floats, Floats]:
    """What is right of edges in rows `top` to `bottom`, columns `left` to `right`: what counts from a column on, and what for it alone."""
    rows, columns = bottom - top, right - left
    first = np.clip(np.floor(edges.y0), top, bottom).astype(np.int64)
    count = np.maximum(np.clip(np.ceil(edges.y1), top, bottom).astype(np.int64) - first, 0)
    partly, whole = np.zeros(rows * columns), np.zeros((rows, columns + 1))
    # The pieces of edges within a row.
    own = np.repeat(np.arange(len(count)), count)
    row = np.arange(len(own)) - np.repeat(np.cumsum(count) - count - first, count)
    high, low = np.maximum(edges.y0[own], row), np.minimum(edges.y1[own], row + 1.0)
    rise = (low - high) * edges.sign[own]
    at = np.stack((_across(edges, own, high), _across(edges, own, low)))
    near, far = at.min(axis=0), at.max(axis=0)
    begin = np.clip(np.floor(near), left, right).astype(np.int64) - left
    end = np.clip(np.ceil(far), left, right).astype(np.int64) - left
    row -= top
    # Right of a piece the pixels have all of its height; those that it crosses have a part of it.
    np.add.at(whole.reshape(-1), row * (columns + 1) + end, rise)
    crossed = end - begin
    for some in _split(crossed):
        numbers = crossed[some]
        column = np.arange(int(numbers.sum())) - np.repeat(np.cumsum(numbers) - numbers - begin[some], numbers)
        a, b, height = (np.repeat(each[some], numbers) for each in (near, far, rise))
        np.add.at(partly, np.repeat(row[some] * columns, numbers) + column, height * _share(a, b, column + float(left)))
    return whole, partly.reshape(rows, columns)


def _split(counts: NDArray[np.int64]) -> list[slice]:
    """Slices of about CHUNK in all each."""
    total = np.cumsum(counts)
    cuts = [0, *np.searchsorted(total, np.arange(CHUNK, int(total[-1]) if len(total) else 0, CHUNK)).tolist(), len(counts)]
    return [slice(a, b) for a, b in pairwise(cuts) if a < b]


def _share(a: Floats, b: Floats, column: Floats) -> Floats:
    """How much of the pixels in a column lies right of a line from `a` to `b`, a <= b, that crosses the height evenly: 0 to 1.

    The part of the line left of the column leaves all of the pixel to its right; the part within it, what is right of its middle.
    """
    length = b - a
    within_a, within_b = np.clip(a, column, column + 1), np.clip(b, column, column + 1)
    upright = length == 0
    length = np.where(upright, 1.0, length)
    inside = np.where(upright, 1.0, (within_b - within_a) / length)
    before = np.where(upright, 0.0, np.maximum(within_a - a, 0.0) / length)
    return before + inside * ((column + 1 - within_a) + (column + 1 - within_b)) / 2


def _across(edges: _Edges, own: NDArray[np.int64], y: Floats) -> Floats:
    """Where the edges `own` are at heights within them. Products and quotients carry what they round away, so that an edge from far
    outside of the picture is as accurate within it as a near one."""
    x0, y0, x1, y1 = edges.x0[own], edges.y0[own], edges.x1[own], edges.y1[own]
    down, run, rise = y - y0, x1 - x0, y1 - y0
    product, product_low = _product(down, run)
    quotient = product / rise
    again, again_low = _product(quotient, rise)
    rest = ((product - again) - again_low + product_low) / rise
    total = x0 + quotient
    back = total - x0
    missed = (x0 - (total - back)) + (quotient - back)
    found: Floats = np.where(y == y1, x1, total + (missed + rest))
    return found


def _product(a: Floats, b: Floats) -> tuple[Floats, Floats]:
    """A product and what its rounding left out (Dekker 1971)."""
    product = a * b
    (a_high, a_low), (b_high, b_low) = _halves(a), _halves(b)
    return product, a_low * b_low - (((product - a_high * b_high) - a_low * b_high) - a_high * b_low)


def _halves(a: Floats) -> tuple[Floats, Any]:
    """A number as the sum of two with half of the digits (Veltkamp)."""
    scaled = a * 134217729.0
    high = scaled - (scaled - a)
    return high, a - high
