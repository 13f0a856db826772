"""From clip space to the corners that a device rasterises: the viewport in single precision, then the grid of sub-pixel positions."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .locations import SUBPIXELS

LIMIT = 2.0**40
"""Pixels from the origin, far beyond what any device draws; within it scaling is exact."""


def snapped(points_px: NDArray[np.float64], bits: int = 8) -> NDArray[np.int64]:
    """Positions in pixels, rounded to the nearest multiple of 2^-bits pixel, ties to the even multiple; in 1/256 pixel.

    `bits` is the device's subPixelPrecisionBits, 4 to 8: 4 is the least that Vulkan allows, 8 what lavapipe and most GPUs have.
    ValueError for other bits, for a position that is no number and for one beyond 2^40 pixels.
    """
    if not 4 <= bits <= 8:
        raise ValueError(f"{bits} bits of sub-pixel precision: 4 to 8")
    points = np.asarray(points_px, dtype=np.float64)
    if not bool(np.all(np.abs(points) <= LIMIT)):
        raise ValueError("a position is no finite number of pixels within 2^40 of the origin")
    return np.rint(points * 2.0**bits).astype(np.int64) * (SUBPIXELS >> bits)


def viewport(ndc: NDArray[np.float32], width: int, height: int, fused: bool = True) -> NDArray[np.float64]:
    """Normalised device coordinates (..., 2) in pixels of a viewport over the whole picture: `ndc * side / 2 + side / 2`.

    In single precision as devices have it: with one rounding (`fused`, a fused multiply-add, lavapipe) or with two (SwiftShader). The
    numbers given are those singles.
    """
    points = np.asarray(ndc, dtype=np.float32)
    half = np.array((width, height), dtype=np.float32) / np.float32(2)
    if not fused:
        rounded: NDArray[np.float32] = points * half + half
        return rounded.astype(np.float64)
    # The product of two singles is exact in double precision. Their sum is rounded to odd, so that the rounding to single that follows
    # gives what one rounding of the exact sum would (Boldo and Melquiond 2008).
    product, offset = points.astype(np.float64) * half.astype(np.float64), half.astype(np.float64)
    total = product + offset
    back = total - product
    missed = (product - (total - back)) + (offset - back)
    even = (total.view(np.int64) & 1) == 0
    odd = np.where((missed != 0) & even, np.nextafter(total, np.copysign(np.inf, missed)), total)
    single: NDArray[np.float32] = odd.astype(np.float32)
    return single.astype(np.float64)
