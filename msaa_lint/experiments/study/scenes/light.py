"""Scenes of light: brighter than a display, and through glass."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from msaa_lint.experiments.study.effects import tone_mapping

from . import area, shapes, visible
from .scene import BLACK, RGBA, Scene

Floats = NDArray[np.float64]
Shown = Callable[[Floats], Floats]
"""Linear colours to what is displayed of them."""

EMITTER: RGBA = (50.0, 30.0, 12.0, 1.0)
"""A lamp's light, in units of display white."""


def displayed(color: Floats) -> Floats:
    """A colour as Reinhard's tone mapping displays it, in double precision: what the exact picture averages."""
    made = np.array(color, np.float64)
    made[..., :3] = made[..., :3] / (1 + made[..., :3])
    return made


def _emitter(width: int, height: int, place: str) -> Scene:
    """Stars of many edges on black."""
    stars = []
    side = min(width, height) / 2
    for row in range(max(int(height // side), 1)):
        for column in range(max(int(width // side), 1)):
            number = row * 8 + column
            middle = ((column + 0.5) * side, (row + 0.5) * side)
            turn = 2 * math.pi * shapes.spread(number)
            points = [shapes.around(middle, side * (0.46 if n % 2 else 0.24), turn + n * math.pi / 7) for n in range(14)]
            stars += [[middle, points[n], points[(n + 1) % 14]] for n in range(14)]
    made = shapes.triangles(stars)
    colors = shapes.painted(len(made), EMITTER)
    why = {
        "hdr": f"its light is {EMITTER[0]:g} times display white, which 8-bit formats cut off",
        "tone-mapping": {
            "after-resolve": "light is mapped to the display after the resolve, as a later pass does",
            "before-resolve": "samples are mapped to the display before they are averaged",
            "weighted": "samples are averaged with weights of 1 / (1 + luma), then mapped",
        }[place],
    }
    shown = displayed(colors)
    exact = area.disjoint(shown, BLACK, width, height)
    crossed = area.edges_between(shown, width, height)
    effects = ("hdr", "tone-mapping")
    return Scene("", "", width, height, made, colors, None, BLACK, effects, why, exact, False, None, crossed, {"tone-mapping": place})


def emitter(width: int, height: int) -> Scene:
    """Tone mapping after the resolve."""
    return _emitter(width, height, tone_mapping.PLACES[0])


def emitter_before(width: int, height: int) -> Scene:
    """Tone mapping before the resolve."""
    return _emitter(width, height, tone_mapping.PLACES[1])


def emitter_weighted(width: int, height: int) -> Scene:
    """The weighted resolve."""
    return _emitter(width, height, tone_mapping.PLACES[2])


WALL: RGBA = (0.5, 0.5, 0.5, 1.0)


def glass(width: int, height: int, shown: Shown | None = None) -> Scene:
    """Panes of coloured glass over one another before a grey wall."""
    side = min(width, height)
    panes, tints = [shapes.rectangle(0, 0, width, height)], [WALL] * 2
    for number in range(9):
        middle = (width * (0.3 + 0.4 * shapes.spread(number, 0.1)), height * (0.3 + 0.4 * shapes.spread(2 * number, 0.3)))
        turn = 2 * math.pi * shapes.spread(number, 0.4)
        panes.append([shapes.around(middle, side * (0.16 + 0.03 * (number % 4)), turn + n * 2 * math.pi / 5) for n in range(5)])
        alpha = 0.25 + 0.5 * shapes.spread(number, 0.8)
        tints += [(shapes.spread(number, 0.9), shapes.spread(number, 0.2), shapes.spread(number, 0.6), alpha)] * 3
    made, colors = shapes.triangles(panes), np.array(tints)
    look = visible.Look(blended=True)
    exact, crossed = visible.overlapping(colors, None, BLACK, width, height, look, shown)
    why = {"blending": "panes are seen through"}
    return Scene("", "", width, height, made, colors, None, BLACK, ("blending",), why, exact, False, None, crossed)
