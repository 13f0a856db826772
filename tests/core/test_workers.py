"""Tasks that are divided among processes."""

from __future__ import annotations

import multiprocessing
import os
import signal
import subprocess
import sys
import threading

import pytest

from msaa_lint.core.workers import Workers, processes

pytestmark = pytest.mark.skipif(not hasattr(os, "fork"), reason="processes are copies of this one")


def test_each_task_is_done_once_by_another_process() -> None:
    workers = Workers(lambda task: (task * task, os.getpid()), range(20), 3)
    try:
        results = [workers.result(task) for task in range(20)]
    finally:
        workers.close()
    assert [square for square, _ in results] == [task * task for task in range(20)]
    assert len({process for _, process in results} - {os.getpid()}) == len({process for _, process in results}) <= 3


def test_results_may_be_asked_for_in_another_order() -> None:
    workers = Workers(str, range(9), 2)
    assert [workers.result(task) for task in reversed(range(9))] == list("876543210")
    workers.close()


@pytest.mark.parametrize("count", [1, 2])
def test_this_process_does_what_others_do_not_return(count: int) -> None:
    here = os.getpid()

    def work(task: int) -> int:
        if os.getpid() != here and task % 3 == 1:
            os.kill(os.getpid(), signal.SIGKILL)
        return task

    workers = Workers(work, range(7), count)
    assert [workers.result(task) for task in range(7)] == list(range(7))
    workers.close()


def test_processes_end_while_they_work() -> None:
    others = {*multiprocessing.active_children()}
    workers = Workers(lambda task: threading.Event().wait(600), range(4), 2)
    started = {*multiprocessing.active_children()} - others
    workers.close()
    assert len(started) == 2 and not started & {*multiprocessing.active_children()}


def test_a_process_with_threads_is_not_copied() -> None:
    end = threading.Event()
    thread = threading.Thread(target=end.wait)
    thread.start()
    assert processes() == 1
    end.set()
    thread.join()


@pytest.mark.parametrize("sent", [signal.SIGKILL, signal.SIGTERM])
def test_processes_end_soon_after_the_one_that_they_work_for(sent: int) -> None:
    """They hold its standard output, which `communicate` reads to the end."""
    code = """if True:
        import time
        from msaa_lint.core.workers import Workers
        workers = Workers(lambda task: time.sleep(600), range(4), 2)
        print("started", flush=True)
        workers.result(0)
    """
    process = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE)
    assert process.stdout is not None
    process.stdout.readline()
    process.send_signal(sent)
    process.communicate(timeout=60)
