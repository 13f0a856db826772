"""Sweeps on clusters of Dask and Ray, started here: the same bytes as in one process, also when a
worker is killed in the middle.
"""

from __future__ import annotations

import contextlib
import os
import secrets
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from tests.command import environment_of, run, run_process
from tests.paths import ROOT

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="workers are killed by signals")

ARGUMENTS = ("study", "zone-plate", "--size", "192x108", "--samples", "1,2,4,8", "--output", "json")

Workers = Callable[[], list[int]]
"""The process ids of the workers that are computing something."""


@contextmanager
def dask_cluster() -> Iterator[tuple[dict[str, str], Workers]]:
    """Two workers of a thread each."""
    distributed = pytest.importorskip(
        "distributed", reason="the group of test dependencies has it; not every Python has a wheel"
    )
    cluster = distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None)
    with cluster, distributed.Client(cluster) as client:
        ids = client.run(os.getpid)
        yield (
            {"DASK_SCHEDULER_ADDRESS": cluster.scheduler_address},
            lambda: [
                ids[worker]
                for worker, keys in client.processing().items()
                if keys and worker in ids
            ],
        )


RAY_NODE = """
import ray, sys
address = ray.init(num_cpus=2, include_dashboard=False, logging_level="ERROR", log_to_driver=False).address_info["gcs_address"]
print(address, flush=True)
sys.stdin.read()
"""
"""Starts a node of two processors, prints its address, and ends when its standard input does."""


@contextmanager
def ray_cluster() -> Iterator[tuple[dict[str, str], Workers]]:
    """A node of two processors that asks for a token, as Ray's do unless told otherwise."""
    pytest.importorskip(
        "ray", reason="the group of test dependencies has it; not every Python has a wheel"
    )
    psutil = pytest.importorskip("psutil", reason="comes with distributed")
    settings = {
        "RAY_AUTH_MODE": "token",
        "RAY_AUTH_TOKEN": secrets.token_hex(32),
        "RAY_USAGE_STATS_ENABLED": "0",
    }
    with subprocess.Popen(
        [sys.executable, "-c", RAY_NODE],
        env=environment_of(settings),
        text=True,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
    ) as node:
        assert node.stdin is not None and node.stdout is not None

        def workers() -> list[int]:
            """A worker of Ray has the name of the task that it does as its title."""
            busy = []
            for process in psutil.Process(node.pid).children(recursive=True):
                with contextlib.suppress(psutil.Error):
                    if "ray::msaa-lint" in " ".join(process.cmdline()):
                        busy.append(process.pid)
            return busy

        try:
            yield {"RAY_ADDRESS": node.stdout.readline().strip(), **settings}, workers
        finally:
            node.stdin.close()


CLUSTERS = {"dask": dask_cluster, "ray": ray_cluster}


@pytest.mark.parametrize("backend", CLUSTERS)
def test_a_cluster_gives_the_same_bytes_also_when_a_worker_is_killed(
    tmp_path: Path, backend: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    wanted = run(tmp_path, *ARGUMENTS, "--jobs", "1").stdout
    monkeypatch.setenv("PYTHONPATH", str(ROOT))
    with CLUSTERS[backend]() as (address, workers):
        command = [
            sys.executable,
            "-m",
            "msaa_lint",
            *ARGUMENTS,
            "--backend",
            backend,
            "--resume",
            "points",
        ]
        with subprocess.Popen(
            command,
            cwd=tmp_path,
            env=environment_of(address),
            text=True,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
        ) as running:
            killed = []
            while not killed and running.poll() is None:
                time.sleep(0.02)
                # Some points are finished, and others are under way.
                if len(list(tmp_path.glob("points/zone-plate-*.json"))) > 2:
                    killed = workers()[:1]
            for process in killed:
                os.kill(process, signal.SIGKILL)
            out, error = running.communicate(timeout=120)
    assert killed, f"the study ended before a worker could be killed: {error}"
    assert (running.returncode, out) == (0, wanted), error


@pytest.mark.parametrize(
    ("backend", "variable"), [("dask", "DASK_SCHEDULER_ADDRESS"), ("ray", "RAY_ADDRESS")]
)
def test_a_cluster_that_is_not_there_is_an_error_on_one_line(
    tmp_path: Path, backend: str, variable: str
) -> None:
    pytest.importorskip({"dask": "distributed", "ray": "ray"}[backend])
    settings = {variable: "127.0.0.1:1"}
    limits = {"DASK_DISTRIBUTED__COMM__TIMEOUTS__CONNECT": "2s"}
    done = run_process(tmp_path, *ARGUMENTS, "--backend", backend, **settings, **limits)
    assert done.returncode == 2 and done.stdout == "", done.stderr
    assert done.stderr.splitlines()[-1].startswith(
        f"msaa-lint: --backend {backend}: no cluster: "
    ), done.stderr
