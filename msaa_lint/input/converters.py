"""Binary captures, read through the converters of the tools that write them.

A converter parses the file natively, so it runs only for a file that the user names. It is looked up outside the project in the working
folder, and runs in an empty folder, with the environment of all child processes.
"""

from __future__ import annotations

import os
import re
import shutil
import signal
import subprocess
import threading
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from typing import NamedTuple

from msaa_lint.core.child_environment import child_environment
from msaa_lint.core.child_output import ChildOutput, signal_name
from msaa_lint.core.scratch import ScratchFolder

from .capture_stream import CaptureStream, StreamFailure, pieces_of
from .file_types import BinaryCapture

PATIENCE = 300.0
"""Seconds without output after which a converter is stopped."""

BLOCK = 1 << 16

MAX_LOG_LINE = 1 << 16

MAX_WARNINGS, MAX_WARNING = 4, 200
"""How many warnings of a converter are shown, and how many characters of each."""

_MARK = b"[gfxrecon]"
_LOG_START = re.compile(rb"(?<=[}\n])\[gfxrecon\](?:\[\d{1,20}\])? (DEBUG|INFO|WARNING|ERROR|FATAL)\b")
_LOG_LINE = re.compile(_LOG_START.pattern + rb"([^\n]*)\n")
_LOG_START_BYTES = 48
"""More bytes than the beginning of a line of the log has, with the character before it."""

_FAILURE = re.compile(rb"\[gfxrecon\][^\n]{0,40}? (?:(?:ERROR|FATAL)\b[^\n]*? - |WARNING - (?=Incomplete block))([^\n]*)")
"""What gfxrecon-convert logs when it has not read all of a capture; version 0.9 still exits with 0."""


class ConvertedCapture(NamedTuple):
    """The text of a converted capture. The files that belong to it are beside `path`, where there may be no file.

    `warnings` has what the converter warned of before the stream ended, each text once.
    """

    stream: CaptureStream
    path: str
    warnings: list[str]


def is_installed(kind: BinaryCapture) -> bool:
    """Whether the converter is installed, outside the project in the working folder."""
    return _found(kind.program) is not None


@contextmanager
def converted(kind: BinaryCapture, path: str) -> Iterator[ConvertedCapture]:
    """Converts a capture while it is read. Its converter must be installed. Raises OSError if the converter cannot be started."""
    with ExitStack() as stack:
        folder = ScratchFolder()
        stack.callback(folder.remove)
        convert = _gfxreconstruct if kind.format == "gfxreconstruct" else _renderdoc
        yield convert(os.path.abspath(path), folder.path, stack)


def _gfxreconstruct(path: str, folder: str, stack: ExitStack) -> ConvertedCapture:
    """The output of gfxrecon-convert as it comes, and the shaders that gfxrecon-extract writes: the former has no code."""
    target = os.path.join(folder, "capture.gfxr")
    if _found("gfxrecon-extract") is not None:
        with _Program(["gfxrecon-extract", "--dir", f"{target}.shaders", path], folder) as program, suppress(StreamFailure):
            # What fails here fails again in the conversion, which says so.
            program.finish()
    with _Program(["gfxrecon-convert", "--help"], folder) as program, suppress(StreamFailure):
        program.finish()
    # Version 0.9 writes JSON Lines alone, and has no such option.
    lines = ["--format", "jsonl"] if "--format" in program.text() else []
    program = stack.enter_context(_Program(["gfxrecon-convert", *lines, "--output", "stdout", path], folder))
    warnings: list[str] = []
    return ConvertedCapture(CaptureStream(_without_log(program, warnings)), target, warnings)


def _renderdoc(path: str, folder: str, stack: ExitStack) -> ConvertedCapture:
    """The file that renderdoccmd writes, beside the zip of its shaders and buffers."""
    target = os.path.join(folder, "capture.zip.xml")
    failure: StreamFailure | None = None
    with _Program(["renderdoccmd", "convert", "-i", "rdc", "-f", path, "-o", target, "-c", "zip.xml"], folder) as program:
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


def _found(program: str) -> str | None:
    return shutil.which(program, path=child_environment().get("PATH", ""))


class _Program:
    """A program that runs. It is killed at the end of the `with` statement, and when it writes nothing for PATIENCE seconds."""

    def __init__(self, command: list[str], folder: str) -> None:
        program = _found(command[0])
        if program is None:
            raise FileNotFoundError(f"{command[0]} is not installed")
        self._name = command[0]
        self._process = subprocess.Popen(
            [program, *command[1:]],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            cwd=folder,
            env=child_environment(),
            start_new_session=True,
        )
        assert self._process.stdout and self._process.stderr
        self._stdout = self._process.stdout
        self.errors = ChildOutput(self._process.stderr)
        self._head = b""
        self._waits_since: float | None = None
        self._ended = threading.Event()
        self._is_late = False
        threading.Thread(target=self._watch, daemon=True).start()

    def __enter__(self) -> _Program:
        return self

    def __exit__(self, *_: object) -> None:
        self._ended.set()
        self._kill()
        self._process.wait()
        self.errors.join(1)
        for pipe in (self._stdout, self._process.stderr):
            if pipe is not None:
                pipe.close()

    def output(self) -> Iterator[bytes]:
        """The standard output as it comes. Raises StreamFailure at its end if the program failed."""
        while True:
            self._waits_since = time.monotonic()
            piece = os.read(self._stdout.fileno(), BLOCK)
            self._waits_since = None
            if not piece:
                break
            self._head = self._head or piece
            yield piece
        self._waits_since = time.monotonic()
        code = self._process.wait()
        self._ended.set()
        self.errors.join(1)
        if self._is_late:
            raise StreamFailure(f"{self._name} wrote nothing for {PATIENCE:.0f} s and was stopped")
        if code:
            how = f"was ended by {signal_name(-code)}" if code < 0 else f"failed with exit code {code}"
            words = self.errors.last()
            raise StreamFailure(f"{self._name} {how}" + (f": {words}" if words else ""))

    def finish(self) -> None:
        """Waits for the end. Raises StreamFailure if the program failed."""
        for _ in self.output():
            pass

    def text(self) -> str:
        """The beginning of what the program wrote, to either stream."""
        return self._head.decode("utf-8", "replace") + self.errors.text()

    def _watch(self) -> None:
        while not self._ended.wait(1):
            since = self._waits_since
            if since is not None and time.monotonic() - since > PATIENCE:
                self._is_late = True
                self._kill()

    def _kill(self) -> None:
        if self._process.poll() is not None:
            return
        with suppress(OSError):
            if hasattr(os, "killpg"):
                # Of a script, also what it started.
                os.killpg(self._process.pid, signal.SIGKILL)
            else:
                self._process.kill()


def _without_log(program: _Program, warnings: list[str]) -> Iterator[bytes]:
    """The output of gfxrecon-convert without its log, which it writes to the same stream.

    Line ends are escaped within JSON, so none of it looks like a line of the log. Raises StreamFailure if the log says that the capture
    was not read to its end. Adds what it warns of to `warnings`.
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
