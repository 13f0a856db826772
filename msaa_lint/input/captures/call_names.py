"""Names of calls without vendor suffixes."""

from __future__ import annotations

import re

_SUFFIX = re.compile(r"(?:KHR|EXT|NV|AMD|QCOM|ARM|LUNARG)\Z")


def without_vendor(name: str) -> str:
    """A call's name without its vendor suffix."""
    return _SUFFIX.sub("", name)


def is_wanted(wanted: frozenset[str], name: str) -> bool:
    """Whether `wanted` contains a call, with or without its vendor suffix."""
    return name in wanted or without_vendor(name) in wanted
