"""The points of a study, simulated on all cores or on a cluster, and stored one by one so that a
sweep can resume.
"""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import lru_cache, partial
from typing import Any

from msaa_lint.core.execution.backend import Failure, attempt
from msaa_lint.core.execution.backend import Unusable as NoBackend
from msaa_lint.core.execution.engines import open_backend

from .checkpoint import Checkpoint
from .points import MSAA, Point, Technique
from .shading import Shading
from .tasks import FailedPoint, StudyInput, Task, Unusable
from .times import Cost, Costs, CostSource

Measure = Callable[[Task], Point]
Progress = Callable[[int, int, str], None]
"""Called with the number of finished points, the number of all points, and the last finished
point.
"""


@lru_cache(maxsize=2)
def picture(source: StudyInput, width: int, height: int) -> Any:
    """The scene (study/scenes) of an input; the last ones are cached. LookupError for an unknown
    name, and the errors of the readers of meshes and descriptions.
    """
    if source.kind == "mesh":
        from .scenes.mesh import from_mesh

        return from_mesh(source.path, width, height)
    if source.kind == "description":
        from .scenes.description import from_description

        return from_description(frame(source), width, height)
    from .scenes import scene

    return scene(source.name, width, height)


def frame(source: StudyInput) -> Any:
    """The frame of a document of a description."""
    from msaa_lint.core.text.source import Source
    from msaa_lint.core.text.tree import Limits, parse
    from msaa_lint.frame.facts.frame import Frame
    from msaa_lint.input import readers

    text = Source(source.name, source.text)
    return Frame(readers.read(text, parse(text, Limits()).documents[source.number], source.format))


def measure_point(task: Task) -> Point:
    """A point as simulated: without times and the cost model's amounts."""
    from . import measure

    point: Point = measure.point(
        picture(task.input, task.width, task.height),
        task.technique,
        task.bits,
        task.ssim,
        task.flip,
    )
    return point._replace(scene=task.input.name)


def costs(
    techniques: Sequence[Technique],
    shadings: Sequence[Shading],
    size: tuple[int, int],
    source: CostSource,
    checkpoint: Checkpoint | None = None,
) -> Costs:
    """The cost of each technique under each cost of shading, and of one sample in any case, because
    ratios are to it. Call it while no points are simulated, which would slow the device down.
    Techniques that the checkpoint does not have are measured together.
    """
    found: dict[tuple[Technique, str], Cost] = {}
    missing: list[Technique] = []
    for technique in dict.fromkeys((Technique(MSAA, 1), *techniques)):
        stored = {
            shading: checkpoint.cost(source, technique, shading, size)
            if checkpoint is not None
            else None
            for shading in shadings
        }
        if None in stored.values():
            missing.append(technique)
        found |= {
            (technique, shading.name): cost for shading, cost in stored.items() if cost is not None
        }
    measured = source.costs(missing, shadings, size) if missing else {}
    for shading in shadings:
        for technique in missing:
            cost = measured[technique, shading.name]
            if checkpoint is not None and not cost.failed:
                checkpoint.save_cost(source, technique, shading, size, cost)
    return {**found, **measured}


def sweep(
    tasks: Sequence[Task],
    *,
    jobs: int | None = 1,
    backend: str | None = None,
    cluster: str | None = None,
    checkpoint: Checkpoint | None = None,
    progress: Progress | None = None,
    measure: Measure = measure_point,
) -> Iterator[Point | FailedPoint]:
    """The points of the tasks in the order in which they finish. A failed point does not stop the
    others. Unusable where a backend is not available.

    With one job and no backend everything runs in this process; None is as many jobs as there are
    cores, or workers of a cluster. Closing the iterator stops the sweep; finished points stay
    stored.
    """
    done = 0
    remaining: list[Task] = []
    for task in tasks:
        point = checkpoint.point(task) if checkpoint is not None else None
        if point is None:
            remaining.append(task)
            continue
        done += 1
        if progress is not None:
            progress(done, len(tasks), _label(task))
        yield point
    for number, result in _results(remaining, jobs, (backend, cluster), measure):
        task = remaining[number]
        done += 1
        if checkpoint is not None and isinstance(result, Point):
            checkpoint.save_point(task, result)
        if progress is not None:
            progress(done, len(tasks), _label(task))
        yield (
            result
            if isinstance(result, Point)
            else FailedPoint(task.input.name, task.technique, result)
        )


def with_cost(point: Point, costs: Costs, shading: Shading, source: str) -> Point:
    """The point under a cost of shading: with its time, the ratio to the time of one sample, bytes
    and power.
    """
    cost, one = (
        costs[point.technique, shading.name],
        costs[Technique(MSAA, 1), shading.name].time_ms,
    )
    return point._replace(
        shading=shading.name,
        time_ms=cost.time_ms,
        low_ms=cost.low_ms,
        high_ms=cost.high_ms,
        rounds=cost.rounds,
        fill_ms=cost.fill_ms,
        shading_ms=cost.shading_ms,
        resolve_ms=cost.resolve_ms,
        invocations=cost.invocations,
        expected_invocations=cost.expected_invocations,
        time_from=source if cost.time_ms is not None else "",
        ratio=cost.time_ms / one if cost.time_ms is not None and one else None,
        bytes_per_frame=cost.bytes_per_frame,
        milliwatts=cost.milliwatts,
        memory_mib=cost.memory_mib,
    )


def _label(task: Task) -> str:
    return f"{task.input.name}: {task.technique.name}"


def _results(
    tasks: Sequence[Task], jobs: int | None, engine: tuple[str | None, str | None], measure: Measure
) -> Iterator[tuple[int, Point | str]]:
    """The number of each task with its point or the reason why there is none, as they finish."""
    if not tasks:
        return
    groups = _groups(tasks)
    attempt_all = partial(_attempt_all, measure)
    backend, cluster = engine
    if jobs == 1 and backend is None:
        for group in groups:
            yield from attempt_all(group)
        return
    try:
        opened = open_backend(backend, cluster, jobs)
        with contextlib.closing(opened):
            results = opened.results(attempt_all, sorted(groups, key=_work, reverse=True), _singles)
            with contextlib.closing(results):  # type: ignore[type-var]
                for group, found in results:
                    yield from (
                        ((number, found.reason) for number, _ in group)
                        if isinstance(found, Failure)
                        else found
                    )
    except NoBackend as error:
        raise Unusable(f"--backend {backend}: {error}") from None


Group = tuple[tuple[int, Task], ...]
"""Tasks by number that need one picture, which a worker simulates once."""


def _groups(tasks: Sequence[Task]) -> list[Group]:
    groups: dict[Task, list[tuple[int, Task]]] = {}
    for number, task in enumerate(tasks):
        groups.setdefault(task.picture, []).append((number, task))
    return list(map(tuple, groups.values()))


def _singles(group: Group) -> list[Group]:
    return [(numbered,) for numbered in group]


def _work(group: Group) -> int:
    """About how long a picture takes: what takes longest begins first, so that all workers end
    together.
    """
    return max(task.technique.samples + task.technique.shaded * task.shader for _, task in group)


def _attempt_all(measure: Measure, group: Group) -> list[tuple[int, Point | str]]:
    results = ((number, attempt(measure, task)) for number, task in group)
    return [
        (number, found.reason if isinstance(found, Failure) else found) for number, found in results
    ]


def ordered(
    results: Iterable[Point | FailedPoint], names: Sequence[str], techniques: Sequence[Technique]
) -> list[Point | FailedPoint]:
    """Results in the order of the scenes and of the techniques."""
    scene_order = {name: n for n, name in enumerate(names)}
    technique_order = {technique: n for n, technique in enumerate(techniques)}
    return sorted(
        results, key=lambda result: (scene_order[result.scene], technique_order[result.technique])
    )
