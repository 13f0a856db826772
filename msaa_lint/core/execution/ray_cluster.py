"""Tasks on a cluster of Ray. Ray itself distributes them: a process has one at a time, so that its
end is that task's alone.
"""

from __future__ import annotations

import contextlib
import os
import pickle
import sys
import time
import uuid
from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
from typing import Any, Generic

from msaa_lint.core.package import VERSION

from .address import check_listening
from .backend import ENDED_WORKERS, Failure, Result, Split, Task, Unusable, Waiting, Work
from .processes import cores
from .starting import interrupts_held, missing_package, outside_the_working_folder

JOIN_SECONDS = 60.0
"""How long a cluster may have no processors."""

AHEAD = 4
"""The number of tasks per worker that Ray has, so that it has one for a worker that has
finished.
"""

POLL_SECONDS = 1.0
"""How often the processors of the cluster are looked at while nothing happens."""


class RayCluster:
    """The cluster at an address, else at RAY_ADDRESS, else one of this machine that ends with
    `close`; the one that this process is already connected to in any case.

    `workers` is the number of processes to start, one per core by default; of a cluster that
    exists, so many tasks are done at the same time, by default as many as it has processors. Raises
    Unusable if there is none. Ray finds the token of a cluster itself, in RAY_AUTH_TOKEN for
    example, with `RAY_AUTH_MODE=token`.
    """

    def __init__(self, address: str | None = None, workers: int | None = None) -> None:
        os.environ.setdefault("RAY_USAGE_STATS_ENABLED", "0")
        try:
            import ray
        except ImportError as error:
            raise missing_package(error) from None
        self._ray: Any = ray
        self._is_connected_here = not ray.is_initialized()
        self._max_tasks = workers
        address = address or os.environ.get("RAY_ADDRESS")
        settings: dict[str, Any] = {"logging_level": "ERROR", "log_to_driver": False}
        if address is None:
            settings |= {
                "address": "local",
                "num_cpus": workers or cores(),
                "include_dashboard": False,
            }
        try:
            if self._is_connected_here:
                if address is not None:
                    check_listening(address)
                _silence(ray)
                # Ray prints to standard output, which is for the report.
                with (
                    contextlib.redirect_stdout(sys.stderr),
                    outside_the_working_folder(),
                    interrupts_held(),
                ):
                    ray.init(**{"address": address, **settings})
            self.workers = min(self._processors(), workers or 1 << 30)
        except Exception as error:
            self.close()
            raise Unusable(f"no cluster: {type(error).__name__}: {error}") from None

    def results(
        self, work: Work[Task, Result], tasks: Iterable[Task], split: Split[Task]
    ) -> Iterator[tuple[Task, Result | Failure]]:
        """Yields tasks with their results as they finish, as `Backend` says. Closing the iterator
        ends the processes that do tasks.
        """
        run: _Run[Task, Result] = _Run(self, work, Waiting(tasks, split))
        try:
            yield from run.results()
        finally:
            run.close()

    def ahead(self) -> int:
        """How many tasks Ray should have."""
        self.workers = self._processors()
        return (
            self._max_tasks
            if self._max_tasks is not None and self._max_tasks < self.workers
            else AHEAD * max(self.workers, 1)
        )

    def close(self) -> None:
        """Disconnects; ends the cluster if it was started here."""
        if self._is_connected_here:
            with suppress(Exception):
                self._ray.shutdown()

    def _processors(self) -> int:
        return int(self._ray.cluster_resources().get("CPU", 0))


class _Run(Generic[Task, Result]):
    """The tasks of one call of `results`."""

    def __init__(
        self, cluster: RayCluster, work: Work[Task, Result], waiting: Waiting[Task]
    ) -> None:
        self._cluster = cluster
        self._ray = cluster._ray
        self._waiting = waiting
        self._name = uuid.uuid4().hex
        # In a list, the reference is passed on as it is, and not the object.
        self._work = [self._ray.put(pickle.dumps(work))]
        self._do = self._ray.remote(max_retries=0, num_cpus=1)(_task_function(VERSION)).options(
            name="msaa-lint"
        )
        self._sent: dict[Any, tuple[Task, int]] = {}

    def results(self) -> Iterator[tuple[Task, Result | Failure]]:
        ahead, since, looked = self._cluster.ahead(), time.monotonic(), time.monotonic()
        while True:
            while len(self._sent) < ahead and (following := self._waiting.next()) is not None:
                self._sent[self._do.remote(self._name, self._work, pickle.dumps(following[0]))] = (
                    following
                )
            if not self._sent:
                return
            ready, _ = self._ray.wait(list(self._sent), num_returns=1, timeout=POLL_SECONDS)
            if ready and len(self._sent) > 1:
                ready, _ = self._ray.wait(list(self._sent), num_returns=len(self._sent), timeout=0)
            now = time.monotonic()
            if now - looked > POLL_SECONDS:
                ahead, looked = self._cluster.ahead(), now
            if ready or self._cluster.workers:
                since = now
            elif now - since > JOIN_SECONDS:
                raise Unusable(f"the cluster has had no processors for {JOIN_SECONDS:g} s")
            for reference in ready:
                yield from self._finish(reference)

    def close(self) -> None:
        for reference in self._sent:
            with suppress(Exception):
                self._ray.cancel(reference, force=True)
        self._sent.clear()

    def _finish(self, reference: Any) -> Iterator[tuple[Task, Result | Failure]]:
        task, deaths = self._sent.pop(reference)
        errors = self._ray.exceptions
        try:
            found = self._ray.get(reference)
        except errors.RayTaskError as error:
            yield (
                task,
                Failure(_one_line(error.cause if isinstance(error.cause, Exception) else error)),
            )
            return
        except (
            errors.RuntimeEnvSetupError,
            errors.TaskUnschedulableError,
            errors.AuthenticationError,
        ) as error:
            raise Unusable(f"the cluster cannot do tasks: {_one_line(error)}") from None
        except errors.RayError:
            # The process or its machine ended, or the result was lost with it.
            if not self._waiting.died(task, deaths):
                yield task, Failure(ENDED_WORKERS)
            return
        if isinstance(found, str):
            raise Unusable(f"the worker {found}")
        yield task, pickle.loads(found)[0]


def _silence(ray: Any) -> None:
    """Keeps Ray from printing to standard output that a worker died; it has no setting for that."""
    if hasattr(ray._private.worker, "print_to_stdstream"):
        ray._private.worker.print_to_stdstream = lambda *_, **__: None


def _one_line(error: Exception) -> str:
    return f"{type(error).__name__}: {' '.join(str(error).split())[:300]}"


def _task_function(wanted: str) -> Callable[[str, list[Any], bytes], bytes | str]:
    """What a worker does: returns a pickled result, or a string that says why the worker cannot do
    tasks. It travels by value, so that workers without this package, or with another version of it,
    can load it.
    """

    def do(run: str, work: list[Any], task: bytes) -> bytes | str:
        import ray

        try:
            from msaa_lint.core.package import VERSION as found
        except ImportError:
            return (
                f"at {ray.util.get_node_ip_address()} has no msaa-lint; install {wanted} there, "
                "as here"
            )
        if found != wanted:
            return (
                f"at {ray.util.get_node_ip_address()} has msaa-lint {found}, and this process "
                f"{wanted}; install the same version"
            )
        from msaa_lint.core.execution.worker import perform

        done = perform(run, lambda: ray.get(work[0]), task)  # type: ignore[no-any-return, unused-ignore]
        return f"at {ray.util.get_node_ip_address()} {done}" if isinstance(done, str) else done

    return do
