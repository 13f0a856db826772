"""A thread that lints documents while the server answers: the newest version of each, and nothing that is superseded."""

from __future__ import annotations

import asyncio
import gc
import threading
from collections.abc import Callable, Sequence
from time import perf_counter
from typing import NamedTuple, TypeVar

from lsprotocol import types

from .analysis import Analysis, Kind
from .documents import OpenDocument
from .linting import analyze

T = TypeVar("T")

IMMEDIATE = 0.1
"""Seconds of linting a document up to which each of its versions is linted at once."""

MAX_DELAY = 1.0
"""Seconds without a change after which a document that takes longer is linted."""


class _Job(NamedTuple):
    """A document to lint, the ones open beside it, and when."""

    document: OpenDocument
    others: Sequence[OpenDocument]
    encoding: types.PositionEncodingKind
    due: float


class Worker:
    """Lints documents. `done` is called on the loop with each result of a version that is still the newest."""

    def __init__(self, done: Callable[[Analysis], None]) -> None:
        self._done = done
        self._changed = threading.Condition()
        self._jobs: dict[str, _Job] = {}
        self._calls: list[Callable[[], None]] = []
        self._kinds: dict[str, Kind] = {}
        self._seconds: dict[str, float] = {}
        self._waiting: dict[str, list[asyncio.Future[Analysis]]] = {}
        self._thread: threading.Thread | None = None
        self.results: dict[str, Analysis] = {}
        """The last result of each document, perhaps of an older version. For the loop alone, as is what follows."""
        self._loop: asyncio.AbstractEventLoop

    def lint(self, document: OpenDocument, others: Sequence[OpenDocument], encoding: types.PositionEncodingKind) -> None:
        """Lints a document in place of older versions: at once, or without another change for as long as that takes."""
        self._start()
        seconds = self._seconds.get(document.uri, 0.0)
        delay = 0.0 if seconds < IMMEDIATE else min(seconds, MAX_DELAY)
        with self._changed:
            self._jobs[document.uri] = _Job(document, others, encoding, perf_counter() + delay)
            self._changed.notify()

    def forget(self, uri: str) -> None:
        """Drops a document that is closed."""
        with self._changed:
            self._jobs.pop(uri, None)
        self.results.pop(uri, None)
        self._kinds.pop(uri, None)
        for waiting in self._waiting.pop(uri, ()):
            waiting.cancel()

    async def result(self, document: OpenDocument) -> Analysis:
        """The result for a version of a document that is being linted, or for a newer one."""
        while True:
            last = self.results.get(document.uri)
            if last is not None and last.version >= document.version and not self._is_pending(document.uri):
                return last
            future: asyncio.Future[Analysis] = asyncio.get_running_loop().create_future()
            self._waiting.setdefault(document.uri, []).append(future)
            await future

    def _is_pending(self, uri: str) -> bool:
        """Whether a newer version waits, which is then linted without delay."""
        with self._changed:
            job = self._jobs.get(uri)
            if job is not None:
                self._jobs[uri] = job._replace(due=0.0)
                self._changed.notify()
            return job is not None

    async def call(self, function: Callable[[], T]) -> T:
        """What a function returns that lints, and so has to run between the documents."""
        self._start()
        loop = asyncio.get_running_loop()
        future: asyncio.Future[T] = loop.create_future()

        def run() -> None:
            try:
                result = function()
            except Exception as error:
                loop.call_soon_threadsafe(_fail, future, error)
            else:
                loop.call_soon_threadsafe(_succeed, future, result)

        with self._changed:
            self._calls.append(run)
            self._changed.notify()
        return await future

    def _start(self) -> None:
        if self._thread is None:
            self._loop = asyncio.get_running_loop()
            self._thread = threading.Thread(target=self._run, name="lint", daemon=True)
            self._thread.start()

    def _run(self) -> None:
        while True:
            work = self._next()
            if isinstance(work, _Job):
                self._analyze(work)
            else:
                work()
            with self._changed:
                idle = not self._jobs and not self._calls
            if idle:
                # The command line disables the collector, and the parts of a frame refer to each other.
                gc.collect()

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
                self._changed.wait(wait)

    def _analyze(self, job: _Job) -> None:
        uri = job.document.uri
        start = perf_counter()
        analysis = analyze(job.document, job.others, job.encoding, self._kinds.get(uri))
        self._seconds[uri] = perf_counter() - start
        self._loop.call_soon_threadsafe(self._take, analysis)

    def _take(self, analysis: Analysis) -> None:
        """Keeps a result, on the loop."""
        self.results[analysis.uri] = analysis
        self._kinds[analysis.uri] = analysis.kind
        self._done(analysis)
        for future in self._waiting.pop(analysis.uri, ()):
            _succeed(future, analysis)


def _succeed(future: asyncio.Future[T], result: T) -> None:
    if not future.done():
        future.set_result(result)


def _fail(future: asyncio.Future[T], error: Exception) -> None:
    if not future.done():
        future.set_exception(error)
