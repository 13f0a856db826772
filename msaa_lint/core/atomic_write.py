"""Writes files atomically: a file has either its old or its new contents, even if the process is killed.

The new contents are written to a file in the same folder, which is then renamed.
"""

from __future__ import annotations

import errno
import os
import stat
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from typing import IO

_NEW = os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_CLOEXEC", 0) | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_BINARY", 0)


class NotWritten(Exception):
    """Why a file was left unchanged."""


def write_file(path: str, data: bytes) -> None:
    """Creates a file or replaces its contents; a symbolic link is replaced itself. Raises OSError, and leaves no other file behind.

    What is no file, such as `/dev/stdout`, is written to.
    """
    if _is_device(path):
        with open(path, "wb") as device:
            device.write(data)
        return
    with _renamed(path) as descriptor:
        _write_all(descriptor, data)


@contextmanager
def new_text(path: str) -> Iterator[IO[str]]:
    """Opens a file for UTF-8 text that gets its name only when all of it is written; a file that it replaces keeps its mode.

    A symbolic link to a file is replaced itself, so that nothing is written through it; what is no file, such as `/dev/stdout`, is written
    to. Raises OSError, and leaves an old file as it was.
    """
    if _is_device(path):
        with open(path, "w", encoding="utf-8", newline="\n") as device:
            yield device
        return
    old = os.lstat(path) if os.path.lexists(path) and not os.path.islink(path) else None
    if old is not None and not os.access(path, os.W_OK):
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES), path)
    with _renamed(path) as descriptor:
        with open(descriptor, "w", encoding="utf-8", newline="\n", closefd=False) as file:
            yield file
        if old is not None and hasattr(os, "fchmod"):
            os.fchmod(descriptor, stat.S_IMODE(old.st_mode))


@contextmanager
def _renamed(path: str) -> Iterator[int]:
    """The descriptor of a new file beside a path, which gets the path's name at the end, unless an exception ends it."""
    temporary = _temporary(path)
    try:
        descriptor = os.open(temporary, _NEW, 0o666)
        try:
            yield descriptor
        finally:
            os.close(descriptor)
        os.replace(temporary, path)
    except BaseException:
        _remove(temporary)
        raise


def replace(path: str, before: bytes, after: bytes) -> None:
    """Replaces the contents of a file, and syncs them to disk. Keeps the file's mode and, if permitted, its owner.

    Raises NotWritten if the file has contents other than `before`, is read-only, or cannot be written; it is then unchanged, and no other
    file is left behind. The target of a symbolic link is replaced. Another hard link to the file keeps the old contents.
    """
    temporary = ""
    try:
        target = os.path.realpath(path)
        status = _check_unchanged(target, before)
        if not status.st_mode & (stat.S_IWUSR | stat.S_IWGRP | stat.S_IWOTH) or not os.access(target, os.W_OK):
            raise NotWritten("the file is read-only")
        temporary = _temporary(target)
        descriptor = os.open(temporary, _NEW, 0o600)
        try:
            _write_all(descriptor, after)
            _copy_status(descriptor, status)
            os.fsync(descriptor)
        finally:
            os.close(descriptor)
        if _identity(_check_unchanged(target, before)) != _identity(status):
            raise NotWritten("the file changed since it was read")
        os.replace(temporary, target)
        _sync_folder(os.path.dirname(target))
    except OSError as error:
        raise NotWritten(error.strerror or str(error)) from None
    finally:
        if temporary:
            _remove(temporary)


def _is_device(path: str) -> bool:
    """Whether a path is no file, or, as `/dev/stdout` and `/dev/fd/3` are, a link to whatever a stream goes to."""
    folder = os.path.realpath(os.path.dirname(os.path.abspath(path)))
    return folder.startswith(("/dev/", "/proc/")) or folder == "/dev" or (os.path.exists(path) and not os.path.isfile(path))


def _temporary(path: str) -> str:
    return os.path.join(os.path.dirname(path), f".msaa-lint-{os.getpid()}-{os.urandom(6).hex()}.tmp")


def _check_unchanged(target: str, before: bytes) -> os.stat_result:
    with open(target, "rb") as file:
        status = os.fstat(file.fileno())
        if not stat.S_ISREG(status.st_mode):
            raise NotWritten("it is not a regular file")
        if status.st_size != len(before) or file.read(len(before) + 1) != before:
            raise NotWritten("the file changed since it was read")
    return status


def _identity(status: os.stat_result) -> tuple[int, ...]:
    return status.st_dev, status.st_ino, status.st_size, status.st_mtime_ns


def _write_all(descriptor: int, data: bytes) -> None:
    rest = memoryview(data)
    while rest:
        rest = rest[os.write(descriptor, rest) :]


def _copy_status(descriptor: int, status: os.stat_result) -> None:
    if hasattr(os, "fchown"):
        current = os.fstat(descriptor)
        if (current.st_uid, current.st_gid) != (status.st_uid, status.st_gid):
            # Without the permission the file belongs to the current user, as with every editor.
            with suppress(PermissionError):
                os.fchown(descriptor, status.st_uid, status.st_gid)
    if hasattr(os, "fchmod"):
        os.fchmod(descriptor, stat.S_IMODE(status.st_mode))


def _sync_folder(folder: str) -> None:
    """Syncs the new directory entry, where the system can; the file is whole without it."""
    with suppress(OSError):
        descriptor = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(descriptor)
        finally:
            os.close(descriptor)


def _remove(path: str) -> None:
    with suppress(OSError):
        os.unlink(path)
