"""A model of a technique's time on a device, fitted to measured times: fixed + bytes + invocations times their cost + edge pixels."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from .points import Technique


class Prediction(NamedTuple):
    """A time in milliseconds, and the bounds within which the residuals of the fit leave it."""

    time_ms: float
    low_ms: float
    high_ms: float


class TimeModel(NamedTuple):
    """The model of one scene's times: `fixed_ms`, `bytes_ms` by technique, and `nanoseconds` per million invocations times `invocations`
    by technique. `residual` is the greatest relative residual of the fit, and `noise` the greatest relative half-width of the intervals of
    the measured times."""

    scene: str
    base_ms: Mapping[Technique, float]
    invocations: Mapping[Technique, float]
    residual: float
    noise: float

    def predict(self, technique: Technique, nanoseconds: float) -> Prediction | None:
        """The time where a million invocations take `nanoseconds`; None for a technique that was not timed."""
        if technique not in self.base_ms:
            return None
        time = self.base_ms[technique] + self.invocations[technique] * nanoseconds * 1e-12
        return Prediction(time, time * (1 - self.residual), time * (1 + self.residual))
