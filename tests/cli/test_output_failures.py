"""Standard output that cannot be written ends every command in one line and with exit code 2, and a
closed pipe in none.
"""

from __future__ import annotations

import errno
import gc
import io
import os
import subprocess
import sys
from pathlib import Path
from unittest import mock

import pytest

from msaa_lint.__main__ import main
from msaa_lint.linter.settings.settings import OUTPUT_FORMATS
from tests.command import environment_of
from tests.experiments.study.test_record import FRAME
from tests.paths import ROOT

COMMANDS = (
    "--version", "--help", "check --help", "--show-completion bash",
    "check --isolated frame.msaa.yaml", "check --isolated --statistics frame.msaa.yaml",
    "check --isolated --diff frame.msaa.yaml",
    *(f"check --isolated --output {format} frame.msaa.yaml" for format in OUTPUT_FORMATS),
    "check --isolated --fix -",
    *(f"cost --isolated --output {format} frame.msaa.yaml" for format in ("full", "json",
    "markdown")),
    "study --list-scenes",
    "rule MSAA201", "rule MSAA901", "rule --all", "rule --all --output json", "rule --all --output "
        "markdown",
    "facts", "facts --output json", "facts --output markdown", "facts frame.msaa.yaml",
    "facts frame.msaa.yaml --output json",
    "device mali-g76", "device mali-g76 --output json", "device mali-g76 --output description",
    "device --list",
    "schema", "schema json-v1", "convert capture.jsonl", "init new",
)  # fmt: skip


class Broken(io.RawIOBase):
    """A file of which every write fails, until its error number is 0."""

    def __init__(self, number: int) -> None:
        self.number = number

    def writable(self) -> bool:
        return True

    def write(self, data: object) -> int:
        if self.number:
            raise OSError(self.number, os.strerror(self.number))
        return len(data)  # type: ignore[arg-type]


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("streams")
    (path / "frame.msaa.yaml").write_text(FRAME.replace("storeOp: DONT_CARE", "storeOp: STORE"))
    (path / "capture.jsonl").write_bytes((ROOT / "examples/capture/forward.jsonl").read_bytes())
    return path


def run_broken(
    folder: Path, words: str, number: int, monkeypatch: pytest.MonkeyPatch
) -> tuple[int, str]:
    """The exit code of a command whose standard output fails, and its standard error; standard
    output is closed if `number` is 0.
    """
    broken = Broken(number)
    out = io.TextIOWrapper(io.BufferedWriter(broken)) if number else None
    errors = io.TextIOWrapper(io.BytesIO(), encoding="utf-8")
    monkeypatch.chdir(folder)
    for name, value in (
        ("stdin", io.TextIOWrapper(io.BytesIO((folder / "frame.msaa.yaml").read_bytes()))),
        ("stdout", out),
        ("stderr", errors),
    ):
        monkeypatch.setattr(sys, name, value)
    monkeypatch.setattr(sys, "argv", ["msaa-lint", *words.split()])
    # typer asks which shell it was started from, which may be one that it has no completion for.
    monkeypatch.setattr("shellingham.detect_shell", lambda *_: ("bash", "/bin/bash"))
    with (
        mock.patch.dict(os.environ, environment_of({}), clear=True),
        pytest.raises(SystemExit) as end,
    ):
        try:
            main()
        finally:
            gc.unfreeze()
            gc.enable()
    broken.number = 0
    errors.flush()
    assert isinstance(end.value.code, int)
    return end.value.code, errors.buffer.getvalue().decode()  # type: ignore[attr-defined]


@pytest.mark.parametrize("words", COMMANDS)
@pytest.mark.parametrize(
    ("number", "reason"),
    [(errno.ENOSPC, os.strerror(errno.ENOSPC)), (errno.EPIPE, ""), (0, "it is closed")],
    ids=["full", "pipe", "closed"],
)
def test_standard_output_fails(
    folder: Path, words: str, number: int, reason: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    code, errors = run_broken(folder, words, number, monkeypatch)
    lines = [
        line
        for line in errors.splitlines()
        if not line.startswith(("msaa-lint: wrote ", "msaa-lint: new", "msaa-lint: 3 "))
    ]
    assert (code, lines) == (
        2,
        [f"msaa-lint: cannot write to standard output: {reason}"] if reason else [],
    )


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="the system has no /dev/full")
@pytest.mark.parametrize("words", ["schema", "check --isolated frame.msaa.yaml"])
@pytest.mark.parametrize(
    "redirection", [">/dev/full", ">&-", "2>/dev/full", "2>&-", "<&-", ">/dev/full 2>&-"]
)
def test_real_streams_fail(folder: Path, words: str, redirection: str) -> None:
    """The interpreter has nothing to add when it closes its streams."""
    command = f"{sys.executable} -m msaa_lint {words} {redirection}"
    done = subprocess.run(
        ["sh", "-c", command],
        cwd=folder,
        env=environment_of({}),
        capture_output=True,
        text=True,
        check=False,
    )
    fails = redirection.startswith(">")
    assert done.returncode == (2 if fails else 1 if words.startswith("check") else 0)
    assert done.stderr.count("\n") == (1 if fails and "2>" not in redirection else 0)
    if "2>" in redirection:
        # What is meant for standard error is not in the report.
        assert "msaa-lint: " not in done.stdout


def test_the_current_folder_is_gone(tmp_path: Path) -> None:
    command = f"mkdir gone; cd gone; rmdir ../gone; {sys.executable} -P -m msaa_lint check ."
    done = subprocess.run(
        ["sh", "-c", command],
        cwd=tmp_path,
        env=environment_of({}),
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stderr.count("\n")) == (2, 1), done.stderr
    assert done.stderr.startswith("msaa-lint: the current folder cannot be used: ")
