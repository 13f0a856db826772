"""Tasks that several processes do at the same time. The processes are copies of this one, so that they know what it knows."""

from __future__ import annotations

import os
import signal
import sys
import threading
from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any, Generic, TypeVar

if TYPE_CHECKING:
    from multiprocessing.connection import Connection
    from multiprocessing.process import BaseProcess

MAX_PROCESSES = 8
"""The maximum number of processes: each takes memory of its own."""

PARENT_SECONDS = 0.5
"""How often a process looks whether the one that it works for has ended."""

Result = TypeVar("Result")


def processes() -> int:
    """Returns how many processes can work at the same time; 1 if this one cannot be copied, since it has other threads, or may have on
    macOS, whose libraries start some."""
    if sys.platform == "darwin" or not hasattr(os, "fork") or threading.active_count() > 1:
        return 1
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    return min(cores, MAX_PROCESSES)


class Workers(Generic[Result]):
    """Processes that do tasks, which are numbers, in their order. Results are pickled on their way to this process.

    The processes end with `close`, and soon after this process. A task whose process does not return is done by this process.
    """

    def __init__(self, work: Callable[[int], Result], tasks: Iterable[int], count: int) -> None:
        from multiprocessing import get_context

        self._work = work
        self._waiting = list(tasks)[::-1]
        self._results: dict[int, Result] = {}
        self._processes: list[BaseProcess] = []
        self._running: dict[Connection[int, Result], int] = {}
        """The tasks that processes do, by the connections to them."""
        context: Any = get_context("fork")
        for _ in range(min(count, len(self._waiting))):
            connection, other = context.Pipe()
            process = context.Process(target=_serve, args=(other, work, os.getpid()), daemon=True)
            process.start()
            other.close()
            self._processes.append(process)
            self._start(connection)

    def result(self, task: int) -> Result:
        """Returns the result of a task, which is asked for once."""
        from multiprocessing.connection import wait

        while task not in self._results and self._running:
            for ready in wait(list(self._running)):
                connection: Any = ready
                number = self._running.pop(connection)
                try:
                    self._results[number] = connection.recv()
                except (EOFError, OSError):
                    connection.close()
                else:
                    self._start(connection)
        return self._results.pop(task) if task in self._results else self._work(task)

    def _start(self, connection: Connection[int, Result]) -> None:
        """Gives the next task to a process that does none."""
        if self._waiting:
            try:
                connection.send(self._waiting[-1])
            except OSError:
                return
            self._running[connection] = self._waiting.pop()

    def close(self) -> None:
        """Ends the processes."""
        for process in self._processes:
            process.kill()
        for process in self._processes:
            process.join()


def _serve(connection: Connection[Any, int], work: Callable[[int], object], parent: int) -> None:
    """Does tasks, in another process, until its parent ends it, or has itself ended."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    for name in ("SIGTERM", "SIGHUP", "SIGQUIT"):
        signal.signal(getattr(signal, name), signal.SIG_DFL)

    def end_with_parent(*_: object) -> None:
        if os.getppid() != parent:
            os._exit(1)

    signal.signal(signal.SIGALRM, end_with_parent)
    signal.setitimer(signal.ITIMER_REAL, PARENT_SECONDS, PARENT_SECONDS)
    while True:
        connection.send(work(connection.recv()))
