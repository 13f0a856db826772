"""The spellings of enumerants: full names, short names and numbers; and the name nearest to a
misspelled one.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from functools import cache

from msaa_lint.core.suggestions import MAX_LENGTH, letters_and_digits, nearest

from .enums import ALIASES, BITLESS, PREFIXES, VALUES

_NUMBER = re.compile(r"0[xX][0-9a-fA-F]{1,18}|[1-9][0-9]{0,19}|0{1,20}")

VENDORS = (
    "AMD",
    "ANDROID",
    "ARM",
    "EXT",
    "HUAWEI",
    "IMG",
    "INTEL",
    "KHR",
    "NV",
    "NVX",
    "QCOM",
    "VALVE",
)

_AFTER_BIT = ("", *(f"_{vendor}" for vendor in VENDORS))


def parse_enum(enum: str, text: str) -> str | None:
    """The canonical short name of an enumerant of `enum` (a name in `enums.VALUES`); None if the
    text is not one.

    The type's prefix, or only its `VK_`, and for flag bits `_BIT` may be left out. Names are
    case-sensitive, as in Vulkan.
    """
    values, aliases = VALUES[enum], ALIASES.get(enum, {})
    if text in values:
        return text
    if text in aliases:
        return aliases[text]
    if len(text) > MAX_LENGTH:
        return None
    name, prefix = text, PREFIXES[enum]
    if name.startswith(prefix):
        name = name[len(prefix) :]
    elif name.startswith(prefix[3:]):
        name = name[len(prefix) - 3 :]
    if len(name) < len(text) and enum.endswith("2"):
        name = name.removeprefix("2_")
    if "FlagBits" in enum:
        bare = _without_bit(name)
        if bare != name and bare in BITLESS.get(enum, ()):
            return None
        name = bare
    return name if name in values else aliases.get(name)


def from_value(enum: str, value: int) -> str | None:
    """The canonical short name of a value; None if the enum does not have it."""
    return _names_by_value(enum).get(value)


@cache
def _names_by_value(enum: str) -> dict[int, str]:
    return {value: name for name, value in VALUES[enum].items()}


def flag_names(enum: str, mask: int) -> list[str] | None:
    """The canonical short names of the bits of a mask, lowest first; None if a bit is unknown. A
    mask of 0 has no names.
    """
    if mask == 0:
        return []
    if not 0 < mask < 1 << 64:
        return None
    whole = from_value(enum, mask)
    if whole is not None:
        return [whole]
    bits = [1 << place for place in range(mask.bit_length()) if mask >> place & 1]
    names = [name for name in map(_names_by_value(enum).get, bits) if name is not None]
    return names if len(names) == len(bits) else None


def parse_flags(enum: str, text: str) -> list[str]:
    """The canonical short names in `A | B`, `0`, `0x11`, `17` or `17 (A | B)`, each once, in their
    order.

    A name without bits (`NONE`) adds nothing. In a number with names in parentheses, the number
    counts. Raises ValueError, with the unknown part as its text.
    """
    text = text.strip()
    if text.endswith(")"):
        number, opened, names = text[:-1].partition("(")
        text = number.strip()
        if not opened or _mask(text) is None:
            raise ValueError(text or names)
        if names.strip():
            parse_flags(enum, names)
    flags = "FlagBits" in enum
    found: dict[str, None] = {}
    for part in text.split("|"):
        word = part.strip()
        name = parse_enum(enum, word)
        if name is None:
            mask = _mask(word) if flags else None
            bits = flag_names(enum, mask) if mask is not None else None
            if bits is None:
                raise ValueError(word)
            found.update(dict.fromkeys(bits))
        elif VALUES[enum][name] or not flags:
            found[name] = None
    return list(found)


def _mask(word: str) -> int | None:
    """A decimal or hexadecimal number below 2^64; None for another word, also with a leading zero,
    which is octal in C.
    """
    value = int(word, 0) if _NUMBER.fullmatch(word) is not None else 1 << 64
    return value if value < 1 << 64 else None


def nearest_name(word: str, names: Iterable[str]) -> str | None:
    """The name that was most likely meant by a word, whatever its type's prefix, `_BIT` and
    vendor's suffix; None if none is near.
    """
    return nearest(word, names, _bare)


def _bare(word: str) -> str:
    """The letters and digits of a name without its type's prefix, `_BIT` and vendor's suffix."""
    name = "_".join(word.upper().replace("-", " ").split())
    prefix = max((p for p in PREFIXES.values() if name.startswith(p)), key=len, default="")
    name = name[len(prefix) :]
    if prefix:
        name = name.removeprefix("2_")
    name = _without_bit(name)
    head, _, vendor = name.rpartition("_")
    return letters_and_digits(head if head and vendor in VENDORS else name)


def _without_bit(name: str) -> str:
    """The name without `_BIT`: `CUSTOM_RESOLVE_EXT` for `CUSTOM_RESOLVE_BIT_EXT`."""
    head, bit, tail = name.rpartition("_BIT")
    return head + tail if bit and tail in _AFTER_BIT else name
