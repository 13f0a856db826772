"""Scenes of depth and stencil: edges that no triangle has, and surfaces behind one another."""

from __future__ import annotations

import math

import numpy as np

from . import area, shapes, visible
from .light import Display
from .scene import BLACK, RGBA, WHITE, Scene

NEAR: RGBA = (0.9, 0.35, 0.05, 1.0)
FAR: RGBA = (0.05, 0.3, 0.8, 1.0)


def _intersecting(
    width: int,
    height: int,
    depths: tuple[float, float],
    greater: bool,
    display: Display | None = None,
) -> Scene:
    """Two sheets of 8 strips each that intersect along lines at many angles.

    With reversed depth, depth is `depths[0]` at the intersection and differs from it by at most
    `depths[1]`; standard depth is 1 minus that.
    """
    count = 8
    strips, offsets, colors = [], [], []
    reach = height / 2
    for number in range(count):
        left, right = width * number / count, width * (number + 1) / count
        middle = (left + right) / 2
        angle = math.pi * (number + shapes.GOLDEN / 2) / count
        for side, color in ((1.0, NEAR), (-1.0, FAR)):
            corners = shapes.rectangle(left, 0, right, height)
            strips.append(corners)
            # A plane that is 0 along a line through the center of the strip, at the strip's angle.
            tilt = [
                side
                * ((x - middle) * math.sin(angle) - (y - height / 2) * math.cos(angle))
                / (2 * reach)
                for x, y in corners
            ]
            offsets += [[tilt[0], tilt[1], tilt[2]], [tilt[0], tilt[2], tilt[3]]]
            colors += [color, color]
    triangles = shapes.triangles(strips)
    nearness_values = depths[0] + depths[1] * np.array(offsets)
    corner_colors = np.array(colors)
    depths_stored = nearness_values if greater else 1 - nearness_values
    comparison = "GREATER" if greater else "LESS"
    # The exact picture has the intersection itself, before any rounding of depth: it uses the
    # nearness.
    exact = visible.overlapping(
        corner_colors,
        nearness_values,
        width,
        height,
        visible.Visibility(depth=True, reversed=True),
        display,
    )
    why = {
        "depth-test": f"surfaces intersect; {'reversed' if greater else 'standard'} depth, "
        f"{comparison}"
    }
    settings = {"depth-test": comparison}
    return Scene(
        width,
        height,
        triangles,
        corner_colors,
        exact,
        False,
        depths_stored,
        ("depth-test",),
        why,
        settings,
    )


def intersecting(width: int, height: int, display: Display | None = None) -> Scene:
    """Near surfaces, standard depth."""
    return _intersecting(width, height, (0.5, 0.4), False, display)


def intersecting_reversed(width: int, height: int, display: Display | None = None) -> Scene:
    """Near surfaces, reversed depth."""
    return _intersecting(width, height, (0.5, 0.4), True, display)


def intersecting_far(width: int, height: int) -> Scene:
    """Surfaces a thousand times as far away as the near plane, where standard depth has few
    distinct values.
    """
    return _intersecting(width, height, (1e-3, 1e-6), False)


def intersecting_far_reversed(width: int, height: int) -> Scene:
    """The same distant surfaces with reversed depth."""
    return _intersecting(width, height, (1e-3, 1e-6), True)


def silhouette(width: int, height: int) -> Scene:
    """A near disc in front of a far wall, whose depth a later pass reads."""
    side = min(width, height)
    disc = [
        shapes.polar((width / 2, height / 2), side * 0.4, 2 * math.pi * (n + shapes.GOLDEN) / 64)
        for n in range(64)
    ]
    triangles = shapes.triangles([shapes.rectangle(0, 0, width, height), disc])
    depths = np.full((len(triangles), 3), 0.25)
    depths[:2] = 0.75
    colors = shapes.uniform_colors(len(triangles), WHITE)
    colors[:2] = BLACK
    exact = area.disjoint(colors, covered=False)
    why = {
        "depth-test": "the disc is in front of the wall",
        "depth-resolve": "a later pass reads one depth per pixel and needs that of a surface: "
        "SAMPLE_ZERO",
    }
    settings = {"depth-test": "LESS", "depth-resolve": "SAMPLE_ZERO"}
    return Scene(
        width,
        height,
        triangles,
        colors,
        lambda view: exact(view.only(view.triangle >= 2)),
        False,
        depths,
        tuple(why),
        why,
        settings,
    )


def portal(width: int, height: int) -> Scene:
    """A window that is marked in stencil, and a wall drawn only through it, so that the edge exists
    in stencil alone.
    """
    side = min(width, height)
    window = [
        shapes.polar(
            (width / 2, height / 2),
            side * (0.45 if n % 2 else 0.36),
            2 * math.pi * (n + shapes.GOLDEN) / 24,
        )
        for n in range(24)
    ]
    middle = (width / 2, height / 2)
    marks = shapes.triangles([[middle, window[n], window[(n + 1) % 24]] for n in range(24)])
    triangles = np.concatenate([marks, shapes.triangles([shapes.rectangle(0, 0, width, height)])])
    colors = shapes.uniform_colors(len(triangles), WHITE)
    count = len(marks)
    exact = area.disjoint(colors)
    why = {"stencil": "the wall is drawn only on the samples that a window marked"}
    settings = {"stencil": (0, count, len(triangles))}
    scene = Scene(
        width, height, triangles, colors, lambda view: exact(view.only(view.triangle < count))
    )
    return scene._replace(effects=("stencil",), why=why, settings=settings)
