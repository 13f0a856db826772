"""Fossilize pipeline databases (`.foz`, versions 5 and 6): render passes, shaders and pipelines,
without images and commands.

A file is a sequence of entries in any order. A first pass finds their offsets; later passes read
each kind, referenced objects first. Every entry states its length, so a damaged entry does not
affect the others; the error is raised after all entries are read.
"""

from __future__ import annotations

import zlib
from array import array
from collections.abc import Iterator
from typing import BinaryIO

from msaa_lint.input.captures.call import Call, CaptureError, Mark, Place

from .fossilize_objects import (
    APPLICATION,
    GRAPHICS_PIPELINE,
    RENDER_PASS,
    SHADER_MODULE,
    calls_of,
    fragment_modules,
)

MAGIC = b"\x81FOSSILIZEDB\x00\x00\x00"
VERSIONS = (5, 6)

HEADER = len(MAGIC) + 1
NAME_LENGTH = 40
ENTRY = NAME_LENGTH + 16
RAW, DEFLATED = 1, 2

MAX_PAYLOAD = 64 << 20
"""Maximum size of an entry in bytes, both stored and decompressed."""

MAX_RATIO = 32
"""A file may decompress to this many times its size, plus one entry of maximum size. Real databases
decompress to about three times.
"""

MAX_ENTRIES = 4_000_000
"""Maximum number of entries; each takes 12 bytes of memory."""

MAX_MODULES = 300_000
"""Maximum number of shader modules."""

MAX_CODE = 128 << 20
"""Maximum total size of shader code in bytes; the tracker keeps it in memory."""

BLOCK = 1 << 16

ORDER = (
    (APPLICATION, ("vkCreateInstance",)),
    (RENDER_PASS, ("vkCreateRenderPass", "vkCreateRenderPass2")),
    (SHADER_MODULE, ("vkCreateShaderModule",)),
    (GRAPHICS_PIPELINE, ("vkCreateGraphicsPipelines",)),
)
"""The kinds of entries to read, in order, with the calls that they become."""


def claims(head: bytes) -> bool:
    """Whether a file that starts with `head` is a Fossilize database of any version."""
    return head.startswith(MAGIC)


def calls(stream: BinaryIO, wanted: frozenset[str], name: str | None) -> Iterator[Call | Mark]:
    """The wanted objects as the calls that create them: application, render passes, shader modules,
    pipelines. Handles are their hashes.

    Only the shader modules of fragment stages are included. A truncated last entry is only marked,
    as `truncated`. Raises CaptureError at the end, for the first invalid entry.
    """
    copy = None if stream.seekable() else _spool(stream)
    try:
        yield from _Database(copy or stream).calls(wanted)
    finally:
        if copy is not None:
            copy.close()


class _Database:
    """The entries of a file, by their offsets."""

    def __init__(self, stream: BinaryIO) -> None:
        self.stream = stream
        self.start = stream.tell()
        self.size = stream.seek(0, 2) - self.start
        self.offsets = {tag: array("Q") for tag, _ in ORDER}
        self.numbers = {tag: array("I") for tag, _ in ORDER}
        self.truncated: int | None = None
        self.error: CaptureError | None = None
        self.inflated = 0
        self.code_size = 0

    def calls(self, wanted: frozenset[str]) -> Iterator[Call | Mark]:
        """The calls; raises the first error after them."""
        tags = frozenset(tag for tag, names in ORDER if not wanted.isdisjoint(names))
        try:
            self.find_entries(tags | {GRAPHICS_PIPELINE} if SHADER_MODULE in tags else tags)
        except CaptureError as error:
            self.error = error
        for tag, _ in ORDER:
            if tag == SHADER_MODULE:
                yield from self.modules()
            elif tag in tags:
                yield from self.calls_of_kind(tag, wanted)
        if self.truncated is not None:
            yield Mark("truncated", Place(call=self.truncated))
        if self.error is not None:
            raise self.error

    def calls_of_kind(
        self, tag: int, wanted: frozenset[str], hashes: set[int] | None = None
    ) -> Iterator[Call]:
        """The calls of the entries of one kind, or of those of its shader modules that have one of
        the hashes.
        """
        for offset, number in zip(self.offsets[tag], self.numbers[tag], strict=True):
            if hashes is not None and (
                self.hash(offset) not in hashes or self.code_size > MAX_CODE
            ):
                continue
            try:
                yield from calls_of(tag, self.payload(offset, number), Place(call=number), wanted)
            except CaptureError as error:
                if self.error is None or number < (self.error.place.call or 0):
                    self.error = CaptureError(
                        f"entry {number} at byte {offset}: {error.message}", Place(call=number)
                    )

    def modules(self) -> Iterator[Call]:
        """The modules of fragment stages: rules need no others, and code is most of a database."""
        if not self.offsets[SHADER_MODULE]:
            return
        hashes: set[int] = set()
        inflated = self.inflated
        for offset, number in zip(
            self.offsets[GRAPHICS_PIPELINE], self.numbers[GRAPHICS_PIPELINE], strict=True
        ):
            try:
                hashes.update(fragment_modules(self.payload(offset, number), Place(call=number)))
            except CaptureError:
                # Reported when the pipelines are read.
                continue
            if len(hashes) > MAX_MODULES:
                break
        self.inflated = inflated
        for call in self.calls_of_kind(SHADER_MODULE, frozenset(), hashes):
            self.code_size += len(call.args["pCreateInfo"].get("pCode", b""))
            yield call

    def hash(self, offset: int) -> int:
        """The hash in an entry's name."""
        self.stream.seek(self.start + offset + NAME_LENGTH - 16)
        return int(self.stream.read(16), 16)

    def find_entries(self, tags: frozenset[int]) -> None:
        """Finds the offsets of the entries of some kinds."""
        stream, start, size = self.stream, self.start, self.size
        stream.seek(start)
        head = stream.read(HEADER)
        if not head.startswith(MAGIC):
            raise CaptureError("not a Fossilize database: the file signature is missing", Place())
        if len(head) < HEADER:
            raise CaptureError("the Fossilize database ends within its first 16 bytes", Place())
        if head[-1] not in VERSIONS:
            raise CaptureError(
                f"Fossilize database version {head[-1]} is not supported; convert it to version 5 "
                "or 6",
                Place(),
            )
        at = HEADER
        number = count = 0
        while at < size:
            stream.seek(start + at)
            header = stream.read(ENTRY)
            tag = _tag(header[:NAME_LENGTH])
            if tag is None:
                raise CaptureError(
                    f"entry {number} at byte {at}: its name must be hexadecimal digits",
                    Place(call=number),
                )
            stored = int.from_bytes(header[40:44], "little")
            if (
                len(header) == ENTRY
                and max(stored, int.from_bytes(header[52:56], "little")) > MAX_PAYLOAD
            ):
                raise CaptureError(
                    f"entry {number} at byte {at}: its stated size exceeds {MAX_PAYLOAD >> 20} MiB",
                    Place(call=number),
                )
            if len(header) < ENTRY or at + ENTRY + stored > size:
                # This is how a killed program leaves its last entry; Fossilize's own tools skip it.
                self.truncated = number
                return
            if tag in tags:
                count += 1
                if count > MAX_ENTRIES:
                    raise CaptureError(f"more than {MAX_ENTRIES:,} entries", Place(call=number))
                self.offsets[tag].append(at)
                self.numbers[tag].append(number)
            at += ENTRY + stored
            number += 1

    def payload(self, offset: int, number: int) -> bytes:
        """The contents of an entry, decompressed and verified."""
        self.stream.seek(self.start + offset + NAME_LENGTH)
        header = self.stream.read(ENTRY - NAME_LENGTH)
        stored, flags, checksum, length = (
            int.from_bytes(header[at : at + 4], "little") for at in (0, 4, 8, 12)
        )
        data = self.stream.read(stored)
        if len(data) < stored:
            raise CaptureError("the file shrank while it was being read", Place(call=number))
        if checksum and zlib.crc32(data) != checksum:
            raise CaptureError("its checksum does not match", Place(call=number))
        if flags not in (RAW, DEFLATED):
            raise CaptureError(f"its compression type {flags} is unknown", Place(call=number))
        if flags == DEFLATED:
            self.inflated += length
            if self.inflated > MAX_PAYLOAD + MAX_RATIO * self.size:
                raise CaptureError(
                    f"the file decompresses to more than {MAX_RATIO} times its size",
                    Place(call=number),
                )
            inflator = zlib.decompressobj()
            try:
                data = inflator.decompress(data, length + 1)
            except zlib.error:
                raise CaptureError("its compressed data is invalid", Place(call=number)) from None
            if not inflator.eof or inflator.unused_data:
                raise CaptureError(
                    "its decompressed size differs from its stated size", Place(call=number)
                )
        if len(data) != length:
            raise CaptureError("its size differs from its stated size", Place(call=number))
        return data


def _tag(name: bytes) -> int | None:
    """The kind in an entry's name, 8 zeros, the kind and the hash in hexadecimal. None if it is
    invalid, -1 if it is incomplete.
    """
    if not name.isalnum():
        return None
    try:
        int(name, 16)
        return int(name[8:24], 16) if len(name) == NAME_LENGTH else -1
    except ValueError:
        return None


def _spool(stream: BinaryIO) -> BinaryIO:
    """Copies a stream that cannot seek to disk."""
    from tempfile import TemporaryFile

    copy = TemporaryFile()  # noqa: SIM115, closed by the caller
    try:
        while block := stream.read(BLOCK):
            copy.write(block)
        copy.seek(0)
    except OSError as error:
        copy.close()
        raise CaptureError(
            f"cannot copy the piped capture to a temporary file: {error.strerror}", Place()
        ) from None
    return copy
