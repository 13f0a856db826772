"""Scenes of light: brighter than a display can show, and through glass."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from msaa_lint.experiments.study.resolve import TONE_MAPPING

from . import area, shapes, visible
from .scene import RGBA, Scene

Floats = NDArray[np.float64]
Display = Callable[[Floats], Floats]
"""Linear colors to displayed colors."""

EMITTER: RGBA = (50.0, 30.0, 12.0, 1.0)
"""A lamp's light, in units of display white."""


def display(color: Floats) -> Floats:
    """A color after Reinhard's tone mapping, in double precision: what the exact picture
    averages.
    """
    mapped = np.array(color, np.float64)
    mapped[..., :3] = mapped[..., :3] / (1 + mapped[..., :3])
    return mapped


def _emitter(width: int, height: int, place: str) -> Scene:
    """Stars with many edges on black."""
    stars = []
    side = min(width, height) / 2
    for row in range(max(int(height // side), 1)):
        for column in range(max(int(width // side), 1)):
            number = row * 8 + column
            center = ((column + 0.5) * side, (row + 0.5) * side)
            rotation = 2 * math.pi * shapes.spread(number)
            points = [
                shapes.polar(center, side * (0.46 if n % 2 else 0.24), rotation + n * math.pi / 7)
                for n in range(14)
            ]
            stars += [[center, points[n], points[(n + 1) % 14]] for n in range(14)]
    triangles = shapes.triangles(stars)
    colors = shapes.uniform_colors(len(triangles), EMITTER)
    why = {
        "hdr": f"its light is {EMITTER[0]:g} times display white, which 8-bit formats clip",
        "tone-mapping": {
            "after-resolve": "light is mapped to the display after the resolve, as a later pass "
            "does",
            "before-resolve": "samples are mapped to the display before they are averaged",
            "weighted": "samples are averaged with weights of 1 / (1 + luma), then mapped",
        }[place],
    }
    exact = area.disjoint(display(colors), covered=False)
    return Scene(
        width,
        height,
        triangles,
        colors,
        exact,
        False,
        None,
        tuple(why),
        why,
        {"tone-mapping": place},
    )


def emitter(width: int, height: int) -> Scene:
    """Tone mapping after the resolve."""
    return _emitter(width, height, TONE_MAPPING[0])


def emitter_before(width: int, height: int) -> Scene:
    """Tone mapping before the resolve."""
    return _emitter(width, height, TONE_MAPPING[1])


def emitter_weighted(width: int, height: int) -> Scene:
    """The weighted resolve."""
    return _emitter(width, height, TONE_MAPPING[2])


WALL: RGBA = (0.5, 0.5, 0.5, 1.0)


def glass(width: int, height: int, display: Display | None = None) -> Scene:
    """Overlapping panes of colored glass in front of a gray wall."""
    side = min(width, height)
    panes, tints = [shapes.rectangle(0, 0, width, height)], [WALL] * 2
    for number in range(9):
        center = (
            width * (0.3 + 0.4 * shapes.spread(number, 0.1)),
            height * (0.3 + 0.4 * shapes.spread(2 * number, 0.3)),
        )
        rotation = 2 * math.pi * shapes.spread(number, 0.4)
        panes.append(
            [
                shapes.polar(
                    center, side * (0.16 + 0.03 * (number % 4)), rotation + n * 2 * math.pi / 5
                )
                for n in range(5)
            ]
        )
        alpha = 0.25 + 0.5 * shapes.spread(number, 0.8)
        tints += [
            (
                shapes.spread(number, 0.9),
                shapes.spread(number, 0.2),
                shapes.spread(number, 0.6),
                alpha,
            )
        ] * 3
    triangles, colors = shapes.triangles(panes), np.array(tints)
    exact = visible.overlapping(
        colors, None, width, height, visible.Visibility(blended=True), display
    )
    why = {"blending": "the panes are transparent"}
    return Scene(width, height, triangles, colors, exact, False, None, ("blending",), why)
