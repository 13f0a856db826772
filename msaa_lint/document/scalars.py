"""Spellings that the format has beside Vulkan's enumerants."""

from __future__ import annotations

import math
import re

from ..vulkan.names import parse_enum

SAMPLE_COUNTS = (1, 2, 4, 8, 16, 32, 64)

ATTACHMENT_UNUSED = 2**32 - 1
"""VK_ATTACHMENT_UNUSED, and VK_SUBPASS_EXTERNAL."""

EXTERNAL = ("EXTERNAL", "SUBPASS_EXTERNAL", "VK_SUBPASS_EXTERNAL")

UNUSED = ("UNUSED", "ATTACHMENT_UNUSED", "VK_ATTACHMENT_UNUSED")

_COUNT = re.compile(r"(?:(?:VK_)?SAMPLE_COUNT_)?(1|2|4|8|16|32|64)(?:_BIT)?")


def sample_count(value: object) -> int | None:
    """The count that `4`, `"4"`, `SAMPLE_COUNT_4` or `VK_SAMPLE_COUNT_4_BIT` states; None where it is none of Vulkan's."""
    if isinstance(value, str):
        match = _COUNT.fullmatch(value)
        value = int(match[1]) if match else None
    if isinstance(value, bool) or not isinstance(value, int) or value not in SAMPLE_COUNTS:
        return None
    return value


def enumerant(enums: str, text: str) -> str | None:
    """The canonical name in the first of the enums, joined by `|`, that has it; None where none has."""
    found = _found.get((enums, text))
    if found is None:
        found = next((name for enum in enums.split("|") if (name := parse_enum(enum, text)) is not None), None)
        if found is not None:
            _found[enums, text] = found
    return found


_found: dict[tuple[str, str], str] = {}
"""Spellings met: the same few words state most of a frame. What is no name is not kept, so that no input makes this grow."""


def finite(value: float) -> bool:
    """Whether a number is one that a double can hold: whole numbers may be longer."""
    try:
        return math.isfinite(value)
    except OverflowError:
        return False
