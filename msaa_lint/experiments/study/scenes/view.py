"""Parts of a scene's picture: the triangles near them, and the exact picture there."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from msaa_lint.experiments.study import snap
from msaa_lint.experiments.study.exact_area import areas_of
from msaa_lint.experiments.study.locations import SUBPIXELS

from .part import Part

Floats = NDArray[np.float64]


class View(NamedTuple):
    """The triangles near some parts of a picture; the parts are all of one size.

    `triangle` (S,) are the scene's numbers of the triangles, in order within each part, `part` (S,)
    the parts that they are near, and `corners` (S, 3, 2) their snapped corners in pixels of the
    picture, moved as the scene is in that part.
    """

    parts: Sequence[Part]
    triangle: NDArray[np.intp]
    part: NDArray[np.intp]
    corners: Floats

    def only(self, which: NDArray[np.bool_]) -> View:
        """The same parts with some of the triangles."""
        return self._replace(
            triangle=self.triangle[which], part=self.part[which], corners=self.corners[which]
        )

    def areas(self) -> Floats:
        """The total area of the triangles, which do not overlap, within every pixel of the parts:
        (P, H, W).
        """
        return areas_in(self.parts, self.part, self.corners)


class Truth(NamedTuple):
    """The exact picture (..., H, W, 4) in linear color, and the pixels (..., H, W) that an edge
    crosses.
    """

    image: Floats
    edge_pixels: NDArray[np.bool_]


class Snapped(NamedTuple):
    """The triangles near some parts as a technique renders them: as in View, with corners (S, 3,
    2) in subpixels of the rendered picture, which is `grid` times as wide and as high as the
    scene's.
    """

    parts: Sequence[Part]
    triangle: NDArray[np.intp]
    part: NDArray[np.intp]
    corners: NDArray[np.int64]
    grid: int

    def view(self) -> View:
        """The same triangles in pixels of the scene's picture."""
        return View(self.parts, self.triangle, self.part, self.corners / (SUBPIXELS * self.grid))


def snapped(triangles: Floats, parts: Sequence[Part], grid: int = 1, bits: int = 8) -> Snapped:
    """Those of a scene's triangles (T, 3, 2) that are near parts of one size, snapped to 2^-bits
    pixels of a picture rendered `grid` times as wide and as high. A moved scene is snapped after it
    has moved, as on a device.
    """
    low, high = _bounds(triangles)
    motion = np.array([(part.dx, part.dy) for part in parts])
    # Snapping moves corners by at most half a pixel.
    margin = 1 + float(np.abs(motion).max())
    near: dict[tuple[int, int], NDArray[np.intp]] = {}
    for left, top, width, height, _, _ in parts:
        if (left, top) not in near:
            across = (low[0] < left + width + margin) & (high[0] > left - margin)
            near[left, top] = np.flatnonzero(
                across & (low[1] < top + height + margin) & (high[1] > top - margin)
            )
    lists = [near[part.left, part.top] for part in parts]
    triangle = np.concatenate(lists)
    number = np.repeat(np.arange(len(parts)), [len(each) for each in lists])
    corners = triangles[triangle]
    if motion.any():
        corners = corners + motion[number][:, None]
    return Snapped(parts, triangle, number, snap.snapped(corners * grid, bits), grid)


def _bounds(triangles: Floats) -> tuple[Floats, Floats]:
    """The least and the greatest coordinates of triangles (T, 3, 2), each (2, T). The last ones are
    cached, for all parts of a scene.
    """
    for cached, low, high in _BOUNDS:
        if cached is triangles:
            return low, high
    a, b, c = (np.ascontiguousarray(triangles[:, corner].T) for corner in range(3))
    low, high = np.minimum(np.minimum(a, b), c), np.maximum(np.maximum(a, b), c)
    _BOUNDS[:] = [(triangles, low, high)]
    return low, high


_BOUNDS: list[tuple[Floats, Floats, Floats]] = []


def whole(triangles: Floats, width: int, height: int) -> View:
    """All triangles (T, 3, 2), and the whole picture as the only part."""
    numbers = np.arange(len(triangles))
    return View([Part(0, 0, width, height)], numbers, np.zeros_like(numbers), triangles)


def offsets(parts: Sequence[Part]) -> NDArray[np.int64]:
    """How far each part is moved, in pixels (P, 2), to stand below the one before it, where the
    first one stays where it is.
    """
    first = parts[0]
    return np.array(
        [
            (first.left - part.left, first.top + number * first.height - part.top)
            for number, part in enumerate(parts)
        ]
    )


def areas_in(parts: Sequence[Part], part: NDArray[np.intp], corners: Floats) -> Floats:
    """The total area of disjoint triangles (S, 3, 2), each near a part (S,), within every pixel of
    the parts: (P, H, W).
    """
    first = parts[0]
    top = first.top + part * first.height
    areas = areas_of(
        corners + offsets(parts)[part][:, None],
        first.width,
        first.height * len(parts),
        (first.left, first.top),
        np.stack((top, top + first.height), axis=1),
    )
    return areas.reshape(len(parts), first.height, first.width)
