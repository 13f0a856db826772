"""The progress bar of a capture that takes a while to read."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from pathlib import Path

import pytest

from tests.command import read_terminal
from tests.input.captures.test_frames import forward
from tests.paths import ROOT

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="terminals are POSIX")


def shown(folder: Path, *arguments: str, **variables: str) -> bytes:
    """What `check` writes to a terminal on standard error while a capture comes through a pipe that
    pauses.
    """
    import pty

    lines = forward(1).text().splitlines()
    master, terminal = pty.openpty()
    environment = {
        name: value for name, value in os.environ.items() if name not in ("CI", "NO_COLOR")
    }
    environment |= {"PYTHONPATH": str(ROOT), "TERM": "xterm", "COLUMNS": "120", **variables}
    command = [
        sys.executable,
        "-m",
        "msaa_lint",
        "check",
        "-",
        "--isolated",
        "--output",
        "json",
        *arguments,
    ]
    with subprocess.Popen(
        command,
        cwd=folder,
        env=environment,
        stdin=subprocess.PIPE,
        stdout=subprocess.DEVNULL,
        stderr=terminal,
    ) as running:
        os.close(terminal)
        assert running.stdin is not None
        for line in lines:
            # A line that is longer than what is read at a time.
            running.stdin.write(line + b" " * (1 << 18) + b"\n")
            running.stdin.flush()
            time.sleep(4 / len(lines))
        running.stdin.close()
        written = read_terminal(master)
    return written


def test_a_capture_that_takes_a_while_has_a_bar_with_megabytes_and_frames(tmp_path: Path) -> None:
    written = shown(tmp_path)
    assert b"reading <stdin>" in written
    assert b" MB, " in written and b" frame" in written


@pytest.mark.parametrize(
    ("arguments", "variables"), [(["--quiet"], {}), ([], {"CI": "true"}), ([], {"TERM": "dumb"})]
)
def test_nobody_who_does_not_watch_gets_a_bar(
    arguments: list[str], variables: dict[str, str], tmp_path: Path
) -> None:
    assert b"reading" not in shown(tmp_path, *arguments, **variables)
