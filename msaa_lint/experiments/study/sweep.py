"""The points of a study, simulated on all cores or on a cluster through joblib, and stored one by one so that a sweep can resume."""

from __future__ import annotations

import contextlib
import functools
import os
import signal
import socket
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import BrokenExecutor
from typing import Any

from msaa_lint.core.extras import needs_extra, pip_install
from msaa_lint.core.parent_process import end_with_parent

from .checkpoint import Checkpoint
from .points import MSAA, Point, Technique
from .shading import Shading
from .tasks import FailedPoint, StudyInput, Task, Unusable
from .times import Cost, Costs, CostSource

CONNECT_SECONDS = 10.0
"""How long to wait for a cluster's answer."""

Measure = Callable[[Task], Point]
Progress = Callable[[int, int, str], None]
"""Called with the number of finished points, the number of all points, and the last finished point."""


@functools.lru_cache(maxsize=2)
def picture(source: StudyInput, width: int, height: int) -> Any:
    """The scene (study/scenes) of an input; the last ones are cached. LookupError for an unknown name, and the errors of the readers of
    meshes and descriptions."""
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

    point: Point = measure.point(picture(task.input, task.width, task.height), task.technique, task.bits, task.ssim, task.flip)
    return point._replace(scene=task.input.name)


def costs(
    techniques: Sequence[Technique],
    shadings: Sequence[Shading],
    size: tuple[int, int],
    source: CostSource,
    checkpoint: Checkpoint | None = None,
) -> Costs:
    """The cost of each technique under each cost of shading, and of one sample in any case, because ratios are to it. Call it while no
    points are simulated, which would slow the device down. Techniques that the checkpoint does not have are measured together."""
    found: dict[tuple[Technique, str], Cost] = {}
    missing: list[Technique] = []
    for technique in dict.fromkeys((Technique(MSAA, 1), *techniques)):
        stored = {shading: checkpoint.cost(source, technique, shading, size) if checkpoint is not None else None for shading in shadings}
        if None in stored.values():
            missing.append(technique)
        found |= {(technique, shading.name): cost for shading, cost in stored.items() if cost is not None}
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
    jobs: int = 1,
    backend: str | None = None,
    checkpoint: Checkpoint | None = None,
    progress: Progress | None = None,
    measure: Measure = measure_point,
) -> Iterator[Point | FailedPoint]:
    """The points of the tasks in the order in which they finish. A failed point does not stop the others. Unusable where a backend is not
    available.

    With one job and no backend everything runs in this process; -1 is as many jobs as the backend has workers. Closing the iterator stops
    the sweep; finished points stay stored.
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
    for number, result in _results(remaining, jobs, backend, measure):
        task = remaining[number]
        done += 1
        if checkpoint is not None and isinstance(result, Point):
            checkpoint.save_point(task, result)
        if progress is not None:
            progress(done, len(tasks), _label(task))
        yield result if isinstance(result, Point) else FailedPoint(task.input.name, task.technique, result)


def with_cost(point: Point, costs: Costs, shading: Shading, source: str) -> Point:
    """The point under a cost of shading: with its time, the ratio to the time of one sample, bytes and power."""
    cost, one = costs[point.technique, shading.name], costs[Technique(MSAA, 1), shading.name].time_ms
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


def _results(tasks: Sequence[Task], jobs: int, backend: str | None, measure: Measure) -> Iterator[tuple[int, Point | str]]:
    """The number of each task with its point or the reason why there is none, as they finish."""
    if not tasks:
        return
    if jobs == 1 and backend is None:
        for group in _groups(dict(enumerate(tasks))):
            for number, task in group.items():
                yield number, _attempt(measure, task)
        return
    unfinished = dict(enumerate(tasks))
    # Ray prints what happens to workers to standard output, which is for the report.
    with contextlib.redirect_stdout(sys.stderr), _cluster(backend):
        try:
            groups = sorted(_groups(unfinished), key=_work, reverse=True)
            for number, result in _parallel(groups, jobs, backend, measure):
                del unfinished[number]
                yield number, result
            return
        except Exception as error:
            if len(unfinished) == len(tasks) and not _worker_died(error):
                raise Unusable(f"--backend {backend}: {_text(error)}") from None
        # A worker died, and nothing tells which point killed it. Continue one by one to find out.
        for number, task in tuple(unfinished.items()):
            try:
                yield from _parallel([{number: task}], 2 if jobs == 1 else jobs, backend, measure)
            except Exception as error:
                yield number, f"the process that simulated it died: {_text(error)}"


Group = dict[int, Task]
"""Tasks by number that need one picture, which a worker simulates once."""


def _groups(tasks: Mapping[int, Task]) -> list[Group]:
    groups: dict[Task, Group] = {}
    for number, task in tasks.items():
        groups.setdefault(task.picture, {})[number] = task
    return list(groups.values())


def _work(group: Group) -> int:
    """About how long a picture takes: what takes longest begins first, so that all workers end together."""
    return max(task.technique.samples + task.technique.shaded * task.shader for task in group.values())


def _parallel(groups: Sequence[Group], jobs: int, backend: str | None, measure: Measure) -> Iterator[tuple[int, Point | str]]:
    import joblib

    owner = os.getpid()
    calls = [joblib.delayed(_attempt_in_worker)(owner, measure, group) for group in groups]
    starting: Callable[[], contextlib.AbstractContextManager[None]] = _interrupts_held
    with joblib.parallel_config(backend=backend or "loky", n_jobs=jobs):
        try:
            parallel, step = joblib.Parallel(return_as="generator_unordered", batch_size=1), len(calls)
        except ValueError:
            starting = contextlib.nullcontext
            # A backend without a stream of results (Ray's) returns a list: run one task per worker at a time, so that few are lost.
            parallel, step = joblib.Parallel(batch_size=1), max(joblib.effective_n_jobs(jobs), 1)
    for start in range(0, len(calls), step):
        with starting():
            results = parallel(calls[start : start + step])
        for result in results:
            yield from result


@contextlib.contextmanager
def _interrupts_held() -> Iterator[None]:
    """Holds interrupts back while processes start, which inherit that: an interrupt does not end them before they ignore it."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _attempt_in_worker(owner: int, measure: Measure, group: Group) -> list[tuple[int, Point | str]]:
    if os.getpid() != owner:
        if os.getppid() == owner:
            end_with_parent(owner)
        # Interrupts are for the parent process, which ends this one.
        with contextlib.suppress(ValueError):
            signal.signal(signal.SIGINT, signal.SIG_IGN)
    return [(number, _attempt(measure, task)) for number, task in group.items()]


def _attempt(measure: Measure, task: Task) -> Point | str:
    try:
        return measure(task)
    except Exception as error:
        return _text(error)


def _worker_died(error: Exception) -> bool:
    """Whether an error of a backend says that a worker ended, as loky, Dask, and Ray say it."""
    return isinstance(error, BrokenExecutor) or type(error).__name__ in (
        "KilledWorker",
        "ActorDiedError",
        "RayActorError",
        "WorkerCrashedError",
    )


def _text(error: Exception) -> str:
    return f"{type(error).__name__}: {str(error)[:300]}" if str(error) else type(error).__name__


def _cluster(backend: str | None) -> Any:
    """A context manager for what a backend needs: the cluster that DASK_SCHEDULER_ADDRESS or RAY_ADDRESS names, or one on this machine.
    Unusable where a package is not installed, or the cluster cannot be reached."""
    try:
        import joblib  # noqa: F401

        if backend == "dask":
            from distributed import Client
        if backend == "ray":
            import ray
            from ray.util.joblib import register_ray
    except ImportError as error:
        package = (error.name or "").partition(".")[0]
        missing = f"{package} is not installed: run `{pip_install(package)}`"
        raise Unusable(needs_extra("more than one job", "study") if package == "joblib" else missing) from None
    try:
        if backend == "dask":
            with _outside_the_working_folder():
                return contextlib.closing(Client())
        if backend == "ray":
            register_ray()
            _check_ray_address(os.environ.get("RAY_ADDRESS", ""))
            os.environ.setdefault("RAY_USAGE_STATS_ENABLED", "0")
            with _outside_the_working_folder():
                return contextlib.nullcontext() if ray.is_initialized() else ray.init(logging_level="ERROR")
    except Exception as error:
        raise Unusable(f"--backend {backend}: no cluster: {_text(error)}") from None
    return contextlib.nullcontext()


def _check_ray_address(address: str) -> None:
    """OSError where nothing listens at an address `host:port`: Ray ends the process then."""
    host, _, port = address.rpartition(":")
    if host and "/" not in host and port.isdecimal():
        socket.create_connection((host.strip("[]"), int(port)), CONNECT_SECONDS).close()


def _outside_the_working_folder() -> contextlib.AbstractContextManager[None]:
    """While workers start: Ray's import modules from the working folder."""
    return contextlib.chdir(os.sep)


def ordered(results: Iterable[Point | FailedPoint], names: Sequence[str], techniques: Sequence[Technique]) -> list[Point | FailedPoint]:
    """Results in the order of the scenes and of the techniques."""
    scene_order = {name: n for n, name in enumerate(names)}
    technique_order = {technique: n for n, technique in enumerate(techniques)}
    return sorted(results, key=lambda result: (scene_order[result.scene], technique_order[result.technique]))
