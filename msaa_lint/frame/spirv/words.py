"""SPIR-V as words and instructions, in either byte order."""

from __future__ import annotations

import array
from collections.abc import Iterator

MAGIC = 0x07230203
HEADER = 5
"""The number of words in the header."""

OP_NAME, OP_ENTRY_POINT, OP_VARIABLE, OP_STORE, OP_DECORATE = 5, 15, 59, 62, 71
MIN_WORDS = {OP_NAME: 2, OP_ENTRY_POINT: 4, OP_VARIABLE: 4, OP_STORE: 3, OP_DECORATE: 3}
"""The minimum number of words of these instructions."""


class SpirvError(ValueError):
    """The bytes are not valid SPIR-V."""


def words_of(code: bytes) -> array.array[int]:
    """The words of SPIR-V in this machine's byte order. Raises SpirvError if the bytes are not
    SPIR-V.
    """
    if len(code) < 4 * HEADER or len(code) % 4:
        raise SpirvError("not SPIR-V: its length is none of whole words")
    words = array.array("I", code)
    if words[0] != MAGIC:
        words.byteswap()
    if words[0] != MAGIC:
        raise SpirvError("not SPIR-V: it does not begin with its number")
    return words


def instructions(words: array.array[int]) -> Iterator[tuple[int, array.array[int]]]:
    """Every instruction: its opcode and its words. Raises SpirvError if one extends beyond the
    end.
    """
    at = HEADER
    while at < len(words):
        length = words[at] >> 16
        if not length or at + length > len(words):
            raise SpirvError("not SPIR-V: an instruction goes beyond its end")
        if length < MIN_WORDS.get(words[at] & 0xFFFF, 1):
            raise SpirvError("not SPIR-V: an instruction is too short")
        yield words[at] & 0xFFFF, words[at : at + length]
        at += length


def text_at(words: array.array[int], start: int, end: int) -> tuple[str, int]:
    """A string that begins at a word, and the index of the word after it. Raises SpirvError if it
    does not end before `end`.
    """
    made = bytearray()
    for at in range(start, end):
        part = words[at].to_bytes(4, "little")
        zero = part.find(0)
        if zero >= 0:
            made += part[:zero]
            return made.decode("utf-8", "replace"), at + 1
        made += part
    raise SpirvError("not SPIR-V: a text does not end")
