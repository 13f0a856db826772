"""Scenes of detail within a triangle: texture, and shapes that alpha cuts out."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from msaa_lint.experiments.study.exact_area import areas_of

from . import shapes
from .light import Shown
from .scene import BLACK, WHITE, Scene

Floats = NDArray[np.float64]


def zone_plate(width: int, height: int, shown: Shown | None = None) -> Scene:
    """Rings (1 + cos(k r^2)) / 2 on two triangles over the whole picture. Half the shorter side from the middle the rings are as fine as
    pixels can show (half a cycle a pixel), beyond finer. With `shown` there is no closed form, and Gauss and Legendre's rule of 12 x 12
    points in its place."""
    x0, y0 = width / 2, height / 2
    strength = math.pi / min(width, height)
    made = shapes.triangles([shapes.rectangle(0, 0, width, height)])

    def shade(triangle: NDArray[np.int32], x: Floats, y: Floats) -> Floats:
        value = 0.5 + 0.5 * np.cos(strength * ((x - x0) ** 2 + (y - y0) ** 2))
        return np.stack([value, value, value, np.ones_like(value)], axis=-1)

    def displayed(triangles: Floats) -> Floats:
        nodes, weights = np.polynomial.legendre.leggauss(12)
        picture = np.zeros((height, width, 4))
        rows, columns = np.arange(height)[:, None], np.arange(width)[None, :]
        for down, high in zip((nodes + 1) / 2, weights / 2, strict=True):
            for across, wide in zip((nodes + 1) / 2, weights / 2, strict=True):
                assert shown is not None
                picture += high * wide * shown(shade(np.empty(0, np.int32), columns + across, rows + down))
        return picture

    def exact(triangles: Floats) -> Floats:
        # cos(k (x^2 + y^2)) is the real part of a product of a function of x and one of y, and so is its integral over a pixel.
        waves = np.outer(_wave(strength, y0, height), _wave(strength, x0, width))
        picture = np.ones((height, width, 4))
        picture[..., :3] = (0.5 + 0.5 * waves.real)[..., None]
        return picture

    def crossed(triangles: Floats) -> NDArray[np.bool_]:
        return np.ones((height, width), bool)

    colors = shapes.painted(len(made), WHITE)
    image = exact if shown is None else displayed
    return Scene("", "", width, height, made, colors, None, BLACK, (), {}, image, False, shade, crossed)


def _wave(strength: float, middle: float, count: int) -> NDArray[np.complex128]:
    """The integral of exp(i k (t - middle)^2) over each of so many pixels, by Gauss and Legendre's rule of 24 points: the phase turns less
    than 4 times within a pixel of the picture, so that it is right to double precision."""
    nodes, weights = np.polynomial.legendre.leggauss(24)
    places = np.arange(count)[:, None] + (nodes + 1) / 2
    return np.asarray(np.exp(1j * strength * (places - middle) ** 2) @ (weights / 2))


LEAF = (0.0, 35.0, 68.0, 180.0, 292.0, 325.0)
"""Degrees around the middle of a leaf at which its corners are: pointed at one end."""

LENGTHS = (1.0, 0.72, 0.45, 0.9, 0.45, 0.72)
"""Their distances from it, in halves of its length."""


def _leaves(width: int, height: int) -> list[list[shapes.Point]]:
    """Leaves at all angles, one in each square of 24 pixels, none over another."""
    side = 24.0
    made = []
    for row in range(int(height // side)):
        for column in range(int(width // side)):
            number = row * int(width // side) + column
            middle = ((column + 0.45 + 0.1 * shapes.spread(number, 0.2)) * side, (row + 0.45 + 0.1 * shapes.spread(number, 0.7)) * side)
            turn = 2 * math.pi * shapes.spread(number)
            made.append(
                [
                    shapes.around(middle, 0.4 * side * length, turn + math.radians(angle))
                    for angle, length in zip(LEAF, LENGTHS, strict=True)
                ]
            )
    return made


def _foliage(width: int, height: int, effect: str, why: str, settings: dict[str, object]) -> Scene:
    leaves = _leaves(width, height)
    cards = []
    for leaf in leaves:
        (left, top), (right, bottom) = np.min(leaf, axis=0), np.max(leaf, axis=0)
        cards.append(shapes.rectangle(left - 1.0, top - 1.0, right + 1.0, bottom + 1.0))
    made = shapes.triangles(cards)
    corners = np.array(leaves)
    along = np.roll(corners, -1, axis=1) - corners
    lengths = np.hypot(along[..., 0], along[..., 1])

    def shade(triangle: NDArray[np.int32], x: Floats, y: Floats) -> Floats:
        leaf = triangle // 2
        inside = np.full(len(leaf), np.inf)
        for side in range(corners.shape[1]):
            (dx, dy), (px, py) = along[leaf, side].T, corners[leaf, side].T
            inside = np.minimum(inside, (dx * (y - py) - dy * (x - px)) / lengths[leaf, side])
        alpha = np.clip(inside + 0.5, 0, 1)
        one = np.ones_like(alpha)
        return np.stack([one, one, one, alpha], axis=-1)

    def exact(triangles: Floats) -> Floats:
        return np.repeat(areas_of(shapes.triangles(leaves), width, height)[..., None], 4, axis=2)

    colors = shapes.painted(len(made), WHITE)
    return Scene("", "", width, height, made, colors, None, BLACK, (effect,), {effect: why}, exact, True, shade, settings=settings)


def foliage(width: int, height: int) -> Scene:
    """Leaves cut out of rectangles by alpha: a texture of the distance to the leaf's edge, half where the edge is, a pixel from 0 to 1."""
    return _foliage(width, height, "alpha-test", "leaves are cut out of their triangles by discarding where alpha is below a half", {})


def foliage_to_coverage(width: int, height: int) -> Scene:
    """The same leaves with alpha to coverage in place of the test."""
    why = "leaves are cut out of their triangles by covering samples in proportion to alpha"
    return _foliage(width, height, "alpha-to-coverage", why, {"alpha-to-coverage": "dithered"})
