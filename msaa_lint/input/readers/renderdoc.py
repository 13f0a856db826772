"""RenderDoc captures, as `renderdoccmd convert -c xml` and `-c zip.xml` write them: one frame, and the calls that made what it uses.

A chunk is a call; `renderdoc_calls` knows C's names for RenderDoc's, `renderdoc_blobs` the shaders in the zip beside a zip.xml.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any, BinaryIO

from msaa_lint.input.captures.call import Broken, Call, Mark, Place
from msaa_lint.input.captures.call_names import wants

from .renderdoc_blobs import Blobs
from .renderdoc_calls import INITIAL, NEEDED, Calls
from .renderdoc_sets import unknown
from .renderdoc_text import Text

NAME = "renderdoc"

BLOCK = 1 << 16
MAX_CHUNK = 32 << 20
"""Bytes of one chunk that is read; in memory they are some six times as many."""

MAX_TOKEN = 1 << 20
"""Bytes of one tag or comment: expat looks at an unfinished one again with every block that comes."""

MAX_ELEMENTS = 1_000_000
"""Structures and arrays of one chunk that is read."""

MAX_NAMES = 20_000
"""Names of elements and attributes of a whole file, which expat keeps; RenderDoc writes some 30."""

MAX_DEPTH = 100


def claims(head: bytes) -> bool:
    """Whether a file that begins so is RenderDoc's XML."""
    start = head[:4096].removeprefix(b"\xef\xbb\xbf").lstrip()
    return start.startswith(b"<rdc") or (start.startswith(b"<?xml") and b"<rdc>" in start)


def calls(stream: BinaryIO, wanted: frozenset[str], name: str | None) -> Iterator[Call | Mark]:
    """The wanted calls in the order of the file; `Broken` where the XML ends in the middle or makes no sense.

    `name` is the file's, for the zip beside it; None where there is none to look for.
    """
    blobs = Blobs(name)
    chunks = _Chunks(wanted, blobs)
    text = Text()
    broken: Broken | None = None
    last = False
    try:
        while not last and broken is None:
            block = stream.read(BLOCK)
            last = not block
            try:
                chunks.feed(text.mended(block, last), last)
            except Broken as error:
                broken = error
            yield from chunks.taken()
    finally:
        blobs.close()
        chunks.drop()
    if broken is not None:
        raise broken


class _Chunks:
    """The parser, and the calls that it has found since they were last taken."""

    def __init__(self, wanted: frozenset[str], blobs: Blobs) -> None:
        # Not xml.parsers.expat, which is the same under a name that costs importing a package.
        from pyexpat import ExpatError, ParserCreate

        self.error = ExpatError
        self.names: dict[str, str] = {}
        # The encoding is stated, or a document could ask for any of Python's codecs.
        self.parser = ParserCreate("utf-8", None, self.names)
        self.parser.buffer_text = True
        self.parser.ordered_attributes = True
        self.parser.StartDoctypeDeclHandler = self.doctype
        self.wanted = wanted
        self.blobs = blobs
        self.calls = Calls()
        self.found: list[Call | Mark] = []
        self.path: list[str] = []
        self.driver = ""
        self.fed = 0
        self.number = -1
        self.began: int | None = None
        """Where the chunk that is read begins, in bytes; None where none is read."""
        self.within = False
        self.name = ""
        self.place = Place(1, 1)
        self.arguments: dict[str, Any] = {}
        self.depth: Callable[[], int] = int
        """How many elements of the chunk that is read are open."""
        self.watch()

    def feed(self, block: bytes, last: bool) -> None:
        """Parses a block of the file."""
        try:
            self.parser.Parse(block, last)
        except self.error as error:
            what = "the XML ends in the middle" if last else f"no well-formed XML: {_reason(error.code)}"
            raise Broken(what, Place(error.lineno, error.offset + 1, self.number if self.within else None)) from None
        self.fed += len(block)
        done = self.parser.CurrentByteIndex
        if self.fed - done > MAX_TOKEN:
            raise self.broken(f"a tag or a comment of more than {MAX_TOKEN >> 20} MiB")
        if len(self.names) > MAX_NAMES:
            raise self.broken(f"more than {MAX_NAMES} names of elements and attributes")
        if self.began is not None and done - self.began > MAX_CHUNK:
            self.too_large(f"more than {MAX_CHUNK >> 20} MiB")

    def taken(self) -> list[Call | Mark]:
        """The calls found since."""
        found, self.found = self.found, []
        return found

    def drop(self) -> None:
        """Lets go of the parser, whose handlers know this object."""
        parser = self.parser
        parser.StartElementHandler = parser.EndElementHandler = parser.CharacterDataHandler = parser.StartDoctypeDeclHandler = None

    def broken(self, message: str) -> Broken:
        """A mistake where the parser is."""
        at = Place(self.parser.CurrentLineNumber, self.parser.CurrentColumnNumber + 1, self.number if self.within else None)
        return Broken(message, at)

    def doctype(self, name: str, system: str | None, public: str | None, subset: int) -> None:
        raise self.broken("a document type declaration, which RenderDoc does not write; entities are not read")

    def watch(self) -> None:
        """Looks for the next chunk."""
        self.within = False
        self.began = None
        parser = self.parser
        parser.StartElementHandler = self.around
        parser.EndElementHandler = self.closed
        parser.CharacterDataHandler = None

    def around(self, tag: str, attributes: list[str]) -> None:
        """An element that is not in a chunk."""
        path = self.path
        if not path:
            if tag != "rdc":
                raise self.broken(f"`{tag[:64]}` where RenderDoc's XML begins with `rdc`")
        elif tag == "chunk" and len(path) == 2 and path[1] == "chunks":
            self.chunk(attributes)
            return
        elif tag == "driver":
            self.driver = ""
            self.parser.CharacterDataHandler = self.driver_named
        if len(path) >= MAX_DEPTH:
            raise self.broken(f"elements nested more than {MAX_DEPTH} deep")
        path.append(tag)

    def closed(self, tag: str) -> None:
        self.path.pop()
        if tag == "driver":
            self.parser.CharacterDataHandler = None
            driver = self.driver.strip()
            if driver != "Vulkan":
                raise self.broken(f"a capture of {driver[:64] or 'no driver'}; only Vulkan's are read")

    def driver_named(self, text: str) -> None:
        self.driver = (self.driver + text)[:100]

    def chunk(self, attributes: list[str]) -> None:
        """A chunk begins: one that is needed is read, the others are passed over."""
        parser, wanted = self.parser, self.wanted
        self.number += 1
        self.within = True
        self.place = Place(parser.CurrentLineNumber, parser.CurrentColumnNumber + 1, self.number)
        self.name = name = _attribute(attributes, "name") or ""
        if not self.number:
            self.found.append(Mark("frameless", self.place))
        if wants(wanted, name) or (name in NEEDED and not wanted.isdisjoint(NEEDED[name])):
            self.began = parser.CurrentByteIndex
            self.blobs.chunk()
            self.read()
        else:
            self.skip(0)

    def skip(self, depth: int) -> None:
        """Handlers that do nothing but find the end of a chunk, of which so many elements are open."""
        self.began = None

        def start(tag: str, attributes: list[str]) -> None:
            nonlocal depth
            depth += 1
            if depth > MAX_DEPTH:
                raise self.broken(f"elements nested more than {MAX_DEPTH} deep")

        def end(tag: str) -> None:
            nonlocal depth
            depth -= 1
            if depth < 0:
                self.watch()

        self.parser.StartElementHandler = start
        self.parser.EndElementHandler = end
        self.parser.CharacterDataHandler = None

    def read(self) -> None:
        """Handlers that read the elements of a chunk."""
        into: Any = {}
        self.arguments = into
        # The containers around `into` with the attributes of what is in each; those of which nothing is known are dropped.
        outer: list[tuple[Any, list[str]]] = []
        text: list[str] = []
        value_of: Callable[[str], Any] | None = None
        named: list[str] = []
        left = MAX_ELEMENTS
        self.depth = lambda: len(outer) + (value_of is not None)

        def start(tag: str, attributes: list[str]) -> None:
            nonlocal into, value_of, named, left
            if value_of is not None:
                raise self.broken(f"an element within a value: `{tag[:64]}`")
            value_of = VALUES.get(tag)
            if value_of is not None:
                named = attributes
                text.clear()
                return
            outer.append((into, attributes))
            into = [] if tag == "array" else {}
            left -= 1
            if len(outer) > MAX_DEPTH:
                raise self.broken(f"elements nested more than {MAX_DEPTH} deep")
            if left < 0:
                self.too_large(f"more than {MAX_ELEMENTS:,} structures and arrays")

        def end(tag: str) -> None:
            nonlocal into, value_of
            if value_of is not None:
                attributes = named
                try:
                    value = value_of("".join(text))
                except (ValueError, OverflowError):
                    raise self.broken(f"`{''.join(text)[:64]}` is no value of `{tag}`") from None
                value_of = None
            elif outer:
                value = into
                into, attributes = outer.pop()
                if tag not in ("struct", "array"):
                    return
            else:
                self.ended()
                return
            if type(into) is list:
                into.append(value)
                return
            name = attributes[1] if attributes and attributes[0] == "name" else _attribute(attributes, "name")
            if name in _ODD:
                value = self.odd(name, value, attributes)
                if value is _ODD:
                    return
            if name is not None:
                into[name] = value

        self.parser.StartElementHandler = start
        self.parser.EndElementHandler = end
        self.parser.CharacterDataHandler = text.append

    def odd(self, name: str, value: Any, attributes: list[str]) -> Any:
        """A member that RenderDoc writes otherwise than C has it; `_ODD` itself where C has none."""
        if name == "sType":
            return _attribute(attributes, "string") or value
        if name == "pSampleMask":
            # The first word stands for the array.
            return [value] if type(value) is int else value
        if name in _BUFFERS:
            if type(value) is not int:
                return value
            held = self.blobs.read(value, _attribute(attributes, "byteLength") or "")
            return _ODD if held is None else held
        return _ODD

    def ended(self) -> None:
        """A chunk is read."""
        for made in self.calls.of(self.name, self.arguments, self.place):
            if wants(self.wanted, made.name):
                self.found.append(made)
        self.watch()

    def too_large(self, what: str) -> None:
        """A chunk that is more than one call may be. What a large descriptor set holds may stay unknown."""
        if self.name != INITIAL:
            raise Broken(f"{self.name[:64]} of {what}", self.place)
        handle = self.arguments.get("id")
        if type(handle) is int and "vkUpdateDescriptorSetWithTemplate" in self.wanted:
            self.found.append(unknown(handle, self.place))
        self.skip(self.depth())


def _attribute(attributes: list[str], name: str) -> str | None:
    for at in range(0, len(attributes), 2):
        if attributes[at] == name:
            return attributes[at + 1]
    return None


def _truth(text: str) -> bool:
    if text not in ("true", "false"):
        raise ValueError(text[:24])
    return text == "true"


VALUES: dict[str, Callable[[str], Any]] = {
    "uint": int,
    "int": int,
    "enum": int,
    "ResourceId": int,
    "buffer": int,
    "float": float,
    "bool": _truth,
    "string": str,
    "char": str,
    "null": lambda text: None,
}
"""The elements that hold a value, and how it is read."""

_BUFFERS = ("pCode", "pData")
_ODD = frozenset({"sType", "pNextType", "pSampleMask", "DebugMessages", "BakedCommandBuffer", *_BUFFERS})
"""Members that `odd` looks at."""


def _reason(code: int) -> str:
    from pyexpat import ErrorString

    return ErrorString(code) or f"error {code}"
