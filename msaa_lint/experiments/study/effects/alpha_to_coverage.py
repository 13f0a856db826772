"""Alpha to coverage. The specification leaves the pattern open and asks for a count of samples in proportion to alpha; two models:

- `dithered`: alpha * N, rounded down after adding one of 16 thresholds by the pixel's place in a block of 4x4 (Bayer), so that the average
  over a block is right to 1/(16 N);
- `ceil`: alpha * N rounded up, the same in every pixel, as no fragment of any alpha above 0 then vanishes.

The samples are the first ones of the pattern. 0, NaN and negative alpha cover nothing, 1 and more cover everything.
"""

from __future__ import annotations

import numpy as np

from .drawing import Band, Batch, Bits, Drawing, Floats

BAYER = np.array([[0, 8, 2, 10], [12, 4, 14, 6], [3, 11, 1, 9], [15, 7, 13, 5]], np.float32) / 16 + np.float32(1 / 32)
"""Thresholds by row and column within a block, evenly from 1/32 to 31/32."""

MODELS = ("dithered", "ceil")


def covered(alpha: Floats, thresholds: Floats | float, samples: int) -> Bits:
    """The samples that alpha covers, as bits. `thresholds` are added before rounding down; those of `ceil` are just below 1."""
    share = np.clip(np.where(alpha > 0, alpha, np.float32(0)), 0, 1) * np.float32(samples)
    count = np.ceil(share) if isinstance(thresholds, float) else np.floor(share + thresholds)
    bits: Bits = ((1 << np.minimum(count, samples).astype(np.uint32)) - 1).astype(np.uint16)
    return bits


def fragment(batch: Batch, band: Band, drawing: Drawing) -> None:
    """Takes samples that alpha does not cover away, each group's by its own alpha."""
    thresholds: Floats | float = 1.0
    if drawing.settings.get("alpha-to-coverage", "dithered") == "dithered":
        thresholds = BAYER[batch.y & 3, batch.x & 3]
    kept = np.zeros_like(batch.mask)
    for number, bits in enumerate(drawing.groups):
        kept |= covered(batch.color[:, number, 3], thresholds, drawing.samples) & np.uint16(bits)
    batch.mask = batch.mask & kept
