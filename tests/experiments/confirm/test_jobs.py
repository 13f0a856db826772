"""`confirm --jobs`: inputs are tried by several processes, and the report is the same bytes as that
of one.
"""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import pytest

from msaa_lint.experiments.confirm import divided_trials
from msaa_lint.experiments.confirm.child import Limits
from msaa_lint.experiments.confirm.inputs import of_file
from msaa_lint.experiments.confirm.outcome import DeviceInfo
from msaa_lint.experiments.confirm.session import SessionOptions
from msaa_lint.experiments.confirm.trial import TrialOptions
from msaa_lint.linter.request import Request
from msaa_lint.linter.workspace import Workspace
from tests.command import environment_of, run_process
from tests.descriptions import CLEAN, STORED
from tests.experiments.confirm.deadly import WIDTH
from tests.experiments.study.test_clusters import CLUSTERS
from tests.paths import ROOT

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="lavapipe is Linux's")

SIZE = "frame: {width: 64, height: 64, fps: 60}\n"
OPTIONS = ("--image", "pictures", "--force")


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Frames of two kinds, some with safe fixes and shaders, one in whose pass the driver dies, one
    that is broken, and a custom rule.

    The names of the pictures of two of them would be the same."""
    frames = tmp_path / "frames"
    (frames / "more").mkdir(parents=True)
    for number in range(6):
        (frames / f"{number}.msaa.yaml").write_text(SIZE + (CLEAN, STORED)[number % 2])
    for name in ("more/6", "more-6"):
        (frames / f"{name}.msaa.yaml").write_text(SIZE + STORED)
    (frames / "3-deadly.msaa.yaml").write_text(SIZE.replace("64", str(WIDTH)) + CLEAN)
    (frames / "4-broken.msaa.yaml").write_text("images: {color: {samples: 3}}\n")
    (frames / "5-example.msaa.yaml").write_text(
        (ROOT / "examples/shader-resolve/note.msaa.yaml").read_text(encoding="utf-8")
    )
    return tmp_path


def confirmed(
    folder: Path, *options: str, before: str = "", paths: tuple[str, ...] = ("frames",)
) -> subprocess.CompletedProcess[str]:
    """The command, whose temporary files are in a folder of their own, in which nothing may be
    left.
    """
    code = f"""if True:
        import os, signal, sys
        from msaa_lint.__main__ import main
        from msaa_lint.experiments.confirm import divided_trials, session
        session.SessionOptions.__new__.__defaults__ = ("tests.experiments.confirm.deadly",)
        {before}
        sys.argv = ["msaa-lint", "confirm", *{(*paths, *OPTIONS, *options)!r}]
        main()
    """
    scratch = folder / "scratch"
    scratch.mkdir(exist_ok=True)
    # Ray has a folder of its own, whose path must be short.
    environment = environment_of({"TMPDIR": str(scratch), "RAY_TMPDIR": tempfile.gettempdir()})
    done = subprocess.run(
        [sys.executable, "-c", code],
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
        env=environment,
    )
    # Dask leaves an empty folder.
    assert [
        path.name for path in scratch.iterdir() if path.name != "dask-scratch-space"
    ] == [] and "Traceback" not in done.stderr
    return done


def test_processes_report_what_one_reports(folder: Path) -> None:
    def outcome(jobs: str) -> tuple[int, str, str, dict[str, bytes]]:
        done = confirmed(folder, *reports, "--jobs", jobs)
        files = [*(folder / "pictures").iterdir(), folder / "report.html", folder / "report.json"]
        return (
            done.returncode,
            done.stdout,
            done.stderr,
            {path.name: path.read_bytes() for path in files},
        )

    reports = ("--output", "full", "--output", "html=report.html", "--output", "json=report.json")
    one = outcome("1")
    assert (
        one[0] == 2
        and "4-broken" in one[2]
        and any("more-6" in name and name.endswith("-2.png") for name in one[3])
    )
    assert outcome("3") == one
    statuses = {
        each["file"]: each["status"] for each in json.loads(one[3]["report.json"])["passes"]
    }
    assert [file for file, status in statuses.items() if status == "driver-died"] == [
        "frames/3-deadly.msaa.yaml"
    ]
    assert len(statuses) == 10 and set(statuses.values()) == {"driver-died", "confirmed"}


@pytest.mark.parametrize("backend", CLUSTERS)
def test_a_cluster_reports_what_one_process_reports(
    folder: Path, backend: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    expected = confirmed(folder, "--output", "json")
    pictures = {path.name: path.read_bytes() for path in (folder / "pictures").iterdir()}
    monkeypatch.setenv("PYTHONPATH", str(ROOT))
    with CLUSTERS[backend]() as (address, _):
        shutil.rmtree(folder / "pictures")
        for name, value in address.items():
            monkeypatch.setenv(name, value)
        found = confirmed(folder, "--output", "json", "--backend", backend)
    assert (found.returncode, found.stdout, found.stderr) == (
        expected.returncode,
        expected.stdout,
        expected.stderr,
    )
    assert {path.name: path.read_bytes() for path in (folder / "pictures").iterdir()} == pictures


def test_no_times_on_a_cluster(folder: Path) -> None:
    done = run_process(folder, "confirm", "frames", "--backend", "dask", "--time")
    assert (done.returncode, done.stdout) == (2, "")
    assert (
        done.stderr == "msaa-lint: `--time` measures times on this machine: leave out `--backend`\n"
    )


def test_an_idle_device_closes_and_opens_again(folder: Path) -> None:
    """The worker of a cluster is not told that a run has ended."""
    inputs = of_file(Workspace(Request([])), str(folder / "frames/1.msaa.yaml"))
    device = divided_trials._Device(
        SessionOptions("llvmpipe", False, Limits()), TrialOptions(), 0.01
    )
    first = device.outcome(inputs)
    assert device._timer is not None and first.verdicts
    device._timer.join()
    assert device._session is None
    assert device.outcome(inputs) == first
    device.close()


def test_workers_with_different_devices_are_no_device() -> None:
    merged = divided_trials._Merged(SessionOptions(None, False, Limits()), TrialOptions())
    for name in ("A", "A", "B", "A"):
        merged.add(divided_trials.Outcome(DeviceInfo(name, driver="1.0")))
    assert (
        merged.run().unusable
        == "the workers of the cluster have different devices, A (1.0) and B (1.0): name one with "
        "`--device`"
    )


def test_each_device_has_its_verdicts(folder: Path) -> None:
    devices = (
        "--device",
        "llvmpipe",
        "--device",
        "nothing of this name",
        "--output",
        "json",
        "--no-time",
    )
    one, two = (confirmed(folder, *devices, "--jobs", jobs) for jobs in ("1", "2"))
    assert (one.returncode, one.stdout, one.stderr) == (two.returncode, two.stdout, two.stderr)
    found = json.loads(two.stdout)["devices"]
    assert (len(found[0]["passes"]) >= 10, found[1]["passes"]) == (True, [])
    assert "there is no device named nothing of this name" in found[1]["unusable"]


def test_an_input_that_ends_processes_is_the_only_one_lost(folder: Path) -> None:
    poison = """
        read = divided_trials.of_file
        def poisonous(workspace, path):
            if path == "frames/2.msaa.yaml":
                os.kill(os.getpid(), signal.SIGKILL)
            return read(workspace, path)
        divided_trials.of_file = poisonous"""
    done = confirmed(folder, "--output", "json", "--jobs", "2", before=poison)
    expected = json.loads(confirmed(folder, "--output", "json").stdout)
    found = json.loads(done.stdout)
    assert done.returncode == 2
    assert [each for each in expected["passes"] if each not in found["passes"]] == [
        each for each in expected["passes"] if each["file"] == "frames/2.msaa.yaml"
    ]
    assert [each["message"] for each in found["errors"] if each not in expected["errors"]] == [
        "not linted: it ended the process that read it (SIGKILL): memory probably ran out; use "
        "fewer `--jobs` or more memory"
    ]


def test_times_are_measured_alone(folder: Path) -> None:
    """Times differ from run to run, so that what else is done at the same time would show in
    them.
    """
    forked = "divided_trials.divided_trials = None"
    paths = ("frames/0.msaa.yaml", "frames/2.msaa.yaml")
    done = confirmed(
        folder,
        "--time",
        "--repeats",
        "2",
        "--output",
        "json",
        "--jobs",
        "3",
        before=forked,
        paths=paths,
    )
    assert all(each["time_ms"] for each in json.loads(done.stdout)["passes"])
    shown = run_process(folder, "confirm", "--help").stdout
    assert "unless times are measured" in " ".join(shown.split())
