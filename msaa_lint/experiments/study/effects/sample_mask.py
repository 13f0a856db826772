"""VkPipelineMultisampleStateCreateInfo::pSampleMask: samples whose bit is not set are never drawn (specification 28.4)."""

from __future__ import annotations

import numpy as np

from .drawing import Band, Batch, Drawing


def fragment(batch: Batch, band: Band, drawing: Drawing) -> None:
    """Leaves the samples of `settings["sample-mask"]`."""
    mask = drawing.settings["sample-mask"]
    assert isinstance(mask, int)
    batch.mask = batch.mask & np.uint16(mask & 0xFFFF)
