"""List types by their spelling."""

from __future__ import annotations

import re

_LISTED = re.compile(
    r"(?:\w+::)*(?:array|vector|span|deque|list|initializer_list|\w*(?:_vector|_array|Vector|Array|Span|List|Slice))"
    r"<((?:[^,<>]|<(?:[^<>]|<[^<>]*>)*>)+)[,>]"
)
_FIXED = re.compile(r"(?:std::|eastl::)?array<[^,<>]+,([^<>]+)>$")


def element_type(type_text: str) -> str | None:
    """Returns the element type of an array or list type, or None."""
    if type_text.endswith("]"):
        return type_text.partition("[")[0]
    match = _LISTED.match(type_text)
    return match[1] if match is not None else None


def array_size(type_text: str) -> str:
    """Returns the size of an array type as written, or an empty string."""
    if type_text.endswith("]"):
        return type_text.partition("[")[2].rstrip("]")
    match = _FIXED.match(type_text)
    return match[1] if match is not None else ""
