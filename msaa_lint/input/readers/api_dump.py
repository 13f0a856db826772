"""LunarG api_dump: the output of VK_LAYER_LUNARG_api_dump with `VK_APIDUMP_OUTPUT_FORMAT=json`.

The file is an array of frames, each with its calls. Arguments and members are nodes with a type, a
name and a value; a null pointer has no value. The closing brackets are missing if the program was
killed. Handles come from the driver and are reused after they are freed.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any, BinaryIO

from msaa_lint.input.captures.call import Call, CaptureError, Mark, Place, is_wanted
from msaa_lint.input.captures.json_stream import BYTE_ORDER_MARK, TRUNCATED, Cursor, loads

HEAD = re.compile(rb'\s*\[\s*\{\s*"frameNumber"\s*:')
START = re.compile(rb'\{\s*"name"\s*:\s*"(\w{1,100})"')

MAX_CACHE = 16 << 20
"""Maximum total size of cached calls, in bytes of text; the parsed calls take less memory."""
MAX_CACHED_CALL = 1 << 18  # bytes

NO_ADDRESSES = (
    "the dump has no addresses, so objects cannot be told apart; run the program again "
    "without VK_APIDUMP_NO_ADDR"
)
NO_ARGUMENTS = "the dump has no arguments; run the program again without VK_APIDUMP_DETAILED=false"


def claims(head: bytes) -> bool:
    """Whether a file that starts with `head` is a JSON dump."""
    return HEAD.match(head.removeprefix(BYTE_ORDER_MARK)) is not None


def calls(stream: BinaryIO, wanted: frozenset[str], name: str | None) -> Iterator[Call | Mark]:
    """The calls of a dump. Identical calls may share their `args`, which must not be modified.

    Raises CaptureError if the text is truncated, is not JSON, or was written with settings that
    omit addresses or arguments.
    """
    cursor = Cursor(stream)
    reader = Reader(wanted)
    try:
        yield from _frames(cursor, reader)
    except CaptureError as error:
        if error.message != TRUNCATED:
            raise
        raise CaptureError(
            f"{TRUNCATED}: the captured program did not exit cleanly", error.place
        ) from None


def _frames(cursor: Cursor, reader: Reader) -> Iterator[Call | Mark]:
    """The calls of all frames."""
    first = True
    for _ in cursor.elements():
        at = cursor.place()
        for key in _keys(cursor):
            if key == "apiCalls":
                yield from reader.frame(cursor)
            else:
                number = _value(cursor)
                if key == "frameNumber" and first and number not in ("0", 0):
                    yield Mark("trimmed", at)
        first = False
    cursor.expect_end()


def _keys(cursor: Cursor) -> Iterator[str]:
    """The keys of an object. The caller must read each value before it asks for the next key."""
    cursor.take(b"{")
    if cursor.next() == b"}":
        cursor.take(b"}")
        return
    while True:
        if cursor.next() not in (b'"', b""):
            raise CaptureError("invalid JSON: expected a name", cursor.place())
        key = _value(cursor)
        cursor.take(b":")
        yield str(key)
        if cursor.take(b",}") == b"}":
            return


def _value(cursor: Cursor) -> Any:
    """The next value."""
    cursor.next()
    place = cursor.place()
    return loads(cursor.value(), place.line or 1, place.column or 1)


class Reader:
    """Parses calls, which are numbered through the whole file."""

    def __init__(self, wanted: frozenset[str]) -> None:
        self.wanted = wanted
        self.number = 0
        self.cache: dict[bytes, Call] = {}
        self.size = 0

    def frame(self, cursor: Cursor) -> Iterator[Call]:
        """The calls of the frame at the cursor."""
        for _ in cursor.elements():
            place = cursor.place(self.number)
            text = cursor.value()
            self.number += 1
            start = START.match(text)
            if start is None or is_wanted(self.wanted, start[1].decode("ascii")):
                cached = self.cache.get(text)
                call = cached._replace(at=place) if cached is not None else self.read(text, place)
                if call is not None:
                    yield call

    def read(self, text: bytes, place: Place) -> Call | None:
        """Parses one call; None if it is not wanted."""
        value = loads(text, place.line or 1, place.column or 1, place.call)
        name = value.get("name") if isinstance(value, dict) else None
        if not isinstance(value, dict) or not isinstance(name, str):
            raise CaptureError("invalid call: expected an object with a name", place)
        if not is_wanted(self.wanted, name):
            return None
        if "args" not in value:
            raise CaptureError(NO_ARGUMENTS, place)
        result = value.get("returnValue")
        call = Call(
            name,
            arguments_of(value["args"], place),
            place,
            result if isinstance(result, str) else None,
        )
        if len(text) <= MAX_CACHED_CALL:
            if self.size > MAX_CACHE:
                self.cache.clear()
                self.size = 0
            self.cache[text] = call
            self.size += len(text)
        return call


def arguments_of(nodes: object, place: Place) -> dict[str, Any]:
    """Argument nodes as plain data: a mapping by name, with nested mappings, lists and scalars."""
    arguments: dict[str, Any] = {}
    pending: list[tuple[object, Any]] = [(nodes, arguments)]
    while pending:
        level, container = pending.pop()
        if not isinstance(level, list):
            raise CaptureError(
                "invalid call: expected an array of arguments, members or elements", place
            )
        for node in level:
            if not isinstance(node, dict):
                raise CaptureError("invalid call: expected an object with a type and a name", place)
            value: Any
            if "members" in node:
                value = {}
                pending.append((node["members"], value))
            elif "elements" in node:
                value = []
                pending.append((node["elements"], value))
            else:
                value = _scalar(node, place)
            if isinstance(container, list):
                container.append(value)
            else:
                name = node.get("name")
                if not isinstance(name, str):
                    raise CaptureError("invalid call: a member has no name", place)
                # The dump has no SPIR-V, only a placeholder.
                if name != "pCode":
                    container[name] = value
    return arguments


def _scalar(node: dict[str, Any], place: Place) -> Any:
    """The value of a node: an integer for a handle, None for a null pointer, otherwise the text as
    written.
    """
    value = node.get("value")
    if not isinstance(value, str) or "char" in str(node.get("type")):
        return value
    if value == "address":
        raise CaptureError(NO_ADDRESSES, place)
    if value.startswith("0x") and len(value) <= 18:
        try:
            return int(value, 16)
        except ValueError:
            return value
    return None if value in ("UNUSED", "NULL") else value
