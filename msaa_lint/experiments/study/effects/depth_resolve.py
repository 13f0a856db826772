"""Depth resolve: one depth for a pixel of several samples (VkResolveModeFlagBits).

SAMPLE_ZERO is always supported, and off the pixel's centre. MIN is the nearest of standard depth and the farthest of reversed depth, MAX
the other way round. AVERAGE of two surfaces is a depth at which there is none.
"""

from __future__ import annotations

import numpy as np

from msaa_lint.experiments.study.resolve import average

from .drawing import Floats

MODES = ("SAMPLE_ZERO", "AVERAGE", "MIN", "MAX")


def resolved(depth: Floats, mode: str) -> Floats:
    """Samples (N, P) to pixels (P,). NaN stays NaN in all modes but SAMPLE_ZERO. ValueError for another mode."""
    if mode == "SAMPLE_ZERO":
        return np.array(depth[0], np.float32)
    if mode == "MIN":
        return np.asarray(np.minimum.reduce(depth, axis=0), np.float32)
    if mode == "MAX":
        return np.asarray(np.maximum.reduce(depth, axis=0), np.float32)
    if mode != "AVERAGE":
        raise ValueError(f"{mode} is no depth resolve mode: they are {', '.join(MODES)}")
    return average(depth)
