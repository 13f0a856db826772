"""The text of an input, and places in it."""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Sequence
from typing import NamedTuple

# Compiled where they are used, which is rare.
_LINE_END = r"\r\n|\r|\n"
# The characters that YAML 1.2 (section 5.1) forbids in a stream.
_FORBIDDEN = "[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x84\x86-\x9f\ud800-\udfff\ufffe\uffff]"
_ALLOWED_ASCII = bytes([9, 10, 13, *range(32, 127)])

_MARKS = {b"\xef\xbb\xbf": "utf-8", b"\xff\xfe": "utf-16-le", b"\xfe\xff": "utf-16-be"}
_NAMES = {"utf-8": "UTF-8", "utf-16-le": "UTF-16", "utf-16-be": "UTF-16"}


class Unreadable(ValueError):
    """An input that is not text or is too large. `offset` is that of the invalid byte, `before` the
    text before it, if it is UTF-8.
    """

    def __init__(self, message: str, offset: int | None = None, before: str | None = None) -> None:
        super().__init__(message)
        self.offset = offset
        self.before = before


class Position(NamedTuple):
    """A line and a column, both counted from 1, columns in code points."""

    line: int
    column: int


class Origin(NamedTuple):
    """The origin of a line in a text that was made from a capture.

    `line` and `column` are the place of the call (None in a binary capture), `call` its index and
    `by` its name; `frames` of `of` frames use what the line states (None if that was not counted).
    """

    line: int | None
    column: int | None
    call: int | None
    by: str
    frames: int | None = None
    of: int = 0


class Source:
    """A decoded text and its name in reports. Lines end as in YAML: \\n, \\r\\n or a lone \\r.

    `origins` has the call that each line comes from, if the text was made from a capture.
    """

    __slots__ = ("_starts", "name", "origins", "text")

    def __init__(
        self, name: str, text: str, origins: Sequence[Origin | None] | None = None
    ) -> None:
        self.name = name
        self.text = text
        self.origins = origins
        self._starts: list[int] | None = None

    def origin(self, offset: int) -> Origin | None:
        """The call that the line at an offset comes from; None if there is none."""
        if self.origins is None:
            return None
        line = self.position(offset).line
        return self.origins[line - 1] if line <= len(self.origins) else None

    @property
    def starts(self) -> list[int]:
        """The offset at which each line begins."""
        if self._starts is None:
            self._starts = [0, *(match.end() for match in re.finditer(_LINE_END, self.text))]
        return self._starts

    @property
    def line_count(self) -> int:
        """The number of lines, at least 1. A line end at the end of the text does not begin another
        line.
        """
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
    """The text of an input in UTF-8, or in UTF-16 with a byte order mark, without the mark. Raises
    Unreadable if it is neither.
    """
    mark, encoding = _encoding(data)
    body = data[len(mark) :] if mark else data
    try:
        return body.decode(encoding)
    except UnicodeDecodeError as error:
        before = Source("", body[: error.start].decode(encoding))
        place = before.position(len(before.text))
        offset = len(mark) + error.start
        message = (
            f"the input is not {_NAMES[encoding]}: byte {offset} (line {place.line}, column "
            f"{place.column}) {_invalid(body, error.start)}"
        )
        raise Unreadable(message, offset, before.text if encoding == "utf-8" else None) from None


def _invalid(body: bytes, at: int) -> str:
    """What an invalid byte is, and what to do."""
    if b"\0" in body[:64]:
        return f"is 0x{body[at]:02X}; this is not a text file"
    letter = body[at : at + 1].decode("cp1252", "replace")
    legacy = (
        f", which is `{letter}` in Windows-1252"
        if letter.isprintable() and letter != "\ufffd"
        else ""
    )
    return f"is 0x{body[at]:02X}{legacy}; save the file as UTF-8"


def encode(text: str, like: bytes) -> bytes:
    """The bytes of a text in the encoding of `like`, with a byte order mark if `like` has one; the
    inverse of `decode`.
    """
    mark, encoding = _encoding(like)
    return mark + text.encode(encoding)


def _encoding(data: bytes) -> tuple[bytes, str]:
    for mark, encoding in _MARKS.items():
        if data.startswith(mark):
            return mark, encoding
    return b"", "utf-8"


def forbidden(text: str) -> int | None:
    """The offset of the first character that YAML forbids; None if there is none."""
    # Most descriptions are ASCII, and bytes are searched seven times as fast.
    if text.isascii() and not text.encode().translate(None, _ALLOWED_ASCII):
        return None
    match = re.search(_FORBIDDEN, text)
    return match.start() if match is not None else None


def forbidden_message(text: str, at: int) -> str:
    """What to say about a character that YAML forbids."""
    if text[at] != "\0":
        number = f"{ord(text[at]):04X}"
        return (
            f"the character U+{number} is not allowed in YAML or JSON; delete it, or write "
            f"`\\u{number}` in double quotes"
        )
    head = text[:64]
    if len(head) >= 4 and head.count("\0") * 3 >= len(head):
        return (
            "the text looks like UTF-16 or UTF-32, which is read with a byte order mark only in "
            "UTF-16; save the file as UTF-8"
        )
    return "the character U+0000 is not allowed in YAML or JSON; delete it"
