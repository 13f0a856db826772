"""JSON as it streams by: texts of values with their places, parsed one at a time, so that memory does not grow with the file.

The values between are not looked into: where one ends is told by its layout, and where that is unusual by its brackets.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any, BinaryIO

import orjson

from .call import Broken, Place

BLOCK = 1 << 18
"""Bytes read at once: what fits the second cache is fastest to look through."""

MAX_VALUE = 64 << 20
"""Bytes of one line, or of one element."""

MAX_DEPTH = 100

BYTE_ORDER_MARK = b"\xef\xbb\xbf"
CUT = "the file ends in the middle"
TOO_DEEP = f"nested deeper than {MAX_DEPTH}"
TOO_LONG = f"a call of more than {MAX_VALUE >> 20} MiB"

_SPACES = re.compile(rb"[ \t\r\n]*")
_TOKEN = re.compile(rb'"(?:[^"\\]|\\.)*+"|["{}\[\]]', re.DOTALL)
_UNUSUAL = re.compile(r'"(?:[^"\\]|\\.)*+"|[-+]?\b(?:nan|inf|infinity)\b(?:\(\w*\))?', re.DOTALL | re.IGNORECASE)
_STRAY = re.compile(r'[\0-\x1f]|\\(?:["\\/bfnrt]|u[0-9a-fA-F]{4})|\\')
_SCALAR = re.compile(rb'"(?:[^"\\]|\\.)*+"|[^\s"{}\[\],:]++', re.DOTALL)


def loads(text: bytes, line: int, column: int = 1, call: int | None = None) -> Any:
    """The value of a text that begins at a line and column. Broken names the place within it that is no JSON, or nested too deep."""
    try:
        value = orjson.loads(text)
    except orjson.JSONDecodeError as error:
        if "limit" in error.msg.lower():
            raise Broken(TOO_DEEP, Place(line, column, call)) from None
        try:
            value = orjson.loads(_repaired(text))
        except orjson.JSONDecodeError:
            within = error.lineno - 1
            place = Place(line + within, error.colno if within else column + error.colno - 1, call)
            raise Broken(f"no JSON: {error.msg}", place) from None
    if text.count(b"{") + text.count(b"[") > MAX_DEPTH and _deep(value):
        raise Broken(TOO_DEEP, Place(line, column, call))
    return value


def shallow(text: bytes, kind: str) -> tuple[Any, str | None] | None:
    """The arguments and the result of a call that a text is, where it is JSON and has few brackets; None else: `loads` has the answer."""
    try:
        body = orjson.loads(text)[kind]
        args = body["args"]
        result = body.get("return")
    except (orjson.JSONDecodeError, LookupError, TypeError):
        return None
    if type(args) is not dict or (len(text) > MAX_DEPTH and text.count(b"{") + text.count(b"[") > MAX_DEPTH):
        return None
    return args, result if type(result) is str else None


def _repaired(text: bytes) -> str:
    """A text as JSON, where the tools write what is none: gfxrecon-convert 0.9 `-nan` and `inf` for floats, all of them names as they are,
    whatever their encoding and with control characters in them."""
    return _UNUSUAL.sub(_usual, text.decode("utf-8", "replace"))


def _usual(found: re.Match[str]) -> str:
    return _STRAY.sub(_escaped, found[0]) if found[0].startswith('"') else "null"


def _escaped(found: re.Match[str]) -> str:
    """An escape as it is; a control character as a space, and a backslash that escapes nothing as itself."""
    return " " if found[0] < " " else "\\\\" if found[0] == "\\" else found[0]


def _deep(value: Any) -> bool:
    """Whether anything stands more than MAX_DEPTH brackets deep."""
    level = [value]
    for _ in range(MAX_DEPTH):
        following: list[Any] = []
        for item in level:
            if isinstance(item, dict):
                following.extend(each for each in item.values() if isinstance(each, (dict, list)))
            elif isinstance(item, list):
                following.extend(each for each in item if isinstance(each, (dict, list)))
        if not following:
            return False
        level = following
    return True


class Joined:
    """A stream whose beginning was looked at."""

    def __init__(self, stream: BinaryIO) -> None:
        self.head = stream.read(1 << 16)
        self._unread = self.head
        self._stream = stream

    def read(self, size: int) -> bytes:
        """So many bytes, or fewer; none at the end."""
        if not self._unread:
            return self._stream.read(size)
        given, self._unread = self._unread[:size], self._unread[size:]
        return given


def _further(pending: int) -> int:
    """How much is read where so many bytes wait for their end: as much again, so that to join them stays linear, and within the limit."""
    return min(max(BLOCK, pending), MAX_VALUE + 1 - pending)


class Blocks:
    """The text of a stream in blocks that end with a line's end; `rest` is what the last line holds where nothing ends it.

    Broken for a line of more than 64 MiB, with its number.
    """

    def __init__(self, stream: BinaryIO | Joined) -> None:
        self.stream = stream
        self.lines = 0
        """Lines of the blocks given so far, to be counted up by who reads them."""
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
                raise Broken(TOO_LONG, Place(self.lines + 1, 1))
            more = self.stream.read(_further(len(rest)))
        self.rest = rest


def _indented(text: bytes) -> bool:
    """Whether a text is an object whose closing brackets all stand at the beginning of their lines, but for those of empty objects."""
    bare = text.translate(None, b" \t\r")
    closed = bare.count(b"}")
    return bare.endswith(b"\n}") and bare.count(b"{") == closed == bare.count(b"\n}") + bare.count(b"{}")


class Cursor:
    """A position in a stream of JSON: values are taken one after another, each as its text."""

    def __init__(self, stream: BinaryIO | Joined) -> None:
        self.stream = stream
        self.text = stream.read(BLOCK).removeprefix(BYTE_ORDER_MARK)
        self.at = 0
        self._counted = 0
        self._line = 1
        self._line_start = 0

    def place(self, call: int | None = None) -> Place:
        """Where the next character stands."""
        ends = self.text.count(b"\n", self._counted, self.at)
        if ends:
            self._line += ends
            self._line_start = self.text.rfind(b"\n", self._counted, self.at) + 1
        self._counted = self.at
        return Place(self._line, self.at - self._line_start + 1, call)

    def next(self) -> bytes:
        """The next character that is no space, not taken; nothing at the end."""
        while True:
            found = _SPACES.match(self.text, self.at)
            self.at = found.end() if found is not None else self.at
            if self.at < len(self.text):
                return self.text[self.at : self.at + 1]
            if not self._more():
                return b""

    def take(self, characters: bytes) -> bytes:
        """Takes the next character, one of some."""
        found = self.next()
        if not found:
            raise self.ends()
        if found not in characters:
            wanted = " or ".join(f"`{chr(each)}`" for each in characters)
            raise Broken(f"no JSON: {wanted} is missing", self.place())
        self.at += 1
        return found

    def ends(self) -> Broken:
        """That the file ends here, where something is missing yet."""
        self.at = len(self.text)
        return Broken(CUT, self.place())

    def value(self) -> bytes:
        """Takes the text of the next value: an object, an array, or what has no parts."""
        first = self.next()
        if not first:
            raise self.ends()
        end = 0
        if first == b"{":
            end = self._by_layout()
        if not end:
            end = self._by_brackets() if first in b"{[" else self._scalar()
        if end - self.at > MAX_VALUE:
            raise Broken(TOO_LONG, self.place())
        text = self.text[self.at : end]
        self.at = end
        return text

    def _by_layout(self) -> int:
        """Where the object ends whose first bracket stands alone on its line: at the bracket below it. 0 where that is not so.

        All tools that write captures as one array indent it so, and to look for the one bracket is ten times faster than for all of them.
        """
        start = self.text.rfind(b"\n", 0, self.at) + 1
        indent = self.text[start : self.at]
        following = self.text[self.at + 1 : self.at + 3]
        if not following.startswith((b"\n", b"\r\n")) or len(indent) > 64 or indent.strip(b" \t"):
            return 0
        outdented = re.compile(b"\n" + indent + b"[^ \t\r\n]")
        since = self.at
        while True:
            found = outdented.search(self.text, since)
            if found is not None:
                end = found.end()
                return end if _indented(self.text[self.at : end]) else 0
            searched = len(self.text) - self.at
            if not self._more():
                return 0
            since = self.at + max(0, searched - len(indent) - 2)

    def _by_brackets(self) -> int:
        """Where the object or array ends, by its brackets outside of texts."""
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
                raise self.ends()
            since = self.at + distance

    def _scalar(self) -> int:
        while True:
            found = _SCALAR.match(self.text, self.at)
            if found is not None and (found.end() < len(self.text) or found.group().endswith(b'"')):
                return found.end()
            if not self._more():
                if found is None and self.text[self.at : self.at + 1] != b'"':
                    raise Broken("no JSON: a value is missing", self.place())
                raise self.ends()

    def _more(self) -> bool:
        """Reads on, and forgets what was taken but for the line that the position is in; False at the end."""
        self.place()
        pending = len(self.text) - self.at
        if pending > MAX_VALUE:
            raise Broken(TOO_LONG, self.place())
        more = self.stream.read(_further(pending))
        if not more:
            return False
        kept = max(self._line_start, self.at - BLOCK)
        self.text = self.text[kept:] + more
        self.at -= kept
        self._counted = self.at
        self._line_start -= kept
        return True
