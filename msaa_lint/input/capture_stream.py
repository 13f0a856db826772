"""Streams of captures that do not come from a plain file: standard input, decompressed data, and
the output of a converter.
"""

import io
from collections.abc import Iterable
from typing import BinaryIO

from .file_types import HEAD_BYTES


class StreamFailure(Exception):
    """The rest of a capture cannot be had: why. `is_limit` says whether that is because it would
    exceed a limit.
    """

    def __init__(self, message: str, is_limit: bool = False) -> None:
        super().__init__(message)
        self.is_limit = is_limit


class CaptureStream(io.BufferedReader):
    """The bytes of pieces, as a stream that ends where their source fails. `failure` then says
    why.
    """

    def __init__(self, pieces: Iterable[bytes]) -> None:
        self._joined = _JoinedPieces(pieces)
        super().__init__(self._joined, HEAD_BYTES)

    @property
    def failure(self) -> StreamFailure | None:
        return self._joined.failure

    def head(self) -> bytes:
        """The first HEAD_BYTES bytes, which stay in the stream. Only before anything is read."""
        return self.peek(HEAD_BYTES)


def pieces_of(stream: BinaryIO, size: int) -> Iterable[bytes]:
    """The bytes of a stream as they come, in pieces of at most `size`."""
    read = getattr(stream, "read1", stream.read)
    while piece := read(size):
        yield piece


class _JoinedPieces(io.RawIOBase):
    """Fills buffers completely: a format is detected from a head of full length, however slowly a
    pipe delivers it.
    """

    def __init__(self, pieces: Iterable[bytes]) -> None:
        self._pieces = iter(pieces)
        self._piece = memoryview(b"")
        self.failure: StreamFailure | None = None

    def readable(self) -> bool:
        return True

    def readinto(self, buffer: object) -> int:
        view = memoryview(buffer).cast("B")  # type: ignore[arg-type]
        filled = 0
        while filled < len(view):
            if not self._piece:
                try:
                    self._piece = memoryview(next(self._pieces))
                except StopIteration:
                    break
                except StreamFailure as failure:
                    self.failure = failure
                    break
                continue
            part = self._piece[: len(view) - filled]
            view[filled : filled + len(part)] = part
            filled += len(part)
            self._piece = self._piece[len(part) :]
        return filled
