"""A study's points: simulated on all cores or on a cluster through joblib, each kept as soon as it is there, so that a sweep resumes."""

from __future__ import annotations

import contextlib
import functools
import os
import signal
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import BrokenExecutor
from typing import TYPE_CHECKING, Any

from .points import MSAA, Point, Technique
from .tasks import Asked, Failed, Task, Unusable
from .times import Cost, Source

if TYPE_CHECKING:
    from .checkpoint import Kept

BACKENDS = ("loky", "threading", "dask", "ray")
"""joblib's: processes and threads of this machine, a Dask cluster (DASK_SCHEDULER_ADDRESS), a Ray cluster (RAY_ADDRESS)."""

Measure = Callable[[Task], Point]
Progress = Callable[[int, int, str], None]
"""Told how many of how many points are done, and what was done last."""


@functools.lru_cache(maxsize=2)
def picture(asked: Asked, width: int, height: int) -> Any:
    """The scene (study/scenes) of what is asked for, the last ones remembered. LookupError where there is none of the name, and what the
    reader of a mesh or of a description raises."""
    from . import scenes

    if asked.kind == "mesh":
        return scenes.from_mesh(asked.path, width, height)
    if asked.kind == "description":
        return scenes.from_description(frame(asked), width, height)
    return scenes.scene(asked.name, width, height)


def frame(asked: Asked) -> Any:
    """The frame of a document of a description."""
    from msaa_lint.core.text.source import Source as Text
    from msaa_lint.core.text.tree import Limits, parse
    from msaa_lint.frame.facts.frame import Frame
    from msaa_lint.input import readers

    source = Text(asked.name, asked.text)
    return Frame(readers.read(source, parse(source, Limits()).documents[asked.number], asked.format))


def measured(task: Task) -> Point:
    """A point as it is simulated: everything but times and what the cost model says."""
    from . import measure

    found: Point = measure.point(picture(task.asked, task.width, task.height), task.technique, task.bits, task.ssim)
    return found._replace(scene=task.asked.name)


def costs(techniques: Sequence[Technique], size: tuple[int, int], source: Source, kept: Kept | None = None) -> dict[Technique, Cost]:
    """What each technique takes, and one sample too, whatever is asked for: ratios are to it. A device is not timed while points are
    simulated, which would slow it down."""
    found: dict[Technique, Cost] = {}
    for technique in dict.fromkeys((Technique(MSAA, 1), *techniques)):
        known = kept.cost(source, technique, size) if kept is not None else None
        found[technique] = known if known is not None else source.of(technique, *size)
        if kept is not None and known is None:
            kept.keep_cost(source, technique, size, found[technique])
    return found


def sweep(
    tasks: Sequence[Task],
    *,
    jobs: int = 1,
    backend: str | None = None,
    kept: Kept | None = None,
    progress: Progress | None = None,
    measure: Measure = measured,
) -> Iterator[Point | Failed]:
    """The points of the tasks, as they come; what fails is said, and the others go on. Unusable where a backend cannot be had.

    With one job and no backend it is this process alone; -1 is as many jobs as the backend has workers. Whoever stops asking stops the
    sweep: points that are done are kept.
    """
    done = 0
    waiting: list[Task] = []
    for task in tasks:
        point = kept.point(task) if kept is not None else None
        if point is None:
            waiting.append(task)
            continue
        done += 1
        if progress is not None:
            progress(done, len(tasks), _called(task))
        yield point
    for number, result in _results(waiting, jobs, backend, measure):
        task = waiting[number]
        done += 1
        if kept is not None and isinstance(result, Point):
            kept.keep_point(task, result)
        if progress is not None:
            progress(done, len(tasks), _called(task))
        yield result if isinstance(result, Point) else Failed(task.asked.name, task.technique, result)


def with_cost(point: Point, found: Mapping[Technique, Cost], source: str) -> Point:
    """The point with its time, the ratio to one sample's, bytes and power."""
    cost, one = found[point.technique], found[Technique(MSAA, 1)].time_ms
    return point._replace(
        time_ms=cost.time_ms,
        time_from=source if cost.time_ms is not None else "",
        ratio=cost.time_ms / one if cost.time_ms is not None and one else None,
        bytes_per_frame=cost.bytes_per_frame,
        milliwatts=cost.milliwatts,
        memory_mib=cost.memory_mib,
    )


def _called(task: Task) -> str:
    return f"{task.asked.name}: {task.technique.name}"


def _results(tasks: Sequence[Task], jobs: int, backend: str | None, measure: Measure) -> Iterator[tuple[int, Point | str]]:
    """The number of each task with its point, or with what was wrong, as they come."""
    if not tasks:
        return
    if jobs == 1 and backend is None:
        for number, task in enumerate(tasks):
            yield number, _attempt(measure, task)
        return
    left = dict(enumerate(tasks))
    with _cluster(backend):
        try:
            for number, result in _parallel(left, jobs, backend, measure):
                del left[number]
                yield number, result
            return
        except Exception as error:
            if len(left) == len(tasks) and not isinstance(error, BrokenExecutor):
                raise Unusable(f"--backend {backend}: {_words(error)}") from None
        # A worker died: whose point it was nobody says. What is left goes on one by one, and the one that kills is known.
        for number, task in tuple(left.items()):
            try:
                yield from _parallel({number: task}, 2 if jobs == 1 else jobs, backend, measure)
            except Exception as error:
                yield number, f"the process that simulated it died: {_words(error)}"


def _parallel(tasks: Mapping[int, Task], jobs: int, backend: str | None, measure: Measure) -> Iterator[tuple[int, Point | str]]:
    import joblib

    owner = os.getpid()
    waiting = [joblib.delayed(_numbered)(owner, number, measure, task) for number, task in tasks.items()]
    with joblib.parallel_config(backend=backend or "loky", n_jobs=jobs):
        try:
            parallel, step = joblib.Parallel(return_as="generator_unordered", batch_size=1), len(waiting)
        except ValueError:
            # A backend that has no stream of results (Ray's) gives a list: as many at a time as it has workers, so that few are lost.
            parallel, step = joblib.Parallel(batch_size=1), max(joblib.effective_n_jobs(jobs), 1)
    for start in range(0, len(waiting), step):
        yield from parallel(waiting[start : start + step])


def _numbered(owner: int, number: int, measure: Measure, task: Task) -> tuple[int, Point | str]:
    if os.getpid() != owner:
        # An interrupt is for the process that started us, which ends us.
        with contextlib.suppress(ValueError):
            signal.signal(signal.SIGINT, signal.SIG_IGN)
    return number, _attempt(measure, task)


def _attempt(measure: Measure, task: Task) -> Point | str:
    try:
        return measure(task)
    except Exception as error:
        return _words(error)


def _words(error: Exception) -> str:
    return f"{type(error).__name__}: {str(error)[:300]}" if str(error) else type(error).__name__


def _cluster(backend: str | None) -> Any:
    """What a backend needs around it. Unusable where a package is not installed."""
    try:
        import joblib  # noqa: F401

        if backend == "dask":
            from distributed import Client
        if backend == "ray":
            import ray
            from ray.util.joblib import register_ray
    except ImportError as error:
        package = (error.name or "").partition(".")[0]
        extra = "'msaa-lint[study]'" if package == "joblib" else package
        raise Unusable(f"{package} is not installed: pip install {extra}") from None
    if backend == "dask":
        return contextlib.closing(Client())
    if backend == "ray":
        register_ray()
        return contextlib.nullcontext() if ray.is_initialized() else ray.init(logging_level="ERROR")
    return contextlib.nullcontext()


def ordered(results: Iterable[Point | Failed], names: Sequence[str], techniques: Sequence[Technique]) -> list[Point | Failed]:
    """Results in the order of the scenes and of the techniques, however they came."""
    scenes = {name: n for n, name in enumerate(names)}
    kinds = {technique: n for n, technique in enumerate(techniques)}
    return sorted(results, key=lambda each: (scenes[each.scene], kinds[each.technique]))
