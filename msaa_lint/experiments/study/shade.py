"""Shading: which samples an invocation is of, where it is evaluated, and what it gives."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .effects.drawing import Batch, Drawing
from .scenes.scene import Scene

Floats = NDArray[np.float64]


def groups(samples: int, invocations: int) -> tuple[int, ...]:
    """The samples of each invocation, as bits: neighbours in the order of samples, as evenly as they divide.

    Vulkan leaves the choice open but for one invocation a sample (specification 29.6).
    """
    made = [0] * invocations
    for sample in range(samples):
        made[sample * invocations // samples] |= 1 << sample
    return tuple(made)


def places(locations: Floats, shared: tuple[int, ...]) -> Floats:
    """Where each invocation is evaluated within the pixel (G, 2): the middle of the pixel for the only one, the sample's own place for that
    of one sample, else the mean of its samples' places."""
    if len(shared) == 1:
        return np.array([[0.5, 0.5]])
    return np.array([locations[[n for n in range(len(locations)) if bits >> n & 1]].mean(axis=0) for bits in shared])


def shaded(scene: Scene, batch: Batch, drawing: Drawing, at: Floats, grid: int, colors: NDArray[np.float32]) -> NDArray[np.float32]:
    """The colours (F, G, 4) of a batch. `colors` are the triangles', which they are where nothing else shades; `at` is places(); the
    picture is drawn `grid` times as large."""
    if scene.shade is None:
        return colors[batch.triangle][:, None]
    made = np.empty((len(batch.triangle), len(at), 4), np.float32)
    for number, (across, down) in enumerate(at):
        made[:, number] = scene.shade(batch.triangle, (batch.x + across) / grid, (batch.y + down) / grid)
    return made


def planes(corners: Floats, depths: Floats) -> Floats:
    """The depth of each triangle as a plane (T, 3): a*x + b*y + c in pixels, of corners (T, 3, 2) in pixels; a and b are 0 for one without
    area."""
    (x0, y0), (x1, y1), (x2, y2) = (corners[:, n].T for n in range(3))
    z0, z1, z2 = depths.T
    area = (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)
    some = area != 0
    whole = np.where(some, area, 1.0)
    a = np.where(some, ((z1 - z0) * (y2 - y0) - (z2 - z0) * (y1 - y0)) / whole, 0.0)
    b = np.where(some, ((z2 - z0) * (x1 - x0) - (z1 - z0) * (x2 - x0)) / whole, 0.0)
    return np.stack([a, b, z0 - a * x0 - b * y0], axis=1)
