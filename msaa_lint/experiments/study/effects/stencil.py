"""Stencil test: some triangles only mark (write 1 to stencil, no colour), others are drawn where a sample is marked (EQUAL 1)."""

from __future__ import annotations

import numpy as np

from .drawing import Band, Batch, Drawing, chosen


def fragment(batch: Batch, band: Band, drawing: Drawing) -> None:
    """`settings["stencil"]` are three numbers of triangles: from the first up to the second they mark, from there up to the third they are
    tested; the rest is left alone."""
    assert band.stencil is not None
    first, marked, tested = _limits(drawing.settings["stencil"])
    marks = (batch.triangle >= first) & (batch.triangle < marked)
    tests = (batch.triangle >= marked) & (batch.triangle < tested)
    kept = np.where(marks | tests, np.uint16(0), batch.mask)
    for sample in range(drawing.samples):
        covered = chosen(batch.mask, sample)
        plane = band.stencil[sample]
        passes = covered & tests & (plane[batch.pixel] == 1)
        plane[batch.pixel[covered & marks]] = 1
        kept |= passes.astype(np.uint16) << np.uint16(sample)
    batch.mask = kept


def _limits(setting: object) -> tuple[int, int, int]:
    assert isinstance(setting, tuple)
    first, marked, tested = setting
    return first, marked, tested
