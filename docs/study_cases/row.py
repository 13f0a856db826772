"""A row of the table of docs/study-numbers.md."""

from __future__ import annotations

import math
from typing import NamedTuple


class Row(NamedTuple):
    """A case: the results of naive arithmetic (float32 unless the case says otherwise), float64 and
    the study; `within` is the relative tolerance.
    """

    group: str
    case: str
    exact: float
    naive: float
    double: float
    ours: float
    within: float = 0.0

    def right(self, value: float) -> bool:
        """Whether a value is correct."""
        if not math.isfinite(self.exact):
            return value == self.exact or (math.isnan(self.exact) and math.isnan(value))
        return abs(value - self.exact) <= self.within * abs(self.exact)
