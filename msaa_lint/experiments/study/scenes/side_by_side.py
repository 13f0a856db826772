"""Scenes side by side: a picture whose parts each show one thing that is called for."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from .area import NOTHING
from .scene import BLACK, RGBA, Scene

Floats = NDArray[np.float64]


def beside(parts: Sequence[Scene], width: int, height: int) -> Scene:
    """One scene of several, from the left; each is height pixels high, all of them width wide, and what is left at the right is background.
    Effects are those of any part, settings those of all; parts that have no depth get one in which what is drawn later is nearer."""
    lefts = np.cumsum([0, *(part.width for part in parts)])
    firsts = [int(first) for first in np.cumsum([0, *(len(part.triangles) for part in parts)])]
    triangles = np.concatenate([part.triangles + np.array((left, 0)) for part, left in zip(parts, lefts, strict=False)])
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
        depths = np.concatenate([_ordered(part, greater) if part.depths is None else part.depths for part in parts])

    def each(given: Floats) -> list[tuple[Scene, Floats]]:
        return [(part, given[firsts[n] : firsts[n + 1]] - (lefts[n], 0)) for n, part in enumerate(parts)]

    def exact(given: Floats) -> Floats:
        return _filled([part.exact(own) for part, own in each(given)], BLACK, width)

    def crossed(given: Floats) -> NDArray[np.bool_]:
        found = np.zeros((height, width), bool)
        for (part, own), left in zip(each(given), lefts, strict=False):
            found[:, left : left + part.width] = _crossed(part, own)
        return found

    def shade(triangle: NDArray[np.int32], x: Floats, y: Floats) -> Floats:
        made = colors[triangle]
        for number, part in enumerate(parts):
            if part.shade is not None:
                own = (triangle >= firsts[number]) & (triangle < firsts[number + 1])
                made[own] = part.shade(triangle[own] - np.int32(firsts[number]), x[own] - lefts[number], y[own])
        return made

    shaded = shade if any(part.shade is not None for part in parts) else None
    coverage = all(part.coverage_matter for part in parts)
    return Scene("", "", width, height, triangles, colors, depths, BLACK, effects, why, exact, coverage, shaded, crossed, settings)


def _ordered(part: Scene, greater: bool) -> Floats:
    count = len(part.triangles)
    nearer = 0.5 + 0.25 * np.arange(count) / count
    return np.repeat((nearer if greater else 1 - nearer)[:, None], 3, axis=1)


def _crossed(part: Scene, triangles: Floats) -> NDArray[np.bool_]:
    if part.crossed is not None:
        return part.crossed(triangles)
    alpha = part.exact(triangles)[..., 3]
    found: NDArray[np.bool_] = (alpha > NOTHING) & (alpha < 1 - NOTHING)
    return found


def _filled(pictures: list[Floats], background: RGBA, width: int) -> Floats:
    made = np.concatenate(pictures, axis=1)
    rest = np.empty((made.shape[0], width - made.shape[1], 4))
    rest[:] = background
    return np.concatenate([made, rest], axis=1)
