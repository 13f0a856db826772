"""The corners that a device rasterizes: positions on the subpixel grid."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .locations import SUBPIXELS

MAX_DISTANCE = 2.0**40
"""Maximum distance from the origin in pixels: far beyond what any device draws, and within it
scaling is exact.
"""


def snapped(points_px: NDArray[np.float64], bits: int = 8) -> NDArray[np.int64]:
    """Positions in pixels, rounded to the nearest multiple of 2^-bits pixel, ties to the even
    multiple; in 1/256 pixel.

    `bits` is the device's subPixelPrecisionBits, 4 to 8: 4 is the minimum of Vulkan; lavapipe and
    most GPUs have 8. ValueError for other bits, for NaN, and for positions beyond 2^40 pixels.
    """
    if not 4 <= bits <= 8:
        raise ValueError(f"subpixel precision must be 4 to 8 bits, found {bits}")
    points = np.asarray(points_px, dtype=np.float64)
    if not bool(np.all(np.abs(points) <= MAX_DISTANCE)):
        raise ValueError("a position is not finite or not within 2^40 pixels of the origin")
    return np.rint(points * 2.0**bits).astype(np.int64) * (SUBPIXELS >> bits)
