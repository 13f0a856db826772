"""Alpha test: an invocation whose alpha is below the threshold is discarded, with all its samples (OpKill, OpTerminateInvocation)."""

from __future__ import annotations

import numpy as np

from .drawing import Band, Batch, Drawing

THRESHOLD = 0.5


def fragment(batch: Batch, band: Band, drawing: Drawing) -> None:
    """Takes the samples of discarded invocations away. NaN is not below anything: it stays."""
    for number, bits in enumerate(drawing.groups):
        discarded = batch.color[:, number, 3] < THRESHOLD
        batch.mask = np.where(discarded, batch.mask & np.uint16(~bits & 0xFFFF), batch.mask)
