"""Reads the inputs of a run, by several processes if there is enough to do."""

from collections.abc import Iterator, Sequence

from .input_runs import InputRuns, Linter, Part, processes
from .workspace import Unit


def parts(linter: Linter[Part], units: Sequence[Unit], jobs: int | None = 1) -> Iterator[Part]:
    """Yields what the inputs and programs of a run add to its result, in their order, as determined by so many processes at once."""
    runs = InputRuns(linter, units)
    count = processes(linter.workspace, units, jobs)
    if count == 1:
        return runs.in_this_process()
    from msaa_lint.core.execution.processes import Processes

    from .job import Job

    return runs.divided(Processes(count), Job(runs))
