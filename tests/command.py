"""The command `msaa-lint`, called from tests.

It runs in the process of the tests where only what it prints, writes and returns matters, else in one of its own.
"""

from __future__ import annotations

import gc
import getpass
import io
import os
import subprocess
import sys
import tempfile
from pathlib import Path
from unittest import mock

from msaa_lint.__main__ import main
from tests.paths import ROOT

CACHES = os.path.join(tempfile.gettempdir(), f"msaa-lint-tests-{getpass.getuser()}")
"""The folder for caches, in which a file is where the command would keep its own."""

os.makedirs(CACHES, exist_ok=True)
Path(CACHES, "msaa-lint").touch()

Done = subprocess.CompletedProcess[str]


def environment_of(stated: dict[str, str]) -> dict[str, str]:
    """An environment without what a developer's own may hold."""
    kept = {name: os.environ[name] for name in ("PATH", "HOME", "SYSTEMROOT") if name in os.environ}
    return {**kept, "PYTHONPATH": str(ROOT), "XDG_CACHE_HOME": CACHES, **stated}


def run(folder: Path, *arguments: str, stdin: bytes = b"", **environment: str) -> Done:
    """Runs the command in a folder, in this process unless a `PYTHONPATH` for it is stated."""
    if "PYTHONPATH" in environment:
        return run_process(folder, *arguments, stdin=stdin, **environment)
    streams = [io.TextIOWrapper(io.BytesIO(given), encoding="utf-8") for given in (stdin, b"", b"")]
    here = os.getcwd()
    code: object = 0
    with (
        mock.patch.multiple(
            sys,
            argv=["msaa-lint", *arguments],
            stdin=streams[0],
            stdout=streams[1],
            stderr=streams[2],
        ),
        mock.patch.dict(os.environ, environment_of(environment), clear=True),
    ):
        os.chdir(folder)
        try:
            main()
        except SystemExit as ended:
            code = ended.code
        finally:
            os.chdir(here)
            # The command turns the collector off for the rest of its process.
            gc.unfreeze()
            gc.enable()
    for stream in streams[1:]:
        stream.flush()
    out, errors = (stream.buffer.getvalue().decode() for stream in streams[1:])  # type: ignore[attr-defined]
    returned = code if isinstance(code, int) else int(code is not None)
    return subprocess.CompletedProcess(["msaa-lint", *arguments], returned, out, errors)


def run_process(folder: Path, *arguments: str, stdin: bytes = b"", **environment: str) -> Done:
    """Runs the command in a process of its own, for tests of imports, pipes and signals."""
    done = subprocess.run(
        [sys.executable, "-m", "msaa_lint", *arguments],
        cwd=folder,
        input=stdin,
        capture_output=True,
        env=environment_of(environment),
        check=False,
        timeout=300,
    )
    assert b"Traceback" not in done.stderr
    return subprocess.CompletedProcess(
        done.args, done.returncode, done.stdout.decode(), done.stderr.decode()
    )


def read_terminal(master: int) -> bytes:
    """What a process writes to a pseudoterminal until it ends, which closes the terminal. Closes `master`."""
    written = b""
    while True:
        try:
            piece = os.read(master, 4096)
        except OSError:
            break
        if not piece:
            break
        written += piece
    os.close(master)
    return written
