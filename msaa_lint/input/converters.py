"""Binary captures, read through the converters of the tools that write them.

A converter parses the file natively, so it runs only for a file that the user names. It is looked
up outside the project in the working folder, and runs in an empty folder, with the environment of
all child processes.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from typing import NamedTuple

from msaa_lint.core.scratch import ScratchFolder

from .capture_stream import CaptureStream, StreamFailure, pieces_of
from .child_program import BLOCK, Program, installed
from .file_types import BinaryCapture

PATIENCE = 300.0
"""Seconds without output after which a converter is stopped."""

MAX_LOG_LINE = 1 << 16

MAX_WARNINGS, MAX_WARNING = 4, 200
"""How many warnings of a converter are shown, and how many characters of each."""

_MARK = b"[gfxrecon]"
_LOG_START = re.compile(
    rb"(?<=[}\n])\[gfxrecon\](?:\[\d{1,20}\])? (DEBUG|INFO|WARNING|ERROR|FATAL)\b"
)
_LOG_LINE = re.compile(_LOG_START.pattern + rb"([^\n]*)\n")
_LOG_START_BYTES = 48
"""More bytes than the beginning of a line of the log has, with the character before it."""

_FAILURE = re.compile(
    rb"\[gfxrecon\][^\n]{0,40}? (?:(?:ERROR|FATAL)\b[^\n]*? - |WARNING - (?=Incomplete "
    rb"block))([^\n]*)"
)
"""What gfxrecon-convert logs when it has not read all of a capture; version 0.9 still exits with
0.
"""


class ConvertedCapture(NamedTuple):
    """The text of a converted capture. The files that belong to it are beside `path`, where there
    may be no file.

    `warnings` has what the converter warned of before the stream ended, each text once.
    """

    stream: CaptureStream
    path: str
    warnings: list[str]


def is_installed(kind: BinaryCapture) -> bool:
    """Whether the converter is installed, outside the project in the working folder."""
    return installed(kind.program) is not None


@contextmanager
def converted(kind: BinaryCapture, path: str) -> Iterator[ConvertedCapture]:
    """Converts a capture while it is read. Its converter must be installed. Raises OSError if the
    converter cannot be started.
    """
    with ExitStack() as stack:
        folder = ScratchFolder()
        stack.callback(folder.remove)
        convert = _gfxreconstruct if kind.format == "gfxreconstruct" else _renderdoc
        yield convert(os.path.abspath(path), folder.path, stack)


def _gfxreconstruct(path: str, folder: str, stack: ExitStack) -> ConvertedCapture:
    """The output of gfxrecon-convert as it comes, and the shaders that gfxrecon-extract writes: the
    former has no code.
    """
    target = os.path.join(folder, "capture.gfxr")
    if installed("gfxrecon-extract") is not None:
        with (
            Program(
                ["gfxrecon-extract", "--dir", f"{target}.shaders", path], folder, PATIENCE
            ) as program,
            suppress(StreamFailure),
        ):
            # What fails here fails again in the conversion, which says so.
            program.finish()
    with (
        Program(["gfxrecon-convert", "--help"], folder, PATIENCE) as program,
        suppress(StreamFailure),
    ):
        program.finish()
    # Version 0.9 writes JSON Lines alone, and has no such option.
    lines = ["--format", "jsonl"] if "--format" in program.text() else []
    program = stack.enter_context(
        Program(["gfxrecon-convert", *lines, "--output", "stdout", path], folder, PATIENCE)
    )
    warnings: list[str] = []
    return ConvertedCapture(CaptureStream(_without_log(program, warnings)), target, warnings)


def _renderdoc(path: str, folder: str, stack: ExitStack) -> ConvertedCapture:
    """The file that renderdoccmd writes, beside the zip of its shaders and buffers."""
    target = os.path.join(folder, "capture.zip.xml")
    failure: StreamFailure | None = None
    with Program(
        ["renderdoccmd", "convert", "-i", "rdc", "-f", path, "-o", target, "-c", "zip.xml"],
        folder,
        PATIENCE,
    ) as program:
        try:
            program.finish()
        except StreamFailure as error:
            failure = error

    def pieces() -> Iterator[bytes]:
        with suppress(FileNotFoundError), open(target, "rb") as file:
            yield from pieces_of(file, BLOCK)
        if failure is not None:
            raise failure

    return ConvertedCapture(CaptureStream(pieces()), target, [])


def _without_log(program: Program, warnings: list[str]) -> Iterator[bytes]:
    """The output of gfxrecon-convert without its log, which it writes to the same stream.

    Line ends are escaped within JSON, so none of it looks like a line of the log. Raises
    StreamFailure if the log says that the capture was not read to its end. Adds what it warns of to
    `warnings`.
    """
    failure: StreamFailure | None = None
    problem = b""

    def drop(line: re.Match[bytes]) -> bytes:
        nonlocal problem
        found = _FAILURE.match(line[0])
        text = line[2].removeprefix(b" - ")[:MAX_WARNING].decode("utf-8", "replace")
        if found is not None:
            problem = found[1]
        elif line[1] == b"WARNING" and len(warnings) < MAX_WARNINGS and text not in warnings:
            warnings.append(text)
        return b""

    rest = b"\n"
    try:
        for piece in program.output():
            data = rest + piece
            end = max(len(data) - _LOG_START_BYTES, 0)
            if _MARK in data:
                data = _LOG_LINE.sub(drop, data)
                unfinished = _LOG_START.search(data)
                end = max(len(data) - _LOG_START_BYTES, 0)
                if unfinished is not None and len(data) - unfinished.start() < MAX_LOG_LINE:
                    end = min(end, unfinished.start() - 1)
            yield data[:end]
            rest = data[end:]
    except StreamFailure as error:
        failure = error
    yield _LOG_LINE.sub(drop, rest + b"\n")
    if failure is not None:
        raise failure
    errors = _FAILURE.search(program.errors.text().encode())
    problem = problem or (errors[1] if errors is not None else b"")
    if problem:
        raise StreamFailure(f"gfxrecon-convert: {problem[:200].decode('utf-8', 'replace')}")
