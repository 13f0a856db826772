"""Sums in double precision of values that come in pieces: blocks by NumPy's pairwise sum, their
totals by math.fsum.

A sum depends on the values and their order alone, not on the pieces.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

BLOCK = 1 << 16
"""Values that NumPy sums at a time."""


class Errors(NamedTuple):
    """The root mean square, greatest magnitude and mean (measured minus exact) of differences, and
    their number.
    """

    rmse: float
    greatest: float
    bias: float
    values: int


class Sum:
    """The sum of all values added, and their number."""

    def __init__(self) -> None:
        self.count = 0
        self._blocks: list[float] = []
        self._rest: NDArray[Any] = np.empty(0)

    def add(self, values: NDArray[np.floating]) -> None:
        """Adds values, in their order in memory."""
        # NumPy sums pairwise along the fastest axis alone, so sum a single row.
        row = np.ascontiguousarray(values).reshape(-1)
        self.count += len(row)
        if len(self._rest):
            row = np.concatenate((self._rest, row))
        end = len(row) - len(row) % BLOCK
        self._blocks += [_block_sum(row[start : start + BLOCK]) for start in range(0, end, BLOCK)]
        self._rest = row[end:].copy()

    def total(self) -> float:
        """The sum. Infinities of both signs, and NaN, give NaN."""
        sums = [*self._blocks, *([_block_sum(self._rest)] if len(self._rest) else [])]
        try:
            return math.fsum(sums)
        except (ValueError, OverflowError):
            with np.errstate(invalid="ignore", over="ignore"):
                return float(np.sum(sums))

    def psnr(self) -> float:
        """The peak signal-to-noise ratio in dB, with a peak of 1.0, of squared differences;
        infinite where nothing differs.
        """
        square = self.total() / self.count
        return (
            math.inf
            if square == 0
            else -10 * math.log10(square)
            if math.isfinite(square)
            else -square
        )


class ErrorSum:
    """The errors of all differences added."""

    def __init__(self) -> None:
        self._values, self._squares, self._greatest = Sum(), Sum(), 0.0

    def add(self, differences: Floats) -> None:
        """Adds differences."""
        self._values.add(differences)
        self._squares.add(differences * differences)
        if differences.size:
            self._greatest = float(np.maximum(self._greatest, np.max(np.abs(differences))))

    def errors(self) -> Errors:
        """Summarized; zeros where there are none."""
        count = self._values.count
        if not count:
            return Errors(0.0, 0.0, 0.0, 0)
        return Errors(
            math.sqrt(self._squares.total() / count),
            self._greatest,
            self._values.total() / count,
            count,
        )


def total(values: NDArray[np.floating]) -> float:
    """The sum of values."""
    values_sum = Sum()
    values_sum.add(values)
    return values_sum.total()


def _block_sum(values: NDArray[np.floating]) -> float:
    with np.errstate(invalid="ignore", over="ignore"):
        return float(np.sum(values, dtype=np.float64))


def difference(measured: NDArray[np.floating], exact: NDArray[np.floating]) -> Floats:
    """Measured minus exact, in double precision; 0 where they are equal, including infinities."""
    with np.errstate(invalid="ignore"):
        return np.where(
            measured == exact, 0.0, measured.astype(np.float64) - exact.astype(np.float64)
        )
