"""What does tasks in the tests: each cluster is started once."""

from __future__ import annotations

import contextlib
import threading
from collections.abc import Iterator

import pytest

from msaa_lint.core.execution import processes as module
from msaa_lint.core.execution.backend import Backend
from msaa_lint.core.execution.engines import open_backend
from msaa_lint.core.execution.processes import Processes, can_copy
from tests.paths import ROOT

PACKAGES = {"dask": "distributed", "ray": "ray"}


class Backends:
    """Backends with two workers, by name; those of clusters go on until all of them end."""

    def __init__(self) -> None:
        self._clusters: dict[str, Backend] = {}

    def cluster(self, name: str) -> Backend:
        """The cluster of an engine."""
        pytest.importorskip(
            PACKAGES[name],
            reason="the group of test dependencies has it; not every Python has a wheel",
        )
        if name not in self._clusters:
            self._clusters[name] = open_backend(name, None, 2)
        return self._clusters[name]

    def close(self) -> None:
        """Ends the clusters."""
        for each in self._clusters.values():
            each.close()

    @contextlib.contextmanager
    def opened(self, name: str) -> Iterator[Backend]:
        """A cluster; or processes, as `copies` of this one or `started anew`, as in a process with
        threads.
        """
        if name in PACKAGES:
            yield self.cluster(name)
        elif name == "copies":
            with pytest.MonkeyPatch.context() as patch:
                # Threads that other tests left are idle.
                patch.setattr(module, "can_copy", lambda: True)
                yield Processes(2)
        else:
            end = threading.Event()
            thread = threading.Thread(target=end.wait)
            thread.start()
            assert not can_copy()
            yield Processes(2)
            end.set()
            thread.join()


@pytest.fixture(scope="package")
def backends() -> Iterator[Backends]:
    """Backends, whose clusters end with the tests of this folder."""
    with pytest.MonkeyPatch.context() as patch:
        for name in ("DASK_SCHEDULER_ADDRESS", "RAY_ADDRESS"):
            patch.delenv(name, raising=False)
        patch.setenv("PYTHONPATH", str(ROOT))
        found = Backends()
        try:
            yield found
        finally:
            found.close()


@pytest.fixture(params=["copies", "started anew", *PACKAGES])
def backend(request: pytest.FixtureRequest, backends: Backends) -> Iterator[Backend]:
    """Each of the backends."""
    with backends.opened(request.param) as found:
        yield found


@pytest.fixture(params=["copies", "started anew"])
def processes(request: pytest.FixtureRequest, backends: Backends) -> Iterator[Backend]:
    """Processes of this machine."""
    with backends.opened(request.param) as found:
        yield found


@pytest.fixture(params=PACKAGES)
def name(request: pytest.FixtureRequest) -> str:
    """The name of an engine."""
    return str(request.param)


@pytest.fixture
def cluster(name: str, backends: Backends) -> Backend:
    """The cluster of an engine."""
    return backends.cluster(name)
