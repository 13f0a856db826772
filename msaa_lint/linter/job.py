"""Linting in other processes: in copies of this one, which know what it knows, and in those that
what they need travels to.
"""

from __future__ import annotations

import os
import pickle
import threading
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import chdir, contextmanager
from typing import Any, Generic, NamedTuple

from msaa_lint.core.execution.backend import Unusable
from msaa_lint.core.text.files import content, recording, with_buffers

from .input_runs import InputRuns, Linter, Part, Task
from .request import Request
from .rules.page_files import pages
from .settings.config import KnownConfigurations, Loaded
from .workspace import Workspace


class Snapshot(NamedTuple):
    """What linting depends on besides the inputs.

    `folder` is the current one, `linter` creates what reads inputs, `current` is the path of the
    configuration of the current folder, and `configurations` are all of them by path. `files` are
    the contents of the files that the settings name, such as rule pages, by absolute path.
    """

    request: Request
    folder: str
    linter: Callable[[Workspace], Linter[Any]]
    current: str | None
    configurations: Mapping[str | None, Loaded]
    files: Mapping[str, bytes]


class Job(Generic[Part]):
    """Lints tasks, in this process and in its copies. Elsewhere it is a `TravelledJob`."""

    def __init__(self, runs: InputRuns[Part]) -> None:
        self._runs = runs
        self._data: bytes | None = None

    def __call__(self, task: Task) -> list[Part]:
        """What the units of a task add to the result."""
        return self._runs.parts_of(task)

    def __reduce__(self) -> tuple[type[TravelledJob], tuple[bytes]]:
        if self._data is None:
            self._data = pickle.dumps(_snapshot(self._runs))
        return TravelledJob, (self._data,)


class TravelledJob:
    """Lints tasks in a process that knows nothing of the run, and prepares it once."""

    _lock = threading.Lock()
    """One task at a time: the current folder is that of the process."""

    _prepared: tuple[bytes, Snapshot, InputRuns[Any]] | None = None

    def __init__(self, data: bytes) -> None:
        self._data = data

    def __reduce__(self) -> tuple[type[TravelledJob], tuple[bytes]]:
        return TravelledJob, (self._data,)

    def __call__(self, task: Task) -> list[Any]:
        """What the units of a task add to the result. Raises Unusable if this machine lacks the
        folder that their paths are relative to.
        """
        with self._lock:
            snapshot, runs = self._prepare()
            with _as_stated(snapshot):
                return runs.parts_of(task)

    def _prepare(self) -> tuple[Snapshot, InputRuns[Any]]:
        known = TravelledJob._prepared
        if known is None or known[0] != self._data:
            snapshot: Snapshot = pickle.loads(self._data)
            with _as_stated(snapshot):
                known = TravelledJob._prepared = (self._data, snapshot, _runs(snapshot))
        return known[1], known[2]


@contextmanager
def _as_stated(snapshot: Snapshot) -> Iterator[None]:
    """The folder and the files of a run. Raises Unusable if this machine lacks the folder."""
    if not os.path.isdir(snapshot.folder):
        import socket

        where = f"the worker on {socket.gethostname()} has no folder {snapshot.folder}"
        raise Unusable(f"{where}: inputs must have the same paths on all machines, or be URLs")
    with chdir(snapshot.folder), with_buffers(snapshot.files):
        yield


def _snapshot(runs: InputRuns[Part]) -> Snapshot:
    workspace = runs.linter.workspace
    request = workspace.request._replace(overrides=_with_pages(workspace.request.overrides))
    with recording() as opened:
        # What was read for the settings is read again, to see what that is.
        again = Workspace(workspace.request, workspace.configurations)
        for path in workspace.loaded.values():
            again.resolve_loaded(path)
    configurations = {
        key: loaded._replace(settings=loaded.settings._replace(rules=_pages(loaded.settings.rules)))
        for key, loaded in workspace.loaded.items()
    }
    files = {
        path: data
        for path, project in opened.files.items()
        if (data := content(path, project)) is not None
    }
    return Snapshot(
        request,
        os.getcwd(),
        runs.linter.travelling(),
        workspace.current.configuration,
        configurations,
        files,
    )


def _with_pages(overrides: Mapping[str, object]) -> dict[str, object]:
    rules = overrides.get("rules")
    return {
        **overrides,
        **({"rules": list(_pages(rules))} if isinstance(rules, Sequence) and rules else {}),
    }


def _pages(paths: Sequence[str]) -> tuple[str, ...]:
    """Rule pages, those of folders among them one by one."""
    return tuple(
        os.path.abspath(page)
        for path in paths
        for page in (pages(path) if os.path.isdir(path) else [path])
    )


def _runs(snapshot: Snapshot) -> InputRuns[Any]:
    workspace = Workspace(
        snapshot.request, KnownConfigurations(snapshot.configurations, snapshot.current)
    )
    return InputRuns(snapshot.linter(workspace), ())
