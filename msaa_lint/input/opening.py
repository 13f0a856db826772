"""What an input is: bytes of a text, source code, or a capture, which is read as a stream and may be of any length."""

from __future__ import annotations

import io
import os
import sys
from typing import TYPE_CHECKING, BinaryIO

from msaa_lint.core.diagnostics import diagnostic
from msaa_lint.core.finding import Finding
from msaa_lint.core.text.files import opened
from msaa_lint.core.text.node import Limits
from msaa_lint.core.text.source import Unreadable

from .readers import CAPTURES, FORMATS, capture_format

if TYPE_CHECKING:
    from .capture_input import CaptureInput
    from .source_file import SourceFile

HEAD = 64 << 10
"""So many bytes tell what an input is."""

STDIN = "-"

DESCRIPTIONS = (".yaml", ".yml", ".json", ".jsonl", ".xml", ".foz")
"""Endings that source code never has."""


class Unconverted(Unreadable):
    """Something that a tool wrote for itself: what it is, and what to run to have it as something that is read."""


class Uninstalled(Unreadable):
    """Source code, where the extra that reads it is not installed."""


def unreadable(error: OSError | Unreadable, name: str) -> Finding:
    """The finding of an input that cannot be read."""
    if isinstance(error, Unconverted):
        return diagnostic("MSAA901", f"this is {error}", name)
    if isinstance(error, Uninstalled):
        return diagnostic("MSAA921", str(error), name)
    code = "MSAA906" if isinstance(error, Unreadable) else "MSAA901"
    reason = (error.strerror if isinstance(error, OSError) else None) or str(error)
    return diagnostic(code, f"the input cannot be read: {reason}", name)


def load(
    path: str, limits: Limits, name: str | None = None, format: str | None = None, data: bytes | None = None
) -> bytes | CaptureInput | SourceFile:
    """The bytes of a text, source code that was read, or a capture that was read as far as it goes.

    `path` is `-` for standard input, for which `data` may stand; `name` is what findings call the input, `format` what it is to be read as,
    whatever it looks like. OSError where it cannot be read or is no file; Unreadable where a text is larger than the limit, it is something
    that must be converted first, or it is source code and the extra `source` is not installed.
    """
    if path == STDIN:
        stream: BinaryIO = sys.stdin.buffer if data is None else io.BytesIO(data)
        return _loaded(stream, None, limits, name or "<stdin>", format, None)
    file, size = opened(path)
    with file:
        return _loaded(file, size, limits, name or path, format, os.path.abspath(path))


def _loaded(
    stream: BinaryIO, size: int | None, limits: Limits, name: str, format: str | None, path: str | None
) -> bytes | CaptureInput | SourceFile:
    # No more than there is: Python sets aside as much memory as it is asked to read.
    head = stream.read(HEAD if size is None else min(size, HEAD) + 1)
    language = _language(name, head, format)
    found = format if format in CAPTURES else None if format is not None or language is not None else capture_format(head)
    if found is not None:
        from .capture_input import captured

        if path is not None and stream.seekable():
            stream.seek(0)
            return captured(stream, found, name, path)
        return captured(io.BufferedReader(_Joined(head, stream), HEAD), found, name, path)
    hint = _hint(head) if format is None and language is None else None
    if hint is not None:
        raise Unconverted(hint)
    data = head if size is None else head + stream.read(max(min(size, limits.bytes) + 1 - len(head), 0))
    if len(data) > (size or 0):
        # A stream, a file of the kernel's, or one that grows.
        data += stream.read(max(limits.bytes + 1 - len(data), 0))
    if len(data) > limits.bytes:
        raise Unreadable(f"the input is larger than the limit of {limits.bytes} bytes")
    return data if language is None else _program(data, name, language)


def _language(name: str, head: bytes, format: str | None) -> str | None:
    """The language of source code; None of anything else. Nothing of it is loaded for what has a description's ending."""
    if format is not None:
        if format in FORMATS:
            return None
        from .code import LANGUAGES

        return format if format in LANGUAGES else None
    if name.endswith(DESCRIPTIONS):
        return None
    from .code import LANGUAGES, language_of, unread

    language = language_of(name, head.decode("latin-1"))
    stranger = unread(name) if language is None else None
    if stranger is not None:
        raise Unconverted(f"{stranger}, which is not read; --input-format can say {', '.join(LANGUAGES)}")
    return language


def _program(data: bytes, name: str, language: str) -> SourceFile:
    from .code.parsing import Missing
    from .source_file import read_source_file

    try:
        return read_source_file(data, name, language)
    except Missing as error:
        raise Uninstalled(str(error)) from None


def _hint(head: bytes) -> str | None:
    """What must be done first with a file that some tool wrote for itself."""
    if not head or (head[:1].isascii() and b"\0" not in head[:512] and b"vk" not in head):
        return None
    from .captures.unsupported import hint

    return hint(head)


class _Joined(io.RawIOBase):
    """What was read of a stream, and then the rest of it."""

    def __init__(self, head: bytes, rest: BinaryIO) -> None:
        self._head = memoryview(head)
        self._rest = rest

    def readable(self) -> bool:
        return True

    def readinto(self, buffer: object) -> int:
        view = memoryview(buffer).cast("B")  # type: ignore[arg-type]
        if self._head:
            count = min(len(view), len(self._head))
            view[:count] = self._head[:count]
            self._head = self._head[count:]
            return count
        data = self._rest.read1(len(view)) if hasattr(self._rest, "read1") else self._rest.read(len(view))
        view[: len(data)] = data
        return len(data)
