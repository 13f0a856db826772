"""The buffers of a RenderDoc zip.xml: members of the zip beside it, named by number."""

from __future__ import annotations

import os
from typing import Any, BinaryIO

from msaa_lint.core.project import project_root
from msaa_lint.core.text.files import open_file

MAX_BLOB = 16 << 20
"""Maximum total size of the buffers of a chunk, in bytes."""

MAX_ALL = 128 << 20
"""Maximum total size of the buffers of a capture, in bytes; the tracker keeps them in memory."""

MAX_DIRECTORY = 8 << 20
"""Maximum size of the zip's directory in bytes, which is held in memory: about 150,000 buffers."""

_END_RECORD = b"PK\x05\x06"


class Blobs:
    """The zip beside a file, opened on first use. If it is missing or damaged, its buffers are
    unknown.
    """

    def __init__(self, name: str | None) -> None:
        self.path = _zip_path(name)
        self.zip: Any = None
        self.file: BinaryIO | None = None
        self.capture_budget = MAX_ALL
        self.chunk_budget = MAX_BLOB

    def start_chunk(self) -> None:
        """Resets the size limit of a chunk."""
        self.chunk_budget = MAX_BLOB

    def read(self, number: int, length_text: str) -> bytes | None:
        """The buffer with this number and stated length; None if the zip does not contain it."""
        if self.path is None or not (length_text.isdecimal() and len(length_text) < 12):
            return None
        length = int(length_text)
        if length > min(self.chunk_budget, self.capture_budget) or not 0 <= number < 1 << 32:
            return None
        self.chunk_budget -= length
        self.capture_budget -= length
        if self.zip is None and not self.open():
            return None
        return self.read_member(number, length)

    def open(self) -> bool:
        """Opens the zip, at most once."""
        path, self.path = self.path, None
        if path is None:
            return False
        try:
            self.file, _ = open_file(path, project_root(os.path.dirname(path) or os.curdir))
            if _directory_size(self.file) <= MAX_DIRECTORY:
                from zipfile import ZipFile

                self.zip = ZipFile(self.file)
                self.path = path
        except Exception:  # zipfile raises many types of exceptions for damaged files
            self.zip = None
        return self.zip is not None

    def read_member(self, number: int, length: int) -> bytes | None:
        from zipfile import ZIP_DEFLATED, ZIP_STORED

        try:
            info = self.zip.getinfo(f"{number:06}")
            if info.file_size != length or info.compress_type not in (ZIP_STORED, ZIP_DEFLATED):
                return None
            with self.zip.open(info) as member:
                content = member.read(length + 1)
        except Exception:  # as above
            return None
        return content if len(content) == length else None

    def close(self) -> None:
        """Closes the zip."""
        if self.file is not None:
            self.file.close()


def _zip_path(name: str | None) -> str | None:
    if name is None or not name.endswith(".xml"):
        return None
    stem = name.removesuffix(".xml")
    return stem if stem.endswith(".zip") else stem + ".zip"


def _directory_size(file: BinaryIO) -> int:
    """The size of a zip's directory in bytes, from its end-of-central-directory record."""
    size = file.seek(0, os.SEEK_END)
    file.seek(max(0, size - (1 << 16) - 22))
    tail = file.read((1 << 16) + 22)
    at = tail.rfind(_END_RECORD)
    return int.from_bytes(tail[at + 12 : at + 16], "little") if at >= 0 else 1 << 32
