"""Operators that the supported languages have in common."""

from __future__ import annotations

import operator

COMPARISONS = {
    "==": operator.eq,
    "!=": operator.ne,
    "<": operator.lt,
    ">": operator.gt,
    "<=": operator.le,
    ">=": operator.ge,
}
"""Comparison operators by their spelling."""
