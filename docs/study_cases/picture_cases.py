"""Cases of the errors that people see: flicker of an edge that moves, and FLIP."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from fractions import Fraction

import flip_evaluator
import numpy as np
from numpy.typing import NDArray

from msaa_lint.experiments.study import displayed, locations
from msaa_lint.experiments.study.flicker import STEPS, flicker
from msaa_lint.experiments.study.points import COUNTS, GRIDS, MSAA, SSAA, Technique
from msaa_lint.experiments.study.scenes import area, shapes
from msaa_lint.experiments.study.scenes.scene import WHITE, Scene

from .row import Row

SIDE = 64
TECHNIQUES = [
    *(Technique(MSAA, count) for count in COUNTS),
    *(Technique(SSAA, grid * grid, grid=grid) for grid in GRIDS),
]


def half_plane(place: float = SIDE * 5 / 8, upright: bool = False) -> Scene:
    """White below a horizontal edge, or right of an upright one: as it moves, it lies on every row
    of samples once.
    """
    far = 3.0 * SIDE
    corners = (
        shapes.rectangle(place, -far, far, far)
        if upright
        else shapes.rectangle(-far, place, far, far)
    )
    triangles = shapes.triangles([corners])
    colors = shapes.uniform_colors(len(triangles), WHITE)
    return Scene(SIDE, SIDE, triangles, colors, area.disjoint(colors), name="half-plane")


def coverages(technique: Technique) -> list[Fraction]:
    """The coverage of a pixel at each phase of the edge, from its top to its bottom: the share of
    the samples on or below the edge.
    """
    if technique.kind == SSAA:
        heights = [(row + Fraction(1, 2)) / technique.grid for row in range(technique.grid)]
    else:
        heights = [Fraction(int(y), 256) for _, y in locations.standard(technique.samples)]
    phases = [Fraction(step, STEPS) for step in range(STEPS + 1)]
    return [Fraction(sum(height >= phase for height in heights), len(heights)) for phase in phases]


def changes(values: Sequence[Fraction | float]) -> float:
    """The root mean square of the changes of a value."""
    squares = [(values[step + 1] - values[step]) ** 2 for step in range(STEPS)]
    return math.sqrt(sum(squares) / STEPS)


def flickering() -> Iterator[Row]:
    """The flicker of a horizontal edge in 64 phases."""
    scene = half_plane()
    for technique in TECHNIQUES:
        shares = coverages(technique)
        exact = changes([share - (1 - Fraction(step, STEPS)) for step, share in enumerate(shares)])
        double = changes([float(share) - (1 - step / STEPS) for step, share in enumerate(shares)])
        case = (
            f"flicker of a horizontal edge, {technique.name}; naive: the change of the picture "
            "instead of its error"
        )
        yield Row("as seen", case, exact, changes(shares), double, flicker(scene, technique), 1e-14)


def flips() -> Iterator[Row]:
    """FLIP of pictures in one color, whose map is the same everywhere; of equal ones it is 0."""
    black, white = (np.full((256, 256, 3), value, np.float32) for value in (0, 1))
    for picture, words in ((black, "black"), (white, "white")):
        yield Row(
            "as seen",
            f"FLIP of {words} against {words}",
            0,
            _package_mean(picture, picture),
            0,
            displayed.flip(picture, picture),
        )
    flip_map = flip_evaluator.evaluate(white, black, "LDR", applyMagma=False)[0]
    exact = round(float(flip_map[0, 0, 0]), 4)
    results = (
        _package_mean(black, white),
        float(np.mean(flip_map, dtype=np.float64)),
        displayed.flip(black, white),
    )
    case = (
        "FLIP of black against white, 256 x 256 pixels, to 4 digits; naive: the mean that the "
        "package returns"
    )
    yield Row("as seen", case, exact, *(round(result, 4) for result in results))


def _package_mean(measured: NDArray[np.float32], exact: NDArray[np.float32]) -> float:
    return float(flip_evaluator.evaluate(exact, measured, "LDR", applyMagma=False)[1])
