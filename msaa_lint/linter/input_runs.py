"""What the inputs of a run add to its result, in their order: kept from an earlier run or linted,
by several processes if there is enough to do.
"""

from __future__ import annotations

from collections.abc import Callable, Generator, Iterator, Mapping, Sequence
from itertools import accumulate
from operator import add
from typing import Generic, NamedTuple, Protocol, TypeVar

from msaa_lint.core.execution.backend import Backend, Failure
from msaa_lint.core.spool import SpooledDict
from msaa_lint.core.urls import is_url
from msaa_lint.input.file_types import STDIN

from .source_programs import ProgramInput
from .workspace import Unit, Workspace

Part = TypeVar("Part")

MIN_DIVIDED = 300_000
"""The number of bytes of inputs from which on they are divided among processes, unless a number of
processes is asked for: starting these takes as long as reading less.
"""

MIN_DIVIDED_ANEW = 1_000_000
"""The same where processes cannot be copies of this one, but start anew: this takes a quarter of a
second.
"""

URL_BYTES = 10_000
"""The number of bytes that take as long to lint as a storage takes to answer."""

MIN_KEPT = 20_000
"""The number of bytes of inputs from which on their parts are kept: linting fewer takes as little
time as looking them up.
"""

MAX_UNITS = 64
"""The number of inputs of a task: a process takes longer to begin a task than to lint some small
inputs.
"""

MAX_BYTES = 2 << 20
"""The number of bytes of the inputs of a task, unless it has only one: they take some tenths of a
second.
"""

MIN_TASKS = 8
"""The number of tasks for each worker, if there are enough inputs, so that all workers end
together.
"""

MAX_WAITING = 100
"""The number of parts in memory that wait for those of inputs before theirs."""

MAX_LOOKED_UP = 64
"""The number of inputs of which is looked up together what is known of them."""

MAX_PROCESSES = 8
"""The number of processes on this machine, unless one is asked for: each takes memory of its
own.
"""


class Numbered(NamedTuple):
    """An input or a program, by its number in the run, and the project that an input must be in."""

    number: int
    unit: Unit
    project: str | None = None


class Task(NamedTuple):
    """What a process lints before it returns what it found: units with the same configuration,
    which is named by its path.
    """

    units: Sequence[Numbered]
    configuration: str | None


class Linter(Protocol[Part]):
    """What reads the inputs of a workspace one by one: `Part` is what an input adds to the result
    of the run.
    """

    workspace: Workspace

    def part(self, unit: Unit) -> Part:
        """What an input or a program adds."""
        ...

    def known(self, units: Sequence[Unit]) -> Mapping[int, Part]:
        """What is known from an earlier run, by the numbers of the inputs and programs among
        these.
        """
        ...

    def included(self, part: Part) -> bool:
        """Counts what custom rules took for a part in another process or run; False if that may be
        more than they have left in this one.
        """
        ...

    def failed(self, unit: Unit, reason: str) -> Part:
        """What an input or a program adds that could not be read."""
        ...

    def travelling(self) -> Callable[[Workspace], Linter[Part]]:
        """Creates such a linter in another process, for the workspace there."""
        ...


class InputRuns(Generic[Part]):
    """What the inputs and programs of a run add to its result."""

    def __init__(
        self, linter: Linter[Part], units: Sequence[Unit], per_task: int = MAX_UNITS
    ) -> None:
        self.linter = linter
        self._per_task = per_task
        self._workspace = linter.workspace
        self._units = units

    def in_this_process(self) -> Generator[Part]:
        """Yields the parts."""
        for start in range(0, len(self._units), MAX_LOOKED_UP):
            units = self._units[start : start + MAX_LOOKED_UP]
            known = self.linter.known(units)
            for number, unit in enumerate(units):
                yield self._part(unit, known.get(number))

    def divided(self, backend: Backend, job: Callable[[Task], list[Part]]) -> Generator[Part]:
        """Yields the parts, which `backend` determines by `job`. They are what one process would
        say.
        """
        for unit in self._units:
            # Here, what the rules of a configuration take is counted once.
            self._configuration(unit)
        known = _Known(self.linter, self._units)
        waiting = known.parts
        results = backend.results(
            job, self._with_rules(self._tasks(known, backend.workers)), list_of_each
        )
        try:
            for number, unit in enumerate(self._units):
                if unit == STDIN:
                    yield self.linter.part(unit)
                    continue
                known.look_up(number)
                while str(number) not in waiting:
                    task, found = next(results)
                    parts = (
                        [self.linter.failed(each.unit, found.reason) for each in task.units]
                        if isinstance(found, Failure)
                        else found
                    )
                    waiting.update(
                        {
                            str(each.number): part
                            for each, part in zip(task.units, parts, strict=True)
                        }
                    )
                yield self._part(unit, waiting.pop(str(number)))
        finally:
            results.close()  # type: ignore[attr-defined]
            backend.close()

    def parts_of(self, task: Task) -> list[Part]:
        """What the units of a task add to the result."""
        parts = []
        self._workspace.use(task.configuration)
        self._workspace.enter(
            {
                each.unit: each.project
                for each in task.units
                if isinstance(each.unit, str) and each.project is not None
            }
        )
        known = self.linter.known([each.unit for each in task.units])
        for number, (_, unit, _) in enumerate(task.units):
            self._workspace.forget_spent()
            parts.append(self._part(unit, known.get(number)))
        self._workspace.flush()
        return parts

    def _part(self, unit: Unit, known: Part | None) -> Part:
        """What a unit adds, which may be known, if custom rules may take what they took for it."""
        return (
            known if known is not None and self.linter.included(known) else self.linter.part(unit)
        )

    def _configuration(self, unit: Unit) -> str | None:
        return self._workspace.resolve(
            unit if isinstance(unit, str) else unit.inputs[0]
        ).configuration

    def _with_rules(self, tasks: Iterator[Task]) -> Iterator[Task]:
        """Loads the rules before the first task: copies of this process then have them."""
        for task in tasks:
            _ = self._workspace.current.engine.linter
            yield task

    def _tasks(self, known: _Known[Part], workers: int) -> Iterator[Task]:
        """The units of which nothing is known, in groups: long programs first, so that all
        processes end together, then inputs in their order.
        """
        programs = [
            Numbered(number, unit)
            for number, unit in enumerate(self._units)
            if isinstance(unit, ProgramInput)
        ]
        unknown = (each for each in programs if not known.is_known(each.number))
        for each in sorted(unknown, key=lambda each: -self._workspace.length(each.unit)):
            yield Task((each,), self._configuration(each.unit))
        per_task = max(min(self._per_task, len(self._units) // (MIN_TASKS * max(workers, 1))), 1)
        group: list[Numbered] = []
        length, common = 0, None
        for number, unit in enumerate(self._units):
            if isinstance(unit, ProgramInput) or unit == STDIN or known.is_known(number):
                continue
            size, configuration = self._workspace.length(unit), self._configuration(unit)
            if group and (
                len(group) == per_task or length + size > MAX_BYTES or configuration != common
            ):
                yield Task(group, common)
                group, length = [], 0
            group.append(Numbered(number, unit, self._workspace.project(unit)))
            length, common = length + size, configuration
        if group:
            yield Task(group, common)


class _Known(Generic[Part]):
    """What is known of units, which is looked up in their order; `parts` has it, by their
    numbers.
    """

    def __init__(self, linter: Linter[Part], units: Sequence[Unit]) -> None:
        self.parts: SpooledDict[Part] = SpooledDict(linter.workspace.spool, MAX_WAITING)
        self._linter = linter
        self._units = units
        self._looked_up = 0
        self._is_known = bytearray(len(units))

    def is_known(self, number: int) -> bool:
        """Whether a unit need not be read."""
        self.look_up(number)
        return bool(self._is_known[number])

    def look_up(self, number: int) -> None:
        """Looks up what is known of the units up to this one."""
        while self._looked_up <= number:
            units = self._units[self._looked_up : self._looked_up + MAX_LOOKED_UP]
            for number, part in self._linter.known(units).items():
                self.parts.update({str(self._looked_up + number): part})
                self._is_known[self._looked_up + number] = True
            self._looked_up += len(units)


def list_of_each(task: Task) -> list[Task]:
    """The units of a task, each of them a task."""
    return [task._replace(units=(each,)) for each in task.units]


def is_worth_keeping(workspace: Workspace, units: Sequence[Unit]) -> bool:
    """Whether keeping what units add takes less time than it may save."""
    return any(not isinstance(unit, str) for unit in units) or _reach(workspace, units, MIN_KEPT)


def _reach(workspace: Workspace, units: Sequence[Unit], length: int) -> bool:
    """Whether units take as long as linting so many bytes."""
    waits = (URL_BYTES if isinstance(unit, str) and is_url(unit) else 0 for unit in units)
    return any(
        total >= length for total in accumulate(map(add, map(workspace.length, units), waits))
    )


def processes(workspace: Workspace, units: Sequence[Unit], jobs: int | None) -> int:
    """The number of processes for units, if `jobs` are asked for; None asks for as many as there
    are cores, if there is enough to do.
    """
    if len(units) < 2 or jobs == 1:
        return 1
    if jobs is not None:
        return jobs
    from msaa_lint.core.execution.processes import can_copy, cores

    count = min(cores(), MAX_PROCESSES)
    return (
        count
        if count > 1 and _reach(workspace, units, MIN_DIVIDED if can_copy() else MIN_DIVIDED_ANEW)
        else 1
    )
