"""Tasks that are divided among processes of this machine."""

from __future__ import annotations

import multiprocessing
import signal
import subprocess
import sys

import pytest

from msaa_lint.core.execution.backend import Backend

from . import work

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="processes are ended by signals")


def test_processes_end_with_the_results(processes: Backend) -> None:
    # Those of a cluster that other tests have started may end meanwhile.
    others = set(multiprocessing.active_children())
    assert len(list(processes.results(work.squares, work.numbers(20), work.split))) == 20
    assert others.issuperset(multiprocessing.active_children())
    results = processes.results(work.squares, work.numbers(20), work.split)
    next(results)
    assert len(set(multiprocessing.active_children()) - others) == 2
    results.close()  # type: ignore[attr-defined]
    assert others.issuperset(multiprocessing.active_children())


def test_a_task_that_fills_the_pipe_waits_for_its_turn(processes: Backend) -> None:
    tasks = [tuple(range(number, number + 100_000)) for number in range(6)]
    found = dict(processes.results(work.squares, tasks, work.split))
    assert all(found[task] == work.squares(task) for task in tasks) and len(found) == 6


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
