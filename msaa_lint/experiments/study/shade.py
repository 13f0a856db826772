"""Shading: which samples share an invocation, where it is evaluated, and the colors it gives."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .drawing import Batch
from .scenes.scene import Scene

Floats = NDArray[np.float64]


def groups(samples: int, invocations: int) -> tuple[int, ...]:
    """A bit mask per invocation of the samples that share it: consecutive samples, divided as
    evenly as possible.

    Vulkan leaves the grouping open except for one invocation per sample (specification 29.6).
    """
    masks = [0] * invocations
    for sample in range(samples):
        masks[sample * invocations // samples] |= 1 << sample
    return tuple(masks)


def positions(locations: Floats, sample_groups: tuple[int, ...]) -> Floats:
    """Where each invocation is evaluated within the pixel (G, 2): at the pixel center if there is
    only one, otherwise at the mean of its samples' locations.
    """
    if len(sample_groups) == 1:
        return np.array([[0.5, 0.5]])
    return np.array(
        [
            locations[[n for n in range(len(locations)) if bits >> n & 1]].mean(axis=0)
            for bits in sample_groups
        ]
    )


def shade(
    scene: Scene,
    batch: Batch,
    at: Floats,
    grid: int,
    colors: NDArray[np.float32],
    moved: Floats | None = None,
) -> NDArray[np.float32]:
    """The colors (F, G, 4) of a batch.

    `colors` are those of the triangles, used where the scene has no shader; `at` is positions();
    the picture is rendered `grid` times as wide and as high as the scene, which has moved by
    `moved` (F, 2) pixels at each fragment.
    """
    if scene.shade is None:
        return np.take(colors, batch.triangle, axis=0)[:, None]
    # The colors of an invocation are next to each other in memory: they are written at once, and
    # moved at once to their samples.
    shaded = np.empty((len(at), len(batch.triangle), 4), np.float32)
    for number, (x, y) in enumerate(at):
        column, row = (batch.x + x) / grid, (batch.y + y) / grid
        if moved is not None:
            column, row = column - moved[:, 0], row - moved[:, 1]
        shaded[number] = scene.shade(batch.triangle, column, row)
    return shaded.transpose(1, 0, 2)
