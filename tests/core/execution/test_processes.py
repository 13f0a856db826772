"""Tasks that are divided among processes of this machine."""

from __future__ import annotations

import contextlib
import multiprocessing
import os
import signal
import subprocess
import sys
import threading
from collections.abc import Iterator

import pytest

from msaa_lint.core.execution import processes as module
from msaa_lint.core.execution.backend import Failure
from msaa_lint.core.execution.processes import Processes, can_copy

from . import work

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="processes are ended by signals")


@pytest.fixture(params=["copies", "started anew"])
def processes(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> Iterator[Processes]:
    """Two processes: a process with threads is not copied."""
    if request.param == "copies":
        # Threads that other tests left are idle.
        monkeypatch.setattr(module, "can_copy", lambda: True)
        yield Processes(2)
        return
    end = threading.Event()
    thread = threading.Thread(target=end.wait)
    thread.start()
    assert not can_copy()
    yield Processes(2)
    end.set()
    thread.join()


def test_each_task_is_done_once_by_another_process(processes: Processes) -> None:
    found = list(processes.results(work.with_process, [(number,) for number in range(20)], work.split))
    assert sorted(task for task, _ in found) == [(number,) for number in range(20)]
    ids = {result[0] for _, result in found if not isinstance(result, Failure)}
    assert len(ids) == 2 and os.getpid() not in ids
    assert multiprocessing.active_children() == []


def test_tasks_are_taken_when_there_is_room(processes: Processes) -> None:
    taken = 0

    def tasks() -> Iterator[work.Chunk]:
        nonlocal taken
        while True:
            taken += 1
            yield (taken,)

    results = processes.results(work.squares, tasks(), work.split)
    assert [len(next(results)) for _ in range(50)] == [2] * 50
    assert taken < 60
    results.close()  # type: ignore[attr-defined]
    assert multiprocessing.active_children() == []


def test_a_task_that_ends_processes_fails_alone(processes: Processes) -> None:
    """The others of its group are done; an exception fails the whole task."""
    tasks = [(10, 11), (12, 13, 14), (7, 8), (13,), (15,)]
    found = dict(processes.results(work.poisonous, tasks, work.split))
    ended = Failure("it ended the process that read it (SIGKILL): memory probably ran out; use fewer `--jobs` or more memory")
    assert found == {(10, 11): [100, 121], (12,): [144], (13,): ended, (14,): [196], (7, 8): Failure("ValueError: it is 7"), (15,): [225]}


def test_a_task_that_fills_the_pipe_waits_for_its_turn(processes: Processes) -> None:
    tasks = [tuple(range(number, number + 100_000)) for number in range(6)]
    found = dict(processes.results(work.squares, tasks, work.split))
    assert all(found[task] == work.squares(task) for task in tasks) and len(found) == 6


def test_killed_processes_lose_no_result() -> None:
    """One is killed after every twentieth result: a task that was lost then is done before the next one is killed."""
    found: dict[work.Chunk, int] = {}
    for task, result in Processes(3).results(work.with_process, [(number,) for number in range(300)], work.split):
        assert task not in found and not isinstance(result, Failure)
        found[task] = result[0]
        if len(found) % 20 == 0:
            # The process that has just done a task, and may have begun the next one.
            with contextlib.suppress(ProcessLookupError):
                os.kill(result[0], signal.SIGKILL)
    assert len(found) == 300 and len(set(found.values())) > 10


@pytest.mark.parametrize("sent", [signal.SIGKILL, signal.SIGTERM])
def test_processes_end_soon_after_the_one_that_they_work_for(sent: int) -> None:
    """They hold its standard output, which `communicate` reads to the end."""
    code = """if True:
        from msaa_lint.core.execution.processes import Processes
        from tests.core.execution.work import sleep, split
        def tasks():
            yield (1,)
            yield (2,)
            print("started", flush=True)
            yield (3,)
        list(Processes(3).results(sleep, tasks(), split))
    """
    process = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE)
    assert process.stdout is not None
    process.stdout.readline()
    process.send_signal(sent)
    process.communicate(timeout=60)
