"""One child process from its start to its end: asked, listened to with a time limit, and ended whatever state it is in."""

from __future__ import annotations

import json
import os
import queue
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Iterator, Mapping
from contextlib import suppress
from typing import IO, Any, NamedTuple

from .protocol import MAX_LINE, Event, ProtocolError, event, line
from .worker import EXECUTE

MAX_WAITING = 4096
"""Answers that may wait to be read; then the child has to wait."""

MAX_OUTPUT = 16 << 10
"""Bytes kept of the beginning, and of the end, of what driver and layer print."""


class Limits(NamedTuple):
    """What a child may take: `seconds` for each pass by the wall clock, `memory` bytes of address space (0: unlimited)."""

    seconds: float = 30.0
    memory: int = 8 << 30


class ChildExit(Exception):
    """A child that is no more: `how` is `died`, `timed-out` or `garbage`; `signal` its name, empty where there was none."""

    def __init__(self, how: str, text: str, signal: str = "") -> None:
        super().__init__(text)
        self.how = how
        self.signal = signal


class Child:
    """A running worker. Whoever makes one closes it."""

    def __init__(self, folder: str, limits: Limits, environment: Mapping[str, str], execute: str = EXECUTE) -> None:
        self.limits = limits
        given = json.dumps({"memory": limits.memory, "execute": execute})
        # -P: what lies in the folder is no module of ours.
        command = [sys.executable, "-P", "-m", "msaa_lint.experiments.confirm.worker", given]
        self._process = subprocess.Popen(
            command,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            cwd=folder,
            env=dict(environment),
            start_new_session=True,
        )
        assert self._process.stdin and self._process.stdout and self._process.stderr
        self._answers: queue.Queue[bytes] = queue.Queue(MAX_WAITING)
        self._closing = False
        self.printed = ChildOutput(self._process.stderr)
        self._listener = threading.Thread(target=self._listen, args=(self._process.stdout,), daemon=True)
        self._listener.start()

    def send(self, request: Mapping[str, Any], seconds: float | None = None) -> None:
        """Asks something; `answers` has what comes of it. A child that does not read does not hold us up."""
        limit = seconds if seconds is not None else self.limits.seconds
        text = line({**request, "seconds": _patience(limit, request)})
        threading.Thread(target=self._write, args=(text,), daemon=True).start()

    def answers(self, seconds: float | None = None) -> Iterator[Event]:
        """The answers to a request, the last of them included (`done`, `failed`, `opened`, `devices`).

        Ended where the child dies, writes garbage or goes on for longer than the limit from now, or from the last pass that it announced
        or timed. It is then closed already.
        """
        limit = seconds if seconds is not None else self.limits.seconds
        deadline = time.monotonic() + limit
        while True:
            try:
                text = self._answers.get(timeout=max(deadline - time.monotonic(), 0))
            except queue.Empty:
                self.close()
                raise ChildExit("timed-out", f"it took longer than {limit:g} s") from None
            if not text:
                raise self._ended()
            try:
                found = event(text)
            except ProtocolError as error:
                self.close()
                raise ChildExit("garbage", f"the process with the driver in it wrote {error}, and was ended") from None
            if found["event"] in ("pass", "time"):
                deadline = time.monotonic() + limit
            yield found
            if found["event"] in ("done", "failed", "opened", "devices"):
                return
            if time.monotonic() > deadline:
                self.close()
                raise ChildExit("timed-out", f"it took longer than {limit:g} s")

    def close(self) -> None:
        """Ends the child and all that it started; nothing of it is left."""
        self._closing = True
        process = self._process
        with suppress(OSError):
            if hasattr(os, "killpg"):
                # The group's number is the child's, and stays its own until it has been waited for.
                os.killpg(process.pid, signal.SIGKILL)
            else:
                process.kill()
        process.wait()
        with suppress(queue.Empty):
            while True:
                self._answers.get_nowait()
        self._listener.join(1)
        self.printed.join(1)
        for pipe in (process.stdin, process.stdout, process.stderr):
            with suppress(OSError):
                if pipe is not None:
                    pipe.close()

    def _write(self, text: bytes) -> None:
        # A child that is gone is seen by its answers.
        with suppress(OSError, ValueError):
            assert self._process.stdin is not None
            self._process.stdin.write(text)
            self._process.stdin.flush()

    def _listen(self, answers: IO[bytes]) -> None:
        text = b"?"
        while text and not self._closing:
            try:
                text = answers.readline(MAX_LINE)
            except (OSError, ValueError):
                text = b""
            while not self._closing:
                with suppress(queue.Full):
                    self._answers.put(text, timeout=0.2)
                    break

    def _ended(self) -> ChildExit:
        """What a child that closed its answers came to."""
        try:
            code = self._process.wait(1)
        except subprocess.TimeoutExpired:
            self.close()
            return ChildExit("garbage", "the process with the driver in it closed its answers, and was ended")
        self.close()
        text = self.printed.last()
        agreement = f"; its last words: {text}" if text else ""
        if code >= 0:
            return ChildExit("died", f"the driver ended the process with code {code}{agreement}")
        name = signal_name(-code)
        hint = ", as the system does when memory runs out" if name == "SIGKILL" else ""
        return ChildExit("died", f"{name}{hint}{agreement}", name)


def _patience(limit: float, request: Mapping[str, Any]) -> float:
    """Seconds after which the child ends by itself, should the parent be gone: more than the parent would ever wait."""
    repeats = int((request.get("want") or {}).get("repeats", 0))
    return min(limit * (2 + len(request.get("passes") or ())) * (1 + repeats) + 5, 1e6)


def signal_name(number: int) -> str:
    """`SIGSEGV` of 11."""
    try:
        return signal.Signals(number).name
    except ValueError:
        return f"signal {number}"


class ChildOutput:
    """What a child prints, read by a thread to the end so that it never waits; of that the beginning and the end."""

    def __init__(self, pipe: IO[bytes]) -> None:
        self._pipe = pipe
        self.head = b""
        self.tail = b""
        self.dropped = 0
        self._thread = threading.Thread(target=self._read, daemon=True)
        self._thread.start()

    def join(self, seconds: float) -> None:
        """Waits for the end of what is printed, at most so long."""
        self._thread.join(seconds)

    def text(self) -> str:
        """What is kept, as text."""
        left = f"\n... {self.dropped} bytes ...\n" if self.dropped else ""
        return self.head.decode("utf-8", "replace") + left + self.tail.decode("utf-8", "replace")

    def last(self) -> str:
        """The last line that is not empty, at most 200 characters; empty where nothing was printed."""
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
