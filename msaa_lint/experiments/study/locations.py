"""The standard sample locations."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from msaa_lint.frame.vulkan.sample_locations import STANDARD

SUBPIXELS = 256
"""Steps per pixel: coordinates are integers in units of 1/256 pixel."""


def standard(samples: int) -> NDArray[np.int64]:
    """The standard pattern of a sample count: (samples, 2), x and y in 1/256 pixel, in sample
    order.

    ValueError for a count without a standard pattern, such as 32 and 64.
    """
    if samples not in STANDARD:
        raise ValueError(
            f"there are no standard sample locations for {samples} samples, only for "
            f"{', '.join(map(str, STANDARD))}"
        )
    return np.array(STANDARD[samples], dtype=np.int64) * (SUBPIXELS // 16)
