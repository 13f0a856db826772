"""What the inputs of a run add to its result, in their order: kept from an earlier run or linted, by several processes if there is enough
to do."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
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
    """An input or a program, by its number in the run."""

    number: int
    unit: Unit


Task = tuple[Numbered, ...]
"""What a process lints before it returns what it found."""


class InputRuns:
    """The parts of the units of a run. `depends_on` is what parts depend on besides files and settings, None if they are not kept."""

    def __init__(self, linter: PartLinter, units: Sequence[Unit], depends_on: str | None) -> None:
        self._linter = linter
        self._workspace = linter.workspace
        self._units = units
        self._kept: KeptParts | None = None
        if depends_on is not None and workspace_keeps(self._workspace, units) and (cache := self._workspace.cache) is not None:
            from .kept_parts import KeptParts

            self._kept = KeptParts(linter, cache, depends_on)

    def in_this_process(self) -> Iterator[RunPart]:
        """Yields the parts."""
        return map(self._part, self._units)

    def divided(self, backend: Backend) -> Iterator[RunPart]:
        """Yields the parts, which `backend` determines. They are what one process would say."""
        kept = {number: part for number, unit in enumerate(self._units) if isinstance(unit, ProgramInput) and (part := self._found(unit))}
        for unit in self._units:
            # Here, what the rules of a configuration take is counted once.
            self._workspace.resolve(unit if isinstance(unit, str) else unit.inputs[0])
        results = backend.results(self._parts, self._tasks(kept), list_of_each)
        waiting: dict[int, RunPart] = dict(kept)
        try:
            for number, unit in enumerate(self._units):
                while number not in waiting and unit != STDIN:
                    task, found = next(results)
                    if isinstance(found, Failure):
                        waiting.update((each.number, self._failed(each.unit, found)) for each in task)
                    else:
                        waiting.update(zip((each.number for each in task), found, strict=True))
                part = waiting.pop(number, None)
                # What custom rules have taken elsewhere counts as if it had been taken here; what may be too much is done here.
                yield part if part is not None and (number in kept or self._workspace.include(part.spent)) else self._linter.part(unit)
        finally:
            results.close()  # type: ignore[attr-defined]
            backend.close()

    def _part(self, unit: Unit) -> RunPart:
        if self._kept is None:
            return self._linter.part(unit)
        return self._found(unit) or self._kept.part(unit)

    def _found(self, unit: Unit) -> RunPart | None:
        """What is kept of a unit, if custom rules may take that much."""
        part = self._kept.find(unit) if self._kept is not None else None
        return part if part is not None and self._workspace.include(part.spent) else None

    def _parts(self, task: Task) -> list[RunPart]:
        """The parts of a task, in another process."""
        parts = []
        for _, unit in task:
            self._workspace.forget_spent()
            parts.append(self._part(unit))
        return parts

    def _tasks(self, done: dict[int, RunPart]) -> Iterator[Task]:
        """The units in groups: long programs first, so that all processes end together, then inputs in their order."""
        programs = [
            Numbered(number, unit) for number, unit in enumerate(self._units) if isinstance(unit, ProgramInput) and number not in done
        ]
        for each in sorted(programs, key=lambda each: -self._workspace.length(each.unit)):
            yield (each,)
        group: list[Numbered] = []
        length = 0
        for number, unit in enumerate(self._units):
            if isinstance(unit, ProgramInput) or unit == STDIN:
                continue
            size = self._workspace.length(unit)
            if group and (len(group) == MAX_UNITS or length + size > MAX_BYTES):
                yield tuple(group)
                group, length = [], 0
            group.append(Numbered(number, unit))
            length += size
        if group:
            yield tuple(group)

    def _failed(self, unit: Unit, failure: Failure) -> RunPart:
        path = unit if isinstance(unit, str) else unit.inputs[0]
        return RunPart(problems=[diagnostic("MSAA941", f"internal error: {failure.reason}", self._linter.request.input_name(path))])


def list_of_each(task: Task) -> list[Task]:
    """The units of a task, each of them a task."""
    return [(each,) for each in task]


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
