"""The buffers of a RenderDoc zip.xml: members of the zip beside it, named by their number."""

from __future__ import annotations

import os
import stat
from typing import Any

MAX_BLOB = 16 << 20
"""Bytes of one buffer, and of all those of one chunk."""

MAX_ALL = 128 << 20
"""Bytes of all buffers of a capture that are read: who follows it keeps them."""

MAX_DIRECTORY = 8 << 20
"""Bytes of the zip's directory, which is held in memory: some 150,000 buffers."""

_END = b"PK\x05\x06"


class Blobs:
    """The zip beside a file, opened when the first buffer is asked for. Whatever is wrong with it, its buffers are unknown, no more."""

    def __init__(self, name: str | None) -> None:
        self.path = _beside(name)
        self.zip: Any = None
        self.left = MAX_ALL
        self.of_chunk = MAX_BLOB

    def chunk(self) -> None:
        """A chunk begins."""
        self.of_chunk = MAX_BLOB

    def read(self, number: object, stated: str) -> bytes | None:
        """A buffer of the length that is stated; None where the zip does not hold it."""
        if self.path is None or type(number) is not int or not (stated.isdecimal() and len(stated) < 12):
            return None
        length = int(stated)
        if length > min(self.of_chunk, self.left) or not 0 <= number < 1 << 32:
            return None
        self.of_chunk -= length
        self.left -= length
        if self.zip is None and not self.open():
            return None
        return self.member(number, length)

    def open(self) -> bool:
        """Opens the zip; once only."""
        path, self.path = self.path, None
        try:
            # What is no regular file could keep a reader waiting.
            if path is not None and stat.S_ISREG(os.stat(path).st_mode) and _directory(path) <= MAX_DIRECTORY:
                from zipfile import ZipFile

                self.zip = ZipFile(path)
                self.path = path
        except Exception:  # zipfile raises what it likes on a file that is no zip
            self.zip = None
        return self.zip is not None

    def member(self, number: int, length: int) -> bytes | None:
        from zipfile import ZIP_DEFLATED, ZIP_STORED

        try:
            info = self.zip.getinfo(f"{number:06}")
            if info.file_size != length or info.compress_type not in (ZIP_STORED, ZIP_DEFLATED):
                return None
            with self.zip.open(info) as member:
                read = member.read(length + 1)
        except Exception:  # as above, on a member
            return None
        return read if len(read) == length else None

    def close(self) -> None:
        """Closes the zip."""
        if self.zip is not None:
            self.zip.close()


def _beside(name: str | None) -> str | None:
    if name is None or not name.endswith(".xml"):
        return None
    stem = name.removesuffix(".xml")
    return stem if stem.endswith(".zip") else stem + ".zip"


def _directory(path: str) -> int:
    """The length of a zip's directory in bytes, as the record at its end states it."""
    with open(path, "rb") as file:
        size = file.seek(0, os.SEEK_END)
        file.seek(max(0, size - (1 << 16) - 22))
        tail = file.read((1 << 16) + 22)
    at = tail.rfind(_END)
    return int.from_bytes(tail[at + 12 : at + 16], "little") if at >= 0 else 1 << 32
