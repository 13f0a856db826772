"""`check --watch`, as a process: each test waits for what is printed, however long that takes."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from threading import Timer

import pytest

from msaa_lint.cli.watch import Watched
from msaa_lint.linter.request import Request
from tests.cli.test_verbosity import CLEAN, STORED
from tests.command import environment_of, run, run_process

pytest.importorskip("watchfiles")

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="ends with a POSIX signal")

LIMIT = 120
"""Seconds after which a process that prints nothing more is killed, which fails its test."""

RULE = "multisampled-attachment-stored"


class Watching:
    """A process that watches."""

    def __init__(self, process: subprocess.Popen[str]) -> None:
        self.process = process

    def screen(self) -> str:
        """What it prints until it waits for changes."""
        assert self.process.stdout is not None
        lines = []
        for line in self.process.stdout:
            lines.append(line)
            if line.endswith("watching for changes; Ctrl-C ends\n"):
                return "".join(lines)
        pytest.fail(f"the process ended after {lines}")

    def interrupt(self) -> tuple[int, str]:
        """The exit code after Ctrl-C, and what was printed last."""
        assert self.process.stdout is not None
        self.process.send_signal(signal.SIGINT)
        rest = self.process.stdout.read()
        return self.process.wait(), rest


@contextmanager
def watching(folder: Path, *arguments: str) -> Iterator[Watching]:
    command = [sys.executable, "-m", "msaa_lint", "check", "--watch", *arguments]
    with subprocess.Popen(
        command,
        cwd=folder,
        env=environment_of({}),
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        encoding="utf-8",
    ) as process:
        timer = Timer(LIMIT, process.kill)
        timer.start()
        try:
            yield Watching(process)
        finally:
            timer.cancel()
            process.kill()


@pytest.fixture
def frame(tmp_path: Path) -> Path:
    file = tmp_path / "scenes" / "frame.msaa.yaml"
    file.parent.mkdir()
    file.write_text(STORED, encoding="utf-8")
    return file


def replace(file: Path, text: str) -> None:
    """Writes a file as editors do: another one takes its name."""
    new = file.with_name(file.name + ".new~")
    new.write_text(text, encoding="utf-8")
    new.replace(file)


@pytest.mark.parametrize("named", ["scenes", "scenes/frame.msaa.yaml"])
def test_each_change_of_an_input_is_checked_and_ctrl_c_ends_with_130(
    frame: Path, named: str
) -> None:
    with watching(frame.parent.parent, named) as process:
        first = process.screen()
        assert RULE in first and "Found 2 findings" in first
        replace(frame, CLEAN)
        assert "No findings in 1 file" in process.screen()
        replace(frame, STORED)
        assert process.screen().splitlines()[:-1] == first.splitlines()[:-1]
        frame.write_text(CLEAN, encoding="utf-8")
        assert "No findings in 1 file" in process.screen()
        assert process.interrupt() == (130, "")


def test_files_and_folders_that_appear_and_disappear(frame: Path) -> None:
    with watching(frame.parent.parent, ".") as process:
        assert "in 1 file" in process.screen()
        other = frame.parent.parent / "more" / "deep"
        shutil.copytree(frame.parent, other)
        assert "in 2 files" in process.screen()
        shutil.rmtree(other.parent)
        assert "in 1 file" in process.screen()
        frame.unlink()
        assert "nothing to lint" in process.screen()
        frame.write_text(CLEAN, encoding="utf-8")
        assert "No findings in 1 file" in process.screen()


def test_configuration_and_rule_pages_outside_the_inputs(frame: Path) -> None:
    root = frame.parent.parent
    page = root / "pages" / "four-samples.md"
    page.parent.mkdir()
    front = (
        "---\ncode: ACME001\nseverity: warning\nsubject: image\nwhen: image.samples == 4\n"
        'message: "%s"\n---\nOurs.\n'
    )
    page.write_text(front % "four samples", encoding="utf-8")
    configuration = root / "msaa-lint.toml"
    configuration.write_text("rules = ['pages']\n", encoding="utf-8")
    with watching(root, "scenes") as process:
        assert "four samples (ACME001)" in process.screen()
        replace(page, front % "too many samples")
        assert "too many samples (ACME001)" in process.screen()
        replace(configuration, "ignore = ['ALL']\n")
        assert "No findings" in process.screen()
        configuration.write_text("edition = 'never'\n", encoding="utf-8")
        assert "unknown value `never`" in process.screen()


def test_a_configuration_that_appears_beside_a_named_file_or_above_it(frame: Path) -> None:
    root = frame.parent.parent
    (root / ".git").mkdir()
    with watching(root.parent, str(frame)) as process:
        assert RULE in process.screen()
        beside = frame.parent / "msaa-lint.toml"
        beside.write_text("ignore = ['ALL']\n", encoding="utf-8")
        assert "No findings" in process.screen()
        beside.unlink()
        assert RULE in process.screen()
        (root / "pyproject.toml").write_text(
            "[tool.msaa-lint]\nignore = ['ALL']\n", encoding="utf-8"
        )
        assert "No findings" in process.screen()


def test_only_changes_of_what_is_read_concern_it(
    frame: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    root = frame.parent.parent
    monkeypatch.chdir(root)
    (root / "msaa-lint.toml").write_text("include = ['**/*.scene']\n", encoding="utf-8")
    folders = ["new", ".git", "node_modules"]
    for folder in folders:
        (root / folder).mkdir()
    changed = Watched(Request(["."])).concerns
    assert [name for name in folders if changed(str(root / name))] == ["new"]
    read = [
        "new/a.yaml",
        "a.cpp",
        "b.scene",
        "msaa-lint.toml",
        "new/.gitignore",
        "shaders/b.spv",
        "rules/a.md",
    ]
    others = [
        ".git/a.yaml",
        "node_modules/a.cpp",
        ".hidden.yaml",
        "a.o",
        "new/a.yaml~",
        ".msaa.yaml.swp",
        ".git/.gitignore",
    ]
    assert [name for name in read + others if changed(str(root / name))] == read
    alone = Watched(Request(["scenes/frame.msaa.yaml"])).concerns
    assert [
        name
        for name in ("scenes/frame.msaa.yaml", "scenes/b.yaml", "msaa-lint.toml")
        if alone(str(root / name))
    ] == [
        "scenes/frame.msaa.yaml",
        "msaa-lint.toml",
    ]


def test_a_terminal_is_cleared_before_each_check(frame: Path) -> None:
    import pty

    master, terminal = pty.openpty()
    command = [sys.executable, "-m", "msaa_lint", "check", "--watch", "scenes"]
    environment = environment_of({"TERM": "xterm-256color"})
    with subprocess.Popen(
        command,
        cwd=frame.parent.parent,
        env=environment,
        stdin=terminal,
        stdout=terminal,
        stderr=terminal,
    ) as process:
        os.close(terminal)
        timer = Timer(LIMIT, process.kill)
        timer.start()
        screens = b""
        for count, text in ((1, CLEAN), (2, STORED)):
            while screens.count(b"Ctrl-C ends\r\n") < count:
                screens += os.read(master, 4096)
            replace(frame, text)
        timer.cancel()
        process.kill()
        os.close(master)
    assert screens.startswith(b"\x1b[2J\x1b[3J\x1b[H")
    first, second = screens.split(b"\x1b[2J\x1b[3J\x1b[H")[1:3]
    assert RULE.encode() in first and b"-->" in first
    assert b"No findings in 1 file" in second


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["-"], "`--watch` cannot watch standard input; name files or folders"),
        (
            ["--fix", "scenes"],
            "`--watch` changes no files; leave out `--fix`, or run it once without `--watch`",
        ),
        (
            ["--diff", "scenes"],
            "`--watch` changes no files; leave out `--diff`, or run it once without `--watch`",
        ),
        (
            ["--output", "json", "scenes"],
            "`--watch` shows full or concise output on the screen, not `json`; write it without "
            "`--watch`",
        ),
        (["--output", "full=a.txt", "scenes"], "not `full=a.txt`; write it without `--watch`"),
        (
            ["--output", "full", "--output", "concise", "scenes"],
            "`--watch` shows one output; write `--output full` or `--output concise`",
        ),
        (["none/frame.yaml"], "its folder does not exist"),
    ],
)
def test_what_does_not_go_with_it_is_an_error(
    frame: Path, arguments: list[str], message: str
) -> None:
    done = run(frame.parent.parent, "check", "--watch", *arguments)
    assert (done.returncode, done.stdout) == (2, "")
    assert (
        done.stderr.startswith("msaa-lint: ")
        and message in done.stderr
        and len(done.stderr.splitlines()) == 1
    )


def test_without_the_extra_the_error_says_how_to_install_it(frame: Path, tmp_path: Path) -> None:
    absent = tmp_path / "absent"
    absent.mkdir()
    (absent / "sitecustomize.py").write_text(
        "import sys\nsys.modules['watchfiles'] = None\n", encoding="utf-8"
    )
    path = os.pathsep.join([str(absent), environment_of({})["PYTHONPATH"]])
    done = run_process(frame.parent.parent, "check", "--watch", "scenes", PYTHONPATH=path)
    assert done.returncode == 2
    assert "`--watch` needs the extra `watch`: run `" in done.stderr and "[watch]" in done.stderr
