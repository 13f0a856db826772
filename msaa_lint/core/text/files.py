"""Bytes of a file, no more than a limit, and of nothing that is no file."""

from __future__ import annotations

import os
import stat
from typing import BinaryIO

from .node import Limits
from .source import Unreadable

_KINDS = {
    stat.S_IFDIR: "a folder",
    stat.S_IFIFO: "a pipe",
    stat.S_IFSOCK: "a socket",
    stat.S_IFCHR: "a device",
    stat.S_IFBLK: "a device",
}

# Nothing may wait for a pipe's other end, should one take a file's place after it was looked at.
_FLAGS = os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_CLOEXEC", 0) | getattr(os, "O_BINARY", 0)


def opened(path: str) -> tuple[BinaryIO, int]:
    """A file for reading, and its size in bytes. OSError where it cannot be opened or is no file."""
    try:
        _regular(os.stat(path).st_mode)
    except ValueError as error:
        raise OSError(f"no file can have that name: {error}") from None
    file = open(os.open(path, _FLAGS), "rb")  # noqa: SIM115 - the caller closes it
    status = os.fstat(file.fileno())
    try:
        _regular(status.st_mode)
    except OSError:
        file.close()
        raise
    return file, status.st_size


def read(path: str, limits: Limits) -> bytes:
    """The bytes of a file. OSError where it cannot be read or is no file; Unreadable where it is larger than the limit."""
    file, size = opened(path)
    with file:
        # Its size first: Python sets aside as much memory as it is asked to read. A file of the kernel's, or one that grows, has more.
        data = file.read(min(size, limits.bytes) + 1)
        if len(data) > size:
            data += file.read(limits.bytes + 1 - len(data))
    if len(data) > limits.bytes:
        raise Unreadable(f"the input is larger than the limit of {limits.bytes} bytes")
    return data


def _regular(mode: int) -> None:
    if not stat.S_ISREG(mode):
        raise OSError(f"it is {_KINDS.get(stat.S_IFMT(mode), 'something else')}, no file")
