"""Opens inputs: a text as bytes, source code as documents, and a capture, which may have any
length, as a stream.
"""

from __future__ import annotations

import io
import os
import re
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from itertools import chain
from typing import TYPE_CHECKING, BinaryIO

from msaa_lint.core.diagnostics import diagnostic
from msaa_lint.core.finding import Finding
from msaa_lint.core.project import folder_of
from msaa_lint.core.text.files import open_file
from msaa_lint.core.text.node import Limits
from msaa_lint.core.text.source import Unreadable
from msaa_lint.core.urls import BLOCK, allow, is_url

from .content import own_output
from .file_types import (
    DATA,
    HEAD_BYTES,
    LANGUAGES,
    STDIN,
    BinaryCapture,
    Compression,
    binary_capture,
    compression_of,
)
from .readers import CAPTURES, FORMATS, capture_format

if TYPE_CHECKING:
    from .capture_input import CaptureInput
    from .source_file import SourceFile, SourceText

_WORDS = (b'"vkFunc"', b'"apiCalls"', b'"gfxrecon-version"', b"<rdc>")
_ARCHIVES = ((b"\x04\x22\x4d\x18", "lz4 -d"), (b"PK\x03\x04", "unzip"))


class UnsupportedFormat(Unreadable):
    """A file that is recognized but not read: what it is, and what to run to convert it."""


class NotAnInput(Unreadable):
    """A file that msaa-lint wrote: what it is."""


class MissingExtra(Unreadable):
    """Source code, without the extra that reads it."""


def unreadable(error: OSError | Unreadable, name: str) -> Finding:
    """The finding about an input that cannot be read."""
    if isinstance(error, UnsupportedFormat):
        return diagnostic("MSAA901", f"unsupported input: this is {error}", name)
    if isinstance(error, NotAnInput):
        return diagnostic(
            "MSAA901",
            f"this is {error}, not an input: name the description, capture, or source code that it "
            "is about",
            name,
        )
    if isinstance(error, MissingExtra):
        return diagnostic("MSAA921", str(error), name)
    code = "MSAA906" if isinstance(error, Unreadable) else "MSAA901"
    reason = (error.strerror if isinstance(error, OSError) else None) or str(error)
    return diagnostic(code, f"cannot read the input: {reason}", name)


def load(
    path: str,
    limits: Limits,
    name: str | None = None,
    format: str | None = None,
    data: bytes | None = None,
    project: str | None = None,
    frame_end: str | None = None,
    assumed: Mapping[str, bool | int | str] = {},
) -> bytes | CaptureInput | SourceFile:
    """The bytes of a text, source code read as documents, or a capture read as far as possible.

    `path` is `-` for standard input, which `data` replaces. `name` is the input's name in findings;
    `format` forces a reader. `project` is that of a file in a named folder, None for a named file.
    `frame_end` says where the frames of a capture end, `assumed` which values source code has.
    Raises OSError if the file cannot be read, and Unreadable if a text is larger than the limit, if
    the format is not supported, if the extra for source code is missing, or if a capture lacks the
    debug label that `frame_end` names.
    """
    content = load_text(path, limits, name, format, data, project, frame_end)
    if isinstance(content, bytes):
        return content
    from .source_file import SourceText

    return (
        read_code(content._replace(assumed=assumed)) if isinstance(content, SourceText) else content
    )


def load_text(
    path: str,
    limits: Limits,
    name: str | None = None,
    format: str | None = None,
    data: bytes | None = None,
    project: str | None = None,
    frame_end: str | None = None,
) -> bytes | CaptureInput | SourceText:
    """What `load` returns, but of source code only its text, which is not read yet."""
    if path == STDIN:
        stream: BinaryIO = sys.stdin.buffer if data is None else io.BytesIO(data)
        return _load(stream, None, limits, name or "<stdin>", format, None, False, frame_end)
    is_at_url = is_url(path)
    if is_at_url:
        # Another process may have listed the folder.
        allow(project if project is not None else folder_of(path))
    file, size = open_file(path, project)
    with file:
        # Other files belong to a file only: there is no folder beside a pipe.
        place = None if size is None else path if is_at_url else os.path.abspath(path)
        return _load(file, size, limits, name or path, format, place, project is None, frame_end)


def _load(
    stream: BinaryIO,
    size: int | None,
    limits: Limits,
    name: str,
    format: str | None,
    path: str | None,
    is_named: bool,
    frame_end: str | None,
) -> bytes | CaptureInput | SourceText:
    # Python allocates as much memory as it is asked to read, so a file is asked for no more than
    # its size.
    head = stream.read(HEAD_BYTES if size is None else min(size, HEAD_BYTES) + 1)
    compression = compression_of(head)
    if compression is not None:
        return _decompress(
            _from_beginning(head, stream, path), compression, name, format, path, frame_end
        )
    kind = binary_capture(head)
    if kind is not None and format in (None, kind.format):
        return _convert(kind, _from_beginning(head, stream, path), name, path, is_named, frame_end)
    language = _language(name, head, format)
    capture = (
        format
        if format in CAPTURES
        else None
        if format is not None or language is not None
        else capture_format(head)
    )
    if capture is not None:
        from .capture_input import read_capture

        return read_capture(
            _from_beginning(head, stream, path), capture, name, path, frame_end=frame_end
        )
    output = own_output(head) if format is None else None
    if output is not None:
        raise NotAnInput(output)
    unusual = (
        b"vk" in head
        or b"VULKANINFO" in head[:512]
        or b"\0" in head[:512]
        or not head[:1].isascii()
    )
    form = hint(head) if unusual and format is None and language is None else None
    if form is not None:
        raise UnsupportedFormat(form)
    too_large = size is not None and size > limits.bytes
    data = head if size is None or too_large else head + stream.read(max(size + 1 - len(head), 0))
    if len(data) > (size or 0):
        # Standard input, a file that grows, or one of a virtual file system.
        data += stream.read(max(limits.bytes + 1 - len(data), 0))
    if too_large or len(data) > limits.bytes:
        raise Unreadable(f"the input is larger than the limit of {limits.bytes} bytes")
    return data if language is None else _source_text(data, name, language)


def _from_beginning(head: bytes, stream: BinaryIO, path: str | None) -> BinaryIO:
    """A stream whose head has been read, from its beginning. A file has a path."""
    if path is not None:
        stream.seek(0)
        return stream
    from .capture_stream import CaptureStream, pieces_of

    return CaptureStream(chain((head,), pieces_of(stream, HEAD_BYTES)))


def _decompress(
    stream: BinaryIO,
    compression: Compression,
    name: str,
    format: str | None,
    path: str | None,
    frame_end: str | None,
) -> CaptureInput:
    """Reads a compressed capture."""
    from .capture_input import read_capture
    from .compression import decompressed, without_ending

    text = decompressed(stream, compression)
    head = text.head()
    capture = format if format in CAPTURES else None if format is not None else capture_format(head)
    if capture is not None:
        return read_capture(text, capture, name, path and without_ending(path), frame_end=frame_end)
    kind = binary_capture(head)
    reason = f" ({text.failure})" if text.failure is not None else ""
    content = (
        f"a compressed file that is not a capture{reason}; only captures may be compressed"
        if kind is None
        else f"{kind.name}, compressed"
    )
    raise UnsupportedFormat(f"{content}: decompress it with `{compression.command} FILE`")


def _convert(
    kind: BinaryCapture,
    stream: BinaryIO,
    name: str,
    path: str | None,
    is_named: bool,
    frame_end: str | None,
) -> CaptureInput:
    """Reads a binary capture through the converter of its tool."""
    if path is None:
        raise UnsupportedFormat(
            f"{kind.name}, which cannot be read from a pipe: name the file, or convert it with "
            f"{kind.command}"
        )
    if not is_named:
        raise UnsupportedFormat(
            f"{kind.name}, which is only converted if it is named: name it, or convert it with "
            f"{kind.command}"
        )
    from .capture_input import read_capture
    from .converters import converted, is_installed

    if not is_installed(kind):
        where = f"install it ({kind.source}), or convert the capture elsewhere with {kind.command}"
        raise UnsupportedFormat(
            f"{kind.name}, and {kind.program}, which reads it, is not installed: {where}"
        )
    with _local_copy(stream, path) as local, converted(kind, local) as capture:
        result = read_capture(
            capture.stream, kind.format, name, capture.path, is_binary=True, frame_end=frame_end
        )
        return result._replace(
            notes=(
                *result.notes,
                *(f"{name}: {kind.program}: {warning}" for warning in capture.warnings),
            )
        )


@contextmanager
def _local_copy(stream: BinaryIO, path: str) -> Iterator[str]:
    """The path of a file, of one at a URL that of a copy, for a program that knows paths alone."""
    if not is_url(path):
        yield path
        return
    from shutil import copyfileobj

    from msaa_lint.core.scratch import ScratchFolder

    folder = ScratchFolder()
    try:
        copy = os.path.join(folder.path, "capture")
        with open(copy, "wb") as file:
            copyfileobj(stream, file, BLOCK)
        yield copy
    finally:
        folder.remove()


def _language(name: str, head: bytes, format: str | None) -> str | None:
    """The language of source code; None for anything else."""
    if format is not None:
        return format if format not in FORMATS and format in LANGUAGES else None
    if name.endswith(DATA):
        return None
    from .code import language_of
    from .code.languages import unread

    text = head.decode("latin-1")
    language = language_of(name, text)
    unsupported = unread(name, text) if language is None else None
    if unsupported is not None:
        raise UnsupportedFormat(
            f"{unsupported}, which is not read; --input-format can be {', '.join(LANGUAGES)}"
        )
    return language


def _source_text(data: bytes, name: str, language: str) -> SourceText:
    from .source_file import source_text

    return source_text(data, name, language)


def read_code(text: SourceText) -> SourceFile:
    """Source code read alone, with the errors of `load`."""
    from .code.parsing import Missing
    from .source_file import read_source_text

    try:
        return read_source_text(text)
    except Missing as error:
        raise MissingExtra(str(error)) from None


def hint(head: bytes) -> str | None:
    """What an unsupported file is and how to convert it, from its first bytes; None for any other
    file.
    """
    beginning = head[:4096].lower()
    if beginning.lstrip().startswith(b"<!doctype html") and b"<title>vulkan api dump" in beginning:
        return _dump("HTML")
    if re.match(
        rb"\s*(?:Thread \d+, Frame \d+|vk[A-Z]\w{1,80}\([\w, ]{0,500}\) returns )", head[:4096]
    ):
        return _dump("text")
    if re.match(rb"[=\s]*VULKANINFO\s", head):
        return (
            "a device report of vulkaninfo: use it with `--profile FILE`, or name it as the "
            "`device` of a description"
        )
    for magic, command in _ARCHIVES:
        if head.startswith(magic):
            return f"a compressed file: decompress it with `{command} FILE`"
    if head.startswith((b"\xff\xfe", b"\xfe\xff")) and any(
        word in head.replace(b"\0", b"") for word in _WORDS
    ):
        return (
            "UTF-16 text, as written by PowerShell's `>`: let the tool write the file itself "
            "(`--output FILE`), or convert it to UTF-8"
        )
    return None


def _dump(form: str) -> str:
    return (
        f"api_dump output in {form} format: run the program again with "
        "VK_APIDUMP_OUTPUT_FORMAT=json in its environment"
    )
