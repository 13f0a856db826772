"""Tone mapping by Reinhard's x / (1 + x), each channel by itself, and where it stands to the resolve.

- `after-resolve`: the average of light, then mapped: beside something bright an edge is as good as not smoothed;
- `before-resolve`: samples are mapped, then averaged: what is displayed is right;
- `weighted`: samples are averaged with weights of 1 / (1 + luma) (Rec. 709), then mapped: the same as the one before for grey, near it for
  colour, and bright single samples (fireflies) do not fill the pixel.
"""

from __future__ import annotations

import numpy as np

from .drawing import Floats

PLACES = ("after-resolve", "before-resolve", "weighted")


def mapped(color: Floats) -> Floats:
    """Colours mapped to [0, 1], alpha as it is. Infinity is 1; NaN stays NaN; negative light is 0."""
    made = color.copy()
    light = np.maximum(color[..., :3], np.float32(0))
    with np.errstate(invalid="ignore"):
        made[..., :3] = np.where(np.isinf(light), np.float32(1), light / (np.float32(1) + light))
    return made
