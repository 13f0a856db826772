"""Writes files atomically: a file has either its old or its new contents, even if the process is
killed.

The new contents are written to a file in the same folder, which is then renamed.
"""

from __future__ import annotations

import errno
import os
import re
import stat
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from typing import IO

from .project import leaving_link, resolved

_NEW = (
    os.O_WRONLY
    | os.O_CREAT
    | os.O_EXCL
    | getattr(os, "O_CLOEXEC", 0)
    | getattr(os, "O_NOFOLLOW", 0)
    | getattr(os, "O_BINARY", 0)
)

_STREAMS = re.compile(r"/dev|/proc/\d+(?:/task/\d+)?/fd")
"""Folders whose links are to what streams go to."""


class NotWritten(Exception):
    """Why a file was left unchanged."""


def write_file(path: str, data: bytes, is_own: Callable[[str], bool] | None = None) -> None:
    """Creates a file or replaces it, as `new_text` does. If `is_own` is given, a file that it does
    not accept is left: FileExistsError.
    """
    with _new_file(path, is_own) as (descriptor, _):
        _write_all(descriptor, data)


@contextmanager
def new_text(path: str) -> Iterator[IO[str]]:
    """Opens a file for UTF-8 text that gets its name only when all of it is written; a file that it
    replaces keeps its mode.

    A symbolic link to a file is replaced itself, and a folder that is a link out of the project is
    refused, so that nothing is written through a link; what is no file, such as `/dev/stdout`, is
    written to. Raises OSError, and leaves an old file as it was.
    """
    with (
        _new_file(path) as (descriptor, _),
        open(descriptor, "w", encoding="utf-8", newline="\n", closefd=False) as file,
    ):
        yield file


@contextmanager
def new_binary(path: str) -> Iterator[IO[bytes]]:
    """Opens a file for bytes, as `new_text` does for text."""
    with _new_file(path) as (descriptor, _), open(descriptor, "wb", closefd=False) as file:
        yield file


@contextmanager
def new_path(path: str) -> Iterator[str]:
    """The path of an empty file, for a library that opens files by name, which gets its name as
    that of `new_text` does.
    """
    with _new_file(path) as (_, temporary):
        yield temporary


@contextmanager
def _new_file(path: str, is_own: Callable[[str], bool] | None = None) -> Iterator[tuple[int, str]]:
    """The descriptor and the path of a new file beside a path, which gets the path's name at the
    end, unless an exception ends it.
    """
    status = os.lstat(path) if os.path.lexists(path) else None
    if status is not None and is_own is None and _is_stream(path, status.st_mode):
        descriptor = os.open(path, os.O_WRONLY | os.O_TRUNC | getattr(os, "O_CLOEXEC", 0))
        try:
            yield descriptor, path
        finally:
            os.close(descriptor)
        return
    _refuse_link(os.path.dirname(path))
    if status is not None and not stat.S_ISLNK(status.st_mode):
        if _is_read_only(path, status):
            raise PermissionError(errno.EACCES, "the file is read-only", path)
        if is_own is not None and not (stat.S_ISREG(status.st_mode) and is_own(path)):
            raise FileExistsError(
                errno.EEXIST, "msaa-lint did not write the file that is there", path
            )
    temporary = _temporary(path)
    try:
        descriptor = os.open(temporary, _NEW, 0o666)
        try:
            yield descriptor, temporary
            if status is not None and stat.S_ISREG(status.st_mode) and hasattr(os, "fchmod"):
                os.fchmod(descriptor, stat.S_IMODE(status.st_mode))
        finally:
            os.close(descriptor)
        os.replace(temporary, path)
    except BaseException:
        _remove(temporary)
        raise


def replace(path: str, before: bytes, after: bytes) -> None:
    """Replaces the contents of a file, and syncs them to disk. Keeps the file's mode and, if
    permitted, its owner.

    Raises NotWritten if the file has contents other than `before`, is read-only, or cannot be
    written; it is then unchanged, and no other file is left behind. The target of a symbolic link
    is replaced if it is in the project. Another hard link to the file keeps the old contents.
    """
    temporary = ""
    try:
        _refuse_link(path)
        target = resolved(path)
        status = _check_unchanged(target, before)
        if _is_read_only(target, status):
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


def _is_stream(path: str, mode: int) -> bool:
    """Whether a path of a mode is no file, folder or link to one: a device, a pipe, or a link of
    the system's such as `/dev/stdout`.
    """
    if stat.S_ISLNK(mode):
        return (
            _STREAMS.fullmatch(os.path.realpath(os.path.dirname(os.path.abspath(path)))) is not None
        )
    return not stat.S_ISREG(mode) and not stat.S_ISDIR(mode)


def _is_read_only(path: str, status: os.stat_result) -> bool:
    """Whether a file must not be written, which renaming another one to its place would not
    heed.
    """
    return not status.st_mode & (stat.S_IWUSR | stat.S_IWGRP | stat.S_IWOTH) or not os.access(
        path, os.W_OK
    )


def _refuse_link(path: str) -> None:
    """OSError if a part of a path is a link that leads out of the project."""
    link = leaving_link(path)
    if link is not None:
        raise OSError(
            errno.ELOOP,
            f"`{link}` is a link that leads out of the project; name the place that it leads to",
            path,
        )


def _temporary(path: str) -> str:
    return os.path.join(
        os.path.dirname(path), f".msaa-lint-{os.getpid()}-{os.urandom(6).hex()}.tmp"
    )


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
