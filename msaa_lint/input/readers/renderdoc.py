"""RenderDoc captures as written by `renderdoccmd convert -c xml` or `-c zip.xml`: one frame, and
the calls that created its objects.

A chunk is a call. `renderdoc_calls` converts RenderDoc's names to C's; `renderdoc_blobs` reads
shaders from the zip beside a zip.xml.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from typing import Any, BinaryIO

from msaa_lint.input.captures.call import Call, CaptureError, Mark, Place, is_wanted

from .renderdoc_blobs import Blobs
from .renderdoc_calls import INITIAL_CONTENTS, NEEDED_FOR, CallConverter
from .renderdoc_elements import (
    BUFFERS,
    CHUNK,
    END,
    MAX_SIZE,
    NAME,
    SPECIAL,
    VALUES,
    ElementParser,
    Unusual,
)
from .renderdoc_repair import XmlRepair
from .renderdoc_sets import unknown_set

BLOCK = 1 << 16
MAX_CHUNK = 32 << 20
"""Maximum size of a chunk in bytes; parsed it takes about six times as much memory."""

MAX_TOKEN = 1 << 20
"""Maximum size of a tag or comment in bytes: expat rescans an unfinished one with every block."""

MAX_ELEMENTS = 1_000_000
"""Maximum number of structures and arrays in a chunk."""

MAX_NAMES = 20_000
"""Maximum number of element and attribute names in a file, which expat keeps; RenderDoc writes
about 30.
"""

MAX_CACHE = 8 << 20
"""Maximum total size of cached chunks, in bytes of text; the parsed calls take about three times as
much memory.
"""

MAX_DEPTH = 100

CHUNKS = ["rdc", "chunks"]
"""The elements around chunks."""

_HEAD = re.compile(rb"\s*+(?:<\?xml[^>]{0,200}\?>\s*+)?<rdc>\s*+(?:<header\b|\Z)")


def claims(head: bytes) -> bool:
    """Whether a file that starts with `head` is RenderDoc's XML."""
    return _HEAD.match(head.removeprefix(b"\xef\xbb\xbf")) is not None


def calls(stream: BinaryIO, wanted: frozenset[str], name: str | None) -> Iterator[Call | Mark]:
    """The wanted calls in file order. Raises CaptureError if the XML is truncated or invalid.

    `name` is the file's name, used to find the zip beside it; None for a stream.
    """
    blobs = Blobs(name)
    parser = _ChunkParser(wanted, blobs)
    repair = XmlRepair()
    failure: CaptureError | None = None
    last = False
    rest = b""
    try:
        while not last and failure is None:
            block = stream.read(max(BLOCK, len(rest)))
            last = not block
            try:
                rest = parser.take(rest + repair.repair(block, last), last)
            except CaptureError as error:
                failure = error
            yield from parser.take_calls()
    finally:
        blobs.close()
        parser.release()
    if failure is not None:
        raise failure


class _ChunkParser:
    """The XML parser, and the calls it has produced since they were last taken."""

    def __init__(self, wanted: frozenset[str], blobs: Blobs) -> None:
        # The same module as xml.parsers.expat, without importing that package.
        from pyexpat import ErrorString, ExpatError, ParserCreate

        self.error = ExpatError
        self.error_text = ErrorString
        self.names: dict[str, str] = {}
        # With a stated encoding, a document cannot select one of Python's codecs.
        self.parser = ParserCreate("utf-8", None, self.names)
        self.parser.buffer_text = True
        self.parser.ordered_attributes = True
        self.parser.StartDoctypeDeclHandler = self.reject_doctype
        self.wanted = wanted
        self.blobs = blobs
        self.converter = CallConverter()
        self.elements = ElementParser(self.special_value)
        self.is_usual = True
        """Whether the file may still have chunks in RenderDoc's layout: so far it has no comments,
        CDATA, or very long lines.
        """
        self.skipped_lines = 0
        self.fed_lines = 0
        """The numbers of lines that the XML parser did not get, and that it got."""
        self.needed: dict[str, bool] = {}
        self.cache: dict[bytes, Call] = {}
        """The calls of commands by the text of their chunks, which recurs."""
        self.cache_size = 0
        self.output: list[Call | Mark] = []
        self.path: list[str] = []
        self.driver = ""
        self.fed = 0
        self.number = -1
        self.chunk_start: int | None = None
        """The byte offset of the current chunk; None if no chunk is being read."""
        self.in_chunk = False
        self.name = ""
        self.place = Place(1, 1)
        self.arguments: dict[str, Any] = {}
        self.depth: Callable[[], int] = int
        """Returns how many elements are open in the current chunk."""
        self.expect_chunk()

    def take(self, text: bytes, last: bool) -> bytes:
        """Takes the next text of the file, and returns the end of it that is needed again with what
        follows.

        Chunks in RenderDoc's own layout are skipped, or parsed by `elements`: the XML parser gets
        the others, line by line.
        """
        at = 0
        while self.is_usual:
            if self.in_chunk or self.path != CHUNKS:
                found = text.find(b"</chunk>" if self.in_chunk else b"<chunks", at)
                end = (text.find(b"\n", found) if found >= 0 else text.rfind(b"\n", at)) + 1
            else:
                end = self.take_chunk(text, at)
                if end:
                    at = end
                    continue
                is_incomplete = CHUNK.match(text, at) is not None and text.find(b"</chunk>", at) < 0
                if is_incomplete and not last and len(text) - at <= MAX_SIZE:
                    break
                end = text.find(b"\n", at) + 1
            if not end:
                break
            line_text = text[at:end]
            self.is_usual = b"<!" not in line_text and (b"<?" not in line_text or not self.fed)
            self.feed(line_text, False)
            self.fed_lines += line_text.count(b"\n")
            at = end
        if self.is_usual and not last and len(text) - at <= MAX_SIZE:
            return text[at:]
        self.is_usual = False
        self.feed(text[at:], False)
        if last:
            self.feed(b"", True)
        return b""

    def take_chunk(self, text: bytes, at: int) -> int:
        """Takes a chunk in RenderDoc's layout, and returns where it ends; 0 if there is none, or
        only a part of it.
        """
        start = CHUNK.match(text, at)
        stop = text.find(b"</chunk>", start.end()) if start is not None else -1
        end = END.match(text, stop) if stop >= 0 else None
        name_match = NAME.search(start[1]) if start is not None else None
        if start is None or end is None or name_match is None or self.number < 0:
            return 0
        if stop - at > MAX_SIZE or text.find(b"<!", at, stop) >= 0:
            return 0
        name = name_match[1].decode("utf-8", "replace")
        if self.is_needed(name):
            place = Place(
                self.fed_lines + self.skipped_lines + 1,
                start.start(1) - at - len("<chunk") + 1,
                self.number + 1,
            )
            body = text[start.end() : stop]
            cached = self.cache.get(body)
            if cached is not None and cached.name == name:
                self.output.append(cached._replace(at=place))
            else:
                self.blobs.start_chunk()
                try:
                    arguments = self.elements.parse(body)
                except Unusual:
                    return 0
                self.add_calls(name, arguments, place)
                call = self.output[-1] if self.output else None
                if name.startswith("vkCmd") and isinstance(call, Call) and call.at is place:
                    self.cache_size += len(body)
                    if self.cache_size > MAX_CACHE:
                        self.cache.clear()
                        self.cache_size = len(body)
                    self.cache[body] = call
        self.number += 1
        self.skipped_lines += text.count(b"\n", at, end.end())
        return end.end()

    def is_needed(self, name: str) -> bool:
        """Whether chunks with this name are read."""
        needed = self.needed.get(name)
        if needed is None:
            needed = is_wanted(self.wanted, name) or (
                name in NEEDED_FOR and not self.wanted.isdisjoint(NEEDED_FOR[name])
            )
            if len(self.needed) < MAX_NAMES:
                self.needed[name] = needed
        return needed

    def feed(self, block: bytes, last: bool) -> None:
        """Parses a block of the file."""
        try:
            self.parser.Parse(block, last)
        except self.error as error:
            what = (
                "the XML is truncated"
                if last
                else f"invalid XML: {self.error_text(error.code) or error.code}"
            )
            raise CaptureError(
                what,
                Place(
                    error.lineno + self.skipped_lines,
                    error.offset + 1,
                    self.number if self.in_chunk else None,
                ),
            ) from None
        self.fed += len(block)
        done = self.parser.CurrentByteIndex
        if self.fed - done > MAX_TOKEN:
            raise self.error_here(f"a tag or comment exceeds {MAX_TOKEN >> 20} MiB")
        if len(self.names) > MAX_NAMES:
            raise self.error_here(f"more than {MAX_NAMES} names of elements and attributes")
        if self.chunk_start is not None and done - self.chunk_start > MAX_CHUNK:
            self.reject_large_chunk(f"{MAX_CHUNK >> 20} MiB")

    def take_calls(self) -> list[Call | Mark]:
        """Returns the calls since the last time."""
        output, self.output = self.output, []
        return output

    def release(self) -> None:
        """Removes the handlers, which refer back to this object."""
        parser = self.parser
        parser.StartElementHandler = parser.EndElementHandler = parser.CharacterDataHandler = (
            parser.StartDoctypeDeclHandler
        ) = None

    def error_here(self, message: str) -> CaptureError:
        """An error at the parser's position."""
        line, column = self.position()
        return CaptureError(message, Place(line, column, self.number if self.in_chunk else None))

    def position(self) -> tuple[int, int]:
        """The line and column that the XML parser is at."""
        return (
            self.parser.CurrentLineNumber + self.skipped_lines,
            self.parser.CurrentColumnNumber + 1,
        )

    def reject_doctype(
        self, name: str, system: str | None, public: str | None, subset: int
    ) -> None:
        raise self.error_here(
            "unexpected document type declaration; RenderDoc does not write one, and entities are "
            "not supported"
        )

    def expect_chunk(self) -> None:
        """Installs the handlers that find the next chunk."""
        self.in_chunk = False
        self.chunk_start = None
        parser = self.parser
        parser.StartElementHandler = self.start_outside
        parser.EndElementHandler = self.end_outside
        parser.CharacterDataHandler = None

    def start_outside(self, tag: str, attributes: list[str]) -> None:
        """Starts an element outside of chunks."""
        path = self.path
        if not path:
            if tag != "rdc":
                raise self.error_here(f"the root element must be `rdc`, found `{tag[:64]}`")
        elif tag == "chunk" and len(path) == 2 and path[1] == "chunks":
            self.start_chunk(attributes)
            return
        elif tag == "driver":
            self.driver = ""
            self.parser.CharacterDataHandler = self.add_driver_text
        if len(path) >= MAX_DEPTH:
            raise self.error_here(f"elements are nested deeper than {MAX_DEPTH} levels")
        path.append(tag)

    def end_outside(self, tag: str) -> None:
        self.path.pop()
        if tag == "driver":
            self.parser.CharacterDataHandler = None
            driver = self.driver.strip()
            if driver != "Vulkan":
                raise self.error_here(
                    f"expected a Vulkan capture, found the driver `{driver[:64]}`"
                )

    def add_driver_text(self, text: str) -> None:
        self.driver = (self.driver + text)[:100]

    def start_chunk(self, attributes: list[str]) -> None:
        """Starts a chunk: reads it if it is needed, otherwise skips it."""
        self.number += 1
        self.in_chunk = True
        self.place = Place(*self.position(), self.number)
        self.name = name = _attribute(attributes, "name") or ""
        if not self.number:
            self.output.append(Mark("frameless", self.place))
        if self.is_needed(name):
            self.chunk_start = self.parser.CurrentByteIndex
            self.blobs.start_chunk()
            self.read()
        else:
            self.skip(0)

    def skip(self, depth: int) -> None:
        """Installs handlers that only find the end of a chunk with `depth` open elements."""
        self.chunk_start = None

        def start(tag: str, attributes: list[str]) -> None:
            nonlocal depth
            depth += 1
            if depth > MAX_DEPTH:
                raise self.error_here(f"elements are nested deeper than {MAX_DEPTH} levels")

        def end(tag: str) -> None:
            nonlocal depth
            depth -= 1
            if depth < 0:
                self.expect_chunk()

        self.parser.StartElementHandler = start
        self.parser.EndElementHandler = end
        self.parser.CharacterDataHandler = None

    def read(self) -> None:
        """Installs handlers that read the elements of a chunk."""
        container: Any = {}
        self.arguments = container
        # The containers around `container`, each with the attributes of the element inside it.
        # Unknown elements are dropped.
        outer: list[tuple[Any, list[str]]] = []
        text: list[str] = []
        value_of: Callable[[str], Any] | None = None
        value_attributes: list[str] = []
        remaining = MAX_ELEMENTS
        self.depth = lambda: len(outer) + (value_of is not None)

        def start(tag: str, attributes: list[str]) -> None:
            nonlocal container, value_of, value_attributes, remaining
            if value_of is not None:
                raise self.error_here(f"unexpected element `{tag[:64]}` inside a value")
            value_of = VALUES.get(tag)
            if value_of is not None:
                value_attributes = attributes
                text.clear()
                return
            outer.append((container, attributes))
            container = [] if tag == "array" else {}
            remaining -= 1
            if len(outer) > MAX_DEPTH:
                raise self.error_here(f"elements are nested deeper than {MAX_DEPTH} levels")
            if remaining < 0:
                self.reject_large_chunk(f"{MAX_ELEMENTS:,} structures and arrays")

        def end(tag: str) -> None:
            nonlocal container, value_of
            if value_of is not None:
                attributes = value_attributes
                try:
                    value = value_of("".join(text))
                except (ValueError, OverflowError, KeyError):
                    raise self.error_here(
                        f"`{''.join(text)[:64]}` is not a valid `{tag}`"
                    ) from None
                value_of = None
            elif outer:
                value = container
                container, attributes = outer.pop()
                if tag not in ("struct", "array"):
                    return
            else:
                self.finish_chunk()
                return
            if type(container) is list:
                container.append(value)
                return
            name = (
                attributes[1]
                if attributes and attributes[0] == "name"
                else _attribute(attributes, "name")
            )
            if name in SPECIAL:
                value = self.special_value(name, value, attributes)
                if value is SPECIAL:
                    return
            if name is not None:
                container[name] = value

        self.parser.StartElementHandler = start
        self.parser.EndElementHandler = end
        self.parser.CharacterDataHandler = text.append

    def special_value(self, name: str, value: Any, attributes: list[str]) -> Any:
        """The C value of a member that RenderDoc writes differently; `SPECIAL` itself if C has no
        such member.
        """
        if name == "sType":
            return _attribute(attributes, "string") or value
        if name == "pSampleMask":
            # RenderDoc writes only the first word of the array.
            return [value] if type(value) is int else value
        if name in BUFFERS:
            if type(value) is not int:
                return value
            content = self.blobs.read(value, _attribute(attributes, "byteLength") or "")
            return SPECIAL if content is None else content
        return SPECIAL

    def finish_chunk(self) -> None:
        """Converts a chunk that is complete."""
        self.add_calls(self.name, self.arguments, self.place)
        self.expect_chunk()

    def add_calls(self, name: str, arguments: dict[str, Any], place: Place) -> None:
        """Adds the calls for a chunk."""
        self.output += [
            call
            for call in self.converter.calls(name, arguments, place)
            if is_wanted(self.wanted, call.name)
        ]

    def reject_large_chunk(self, limit: str) -> None:
        """Raises CaptureError for a chunk above a limit. The contents of a large descriptor set are
        unknown instead.
        """
        if self.name != INITIAL_CONTENTS:
            raise CaptureError(f"{self.name[:64]} exceeds {limit}", self.place)
        handle = self.arguments.get("id")
        if type(handle) is int and "vkUpdateDescriptorSetWithTemplate" in self.wanted:
            self.output.append(unknown_set(handle, self.place))
        self.skip(self.depth())


def _attribute(attributes: list[str], name: str) -> str | None:
    for at in range(0, len(attributes), 2):
        if attributes[at] == name:
            return attributes[at + 1]
    return None
