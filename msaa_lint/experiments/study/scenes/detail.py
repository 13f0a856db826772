"""Scenes of detail within a triangle: a texture, and shapes cut out by alpha."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from msaa_lint.experiments.study.exact_area import areas_of

from . import shapes
from .light import Display
from .scene import WHITE, Scene

Floats = NDArray[np.float64]


def zone_plate(width: int, height: int, display: Display | None = None) -> Scene:
    """Rings (1 + cos(k r^2)) / 2 on two triangles that cover the picture.

    At half the shorter side from the center the rings reach the finest detail that pixels can show (half a cycle per pixel); beyond that
    they are finer. With `display` there is no closed form, and the exact picture uses Gauss-Legendre quadrature of 12 x 12 points.
    """
    x0, y0 = width / 2, height / 2
    k = math.pi / min(width, height)
    triangles = shapes.triangles([shapes.rectangle(0, 0, width, height)])

    def shade(triangle: NDArray[np.int32], x: Floats, y: Floats) -> Floats:
        value = 0.5 + 0.5 * np.cos(k * ((x - x0) ** 2 + (y - y0) ** 2))
        return np.stack([value, value, value, np.ones_like(value)], axis=-1)

    def displayed(triangles: Floats) -> Floats:
        nodes, weights = np.polynomial.legendre.leggauss(12)
        picture = np.zeros((height, width, 4))
        rows, columns = np.arange(height)[:, None], np.arange(width)[None, :]
        for offset_y, weight_y in zip((nodes + 1) / 2, weights / 2, strict=True):
            for offset_x, weight_x in zip((nodes + 1) / 2, weights / 2, strict=True):
                assert display is not None
                picture += weight_y * weight_x * display(shade(np.empty(0, np.int32), columns + offset_x, rows + offset_y))
        return picture

    def exact(triangles: Floats) -> Floats:
        # cos(k (x^2 + y^2)) is the real part of the product of a function of x and one of y, and so is its integral over a pixel.
        waves = np.outer(_wave(k, y0, height), _wave(k, x0, width))
        picture = np.ones((height, width, 4))
        picture[..., :3] = (0.5 + 0.5 * waves.real)[..., None]
        return picture

    def edge_pixels(triangles: Floats) -> NDArray[np.bool_]:
        return np.ones((height, width), bool)

    colors = shapes.uniform_colors(len(triangles), WHITE)
    return Scene(width, height, triangles, colors, exact if display is None else displayed, edge_pixels, False, shade=shade)


def _wave(k: float, center: float, count: int) -> NDArray[np.complex128]:
    """The integral of exp(i k (t - center)^2) over each of `count` pixels, by Gauss-Legendre quadrature of 24 points: the phase makes fewer
    than 4 turns within a pixel, so that the result is accurate to double precision."""
    nodes, weights = np.polynomial.legendre.leggauss(24)
    points = np.arange(count)[:, None] + (nodes + 1) / 2
    return np.asarray(np.exp(1j * k * (points - center) ** 2) @ (weights / 2))


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
            center = ((column + 0.45 + 0.1 * shapes.spread(number, 0.2)) * side, (row + 0.45 + 0.1 * shapes.spread(number, 0.7)) * side)
            turn = 2 * math.pi * shapes.spread(number)
            leaves.append(
                [shapes.polar(center, 0.4 * side * length, turn + math.radians(angle)) for angle, length in zip(LEAF, LENGTHS, strict=True)]
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
    sides = np.roll(corners, -1, axis=1) - corners
    lengths = np.hypot(sides[..., 0], sides[..., 1])

    def shade(triangle: NDArray[np.int32], x: Floats, y: Floats) -> Floats:
        leaf = triangle // 2
        inside = np.full(len(leaf), np.inf)
        for side in range(corners.shape[1]):
            (dx, dy), (px, py) = sides[leaf, side].T, corners[leaf, side].T
            inside = np.minimum(inside, (dx * (y - py) - dy * (x - px)) / lengths[leaf, side])
        alpha = np.clip(inside + 0.5, 0, 1)
        one = np.ones_like(alpha)
        return np.stack([one, one, one, alpha], axis=-1)

    def exact(triangles: Floats) -> Floats:
        return np.repeat(areas_of(shapes.triangles(leaves), width, height)[..., None], 4, axis=2)

    colors = shapes.uniform_colors(len(card_triangles), WHITE)
    scene = Scene(width, height, card_triangles, colors, exact, shade=shade)
    return scene._replace(effects=(effect,), why={effect: why}, settings=settings)


def foliage(width: int, height: int) -> Scene:
    """Leaves cut out of rectangles by alpha: a texture of the distance to the leaf's edge, 0.5 at the edge, going from 0 to 1 over one
    pixel."""
    return _foliage(width, height, "alpha-test", "leaves are cut out of their triangles by discarding where alpha is below 0.5", {})


def foliage_to_coverage(width: int, height: int) -> Scene:
    """The same leaves with alpha to coverage instead of the alpha test."""
    why = "leaves are cut out of their triangles by covering samples in proportion to alpha"
    return _foliage(width, height, "alpha-to-coverage", why, {"alpha-to-coverage": "dithered"})
