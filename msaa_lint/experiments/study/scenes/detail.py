"""Scenes of detail within a triangle: a texture, and shapes cut out by alpha."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from . import shapes
from .area import partly_covered
from .light import Display
from .scene import WHITE, Scene
from .view import Truth, View, areas_in

Floats = NDArray[np.float64]


def zone_plate(width: int, height: int, display: Display | None = None) -> Scene:
    """Rings (1 + cos(k r^2)) / 2 on two triangles that cover the picture.

    At half the shorter side from the center the rings reach the finest detail that pixels can show
    (half a cycle per pixel); beyond that they are finer. With `display` there is no closed form,
    and the exact picture uses Gauss-Legendre quadrature of 12 x 12 points.
    """
    x0, y0 = width / 2, height / 2
    k = math.pi / min(width, height)
    triangles = shapes.triangles([shapes.rectangle(0, 0, width, height)])

    def shade(triangle: NDArray[np.int32], x: Floats, y: Floats) -> Floats:
        phase = np.asarray(k * ((x - x0) ** 2 + (y - y0) ** 2))
        color = np.ones((4, *phase.shape))
        color[:3] = 0.5 + 0.5 * np.cos(phase, out=phase)
        return np.moveaxis(color, 0, -1)

    def exact(view: View) -> Truth:
        across, wave_x = _wave(
            k, [(part.left, part.dx) for part in view.parts], view.parts[0].width, width
        )
        down, wave_y = _wave(
            k, [(part.top, part.dy) for part in view.parts], view.parts[0].height, height
        )
        area = down[:, :, None] * across[:, None, :]
        # cos(k (x^2 + y^2)) is the real part of the product of a function of x and one of y, and so
        # is its integral over a pixel.
        waves = wave_y[:, :, None] * wave_x[:, None, :]
        picture = np.empty((*area.shape, 4))
        picture[..., :3] = (0.5 * area + 0.5 * waves.real)[..., None]
        picture[..., 3] = area
        return Truth(picture, area > 0)

    def displayed(view: View) -> Truth:
        nodes, weights = np.polynomial.legendre.leggauss(12)
        pictures = []
        for left, top, columns, rows, dx, dy in view.parts:
            (x, widths), (y, heights) = (
                _clipped(left - dx, columns, width),
                _clipped(top - dy, rows, height),
            )
            picture = np.zeros((rows, columns, 4))
            for offset_y, weight_y in zip((nodes + 1) / 2, weights / 2, strict=True):
                for offset_x, weight_x in zip((nodes + 1) / 2, weights / 2, strict=True):
                    assert display is not None
                    points = x + widths * offset_x, (y + heights * offset_y)[:, None]
                    picture += weight_y * weight_x * display(shade(np.empty(0, np.int32), *points))
            pictures.append(picture * (heights[:, None] * widths)[..., None])
        image = np.stack(pictures)
        return Truth(image, image[..., 3] > 0)

    colors = shapes.uniform_colors(len(triangles), WHITE)
    return Scene(
        width,
        height,
        triangles,
        colors,
        exact if display is None else displayed,
        False,
        shade=shade,
    )


def _clipped(start: float, count: int, end: int) -> tuple[Floats, Floats]:
    """The begin and the length of the part of each of `count` pixels from `start` on that lies
    between 0 and `end`.
    """
    edges = np.clip(start + np.arange(count + 1), 0, end)
    return edges[:-1], np.diff(edges)


def _wave(
    k: float, starts: Sequence[tuple[int, float]], count: int, end: int
) -> tuple[Floats, NDArray[np.complex128]]:
    """Of `count` pixels from each start on (a column, and how far the picture has moved): the
    length that lies between 0 and `end`, and the integral of exp(i k (t - end / 2)^2) over it, each
    (P, count).

    By Gauss-Legendre quadrature of 24 points: the phase makes fewer than 4 turns within a pixel, so
    that the result is accurate to double precision.
    """
    nodes, weights = np.polynomial.legendre.leggauss(24)
    clipped = [_clipped(start - moved, count, end) for start, moved in starts]
    begins, lengths = (np.stack(column) for column in zip(*clipped, strict=True))
    points = begins[..., None] + lengths[..., None] * ((nodes + 1) / 2)
    return lengths, lengths * (np.exp(1j * k * (points - end / 2) ** 2) @ (weights / 2))


LEAF = (0.0, 35.0, 68.0, 180.0, 292.0, 325.0)
"""Angles in degrees of a leaf's corners around its center: pointed at one end."""

LENGTHS = (1.0, 0.72, 0.45, 0.9, 0.45, 0.72)
"""Distances of the corners from the center, in units of half the leaf's length."""


def _leaves(width: int, height: int) -> list[list[shapes.Point]]:
    """Leaves at all angles, one in each square of 24 pixels, without overlap."""
    side = 24.0
    leaves = []
    for row in range(int(height // side)):
        for column in range(int(width // side)):
            number = row * int(width // side) + column
            center = (
                (column + 0.45 + 0.1 * shapes.spread(number, 0.2)) * side,
                (row + 0.45 + 0.1 * shapes.spread(number, 0.7)) * side,
            )
            turn = 2 * math.pi * shapes.spread(number)
            leaves.append(
                [
                    shapes.polar(center, 0.4 * side * length, turn + math.radians(angle))
                    for angle, length in zip(LEAF, LENGTHS, strict=True)
                ]
            )
    return leaves


def _foliage(width: int, height: int, effect: str, why: str, settings: dict[str, object]) -> Scene:
    leaves = _leaves(width, height)
    cards = []
    for leaf in leaves:
        (left, top), (right, bottom) = np.min(leaf, axis=0), np.max(leaf, axis=0)
        cards.append(shapes.rectangle(left - 1.0, top - 1.0, right + 1.0, bottom + 1.0))
    card_triangles = shapes.triangles(cards)
    corners = np.array(leaves)
    directions = np.roll(corners, -1, axis=1) - corners
    # The sides of leaves: x and y of the direction and of the corner, and the length, each by side
    # and leaf.
    sides = np.ascontiguousarray(
        np.concatenate([directions, corners, np.hypot(*directions.T).T[..., None]], axis=-1).T
    )

    def shade(triangle: NDArray[np.int32], x: Floats, y: Floats) -> Floats:
        leaf = triangle // 2
        inside = np.full(len(leaf), np.inf)
        for side in sides.swapaxes(0, 1):
            dx, dy, px, py, length = np.take(side, leaf, axis=1)
            inside = np.minimum(inside, (dx * (y - py) - dy * (x - px)) / length)
        color = np.ones((len(leaf), 4))
        color[:, 3] = np.clip(inside + 0.5, 0, 1)
        return color

    leaf_triangles = shapes.triangles(leaves).reshape(len(leaves), -1, 3, 2)

    def exact(view: View) -> Truth:
        # Both triangles of a card, or one of them, are near a part.
        part, leaf = np.unique(np.stack((view.part, view.triangle // 2)), axis=1)
        motion = np.array([(each.dx, each.dy) for each in view.parts])
        corners = leaf_triangles[leaf] + motion[part][:, None, None]
        area = areas_in(view.parts, np.repeat(part, corners.shape[1]), corners.reshape(-1, 3, 2))
        return Truth(np.repeat(area[..., None], 4, axis=-1), partly_covered(area))

    colors = shapes.uniform_colors(len(card_triangles), WHITE)
    scene = Scene(width, height, card_triangles, colors, exact, shade=shade)
    return scene._replace(effects=(effect,), why={effect: why}, settings=settings)


def foliage(width: int, height: int) -> Scene:
    """Leaves cut out of rectangles by alpha: a texture of the distance to the leaf's edge, 0.5 at
    the edge, going from 0 to 1 over one pixel.
    """
    return _foliage(
        width,
        height,
        "alpha-test",
        "leaves are cut out of their triangles by discarding where alpha is below 0.5",
        {},
    )


def foliage_to_coverage(width: int, height: int) -> Scene:
    """The same leaves with alpha to coverage instead of the alpha test."""
    why = "leaves are cut out of their triangles by covering samples in proportion to alpha"
    return _foliage(width, height, "alpha-to-coverage", why, {"alpha-to-coverage": "dithered"})
