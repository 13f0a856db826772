"""Streaming JSON: finds the text of each value and its place, so that memory does not grow with the
file.

The end of a value is found from its indentation, or from its brackets if the indentation is
unusual.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any, BinaryIO

import orjson

from .call import CaptureError, Place

BLOCK = 1 << 18
"""Bytes read at a time. Blocks that fit the L2 cache are the fastest to search."""

MAX_VALUE = 64 << 20
"""Maximum size of a line or an array element, in bytes."""

MAX_PARSED = 12 << 20
"""Maximum size of a value that is parsed, in bytes; parsed small values take up to 70 times as much
memory.
"""

MAX_DEPTH = 100

BYTE_ORDER_MARK = b"\xef\xbb\xbf"
TRUNCATED = "the file is truncated"
TOO_DEEP = f"nested deeper than {MAX_DEPTH}"
TOO_LONG = f"a call exceeds {MAX_VALUE >> 20} MiB"
TOO_LONG_TO_PARSE = f"a call that is read exceeds {MAX_PARSED >> 20} MiB"

_SPACES = re.compile(rb"[ \t\r\n]*")
_TOKEN = re.compile(rb'"(?:[^"\\]|\\.)*+"|["{}\[\]]', re.DOTALL)
_UNUSUAL = re.compile(
    r'"(?:[^"\\]|\\.)*+"|[-+]?\b(?:nan|inf|infinity)\b(?:\(\w*\))?', re.DOTALL | re.IGNORECASE
)
_STRAY = re.compile(r'[\0-\x1f]|\\(?:["\\/bfnrt]|u[0-9a-fA-F]{4})|\\')
_SCALAR = re.compile(rb'"(?:[^"\\]|\\.)*+"|[^\s"{}\[\],:]++', re.DOTALL)


loads_plain = orjson.loads
"""Parses a value for which `is_plain` is true. Raises ValueError if it is not JSON."""


def loads(text: bytes, line: int, column: int = 1, call: int | None = None) -> Any:
    """Parses a value whose text starts at a line and column. Raises CaptureError at the place of a
    syntax error, and for a limit.
    """
    if len(text) > MAX_PARSED:
        raise CaptureError(TOO_LONG_TO_PARSE, Place(line, column, call))
    try:
        value = orjson.loads(text)
    except orjson.JSONDecodeError as error:
        if "depth" in error.msg:
            raise CaptureError(TOO_DEEP, Place(line, column, call)) from None
        try:
            value = orjson.loads(_repair(text))
        except orjson.JSONDecodeError:
            within = error.lineno - 1
            place = Place(line + within, error.colno if within else column + error.colno - 1, call)
            raise CaptureError(f"invalid JSON: {_mistake(text, error)}", place) from None
    if text.count(b"{") + text.count(b"[") > MAX_DEPTH and is_too_deep(value):
        raise CaptureError(TOO_DEEP, Place(line, column, call))
    return value


def _mistake(text: bytes, error: orjson.JSONDecodeError) -> str:
    """What is wrong with a text that is not JSON."""
    from msaa_lint.core.text.json_errors import json_problem

    # Places in the message would count from the beginning of the value.
    return re.sub(
        r" at line \d+, column \d+",
        "",
        json_problem(text.decode("utf-8", "replace"), error.pos).message,
    )


def is_plain(text: bytes) -> bool:
    """Whether the text of a value is certainly neither too large nor too deep, without parsing
    it.
    """
    # An object takes five characters at least, `{"":` and `}`. To count all brackets takes longer.
    if len(text) // 5 + text.count(b"[") <= MAX_DEPTH:
        return True
    return len(text) <= MAX_PARSED and text.count(b"{") + text.count(b"[") <= MAX_DEPTH


def _repair(text: bytes) -> str:
    """Valid JSON for the invalid JSON that the tools write: gfxrecon-convert 0.9 writes `-nan` and
    `inf` for floats, and all tools copy names verbatim, in any encoding and with control
    characters.
    """
    return _UNUSUAL.sub(_repair_token, text.decode("utf-8", "replace"))


def _repair_token(found: re.Match[str]) -> str:
    return _STRAY.sub(_repair_character, found[0]) if found[0].startswith('"') else "null"


def _repair_character(found: re.Match[str]) -> str:
    """Replaces a control character by a space and doubles a stray backslash; a valid escape is
    kept.
    """
    return " " if found[0] < " " else "\\\\" if found[0] == "\\" else found[0]


def is_too_deep(value: Any) -> bool:
    """Whether a value is nested more than MAX_DEPTH deep."""
    level = [value] if isinstance(value, (dict, list)) else []
    for _ in range(MAX_DEPTH):
        level = [
            child
            for item in level
            for child in (item.values() if isinstance(item, dict) else item)
            if isinstance(child, (dict, list))
        ]
    return bool(level)


class PeekedStream:
    """A stream that remembers its `head`, which can be inspected before anything is read."""

    def __init__(self, stream: BinaryIO) -> None:
        self.head = stream.read(1 << 16)
        self._unread = self.head
        self._stream = stream

    def read(self, size: int) -> bytes:
        """Up to `size` bytes; empty at the end."""
        if not self._unread:
            return self._stream.read(size)
        block, self._unread = self._unread[:size], self._unread[size:]
        return block


def _read_size(pending: int) -> int:
    """How many bytes to read while `pending` bytes wait for their end: as many again, which keeps
    joining linear, up to the limit.
    """
    return min(max(BLOCK, pending), MAX_VALUE + 1 - pending)


class Blocks:
    """The text of a stream in blocks of whole lines. `rest` is the last line if it has no line end.

    Raises CaptureError with the line number for a line of more than 64 MiB.
    """

    def __init__(self, stream: BinaryIO | PeekedStream) -> None:
        self.stream = stream
        self.lines = 0
        """Lines in the blocks so far. The consumer keeps this count."""
        self.rest = b""

    def __iter__(self) -> Iterator[bytes]:
        rest = b""
        more = self.stream.read(BLOCK).removeprefix(BYTE_ORDER_MARK)
        while more:
            end = more.rfind(b"\n") + 1
            if end:
                yield b"".join((rest, memoryview(more)[:end]))
                rest = more[end:]
            else:
                rest += more
            if len(rest) > MAX_VALUE:
                raise CaptureError(TOO_LONG, Place(self.lines + 1, 1))
            more = self.stream.read(_read_size(len(rest)))
        self.rest = rest


def _indented(text: bytes) -> bool:
    """Whether the text is an object whose closing brackets all start a line, apart from those of
    empty objects.
    """
    brackets = text.translate(None, b" \t\r")
    closed = brackets.count(b"}")
    return brackets.endswith(b"\n}") and brackets.count(b"{") == closed == brackets.count(
        b"\n}"
    ) + brackets.count(b"{}")


class Cursor:
    """A position in a JSON stream. Values are taken one after another, as text."""

    def __init__(self, stream: BinaryIO | PeekedStream) -> None:
        self.stream = stream
        self.text = stream.read(BLOCK).removeprefix(BYTE_ORDER_MARK)
        self.at = 0
        self._layout_debt = BLOCK
        """How many bytes may be searched in vain for the ends of objects by their layout."""
        self._counted = 0
        self._line = 1
        self._line_start = 0

    def place(self, call: int | None = None) -> Place:
        """The place of the next character."""
        ends = self.text.count(b"\n", self._counted, self.at)
        if ends:
            self._line += ends
            self._line_start = self.text.rfind(b"\n", self._counted, self.at) + 1
        self._counted = self.at
        return Place(self._line, self.at - self._line_start + 1, call)

    def next(self) -> bytes:
        """The next character that is not white space, without taking it; empty at the end."""
        while True:
            found = _SPACES.match(self.text, self.at)
            self.at = found.end() if found is not None else self.at
            if self.at < len(self.text):
                return self.text[self.at : self.at + 1]
            if not self._more():
                return b""

    def take(self, characters: bytes) -> bytes:
        """Takes the next character, which must be one of `characters`."""
        found = self.next()
        if not found:
            raise self.truncation()
        if found not in characters:
            expected = " or ".join(f"`{chr(character)}`" for character in characters)
            raise CaptureError(f"invalid JSON: expected {expected}", self.place())
        self.at += 1
        return found

    def elements(self, allow_empty: bool = True) -> Iterator[None]:
        """Takes an array, whose elements the caller takes: the position is at the beginning of
        each.
        """
        self.take(b"[")
        if self.next() == b"]" and allow_empty:
            self.at += 1
            return
        while True:
            self.next()
            yield
            if self.take(b",]") == b"]":
                return

    def expect_end(self) -> None:
        """Raises CaptureError if anything follows."""
        if self.next():
            raise CaptureError(
                "invalid JSON: unexpected text after the end of the document", self.place()
            )

    def truncation(self) -> CaptureError:
        """The error for a file that ends here."""
        self.at = len(self.text)
        return CaptureError(TRUNCATED, self.place())

    def value(self) -> bytes:
        """Takes the text of the next value: an object, an array or a scalar."""
        first = self.next()
        if not first:
            raise self.truncation()
        end = 0
        if first == b"{":
            end = self._end_by_layout()
        if not end:
            end = self._end_by_brackets() if first in b"{[" else self._scalar()
        if end - self.at > MAX_VALUE:
            raise CaptureError(TOO_LONG, self.place())
        text = self.text[self.at : end]
        self.at = end
        return text

    def _end_by_layout(self) -> int:
        """The end of an object whose opening bracket is alone on its line: the closing bracket at
        the same indentation. 0 if that fails.

        All tools that write captures as one array indent them this way, and finding one bracket is
        ten times faster than finding all.
        """
        if self._layout_debt < 0 or not self.text.startswith((b"\n", b"\r\n"), self.at + 1):
            return 0
        start = self.text.rfind(b"\n", max(self.at - 66, 0), self.at) + 1
        indent = self.text[start : self.at]
        if len(indent) > 64 or indent.strip(b" \t"):
            return 0
        outdented = re.compile(b"\n" + indent + b"[^ \t\r\n]")
        since = self.at
        while True:
            found = outdented.search(self.text, since)
            if found is not None:
                end = found.end()
                if _indented(self.text[self.at : end]):
                    self._layout_debt += end - self.at
                    return end
                self._layout_debt -= end - self.at
                return 0
            searched = len(self.text) - self.at
            if not self._more():
                self._layout_debt -= searched
                return 0
            since = self.at + max(0, searched - len(indent) - 2)

    def _end_by_brackets(self) -> int:
        """The end of an object or array, found by counting the brackets outside strings."""
        depth = 0
        since = self.at
        while True:
            for found in _TOKEN.finditer(self.text, since):
                token = self.text[found.start()]
                if token == 0x22:
                    if found.end() == found.start() + 1:
                        since = found.start()
                        break
                elif token in b"{[":
                    depth += 1
                else:
                    depth -= 1
                    if depth == 0:
                        return found.end()
                since = found.end()
            else:
                since = max(since, len(self.text))
            distance = since - self.at
            if not self._more():
                raise self.truncation()
            since = self.at + distance

    def _scalar(self) -> int:
        while True:
            found = _SCALAR.match(self.text, self.at)
            if found is not None and (found.end() < len(self.text) or found.group().endswith(b'"')):
                return found.end()
            if not self._more():
                if found is None and self.text[self.at : self.at + 1] != b'"':
                    raise CaptureError("invalid JSON: expected a value", self.place())
                raise self.truncation()

    def _more(self) -> bool:
        """Reads more and drops what was taken, except for the current line; False at the end."""
        self.place()
        pending = len(self.text) - self.at
        if pending > MAX_VALUE:
            raise CaptureError(TOO_LONG, self.place())
        more = self.stream.read(_read_size(pending))
        if not more:
            return False
        kept = max(self._line_start, self.at - BLOCK)
        self.text = self.text[kept:] + more
        self.at -= kept
        self._counted = self.at
        self._line_start -= kept
        return True
