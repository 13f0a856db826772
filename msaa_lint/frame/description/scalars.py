"""Spellings of scalars in the description format, beside those of Vulkan's enumerants."""

from __future__ import annotations

import math
import re
from collections.abc import Collection

from msaa_lint.frame.vulkan.names import nearest_name, parse_enum, parse_flags

SAMPLE_COUNTS = (1, 2, 4, 8, 16, 32, 64)

ATTACHMENT_UNUSED = 2**32 - 1
"""VK_ATTACHMENT_UNUSED, and VK_SUBPASS_EXTERNAL."""

EXTERNAL = ("EXTERNAL", "SUBPASS_EXTERNAL", "VK_SUBPASS_EXTERNAL")

UNUSED = ("UNUSED", "ATTACHMENT_UNUSED", "VK_ATTACHMENT_UNUSED")

SHADING_LEVELS = ("none", "light", "medium", "heavy")
"""The costs of shading that have a name."""

MAX_SHADING = {"ops": 1_000_000, "ns": 1e9, "ms": 1000.0}
"""The greatest cost of shading by unit: operations of an invocation, nanoseconds of a million
invocations, milliseconds of a screen.
"""

_SHADING = re.compile(r"([0-9]{1,12}(?:\.[0-9]{1,9})?)(ops|ns|ms)?")

_COUNT = re.compile(r"(?:(?:VK_)?SAMPLE_COUNT_)?(1|2|4|8|16|32|64)(?:_BIT)?")


def sample_count(value: object) -> int | None:
    """The sample count that `4`, `"4"`, `SAMPLE_COUNT_4` or `VK_SAMPLE_COUNT_4_BIT` states; None
    for other values.
    """
    if isinstance(value, str):
        match = _COUNT.fullmatch(value)
        value = int(match[1]) if match else None
    if isinstance(value, bool) or not isinstance(value, int) or value not in SAMPLE_COUNTS:
        return None
    return value


def shading_cost(value: object) -> str | None:
    """The cost of shading that `medium`, `200` or `200ops` (operations), `500000ns` (of a million
    invocations), or `4.2ms` (of a full screen at one sample) states, in one spelling for each cost;
    None for other values.
    """
    text = str(value) if type(value) in (str, int) else ""
    if text in SHADING_LEVELS:
        return text
    match = _SHADING.fullmatch(text)
    if match is None:
        return None
    unit, number = match[2] or "ops", float(match[1])
    if number > MAX_SHADING[unit] or (unit == "ops" and not number.is_integer()):
        return None
    return f"{number:.9g}{unit}" if number else "none"


def enumerant(enums: str, text: str) -> str | None:
    """The canonical name in the first of the enums, joined by `|`, that has it; None if none has.
    Metal's enums begin with `MTL`.
    """
    found = _canonical.get((enums, text))
    if found is None:
        if enums.startswith("MTL"):
            from msaa_lint.frame.metal.names import parse

            return parse(enums, text)
        found = next(
            (name for enum in enums.split("|") if (name := parse_enum(enum, text)) is not None),
            None,
        )
        if found is not None:
            _canonical[enums, text] = found
    return found


_canonical: dict[tuple[str, str], str] = {}
"""Spellings seen so far, as a frame repeats a few words. Unknown words are not added, so that no
input makes this grow.
"""


def flags(enum: str, text: str) -> list[str]:
    """The canonical names in a text that joins them by `|`, as `names.parse_flags`. Raises
    ValueError with the unknown part.
    """
    if enum.startswith("MTL"):
        from msaa_lint.frame.metal.names import parse_options

        return parse_options(enum, text)
    return parse_flags(enum, text)


def nearest_enumerant(enums: str, text: str) -> str | None:
    """The enumerant that was most likely meant by an unknown word; None if none is near."""
    if enums.startswith("MTL"):
        from msaa_lint.frame.metal.names import nearest_to

        return nearest_to(enums, text)
    from msaa_lint.frame.vulkan.enums import ENUMS

    return nearest_name(
        text, [name for enum in enums.split("|") for name in dict.fromkeys(ENUMS[enum].values())]
    )


def caseless(words: Collection[str], value: object) -> str | None:
    """The word that a value is in any case, in lower case; None if it is none of the words."""
    word = value.lower() if isinstance(value, str) else None
    return word if word in words else None


def finite(value: float) -> bool:
    """Whether a number is finite as a double; integers may exceed it."""
    try:
        return math.isfinite(value)
    except OverflowError:
        return False
