"""Scenes of edges: what coverage is for."""

from __future__ import annotations

import math

import numpy as np

from . import area, shapes
from .scene import BLACK, WHITE, Scene


def _white(polygons: list[list[shapes.Point]], width: int, height: int) -> Scene:
    """White shapes that do not overlap, on black: nothing but coverage."""
    made = shapes.triangles(polygons)
    colors = shapes.painted(len(made), WHITE)
    exact = area.disjoint(colors, BLACK, width, height)
    return Scene("", "", width, height, made, colors, None, BLACK, (), {}, exact)


def edge_fan(width: int, height: int) -> Scene:
    """A ring of wedges, as many as stand 3 pixels apart. Their edges, straight out and across, are at all angles, evenly."""
    center = (width / 2, height / 2)
    outer = min(width, height) / 2 - 1
    inner = outer / 2
    count = max(int(math.pi * inner / 3), 4)
    step = 2 * math.pi / count
    wedges = []
    for number in range(count):
        # A start off the axes, so that no edge lies on one.
        start = number * step + step * shapes.GOLDEN / 2
        ends = (start, start + step / 2)
        wedges.append([shapes.around(center, inner, ends[0]), shapes.around(center, outer, ends[0]),
                       shapes.around(center, outer, ends[1]), shapes.around(center, inner, ends[1])])  # fmt: skip
    return _white(wedges, width, height)


def near_horizontal(width: int, height: int) -> Scene:
    """Bars across the whole picture, their slopes from -1/16 to 1/16, evenly, one below the other as close as 3 pixels."""
    thick, gap, steepest = 5.0, 3.0, 1 / 16
    count = max(int((height - 2 * width * steepest) / (thick + gap)), 2)
    change = 2 * steepest / (count - 1)
    pitch = thick + gap + change * width / 2
    top = (height - pitch * (count - 1) - thick) / 2
    bars = []
    for number in range(count):
        # Moved by less than the gap, so that edges start at every height within a pixel.
        middle = top + number * pitch + shapes.spread(number, 0.25) * gap / 2
        fall = (number * change - steepest) * width / 2
        bars.append(
            [(0.0, middle - fall), (float(width), middle + fall), (float(width), middle + fall + thick), (0.0, middle - fall + thick)]
        )
    return _white(bars, width, height)


def wires(width: int, height: int) -> Scene:
    """Wires from 0.1 to 2 pixels wide, evenly, at all angles, one in each square of 24 pixels."""
    side = 24.0
    rows, columns = int(height // side), int(width // side)
    bars = []
    for number in range(rows * columns):
        middle = (
            (number % columns + 0.5) * side + shapes.spread(number, 0.1),
            (number // columns + 0.5) * side + shapes.spread(number, 0.8),
        )
        thick = 0.1 + 1.9 * shapes.spread(number, 0.3)
        angle = math.pi * shapes.spread(number * 7)
        bars.append(shapes.bar(shapes.around(middle, 10, angle), shapes.around(middle, -10, angle), thick))
    return _white(bars, width, height)


def siemens_star(width: int, height: int) -> Scene:
    """36 wedges that meet in the middle."""
    count = 36
    center = (width / 2 + 0.3, height / 2 + 0.2)
    outer = min(width, height) / 2 - 1
    step = 2 * math.pi / count
    starts = [(number + shapes.GOLDEN / 2) * step for number in range(count)]
    wedges = [[center, shapes.around(center, outer, start), shapes.around(center, outer, start + step / 2)] for start in starts]
    return _white(wedges, width, height)


def mesh(width: int, height: int) -> Scene:
    """Squares of about 12 pixels with their corners moved, each in two triangles, over the whole picture. There are 8 colours, and never
    one on both sides of an edge nor twice within a pixel."""
    columns, rows = max(round(width / 12), 2), max(round(height / 12), 2)
    across, down = width / columns, height / rows

    def corner(column: int, row: int) -> shapes.Point:
        number = row * (columns + 1) + column
        inside = 0 < column < columns, 0 < row < rows
        return ((column + 0.6 * (shapes.spread(number, 0.1) - 0.5) * inside[0]) * across,
                (row + 0.6 * (shapes.spread(number * 3, 0.6) - 0.5) * inside[1]) * down)  # fmt: skip

    found, colors = [], []
    for row in range(rows):
        for column in range(columns):
            square = [corner(column, row), corner(column + 1, row), corner(column + 1, row + 1), corner(column, row + 1)]
            # Either diagonal: of a square that is bent inwards at a corner, the one that stays inside.
            turned = (row + column) % 2
            found.append(square[turned:] + square[:turned])
            for half in range(2):
                number = 4 * half + 2 * (row % 2) + column % 2
                colors.append([shapes.spread(number, 0.2), shapes.spread(number * 5, 0.7), shapes.spread(number * 11, 0.4), 1.0])
    made, tints = shapes.triangles(found), np.array(colors)
    exact = area.disjoint(tints, BLACK, width, height)
    crossed = area.edges_between(tints, width, height)
    return Scene("", "", width, height, made, tints, None, BLACK, (), {}, exact, False, None, crossed)
