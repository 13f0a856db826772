"""The values of reports, in whatever spelling a tool gives them: numbers, text of numbers, names of
bits, lists of names.
"""

from __future__ import annotations

import re

from msaa_lint.frame.vulkan.enums import VALUES
from msaa_lint.frame.vulkan.names import parse_enum

MAX_TEXT = 256
"""Code points of one value; longer ones are none."""

MAX_BITS = 64
"""Names in one list of bits."""

_NUMBER = re.compile(r"(?:0[xX][0-9a-fA-F]{1,16}|[0-9]{1,20})(?![\w.])")
_VERSION = re.compile(r"[0-9]{1,4}\.[0-9]{1,4}(?:\.[0-9]{1,6})?(?![\w.])")
_FEATURE = re.compile(r"[A-Za-z][A-Za-z0-9_]{0,127}\Z")
_EXTENSION = re.compile(r"VK_[A-Z0-9]{1,20}_\w{1,100}\Z", re.ASCII)


def number(value: object) -> int | None:
    """A whole number from 0 to 2^64 - 1: `15`, `15.0`, `"15"`, `"0x0000000f: count = 4"`."""
    if isinstance(value, bool):
        return None
    if isinstance(value, float):
        value = int(value) if value.is_integer() else None
    elif isinstance(value, str):
        found = _NUMBER.match(value.strip()) if len(value) <= MAX_TEXT else None
        if found is None:
            return None
        digits = found.group()
        value = int(digits, 16) if digits[:2] in ("0x", "0X") else int(digits)
    return value if isinstance(value, int) and 0 <= value < 1 << 64 else None


def boolean(value: object) -> bool | None:
    """`true`, `1`, `"true"`, `"1"`, and their opposites."""
    if isinstance(value, str):
        value = {"true": True, "false": False, "1": True, "0": False}.get(value.strip().lower())
    if isinstance(value, float) and value in (0.0, 1.0):
        value = int(value)
    if isinstance(value, int) and value in (0, 1):
        return bool(value)
    return None


def mask(enum: str, value: object) -> int | None:
    """The bits of a flags value: a number, a name, `A | B`, or a list of names. Names of bits that
    are not known yet count for nothing.
    """
    if isinstance(value, str) and number(value) is None:
        value = value.split("|")
    if not isinstance(value, (list, tuple)):
        return number(value)
    if len(value) > MAX_BITS:
        return None
    bits = 0
    for word in value:
        if not isinstance(word, str) or not word.strip() or len(word) > MAX_TEXT:
            return None
        name = parse_enum(enum, word.strip())
        if name is None and re.fullmatch(r"[A-Z0-9_]+", word.strip(), re.ASCII) is None:
            return None
        bits |= VALUES[enum][name] if name is not None else 0
    return bits


def names(enum: str, bits: int) -> tuple[str, ...]:
    """The canonical names of the bits that are known, lowest first."""
    return tuple(
        name
        for name, bit in sorted(VALUES[enum].items(), key=lambda each: each[1])
        if bit and bits & bit == bit
    )


def text(value: object) -> str | None:
    """A text that is not empty, cut at its limit."""
    return value.strip()[:MAX_TEXT] or None if isinstance(value, str) else None


def version(value: object) -> str | None:
    """`1.3.230` of a packed version or of `1.3.230 (4206822)`."""
    if isinstance(value, str):
        found = _VERSION.match(value.strip()[:MAX_TEXT])
        if found is not None:
            return found.group()
    packed = number(value)
    if packed is None or packed >= 1 << 32 or not packed >> 22 & 0x7F:
        return None
    return f"{packed >> 22 & 0x7F}.{packed >> 12 & 0x3FF}.{packed & 0xFFF}"


def is_feature(name: object) -> bool:
    """Whether a name can be that of a member of a features structure."""
    return isinstance(name, str) and _FEATURE.match(name) is not None


def is_extension(name: object) -> bool:
    """Whether a name can be an extension's."""
    return isinstance(name, str) and _EXTENSION.match(name) is not None
