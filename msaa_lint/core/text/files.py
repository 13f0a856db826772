"""Opens files: as named by the command line, or as named by content, which may come from a
stranger.

An editor has texts that are not yet saved: within `with_buffers`, they take the place of their
files.
"""

from __future__ import annotations

import io
import os
import stat
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from typing import BinaryIO

from msaa_lint.core.project import Outside, real_path
from msaa_lint.core.urls import (
    ABSENT,
    inside,
    is_url,
    keep_version,
    normalized,
    open_listed,
    open_object,
    version_read,
)

from .source import Unreadable

FINE_CLOCK = 10_000_000
"""The resolution of the times of most file systems, in nanoseconds, with a margin."""

COARSE_CLOCK = 2_000_000_000
"""The same for a file system whose times are whole seconds."""

_KINDS = {
    stat.S_IFDIR: "a folder",
    stat.S_IFIFO: "a pipe",
    stat.S_IFSOCK: "a socket",
    stat.S_IFCHR: "a device",
    stat.S_IFBLK: "a device",
}

# O_NONBLOCK: opening a pipe must not wait for a writer.
_FLAGS = (
    os.O_RDONLY
    | getattr(os, "O_NONBLOCK", 0)
    | getattr(os, "O_CLOEXEC", 0)
    | getattr(os, "O_BINARY", 0)
)
_NO_LINK = getattr(os, "O_NOFOLLOW", 0)
_buffers: ContextVar[Mapping[str, bytes]] = ContextVar("buffers")
_opened: ContextVar[Opened] = ContextVar("opened")
_FOLDER = (
    getattr(os, "O_PATH", os.O_RDONLY) | getattr(os, "O_DIRECTORY", 0) | getattr(os, "O_CLOEXEC", 0)
)


@contextmanager
def with_buffers(buffers: Mapping[str, bytes]) -> Iterator[None]:
    """Makes this thread read `buffers`, by real or absolute path, in place of the files."""
    token = _buffers.set(buffers)
    try:
        yield
    finally:
        _buffers.reset(token)


class Opened:
    """The absolute paths of the files that were opened, or that something tried to open, each with
    the project that it must be in, None if the command line names it; the names of programs that
    were looked up; and URLs with the versions that their storage stated.
    """

    def __init__(self) -> None:
        self.files: dict[str, str | None] = {}
        self.programs: set[str] = set()
        self.urls: dict[str, str] = {}


@contextmanager
def recording() -> Iterator[Opened]:
    """Records what this thread opens."""
    opened = Opened()
    token = _opened.set(opened)
    try:
        yield opened
    finally:
        _opened.reset(token)


def record_program(name: str) -> None:
    """Adds the name of a program to what is recorded, if anything is."""
    if (opened := _opened.get(None)) is not None:
        opened.programs.add(name)


def record(path: str, project: str | None) -> None:
    """Adds a path, which must be in a project unless that is None, to what is recorded, if anything
    is, and a URL if it was read before.
    """
    if is_url(path):
        url = normalized(path)
        if (version := version_read(url)) is not None:
            _record_url(url, version)
    elif (opened := _opened.get(None)) is not None:
        absolute = os.path.abspath(path)
        opened.files[absolute] = None if opened.files.get(absolute, project) is None else project


def _record_url(url: str, version: str) -> None:
    if (opened := _opened.get(None)) is not None:
        # Of two versions, what was read is unknown.
        opened.urls[url] = version if opened.urls.get(url, version) == version else ""


def is_there(path: str) -> bool:
    """Whether there is a file or folder at a path, or what takes the place of a file."""
    return os.path.exists(path) or os.path.abspath(path) in _buffers.get({})


def _buffer(path: str, project: str | None) -> bytes | None:
    """The unsaved text of a file, if it has one. Raises Outside."""
    buffers = _buffers.get({})
    if not buffers:
        return None
    real = os.path.realpath(path) if project is None else real_path(path, project)
    return buffers.get(real, buffers.get(os.path.abspath(path)))


def open_file(path: str, project: str | None) -> tuple[BinaryIO, int | None]:
    """A file, open for reading, and its size in bytes; None for a pipe or a device.

    `project` is None for a path of the command line, which is read as named: a file, a pipe, or a
    device. A path that a file, a folder, or a link states must be a regular file in the project,
    with all symbolic links resolved, and one that an input at a URL states in the folder that was
    named. Raises OSError, and Outside without looking at what is there.
    """
    if is_url(path if project is None else project):
        return _open_url(path, project)
    try:
        record(path, project)
        unsaved = _buffer(path, project)
        if unsaved is not None:
            return io.BytesIO(unsaved), len(unsaved)
        descriptor = _open_named(path) if project is None else _open_inside(path, project)
    except ValueError as error:
        raise OSError(f"invalid file name: {error}") from None
    file = open(descriptor, "rb")  # noqa: SIM115 - the caller closes it
    try:
        status = os.fstat(descriptor)
        if stat.S_ISREG(status.st_mode):
            return file, status.st_size
        if project is not None:
            _check_regular(status.st_mode)
        if os.name == "posix":
            os.set_blocking(descriptor, True)
        if stat.S_ISFIFO(status.st_mode) and not file.peek(1):
            raise OSError("it is a pipe that nothing writes to")
    except BaseException:
        file.close()
        raise
    return file, None


def open_entry(path: str) -> BinaryIO:
    """A regular file, according to the listing of its folder, open for reading; a link is not
    followed. Raises OSError.
    """
    if is_url(path):
        return open_listed(path)
    record(path, os.path.dirname(os.path.abspath(path)))
    unsaved = _buffer(path, None)
    if unsaved is not None:
        return io.BytesIO(unsaved)
    file = open(os.open(path, _FLAGS | _NO_LINK), "rb")  # noqa: SIM115 - the caller closes it
    try:
        _check_regular(os.fstat(file.fileno()).st_mode)
    except OSError:
        file.close()
        raise
    return file


def _open_url(path: str, project: str | None) -> tuple[BinaryIO, int | None]:
    url = path if project is None else inside(path, project)
    if url is None:
        raise Outside
    version = ""
    try:
        file, stated = open_object(url)
        version = stated.version
    except FileNotFoundError:
        version = ABSENT
        raise
    finally:
        keep_version(url, version)
        _record_url(url, version)
    return file, stated.size


def read(path: str, max_bytes: int, project: str | None) -> bytes:
    """The bytes of a file, which is opened as by `open_file`. Raises OSError, and Unreadable if the
    file is larger than `max_bytes`.
    """
    file, size = open_file(path, project)
    with file:
        # Python allocates as much memory as it is asked to read. Files in /proc, and files that
        # grow, have more than their stated size.
        data = b"" if (size or 0) > max_bytes else file.read((size or 0) + 1)
        if len(data) > (size or 0):
            data += file.read(max(max_bytes + 1 - len(data), 0))
    if max(len(data), size or 0) > max_bytes:
        raise Unreadable(f"it is larger than the limit of {max_bytes} bytes")
    return data


def content(path: str, project: str | None) -> bytes | None:
    """The bytes of a regular file on disk; None if there is none, or if it must be in a project and
    is not, which is not opened.
    """
    try:
        with open(
            os.open(path, _FLAGS) if project is None else _open_inside(path, project), "rb"
        ) as file:
            status = os.fstat(file.fileno())
            return file.read(status.st_size) if stat.S_ISREG(status.st_mode) else None
    except (OSError, ValueError):
        return None


def file_state(status: os.stat_result) -> list[int]:
    """What differs for a file if it has been written: nobody can set when its state changed
    last.
    """
    return [status.st_mode, status.st_size, status.st_mtime_ns, status.st_ctime_ns, status.st_ino]


def is_settled(state: Sequence[int], start: int) -> bool:
    """Whether any write to a file after `start`, in nanoseconds, gives it a state other than this
    one. Clocks of file systems are coarse; one that counts whole seconds is known by the times that
    it states.
    """
    times = state[2:4]
    return max(times, default=0) < start - (
        COARSE_CLOCK if not any(time % 1_000_000_000 for time in times) else FINE_CLOCK
    )


def _open_named(path: str) -> int:
    mode = os.stat(path).st_mode
    if stat.S_ISDIR(mode) or stat.S_ISSOCK(mode):
        _check_regular(mode)
    return os.open(path, _FLAGS)


def _open_inside(path: str, project: str) -> int:
    """Opens a regular file of a project.

    The real path is opened folder by folder, none of which may be a link, so that nothing that
    changes in between can lead elsewhere.
    """
    real, root = real_path(path, project), os.path.realpath(project)
    *folders, name = os.path.relpath(real, root).split(os.sep)
    if os.open not in os.supports_dir_fd or os.stat not in os.supports_follow_symlinks:
        _check_regular(os.lstat(real).st_mode)
        return os.open(real, _FLAGS)
    parent = os.open(root, _FOLDER)
    try:
        for folder in folders:
            above, parent = parent, os.open(folder, _FOLDER | _NO_LINK, dir_fd=parent)
            os.close(above)
        # Opening a device may have an effect.
        _check_regular(os.stat(name, dir_fd=parent, follow_symlinks=False).st_mode)
        return os.open(name, _FLAGS | _NO_LINK, dir_fd=parent)
    finally:
        os.close(parent)


def _check_regular(mode: int) -> None:
    if not stat.S_ISREG(mode):
        raise OSError(
            f"it is {_KINDS.get(stat.S_IFMT(mode), 'a special file')}, not a regular file"
        )
