"""The files that commands write: never through a link, and an old file stays until the new one is
whole.
"""

from __future__ import annotations

import os
import stat
import subprocess
import sys
from pathlib import Path
from unittest import mock

import pytest

from msaa_lint.cli import convert
from msaa_lint.cli.common import UsageError
from tests.command import environment_of, run, run_process
from tests.linter.fixes.test_fixer import STORED
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
    assert not (folder / "report.json").is_symlink() and (
        folder / "report.json"
    ).read_text().startswith(("[", "{"))


def test_an_old_report_keeps_its_mode_and_stays_if_the_new_one_fails(folder: Path) -> None:
    report = folder / "report.json"
    report.write_text("old")
    report.chmod(0o640)
    with mock.patch(
        "msaa_lint.cli.report.gitlab.render", side_effect=OSError(28, "No space left on device")
    ):
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
    done = run_process(
        folder, "check", "--isolated", "--output", "json=/dev/stdout", "frame.msaa.yaml"
    )
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
    assert (
        not (folder / "out.yaml").is_symlink()
        and "renderPasses:" in (folder / "out.yaml").read_text()
    )


def outside_link(folder: Path, name: str) -> Path:
    """A link in a project, as a branch may bring it, to a folder outside; returns the folder."""
    (folder / ".git").mkdir(exist_ok=True)
    outside = folder.parent / "outside"
    outside.mkdir(exist_ok=True)
    (folder / name).symlink_to(outside)
    return outside


@pytest.mark.parametrize(
    "words",
    [
        "check --isolated --output json=out/report.json frame.msaa.yaml",
        "cost --isolated --output json=out/report.json frame.msaa.yaml",
        "baseline --isolated --file out/baseline.json frame.msaa.yaml",
        "convert capture.jsonl -o out/frame.yaml",
        "init out",
    ],
)
def test_a_folder_that_is_a_link_out_of_the_project_is_refused(words: str, folder: Path) -> None:
    outside = outside_link(folder, "out")
    (folder / "capture.jsonl").write_bytes((ROOT / "examples/capture/forward.jsonl").read_bytes())
    done = run(folder, *words.split())
    assert (done.returncode, os.listdir(outside)) == (2, [])
    assert (
        "`out` is a link that leads out of the project; name the place that it leads to"
        in done.stderr
    )


def test_the_place_that_a_link_leads_to_can_be_named(folder: Path) -> None:
    outside = outside_link(folder, "out")
    done = run(
        folder, "check", "--isolated", "--output", f"json={outside}/report.json", "frame.msaa.yaml"
    )
    assert (done.returncode, os.listdir(outside)) == (0, ["report.json"])


def test_a_link_inside_the_project_is_followed_to_a_folder(folder: Path) -> None:
    (folder / "build-1").mkdir()
    (folder / "build").symlink_to("build-1")
    run(folder, "check", "--isolated", "--output", "json=build/report.json", "frame.msaa.yaml")
    assert os.listdir(folder / "build-1") == ["report.json"]


def test_shaders_of_a_capture_are_not_written_through_a_link(folder: Path) -> None:
    outside = outside_link(folder, "shaders")
    modules = {"shaders/a.spv": b"new"}
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        with pytest.raises(UsageError, match="leads out of the project"):
            convert._write("images: {}\n", modules, "frame.yaml", False)
        (folder / "shaders").unlink()
        (folder / "shaders").mkdir()
        (folder / "shaders" / "a.spv").write_bytes(b"other")
        with pytest.raises(UsageError, match="msaa-lint did not write the file"):
            convert._write("images: {}\n", modules, "frame.yaml", False)
        assert not (folder / "frame.yaml").exists()
        convert._write("images: {}\n", modules, "frame.yaml", True)
    assert os.listdir(outside) == [] and (folder / "shaders" / "a.spv").read_bytes() == b"new"


def test_a_link_to_a_device_or_a_pipe_is_replaced(folder: Path) -> None:
    """To write to it would wait for a reader of the pipe, or fill the device."""
    if not hasattr(os, "mkfifo"):
        pytest.skip("the system has no named pipes")
    os.mkfifo(folder.parent / "pipe")
    (folder / "report.json").symlink_to(folder.parent / "pipe")
    done = run(folder, *COMMANDS["check"])
    assert done.returncode == 0 and stat.S_ISREG((folder / "report.json").lstat().st_mode)


def test_dev_null_is_written_to_by_several(folder: Path) -> None:
    outputs = (
        "--output",
        "json=/dev/null",
        "--output",
        "sarif=/dev/null",
        "--output",
        "markdown=/dev/stdout",
    )
    done = run_process(folder, "check", "--isolated", *outputs, "frame.msaa.yaml")
    assert done.returncode == 0 and done.stdout.startswith("<!-- msaa-lint -->")
    assert stat.S_ISCHR(os.stat("/dev/null").st_mode)


@pytest.mark.parametrize(
    "other", ["report.json", "./report.json", "sub/../report.json", "link.json"]
)
def test_two_outputs_in_one_file_are_refused(other: str, folder: Path) -> None:
    (folder / "sub").mkdir()
    (folder / "link.json").symlink_to("report.json")
    done = run(
        folder,
        "check",
        "--isolated",
        "--output",
        "json=report.json",
        "--output",
        f"sarif={other}",
        "frame.msaa.yaml",
    )
    assert (done.returncode, (folder / "report.json").exists()) == (2, False)
    assert done.stderr == f"msaa-lint: two outputs go to {other}; write each to a file of its own\n"


@pytest.mark.parametrize(
    "words",
    [
        "check --output json=frame.msaa.yaml frame.msaa.yaml",
        "check --output json=./frame.msaa.yaml .",
        "check --output json=hard.yaml frame.msaa.yaml",
        "cost --output json=frame.msaa.yaml frame.msaa.yaml",
        "cost --output json=frame.msaa.yaml .",
        "confirm --output json=frame.msaa.yaml frame.msaa.yaml",
        "baseline --file frame.msaa.yaml frame.msaa.yaml",
        "baseline --file frame.msaa.yaml .",
        "convert frame.msaa.yaml --force -o frame.msaa.yaml",
    ],
)
def test_an_input_is_never_an_output(words: str, folder: Path) -> None:
    os.link(folder / "frame.msaa.yaml", folder / "hard.yaml")
    done = run(folder, *words.split())
    assert (done.returncode, (folder / "frame.msaa.yaml").read_text()) == (2, FRAME)
    assert (
        done.stderr.count("\n") == 1
        and "is an input, which the output would replace" in done.stderr
    )


def test_the_default_baseline_replaces_only_a_baseline(folder: Path) -> None:
    path = folder / "msaa-lint-baseline.json"
    path.write_text('{"mine": 1}')
    done = run(folder, "baseline", "--isolated", "frame.msaa.yaml")
    assert (done.returncode, path.read_text()) == (2, '{"mine": 1}')
    assert (
        done.stderr
        == "msaa-lint: cannot write msaa-lint-baseline.json: msaa-lint did not write the file that "
        "is there\n"
    )
    assert (
        run(folder, "baseline", "--isolated", "frame.msaa.yaml", "--file", path.name).returncode
        == 0
    )
    assert run(folder, "baseline", "--isolated", "frame.msaa.yaml").returncode == 0


@pytest.mark.parametrize(
    "words", ["check --output json=report.json", "check --fix", "baseline --file report.json"]
)
def test_a_read_only_file_stays(words: str, folder: Path) -> None:
    (folder / "frame.msaa.yaml").write_text(STORED)
    for name in ("report.json", "frame.msaa.yaml"):
        (folder / name).touch()
        (folder / name).chmod(0o444)
    done = run(folder, *words.split(), "--isolated", "frame.msaa.yaml")
    assert done.returncode == 2 and "the file is read-only" in done.stdout + done.stderr
    assert ((folder / "report.json").read_text(), (folder / "frame.msaa.yaml").read_text()) == (
        "",
        STORED,
    )


@pytest.mark.parametrize("named", ["frame.msaa.yaml", "sub/frame.msaa.yaml"])
def test_a_fix_is_not_written_through_a_link_out_of_the_project(named: str, folder: Path) -> None:
    (folder.parent / "secret.yaml").write_text(STORED)
    (folder / "frame.msaa.yaml").unlink()
    if named.startswith("sub/"):
        outside = outside_link(folder, "sub")
        (outside / "frame.msaa.yaml").write_text(STORED)
    else:
        (folder / ".git").mkdir()
        (folder / "frame.msaa.yaml").symlink_to("../secret.yaml")
    done = run(folder, "check", "--isolated", "--fix", named)
    assert done.returncode == 2
    assert (folder / named).read_text() == STORED and (
        folder.parent / "secret.yaml"
    ).read_text() == STORED


LIMITED = """\
import resource, signal, sys
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
resource.setrlimit(resource.RLIMIT_FSIZE, (20, 20))
from msaa_lint.__main__ import main
main()
"""


@pytest.mark.parametrize(
    "words",
    [
        "check --isolated --output json=report.json frame.msaa.yaml",
        "check --isolated --fix frame.msaa.yaml",
        "cost --isolated --output json=report.json frame.msaa.yaml",
        "baseline --isolated --file report.json frame.msaa.yaml",
        "convert --force capture.jsonl -o report.json",
        "init new",
    ],
)
def test_a_full_disk_leaves_the_old_file_and_nothing_else(words: str, folder: Path) -> None:
    pytest.importorskip("resource")
    (folder / "frame.msaa.yaml").write_text(STORED)
    (folder / "report.json").write_text("old")
    (folder / "new").mkdir()
    (folder / "capture.jsonl").write_bytes((ROOT / "examples/capture/forward.jsonl").read_bytes())
    before = sorted(os.listdir(folder))
    command = [sys.executable, "-c", LIMITED, *words.split()]
    done = subprocess.run(
        command,
        cwd=folder,
        env=environment_of({"PYTHONDONTWRITEBYTECODE": "1"}),
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 2 and "File too large" in done.stdout + done.stderr, done
    assert "Traceback" not in done.stderr and done.stderr.count("\n") <= 2
    assert (sorted(os.listdir(folder)), os.listdir(folder / "new")) == (before, [])
    assert ((folder / "report.json").read_text(), (folder / "frame.msaa.yaml").read_text()) == (
        "old",
        STORED,
    )


@pytest.mark.parametrize("output", ["gone/report.json", "frame.msaa.yaml/report.json", "folder"])
def test_an_output_that_cannot_be_created_is_one_line(output: str, folder: Path) -> None:
    (folder / "folder").mkdir()
    done = run(folder, "check", "--isolated", "--output", f"json={output}", "frame.msaa.yaml")
    assert done.returncode == 2 and done.stderr.startswith(f"msaa-lint: cannot write {output}: ")
    assert done.stderr.count("\n") == 1 and sorted(os.listdir(folder)) == [
        "folder",
        "frame.msaa.yaml",
    ]


@pytest.mark.parametrize(
    "words",
    [
        "confirm --isolated --no-layer --no-time --image out frame.msaa.yaml",
        "cost --isolated --chart out/a.svg frame.msaa.yaml",
        "study --samples 1,2 --techniques msaa --size 96x64 --jobs 1 --crops out edge-fan",
        "study --samples 1,2 --techniques msaa --size 96x64 --jobs 1 --plot out/a.svg edge-fan",
        "study --samples 1,2 --techniques msaa --size 96x64 --jobs 1 --resume out edge-fan",
        "study --samples 1,2 --techniques msaa --size 96x64 --jobs 1 --record frame.msaa.yaml",
    ],
)
def test_pictures_and_records_replace_nothing_of_others(words: str, folder: Path) -> None:
    for package in (
        "altair",
        "vl_convert",
        "numpy",
        *(["vulkan"] if words.startswith("confirm") else []),
    ):
        pytest.importorskip(package)
    outside = outside_link(folder, "out")
    (folder / "frame.msaa.yaml").write_text(STORED)
    (folder / "frame.msaa.yaml.msaa-study.json").write_text('{"mine": 1}')
    done = run_process(folder, *words.split())
    if "no Vulkan" in done.stderr or "libvulkan" in done.stderr:
        pytest.skip("no Vulkan device")
    assert done.returncode == 2, done.stderr
    message = (
        "msaa-lint did not write the file that is there"
        if "--record" in words
        else "`out` is a link that leads out of the project"
    )
    assert done.stderr.count(message) == 1 and done.stderr.count("\n") == 1
    assert (
        os.listdir(outside) == []
        and (folder / "frame.msaa.yaml.msaa-study.json").read_text() == '{"mine": 1}'
    )
