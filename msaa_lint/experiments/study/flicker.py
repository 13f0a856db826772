"""Flicker: how much the error of a picture changes from frame to frame while the scene moves by
fractions of a pixel.

The scene moves in 64 steps of 1/64 of a pixel to the right and, at the same time, down in one sweep
and up in another, so that every edge moves across its own direction in at least one of them, and
edges along the axes in both. After 64 steps it has moved by whole pixels: the errors are those of
the beginning, a pixel further on, and so every position of an edge within a pixel counts once.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .displayed import display_codes
from .points import Technique
from .scenes.part import Part
from .scenes.scene import Scene
from .scenes.shapes import spread
from .scenes.view import snapped
from .simulate import BAND_SAMPLES, Simulator
from .sums import Sum, difference

STEPS = 64
"""Steps of a sweep, each of 1/STEPS pixel in x and in y."""

SWEEPS = ((1, 1), (1, -1))
"""The directions in x and y."""

SIDE = 16
"""The width and height of a window in pixels."""

SHARE, MIN_WINDOWS, MAX_WINDOWS = 64, 4, 32
"""One in SHARE of the windows that an edge crosses is looked at, within these limits."""

OFFSET = 77 / 256
"""How far the scene has moved, in pixels, where edges are looked for: edges that lie between
pixels, as many do, are within pixels then.
"""

SWEEPS_AT_A_TIME = 8
"""Sweeps whose exact pictures are computed together."""


Sweep = list[Part]
"""A window at each step of a sweep, the first and the last included."""


class _Exact(NamedTuple):
    """What errors are measured against, in the windows of every step of every sweep: coverage (S,
    STEPS + 1, pixels, 1) or displayed color (..., 3), and the pixels that an edge crosses.
    """

    values: NDArray[np.floating]
    edges: NDArray[np.bool_]


def flicker(scene: Scene, technique: Technique, bits: int = 8) -> float:
    """The root mean square of the change of the error in one step, over the pixels that an edge
    crosses before or after the step: of coverage, or of the displayed color (sRGB codes in [0, 1])
    for scenes without coverage.
    """
    simulator = Simulator(scene, technique, bits)
    sweeps = [_sweep(window, direction) for window in windows(scene, bits) for direction in SWEEPS]
    exact = _exact(simulator, sweeps)
    squares = Sum()
    samples = (STEPS + 1) * SIDE * SIDE * simulator.grid**2 * simulator.samples
    for which in _slices(len(sweeps), max(BAND_SAMPLES // samples, 1)):
        measured, edges = _measured(simulator, sweeps[which]), exact.edges[which]
        error = difference(measured, exact.values[which])
        change = (error[:, 1:] - error[:, :-1])[edges[:, 1:] | edges[:, :-1]]
        squares.add(change * change)
    return math.sqrt(squares.total() / squares.count) if squares.count else 0.0


def _measured(simulator: Simulator, sweeps: Sequence[Sweep]) -> NDArray[np.floating]:
    simulation = simulator.render([part for sweep in sweeps for part in sweep])
    return _by_step(_quantity(simulator.scene, simulation.image, simulation.coverage), len(sweeps))


def _exact(simulator: Simulator, sweeps: Sequence[Sweep]) -> _Exact:
    """The exact values, as the technique snaps the triangles; the last ones of multisampling are
    cached.
    """
    scene, bits, grid = simulator.scene, simulator.bits, simulator.grid
    for cached_scene, cached_bits, cached in _EXACT:
        if cached_scene is scene and (cached_bits, 1) == (bits, grid):
            return cached
    values, edges = [], []
    for which in _slices(len(sweeps), SWEEPS_AT_A_TIME):
        truth = scene.exact(
            simulator.snapped([part for sweep in sweeps[which] for part in sweep]).view()
        )
        count = len(sweeps[which])
        values.append(_by_step(_quantity(scene, truth.image, truth.image[..., 3]), count))
        edges.append(truth.edge_pixels.reshape(count, STEPS + 1, -1))
    exact = (
        _Exact(np.concatenate(values), np.concatenate(edges))
        if values
        else _Exact(np.empty(0), np.empty(0, bool))
    )
    if grid == 1:
        _EXACT[:] = [(scene, bits, exact)]
    return exact


def _quantity(
    scene: Scene, image: NDArray[np.floating], coverage: NDArray[np.floating] | None
) -> NDArray[np.floating]:
    """What errors are of: coverage (..., 1), or displayed color (..., 3)."""
    return (
        coverage[..., None]
        if scene.coverage_matter and coverage is not None
        else display_codes(scene, image)
    )


def _by_step(values: NDArray[np.floating], sweeps: int) -> NDArray[np.floating]:
    return values.reshape(sweeps, STEPS + 1, SIDE * SIDE, values.shape[-1])


def _slices(count: int, step: int) -> list[slice]:
    return [slice(start, start + step) for start in range(0, count, step)]


def _sweep(window: Part, direction: tuple[int, int]) -> Sweep:
    x, y = direction
    return [window._replace(dx=x * step / STEPS, dy=y * step / STEPS) for step in range(STEPS + 1)]


def windows(scene: Scene, bits: int = 8) -> list[Part]:
    """The windows of a scene that are looked at: some of those that an edge crosses, evenly spread.
    The last scene's are cached.
    """
    for cached_scene, cached_bits, cached in _WINDOWS:
        if cached_scene is scene and cached_bits == bits:
            return cached
    crossed = []
    for top in range(0, scene.height - SIDE + 1, SIDE):
        band = Part(0, top, scene.width, SIDE, OFFSET, OFFSET)
        edge_pixels = scene.exact(snapped(scene.triangles, [band], bits=bits).view()).edge_pixels[0]
        columns = (
            edge_pixels.any(axis=0)[: scene.width // SIDE * SIDE].reshape(-1, SIDE).any(axis=1)
        )
        crossed += [Part(int(column) * SIDE, top, SIDE, SIDE) for column in np.flatnonzero(columns)]
    count = min(max(-(-len(crossed) // SHARE), MIN_WINDOWS), MAX_WINDOWS, len(crossed))
    # One from each of as many equal parts of the list, at varying places, so that no pattern of the
    # scene recurs.
    chosen = [
        crossed[int((number + spread(number)) * len(crossed) / count)] for number in range(count)
    ]
    _WINDOWS[:] = [(scene, bits, chosen)]
    return chosen


_WINDOWS: list[tuple[Scene, int, list[Part]]] = []
_EXACT: list[tuple[Scene, int, _Exact]] = []
