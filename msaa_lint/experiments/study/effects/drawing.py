"""What stages work on: a batch of fragments, the samples of a band of the picture, and what is drawn."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Bits = NDArray[np.uint16]
Floats = NDArray[np.float32]
Indices = NDArray[np.intp]


class Drawing(NamedTuple):
    """What holds for a whole draw. Locations are (N, 2) in pixels of the picture that is drawn; `groups` are the samples that each shader
    invocation is of, as bits, one group where a pixel is shaded once. `planes` (T, 3) give depth as a*x + b*y + c."""

    samples: int
    locations: NDArray[np.float64]
    groups: tuple[int, ...]
    settings: Mapping[str, object]
    planes: NDArray[np.float64] | None


class Band:
    """The samples of some rows of the picture: sample by sample, then pixel by pixel. What no effect calls for is None."""

    __slots__ = ("color", "depth", "stencil", "written")

    def __init__(self, color: Floats, depth: Floats | None, stencil: NDArray[np.uint8] | None, written: Bits | None) -> None:
        self.color = color  # (N, P, 4)
        self.depth = depth  # (N, P)
        self.stencil = stencil  # (N, P)
        self.written = written  # (P,): the samples that anything was drawn to


class Batch:
    """Fragments of which no two are of one pixel, F of them. `mask` are the samples that are still to be drawn, as bits; `color` is of each
    group of samples."""

    __slots__ = ("color", "mask", "pixel", "triangle", "x", "y")

    def __init__(self, triangle: NDArray[np.int32], pixel: Indices, x: NDArray[np.int32], y: NDArray[np.int32], mask: Bits) -> None:
        self.triangle = triangle
        self.pixel = pixel
        self.x = x
        self.y = y
        self.mask = mask
        self.color: Floats = np.empty((0, 0, 4), np.float32)  # (F, G, 4)


def chosen(mask: Bits, sample: int) -> NDArray[np.bool_]:
    """Which fragments have a sample in their mask."""
    found: NDArray[np.bool_] = (mask & np.uint16(1 << sample)) != 0
    return found


def group_of(sample: int, groups: tuple[int, ...]) -> int:
    """The group that a sample is shaded with."""
    return next((number for number, bits in enumerate(groups) if bits >> sample & 1), 0)
