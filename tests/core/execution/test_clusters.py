"""Tasks on clusters of Dask and Ray, each started once."""

from __future__ import annotations

import functools
import socket
import sys
import threading
from collections import Counter
from pathlib import Path
from typing import Any

import pytest

from msaa_lint.core.execution import dask_cluster, ray_cluster
from msaa_lint.core.execution.backend import Backend, Failure, Unusable
from msaa_lint.core.execution.engines import open_backend
from msaa_lint.core.execution.processes import Processes

from . import work
from .conftest import PACKAGES, Backends

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="workers are killed by signals")

MODULES: dict[str, Any] = {"dask": dask_cluster, "ray": ray_cluster}


def test_work_travels_once_to_each_worker(cluster: Backend, tmp_path: Path) -> None:
    found = [
        result
        for _, result in cluster.results(work.Heavy(str(tmp_path)), work.numbers(30), work.split)
    ]
    assert Counter((tmp_path / "loaded").read_text().split()) == {
        str(process): 1 for process in set(found)
    }


def test_what_cannot_travel_is_said(cluster: Backend) -> None:
    found = dict(cluster.results(work.unpicklable, work.numbers(9), work.split))
    assert found.pop((7,)) == Failure("ValueError: it stays here")
    assert found == {(number,): [number * number] for number in range(9) if number != 7}
    with pytest.raises(
        Unusable, match=r"^the worker at \S+ cannot load what it should do: TypeError: "
    ):
        list(cluster.results(work.Broken(), work.numbers(9), work.split))


def test_closing_the_results_cancels_tasks(cluster: Backend, tmp_path: Path) -> None:
    """Those that workers have begun go on with Dask; the others are not begun."""
    results = cluster.results(
        functools.partial(work.brief_then_long, str(tmp_path)), work.numbers(200), work.split
    )
    for _ in range(work.BRIEF):
        next(results)
    results.close()  # type: ignore[attr-defined]
    assert (
        len(
            list(
                cluster.results(functools.partial(work.process, 200), work.numbers(10), work.split)
            )
        )
        == 10
    )
    begun = [int(number) for number in (tmp_path / "begun").read_text().split()]
    assert work.BRIEF <= len(begun) == len(set(begun)) <= work.BRIEF + 4


def test_workers_of_another_version_are_refused(
    name: str, cluster: Backend, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(MODULES[name], "VERSION", "9.9.9")
    with pytest.raises(
        Unusable,
        match=r"^the worker at \S+ has msaa-lint \d+\.\d+\.\d+, and this process 9\.9\.9; ",
    ):
        list(cluster.results(work.squares, work.numbers(3), work.split))


def test_a_package_that_is_not_installed_is_said(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, PACKAGES[name], None)
    with pytest.raises(
        Unusable,
        match=rf"^{PACKAGES[name]} is not installed: run `.*pip install {PACKAGES[name]}`$",
    ):
        open_backend(name, None, 2)


@pytest.mark.parametrize("scheme", ["", "tcp://"])
def test_an_address_where_nothing_listens_is_said(scheme: str) -> None:
    """With Ray, only a process that is not connected yet looks at it: tests of the study have
    one.
    """
    pytest.importorskip("distributed")
    with socket.create_server(("127.0.0.1", 0)) as server:
        port = server.getsockname()[1]
    with pytest.raises(Unusable, match=r"^no cluster: ConnectionRefusedError: "):
        open_backend("dask", f"{scheme}127.0.0.1:{port}", None)


def test_without_a_name_there_are_processes() -> None:
    backend = open_backend(None, None, 3)
    assert isinstance(backend, Processes) and backend.workers == 3
    with pytest.raises(Unusable, match="needs `--backend`"):
        open_backend(None, "127.0.0.1:8786", None)


def test_a_cluster_that_exists_goes_on(backends: Backends) -> None:
    """Some of its workers may be asked for."""
    own = backends.cluster("dask")
    assert isinstance(own, dask_cluster.DaskCluster)
    address = own._cluster.scheduler_address.removeprefix("tcp://")
    for workers in (None, 1):
        other = open_backend("dask", address, workers)
        found = {
            result
            for _, result in other.results(
                functools.partial(work.process, 1), work.numbers(20), work.split
            )
        }
        assert other.workers == len(found) == (workers or 2)
        other.close()
    assert len(list(own.results(work.squares, work.numbers(5), work.split))) == 5


def test_threads_of_a_worker_take_turns(tmp_path: Path) -> None:
    distributed = pytest.importorskip("distributed")
    with distributed.LocalCluster(
        n_workers=1, threads_per_worker=4, dashboard_address="127.0.0.1:0"
    ) as cluster:
        backend = dask_cluster.DaskCluster(cluster.scheduler_address)
        found = [
            result
            for _, result in backend.results(
                functools.partial(work.overlaps, str(tmp_path)), work.numbers(20), work.split
            )
        ]
        assert found == [False] * 20
        backend.close()


def test_workers_that_join_are_waited_for(monkeypatch: pytest.MonkeyPatch) -> None:
    distributed = pytest.importorskip("distributed")
    monkeypatch.setattr(dask_cluster, "POLL_SECONDS", 0.1)
    with distributed.LocalCluster(
        n_workers=0, threads_per_worker=1, dashboard_address="127.0.0.1:0"
    ) as cluster:
        backend = dask_cluster.DaskCluster(cluster.scheduler_address)
        assert backend.workers == 0
        joining = threading.Timer(0.5, cluster.scale, [1])
        joining.start()
        assert len(list(backend.results(work.squares, work.numbers(20), work.split))) == 20
        joining.join()
        cluster.scale(0)
        monkeypatch.setattr(dask_cluster, "JOIN_SECONDS", 0.5)
        with pytest.raises(Unusable, match=r"^the cluster has had no worker for 0\.5 s$"):
            list(backend.results(work.sleep, work.numbers(1), work.split))
        backend.close()


def test_an_adaptive_cluster_starts_workers_for_tasks() -> None:
    distributed = pytest.importorskip("distributed")
    with distributed.LocalCluster(
        n_workers=0, threads_per_worker=1, dashboard_address="127.0.0.1:0"
    ) as cluster:
        cluster.adapt(minimum=0, maximum=1, interval="100 ms")
        backend = dask_cluster.DaskCluster(cluster.scheduler_address)
        assert len(list(backend.results(work.squares, work.numbers(20), work.split))) == 20
        backend.close()


def test_a_scheduler_that_ends_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    distributed = pytest.importorskip("distributed")
    monkeypatch.setattr(dask_cluster, "CONNECT_SECONDS", 1.0)
    cluster = distributed.LocalCluster(
        n_workers=1, threads_per_worker=1, dashboard_address="127.0.0.1:0"
    )
    backend = dask_cluster.DaskCluster(cluster.scheduler_address)
    results = backend.results(functools.partial(work.process, 50), work.numbers(1000), work.split)
    next(results)
    cluster.close()
    with pytest.raises(Unusable, match="scheduler"):
        list(results)
    backend.close()


def test_a_cluster_without_processors_is_said(
    backends: Backends, monkeypatch: pytest.MonkeyPatch
) -> None:
    cluster = backends.cluster("ray")
    monkeypatch.setattr(ray_cluster, "POLL_SECONDS", 0.1)
    monkeypatch.setattr(ray_cluster, "JOIN_SECONDS", 0.5)
    monkeypatch.setattr(cluster, "_processors", lambda: 0)
    with pytest.raises(Unusable, match=r"^the cluster has had no processors for 0\.5 s$"):
        list(cluster.results(work.sleep, work.numbers(2), work.split))
