"""The files that commands write: never through a link, and an old file stays until the new one is whole."""

from __future__ import annotations

import os
import stat
from pathlib import Path
from unittest import mock

import pytest

from tests.command import run, run_process
from tests.paths import ROOT

FRAME = "images: {a: {format: R8G8B8A8_UNORM, samples: 4}}\n"
COMMANDS = {
    "check": ("check", "--isolated", "--output", "gitlab=report.json", "frame.msaa.yaml"),
    "cost": ("cost", "--isolated", "--output", "json=report.json", "frame.msaa.yaml"),
}


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "project").mkdir()
    (tmp_path / "project" / "frame.msaa.yaml").write_text(FRAME)
    (tmp_path / "secret").write_text("keep")
    return tmp_path / "project"


@pytest.mark.parametrize("command", COMMANDS)
def test_a_report_is_never_written_through_a_link(command: str, folder: Path) -> None:
    """A committed link called as the report is would let a branch overwrite any file of the job."""
    (folder / "report.json").symlink_to(folder.parent / "secret")
    done = run(folder, *COMMANDS[command])
    assert done.returncode in (0, 1), done.stderr
    assert (folder.parent / "secret").read_text() == "keep"
    assert not (folder / "report.json").is_symlink() and (folder / "report.json").read_text().startswith(("[", "{"))


def test_an_old_report_keeps_its_mode_and_stays_if_the_new_one_fails(folder: Path) -> None:
    report = folder / "report.json"
    report.write_text("old")
    report.chmod(0o640)
    with mock.patch("msaa_lint.cli.report.gitlab.render", side_effect=OSError(28, "No space left on device")):
        done = run(folder, *COMMANDS["check"])
    assert (done.returncode, report.read_text()) == (2, "old")
    assert done.stderr == "msaa-lint: cannot write report.json: No space left on device\n"
    run(folder, *COMMANDS["check"])
    assert report.read_text() != "old" and stat.S_IMODE(report.stat().st_mode) == 0o640
    assert sorted(os.listdir(folder)) == ["frame.msaa.yaml", "report.json"]


def test_a_stream_is_written_to(folder: Path) -> None:
    """`/dev/stdout` is a link as well, to what standard output is: here to a file."""
    if not os.path.exists("/dev/stdout"):
        pytest.skip("the system has no /dev/stdout")
    link = os.readlink("/dev/stdout")
    done = run_process(folder, "check", "--isolated", "--output", "json=/dev/stdout", "frame.msaa.yaml")
    assert done.stdout.startswith("{")
    assert os.readlink("/dev/stdout") == link


def test_convert_replaces_a_link_and_not_what_it_leads_to(folder: Path) -> None:
    (folder / "out.yaml").symlink_to(folder.parent / "secret")
    capture = (ROOT / "examples/capture/forward.jsonl").as_posix()
    refused = run(folder, "convert", capture, "-o", "out.yaml")
    assert (refused.returncode, (folder / "out.yaml").is_symlink()) == (2, True)
    done = run(folder, "convert", capture, "-o", "out.yaml", "--force")
    assert done.returncode == 0, done.stderr
    assert (folder.parent / "secret").read_text() == "keep"
    assert not (folder / "out.yaml").is_symlink() and "renderPasses:" in (folder / "out.yaml").read_text()
