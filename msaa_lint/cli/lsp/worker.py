"""A thread that lints documents while the server answers: the newest version of each, and nothing
that is superseded.
"""

from __future__ import annotations

import asyncio
import gc
import threading
from collections.abc import Callable, Sequence
from itertools import count
from time import perf_counter, thread_time
from typing import NamedTuple, TypeVar

from lsprotocol import types

from .analysis import Analysis
from .documents import OpenDocument
from .linting import analyze

T = TypeVar("T")

IMMEDIATE = 0.25
"""Seconds of processor time for linting a document up to which each of its versions is linted at
once.
"""

MAX_DELAY = 1.0
"""Seconds without a change after which a document that takes longer is linted."""


IDLE = 2.0
"""Seconds without anything to do after which garbage is collected, which takes as long as linting.
Linting leaves little of it.
"""


class _Job(NamedTuple):
    """A document to lint, the ones open beside it, the number of the request, and when it is
    due.
    """

    document: OpenDocument
    others: Sequence[OpenDocument]
    encoding: types.PositionEncodingKind
    number: int
    due: float


class Worker:
    """Lints documents. `done` is called on the loop with each result.

    All but the thread itself runs on the loop, and only the jobs and calls that wait are shared.
    """

    def __init__(self, done: Callable[[Analysis], None]) -> None:
        self._done = done
        self._changed = threading.Condition()
        self._jobs: dict[str, _Job] = {}
        self._calls: list[Callable[[], None]] = []
        self._numbers = count(1)
        self._requests: dict[str, int] = {}
        self._finished: dict[str, int] = {}
        self._seconds: dict[str, float] = {}
        self._waiting: dict[str, list[asyncio.Future[None]]] = {}
        self._started = False
        self._loop: asyncio.AbstractEventLoop
        self.results: dict[str, Analysis] = {}
        """The last result of each document, perhaps of an older version."""

    def lint(
        self,
        document: OpenDocument,
        others: Sequence[OpenDocument],
        encoding: types.PositionEncodingKind,
    ) -> None:
        """Lints a document in place of older versions: at once, or without another change for as
        long as that takes.
        """
        self._start()
        uri = document.uri
        self._requests[uri] = next(self._numbers)
        seconds = self._seconds.get(uri, 0.0)
        delay = 0.0 if seconds < IMMEDIATE else min(seconds, MAX_DELAY)
        with self._changed:
            self._jobs[uri] = _Job(
                document, others, encoding, self._requests[uri], perf_counter() + delay
            )
            self._changed.notify()

    def forget(self, uri: str) -> None:
        """Drops a document that is closed."""
        with self._changed:
            self._jobs.pop(uri, None)
        self.results.pop(uri, None)
        self._requests.pop(uri, None)
        self._give_up(uri)

    async def result(self, uri: str) -> Analysis:
        """The result of the last request for a document, which is then not delayed, or of a newer
        one.
        """
        number = self._requests[uri]
        while self._finished.get(uri, 0) < number or uri not in self.results:
            with self._changed:
                job = self._jobs.get(uri)
                if job is not None:
                    self._jobs[uri] = job._replace(due=0.0)
                    self._changed.notify()
            future: asyncio.Future[None] = asyncio.get_running_loop().create_future()
            self._waiting.setdefault(uri, []).append(future)
            await future
        return self.results[uri]

    async def call(self, function: Callable[[], T]) -> T:
        """What a function returns that lints, and so has to run between the documents."""
        self._start()
        future: asyncio.Future[T] = asyncio.get_running_loop().create_future()

        def run() -> None:
            try:
                result = function()
            except Exception as error:
                self._post(_fail, future, error)
            else:
                self._post(_succeed, future, result)

        with self._changed:
            self._calls.append(run)
            self._changed.notify()
        return await future

    def _start(self) -> None:
        if not self._started:
            self._started = True
            self._loop = asyncio.get_running_loop()
            threading.Thread(target=self._run, name="lint", daemon=True).start()

    def _run(self) -> None:
        while True:
            work = self._next()
            if isinstance(work, _Job):
                self._analyze(work)
            else:
                work()

    def _next(self) -> _Job | Callable[[], None]:
        """What to do next, when it is due."""
        with self._changed:
            while True:
                if self._calls:
                    return self._calls.pop(0)
                first = min(self._jobs.values(), key=lambda job: job.due, default=None)
                wait = first.due - perf_counter() if first is not None else None
                if first is not None and wait is not None and wait <= 0:
                    return self._jobs.pop(first.document.uri)
                if not self._changed.wait(IDLE if wait is None else wait) and wait is None:
                    gc.collect()
                    self._changed.wait()

    def _analyze(self, job: _Job) -> None:
        start = thread_time()
        last = self.results.get(job.document.uri)
        try:
            analysis = analyze(
                job.document, job.others, job.encoding, last.kind if last is not None else None
            )
        except Exception:
            # What linting raises is a finding. The server outlives everything else, and the next
            # change is linted again.
            self._post(self._give_up, job.document.uri)
        else:
            self._post(self._take, analysis, job.number, thread_time() - start)

    def _post(self, function: Callable[..., None], *arguments: object) -> None:
        """Calls a function on the loop. Ends the thread if there is no loop any more."""
        try:
            self._loop.call_soon_threadsafe(function, *arguments)
        except RuntimeError:
            raise SystemExit from None

    def _give_up(self, uri: str) -> None:
        """Ends what waits for the result of a document."""
        for waiting in self._waiting.pop(uri, ()):
            waiting.cancel()

    def _take(self, analysis: Analysis, number: int, seconds: float) -> None:
        """Keeps a result, unless its document was closed meanwhile."""
        uri = analysis.uri
        if uri not in self._requests:
            return
        self._seconds[uri], self._finished[uri] = seconds, number
        # The older result is freed at the end, which takes milliseconds: the answer does not wait
        # for it.
        older = self.results.get(uri)
        self.results[uri] = analysis
        self._done(analysis)
        for future in self._waiting.pop(uri, ()):
            _succeed(future, None)
        del older


def _succeed(future: asyncio.Future[T], result: T) -> None:
    if not future.done():
        future.set_result(result)


def _fail(future: asyncio.Future[T], error: Exception) -> None:
    if not future.done():
        future.set_exception(error)
