"""The data that the stages of a draw share: the draw's constants, a batch of fragments, and a band
of the picture's samples.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Bits = NDArray[np.uint16]
Floats = NDArray[np.float32]
Indices = NDArray[np.intp]


class Drawing(NamedTuple):
    """The constants of a draw.

    `locations` (N, 2) are the sample locations in pixels of the rendered picture. `groups` holds a
    bit mask per shader invocation: the samples that the invocation shades; there is a single group
    when each pixel is shaded once. `planes` (S, 3) give the depth of a triangle, where it is drawn,
    as a*x + b*y + c.
    """

    samples: int
    locations: NDArray[np.float64]
    groups: tuple[int, ...]
    settings: Mapping[str, object]
    planes: NDArray[np.float64] | None


class Band:
    """The samples of parts of the picture, indexed by sample (N), then by pixel (P). Arrays that no
    effect needs are None.
    """

    __slots__ = ("color", "depth", "stencil", "written")

    def __init__(
        self,
        color: Floats,
        depth: Floats | None,
        stencil: NDArray[np.uint8] | None,
        written: Bits | None,
    ) -> None:
        self.color = color  # (N, P, 4)
        self.depth = depth  # (N, P)
        self.stencil = stencil  # (N, P)
        self.written = written  # (P,): bit mask of the samples that were drawn to


class Batch:
    """F fragments of distinct pixels. `mask` is a bit mask of the samples still to be drawn;
    `color` holds one color per sample group.

    `pixel` indexes the band's samples, `x` and `y` are the place in the rendered picture,
    `triangle` is the scene's number of the triangle, and `plane` that of its depth plane.
    """

    __slots__ = ("color", "mask", "pixel", "plane", "triangle", "x", "y")

    def __init__(
        self,
        triangle: NDArray[np.int32],
        pixel: Indices,
        x: NDArray[np.int32],
        y: NDArray[np.int32],
        mask: Bits,
    ) -> None:
        self.triangle = triangle
        self.plane = triangle
        self.pixel = pixel
        self.x = x
        self.y = y
        self.mask = mask
        self.color: Floats = np.empty((0, 0, 4), np.float32)  # (F, G, 4)


def has_sample(mask: Bits, sample: int) -> NDArray[np.bool_]:
    """For each fragment, whether its mask contains a sample."""
    selected: NDArray[np.bool_] = (mask & np.uint16(1 << sample)) != 0
    return selected


def group_of(sample: int, groups: tuple[int, ...]) -> int:
    """The index of the group that a sample is shaded with."""
    return next((number for number, bits in enumerate(groups) if bits >> sample & 1), 0)
