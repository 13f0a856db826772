"""gfxreconstruct: what `gfxrecon-convert` writes of a capture, as JSON Lines or as one array, in versions 0.9 and 1.x.

A call is an object with `index` and, by version, `vkFunc` or `function`. Beside calls stand `meta` commands, of which two describe the
device, and markers of a trimmed capture's state. Lines of calls that nobody follows are not parsed.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any, BinaryIO, NamedTuple

from msaa_lint.input.captures.call import Broken, Call, Mark, Place
from msaa_lint.input.captures.call_names import wants
from msaa_lint.input.captures.json_stream import BYTE_ORDER_MARK, CUT, Blocks, Cursor, Joined, loads, shallow
from msaa_lint.input.captures.sibling_files import Folder

NAME = "gfxreconstruct"

DEVICE_COMMANDS = frozenset({"SetDevicePropertiesCommand", "SetDeviceMemoryPropertiesCommand"})
"""The `meta` commands that say what the device offers, where a trimmed capture lacks the calls."""

HEAD = re.compile(
    rb'\s*(?:\[\s*)?\{\s*"(?:header"\s*:\s*\{\s*"source-path"|index"\s*:\s*\d+\s*,\s*"(?:vkFunc|function|meta|annotation)"|'
    rb'state"\s*:\s*\{\s*"marker_)'
)
# The layer names a trimmed capture by its frames.
TRIMMED = re.compile(r"_frames?_\d+(?:_through_\d+)?\b|_trim_trigger")
START = re.compile(rb'\{\s*"index"\s*:\s*(\d{1,18})\s*,\s*"(vkFunc|function|meta|method)"\s*:\s*\{\s*"name"\s*:\s*"(\w{1,100})"')
PREFIX = b'{"index":'
LINE_START = re.compile(rb'\{"index":\d{1,18}(,"(vkFunc|function|meta|method)":\{"name":"(\w{1,100})")')

MAX_KEPT = 12 << 20
"""Bytes of calls whose values are kept for when they recur; parsed they take some five times as much."""
MAX_KEPT_CALL = 1 << 16
MAX_PAST = 1 << 19
"""So many lines back a repetition is looked for."""
MIN_LIKE = 1.25
PAUSE = 16
"""Where fewer than a fifth of the lines are like earlier ones, nothing is kept for sixteen times as many lines."""


def claims(head: bytes) -> bool:
    """Whether a file that begins so is a converted capture."""
    return HEAD.match(head.removeprefix(BYTE_ORDER_MARK)) is not None


def calls(stream: BinaryIO, wanted: frozenset[str], name: str | None) -> Iterator[Call | Mark]:
    """The calls of a capture, and its marks. Calls that are written alike may share their arguments, which are not to be changed.

    Binaries that the capture names are read from the folder of the file `name`. Broken where the text ends in the middle or is no JSON.
    """
    joined = Joined(stream)
    reader = Reader(wanted, name)
    array = joined.head.removeprefix(BYTE_ORDER_MARK).lstrip()[:1] == b"["
    return _elements(Cursor(joined), reader) if array else _lines(Blocks(joined), reader)


Known = tuple[bytes, int, str, Any, str | None]
"""A line as it was met: what follows its index, up to and with its end, and how long that is; the call's name, arguments and result. Of a
call that nobody wants only what is up to its name, which is empty then."""

NEVER: Known = (b"\0", 1, "", None, None)
"""No line is like this one."""


class Start(NamedTuple):
    """What the beginning of a line tells, up to the call's name: how to know such lines where they are not wanted; whether the arguments
    are to be taken as they are, and may come again."""

    unwanted: Known | None
    kind: str
    name: str
    plain: bool


class Reader:
    """What is known of a capture's dialect: which calls are wanted, and how their values become Calls."""

    def __init__(self, wanted: frozenset[str], name: str | None) -> None:
        self.wanted = wanted
        self.folder = Folder(name)
        self.vulkan = False
        self.direct3d = False
        self.trimmed = False
        self.starts: dict[bytes, Start] = {}
        """By what lines begin with after their index."""

    def start(self, found: re.Match[bytes]) -> Start:
        """What a match of LINE_START tells."""
        text, kind, name = found[1], found[2].decode("ascii"), found[3].decode("ascii")
        wanted = self.wants(kind, name)
        made = Start(None if wanted else (text, len(text), "", None, None), kind, name, kind != "meta" and _recurs(name))
        if len(self.starts) < 10_000:
            self.starts[text] = made
        return made

    def wants(self, kind: str, name: str) -> bool:
        """Whether anybody follows a call, or a `meta` command."""
        if kind == "method":
            self.direct3d = True
            return False
        if kind == "meta":
            return name in DEVICE_COMMANDS
        self.vulkan = True
        return wants(self.wanted, name)

    def read(self, text: bytes, line: int, column: int) -> Call | Mark | None:
        """What the text of an object says; None where nobody wants it."""
        value = loads(text, line, column)
        if not isinstance(value, dict):
            raise Broken("no call: an object is expected", Place(line, column))
        index = value.get("index")
        place = Place(line, column, index if type(index) is int else None)
        for kind in ("function", "vkFunc", "meta", "method"):
            if kind in value:
                return self._call(kind, value[kind], place)
        return self._mark(value, place)

    def finish(self) -> None:
        """At the end: Broken where nothing was a call of Vulkan."""
        if not self.vulkan:
            raise Broken("no call of Vulkan in this capture" + (", only of Direct3D" if self.direct3d else ""), Place(1, 1))

    def _call(self, kind: str, body: object, place: Place) -> Call | None:
        name = body.get("name") if isinstance(body, dict) else None
        if not isinstance(body, dict) or not isinstance(name, str):
            raise Broken(f"no call: `{kind}` has no name", place)
        if not self.wants(kind, name):
            return None
        args = body.get("args", {})
        if not isinstance(args, dict):
            raise Broken("no call: `args` is no object", place)
        if name.startswith("vkCreate"):
            self._shaders(args)
            if kind == "vkFunc" and name == "vkCreateGraphicsPipelines":
                _forget_sample_masks(args)
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

    def _shaders(self, args: dict[str, Any]) -> None:
        """Gives the shaders of a call their code, where it lies in a file beside the capture; else takes away what stands in its place."""
        infos = args.get("pCreateInfos")
        for info in (args.get("pCreateInfo"), *(infos if isinstance(infos, list) else ())):
            stages = info.get("pStages") if isinstance(info, dict) else None
            for each in (info, *(stages if isinstance(stages, list) else ())):
                for _ in range(16):
                    if not isinstance(each, dict):
                        break
                    if "pCode" in each:
                        path = each.pop("pCode")
                        code = self.folder.read(path) if isinstance(path, str) and not path.startswith(("[", "0x")) else None
                        if code is not None:
                            each["pCode"] = code
                    each = each.get("pNext")


def _forget_sample_masks(args: dict[str, Any]) -> None:
    """Takes away sample masks that are null: 0.9 writes null whatever the mask is, so that nothing is known."""
    infos = args.get("pCreateInfos")
    for info in infos if isinstance(infos, list) else ():
        state = info.get("pMultisampleState") if isinstance(info, dict) else None
        if isinstance(state, dict) and state.get("pSampleMask", ...) is None:
            del state["pSampleMask"]


def _recurs(name: str) -> bool:
    """Whether a call may come again with the same arguments: one that makes an object names another each time."""
    return not name.startswith(("vkCreate", "vkAllocate", "vkGet"))


def _lines(blocks: Blocks, reader: Reader) -> Iterator[Call | Mark]:
    """The calls of JSON Lines.

    A frame is recorded much like the one before it. So the next line mostly is, but for its index, the one that came at this point the last
    time, and to compare the two is many times faster than to parse. Where that is seldom so, nothing is kept for a while.
    """
    new = tuple.__new__
    kept: dict[bytes, tuple[int, Known]] = {}
    """The lines that may recur, with where in the past each stands."""
    size = 0
    past: list[Known] = [NEVER]
    gone = 0
    guess = 0
    offset = 10
    """From the beginning of a line to the end of its index."""
    number = 0
    slow = since = resumes = 0
    for block in blocks:
        at = 0
        length = len(block)
        while at < length:
            number += 1
            after = at + offset
            text, text_size, name, args, result = known = past[guess]
            if block.startswith(text, after):
                if name:
                    try:
                        call = new(Call, (name, args, new(Place, (number, 1, int(block[at + 9 : after]))), result))
                    except ValueError:
                        pass  # It is no index.
                    else:
                        at = after + text_size
                        guess += 1
                        past.append(known)
                        yield call
                        continue
                elif block.startswith(PREFIX, at):
                    at = block.find(b"\n", after) + 1
                    guess += 1
                    past.append(known)
                    continue
            start, line = at, number
            at = block.find(b"\n", at) + 1
            slow += 1
            guess += 1
            known = NEVER
            made: Call | Mark | None = None
            found = LINE_START.match(block, start, at)
            if found is None:
                if not block[start:at].isspace():
                    made = reader.read(block[start:at], line, 1)
            else:
                after = found.start(1)
                offset = after - start
                unwanted, kind, name, plain = reader.starts.get(found[1]) or reader.start(found)
                text = block[after:at]
                before = kept.get(text) if plain and line >= resumes else None
                if unwanted is not None:
                    known = unwanted
                elif before is not None:
                    position, known = before
                    kept[text] = (len(past) + gone, known)
                    guess = max(0, position + 1 - gone)
                    made = new(Call, (name, known[3], new(Place, (line, 1, int(block[start + 9 : after]))), known[4]))
                else:
                    # What is as expected is taken here; what is not, there.
                    values = shallow(block[start:at], kind) if plain else None
                    if values is None:
                        made = reader.read(block[start:at], line, 1)
                    else:
                        args, result = values
                        made = new(Call, (name, args, new(Place, (line, 1, int(block[start + 9 : after]))), result))
                        if line >= resumes and at - after <= MAX_KEPT_CALL:
                            if size > MAX_KEPT:
                                if line - since < slow * MIN_LIKE:
                                    resumes = line + PAUSE * slow
                                kept.clear()
                                past.clear()
                                size = gone = slow = 0
                                since = line
                            known = (text, at - after, name, args, result)
                            kept[text] = (len(past) + gone, known)
                            size += at - after
            past.append(known)
            if guess >= len(past):
                guess = 0
            if made is not None:
                yield made
        blocks.lines = number
        if len(past) > 2 * MAX_PAST:
            del past[:MAX_PAST]
            gone += MAX_PAST
            guess = max(0, guess - MAX_PAST)
    if blocks.rest.strip():
        try:
            made = reader.read(blocks.rest, number + 1, 1)
        except Broken as error:
            if not error.message.startswith("no JSON"):
                raise
            raise Broken(f"{CUT} of this line", Place(number + 1, 1)) from None
        if made is not None:
            yield made
    reader.finish()


def _elements(cursor: Cursor, reader: Reader) -> Iterator[Call | Mark]:
    """The calls of one array."""
    kept: dict[bytes, Call] = {}
    size = 0
    cursor.take(b"[")
    while True:
        cursor.next()
        place = cursor.place()
        text = cursor.value()
        start = START.match(text)
        if start is None or reader.wants(start[2].decode("ascii"), start[3].decode("ascii")):
            body = text[start.end(1) :] if start is not None else text
            known = kept.get(body)
            if known is not None and start is not None:
                yield known._replace(at=place._replace(call=int(start[1])))
            else:
                assert place.line is not None and place.column is not None
                made = reader.read(text, place.line, place.column)
                if isinstance(made, Call) and start is not None and len(body) <= MAX_KEPT_CALL and _recurs(made.name):
                    if size > MAX_KEPT:
                        kept.clear()
                        size = 0
                    kept[body] = made
                    size += len(body)
                if made is not None:
                    yield made
        if cursor.take(b",]") == b"]":
            break
    if cursor.next():
        raise Broken("no JSON: the file goes on after its end", cursor.place())
    reader.finish()
