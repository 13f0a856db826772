"""The exact picture of triangles that overlap, cross in depth or are mixed: the picture is cut into convex pieces of one colour each.

A piece of the picture begins as a tile of the background. Each triangle, in order, cuts the pieces that it meets into what lies inside it
and what does not; inside, depth cuts once more, along the line where the two surfaces cross, and what is in front (or drawn last,
where there is no depth) has the colour. Areas of the pieces within every pixel are exact as those of triangles are; all of it in double
precision.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from msaa_lint.experiments.study.exact_area import areas_of
from msaa_lint.experiments.study.shade import planes

from . import shapes
from .area import NOTHING
from .scene import RGBA

Floats = NDArray[np.float64]
Point = tuple[float, float]
Polygon = list[Point]
Line = tuple[float, float, float]
Color = tuple[float, float, float, float]

TILE = 16
"""Pixels of a tile's side: few triangles meet one, so that the work grows with their number and not with its square."""

ABREAST = 64
"""Tiles beside each other, and below, whose areas are worked out together."""

SLIVER = 1e-12
"""Pieces of a smaller area, in pixels, are dropped."""


class Piece(NamedTuple):
    """A convex part of the picture: its colour, and the depth of its surface as a plane."""

    polygon: Polygon
    color: Color
    plane: Line


class Look(NamedTuple):
    """What decides which surface is seen: depth or the order, and whether colours are mixed by alpha."""

    depth: bool = False
    reversed: bool = False
    blended: bool = False


def cut(polygon: Polygon, line: Line) -> tuple[Polygon, Polygon]:
    """The parts of a convex polygon where a*x + b*y + c is at least 0, and where it is at most 0; one may be empty."""
    a, b, c = line
    sides = [a * x + b * y + c for x, y in polygon]
    if min(sides) >= 0:
        return polygon, []
    if max(sides) <= 0:
        return [], polygon
    above: Polygon = []
    below: Polygon = []
    for number, (point, side) in enumerate(zip(polygon, sides, strict=True)):
        before, last = polygon[number - 1], sides[number - 1]
        if (last < 0 < side) or (side < 0 < last):
            part = last / (last - side)
            crossing = (before[0] + (point[0] - before[0]) * part, before[1] + (point[1] - before[1]) * part)
            above.append(crossing)
            below.append(crossing)
        if side >= 0:
            above.append(point)
        if side <= 0:
            below.append(point)
    return _solid(above), _solid(below)


def size(polygon: Polygon) -> float:
    """The area of a polygon, with the sign of its direction."""
    return sum(x0 * y1 - x1 * y0 for (x0, y0), (x1, y1) in zip(polygon, polygon[1:] + polygon[:1], strict=True)) / 2


def _solid(polygon: Polygon) -> Polygon:
    return polygon if len(polygon) > 2 and abs(size(polygon)) > SLIVER else []


def _edges(triangle: Floats) -> list[Line]:
    """The lines of a triangle's edges, at least 0 inside, in units of pixels; none for one without area."""
    corners = [(float(x), float(y)) for x, y in triangle]
    if size(corners) < 0:
        corners.reverse()
    if size(corners) <= SLIVER:
        return []
    return [(y0 - y1, x1 - x0, x0 * y1 - x1 * y0) for (x0, y0), (x1, y1) in zip(corners, corners[1:] + corners[:1], strict=True)]


def _inserted(tile: list[Piece], edges: list[Line], new: Piece, look: Look) -> list[Piece]:
    """The pieces of a tile with a triangle drawn over them."""
    found = []
    for piece in tile:
        inside, rest = piece.polygon, []
        for line in edges:
            inside, outside = cut(inside, line)
            if outside:
                rest.append(outside)
            if not inside:
                break
        seen: Polygon = inside
        if inside and look.depth:
            # Where the new surface is nearer: LESS, or GREATER with reversed depth.
            sign = -1.0 if look.reversed else 1.0
            a, b, c = (sign * (old - own) for old, own in zip(piece.plane, new.plane, strict=True))
            seen, hidden = ([], inside) if a == b == 0 and c <= 0 else cut(inside, (a, b, c))
            if hidden:
                rest.append(hidden)
        if not seen:
            found.append(piece)
            continue
        found += [piece._replace(polygon=each) for each in rest]
        found.append(Piece(seen, _mixed(new.color, piece.color) if look.blended else new.color, new.plane))
    return found


def _mixed(color: Color, behind: Color) -> Color:
    alpha = color[3]
    red, green, blue = (alpha * own + (1 - alpha) * old for own, old in zip(color[:3], behind[:3], strict=True))
    return red, green, blue, alpha + (1 - alpha) * behind[3]


def tiles(
    triangles: Floats, colors: Floats, depths: Floats | None, background: RGBA, size: tuple[int, int], look: Look
) -> Iterator[tuple[int, int, list[Piece]]]:
    """The tiles of a picture of that size (width, height): left, top and pieces of each."""
    width, height = size
    surfaces = planes(triangles, depths) if depths is not None else np.zeros((len(triangles), 3))
    low, high = triangles.min(axis=1), triangles.max(axis=1)
    edges = [_edges(triangle) for triangle in triangles]
    news = [Piece([], _four(color), (float(a), float(b), float(c))) for color, (a, b, c) in zip(colors, surfaces, strict=True)]
    cleared = 0.0 if look.reversed else 1.0
    for top in range(0, height, TILE):
        bottom = min(top + TILE, height)
        beside = np.flatnonzero((low[:, 1] < bottom) & (high[:, 1] > top))
        for left in range(0, width, TILE):
            right = min(left + TILE, width)
            tile = [(float(left), float(top)), (float(right), float(top)), (float(right), float(bottom)), (float(left), float(bottom))]
            found = [Piece(tile, background, (0.0, 0.0, cleared))]
            for number in beside[(low[beside, 0] < right) & (high[beside, 0] > left)]:
                if edges[number]:
                    found = _inserted(found, edges[number], news[number], look)
            yield left, top, found


def _four(color: Floats) -> Color:
    red, green, blue, alpha = map(float, color)
    return red, green, blue, alpha


class _Part(NamedTuple):
    """What a tile has of one colour, as triangles."""

    left: int
    top: int
    color: Color
    triangles: list[list[Point]]


def _areas(parts: list[_Part]) -> Floats:
    """The areas of parts within the pixels of their tiles (P, TILE, TILE), worked out side by side in one picture."""
    corners = []
    for number, part in enumerate(parts):
        row, column = divmod(number, ABREAST)
        corners.append(np.array(part.triangles) + np.array((TILE * column - part.left, TILE * row - part.top)))
    rows = -(-len(parts) // ABREAST)
    found = areas_of(np.concatenate(corners), TILE * ABREAST, TILE * rows)
    return found.reshape(rows, TILE, ABREAST, TILE).swapaxes(1, 2).reshape(-1, TILE, TILE)


def overlapping(
    colors: Floats,
    depths: Floats | None,
    background: RGBA,
    width: int,
    height: int,
    look: Look,
    shown: Callable[[Floats], Floats] | None = None,
) -> tuple[Callable[[Floats], Floats], Callable[[Floats], NDArray[np.bool_]]]:
    """What gives the exact picture (H, W, 4) of triangles (T, 3, 2), and the pixels that an edge or a crossing line goes through: those
    that no colour fills whole. `shown` maps the colour of a piece to what is displayed."""

    def display(color: Color) -> Floats:
        return np.array(color) if shown is None else shown(np.array(color))

    def both(triangles: Floats) -> tuple[Floats, NDArray[np.bool_]]:
        picture, whole = np.zeros((height, width, 4)), np.zeros((height, width), bool)
        parts: list[_Part] = []
        for left, top, found in tiles(triangles, colors, depths, background, (width, height), look):
            kinds: dict[Color, list[list[Point]]] = {}
            for piece in found:
                kinds.setdefault(piece.color, []).extend(shapes.fan(piece.polygon))
            if len(kinds) == 1:
                picture[top : top + TILE, left : left + TILE] = display(found[0].color)
                whole[top : top + TILE, left : left + TILE] = True
            else:
                parts += [_Part(left, top, color, own) for color, own in kinds.items()]
        for start in range(0, len(parts), ABREAST * ABREAST):
            some = parts[start : start + ABREAST * ABREAST]
            for part, area in zip(some, _areas(some), strict=False):
                pixels = slice(part.top, min(part.top + TILE, height)), slice(part.left, min(part.left + TILE, width))
                area = area[: pixels[0].stop - part.top, : pixels[1].stop - part.left]
                picture[pixels] += area[..., None] * display(part.color)
                whole[pixels] |= area > 1 - NOTHING
        return picture, ~whole

    remembered: list[tuple[bytes, tuple[Floats, NDArray[np.bool_]]]] = []

    def once(triangles: Floats) -> tuple[Floats, NDArray[np.bool_]]:
        key = triangles.tobytes()
        if not remembered or remembered[0][0] != key:
            remembered[:] = [(key, both(triangles))]
        return remembered[0][1]

    return lambda triangles: once(triangles)[0], lambda triangles: once(triangles)[1]
