"""Reads the inputs of a run, by several processes if there is enough to do."""

from collections.abc import Generator, Sequence

from .input_runs import MAX_UNITS, InputRuns, Linter, Part, processes
from .request import ALONE, Division
from .workspace import Unit


def parts(
    linter: Linter[Part],
    units: Sequence[Unit],
    division: Division = ALONE,
    per_task: int = MAX_UNITS,
) -> Generator[Part]:
    """Yields what the inputs and programs of a run add to its result, in their order; a process
    gets at most `per_task` inputs at once. Raises Unusable if the cluster cannot be used.
    """
    runs = InputRuns(linter, units, per_task)
    count = (
        division.jobs
        if division.backend is not None
        else processes(linter.workspace, units, division.jobs)
    )
    if count == 1 and division.backend is None:
        return runs.in_this_process()
    from msaa_lint.core.execution.backend import Unusable
    from msaa_lint.core.execution.engines import open_backend

    from .job import Job

    try:
        backend = open_backend(division.backend, division.cluster, count)
    except Unusable as error:
        raise Unusable(f"--backend {division.backend}: {error}") from None
    return runs.divided(backend, Job(runs))
