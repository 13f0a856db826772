"""gfxreconstruct: the output of `gfxrecon-convert` 0.9 and 1.x, as JSON Lines or as one JSON array.

A call is an object with `index` and, depending on the version, `vkFunc` or `function`. The file also contains `meta` commands, two of which
describe the device, and markers for the state of a trimmed capture. Lines of unwanted calls are not parsed.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from typing import Any, BinaryIO, NamedTuple

from msaa_lint.core.text.files import read
from msaa_lint.core.text.source import Unreadable
from msaa_lint.input.captures.call import Call, CaptureError, Mark, Place, is_wanted
from msaa_lint.input.captures.json_stream import BYTE_ORDER_MARK, TRUNCATED, Blocks, Cursor, PeekedStream, loads, parse_call
from msaa_lint.input.captures.values import chain, items, record

DEVICE_COMMANDS = frozenset({"SetDevicePropertiesCommand", "SetDeviceMemoryPropertiesCommand"})
"""The `meta` commands that describe the device. A trimmed capture has them instead of the queries."""

HEAD = re.compile(
    rb'\s*(?:\[\s*)?\{\s*"(?:header"\s*:\s*\{\s*"source-path"|index"\s*:\s*\d+\s*,\s*"(?:vkFunc|function|meta|annotation)"|'
    rb'state"\s*:\s*\{\s*"marker_)'
)
# The layer puts the frame range into the file name of a trimmed capture.
TRIMMED = re.compile(r"_frames?_\d+(?:_through_\d+)?\b|_trim_trigger")
START = re.compile(rb'\{\s*"index"\s*:\s*(\d{1,18})\s*,\s*"(vkFunc|function|meta|method)"\s*:\s*\{\s*"name"\s*:\s*"(\w{1,100})"')
PREFIX = b'{"index":'
LINE_START = re.compile(rb'\{"index":\d{1,18}(,"(vkFunc|function|meta|method)":\{"name":"(\w{1,100})")')

MAX_CACHE = 12 << 20
"""Maximum total size of cached lines, in bytes of text; the parsed calls take about five times as much memory."""
MAX_CACHED_CALL = 1 << 16  # bytes
MAX_HISTORY = 1 << 19
"""How many lines back a repetition is found."""
MIN_HIT_RATIO = 1.25
MAX_FILE = 16 << 20
"""Maximum size of a shader file in bytes; larger ones are skipped."""

MAX_PATH = 4096

PAUSE = 16
"""If fewer than a fifth of the lines repeat earlier ones, nothing is cached for 16 times as many lines."""


def claims(head: bytes) -> bool:
    """Whether a file that starts with `head` is a converted capture."""
    return HEAD.match(head.removeprefix(BYTE_ORDER_MARK)) is not None


def calls(stream: BinaryIO, wanted: frozenset[str], name: str | None) -> Iterator[Call | Mark]:
    """The calls and marks of a capture. Identical calls may share their `args`, which must not be modified.

    Shader files that the capture names are read from the folder of the file `name`. Raises CaptureError if the text is truncated or is not
    JSON.
    """
    peeked = PeekedStream(stream)
    reader = Reader(wanted, name)
    is_array = peeked.head.removeprefix(BYTE_ORDER_MARK).lstrip()[:1] == b"["
    return _elements(Cursor(peeked), reader) if is_array else _lines(Blocks(peeked), reader)


def _file_beside(capture: str | None, path: str) -> bytes | None:
    """The contents of a file at a path relative to a capture; None if it is outside the capture's folder, unreadable, or larger than 16
    MiB."""
    if not capture or not 0 < len(path) <= MAX_PATH:
        return None
    folder = os.path.dirname(os.path.abspath(capture))
    try:
        # A converter on Windows writes backslashes.
        return read(os.path.join(folder, path.replace("\\", "/")), MAX_FILE, folder)
    except (OSError, Unreadable):
        return None


CachedLine = tuple[bytes, int, str, Any, str | None]
"""A line: its text after the index, including the line end, and the length of that; the call's name, arguments and result.

For an unwanted call the text ends after the name, and the name is empty.
"""

NO_LINE: CachedLine = (b"\0", 1, "", None, None)
"""Matches no line."""


class LineStart(NamedTuple):
    """The start of a line, up to the call's name. `unwanted` matches such lines if the call is unwanted; `plain` says whether the arguments
    need no conversion and may recur."""

    unwanted: CachedLine | None
    kind: str
    name: str
    plain: bool


class Reader:
    """Converts JSON objects to calls and marks."""

    def __init__(self, wanted: frozenset[str], name: str | None) -> None:
        self.wanted = wanted
        self.file = name
        self.vulkan = False
        self.direct3d = False
        self.trimmed = False
        self.starts: dict[bytes, LineStart] = {}
        """By the text from the end of the index to the end of the name."""

    def start(self, match: re.Match[bytes]) -> LineStart:
        """Interprets a match of LINE_START."""
        text, kind, name = match[1], match[2].decode("ascii"), match[3].decode("ascii")
        unwanted = None if self.is_wanted(kind, name) else (text, len(text), "", None, None)
        start = LineStart(unwanted, kind, name, kind != "meta" and _recurs(name))
        if len(self.starts) < 10_000:
            self.starts[text] = start
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
            raise CaptureError("this capture contains no Vulkan calls" + (", only Direct3D calls" if self.direct3d else ""), Place(1, 1))

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
            if kind == "vkFunc" and name == "vkCreateGraphicsPipelines":
                _drop_null_sample_masks(args)
        result = body.get("return")
        return Call(name, args, place, result if isinstance(result, str) else None)

    def _mark(self, value: dict[str, Any], place: Place) -> Mark | None:
        header, state, frame = value.get("header"), value.get("state"), value.get("frame")
        if isinstance(frame, dict) and frame.get("marker_type") == "EndMarker":
            return Mark("frame", place)
        path = header.get("source-path") if isinstance(header, dict) else None
        begins = isinstance(state, dict) and state.get("marker_type") == "BeginMarker"
        if self.trimmed or not (begins or (isinstance(path, str) and TRIMMED.search(path))):
            return None
        self.trimmed = True
        return Mark("trimmed", place)

    def _read_shaders(self, args: dict[str, Any]) -> None:
        """Replaces the file names in `pCode` by the code from files beside the capture, and removes other placeholders."""
        for info in (args.get("pCreateInfo"), *items(args.get("pCreateInfos"))):
            for structure in (info, *items(record(info).get("pStages"))):
                for holder in (holder for holder in chain(structure) if "pCode" in holder):
                    path = holder.pop("pCode")
                    code = _file_beside(self.file, path) if isinstance(path, str) and not path.startswith(("[", "0x")) else None
                    if code is not None:
                        holder["pCode"] = code


def _drop_null_sample_masks(args: dict[str, Any]) -> None:
    """Removes null sample masks: version 0.9 writes null for every mask, so its value is unknown."""
    for info in items(args.get("pCreateInfos")):
        state = record(record(info).get("pMultisampleState"))
        if state.get("pSampleMask", ...) is None:
            del state["pSampleMask"]


def _recurs(name: str) -> bool:
    """Whether a call may recur with the same arguments. A call that creates an object has a new handle each time."""
    return not name.startswith(("vkCreate", "vkAllocate", "vkGet"))


def _lines(blocks: Blocks, reader: Reader) -> Iterator[Call | Mark]:
    """The calls of JSON Lines.

    A frame usually resembles the one before it, so the next line is predicted to be the line that followed the current one last time,
    apart from its index. Comparing the two is many times faster than parsing. If predictions rarely hold, caching pauses for a while.
    """
    new = tuple.__new__
    cache: dict[bytes, tuple[int, CachedLine]] = {}
    """The lines that may recur, each with its last position in the history."""
    size = 0
    history: list[CachedLine] = [NO_LINE]
    dropped = 0
    guess = 0
    offset = 10
    """The length of a line's text up to the end of its index."""
    number = 0
    slow = since = resumes = 0
    for block in blocks:
        at = 0
        block_size = len(block)
        while at < block_size:
            number += 1
            body_start = at + offset
            text, length, name, args, result = cached = history[guess]
            if block.startswith(text, body_start):
                if name:
                    try:
                        call = new(Call, (name, args, new(Place, (number, 1, int(block[at + 9 : body_start]))), result))
                    except ValueError:
                        pass  # not an index
                    else:
                        at = body_start + length
                        guess += 1
                        history.append(cached)
                        yield call
                        continue
                elif block.startswith(PREFIX, at):
                    at = block.find(b"\n", body_start) + 1
                    guess += 1
                    history.append(cached)
                    continue
            start, line = at, number
            at = block.find(b"\n", at) + 1
            slow += 1
            guess += 1
            cached = NO_LINE
            call_or_mark: Call | Mark | None = None
            match = LINE_START.match(block, start, at)
            if match is None:
                if not block[start:at].isspace():
                    call_or_mark = reader.read(block[start:at], line, 1)
            else:
                body_start = match.start(1)
                offset = body_start - start
                unwanted, kind, name, plain = reader.starts.get(match[1]) or reader.start(match)
                text = block[body_start:at]
                earlier = cache.get(text) if plain and line >= resumes else None
                if unwanted is not None:
                    cached = unwanted
                elif earlier is not None:
                    position, cached = earlier
                    cache[text] = (len(history) + dropped, cached)
                    guess = max(0, position + 1 - dropped)
                    call_or_mark = new(Call, (name, cached[3], new(Place, (line, 1, int(block[start + 9 : body_start]))), cached[4]))
                else:
                    # Common calls are parsed here, unusual ones by the reader.
                    values = parse_call(block[start:at], kind) if plain else None
                    if values is None:
                        call_or_mark = reader.read(block[start:at], line, 1)
                    else:
                        args, result = values
                        call_or_mark = new(Call, (name, args, new(Place, (line, 1, int(block[start + 9 : body_start]))), result))
                        if line >= resumes and at - body_start <= MAX_CACHED_CALL:
                            if size > MAX_CACHE:
                                if line - since < slow * MIN_HIT_RATIO:
                                    resumes = line + PAUSE * slow
                                cache.clear()
                                history.clear()
                                size = dropped = slow = 0
                                since = line
                            cached = (text, at - body_start, name, args, result)
                            cache[text] = (len(history) + dropped, cached)
                            size += at - body_start
            history.append(cached)
            if guess >= len(history):
                guess = 0
            if call_or_mark is not None:
                yield call_or_mark
        blocks.lines = number
        if len(history) > 2 * MAX_HISTORY:
            del history[:MAX_HISTORY]
            dropped += MAX_HISTORY
            guess = max(0, guess - MAX_HISTORY)
    if blocks.rest.strip():
        try:
            call_or_mark = reader.read(blocks.rest, number + 1, 1)
        except CaptureError as error:
            if not error.message.startswith("invalid JSON"):
                raise
            raise CaptureError(f"{TRUNCATED} in this line", Place(number + 1, 1)) from None
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
                yield cached._replace(at=place._replace(call=int(start[1])))
            else:
                assert place.line is not None and place.column is not None
                call_or_mark = reader.read(text, place.line, place.column)
                if isinstance(call_or_mark, Call) and start is not None and len(body) <= MAX_CACHED_CALL and _recurs(call_or_mark.name):
                    if size > MAX_CACHE:
                        cache.clear()
                        size = 0
                    cache[body] = call_or_mark
                    size += len(body)
                if call_or_mark is not None:
                    yield call_or_mark
    cursor.expect_end()
    reader.finish()
