"""The bytes of regular files, up to a limit."""

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

# O_NONBLOCK: a pipe that replaces a file after the check must not block.
_FLAGS = os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_CLOEXEC", 0) | getattr(os, "O_BINARY", 0)


def open_regular(path: str) -> tuple[BinaryIO, int]:
    """A file, open for reading, and its size in bytes. Raises OSError if it cannot be opened or is not a regular file."""
    try:
        _check_regular(os.stat(path).st_mode)
    except ValueError as error:
        raise OSError(f"invalid file name: {error}") from None
    file = open(os.open(path, _FLAGS), "rb")  # noqa: SIM115 - the caller closes it
    status = os.fstat(file.fileno())
    try:
        _check_regular(status.st_mode)
    except OSError:
        file.close()
        raise
    return file, status.st_size


def read(path: str, limits: Limits) -> bytes:
    """The bytes of a file. Raises OSError if it cannot be read or is not a regular file, and Unreadable if it exceeds the limit."""
    file, size = open_regular(path)
    with file:
        # Python allocates as much memory as it is asked to read. Files in /proc, and files that grow, have more than their stated size.
        data = file.read(min(size, limits.bytes) + 1)
        if len(data) > size:
            data += file.read(limits.bytes + 1 - len(data))
    if len(data) > limits.bytes:
        raise Unreadable(f"the input is larger than the limit of {limits.bytes} bytes")
    return data


def _check_regular(mode: int) -> None:
    if not stat.S_ISREG(mode):
        raise OSError(f"it is {_KINDS.get(stat.S_IFMT(mode), 'a special file')}, not a regular file")
