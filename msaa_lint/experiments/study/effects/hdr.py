"""HDR: samples are kept in half precision (R16G16B16A16_SFLOAT), rounded to nearest, ties to even; above 65504 is infinity (65520 and up).

The resolve adds them in single precision, where 16 samples of 65504 are far from overflow; its result is rounded to half precision again.
"""

from __future__ import annotations

import numpy as np

from .drawing import Floats


def stored(color: Floats) -> Floats:
    """What is read back of what is written."""
    with np.errstate(over="ignore"):
        return color.astype(np.float16).astype(np.float32)
