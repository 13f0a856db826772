"""The exact picture of triangles that overlap, intersect in depth or are blended: the picture is
divided into convex regions of one color.

A tile of the picture starts as one black region. Each triangle, in order, divides the regions that
it overlaps into the part inside it and the rest. Inside, a depth test divides the part once more
along the line where the two surfaces intersect; what is in front (or drawn last, without depth)
determines the color. The areas of regions within each pixel are exact, in double precision.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from msaa_lint.experiments.study.exact_area import areas_of

from .area import TOLERANCE
from .part import Part
from .scene import BLACK
from .shapes import Point, depth_planes, fan, rectangle
from .view import Truth, View

Floats = NDArray[np.float64]
Polygon = list[Point]
Line = tuple[float, float, float]
Color = tuple[float, float, float, float]

TILE = 16
"""Side of a tile in pixels. A tile of many small triangles is quartered, down to single pixels."""

MAX_IN_CELL = 8
"""Triangles that overlap a part of a tile that is never quartered."""

MAX_STEPS = 500_000
"""Comparisons of a triangle with a region, of 3 µs each, for one picture. It grows with the square
of the triangles over a pixel.
"""

STEPS_PER_TRIANGLE, STEPS_PER_TILE = 5, 100
"""Comparisons beyond MAX_STEPS for each triangle and each tile of the picture."""

BATCH_TILES = 64
"""Tiles, horizontally and vertically, whose areas are computed together."""

MIN_AREA = 1e-12
"""Regions of a smaller area, in pixels, are dropped."""


TOO_MANY = (
    "too many triangles overlap in the same pixels for an exact picture; simplify the mesh, "
    "or use a larger --size"
)


class Region(NamedTuple):
    """A convex part of the picture, its color, and the depth plane of its surface."""

    polygon: Polygon
    color: Color
    plane: Line


class Visibility(NamedTuple):
    """What decides the visible surface: depth or the drawing order, and whether colors are blended
    by alpha.
    """

    depth: bool = False
    reversed: bool = False
    blended: bool = False


def split(polygon: Polygon, line: Line) -> tuple[Polygon, Polygon]:
    """The parts of a convex polygon where a*x + b*y + c is at least 0, and where it is at most 0;
    one of them may be empty.
    """
    a, b, c = line
    sides = [a * x + b * y + c for x, y in polygon]
    if min(sides) >= 0:
        return polygon, []
    if max(sides) <= 0:
        return [], polygon
    above: Polygon = []
    below: Polygon = []
    for number, (point, side) in enumerate(zip(polygon, sides, strict=True)):
        previous, previous_side = polygon[number - 1], sides[number - 1]
        if (previous_side < 0 < side) or (side < 0 < previous_side):
            fraction = previous_side / (previous_side - side)
            crossing = (
                previous[0] + (point[0] - previous[0]) * fraction,
                previous[1] + (point[1] - previous[1]) * fraction,
            )
            above.append(crossing)
            below.append(crossing)
        if side >= 0:
            above.append(point)
        if side <= 0:
            below.append(point)
    return _unless_degenerate(above), _unless_degenerate(below)


def signed_area(polygon: Polygon) -> float:
    """The area of a polygon, signed by its winding."""
    return (
        sum(
            x0 * y1 - x1 * y0
            for (x0, y0), (x1, y1) in zip(polygon, polygon[1:] + polygon[:1], strict=True)
        )
        / 2
    )


def _unless_degenerate(polygon: Polygon) -> Polygon:
    return polygon if len(polygon) > 2 and abs(signed_area(polygon)) > MIN_AREA else []


def _edges(triangle: Floats) -> list[Line]:
    """The lines of a triangle's edges, at least 0 inside, in pixels; none for a triangle without
    area.
    """
    corners = [(float(x), float(y)) for x, y in triangle]
    if signed_area(corners) < 0:
        corners.reverse()
    if signed_area(corners) <= MIN_AREA:
        return []
    return [
        (y0 - y1, x1 - x0, x0 * y1 - x1 * y0)
        for (x0, y0), (x1, y1) in zip(corners, corners[1:] + corners[:1], strict=True)
    ]


def _draw(
    tile: list[Region], edges: list[Line], triangle: Region, visibility: Visibility
) -> list[Region]:
    """The regions of a tile with a triangle drawn over them."""
    regions = []
    for region in tile:
        inside, outside = region.polygon, []
        for line in edges:
            inside, rest = split(inside, line)
            if rest:
                outside.append(rest)
            if not inside:
                break
        visible: Polygon = inside
        if inside and visibility.depth:
            # Where the new surface is nearer: LESS, or GREATER with reversed depth.
            sign = -1.0 if visibility.reversed else 1.0
            a, b, c = (
                sign * (old - new) for old, new in zip(region.plane, triangle.plane, strict=True)
            )
            visible, hidden = ([], inside) if a == b == 0 and c <= 0 else split(inside, (a, b, c))
            if hidden:
                outside.append(hidden)
        if not visible:
            regions.append(region)
            continue
        regions += [region._replace(polygon=polygon) for polygon in outside]
        color = _blend(triangle.color, region.color) if visibility.blended else triangle.color
        regions.append(Region(visible, color, triangle.plane))
    return regions


def _blend(color: Color, behind: Color) -> Color:
    alpha = color[3]
    red, green, blue = (
        alpha * new + (1 - alpha) * old for new, old in zip(color[:3], behind[:3], strict=True)
    )
    return red, green, blue, alpha + (1 - alpha) * behind[3]


class _Drawing(NamedTuple):
    """The triangles to draw, with the comparisons that remain."""

    low: Floats
    high: Floats
    edges: list[list[Line]]
    surfaces: list[Region]
    visibility: Visibility
    steps: list[int]

    def overlapping(
        self, left: int, top: int, right: int, bottom: int, numbers: NDArray[np.intp]
    ) -> NDArray[np.intp]:
        """The triangles of these numbers whose bounds overlap a part of the picture."""
        low, high = self.low[numbers], self.high[numbers]
        return numbers[
            (low[:, 0] < right) & (high[:, 0] > left) & (low[:, 1] < bottom) & (high[:, 1] > top)
        ]

    def regions(
        self, left: int, top: int, right: int, bottom: int, numbers: NDArray[np.intp]
    ) -> list[Region]:
        """The regions of a part of the picture that the triangles of these numbers overlap.
        ValueError if that takes too many steps.
        """
        if len(numbers) > MAX_IN_CELL and max(right - left, bottom - top) > 1:
            parts = [
                (x0, y0, x1, y1)
                for y0, y1 in _halves(top, bottom)
                for x0, x1 in _halves(left, right)
            ]
            overlaps = [self.overlapping(*part, numbers) for part in parts]
            # The work grows with the square of the triangles, and those that are larger than a part
            # are in several.
            if 2 * sum(len(overlap) ** 2 for overlap in overlaps) <= len(numbers) ** 2:
                return [
                    region
                    for part, overlap in zip(parts, overlaps, strict=True)
                    for region in self.regions(*part, overlap)
                ]
        corners = [(float(x), float(y)) for x, y in rectangle(left, top, right, bottom)]
        regions = [Region(corners, BLACK, (0.0, 0.0, 0.0 if self.visibility.reversed else 1.0))]
        for number in numbers:
            self.steps[0] -= len(regions)
            if self.steps[0] < 0:
                raise ValueError(
                    "too many triangles overlap in the same pixels for an exact picture; simplify "
                    "the mesh, or use a larger --size"
                )
            regions = _draw(regions, self.edges[number], self.surfaces[number], self.visibility)
        return regions


def _halves(start: int, end: int) -> list[tuple[int, int]]:
    """Both halves of a range of pixels; the range itself if it is a single pixel."""
    middle = (start + end) // 2
    return [(start, middle), (middle, end)] if start < middle else [(start, end)]


class Tile(NamedTuple):
    """A tile of a part of the picture: its place in the part, and its regions."""

    part: int
    left: int
    top: int
    regions: list[Region]


def tiles(
    view: View, colors: Floats, depths: Floats | None, size: tuple[int, int], visibility: Visibility
) -> Iterator[Tile]:
    """The tiles of the parts of a picture of `size` (width, height). ValueError where the overlaps
    in them take more than MAX_STEPS comparisons, and those for each triangle and tile of the whole
    picture.
    """
    near = view.triangle
    planes = (
        depth_planes(view.corners, depths[near]) if depths is not None else np.zeros((len(near), 3))
    )
    edges = [_edges(triangle) for triangle in view.corners]
    surfaces = [
        Region([], _color(color), (float(a), float(b), float(c)))
        for color, (a, b, c) in zip(colors[near], planes, strict=True)
    ]
    tile_count = -(-size[0] // TILE) * -(-size[1] // TILE)
    steps = MAX_STEPS + STEPS_PER_TRIANGLE * len(colors) + STEPS_PER_TILE * tile_count
    drawing = _Drawing(
        view.corners.min(axis=1), view.corners.max(axis=1), edges, surfaces, visibility, [steps]
    )
    with_area = np.array([number for number, lines in enumerate(edges) if lines], np.intp)
    limits = np.searchsorted(view.part[with_area], np.arange(len(view.parts) + 1))
    for number, (left, top, width, height, _, _) in enumerate(view.parts):
        in_part = with_area[limits[number] : limits[number + 1]]
        for y0 in range(top, top + height, TILE):
            y1 = min(y0 + TILE, top + height)
            in_row = drawing.overlapping(left, y0, left + width, y1, in_part)
            for x0 in range(left, left + width, TILE):
                x1 = min(x0 + TILE, left + width)
                yield Tile(
                    number,
                    x0 - left,
                    y0 - top,
                    drawing.regions(x0, y0, x1, y1, drawing.overlapping(x0, y0, x1, y1, in_row)),
                )


def _color(color: Floats) -> Color:
    red, green, blue, alpha = map(float, color)
    return red, green, blue, alpha


class _ColorArea(NamedTuple):
    """What one color fills of a tile, as triangles in pixels of the picture."""

    tile: Tile
    color: Color
    triangles: list[list[Point]]


def _areas(areas: list[_ColorArea], parts: Sequence[Part]) -> Floats:
    """The areas within the pixels of their tiles (A, TILE, TILE), computed side by side in one
    picture.
    """
    corners = []
    for number, (tile, _, triangles) in enumerate(areas):
        row, column = divmod(number, BATCH_TILES)
        part = parts[tile.part]
        corners.append(
            np.array(triangles)
            + np.array((TILE * column - part.left - tile.left, TILE * row - part.top - tile.top))
        )
    rows = -(-len(areas) // BATCH_TILES)
    picture = areas_of(np.concatenate(corners), TILE * BATCH_TILES, TILE * rows)
    return picture.reshape(rows, TILE, BATCH_TILES, TILE).swapaxes(1, 2).reshape(-1, TILE, TILE)


def overlapping(
    colors: Floats,
    depths: Floats | None,
    width: int,
    height: int,
    visibility: Visibility,
    display: Callable[[Floats], Floats] | None = None,
) -> Callable[[View], Truth]:
    """A function of triangles to their exact picture, and the pixels that an edge or an
    intersection crosses, which no single color fills. `display` maps the color of a region to the
    displayed one.
    """

    def displayed(color: Color) -> Floats:
        return np.array(color) if display is None else display(np.array(color))

    def render(view: View) -> Truth:
        first = view.parts[0]
        size = (len(view.parts), first.height, first.width)
        picture, whole = np.zeros((*size, 4)), np.zeros(size, bool)
        areas: list[_ColorArea] = []
        for tile in tiles(view, colors, depths, (width, height), visibility):
            by_color: dict[Color, list[list[Point]]] = {}
            for region in tile.regions:
                by_color.setdefault(region.color, []).extend(fan(region.polygon))
            if len(by_color) == 1:
                pixels = (
                    tile.part,
                    slice(tile.top, tile.top + TILE),
                    slice(tile.left, tile.left + TILE),
                )
                picture[pixels] = displayed(tile.regions[0].color)
                whole[pixels] = True
            else:
                areas += [_ColorArea(tile, color, shapes) for color, shapes in by_color.items()]
        for start in range(0, len(areas), BATCH_TILES * BATCH_TILES):
            batch = areas[start : start + BATCH_TILES * BATCH_TILES]
            for (tile, color, _), area in zip(batch, _areas(batch, view.parts), strict=False):
                bottom, right = (
                    min(tile.top + TILE, first.height),
                    min(tile.left + TILE, first.width),
                )
                pixels = tile.part, slice(tile.top, bottom), slice(tile.left, right)
                area = area[: bottom - tile.top, : right - tile.left]
                picture[pixels] += area[..., None] * displayed(color)
                whole[pixels] |= area > 1 - TOLERANCE
        return Truth(picture, ~whole)

    return render
