"""gfxreconstruct: the output of `gfxrecon-convert` 0.9 and 1.x, as JSON Lines or as one JSON array.

A call is an object with `index` and, depending on the version, `vkFunc` or `function`. The file
also contains `meta` commands, two of which describe the device, and markers for the state of a
trimmed capture. Lines of unwanted calls are not parsed.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from contextlib import suppress
from typing import Any, BinaryIO

from msaa_lint.core.text.files import read
from msaa_lint.core.text.source import Unreadable
from msaa_lint.core.urls import is_folder, is_url
from msaa_lint.input.captures.call import Call, CaptureError, Mark, Place, is_wanted
from msaa_lint.input.captures.json_stream import (
    BYTE_ORDER_MARK,
    TRUNCATED,
    Blocks,
    Cursor,
    PeekedStream,
    is_plain,
    loads,
    loads_plain,
)
from msaa_lint.input.captures.values import chain, items, record

DEVICE_COMMANDS = frozenset({"SetDevicePropertiesCommand", "SetDeviceMemoryPropertiesCommand"})
"""The `meta` commands that describe the device. A trimmed capture has them instead of the
queries.
"""

HEAD = re.compile(
    rb'\s*(?:\[\s*)?\{\s*"(?:header"\s*:\s*\{\s*"source-path"|index"\s*:\s*\d+\s*,\s*"(?:vkFunc|function|meta|annotation)"|'
    rb'state"\s*:\s*\{\s*"marker_)'
)
# The layer puts the frame range into the file name of a trimmed capture.
TRIMMED = re.compile(r"_frames?_\d+(?:_through_\d+)?\b|_trim_trigger")
CONVERTED_ENDING = re.compile(r"(?:\.gfxr)?(?:\.jsonl?)?\Z")
START = re.compile(
    rb'\{\s*"index"\s*:\s*(\d{1,18})\s*,\s*"(vkFunc|function|meta|method)"\s*:\s*\{\s*"name"\s*:\s*"(\w{1,100})"'
)
PREFIX = b'{"index":'
LINE_START = re.compile(
    rb'\{"index":\d{1,18}(,"(vkFunc|function|meta|method)":\{"name":"(\w{2,100}))"'
)
NAME_END = len(',"function":{"name":"')
"""Where to look for the quote that ends the name in a match of LINE_START's first group; a name has
two letters or more.
"""
MAX_STARTS = 10_000

MAX_CACHE = 8 << 20
"""Maximum total size of cached lines, in bytes of text; the parsed calls take about five times as
much memory.
"""
MAX_CACHED_CALL = 1 << 16  # bytes
CREDIT = 1 << 13
"""How many lines of a call are cached although none of them recurs. After that, none is for 16
times as many lines.
"""
CREDIT_PER_HIT = 2
PAUSE = 16 * CREDIT
MAX_FILE = 16 << 20
"""Maximum size of a shader file in bytes; larger ones are skipped."""

MAX_CODE = 128 << 20
"""Maximum total size of the shader files of a capture in bytes; the tracker keeps their contents in
memory.
"""

MAX_PATH = 4096


def claims(head: bytes) -> bool:
    """Whether a file that starts with `head` is a converted capture."""
    return HEAD.match(head.removeprefix(BYTE_ORDER_MARK)) is not None


def calls(stream: BinaryIO, wanted: frozenset[str], name: str | None) -> Iterator[Call | Mark]:
    """The calls and marks of a capture. Identical calls may share their `args`, which must not be
    modified.

    Shader files that the capture names are read from the folder of the file `name`. Raises
    CaptureError if the text is truncated or is not JSON.
    """
    peeked = PeekedStream(stream)
    reader = Reader(wanted, name)
    is_array = peeked.head.removeprefix(BYTE_ORDER_MARK).lstrip()[:1] == b"["
    return _elements(Cursor(peeked), reader) if is_array else _lines(Blocks(peeked), reader)


def _file_beside(capture: str | None, path: str) -> bytes | None:
    """The contents of a file at a path relative to a capture; None if it is outside the capture's
    folder, unreadable, or larger than 16 MiB.
    """
    if not capture or not 0 < len(path) <= MAX_PATH:
        return None
    folder = os.path.dirname(capture if is_url(capture) else os.path.abspath(capture))
    try:
        # A converter on Windows writes backslashes.
        return read(os.path.join(folder, path.replace("\\", "/")), MAX_FILE, folder)
    except (OSError, Unreadable):
        return None


def _extracted_shaders(capture: str | None, source: str) -> str:
    """The name of the folder beside a capture with the shaders that gfxrecon-extract writes for a
    file `source`; empty if there is none.
    """
    name = f"{source}.shaders"
    return (
        name
        if capture and source and _is_folder(os.path.join(os.path.dirname(capture), name))
        else ""
    )


def _is_folder(path: str) -> bool:
    with suppress(OSError):
        return is_folder(path) if is_url(path) else os.path.isdir(path)
    return False


class LineStart:
    """The start of a line, up to the call's name. `plain` says whether the arguments need no
    conversion and may recur.
    """

    __slots__ = ("credit", "kind", "name", "plain", "wanted")

    def __init__(self, kind: str, name: str, wanted: bool) -> None:
        self.kind = kind
        self.name = name
        self.wanted = wanted
        self.plain = kind != "meta" and _recurs(name)
        self.credit = CREDIT
        """How many further lines are cached, or if it is negative, are not. Lines that recur raise
        it.
        """


class CachedLine:
    """A line that may recur: its text after the index, its call, and the cached line that followed
    it last, at first itself.
    """

    __slots__ = ("args", "body", "following", "result", "start")

    def __init__(
        self, body: bytes, start: LineStart, args: dict[str, Any], result: str | None
    ) -> None:
        self.body = body
        self.start = start
        self.args = args
        self.result = result
        self.following = self


class LineCache(dict[bytes, CachedLine]):
    """The cached lines by their text after the index. They refer to each other until `forget` is
    called.
    """

    def __init__(self) -> None:
        self.size = 0

    def add(self, line: CachedLine) -> None:
        """Adds a line, and forgets all others if they are too many."""
        self.size += len(line.body)
        if self.size > MAX_CACHE:
            self.forget()
            self.size = len(line.body)
        self[line.body] = line

    def forget(self) -> None:
        """Removes all lines."""
        for line in self.values():
            del line.following
        self.clear()


class Reader:
    """Converts JSON objects to calls and marks."""

    def __init__(self, wanted: frozenset[str], name: str | None) -> None:
        self.wanted = wanted
        self.file = name
        self.vulkan = False
        self.direct3d = False
        self.trimmed = False
        self.code_budget = MAX_CODE
        self.extracted = _extracted_shaders(
            name, CONVERTED_ENDING.sub(".gfxr", os.path.basename(name or ""), count=1)
        )
        """The folder of the shaders that gfxrecon-extract wrote, by its name beside the capture;
        empty without any.
        """
        self.starts: dict[bytes, LineStart] = {}
        """By the text from the end of the index to the end of the name."""

    def start(self, match: re.Match[bytes]) -> LineStart:
        """Interprets a match of LINE_START."""
        kind, name = match[2].decode("ascii"), match[3].decode("ascii")
        start = LineStart(kind, name, self.is_wanted(kind, name))
        if len(self.starts) < MAX_STARTS:
            self.starts[match[1]] = start
        return start

    def is_wanted(self, kind: str, name: str) -> bool:
        """Whether a call or a `meta` command is wanted."""
        if kind == "method":
            self.direct3d = True
            return False
        if kind == "meta":
            return name in DEVICE_COMMANDS
        self.vulkan = True
        return is_wanted(self.wanted, name)

    def read(self, text: bytes, line: int, column: int) -> Call | Mark | None:
        """Parses an object; None if it is not wanted."""
        value = loads(text, line, column)
        if not isinstance(value, dict):
            raise CaptureError("invalid call: expected an object", Place(line, column))
        index = value.get("index")
        place = Place(line, column, index if type(index) is int else None)
        for kind in ("function", "vkFunc", "meta", "method"):
            if kind in value:
                return self._call(kind, value[kind], place)
        return self._mark(value, place)

    def finish(self) -> None:
        """Ends the capture. Raises CaptureError if it contained no Vulkan call."""
        if not self.vulkan:
            raise CaptureError(
                "this capture contains no Vulkan calls"
                + (", only Direct3D calls" if self.direct3d else ""),
                Place(1, 1),
            )

    def _call(self, kind: str, body: object, place: Place) -> Call | None:
        name = body.get("name") if isinstance(body, dict) else None
        if not isinstance(body, dict) or not isinstance(name, str):
            raise CaptureError(f"invalid call: `{kind}` has no name", place)
        if not self.is_wanted(kind, name):
            return None
        args = body.get("args", {})
        if not isinstance(args, dict):
            raise CaptureError("invalid call: `args` must be an object", place)
        if name.startswith("vkCreate"):
            self._read_shaders(args)
            if name == "vkCreateShaderModule" and self.extracted:
                self._read_extracted_shader(args)
            if kind == "vkFunc" and name == "vkCreateGraphicsPipelines":
                _drop_null_sample_masks(args)
        result = body.get("return")
        return Call(name, args, place, result if isinstance(result, str) else None)

    def _mark(self, value: dict[str, Any], place: Place) -> Mark | None:
        header, state, frame = value.get("header"), value.get("state"), value.get("frame")
        if isinstance(frame, dict) and frame.get("marker_type") == "EndMarker":
            return Mark("frame", place)
        path = header.get("source-path") if isinstance(header, dict) else None
        if isinstance(path, str):
            path = re.split(r"[/\\]", path)[-1]
            self.extracted = self.extracted or _extracted_shaders(self.file, path)
        begins = isinstance(state, dict) and state.get("marker_type") == "BeginMarker"
        if self.trimmed or not (begins or (isinstance(path, str) and TRIMMED.search(path))):
            return None
        self.trimmed = True
        return Mark("trimmed", place)

    def _read_shaders(self, args: dict[str, Any]) -> None:
        """Replaces the file names in `pCode` by the code from files beside the capture, and removes
        other placeholders.
        """
        for info in (args.get("pCreateInfo"), *items(args.get("pCreateInfos"))):
            for structure in (info, *items(record(info).get("pStages"))):
                for holder in (holder for holder in chain(structure) if "pCode" in holder):
                    path = holder.pop("pCode")
                    code = (
                        self._code(path)
                        if isinstance(path, str) and not path.startswith(("[", "0x"))
                        else None
                    )
                    if code is not None:
                        holder["pCode"] = code

    def _read_extracted_shader(self, args: dict[str, Any]) -> None:
        """Adds the code that gfxrecon-extract wrote to a shader module without any."""
        info, handle = args.get("pCreateInfo"), args.get("pShaderModule")
        if isinstance(info, dict) and "pCode" not in info and type(handle) is int:
            code = self._code(f"{self.extracted}/sh{handle}")
            if code is not None:
                info["pCode"] = code

    def _code(self, path: str) -> bytes | None:
        """The contents of a shader file, at a path relative to the capture."""
        code = _file_beside(self.file, path)
        if code is None or len(code) > self.code_budget:
            return None
        self.code_budget -= len(code)
        return code


def _drop_null_sample_masks(args: dict[str, Any]) -> None:
    """Removes null sample masks: version 0.9 writes null for every mask, so its value is
    unknown.
    """
    for info in items(args.get("pCreateInfos")):
        state = record(record(info).get("pMultisampleState"))
        if state.get("pSampleMask", ...) is None:
            del state["pSampleMask"]


def _recurs(name: str) -> bool:
    """Whether a call may recur with the same arguments. A call that creates an object has a new
    handle each time.
    """
    return not name.startswith(("vkCreate", "vkAllocate", "vkGet"))


def _lines(blocks: Blocks, reader: Reader) -> Iterator[Call | Mark]:
    """The calls of JSON Lines.

    Lines of unwanted calls are skipped for their first characters. Lines that recur, apart from
    their index, are not parsed again: a frame usually resembles the one before it, so that most are
    recognized as the line that followed last time.
    """
    new = tuple.__new__
    parse = loads_plain
    find_start = reader.starts.get
    cache = LineCache()
    last = CachedLine(b"", LineStart("", "", False), {}, None)
    index_end = 10
    """The length of a line's text up to the end of its index."""
    for block in blocks:
        lines = block.split(b"\n")
        lines.pop()
        for number, line in enumerate(lines, blocks.lines + 1):
            body = line[index_end:]
            cached = last.following
            if body == cached.body and line.startswith(PREFIX):
                last = cached
                start = cached.start
                start.credit += CREDIT_PER_HIT
                args, result, recurring = cached.args, cached.result, len(body)
            else:
                known = find_start(body[: body.find(b'"', NAME_END)])
                if known is not None and line.startswith(PREFIX):
                    start = known
                else:
                    match = LINE_START.match(line)
                    if match is None:
                        call_or_mark = (
                            reader.read(line, number, 1) if line and not line.isspace() else None
                        )
                        if call_or_mark is not None:
                            yield call_or_mark
                        continue
                    start = find_start(match[1]) or reader.start(match)
                    index_end = match.start(1)
                    body = line[index_end:]
                if not start.wanted:
                    continue
                credit = start.credit
                found = cache.get(body) if credit > 0 else None
                if found is not None:
                    last.following = last = found
                    args, result, recurring = found.args, found.result, len(body)
                    start.credit = credit + CREDIT_PER_HIT
                else:
                    # Common calls are parsed here, unusual ones by the reader.
                    args = None
                    recurring = 0
                    if start.plain and is_plain(line):
                        try:
                            call = parse(line)[start.kind]
                            args, result = call["args"], call.get("return")
                        except (ValueError, LookupError, TypeError):
                            pass  # not JSON, or not a call
                    if type(args) is not dict or (type(result) is not str and result is not None):
                        call_or_mark = reader.read(line, number, 1)
                        if call_or_mark is not None:
                            yield call_or_mark
                        continue
                    if credit <= 0:
                        start.credit = credit + 1 or CREDIT
                    else:
                        start.credit = min(credit, CREDIT) - 1 or -PAUSE
                        if len(body) <= MAX_CACHED_CALL:
                            found = CachedLine(body, start, args, result)
                            cache.add(found)
                            last.following = last = found
            try:
                place = new(Place, (number, 1, int(line[len(PREFIX) : index_end])))
            except ValueError:
                call_or_mark = reader.read(line, number, 1)
                if call_or_mark is not None:
                    yield call_or_mark
            else:
                yield new(Call, (start.name, args, place, result, recurring))
        blocks.lines += len(lines)
    cache.forget()
    if blocks.rest.strip():
        try:
            call_or_mark = reader.read(blocks.rest, blocks.lines + 1, 1)
        except CaptureError as error:
            if not error.message.startswith("invalid JSON"):
                raise
            raise CaptureError(f"{TRUNCATED} in this line", Place(blocks.lines + 1, 1)) from None
        if call_or_mark is not None:
            yield call_or_mark
    reader.finish()


def _elements(cursor: Cursor, reader: Reader) -> Iterator[Call | Mark]:
    """The calls of a JSON array."""
    cache: dict[bytes, Call] = {}
    size = 0
    for _ in cursor.elements(allow_empty=False):
        place = cursor.place()
        text = cursor.value()
        start = START.match(text)
        if start is None or reader.is_wanted(start[2].decode("ascii"), start[3].decode("ascii")):
            body = text[start.end(1) :] if start is not None else text
            cached = cache.get(body)
            if cached is not None and start is not None:
                yield cached._replace(at=place._replace(call=int(start[1])), recurring=len(body))
            else:
                assert place.line is not None and place.column is not None
                call_or_mark = reader.read(text, place.line, place.column)
                if (
                    isinstance(call_or_mark, Call)
                    and start is not None
                    and len(body) <= MAX_CACHED_CALL
                    and _recurs(call_or_mark.name)
                ):
                    if size > MAX_CACHE:
                        cache.clear()
                        size = 0
                    cache[body] = call_or_mark
                    size += len(body)
                if call_or_mark is not None:
                    yield call_or_mark
    cursor.expect_end()
    reader.finish()
