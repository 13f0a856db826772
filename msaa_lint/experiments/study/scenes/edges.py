"""Scenes of edges, which coverage samples smooth."""

from __future__ import annotations

import math

import numpy as np

from . import area, shapes
from .scene import WHITE, Scene

MIN_SIDE = 4.0


def _white(polygons: list[list[shapes.Point]], width: int, height: int) -> Scene:
    """White shapes that do not overlap, on black: a scene of coverage alone."""
    white_triangles = shapes.triangles(polygons)
    colors = shapes.uniform_colors(len(white_triangles), WHITE)
    return Scene(width, height, white_triangles, colors, area.disjoint(colors))


def edge_fan(width: int, height: int) -> Scene:
    """A ring of wedges, as many as fit 3 pixels apart. Their edges, radial and tangential, are
    evenly distributed over all angles.
    """
    center = (width / 2, height / 2)
    outer = min(width, height) / 2 - 1
    inner = outer / 2
    count = max(int(math.pi * inner / 3), 4)
    step = 2 * math.pi / count
    wedges = []
    for number in range(count):
        # Start off the axes so that no edge lies on one.
        start = number * step + step * shapes.GOLDEN / 2
        ends = (start, start + step / 2)
        wedges.append([shapes.polar(center, inner, ends[0]), shapes.polar(center, outer, ends[0]),
                       shapes.polar(center, outer, ends[1]), shapes.polar(center, inner,
                       ends[1])])  # fmt: skip
    return _white(wedges, width, height)


def near_horizontal(width: int, height: int) -> Scene:
    """Bars across the whole picture with slopes evenly distributed from -1/16 to 1/16, as close
    together as 3 pixels.
    """
    thick, gap, steepest = 5.0, 3.0, 1 / 16
    count = max(int((height - 2 * width * steepest) / (thick + gap)), 2)
    change = 2 * steepest / (count - 1)
    pitch = thick + gap + change * width / 2
    top = (height - pitch * (count - 1) - thick) / 2
    bars = []
    for number in range(count):
        # Offset by less than the gap so that edges start at every height within a pixel.
        center = top + number * pitch + shapes.spread(number, 0.25) * gap / 2
        fall = (number * change - steepest) * width / 2
        bars.append(
            [
                (0.0, center - fall),
                (float(width), center + fall),
                (float(width), center + fall + thick),
                (0.0, center - fall + thick),
            ]
        )
    return _white(bars, width, height)


def wires(width: int, height: int) -> Scene:
    """Wires at all angles, one in each square of 24 pixels, with widths evenly distributed from 0.1
    to 2 pixels.
    """
    side = 24.0
    rows, columns = int(height // side), int(width // side)
    bars = []
    for number in range(rows * columns):
        center = (
            (number % columns + 0.5) * side + shapes.spread(number, 0.1),
            (number // columns + 0.5) * side + shapes.spread(number, 0.8),
        )
        thick = 0.1 + 1.9 * shapes.spread(number, 0.3)
        angle = math.pi * shapes.spread(number * 7)
        bars.append(
            shapes.bar(shapes.polar(center, 10, angle), shapes.polar(center, -10, angle), thick)
        )
    return _white(bars, width, height)


def siemens_star(width: int, height: int) -> Scene:
    """36 wedges that meet at the center."""
    count = 36
    center = (width / 2 + 0.3, height / 2 + 0.2)
    outer = min(width, height) / 2 - 1
    step = 2 * math.pi / count
    starts = [(number + shapes.GOLDEN / 2) * step for number in range(count)]
    wedges = [
        [center, shapes.polar(center, outer, start), shapes.polar(center, outer, start + step / 2)]
        for start in starts
    ]
    return _white(wedges, width, height)


def mesh(width: int, height: int, side: float = 12) -> Scene:
    """Squares of about `side` pixels with displaced corners, each in two triangles, over the whole
    picture. No color of the 8 is on both sides of an edge or, from MIN_SIDE on, twice within a
    pixel.
    """
    columns, rows = max(round(width / side), 2), max(round(height / side), 2)
    pitch_x, pitch_y = width / columns, height / rows

    def corner(column: int, row: int) -> shapes.Point:
        number = row * (columns + 1) + column
        movable = 0 < column < columns, 0 < row < rows
        return ((column + 0.6 * (shapes.spread(number, 0.1) - 0.5) * movable[0]) * pitch_x,
                (row + 0.6 * (shapes.spread(number * 3,
                0.6) - 0.5) * movable[1]) * pitch_y)  # fmt: skip

    squares, colors = [], []
    for row in range(rows):
        for column in range(columns):
            square = [
                corner(column, row),
                corner(column + 1, row),
                corner(column + 1, row + 1),
                corner(column, row + 1),
            ]
            # Alternate the diagonal, so that a square with a reflex corner is split inside it.
            rotation = (row + column) % 2
            squares.append(square[rotation:] + square[:rotation])
            for half in range(2):
                number = 4 * half + 2 * (row % 2) + column % 2
                colors.append(
                    [
                        shapes.spread(number, 0.2),
                        shapes.spread(number * 5, 0.7),
                        shapes.spread(number * 11, 0.4),
                        1.0,
                    ]
                )
    mesh_triangles, mesh_colors = shapes.triangles(squares), np.array(colors)
    exact = area.disjoint(mesh_colors, covered=False)
    return Scene(width, height, mesh_triangles, mesh_colors, exact, coverage_matter=False)
