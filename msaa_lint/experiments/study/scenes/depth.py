"""Scenes of depth and stencil: edges that no triangle has, and surfaces one behind the other."""

from __future__ import annotations

import math

import numpy as np

from . import area, shapes, visible
from .light import Shown
from .scene import BLACK, RGBA, WHITE, Scene

NEAR: RGBA = (0.9, 0.35, 0.05, 1.0)
FAR: RGBA = (0.05, 0.3, 0.8, 1.0)


def _intersecting(width: int, height: int, depths: tuple[float, float], greater: bool, shown: Shown | None = None) -> Scene:
    """Two sheets of 8 strips each that go through each other along lines at many angles. Depth is `depths[0]` at the crossing and differs
    by at most `depths[1]`; it is kept as 1 less that with standard depth."""
    count = 8
    strips, nearness, colors = [], [], []
    reach = height / 2
    for number in range(count):
        left, right = width * number / count, width * (number + 1) / count
        middle = (left + right) / 2
        angle = math.pi * (number + shapes.GOLDEN / 2) / count
        for side, color in ((1.0, NEAR), (-1.0, FAR)):
            corners = shapes.rectangle(left, 0, right, height)
            strips.append(corners)
            # A plane that is 0 along a line through the strip's middle, at the strip's own angle.
            tilt = [side * ((x - middle) * math.sin(angle) - (y - height / 2) * math.cos(angle)) / (2 * reach) for x, y in corners]
            nearness += [[tilt[0], tilt[1], tilt[2]], [tilt[0], tilt[2], tilt[3]]]
            colors += [color, color]
    made = shapes.triangles(strips)
    near = depths[0] + depths[1] * np.array(nearness)
    tints = np.array(colors)
    stored = near if greater else 1 - near
    comparison = "GREATER" if greater else "LESS"
    # What is due is the crossing line itself, whatever depth is kept in: of the nearness before it is rounded.
    exact, crossed = visible.overlapping(tints, near, BLACK, width, height, visible.Look(depth=True, reversed=True), shown)
    why = {"depth-test": f"surfaces go through each other; {'reversed' if greater else 'standard'} depth, {comparison}"}
    return Scene(
        "", "", width, height, made, tints, stored, BLACK, ("depth-test",), why, exact, False, None, crossed, {"depth-test": comparison}
    )


def intersecting(width: int, height: int, shown: Shown | None = None) -> Scene:
    """Near, standard depth."""
    return _intersecting(width, height, (0.5, 0.4), False, shown)


def intersecting_reversed(width: int, height: int, shown: Shown | None = None) -> Scene:
    """Near, reversed depth."""
    return _intersecting(width, height, (0.5, 0.4), True, shown)


def intersecting_far(width: int, height: int) -> Scene:
    """A thousand times as far as the near plane, where standard depth has few values left."""
    return _intersecting(width, height, (1e-3, 1e-6), False)


def intersecting_far_reversed(width: int, height: int) -> Scene:
    """As far, with reversed depth."""
    return _intersecting(width, height, (1e-3, 1e-6), True)


def silhouette(width: int, height: int) -> Scene:
    """A near disc before a far wall, whose depth a later pass reads."""
    side = min(width, height)
    disc = [shapes.around((width / 2, height / 2), side * 0.4, 2 * math.pi * (n + shapes.GOLDEN) / 64) for n in range(64)]
    made = shapes.triangles([shapes.rectangle(0, 0, width, height), disc])
    depths = np.full((len(made), 3), 0.25)
    depths[:2] = 0.75
    colors = shapes.painted(len(made), WHITE)
    colors[:2] = BLACK
    exact = area.disjoint(colors[2:], BLACK, width, height)
    why = {
        "depth-test": "the disc is before the wall",
        "depth-resolve": "a later pass reads one depth for a pixel, and wants a surface's: SAMPLE_ZERO",
    }
    settings: dict[str, object] = {"depth-test": "LESS", "depth-resolve": "SAMPLE_ZERO"}
    crossed = area.edges_between(colors[2:], width, height)
    return Scene("", "", width, height, made, colors, depths, BLACK, ("depth-test", "depth-resolve"), why,
                 lambda triangles: exact(triangles[2:]), False, None, lambda triangles: crossed(triangles[2:]), settings)  # fmt: skip


def portal(width: int, height: int) -> Scene:
    """A window that is marked in stencil, and a wall drawn only through it: its edge is in stencil alone."""
    side = min(width, height)
    window = [
        shapes.around((width / 2, height / 2), side * (0.45 if n % 2 else 0.36), 2 * math.pi * (n + shapes.GOLDEN) / 24) for n in range(24)
    ]
    middle = (width / 2, height / 2)
    marks = shapes.triangles([[middle, window[n], window[(n + 1) % 24]] for n in range(24)])
    made = np.concatenate([marks, shapes.triangles([shapes.rectangle(0, 0, width, height)])])
    colors = shapes.painted(len(made), WHITE)
    count = len(marks)
    exact = area.disjoint(colors[:count], BLACK, width, height)
    why = {"stencil": "the wall is drawn where a window marked samples"}
    return Scene("", "", width, height, made, colors, None, BLACK, ("stencil",), why,
                 lambda triangles: exact(triangles[:count]), settings={"stencil": (0, count, len(made))})  # fmt: skip
