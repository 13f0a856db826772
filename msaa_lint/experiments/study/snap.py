"""From clip space to the corners that a device rasterizes: the viewport transform in single precision, then the subpixel grid."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .locations import SUBPIXELS

MAX_DISTANCE = 2.0**40
"""Maximum distance from the origin in pixels: far beyond what any device draws, and within it scaling is exact."""


def snapped(points_px: NDArray[np.float64], bits: int = 8) -> NDArray[np.int64]:
    """Positions in pixels, rounded to the nearest multiple of 2^-bits pixel, ties to the even multiple; in 1/256 pixel.

    `bits` is the device's subPixelPrecisionBits, 4 to 8: 4 is the minimum of Vulkan; lavapipe and most GPUs have 8. ValueError for other
    bits, for NaN, and for positions beyond 2^40 pixels.
    """
    if not 4 <= bits <= 8:
        raise ValueError(f"subpixel precision must be 4 to 8 bits, found {bits}")
    points = np.asarray(points_px, dtype=np.float64)
    if not bool(np.all(np.abs(points) <= MAX_DISTANCE)):
        raise ValueError("a position is not finite or not within 2^40 pixels of the origin")
    return np.rint(points * 2.0**bits).astype(np.int64) * (SUBPIXELS >> bits)


def viewport(ndc: NDArray[np.float32], width: int, height: int, fused: bool = True) -> NDArray[np.float64]:
    """Normalized device coordinates (..., 2) in pixels of a viewport that covers the picture: `ndc * side / 2 + side / 2`.

    Computed in single precision as devices do: with one rounding (`fused`, a fused multiply-add, lavapipe) or with two (SwiftShader).
    """
    points = np.asarray(ndc, dtype=np.float32)
    half = np.array((width, height), dtype=np.float32) / np.float32(2)
    if not fused:
        rounded: NDArray[np.float32] = points * half + half
        return rounded.astype(np.float64)
    # The product of two singles is exact in double precision. The sum is rounded to odd, so that the subsequent rounding to single equals
    # one rounding of the exact sum (Boldo and Melquiond 2008).
    product, offset = points.astype(np.float64) * half.astype(np.float64), half.astype(np.float64)
    total = product + offset
    difference = total - product
    error = (product - (total - difference)) + (offset - difference)
    even = (total.view(np.int64) & 1) == 0
    odd = np.where((error != 0) & even, np.nextafter(total, np.copysign(np.inf, error)), total)
    single: NDArray[np.float32] = odd.astype(np.float32)
    return single.astype(np.float64)
