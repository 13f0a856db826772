"""How a child process ended, and what it wrote while it ran."""

from __future__ import annotations

import os
import signal
import threading
from typing import IO

MAX_OUTPUT = 16 << 10
"""Bytes kept of the beginning and of the end of a child's output."""


def signal_name(number: int) -> str:
    """The name of a signal: `SIGSEGV` for 11."""
    try:
        return signal.Signals(number).name
    except ValueError:
        return f"signal {number}"


class ChildOutput:
    """The beginning and the end of a child's output. A thread reads all of it so that the child
    never blocks.
    """

    def __init__(self, pipe: IO[bytes]) -> None:
        self._pipe = pipe
        self.head = b""
        self.tail = b""
        self.dropped = 0
        self._thread = threading.Thread(target=self._read, daemon=True)
        self._thread.start()

    def join(self, seconds: float) -> None:
        """Waits for the end of the output, at most `seconds`."""
        self._thread.join(seconds)

    def text(self) -> str:
        """The kept output as text."""
        left = f"\n... {self.dropped} bytes ...\n" if self.dropped else ""
        return self.head.decode("utf-8", "replace") + left + self.tail.decode("utf-8", "replace")

    def last(self) -> str:
        """The last nonempty line, at most 200 characters; empty without output."""
        lines = [each.strip() for each in self.text().splitlines() if each.strip()]
        return lines[-1][:200] if lines else ""

    def _read(self) -> None:
        while True:
            try:
                text = os.read(self._pipe.fileno(), 1 << 16)
            except (OSError, ValueError):
                return
            if not text:
                return
            room = MAX_OUTPUT - len(self.head)
            self.head, rest = self.head + text[:room], text[room:]
            tail = self.tail + rest
            self.dropped += max(len(tail) - MAX_OUTPUT, 0)
            self.tail = tail[-MAX_OUTPUT:]
