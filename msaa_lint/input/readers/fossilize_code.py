"""Fossilize's packed SPIR-V: each word in bytes of seven bits, lowest first, with the eighth bit
set on all but the last byte of a word.
"""

from __future__ import annotations

import re
import sys
from array import array

BLOCK = 1 << 18
"""Packed bytes unpacked at a time."""

MAX_CACHED_WORDS = 1 << 16
"""Maximum number of cached words."""

_CONTINUED = bytes(range(0x80, 0x100))
_WORD = re.compile(rb"[\x80-\xff]*[\x00-\x7f]")
_TOO_LONG = re.compile(rb"[\x80-\xff]{5}")


class _Words(dict[bytes, int]):
    """The values of packed words, cached because shaders repeat them."""

    def __missing__(self, packed: bytes) -> int:
        value = 0
        for at, byte in enumerate(packed):
            value |= (byte & 0x7F) << 7 * at
        if len(self) < MAX_CACHED_WORDS:
            self[packed] = value
        return value


_words = _Words()


def unpack_code(packed: bytes, size: int) -> bytes | None:
    """The code in bytes, little-endian; None if it does not unpack to `size` bytes."""
    if (
        size % 4
        or len(packed.translate(None, _CONTINUED)) != size // 4
        or packed[-1:] > b"\x7f"
        or _TOO_LONG.search(packed)
    ):
        return None
    words = array("I")
    value_of = _words.__getitem__
    at = 0
    while at < len(packed):
        end = min(at + BLOCK, len(packed))
        while packed[end - 1] > 0x7F:
            end += 1
        try:
            words.extend(map(value_of, _WORD.findall(packed, at, end)))
        except OverflowError:
            return None
        at = end
    if sys.byteorder == "big":
        words.byteswap()
    return words.tobytes()
