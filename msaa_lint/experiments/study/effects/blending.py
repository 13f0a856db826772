"""Blending: SRC_ALPHA over ONE_MINUS_SRC_ALPHA, sample by sample, in single precision and in linear light."""

from __future__ import annotations

import numpy as np

from .drawing import Floats


def blended(source: Floats, behind: Floats) -> Floats:
    """A colour (F, 4) over what is there: source * alpha + behind * (1 - alpha); alpha by ONE and ONE_MINUS_SRC_ALPHA."""
    alpha = source[:, 3:4]
    rest = np.float32(1) - alpha
    made = behind * rest
    made[:, :3] += source[:, :3] * alpha
    made[:, 3:4] += alpha
    return np.asarray(made, np.float32)
