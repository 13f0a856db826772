"""A program that reads a file of the user natively. It is looked up outside the project in the
working folder, and runs with the environment of all child processes.
"""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import threading
import time
from collections.abc import Iterator
from contextlib import suppress

from msaa_lint.core.child_environment import child_environment
from msaa_lint.core.child_output import ChildOutput, signal_name
from msaa_lint.core.text.files import record_program

from .capture_stream import StreamFailure

BLOCK = 1 << 16
"""Bytes of output that are read at once."""


def installed(program: str) -> str | None:
    """The path of a program, looked up outside the project in the working folder; None if it is not
    installed.
    """
    record_program(program)
    return shutil.which(program, path=child_environment().get("PATH", ""))


class Program:
    """A program that runs. It is killed at the end of the `with` statement, and when it writes
    nothing for `patience` seconds.
    """

    def __init__(self, command: list[str], folder: str, patience: float) -> None:
        program = installed(command[0])
        if program is None:
            raise FileNotFoundError(f"{command[0]} is not installed")
        self._name = command[0]
        self._patience = patience
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

    def __enter__(self) -> Program:
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
        """The standard output as it comes. Raises StreamFailure at its end if the program
        failed.
        """
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
            raise StreamFailure(
                f"{self._name} wrote nothing for {self._patience:.0f} s and was stopped"
            )
        if code:
            how = (
                f"was ended by {signal_name(-code)}"
                if code < 0
                else f"failed with exit code {code}"
            )
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
            if since is not None and time.monotonic() - since > self._patience:
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
