"""Calls by their names without the suffixes of vendors, and which of them somebody follows."""

from __future__ import annotations

import re

_SUFFIX = re.compile(r"(?:KHR|EXT|NV|AMD|QCOM|ARM|LUNARG)\Z")


def bare(name: str) -> str:
    """A call's name without its vendor's suffix."""
    return _SUFFIX.sub("", name)


def wants(wanted: frozenset[str], name: str) -> bool:
    """Whether a call is among those wanted, which are named without the suffixes of vendors."""
    return name in wanted or bare(name) in wanted
