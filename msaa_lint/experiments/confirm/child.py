"""A child process: requests, answers within a time limit, and termination in whatever state it
is.
"""

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

from msaa_lint.core.child_output import ChildOutput, signal_name
from msaa_lint.core.isolation import import_path

from .protocol import MAX_LINE, Event, ProtocolError, event, line
from .worker import EXECUTE

MAX_WAITING = 4096
"""Maximum number of unread answers; beyond it the child blocks."""


class Limits(NamedTuple):
    """The limits of a child: `seconds` of wall-clock time per pass, and `memory` bytes of address
    space (0: unlimited).
    """

    seconds: float = 30.0
    memory: int = 8 << 30


class ChildExit(Exception):
    """The end of a child: `how` is `died`, `timed-out` or `garbage`; `signal` is the signal's name,
    empty without any.
    """

    def __init__(self, how: str, text: str, signal: str = "") -> None:
        super().__init__(text)
        self.how = how
        self.signal = signal


_PROGRAM = """\
import json, runpy, sys
sys.path[:] = json.loads(sys.argv[1])["path"]
runpy.run_module("msaa_lint.experiments.confirm.worker", run_name="__main__", alter_sys=True)
"""
"""Runs `worker` with this process's import path. -I: neither a folder nor the environment adds to
it.
"""


class Child:
    """A running worker. The creator must close it."""

    def __init__(
        self, folder: str, limits: Limits, environment: Mapping[str, str], execute: str = EXECUTE
    ) -> None:
        self.limits = limits
        given = json.dumps(
            {
                "memory": limits.memory,
                "execute": execute,
                "path": import_path(),
                "parent": os.getpid(),
            }
        )
        self._process = subprocess.Popen(
            [sys.executable, "-I", "-c", _PROGRAM, given],
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
        self._listener = threading.Thread(
            target=self._listen, args=(self._process.stdout,), daemon=True
        )
        self._listener.start()

    def send(self, request: Mapping[str, Any], seconds: float | None = None) -> None:
        """Sends a request; `answers` returns the answers to it. A child that does not read does not
        block the caller.
        """
        limit = seconds if seconds is not None else self.limits.seconds
        text = line({**request, "seconds": _patience(limit, request)})
        threading.Thread(target=self._write, args=(text,), daemon=True).start()

    def answers(self, seconds: float | None = None) -> Iterator[Event]:
        """The answers to a request up to the last one (`done`, `failed`, `opened` or `devices`).

        ChildExit if the child dies, writes garbage, or takes longer than the limit from now or from
        the last pass that it announced or timed. The child is closed by then.
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
                raise ChildExit(
                    "garbage", f"the driver's process wrote {error} and was terminated"
                ) from None
            if found["event"] in ("pass", "time"):
                deadline = time.monotonic() + limit
            yield found
            if found["event"] in ("done", "failed", "opened", "devices"):
                return
            if time.monotonic() > deadline:
                self.close()
                raise ChildExit("timed-out", f"it took longer than {limit:g} s")

    def close(self) -> None:
        """Terminates the child and all processes that it started."""
        self._closing = True
        process = self._process
        with suppress(OSError):
            if hasattr(os, "killpg"):
                # The process group has the child's id, which stays reserved until the child has
                # been waited for.
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
        # The end of a child shows in its answers.
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
        """How a child that closed its answers ended."""
        try:
            code = self._process.wait(1)
        except subprocess.TimeoutExpired:
            self.close()
            return ChildExit(
                "garbage", "the driver's process closed its answers and was terminated"
            )
        self.close()
        text = self.printed.last()
        agreement = f"; its last words: {text}" if text else ""
        if code >= 0:
            return ChildExit("died", f"the driver ended the process with code {code}{agreement}")
        name = signal_name(-code)
        hint = ", which may mean that memory ran out" if name == "SIGKILL" else ""
        return ChildExit("died", f"{name}{hint}{agreement}", name)


def _patience(limit: float, request: Mapping[str, Any]) -> float:
    """Seconds after which the child ends by itself if the parent is gone: more than the parent
    would ever wait.
    """
    want = request.get("want") or {}
    repeats = int(want.get("repeats", 0) or want.get("rounds", 0))
    return min(
        limit * (2 + len(request.get("passes") or request.get("items") or ())) * (1 + repeats) + 5,
        1e6,
    )
