"""What the inputs of a run add to its result, in their order: kept from an earlier run or linted, by several processes if there is enough
to do."""

from __future__ import annotations

from collections.abc import Callable, Container, Iterator, Sequence
from itertools import accumulate
from typing import TYPE_CHECKING, NamedTuple

from msaa_lint.core.diagnostics import diagnostic
from msaa_lint.core.execution.backend import Backend, Failure
from msaa_lint.input.file_types import STDIN

from .part_linter import PartLinter, Unit
from .run_part import RunPart
from .source_programs import ProgramInput
from .workspace import Workspace

if TYPE_CHECKING:
    from .kept_parts import KeptParts

MIN_DIVIDED = 300_000
"""The number of bytes of inputs from which on they are divided among processes, unless a number of processes is asked for: starting these
takes as long as reading less."""

MIN_KEPT = 20_000
"""The number of bytes of inputs from which on their parts are kept: linting fewer takes as little time as looking them up."""

MAX_UNITS = 32
"""The number of inputs of a task: a process takes longer to begin a task than to lint some small inputs."""

MAX_BYTES = 64 << 10
"""The number of bytes of the inputs of a task, unless it has only one."""

MAX_PROCESSES = 8
"""The number of processes on this machine, unless one is asked for: each takes memory of its own."""


class Numbered(NamedTuple):
    """An input or a program, by its number in the run, and the project that an input must be in."""

    number: int
    unit: Unit
    project: str | None = None


class Task(NamedTuple):
    """What a process lints before it returns what it found: units with the same configuration, which is named by its path."""

    units: Sequence[Numbered]
    configuration: str | None


class InputRuns:
    """The parts of the units of a run. `depends_on` is what parts depend on besides files and settings, None if they are not kept."""

    def __init__(self, linter: PartLinter, units: Sequence[Unit], depends_on: str | None) -> None:
        self.linter = linter
        self.depends_on = depends_on
        self._workspace = linter.workspace
        self._units = units
        self._kept: KeptParts | None = None
        if depends_on is not None and workspace_keeps(self._workspace, units) and (cache := self._workspace.cache) is not None:
            from .kept_parts import KeptParts

            self._kept = KeptParts(linter, cache, depends_on)

    def in_this_process(self) -> Iterator[RunPart]:
        """Yields the parts."""
        return map(self._part, self._units)

    def divided(self, backend: Backend, job: Callable[[Task], list[RunPart]]) -> Iterator[RunPart]:
        """Yields the parts, which `backend` determines by `job`. They are what one process would say."""
        kept = {number: part for number, unit in enumerate(self._units) if isinstance(unit, ProgramInput) and (part := self._found(unit))}
        for unit in self._units:
            # Here, what the rules of a configuration take is counted once.
            self._configuration(unit)
        results = backend.results(job, self._tasks(kept), list_of_each)
        waiting: dict[int, RunPart] = dict(kept)
        try:
            for number, unit in enumerate(self._units):
                while number not in waiting and unit != STDIN:
                    task, found = next(results)
                    if isinstance(found, Failure):
                        waiting.update((each.number, self._failed(each.unit, found)) for each in task.units)
                    else:
                        waiting.update(zip((each.number for each in task.units), found, strict=True))
                part = waiting.pop(number, None)
                # What custom rules have taken elsewhere counts as if it had been taken here; what may be too much is done here.
                yield part if part is not None and (number in kept or self._workspace.include(part.spent)) else self.linter.part(unit)
        finally:
            results.close()  # type: ignore[attr-defined]
            backend.close()

    def _part(self, unit: Unit) -> RunPart:
        if self._kept is None:
            return self.linter.part(unit)
        return self._found(unit) or self._kept.part(unit)

    def _found(self, unit: Unit) -> RunPart | None:
        """What is kept of a unit, if custom rules may take that much."""
        part = self._kept.find(unit) if self._kept is not None else None
        return part if part is not None and self._workspace.include(part.spent) else None

    def parts_of(self, task: Task) -> list[RunPart]:
        """What the units of a task add to the result."""
        parts = []
        self._workspace.use(task.configuration)
        for _, unit, project in task.units:
            if isinstance(unit, str):
                self._workspace.enter(unit, project)
            self._workspace.forget_spent()
            parts.append(self._part(unit))
        return parts

    def _configuration(self, unit: Unit) -> str | None:
        return self._workspace.resolve(unit if isinstance(unit, str) else unit.inputs[0]).configuration

    def _tasks(self, done: Container[int]) -> Iterator[Task]:
        """The units in groups: long programs first, so that all processes end together, then inputs in their order."""
        programs = [
            Numbered(number, unit) for number, unit in enumerate(self._units) if isinstance(unit, ProgramInput) and number not in done
        ]
        for each in sorted(programs, key=lambda each: -self._workspace.length(each.unit)):
            yield Task((each,), self._configuration(each.unit))
        group: list[Numbered] = []
        length, common = 0, None
        for number, unit in enumerate(self._units):
            if isinstance(unit, ProgramInput) or unit == STDIN:
                continue
            size, configuration = self._workspace.length(unit), self._configuration(unit)
            if group and (len(group) == MAX_UNITS or length + size > MAX_BYTES or configuration != common):
                yield Task(group, common)
                group, length = [], 0
            group.append(Numbered(number, unit, self._workspace.project(unit)))
            length, common = length + size, configuration
        if group:
            yield Task(group, common)

    def _failed(self, unit: Unit, failure: Failure) -> RunPart:
        path = unit if isinstance(unit, str) else unit.inputs[0]
        return RunPart(problems=[diagnostic("MSAA941", f"not linted: {failure.reason}", self.linter.request.input_name(path))])


def list_of_each(task: Task) -> list[Task]:
    """The units of a task, each of them a task."""
    return [task._replace(units=(each,)) for each in task.units]


def workspace_keeps(workspace: Workspace, units: Sequence[Unit]) -> bool:
    """Whether the parts of units are kept."""
    return workspace.request.cache and (_reach(workspace, units, MIN_KEPT) or any(not isinstance(unit, str) for unit in units))


def _reach(workspace: Workspace, units: Sequence[Unit], length: int) -> bool:
    """Whether units have as many bytes."""
    return any(total >= length for total in accumulate(map(workspace.length, units)))


def processes(workspace: Workspace, units: Sequence[Unit], jobs: int | None) -> int:
    """The number of processes for units, if `jobs` are asked for; None asks for as many as there are cores, if there is enough to do."""
    if len(units) < 2 or jobs == 1:
        return 1
    if jobs is not None:
        return jobs
    from msaa_lint.core.execution.processes import can_copy, cores

    count = min(cores(), MAX_PROCESSES)
    if count == 1 or not can_copy():
        return 1
    return count if _reach(workspace, units, MIN_DIVIDED) else 1
