"""Depth test: each sample has a depth of its own, so that the line where surfaces cross is an edge too.

A triangle's depth is a plane over the picture; it is evaluated in double precision at the sample's place and rounded once, to the single
precision of D32_SFLOAT. A sample passes where the comparison of its depth with what is stored holds, and then stores it.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .drawing import Band, Batch, Drawing, chosen

COMPARE: dict[str, Callable[[Any, Any], NDArray[np.bool_]]] = {
    "LESS": np.less,
    "LESS_OR_EQUAL": np.less_equal,
    "GREATER": np.greater,
    "GREATER_OR_EQUAL": np.greater_equal,
    "EQUAL": np.equal,
    "NOT_EQUAL": np.not_equal,
}
"""VkCompareOp, without the two that compare nothing."""


def reversed_depth(drawing_settings: object) -> bool:
    """Whether greater is nearer."""
    return str(drawing_settings).startswith("GREATER")


def cleared(comparison: object) -> float:
    """What depth is cleared to: the farthest."""
    return 0.0 if reversed_depth(comparison) else 1.0


def fragment(batch: Batch, band: Band, drawing: Drawing) -> None:
    """Takes samples that fail away, and stores the depth of those that pass. Equal depth fails LESS: what was drawn first stays."""
    assert band.depth is not None and drawing.planes is not None
    compare = COMPARE[str(drawing.settings.get("depth-test", "LESS"))]
    across, down, base = drawing.planes[batch.triangle].T
    corner = across * batch.x + down * batch.y + base
    kept = np.zeros_like(batch.mask)
    for sample, (x, y) in enumerate(drawing.locations):
        depth = np.clip(corner + (across * x + down * y), 0.0, 1.0).astype(np.float32)
        plane = band.depth[sample]
        passes = compare(depth, plane[batch.pixel]) & chosen(batch.mask, sample)
        plane[batch.pixel[passes]] = depth[passes]
        kept |= passes.astype(np.uint16) << np.uint16(sample)
    batch.mask = kept
