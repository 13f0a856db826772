"""Tasks on a cluster of Dask, the package `distributed`.

Each task is meant for one worker, so that it is known which tasks a worker that ended had, and in
which order. Workers should have a single thread: the tasks of a process take turns in any case.
"""

from __future__ import annotations

import asyncio
import os
import pickle
import queue
import time
import uuid
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
from typing import Any, Generic, NamedTuple

from msaa_lint.core.package import VERSION

from .address import CONNECT_SECONDS, check_listening
from .backend import ENDED_WORKERS, Failure, Result, Split, Task, Unusable, Waiting, Work
from .processes import cores
from .starting import interrupts_held, missing_package, outside_the_working_folder

JOIN_SECONDS = 60.0
"""How long a cluster may have no worker."""

AHEAD_SECONDS = 0.1
"""A worker has tasks for as long as this besides the one that it does: messages take some
hundredths of a second. Those that it has are not moved to a worker that has none.
"""

MAX_AHEAD = 16

POLL_SECONDS = 1.0
"""How often the connection is looked at while nothing happens."""

REGISTRATIONS = 5
"""How often the work is sent to the workers, if one of them ends meanwhile."""

MAX_LOGGED = 1000
"""How many state changes the scheduler of a cluster that is started here remembers."""


class DaskCluster:
    """The cluster whose scheduler is at an address, else at DASK_SCHEDULER_ADDRESS, else one of
    this machine that ends with `close`.

    `workers` is the number of processes to start, one per core by default; of a cluster that
    exists, so many workers get tasks, by default all of them. Raises Unusable if there is none.
    """

    def __init__(self, address: str | None = None, workers: int | None = None) -> None:
        try:
            import distributed
        except ImportError as error:
            raise missing_package(error) from None
        self._cluster: Any = None
        self._max_workers = workers
        address = address or os.environ.get("DASK_SCHEDULER_ADDRESS")
        try:
            with outside_the_working_folder(), interrupts_held():
                if address is None:
                    self._cluster = _local_cluster(workers or cores())
                else:
                    check_listening(address)
                self._client: Any = distributed.Client(
                    self._cluster or address, timeout=CONNECT_SECONDS, set_as_default=False
                )
            self.workers = min(len(self._client.nthreads()), workers or 1 << 30)
        except Exception as error:
            self.close()
            raise Unusable(f"no cluster: {type(error).__name__}: {error}") from None

    def results(
        self, work: Work[Task, Result], tasks: Iterable[Task], split: Split[Task]
    ) -> Iterator[tuple[Task, Result | Failure]]:
        """Yields tasks with their results as they finish, as `Backend` says. A task that a worker
        does when the iterator is closed goes on there.
        """
        run: _Run[Task, Result] = _Run(self._client, self._max_workers, work, Waiting(tasks, split))
        try:
            yield from run.results()
        finally:
            run.close()

    def close(self) -> None:
        """Disconnects; ends the cluster if it was started here."""
        client: Any = getattr(self, "_client", None)
        with suppress(Exception):
            client.unsubscribe_topic("all")
        for each in (client, self._cluster):
            if each is not None:
                with suppress(Exception):
                    each.close(timeout=CONNECT_SECONDS)


def _local_cluster(workers: int) -> Any:
    """A cluster of this machine: processes of one thread."""
    import logging

    import dask
    from distributed import LocalCluster

    # Dask looks at this when a worker ends, and as long afterward gives up a worker that happens to
    # be starting again just then.
    dask.config.set({"distributed.deploy.lost-worker-timeout": "1000 days"})
    with dask.config.set({"distributed.admin.low-level-log-length": MAX_LOGGED}):
        return LocalCluster(
            n_workers=workers,
            threads_per_worker=1,
            dashboard_address="127.0.0.1:0",
            memory_limit=0,
            silence_logs=logging.CRITICAL,
        )


class _Sent(NamedTuple, Generic[Task]):
    """A task that a worker has, and the processes that it has ended."""

    task: Task
    deaths: int
    future: Any


class _Worker:
    """A worker, and the keys of the tasks that it has, in the order in which it does them. One that
    is repeated is there alone: if the worker ends, it is why.
    """

    def __init__(self) -> None:
        self.doing: deque[str] = deque()
        self.is_alone = False


class _Run(Generic[Task, Result]):
    """The tasks of one call of `results`. What happens comes through a queue, from the thread in
    which Dask's client has its event loop.
    """

    def __init__(
        self, client: Any, max_workers: int | None, work: Work[Task, Result], waiting: Waiting[Task]
    ) -> None:
        self._client = client
        self._max_workers = max_workers
        self._waiting = waiting
        self._happened: queue.SimpleQueue[Callable[[], Iterator[tuple[Task, Result | Failure]]]] = (
            queue.SimpleQueue()
        )
        self._workers: dict[str, _Worker] = {}
        self._sent: dict[str, tuple[str, _Sent[Task]]] = {}
        self._name = f"msaa-lint-{uuid.uuid4().hex}"
        self._number = 0
        self._mean_seconds = AHEAD_SECONDS
        self._knock: Any = None
        self._do = _task_function(VERSION)
        # From here on it is told which workers join, and then those that are there are asked for.
        client.subscribe_topic("all", self._hear)
        self._register(_plugin(pickle.dumps(work)))
        for address in client.nthreads():
            self._join(address)

    def _register(self, plugin: Any) -> None:
        """Gives the workers the work, and those that join."""
        for attempts_left in reversed(range(REGISTRATIONS)):
            try:
                self._client.register_plugin(plugin, name=self._name)
                return
            except Exception as error:
                # A worker may end meanwhile; to those that have it, it comes again.
                if not attempts_left:
                    raise Unusable(
                        f"the workers do not take tasks: {type(error).__name__}: {error}"
                    ) from None

    def results(self) -> Iterator[tuple[Task, Result | Failure]]:
        since = time.monotonic()
        while True:
            self._fill()
            if self._workers:
                since = time.monotonic()
                if not self._sent:
                    return
            elif time.monotonic() - since > JOIN_SECONDS:
                raise Unusable(f"the cluster has had no worker for {JOIN_SECONDS:g} s")
            try:
                happened = self._happened.get(timeout=POLL_SECONDS)
            except queue.Empty:
                yield from self._look()
                continue
            yield from happened()
            # More may have happened meanwhile: workers get their next tasks together.
            with suppress(queue.Empty):
                while True:
                    yield from self._happened.get_nowait()()

    def _look(self) -> Iterator[tuple[Task, Failure]]:
        """Takes note of workers that have joined or ended, where the scheduler's messages were
        missed.
        """
        if self._client.status != "running":
            raise Unusable("the connection to the scheduler is lost")
        try:
            there = self._client.nthreads()
        except Exception as error:
            raise Unusable(
                f"the connection to the scheduler is lost: {type(error).__name__}"
            ) from None
        for address in self._workers.keys() - there.keys():
            yield from self._leave(address, None, False)
        for address in there:
            self._join(address)

    def close(self) -> None:
        sent = [sent.future for _, sent in self._sent.values()]
        self._sent.clear()
        with suppress(Exception):
            self._client.cancel(sent)
            self._client.unregister_worker_plugin(self._name)
        self._knock = None

    def _fill(self) -> None:
        """Gives the workers tasks, those first that have the fewest."""
        depth = 1 + min(MAX_AHEAD, int(AHEAD_SECONDS / max(self._mean_seconds, 1e-6)))
        for count in range(depth):
            for address, worker in self._workers.items():
                if worker.is_alone or len(worker.doing) != count:
                    continue
                if self._waiting.has_repeated and count:
                    return
                is_alone = self._waiting.has_repeated
                if (following := self._waiting.next()) is None:
                    return
                worker.is_alone = is_alone
                self._send(address, worker, *following)
        if not self._workers and self._knock is None:
            # An adaptive cluster starts workers for tasks that any may do.
            self._knock = self._client.submit(_nothing(), pure=False)

    def _send(self, address: str, worker: _Worker, task: Task, deaths: int) -> None:
        self._number += 1
        key = f"{self._name}-{self._number}"
        future = self._client.submit(
            self._do, self._name, pickle.dumps(task), key=key, workers=[address], pure=False,
            fifo_timeout="0 ms"
        )  # fmt: skip
        asyncio.run_coroutine_threadsafe(self._fetch(key, future), self._client.loop.asyncio_loop)
        worker.doing.append(key)
        self._sent[key] = address, _Sent(task, deaths, future)

    async def _fetch(self, key: str, future: Any) -> None:
        """Waits for a result, in the thread of the event loop, or until the task is canceled. It is
        not canceled itself: several may wait for one message.
        """
        found: Any
        try:
            found = await future
        except (Exception, asyncio.CancelledError) as error:
            found = error
        self._happened.put(lambda: self._finish(key, found))

    def _hear(self, event: tuple[float, Any]) -> None:
        """Takes note of what the scheduler says of its workers, in the thread of the event loop."""
        _, what = event
        if isinstance(what, dict) and what.get("action") == "add-worker":
            self._happened.put(lambda: self._join(what["worker"]))
        if isinstance(what, dict) and what.get("action") == "remove-worker":
            self._happened.put(
                lambda: self._leave(
                    what["worker"], what.get("processing-tasks"), what.get("expected", False)
                )
            )

    def _join(self, address: str) -> Iterator[tuple[Task, Failure]]:
        if self._max_workers is None or len(self._workers) < self._max_workers:
            self._workers.setdefault(address, _Worker())
            self._knock = None
        return iter(())

    def _leave(
        self, address: str, processing: Iterable[str] | None, expected: bool
    ) -> Iterator[tuple[Task, Failure]]:
        """Repeats the tasks of a worker that ended. The first that it had not finished may be why,
        unless it ended in good order.
        """
        worker = self._workers.pop(address, None)
        if worker is None:
            return
        unfinished = [key for key in worker.doing if processing is None or key in processing]
        doing = {key: self._forget(key) for key in worker.doing}
        self._client.cancel([sent.future for sent in doing.values()])
        for key, sent in doing.items():
            if expected or key not in unfinished[:1]:
                self._waiting.repeat(sent.task, sent.deaths)
            elif not self._waiting.died(sent.task, sent.deaths):
                yield sent.task, Failure(ENDED_WORKERS)

    def _finish(self, key: str, found: Any) -> Iterator[tuple[Task, Result | Failure]]:
        if key not in self._sent:
            return
        address = self._sent[key][0]
        sent = self._forget(key)
        if isinstance(found, str):
            raise Unusable(f"the worker at {address} {found}")
        if isinstance(found, asyncio.CancelledError):
            raise Unusable("the scheduler has ended, or canceled the tasks")
        if type(found).__name__ == "KilledWorker":
            # Workers that ended were replaced at the same address.
            if not self._waiting.died(sent.task, sent.deaths):
                yield sent.task, Failure(ENDED_WORKERS)
            return
        if isinstance(found, Exception):
            yield sent.task, Failure(f"{type(found).__name__}: {str(found)[:300]}")
            return
        result, seconds = pickle.loads(found)
        self._mean_seconds += (seconds - self._mean_seconds) / 4
        yield sent.task, result

    def _forget(self, key: str) -> _Sent[Task]:
        address, sent = self._sent.pop(key)
        worker = self._workers.get(address)
        if worker is not None:
            worker.doing.remove(key)
            worker.is_alone = worker.is_alone and bool(worker.doing)
        return sent


# What follows travels by value: the scheduler and workers without this package, or with another
# version of it, can load it.


def _nothing() -> Callable[[], None]:
    def nothing() -> None:
        pass

    return nothing


def _plugin(work: bytes) -> Any:
    """Keeps the pickled work on each worker, also on those that join later."""
    from distributed import WorkerPlugin

    class Plugin(WorkerPlugin):  # type: ignore[misc, unused-ignore]
        pass

    plugin = Plugin()
    plugin.work = work
    return plugin


def _task_function(wanted: str) -> Callable[[str, bytes], bytes | str]:
    """What a worker does: returns a pickled result, or a string that says why the worker cannot do
    tasks.
    """

    def do(run: str, task: bytes) -> bytes | str:
        from distributed import get_worker

        try:
            from msaa_lint.core.package import VERSION as found
        except ImportError:
            return f"has no msaa-lint; install {wanted} there, as here"
        if found != wanted:
            return f"has msaa-lint {found}, and this process {wanted}; install the same version"
        from msaa_lint.core.execution.worker import perform

        return perform(run, lambda: get_worker().plugins[run].work, task)

    return do
