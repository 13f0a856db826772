"""A disc in front of a tilted wall, with its depth at every sample in rational arithmetic."""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction
from typing import NamedTuple

import numpy as np

from msaa_lint.experiments.study import locations, snap
from msaa_lint.experiments.study.points import MSAA, Technique
from msaa_lint.experiments.study.scenes import area, shapes
from msaa_lint.experiments.study.scenes.scene import BLACK, WHITE, Scene
from msaa_lint.experiments.study.simulate import Simulation, simulate
from tests.experiments.study.rational import covers, edge

SIDE = 32
"""Pixels across the picture."""

SEGMENTS = 24
NEAR_PLANE = 0.1
"""Meters. Reversed depth is this over the distance, standard depth 1 minus that; both are planes on
the screen.
"""


class Surface(NamedTuple):
    """A triangle at a sample: its depth there, exactly, in D32_SFLOAT, and by a plane in single
    precision.
    """

    exact: Fraction
    stored: float
    by_plane: float


class Sample(NamedTuple):
    """A sample of a pixel, with the disc, None beside it, and the wall behind."""

    pixel: tuple[int, int]
    disc: Surface | None
    wall: Surface


GAP = 0.1
"""Meters between the disc and the wall."""


def scene(reversed_depth: bool, mode: str) -> Scene:
    """The disc in front of a wall that is 1,000 meters away at its left and 1,200 at its right. The
    disc is white.
    """
    disc = [
        shapes.polar((SIDE / 2, SIDE / 2), SIDE * 0.4, 2 * math.pi * (n + shapes.GOLDEN) / SEGMENTS)
        for n in range(SEGMENTS)
    ]
    triangles = shapes.triangles([shapes.rectangle(0, 0, SIDE, SIDE), disc])
    distance = 1 / (1 / 1000 + (1 / 1200 - 1 / 1000) * triangles[..., 0] / SIDE)
    distance[2:] -= GAP
    depths = NEAR_PLANE / distance
    colors = shapes.uniform_colors(len(triangles), WHITE)
    colors[:2] = BLACK
    settings = {"depth-test": "GREATER" if reversed_depth else "LESS", "depth-resolve": mode}
    return Scene(
        SIDE, SIDE, triangles, colors, area.disjoint(colors), False,
        depths if reversed_depth else 1 - depths,
        ("depth-test", "depth-resolve"), {}, settings,
    )  # fmt: skip


def rendered(silhouette: Scene, samples: int) -> Simulation:
    return simulate(silhouette, Technique(MSAA, samples))


def edge_samples(silhouette: Scene, samples: int) -> list[Sample]:
    """The samples of the pixels that the outline crosses, pixel by pixel, in their order."""
    assert silhouette.depths is not None
    triangles = snap.snapped(silhouette.triangles)
    corners = [[(int(x), int(y)) for x, y in triangle] for triangle in triangles]
    planes = shapes.depth_planes(triangles / 256, silhouette.depths).astype(np.float32)
    depths = [[Fraction(float(depth)) for depth in corner] for corner in silhouette.depths]

    def surface(triangle: int, at: tuple[int, int]) -> Surface:
        exact = depth_at(corners[triangle], depths[triangle], at)
        a, b, c = planes[triangle]
        return Surface(
            exact,
            single(exact),
            float(a * np.float32(at[0] / 256) + b * np.float32(at[1] / 256) + c),
        )

    found = []
    for row, column in np.ndindex(SIDE, SIDE):
        at = [(column * 256 + int(x), row * 256 + int(y)) for x, y in locations.standard(samples)]
        over = [
            next((n for n in range(2, len(corners)) if covers(corners[n], place)), None)
            for place in at
        ]
        if all(over) or not any(over):
            continue
        for place, disc in zip(at, over, strict=True):
            wall = next(n for n in range(2) if covers(corners[n], place))
            found.append(
                Sample(
                    (row, column),
                    None if disc is None else surface(disc, place),
                    surface(wall, place),
                )
            )
    return found


def depth_at(
    triangle: Sequence[tuple[int, int]], depths: Sequence[Fraction], at: tuple[int, int]
) -> Fraction:
    """The depth of a triangle's plane at a point, by areas."""
    a, b, c = triangle
    shares = edge(b, c, at), edge(c, a, at), edge(a, b, at)
    return sum(
        (depth * share for depth, share in zip(depths, shares, strict=True)), Fraction(0)
    ) / edge(a, b, c)


def single(value: Fraction) -> float:
    """The nearest single-precision number, ties to even, as D32_SFLOAT holds it."""
    guess = np.float32(float(value))
    beside = [np.nextafter(guess, np.float32(toward)) for toward in (-np.inf, np.inf)]
    candidates = [guess, *beside]
    return float(
        min(
            candidates,
            key=lambda one: (abs(Fraction(float(one)) - value), int(one.view(np.uint32)) & 1),
        )
    )
