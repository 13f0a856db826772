"""Tasks on the cores of this machine.

Where the system can, the processes are copies of this one, which know what it knows; elsewhere they
import the package again, and `work` is pickled.
"""

from __future__ import annotations

import os
import pickle
import signal
import sys
import threading
from collections import deque
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING, Any, Generic

from msaa_lint.core.garbage import collect_garbage, not_collecting
from msaa_lint.core.parent_process import end_with_parent

from .backend import Failure, Result, Split, Task, Waiting, Work, attempt
from .starting import interrupts_held

if TYPE_CHECKING:
    from multiprocessing.connection import Connection
    from multiprocessing.process import BaseProcess

PARENT_SECONDS = 0.5
"""How often a process looks whether the one that it works for has ended, where the system does not
tell it.
"""

MAX_AHEAD_BYTES = 16_384
"""The size of a pickled task up to which a process gets it while it does another one: with more,
both ends of a full pipe might wait for each other.
"""


THREADS = (
    "OMP_NUM_THREADS",
    "OPENBLAS_NUM_THREADS",
    "MKL_NUM_THREADS",
    "BLIS_NUM_THREADS",
    "VECLIB_MAXIMUM_THREADS",
)
"""What libraries of linear algebra take their number of threads from."""


def cores() -> int:
    """The number of cores that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def can_copy() -> bool:
    """Whether this process can be copied: it has no other threads, nor may have on macOS, whose
    libraries start some.
    """
    return sys.platform != "darwin" and hasattr(os, "fork") and threading.active_count() == 1


class Processes:
    """As many processes as there are workers. They end with the iterator of results, and with this
    process.
    """

    def __init__(self, workers: int) -> None:
        self.workers = workers

    def results(
        self, work: Work[Task, Result], tasks: Iterable[Task], split: Split[Task]
    ) -> Iterator[tuple[Task, Result | Failure]]:
        """Yields tasks with their results as they finish, as `Backend` says."""
        from multiprocessing.connection import wait

        waiting = Waiting(tasks, split)
        running: dict[Any, _Process[Task, Result]] = {}
        try:
            while True:
                while len(running) < self.workers and (first := waiting.next()) is not None:
                    process: _Process[Task, Result] = _Process(work)
                    running[process.connection] = process
                    process.send(*first)
                if not running:
                    return
                for connection in wait(list(running)):
                    process = running[connection]
                    try:
                        result = process.receive()
                    except (EOFError, OSError):
                        del running[connection]
                        yield from process.died(waiting)
                        continue
                    task, _ = process.doing.popleft()
                    self._fill(process, waiting)
                    if not process.doing:
                        del running[connection]
                        process.end()
                    yield task, result
        finally:
            for process in running.values():
                process.end()

    def _fill(self, process: _Process[Task, Result], waiting: Waiting[Task]) -> None:
        """Gives a process the next task, and another one to do after it."""
        while len(process.doing) < 2 and (task := waiting.next()) is not None:
            if not process.send(*task):
                waiting.repeat(*task)
                return

    def close(self) -> None:
        """Does nothing: the processes end with the results."""


class _Process(Generic[Task, Result]):
    """A process, and the tasks that it has, the first of which it does."""

    def __init__(self, work: Work[Task, Result]) -> None:
        from multiprocessing import get_context

        context: Any = get_context("fork" if can_copy() else "spawn")
        self.doing: deque[tuple[Task, int]] = deque()
        self.connection: Connection[Any, Any]
        self.connection, other = context.Pipe()
        self._process: BaseProcess = context.Process(
            target=_serve, args=(other, work, os.getpid()), daemon=True
        )
        with interrupts_held(), _few_threads():
            self._process.start()
        other.close()

    def send(self, task: Task, deaths: int) -> bool:
        """Gives the process a task; False if the process does another one, and the task is too
        large to wait in the pipe.
        """
        data = pickle.dumps(task)
        if self.doing and len(data) > MAX_AHEAD_BYTES:
            return False
        # That it has ended is found when it is received from.
        with suppress(OSError):
            self.connection.send_bytes(data)
        self.doing.append((task, deaths))
        return True

    def receive(self) -> Result | Failure:
        """The result of the first task. Raises EOFError or OSError if the process has ended."""
        result: Result | Failure = self.connection.recv()
        return result

    def died(self, waiting: Waiting[Task]) -> Iterator[tuple[Task, Failure]]:
        """Lets the tasks be repeated; yields the first one if it has ended too many processes."""
        self._process.join()
        (task, deaths), *others = self.doing
        for other in others:
            waiting.repeat(*other)
        if not waiting.died(task, deaths):
            yield task, Failure(_ended(self._process.exitcode))
        self.connection.close()

    def end(self) -> None:
        """Ends the process."""
        self._process.kill()
        self._process.join()
        self.connection.close()


@contextmanager
def _few_threads() -> Iterator[None]:
    """Lets the processes that start, and do not know NumPy yet, compute with one thread each,
    unless the user wants more: there are as many processes as cores.
    """
    stated = [name for name in THREADS if name not in os.environ]
    os.environ.update(dict.fromkeys(stated, "1"))
    try:
        yield
    finally:
        for name in stated:
            del os.environ[name]


def _ended(code: int | None) -> str:
    """Why a task failed that ended its processes, and what to do."""
    reason = _reason(code)
    # The system kills processes when it runs out of memory.
    advice = (
        "memory probably ran out; use fewer `--jobs` or more memory"
        if reason == "SIGKILL"
        else "please report it with the input"
    )
    return f"it ended the process that read it ({reason}): {advice}"


def _reason(code: int | None) -> str:
    if code is not None and code < 0:
        try:
            return signal.Signals(-code).name
        except ValueError:
            return f"signal {-code}"
    return f"exit code {code}"


def _serve(connection: Connection[Any, Any], work: Work[Any, Any], parent: int) -> None:
    """Does tasks, in another process, until its parent ends it, or has itself ended."""
    # Interrupts are for the parent process, which ends this one.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    for name in ("SIGTERM", "SIGHUP", "SIGQUIT"):
        if hasattr(signal, name):
            signal.signal(getattr(signal, name), signal.SIG_DFL)
    end_with_parent(parent)
    if sys.platform != "linux" and hasattr(signal, "setitimer"):

        def look(*_: object) -> None:
            if os.getppid() != parent:
                os._exit(1)

        signal.signal(signal.SIGALRM, look)
        signal.setitimer(signal.ITIMER_REAL, PARENT_SECONDS, PARENT_SECONDS)
    while True:
        try:
            task = pickle.loads(connection.recv_bytes())
        except EOFError:
            return
        with not_collecting():
            connection.send(attempt(work, task))
            collect_garbage()
