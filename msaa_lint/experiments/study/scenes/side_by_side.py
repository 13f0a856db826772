"""Scenes side by side: a picture whose parts each show one thing."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from .scene import Scene
from .view import Truth, View

Floats = NDArray[np.float64]


def side_by_side(parts: Sequence[Scene], width: int, height: int) -> Scene:
    """One scene of several, from the left, with black in what remains at the right; each part is
    `height` pixels high.

    The effects and settings are those of all parts. With a depth test, a part without depths gets
    some with which triangles drawn later are nearer.
    """
    lefts = np.cumsum([0, *(part.width for part in parts)])
    firsts = [int(first) for first in np.cumsum([0, *(len(part.triangles) for part in parts)])]
    triangles = np.concatenate(
        [part.triangles + np.array((left, 0)) for part, left in zip(parts, lefts, strict=False)]
    )
    colors = np.concatenate([part.colors for part in parts])
    effects = tuple(dict.fromkeys(name for part in parts for name in part.effects))
    why = {name: reason for part in parts for name, reason in part.why.items()}
    settings = {name: value for part in parts for name, value in part.settings.items()}
    for part, first in zip(parts, firsts, strict=False):
        if "stencil" in part.settings:
            settings["stencil"] = tuple(first + n for n in part.settings["stencil"])  # type: ignore[attr-defined]
    depths = None
    if "depth-test" in effects:
        greater = str(settings.get("depth-test", "LESS")).startswith("GREATER")
        depths = np.concatenate(
            [
                _depths_in_order(part, greater) if part.depths is None else part.depths
                for part in parts
            ]
        )

    def exact(view: View) -> Truth:
        window = view.parts[0]
        size = (len(view.parts), window.height, window.width)
        truth = Truth(np.zeros((*size, 4)), np.zeros(size, bool))
        for number, part in enumerate(parts):
            own = (view.triangle >= firsts[number]) & (view.triangle < firsts[number + 1])
            if own.any():
                _add(truth, part, view.only(own), firsts[number], int(lefts[number]))
        return truth

    def shade(triangle: NDArray[np.int32], x: Floats, y: Floats) -> Floats:
        shaded = colors[triangle]
        for number, part in enumerate(parts):
            if part.shade is not None:
                inside = (triangle >= firsts[number]) & (triangle < firsts[number + 1])
                shaded[inside] = part.shade(
                    triangle[inside] - np.int32(firsts[number]),
                    x[inside] - lefts[number],
                    y[inside],
                )
        return shaded

    shader = shade if any(part.shade is not None for part in parts) else None
    coverage = all(part.coverage_matter for part in parts)
    return Scene(
        width, height, triangles, colors, exact, coverage, depths, effects, why, settings, shader
    )


def _depths_in_order(part: Scene, greater: bool) -> Floats:
    count = len(part.triangles)
    nearer = 0.5 + 0.25 * np.arange(count) / count
    return np.repeat((nearer if greater else 1 - nearer)[:, None], 3, axis=1)


def _add(truth: Truth, scene: Scene, view: View, first: int, left: int) -> None:
    """Adds one of the scenes to the exact picture of some parts; its first triangle is `first`, and
    it begins at column `left`. What of it moves beyond its columns is added to what is there.
    """
    parts = [part._replace(left=part.left - left) for part in view.parts]
    exact = scene.exact(View(parts, view.triangle - first, view.part, view.corners - (left, 0)))
    truth.image[...] += exact.image
    truth.edge_pixels[...] |= exact.edge_pixels
