"""LunarG api_dump: what the layer VK_LAYER_LUNARG_api_dump writes with `VK_APIDUMP_OUTPUT_FORMAT=json`.

An array of frames, each with its calls; arguments and members are nodes that say their type, name and value, and a null pointer is a node
without one. A program that was killed leaves the last brackets out. Handles are the driver's own, which come again after they were freed.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any, BinaryIO

from msaa_lint.input.captures.call import Broken, Call, Mark, Place
from msaa_lint.input.captures.call_names import wants
from msaa_lint.input.captures.json_stream import BYTE_ORDER_MARK, CUT, Cursor, loads

NAME = "api-dump"

HEAD = re.compile(rb'\s*\[\s*\{\s*"frameNumber"\s*:')
START = re.compile(rb'\{\s*"name"\s*:\s*"(\w{1,100})"')

MAX_KEPT = 16 << 20
"""Bytes of calls whose values are kept for when they recur; parsed they take less."""
MAX_KEPT_CALL = 1 << 18

NO_ADDRESSES = "the dump has no addresses, so that nothing tells one object from another: run the program again without VK_APIDUMP_NO_ADDR"
NO_ARGUMENTS = "the dump has no arguments: run the program again without VK_APIDUMP_DETAILED=false"


def claims(head: bytes) -> bool:
    """Whether a file that begins so is a dump as JSON."""
    return HEAD.match(head.removeprefix(BYTE_ORDER_MARK)) is not None


def calls(stream: BinaryIO, wanted: frozenset[str], name: str | None) -> Iterator[Call | Mark]:
    """The calls of a dump. Calls that are written alike may share their arguments, which are not to be changed.

    Broken where the text ends in the middle, is no JSON, or was written with settings that leave out what is needed.
    """
    cursor = Cursor(stream)
    reader = Reader(wanted)
    try:
        yield from _frames(cursor, reader)
    except Broken as error:
        if error.message != CUT:
            raise
        raise Broken(f"{CUT}: the program that was captured did not end in order", error.place) from None


def _frames(cursor: Cursor, reader: Reader) -> Iterator[Call | Mark]:
    """The calls of all frames."""
    cursor.take(b"[")
    first = True
    while True:
        if cursor.next() == b"]" and first:
            cursor.take(b"]")
            break
        at = cursor.place()
        for key in _keys(cursor):
            if key == "apiCalls":
                yield from reader.frame(cursor)
            else:
                number = _value(cursor)
                if key == "frameNumber" and first and number not in ("0", 0):
                    yield Mark("trimmed", at)
        first = False
        if cursor.take(b",]") == b"]":
            break
    if cursor.next():
        raise Broken("no JSON: the file goes on after its end", cursor.place())


def _keys(cursor: Cursor) -> Iterator[str]:
    """The keys of an object, each taken up to its value, which is to be taken before the next."""
    cursor.take(b"{")
    if cursor.next() == b"}":
        cursor.take(b"}")
        return
    while True:
        if cursor.next() not in (b'"', b""):
            raise Broken("no JSON: a name is missing", cursor.place())
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
    """The calls of frames, numbered throughout the file."""

    def __init__(self, wanted: frozenset[str]) -> None:
        self.wanted = wanted
        self.number = 0
        self.kept: dict[bytes, Call] = {}
        self.size = 0

    def frame(self, cursor: Cursor) -> Iterator[Call]:
        """The calls of one frame, which the cursor stands before."""
        cursor.take(b"[")
        if cursor.next() == b"]":
            cursor.take(b"]")
            return
        while True:
            cursor.next()
            place = cursor.place(self.number)
            text = cursor.value()
            self.number += 1
            start = START.match(text)
            if start is None or wants(self.wanted, start[1].decode("ascii")):
                known = self.kept.get(text)
                made = known._replace(at=place) if known is not None else self.read(text, place)
                if made is not None:
                    yield made
            if cursor.take(b",]") == b"]":
                return

    def read(self, text: bytes, place: Place) -> Call | None:
        """The call that a text is; None where nobody wants it."""
        value = loads(text, place.line or 1, place.column or 1, place.call)
        name = value.get("name") if isinstance(value, dict) else None
        if not isinstance(value, dict) or not isinstance(name, str):
            raise Broken("no call: an object with a name is expected", place)
        if not wants(self.wanted, name):
            return None
        if "args" not in value:
            raise Broken(NO_ARGUMENTS, place)
        result = value.get("returnValue")
        made = Call(name, plain(value["args"], place), place, result if isinstance(result, str) else None)
        if len(text) <= MAX_KEPT_CALL:
            if self.size > MAX_KEPT:
                self.kept.clear()
                self.size = 0
            self.kept[text] = made
            self.size += len(text)
        return made


def plain(nodes: object, place: Place) -> dict[str, Any]:
    """Nodes as a mapping by their names, all that is within them as mappings, lists and values."""
    made: dict[str, Any] = {}
    rest: list[tuple[object, Any]] = [(nodes, made)]
    while rest:
        level, into = rest.pop()
        if not isinstance(level, list):
            raise Broken("no call: an array of arguments, members or elements is expected", place)
        for node in level:
            if not isinstance(node, dict):
                raise Broken("no call: an object with a type and a name is expected", place)
            value: Any
            if "members" in node:
                value = {}
                rest.append((node["members"], value))
            elif "elements" in node:
                value = []
                rest.append((node["elements"], value))
            else:
                value = _scalar(node, place)
            if isinstance(into, list):
                into.append(value)
            else:
                name = node.get("name")
                if not isinstance(name, str):
                    raise Broken("no call: a member has no name", place)
                # What stands in the place of SPIR-V.
                if name != "pCode":
                    into[name] = value
    return made


def _scalar(node: dict[str, Any], place: Place) -> Any:
    """The value of a node: a handle as a number, None for a null pointer, else as it is written."""
    value = node.get("value")
    if not isinstance(value, str) or "char" in str(node.get("type")):
        return value
    if value == "address":
        raise Broken(NO_ADDRESSES, place)
    if value.startswith("0x") and len(value) <= 18:
        try:
            return int(value, 16)
        except ValueError:
            return value
    return None if value in ("UNUSED", "NULL") else value
