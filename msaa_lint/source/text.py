"""The text of an input, and places in it."""

from __future__ import annotations

import re
from bisect import bisect_right
from typing import NamedTuple

_LINE_END = re.compile(r"\r\n|\r|\n")

# What YAML 1.2 (section 5.1) does not allow in a stream. Lone surrogates cannot come out of a decoder.
_FORBIDDEN = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\x7f\x80-\x84\x86-\x9f\ufffe\uffff]")


class Unreadable(ValueError):
    """Input that is no text: what is wrong and where, in words."""


class Position(NamedTuple):
    """A place as people count: from 1, columns in code points."""

    line: int
    column: int


class Source:
    """A decoded text and the name that reports call it by. Lines end as in YAML: \\n, \\r\\n or a lone \\r."""

    __slots__ = ("_starts", "name", "text")

    def __init__(self, name: str, text: str) -> None:
        self.name = name
        self.text = text
        self._starts: list[int] | None = None

    @property
    def starts(self) -> list[int]:
        """The offset at which each line begins."""
        if self._starts is None:
            self._starts = [0, *(match.end() for match in _LINE_END.finditer(self.text))]
        return self._starts

    @property
    def line_count(self) -> int:
        """How many lines there are; a line end at the end of the text begins no further one, but in an empty text."""
        starts = self.starts
        return len(starts) - (1 if len(starts) > 1 and starts[-1] == len(self.text) else 0)

    def position(self, offset: int) -> Position:
        """The line and column of an offset."""
        line = bisect_right(self.starts, offset)
        return Position(line, offset - self.starts[line - 1] + 1)

    def line(self, number: int) -> str:
        """A line by its number, without its end."""
        starts = self.starts
        end = starts[number] if number < len(starts) else len(self.text)
        return self.text[starts[number - 1] : end].rstrip("\r\n")


def decode(data: bytes) -> str:
    """The text of an input: UTF-8, or UTF-16 with a byte order mark; the mark is taken off. Unreadable where it is neither."""
    if data.startswith((b"\xff\xfe", b"\xfe\xff")):
        encoding, body = "utf-16", data
    else:
        encoding, body = "utf-8", data.removeprefix(b"\xef\xbb\xbf")
    try:
        return body.decode(encoding)
    except UnicodeDecodeError as error:
        before = body[: error.start].decode(encoding, "replace")
        place = Source("", before).position(len(before))
        name = "UTF-16" if encoding == "utf-16" else "UTF-8"
        raise Unreadable(f"the input is no {name}: byte {error.start} (line {place.line}, column {place.column}): {error.reason}") from None


def forbidden(text: str) -> int | None:
    """The offset of the first character that YAML forbids; None where there is none."""
    match = _FORBIDDEN.search(text)
    return match.start() if match is not None else None
