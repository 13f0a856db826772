"""Standard output and standard error while a command runs: what goes wrong there ends every command
alike.
"""

from __future__ import annotations

import io
import os
import sys
from collections.abc import Callable
from contextlib import suppress
from typing import Any

WRITE_FAILED = 2
"""The exit code if standard output cannot be written, or if the program that reads it is gone."""


class OutputError(Exception):
    """Why standard output cannot be written; empty if the program that reads it is gone, which is
    no mistake.

    Not an OSError, so that no handler takes it for the error of a file.
    """


class _Output:
    """A stream that raises OutputError instead of OSError; `problem` says why it cannot be written
    at all.
    """

    def __init__(self, stream: Any, problem: str = "") -> None:
        self._stream, self._problem = stream, problem

    def __getattr__(self, name: str) -> Any:
        return getattr(self._stream, name)

    @property
    def buffer(self) -> Any:
        return _Output(getattr(self._stream, "buffer", None), self._problem)

    def write(self, text: Any) -> Any:
        if self._problem:
            raise OutputError(self._problem)
        try:
            return self._stream.write(text)
        except OSError as error:
            raise _output_error(error) from None

    def flush(self) -> None:
        try:
            self._stream.flush()
        except OSError as error:
            raise _output_error(error) from None


class _Errors(_Output):
    """Standard error: nobody can be told that it cannot be written."""

    def write(self, text: Any) -> Any:
        with suppress(OutputError):
            return super().write(text)
        _discard(self._stream)
        return len(text)

    def flush(self) -> None:
        with suppress(OutputError):
            super().flush()


def _output_error(error: OSError) -> OutputError:
    return OutputError("" if isinstance(error, BrokenPipeError) else error.strerror or str(error))


def run_with_streams(command: Callable[[], int]) -> int:
    """Calls a command and returns its exit code, or that of the SystemExit that it raises; 2 if its
    output cannot be written, 130 on an interrupt.
    """
    _open_closed()
    streams = sys.stdin, sys.stdout, sys.stderr
    sys.stdout, sys.stderr = _Output(*_usable(sys.stdout)), _Errors(*_usable(sys.stderr))
    if sys.stdin is None:
        sys.stdin = io.TextIOWrapper(io.BytesIO())
    try:
        for stream in (sys.stdout, sys.stderr):
            # Its own encoding may lack characters, and machine formats are UTF-8 whatever the
            # locale.
            if hasattr(stream, "reconfigure"):
                stream.flush()
                stream.reconfigure(encoding="utf-8", errors="backslashreplace")
        code = _exit_code(command)
        sys.stdout.flush()
        return code
    except OutputError as error:
        _discard(streams[1])
        if str(error):
            print(f"msaa-lint: cannot write to standard output: {error}", file=sys.stderr)
        return WRITE_FAILED
    except KeyboardInterrupt:
        return 130
    finally:
        sys.stdin, sys.stdout, sys.stderr = streams


def _exit_code(command: Callable[[], int]) -> int:
    try:
        return command()
    except SystemExit as end:
        return end.code if isinstance(end.code, int) else int(end.code is not None)


def _usable(stream: Any) -> tuple[Any, str]:
    """A standard stream and an empty text; if it was closed, one that takes nothing and the
    reason.
    """
    return (
        (stream, "")
        if stream is not None
        else (io.TextIOWrapper(io.BytesIO(), encoding="utf-8"), "it is closed")
    )


def _open_closed() -> None:
    """Opens nothing in place of closed standard streams, so that no file or child process takes
    their numbers.
    """
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDWR)


def _discard(stream: Any) -> None:
    """Makes what a stream still holds go nowhere: Python would report the error again when it
    closes the stream.
    """
    with suppress(OSError, ValueError, AttributeError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())
