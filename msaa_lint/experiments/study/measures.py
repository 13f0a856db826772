"""The error by which the techniques of a scene are compared: what people look at in such a
picture.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from .points import Point
from .scenes.about import HDR, THIN_LINES

FIGURES = 3
"""Significant digits of an error that are compared: smaller differences are rounding."""


class Measure(NamedTuple):
    """An error of points: the member that has it, and its name in sentences."""

    key: str
    name: str

    def of(self, point: Point) -> float | None:
        """The error, of which less is better, or NaN; None where it was not measured. Of PSNR it is
        the RMSE, in units of display white.
        """
        value: float | None = getattr(point, self.key)
        if value is None or self.key != "psnr_display_db":
            return value
        return (
            10.0 ** (-min(max(value, -1000.0), 1000.0) / 20)
            if not math.isinf(value)
            else 0.0
            if value > 0
            else math.inf
        )

    def is_finite(self, point: Point) -> bool:
        """Whether the error was measured, and is a finite number that is not negative."""
        value = self.of(point)
        return value is not None and 0 <= value < math.inf

    def rounded(self, point: Point) -> float:
        """The error to as many digits as are compared; NaN where it was not measured."""
        value = self.of(point)
        return math.nan if value is None else float(f"{value:.{FIGURES}g}")


ERROR = Measure("rmse", "error")
DISPLAY = Measure("psnr_display_db", "error on the display")
FLIP = Measure("flip", "FLIP")
FLICKER = Measure("flicker", "flicker")

MEASURES = (ERROR, DISPLAY, FLIP, FLICKER)


def measure_of(about: Sequence[str], points: Sequence[Point]) -> Measure:
    """The error that decides between the points of a scene: of HDR the one on the display, FLIP if
    it was measured, else that of PSNR; of thin lines their flicker; otherwise, and where that was
    not measured of all points, the RMSE.
    """
    preferred = (FLIP, DISPLAY) if HDR in about else (FLICKER,) if THIN_LINES in about else ()
    for measure in preferred:
        finite = [point for point in points if ERROR.is_finite(point)]
        if finite and all(map(measure.is_finite, finite)):
            return measure
    return ERROR
