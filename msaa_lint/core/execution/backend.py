"""What does tasks: processes of this machine, or the workers of a cluster. Each yields the results
of tasks as they finish.

A task is repeated if the process that does it ends, so it must be safe to repeat.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Generic, NamedTuple, Protocol, TypeVar

Task = TypeVar("Task")
Result = TypeVar("Result")

MAX_DEATHS = 2
"""The number of processes that a task may end before it counts as failed."""

ENDED_WORKERS = (
    "it ended the workers that read it: give them more memory; if that does not help, "
    "please report it with the input"
)
"""Why a task failed that ended so many workers of a cluster, and what to do: the same with every
cluster, which do not say how they ended.
"""

Work = Callable[[Task], Result]
"""What is done with a task. It travels to other processes, as tasks and results do."""

Split = Callable[[Task], Sequence[Task]]
"""Returns the parts of a task that can be done one by one, to find the one that ends processes; a
single one if it has none.
"""


class Failure(NamedTuple):
    """Why a task has no result: `work` raised an exception, or the processes that did the task
    ended.
    """

    reason: str


class Unusable(Exception):
    """Nothing can do the tasks; the message says why, and what to do."""


class Backend(Protocol):
    """What does tasks, `workers` at the same time."""

    workers: int

    def results(
        self, work: Work[Task, Result], tasks: Iterable[Task], split: Split[Task]
    ) -> Iterator[tuple[Task, Result | Failure]]:
        """Yields tasks with their results as they finish.

        Tasks are taken from the iterable when there is room for them, so that it may have any
        length. Closing the iterator ends the tasks. Raises Unusable if no worker is left.
        """
        ...

    def close(self) -> None:
        """Ends what this object started."""
        ...


class Waiting(Generic[Task]):
    """The tasks that are not being done: new ones, and before them those to repeat. `deaths` are
    the processes that a task has ended.
    """

    def __init__(self, tasks: Iterable[Task], split: Split[Task]) -> None:
        self._new = iter(tasks)
        self._split = split
        self._again: deque[tuple[Task, int]] = deque()

    @property
    def has_repeated(self) -> bool:
        """Whether the next task was begun before, as a whole or as part of another one."""
        return bool(self._again)

    def next(self) -> tuple[Task, int] | None:
        """The next task, and the processes that it has ended; None if there is none."""
        if self._again:
            return self._again.popleft()
        for task in self._new:
            return task, 0
        return None

    def repeat(self, task: Task, deaths: int) -> None:
        """Adds a task whose process ended while it did another one."""
        self._again.append((task, deaths))

    def died(self, task: Task, deaths: int) -> bool:
        """Adds a task whose process ended while it did the task, or the parts of it; False if it
        has ended too many.
        """
        parts = self._split(task)
        if len(parts) > 1:
            self._again.extend((part, 0) for part in parts)
            return True
        if deaths + 1 < MAX_DEATHS:
            self._again.append((task, deaths + 1))
            return True
        return False


def attempt(work: Work[Task, Result], task: Task) -> Result | Failure:
    """The result of a task, or the exception that it raised."""
    try:
        return work(task)
    except Unusable as error:
        return Failure(str(error))
    except Exception as error:
        return Failure(
            f"{type(error).__name__}: {str(error)[:300]}" if str(error) else type(error).__name__
        )
