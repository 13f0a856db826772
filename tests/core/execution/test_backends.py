"""What all backends have in common: processes of this machine, copied or started anew, and
clusters.
"""

from __future__ import annotations

import contextlib
import functools
import os
import signal
import sys
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import pytest

from msaa_lint.core.execution.backend import Backend, Failure
from msaa_lint.core.execution.dask_cluster import MAX_AHEAD

from . import work

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="processes are ended by signals")


def test_each_task_is_done_once_by_another_process(backend: Backend) -> None:
    found = list(backend.results(work.with_process, work.numbers(40), work.split))
    assert sorted(task for task, _ in found) == work.numbers(40)
    ids = {result[0] for _, result in found if not isinstance(result, Failure)}
    assert backend.workers == 2 and len(ids) == 2 and os.getpid() not in ids


def test_tasks_are_taken_when_there_is_room(backend: Backend) -> None:
    taken = 0

    def tasks() -> Iterator[work.Chunk]:
        nonlocal taken
        while True:
            taken += 1
            yield (taken,)

    results = backend.results(work.squares, tasks(), work.split)
    assert [len(next(results)) for _ in range(50)] == [2] * 50
    assert taken <= 50 + 2 * (MAX_AHEAD + 1)
    results.close()  # type: ignore[attr-defined]
    assert len(list(backend.results(work.squares, work.numbers(5), work.split))) == 5


def test_a_task_that_ends_processes_fails_alone(backend: Backend) -> None:
    """The others of its group are done, and those that its worker had; an exception fails the whole
    task.
    """
    tasks = [(10, 11), (12, 13, 14), (7, 8), (13,), *((number,) for number in range(15, 25))]
    found = dict(backend.results(work.poisonous, tasks, work.split))
    ended = found.pop((13,))
    assert isinstance(ended, Failure) and ended.reason.startswith(
        ("it ended the process that read it (SIGKILL): ", "it ended the workers")
    )
    squares = {(number,): [number * number] for number in (12, 14, *range(15, 25))}
    assert found == {(10, 11): [100, 121], (7, 8): Failure("ValueError: it is 7"), **squares}


def test_killed_workers_lose_no_result(backend: Backend, tmp_path: Path) -> None:
    """What a worker had is repeated, and nothing else; no result comes twice."""
    found: dict[work.Chunk, int] = {}
    kills = 0
    for task, result in backend.results(
        functools.partial(work.recorded, str(tmp_path)), work.numbers(120), work.split
    ):
        assert task not in found and not isinstance(result, Failure)
        found[task] = result
        if len(found) % 30 == 0:
            # The process that has just done a task, and may have begun the next one.
            with contextlib.suppress(ProcessLookupError):
                os.kill(result, signal.SIGKILL)
                kills += 1
    assert len(found) == 120 and kills > 2
    done = Counter((tmp_path / "done").read_text().split())
    assert len(done) == 120 and max(done.values()) <= 2
    assert done.total() <= 120 + kills * (MAX_AHEAD + 1)
