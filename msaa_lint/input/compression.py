"""Decompresses captures while they are read: gzip, xz, zstd, and bzip2."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any, BinaryIO

from .capture_stream import CaptureStream, StreamFailure
from .file_types import COMPRESSED, Compression

BLOCK = 1 << 13
"""Bytes read at a time. What follows a member is copied once per member, so many tiny members cost
this much each.
"""

STEP = 1 << 14
"""Bytes decompressed at a time: what is lost before invalid data."""

MAX_BYTES = 2 << 30
MAX_RATIO = 256
"""A capture may decompress to MAX_BYTES, and MAX_RATIO times its size more: 1 MB of zeros could
decompress for hours.
"""

MAX_MEMORY = 256 << 20
"""Memory in bytes that the dictionary of xz data may take. `xz -9` takes 64 MiB; zstd has a limit
of 128 MiB itself.
"""


def _gzip() -> Any:
    return _GzipDecompressor()


def _xz() -> Any:
    from lzma import FORMAT_XZ, LZMADecompressor

    return LZMADecompressor(FORMAT_XZ, MAX_MEMORY)


def _bzip2() -> Any:
    from bz2 import BZ2Decompressor

    return BZ2Decompressor()


def _zstd() -> Any:
    from msaa_lint.core.zstd import ZstdDecompressor

    return ZstdDecompressor()


_CREATE: dict[str, Callable[[], Any]] = {"gzip": _gzip, "xz": _xz, "bzip2": _bzip2, "zstd": _zstd}
"""Functions that create a decompressor of one member, or frame, by the name of the format."""


def decompressed(stream: BinaryIO, compression: Compression) -> CaptureStream:
    """What a compressed stream holds, all members of it."""
    return CaptureStream(_pieces(stream, compression))


def without_ending(path: str) -> str:
    """A path without the ending of a compressed file."""
    return next((path.removesuffix(ending) for ending in COMPRESSED if path.endswith(ending)), path)


def _pieces(stream: BinaryIO, compression: Compression) -> Iterator[bytes]:
    room = MAX_BYTES
    data = b""
    while True:
        # xz and gzip files may have zeros between members and at the end.
        while not data:
            block = stream.read(BLOCK)
            if not block:
                return
            room += MAX_RATIO * len(block)
            data = block.lstrip(b"\0")
        decompressor = _CREATE[compression.name]()
        while not decompressor.eof:
            if decompressor.needs_input and not data:
                data = stream.read(BLOCK)
                room += MAX_RATIO * len(data)
                if not data:
                    raise StreamFailure(f"the {compression.name} data is truncated")
            try:
                piece = decompressor.decompress(data, STEP)
            except MemoryError:
                raise
            except Exception as error:  # zlib, lzma, bz2 and zstd each have their own
                raise StreamFailure(
                    f"the {compression.name} data is invalid: {_first_line(error)}"
                ) from None
            data = b""
            room -= len(piece)
            if room < 0:
                size = f"{MAX_BYTES >> 30} GiB and {MAX_RATIO} times its size"
                raise StreamFailure(
                    "the rest of the capture was not read because it decompresses to more than "
                    f"{size}",
                    True,
                )
            if piece:
                yield piece
        data = decompressor.unused_data.lstrip(b"\0")


def _first_line(error: Exception) -> str:
    lines = str(error).splitlines() or [type(error).__name__]
    return lines[0]


class _GzipDecompressor:
    """zlib's decompressor of a gzip member, with the interface of the others."""

    def __init__(self) -> None:
        from zlib import decompressobj

        self._member = decompressobj(31)
        self.needs_input = True

    @property
    def eof(self) -> bool:
        return self._member.eof

    @property
    def unused_data(self) -> bytes:
        return self._member.unused_data

    def decompress(self, data: bytes, max_length: int) -> bytes:
        piece = self._member.decompress(self._member.unconsumed_tail + data, max_length)
        self.needs_input = not self._member.unconsumed_tail and len(piece) < max_length
        return piece
