"""A file written anew: at every moment it is wholly what it was, or wholly what it will be.

The new text goes to a file beside it, to the disk, and takes its name in one step.
"""

from __future__ import annotations

import os
import stat
from contextlib import suppress
from typing import NamedTuple

_NEW = os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_CLOEXEC", 0) | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_BINARY", 0)


class NotWritten(Exception):
    """Why a file is as it was, in words."""


class _Stamp(NamedTuple):
    device: int
    inode: int
    size: int
    changed: int


def replace(path: str, before: bytes, after: bytes) -> None:
    """Gives a file other contents, and leaves its mode and, where that is permitted, its owner.

    NotWritten where it holds anything but `before`, is read-only, or cannot be written; the file is then as it was, and nothing is left
    beside it. Of a link what it leads to is replaced. Another name of the same file (a hard link) keeps the old contents.
    """
    beside = ""
    try:
        target = os.path.realpath(path)
        status, stamp = _unchanged(target, before)
        folder = os.path.dirname(target)
        if not status.st_mode & (stat.S_IWUSR | stat.S_IWGRP | stat.S_IWOTH) or not os.access(target, os.W_OK):
            raise NotWritten("the file is read-only")
        name = os.path.join(folder, f".msaa-lint-{os.getpid()}-{os.urandom(6).hex()}.tmp")
        descriptor = os.open(name, _NEW, 0o600)
        beside = name
        try:
            _fill(descriptor, after, status)
        finally:
            os.close(descriptor)
        if _unchanged(target, before)[1] != stamp:
            raise NotWritten("the file changed since it was read")
        os.replace(beside, target)
        beside = ""
        _settle(folder)
    except OSError as error:
        raise NotWritten(error.strerror or str(error)) from None
    finally:
        if beside:
            _remove(beside)


def write_file(path: str, data: bytes) -> None:
    """Creates or replaces a file in one step, so that a reader sees the old contents or the new ones. A link is replaced, not followed.

    OSError where the file cannot be written; an old file is then unchanged, and nothing is left next to it.
    """
    temporary = os.path.join(os.path.dirname(path), f".msaa-lint-{os.getpid()}-{os.urandom(6).hex()}.tmp")
    descriptor = os.open(temporary, _NEW, 0o666)
    try:
        with os.fdopen(descriptor, "wb") as file:
            file.write(data)
        os.replace(temporary, path)
    except BaseException:
        _remove(temporary)
        raise


def _unchanged(target: str, before: bytes) -> tuple[os.stat_result, _Stamp]:
    """What the system says of a file that holds what it did."""
    with open(target, "rb") as file:
        status = os.fstat(file.fileno())
        if not stat.S_ISREG(status.st_mode):
            raise NotWritten("it is no file")
        if status.st_size != len(before) or file.read(len(before) + 1) != before:
            raise NotWritten("the file changed since it was read")
    return status, _Stamp(status.st_dev, status.st_ino, status.st_size, status.st_mtime_ns)


def _fill(descriptor: int, data: bytes, like: os.stat_result) -> None:
    left = memoryview(data)
    while left:
        left = left[os.write(descriptor, left) :]
    if hasattr(os, "fchown"):
        own = os.fstat(descriptor)
        if (own.st_uid, own.st_gid) != (like.st_uid, like.st_gid):
            # Where it is not permitted the file is whoever's runs this, as with every editor.
            with suppress(PermissionError):
                os.fchown(descriptor, like.st_uid, like.st_gid)
    if hasattr(os, "fchmod"):
        os.fchmod(descriptor, stat.S_IMODE(like.st_mode))
    os.fsync(descriptor)


def _settle(folder: str) -> None:
    """Has the folder's entry written out as well, where the system can: the file is whole either way."""
    with suppress(OSError):
        descriptor = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(descriptor)
        finally:
            os.close(descriptor)


def _remove(path: str) -> None:
    with suppress(OSError):
        os.unlink(path)
