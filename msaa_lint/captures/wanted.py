"""Which calls of a capture somebody follows."""

from __future__ import annotations

import re

_SUFFIX = re.compile(r"(?:KHR|EXT|NV|AMD|QCOM|ARM|LUNARG)\Z")


def wants(wanted: frozenset[str], name: str) -> bool:
    """Whether a call is among those wanted, which are named without the suffixes of vendors."""
    return name in wanted or _SUFFIX.sub("", name) in wanted
