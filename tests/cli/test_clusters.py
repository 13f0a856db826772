"""Inputs that the workers of a cluster read: the same bytes as by one process, also when a worker
is killed.
"""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.command import environment_of, run_process
from tests.descriptions import CLEAN, STORED
from tests.experiments.study.test_clusters import CLUSTERS
from tests.paths import ROOT

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="workers are killed by signals")

COUNT = 600


@pytest.fixture
def corpus(tmp_path: Path) -> Path:
    """Small descriptions under a configuration, one of which is broken."""
    folder = tmp_path / "corpus"
    folder.mkdir()
    for number in range(COUNT):
        (folder / f"{number:03}.msaa.yaml").write_text(
            (STORED, CLEAN, STORED)[number % 3].replace("color", f"color{number}")
        )
    (folder / "broken.msaa.yaml").write_text("images: {color: {samples: 3}}\n")
    (folder / "msaa-lint.toml").write_text('ignore = ["MSAA403"]\n')
    return folder


def interrupted(process: subprocess.Popen[str], busy: Callable[[], list[int]]) -> None:
    """Interrupts a run once workers are busy."""
    while not busy() and process.poll() is None:
        time.sleep(0.02)
    process.send_signal(signal.SIGINT)


@pytest.mark.parametrize("backend", CLUSTERS)
def test_a_cluster_says_what_one_process_says(
    corpus: Path, backend: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    options = ("check", ".", "--output", "json", "--no-cache")
    expected = run_process(corpus, *options, "--jobs", "1")
    costs = run_process(corpus, "cost", ".", "--each", "--output", "json", "--jobs", "1")
    monkeypatch.setenv("PYTHONPATH", str(ROOT))
    with CLUSTERS[backend]() as (address, busy):
        command = [sys.executable, "-m", "msaa_lint", *options, "--backend", backend]
        pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
        with subprocess.Popen(
            command, cwd=corpus, env=environment_of(address), text=True, **pipes
        ) as running:  # type: ignore[call-overload]
            killed: list[int] = []
            while not killed and running.poll() is None:
                time.sleep(0.01)
                killed = busy()[:1]
            for process in killed:
                os.kill(process, signal.SIGKILL)
            out, error = running.communicate(timeout=120)
        assert killed, f"the run ended before a worker could be killed: {error}"
        assert (running.returncode, error) == (expected.returncode, expected.stderr)
        assert out == expected.stdout
        with subprocess.Popen(
            command, cwd=corpus, env=environment_of(address), text=True, **pipes
        ) as running:  # type: ignore[call-overload]
            interrupted(running, busy)
            out, error = running.communicate(timeout=60)
        assert (running.returncode, out) == (130, ""), error
        # The cluster goes on.
        again = run_process(
            corpus, "cost", ".", "--each", "--output", "json", "--backend", backend, **address
        )
    assert (again.returncode, again.stdout, again.stderr) == (
        costs.returncode,
        costs.stdout,
        costs.stderr,
    )


def test_an_address_needs_an_engine(corpus: Path) -> None:
    done = run_process(corpus, "check", ".", "--cluster", "127.0.0.1:8786")
    assert (done.returncode, done.stdout) == (2, "")
    assert (
        done.stderr
        == "msaa-lint: `--cluster` needs the engine of the cluster: `--backend dask` or `--backend "
        "ray`\n"
    )


def test_a_cluster_that_is_not_there_is_an_error_on_one_line(corpus: Path) -> None:
    pytest.importorskip(
        "distributed", reason="the group of test dependencies has it; not every Python has a wheel"
    )
    done = run_process(corpus, "check", ".", "--backend", "dask", "--cluster", "127.0.0.1:1")
    assert (done.returncode, done.stdout) == (2, "")
    (line,) = done.stderr.splitlines()
    assert line.startswith("msaa-lint: --backend dask: no cluster: ConnectionRefusedError: ")
