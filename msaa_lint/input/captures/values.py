"""Parses the values of all capture formats.

A number may be a number or a string (`256`, `"256"`, `"0x11"`); a boolean `true`, `1`, `"1"` or
`"VK_TRUE"`; an enumerant its name, its number or `4 (VK_SAMPLE_COUNT_4_BIT)`; flags a number,
`0x00000011`, `VK_A|VK_B` or `17 (VK_A | VK_B)`. Anything else is None: unknown.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

from msaa_lint.frame.description.scalars import enumerant, sample_count
from msaa_lint.frame.vulkan.enums import VALUES
from msaa_lint.frame.vulkan.names import flag_names, from_value

MAX_TEXT = 4096
"""Longer strings are not parsed."""


def integer(value: object) -> int | None:
    """An integer."""
    if type(value) is int:
        return value
    if isinstance(value, str):
        return _number_in(value)
    if isinstance(value, float) and value.is_integer():
        return int(value)
    return int(value) if isinstance(value, bool) else None


def count(value: object) -> int | None:
    """A uint32_t."""
    result = integer(value)
    return result if result is not None and 0 <= result < 1 << 32 else None


def handle(value: object) -> int:
    """A handle; 0 if it is null or invalid."""
    if type(value) is int:
        return value
    if value is None or value == "VK_NULL_HANDLE":
        return 0
    return integer(value) or 0


def number(value: object) -> float | None:
    """A finite number."""
    if isinstance(value, str) and len(value) <= 64:
        try:
            value = float(value)
        except ValueError:
            return None
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return None
    try:
        return float(value) if math.isfinite(value) else None
    except OverflowError:
        return None


def boolean(value: object) -> bool | None:
    """A VkBool32."""
    if isinstance(value, bool):
        return value
    if value in ("VK_TRUE", "true"):
        return True
    if value in ("VK_FALSE", "false"):
        return False
    bit = integer(value)
    return None if bit is None else bit != 0


def text(value: object) -> str | None:
    """A string."""
    return value[:MAX_TEXT] if isinstance(value, str) else None


def enum(enums: str, value: object) -> str | None:
    """The canonical short name of an enumerant. `enums` is one enum name, or several joined by
    `|`.
    """
    if isinstance(value, str) and len(value) <= MAX_TEXT:
        name = enumerant(enums, value) or enumerant(enums, enumerant_name(value))
        if name is not None:
            return name
    value_ = integer(value)
    return from_value(enums.partition("|")[0], value_) if value_ is not None else None


def enumerant_name(value: object) -> str:
    """The name of an enumerant as written, or in parentheses as in `4 (VK_SAMPLE_COUNT_4_BIT)`;
    empty if it is not a string.
    """
    if not isinstance(value, str):
        return ""
    return (
        value[value.find("(") + 1 : -1].strip() if value.endswith(")") and "(" in value else value
    )


def flags(enums: str, value: object) -> tuple[list[str], bool] | None:
    """The canonical short names of the known bits, and whether all bits are known; None if the
    value is not a mask.
    """
    bits_ = value if type(value) is int else mask(value)
    if bits_ is None:
        return _names(enums, value) if isinstance(value, str) and len(value) <= MAX_TEXT else None
    if bits_ < 0 or bits_ >= 1 << 64:
        return None
    names = flag_names(enums, bits_)
    if names is not None:
        return names, True
    return [
        name for name, bit in VALUES[enums].items() if bit and bit & (bit - 1) == 0 and bits_ & bit
    ], False


def bits(enums: str, value: object) -> int | None:
    """The bits of flags, from a number or names; None if one of them is unknown."""
    number_ = mask(value)
    if number_ is not None:
        return number_
    names = flags(enums, value)
    return sum(VALUES[enums][name] for name in names[0]) if names is not None and names[1] else None


def samples(value: object) -> int | None:
    """A sample count."""
    if isinstance(value, str):
        parsed = sample_count(value)
        if parsed is not None:
            return parsed
        value = mask(value)
    return sample_count(value)


def record(value: object) -> dict[str, Any]:
    """A structure; an empty one if there is none."""
    return value if isinstance(value, dict) else {}


def items(value: object) -> list[Any]:
    """An array; an empty one for a null pointer."""
    return value if isinstance(value, list) else []


def chain(structure: object) -> Iterator[dict[str, Any]]:
    """A structure and those in its pNext chain, at most 64."""
    for _ in range(64):
        if not isinstance(structure, dict):
            return
        yield structure
        structure = structure.get("pNext")


def chained(structure: dict[str, Any], kind: str) -> dict[str, Any] | None:
    """The structure in a pNext chain whose sType, without prefix and vendor suffix, is `kind`."""
    return next(
        (
            following
            for following in chain(structure.get("pNext"))
            if structure_type(following) == kind
        ),
        None,
    )


def structure_type(structure: dict[str, Any]) -> str:
    """The sType of a structure without its prefix and vendor suffix."""
    return (
        enumerant_name(structure.get("sType"))
        .removeprefix("VK_STRUCTURE_TYPE_")
        .removesuffix("_KHR")
        .removesuffix("_EXT")
    )


def _number_in(value: str) -> int | None:
    """The number in a string, which may be followed by a name in parentheses."""
    if len(value) > MAX_TEXT:
        return None
    head = value.partition(" (")[0]
    if len(head) > 20:
        return None
    try:
        return int(head, 16) if head[:2] in ("0x", "0X") else int(head)
    except ValueError:
        return None


def mask(value: object) -> int | None:
    """The bits of flags written as a number; None if they are only names."""
    if isinstance(value, str):
        bits_ = _number_in(value)
        # RenderDoc writes an empty mask as `VkImageCreateFlagBits(0)`.
        if bits_ is None and value.endswith("(0)") and value[:2] == "Vk":
            return 0
        return bits_
    return integer(value)


def _names(enums: str, value: str) -> tuple[list[str], bool] | None:
    names: dict[str, None] = {}
    complete = True
    for part in value.split("|"):
        name = enumerant(enums, part.strip())
        if name is None:
            complete = False
        elif VALUES[enums][name]:
            names[name] = None
    return (list(names), complete) if names or complete else None
