"""Values as captures spell them: one reading for every dialect.

A number may be a number or a text (`256`, `"256"`, `"0x11"`), a boolean `true`, `1`, `"1"` or `"VK_TRUE"`, an enumerant its name or number
or `4 (VK_SAMPLE_COUNT_4_BIT)`, flags a number, `0x00000011`, `VK_A|VK_B` or `17 (VK_A | VK_B)`. What is none of these is None: unknown.
"""

from __future__ import annotations

import math
from typing import Any

from msaa_lint.frame.description.scalars import enumerant, sample_count
from msaa_lint.frame.vulkan.enums import VALUES
from msaa_lint.frame.vulkan.names import flag_names, from_value

MAX_TEXT = 4096
"""Longer texts are no number, name or mask."""


def integer(value: object) -> int | None:
    """A whole number."""
    if type(value) is int:
        return value
    if isinstance(value, str):
        return _number_in(value)
    if isinstance(value, float) and value.is_integer():
        return int(value)
    return int(value) if isinstance(value, bool) else None


def count(value: object) -> int | None:
    """A uint32_t."""
    found = integer(value)
    return found if found is not None and 0 <= found < 1 << 32 else None


def handle(value: object) -> int:
    """A handle: 0 is null, and what cannot be read."""
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
    found = integer(value)
    return None if found is None else found != 0


def text(value: object) -> str | None:
    """A text."""
    return value[:MAX_TEXT] if isinstance(value, str) else None


def enum(enums: str, value: object) -> str | None:
    """The canonical short name of an enumerant of one of the enums, joined by `|`."""
    if isinstance(value, str) and len(value) <= MAX_TEXT:
        found = enumerant(enums, value)
        if found is not None:
            return found
        found = enumerant(enums, named(value))
        if found is not None:
            return found
    known = integer(value)
    return from_value(enums.partition("|")[0], known) if known is not None else None


def named(value: object) -> str:
    """The name of an enumerant as it is written: of `4 (VK_SAMPLE_COUNT_4_BIT)` what is in parentheses. Empty where it is no text."""
    if not isinstance(value, str):
        return ""
    return value[value.find("(") + 1 : -1].strip() if value.endswith(")") and "(" in value else value


def flags(enums: str, value: object) -> tuple[list[str], bool] | None:
    """The canonical short names of the bits that are known, and whether all bits are; None where it is no mask."""
    whole = value if type(value) is int else mask(value)
    if whole is None:
        return _names(enums, value) if isinstance(value, str) and len(value) <= MAX_TEXT else None
    if whole < 0 or whole >= 1 << 64:
        return None
    known = flag_names(enums, whole)
    if known is not None:
        return known, True
    return [name for name, bit in VALUES[enums].items() if bit and bit & (bit - 1) == 0 and whole & bit], False


def bits(enums: str, value: object) -> int | None:
    """The bits of flags, by number or by names; None where one of them is unknown."""
    found = mask(value)
    if found is not None:
        return found
    named = flags(enums, value)
    return sum(VALUES[enums][name] for name in named[0]) if named is not None and named[1] else None


def samples(value: object) -> int | None:
    """A sample count."""
    if isinstance(value, str):
        found = sample_count(value)
        if found is not None:
            return found
        value = mask(value)
    return sample_count(value)


def sample_counts(value: object) -> list[int] | None:
    """The counts of a VkSampleCountFlags mask, in rising order."""
    found = flags("VkSampleCountFlagBits", value)
    if found is None:
        return None
    counts = (sample_count(name) for name in found[0])
    return sorted(count for count in counts if count is not None)


def record(value: object) -> dict[str, Any]:
    """A structure; an empty one where there is none."""
    return value if isinstance(value, dict) else {}


def items(value: object) -> list[Any]:
    """An array; an empty one for a null pointer."""
    return value if isinstance(value, list) else []


def chained(structure: dict[str, Any], kind: str) -> dict[str, Any] | None:
    """The structure of a pNext chain whose sType, without prefix and vendor, is `kind`."""
    following = structure.get("pNext")
    for _ in range(64):
        if not isinstance(following, dict):
            return None
        if structure_type(following) == kind:
            return following
        following = following.get("pNext")
    return None


def structure_type(structure: dict[str, Any]) -> str:
    """The sType of a structure without its prefix and vendor."""
    return named(structure.get("sType")).removeprefix("VK_STRUCTURE_TYPE_").removesuffix("_KHR").removesuffix("_EXT")


def _number_in(value: str) -> int | None:
    """The number that a text is, or begins with where a name follows in parentheses."""
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
    """The bits of flags that are a number; None where they are names alone."""
    if isinstance(value, str):
        found = _number_in(value)
        # RenderDoc names no bits `VkImageCreateFlagBits(0)`.
        if found is None and value.endswith("(0)") and value[:2] == "Vk":
            return 0
        return found
    return integer(value)


def _names(enums: str, value: str) -> tuple[list[str], bool] | None:
    found: dict[str, None] = {}
    whole = True
    for part in value.split("|"):
        name = enumerant(enums, part.strip())
        if name is None:
            whole = False
        elif VALUES[enums][name]:
            found[name] = None
    return (list(found), whole) if found or whole else None
