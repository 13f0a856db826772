"""Fossilize's pipeline databases, `.foz` of version 5 and 6: render passes, shaders and pipelines, without images and commands.

A file is a row of entries, in any order: a first pass finds where they are, the others read them, what is referred to first. Every entry
says how long it is, so that one which is damaged leaves the others readable: it is told when they are all read.
"""

from __future__ import annotations

import zlib
from array import array
from collections.abc import Iterator
from typing import BinaryIO

from msaa_lint.input.captures.call import Broken, Call, Mark, Place

from .fossilize_objects import APPLICATION, GRAPHICS_PIPELINE, RENDER_PASS, SHADER_MODULE, calls_of, fragment_modules

NAME = "fossilize"

MAGIC = b"\x81FOSSILIZEDB\x00\x00\x00"
VERSIONS = (5, 6)

HEADER = len(MAGIC) + 1
NAME_LENGTH = 40
ENTRY = NAME_LENGTH + 16
RAW, DEFLATED = 1, 2

MAX_PAYLOAD = 64 << 20
"""Bytes of an entry, as it is stored and inflated."""

MAX_RATIO = 32
"""So many times its size a file may inflate to, beyond one largest entry; Fossilize's own shrink to a third."""

MAX_ENTRIES = 4_000_000
"""Entries that are read; 12 bytes of memory each."""

MAX_MODULES = 300_000
"""Shader modules that are told."""

MAX_CODE = 128 << 20
"""Bytes of code of all modules that are told; who follows a capture keeps them."""

BLOCK = 1 << 16

ORDER = (
    (APPLICATION, ("vkCreateInstance",)),
    (RENDER_PASS, ("vkCreateRenderPass", "vkCreateRenderPass2")),
    (SHADER_MODULE, ("vkCreateShaderModule",)),
    (GRAPHICS_PIPELINE, ("vkCreateGraphicsPipelines",)),
)
"""The kinds of entries that are read, in the order in which they are, with the calls that they become."""


def claims(head: bytes) -> bool:
    """Whether a file that begins so is such a database, of whatever version."""
    return head.startswith(MAGIC)


def calls(stream: BinaryIO, wanted: frozenset[str], name: str | None) -> Iterator[Call | Mark]:
    """The wanted objects as the calls that create them: application, render passes, shader modules, pipelines; handles are their hashes.

    Of shader modules those are told that a pipeline has as its fragment stage. A last entry that is cut off is marked `truncated`, no more.
    Broken, at the end, for the first of those that make no sense.
    """
    kept = None if stream.seekable() else _kept_aside(stream)
    try:
        yield from _Database(kept or stream).calls(wanted)
    finally:
        if kept is not None:
            kept.close()


class _Database:
    """Where the entries of a file are."""

    def __init__(self, stream: BinaryIO) -> None:
        self.stream = stream
        self.start = stream.tell()
        self.size = stream.seek(0, 2) - self.start
        self.offsets = {tag: array("Q") for tag, _ in ORDER}
        self.numbers = {tag: array("I") for tag, _ in ORDER}
        self.truncated: int | None = None
        self.broken: Broken | None = None
        self.inflated = 0
        self.code = 0

    def calls(self, wanted: frozenset[str]) -> Iterator[Call | Mark]:
        """The calls, then what is wrong."""
        tags = frozenset(tag for tag, names in ORDER if not wanted.isdisjoint(names))
        try:
            self.look(tags | {GRAPHICS_PIPELINE} if SHADER_MODULE in tags else tags)
        except Broken as error:
            self.broken = error
        for tag, _ in ORDER:
            if tag == SHADER_MODULE:
                yield from self.modules()
            elif tag in tags:
                yield from self.of(tag, wanted)
        if self.truncated is not None:
            yield Mark("truncated", Place(call=self.truncated))
        if self.broken is not None:
            raise self.broken

    def of(self, tag: int, wanted: frozenset[str], of_modules: set[int] | None = None) -> Iterator[Call]:
        """The calls of the entries of a kind, of modules those alone."""
        for offset, number in zip(self.offsets[tag], self.numbers[tag], strict=True):
            if of_modules is not None and (self.hash(offset) not in of_modules or self.code > MAX_CODE):
                continue
            try:
                yield from calls_of(tag, self.payload(offset, number), Place(call=number), wanted)
            except Broken as error:
                if self.broken is None or number < (self.broken.place.call or 0):
                    self.broken = Broken(f"entry {number} at byte {offset}: {error.message}", Place(call=number))

    def modules(self) -> Iterator[Call]:
        """The modules that pipelines have as their fragment stages: no rule asks about the others, and code is most of a database."""
        if not self.offsets[SHADER_MODULE]:
            return
        named: set[int] = set()
        inflated = self.inflated
        for offset, number in zip(self.offsets[GRAPHICS_PIPELINE], self.numbers[GRAPHICS_PIPELINE], strict=True):
            try:
                named.update(fragment_modules(self.payload(offset, number), Place(call=number)))
            except Broken:
                # It is told when the pipelines are.
                continue
            if len(named) > MAX_MODULES:
                break
        self.inflated = inflated
        for call in self.of(SHADER_MODULE, frozenset(), named):
            self.code += len(call.args["pCreateInfo"].get("pCode", b""))
            yield call

    def hash(self, offset: int) -> int:
        """What an entry is named by."""
        self.stream.seek(self.start + offset + NAME_LENGTH - 16)
        return int(self.stream.read(16), 16)

    def look(self, tags: frozenset[int]) -> None:
        """Finds the entries."""
        stream, start, size = self.stream, self.start, self.size
        stream.seek(start)
        head = stream.read(HEADER)
        if not head.startswith(MAGIC):
            raise Broken("no Fossilize database: it does not begin as one", Place())
        if len(head) < HEADER:
            raise Broken("a Fossilize database that ends within its first 16 bytes", Place())
        if head[-1] not in VERSIONS:
            raise Broken(f"a Fossilize database of version {head[-1]}; 5 and 6 are read", Place())
        at = HEADER
        number = found = 0
        while at < size:
            stream.seek(start + at)
            header = stream.read(ENTRY)
            tag = _tag(header[:NAME_LENGTH])
            if tag is None:
                raise Broken(f"entry {number} at byte {at}: its name is not of hexadecimal digits", Place(call=number))
            stored = int.from_bytes(header[40:44], "little")
            if len(header) == ENTRY and max(stored, int.from_bytes(header[52:56], "little")) > MAX_PAYLOAD:
                raise Broken(f"entry {number} at byte {at}: it says that it has more than {MAX_PAYLOAD >> 20} MiB", Place(call=number))
            if len(header) < ENTRY or at + ENTRY + stored > size:
                # A program that is killed leaves its last entry so, and Fossilize's own tools pass over it.
                self.truncated = number
                return
            if tag in tags:
                found += 1
                if found > MAX_ENTRIES:
                    raise Broken(f"more than {MAX_ENTRIES:,} entries", Place(call=number))
                self.offsets[tag].append(at)
                self.numbers[tag].append(number)
            at += ENTRY + stored
            number += 1

    def payload(self, offset: int, number: int) -> bytes:
        """What an entry holds, inflated and checked."""
        self.stream.seek(self.start + offset + NAME_LENGTH)
        header = self.stream.read(ENTRY - NAME_LENGTH)
        stored, flags, checksum, length = (int.from_bytes(header[at : at + 4], "little") for at in (0, 4, 8, 12))
        data = self.stream.read(stored)
        if len(data) < stored:
            raise Broken("the file became shorter while it was read", Place(call=number))
        if checksum and zlib.crc32(data) != checksum:
            raise Broken("its checksum is wrong", Place(call=number))
        if flags not in (RAW, DEFLATED):
            raise Broken(f"it is stored in a way, {flags}, that is not known", Place(call=number))
        if flags == DEFLATED:
            self.inflated += length
            if self.inflated > MAX_PAYLOAD + MAX_RATIO * self.size:
                raise Broken(f"the file inflates to more than {MAX_RATIO} times its size", Place(call=number))
            inflator = zlib.decompressobj()
            try:
                data = inflator.decompress(data, length + 1)
            except zlib.error:
                raise Broken("it does not inflate", Place(call=number)) from None
            if not inflator.eof or inflator.unused_data:
                raise Broken("it does not inflate to the size that it says", Place(call=number))
        if len(data) != length:
            raise Broken("it has not the size that it says", Place(call=number))
        return data


def _tag(name: bytes) -> int | None:
    """The kind of an entry by its name: eight zeros, kind and hash in hexadecimal digits. None of what is no name, -1 of a part of one."""
    if not name.isalnum():
        return None
    try:
        int(name, 16)
        return int(name[8:24], 16) if len(name) == NAME_LENGTH else -1
    except ValueError:
        return None


def _kept_aside(stream: BinaryIO) -> BinaryIO:
    """A copy, on disk, of what cannot be read twice."""
    from tempfile import TemporaryFile

    kept = TemporaryFile()  # noqa: SIM115, closed by who reads it
    try:
        while block := stream.read(BLOCK):
            kept.write(block)
        kept.seek(0)
    except OSError as error:
        kept.close()
        raise Broken(f"what comes from a pipe is kept on disk meanwhile, which fails: {error.strerror}", Place()) from None
    return kept
