"""Whatever a driver does to the process that it runs in: it is said of the pass that it did it at,
and the next pass still runs.
"""

from __future__ import annotations

import glob
import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from msaa_lint.core.child_output import signal_name
from msaa_lint.experiments.confirm.child import Limits
from msaa_lint.experiments.confirm.frame_results import MAX_MESSAGES, FrameRun
from msaa_lint.experiments.confirm.session import MAX_DEATHS, Session
from msaa_lint.experiments.confirm.vulkan_errors import Unusable
from tests.paths import ROOT

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="signals are POSIX")

WANT = {"pixels": None, "repeats": 0, "warmups": 0}


@pytest.fixture
def scratch(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A folder for temporary files, in which nothing may be left; and no child may be."""
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    # Other tests of this process may have left helpers running, clusters' for instance.
    OTHERS.clear()
    OTHERS.update(children())
    yield tmp_path
    assert list(tmp_path.iterdir()) == []
    assert children() == []


OTHERS: set[int] = set()


def children() -> list[int]:
    """The processes that the test started and that still exist, dead ones too."""
    own = []
    for path in glob.glob("/proc/[0-9]*/stat"):
        try:
            text = Path(path).read_text()
        except OSError:
            continue
        if int(text.rpartition(")")[2].split()[1]) == os.getpid():
            own.append(int(text.split()[0]))
    return [child for child in own if child not in OTHERS]


def session(
    seconds: float = 20.0, memory: int = 8 << 30, device: str | None = None, **more: Any
) -> Session:
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "STARTED_BY": str(os.getpid())}
    return Session(
        device,
        limits=Limits(seconds, memory),
        environment=environment,
        execute="tests.experiments.confirm.fake",
        **more,
    )


def ran(
    *deeds: str, seconds: float = 20.0, memory: int = 8 << 30, before: str | None = None
) -> FrameRun:
    with session(seconds, memory) as opened:
        return opened.run({"passes": list(deeds), "before": before}, range(len(deeds)), WANT)


def processes(run: FrameRun) -> list[str]:
    return [
        each.messages[0]["id"] if each.messages else "" for _, each in sorted(run.passes.items())
    ]


def test_frames_that_live_share_a_process(scratch: Path) -> None:
    with session() as opened:
        assert opened.open() == {"name": "fake", "type": "CPU"}
        assert opened.layer == {"name": "fake layer"}
        runs = [opened.run({"passes": ["draws", "draws"]}, [0, 1], WANT) for _ in range(3)]
    assert len({process for run in runs for process in processes(run)}) == 1
    assert [run.passes[0].messages[0]["text"] for run in runs] == ["run 1", "run 2", "run 3"]
    assert all(
        run.whole and each.created and each.end == ""
        for run in runs
        for each in run.passes.values()
    )


@pytest.mark.parametrize("name", ["SIGSEGV", "SIGABRT", "SIGFPE", "SIGKILL", "SIGILL", "SIGBUS"])
def test_signal_is_named_and_the_passes_beside_it_run(scratch: Path, name: str) -> None:
    run = ran("draws", name, "draws")
    assert [run.passes[n].end for n in range(3)] == ["", "died", ""]
    assert run.passes[1].signal == name and run.passes[1].reason.startswith(name)
    assert "alone it lives" not in run.passes[1].reason
    assert [run.passes[n].created for n in range(3)] == [True, None, True]
    assert not run.whole


def test_sigkill_is_explained(scratch: Path) -> None:
    assert ran("SIGKILL").passes[0].reason == "SIGKILL, which may mean that memory ran out"


def test_last_words_are_told(scratch: Path) -> None:
    assert (
        ran("aborts").passes[0].reason
        == "SIGABRT; its last words: LLVM ERROR: \x1b[31mcannot select"
    )


def test_death_in_company_alone(scratch: Path) -> None:
    run = ran("draws", "dies in company", "draws")
    died = run.passes[1]
    assert (died.end, died.signal, died.created) == ("died", "SIGSEGV", True)
    assert died.reason == "SIGSEGV (only together with other passes, not alone)"
    assert run.passes[2].end == ""


def test_several_deaths_are_all_found(scratch: Path) -> None:
    run = ran("SIGSEGV", "draws", "SIGFPE", "draws", "aborts")
    assert [run.passes[n].signal for n in range(5)] == ["SIGSEGV", "", "SIGFPE", "", "SIGABRT"]


def test_deaths_are_bounded(scratch: Path) -> None:
    run = ran(*["SIGKILL"] * (MAX_DEATHS + 2))
    ends = [run.passes[n].end for n in range(MAX_DEATHS + 2)]
    assert ends == ["died"] * MAX_DEATHS + ["left"] * 2


def test_death_before_any_pass_is_of_each_that_has_it(scratch: Path) -> None:
    run = ran("draws", "draws", before="aborts")
    assert [run.passes[n].signal for n in range(2)] == ["SIGABRT", "SIGABRT"]
    assert not run.whole


def test_child_that_sleeps_forever_is_ended(scratch: Path) -> None:
    start = time.monotonic()
    run = ran("draws", "sleeps", "draws", seconds=1.0)
    assert [run.passes[n].end for n in range(3)] == ["", "timed-out", ""]
    assert run.passes[1].reason == "it took longer than 1 s"
    assert time.monotonic() - start < 30


def test_what_a_driver_starts_is_ended_with_it(scratch: Path) -> None:
    run = ran("forks", seconds=1.0)
    assert run.passes[0].end == "timed-out"
    time.sleep(0.1)
    left = []
    for path in glob.glob("/proc/[0-9]*/environ"):
        try:
            if f"STARTED_BY={os.getpid()}".encode() in Path(path).read_bytes().split(b"\0"):
                left.append(path)
        except OSError:
            continue
    assert left == []


def test_garbage_on_the_pipe_ends_the_child(scratch: Path) -> None:
    run = ran("draws", "garbage", "draws")
    assert [run.passes[n].end for n in range(3)] == ["", "died", ""]
    assert "wrote a line that is not JSON" in run.passes[1].reason


def test_printing_is_no_answer_and_is_bounded(scratch: Path) -> None:
    with session() as opened:
        run = opened.run({"passes": ["prints", "draws"]}, [0, 1], WANT)
    assert [run.passes[n].end for n in range(2)] == ["", ""]
    (printed,) = opened.printed
    assert printed.startswith("to standard output") and printed.endswith("to standard error")
    assert len(printed) < 40_000


def test_exit_of_the_process_by_the_driver(scratch: Path) -> None:
    assert ran("exits").passes[0].reason == "the driver ended the process with code 7"


def test_memory_is_limited(scratch: Path) -> None:
    run = ran("eats", memory=2 << 30)
    assert run.failed == "out of memory" and run.passes[0].end == "left"


def test_exception_in_the_child_is_said_and_the_next_frame_runs(scratch: Path) -> None:
    with session() as opened:
        first = opened.run({"passes": ["raises"]}, [0], WANT)
        second = opened.run({"passes": ["draws"]}, [0], WANT)
    assert first.failed == "RuntimeError: a bug of ours"
    assert second.passes[0].created


def test_failed_creation_is_no_death(scratch: Path) -> None:
    run = ran("refuses")
    assert (run.passes[0].created, run.passes[0].error, run.passes[0].end) == (
        False,
        "VK_ERROR_UNKNOWN",
        "",
    )


def test_messages_are_bounded(scratch: Path) -> None:
    found = ran("chatters").passes[0]
    assert (len(found.messages), found.dropped) == (MAX_MESSAGES, 301 - MAX_MESSAGES)


def test_pixels_come_where_all_went_through(scratch: Path) -> None:
    with session() as opened:
        want = {**WANT, "pixels": opened.folder("pixels")}
        alive = opened.run({"passes": ["draws"]}, [0], want)
        path = alive.images["color"]["path"]
        assert Path(path).read_bytes() == bytes(16)
        dead = opened.run({"passes": ["draws", "SIGSEGV"]}, [0, 1], want)
    assert dict(dead.images) == {} and not Path(path).exists()


@pytest.mark.parametrize(
    ("device", "words"),
    [("dies", "cannot open the driver: SIGSEGV"), ("sleeps", "it took longer than 1 s")],
)
def test_driver_that_dies_at_once_is_no_device(
    scratch: Path, monkeypatch: pytest.MonkeyPatch, device: str, words: str
) -> None:
    monkeypatch.setattr("msaa_lint.experiments.confirm.session.OPENING", 1.0)
    with session(1.0, device=device) as opened, pytest.raises(Unusable, match=words):
        opened.open()


def test_module_that_is_missing_is_named(scratch: Path) -> None:
    with (
        Session(execute="tests.experiments.confirm.nothing_there") as opened,
        pytest.raises(Unusable, match="nothing_there"),
    ):
        opened.open()


def test_devices_are_listed(scratch: Path) -> None:
    with session() as opened:
        assert opened.devices() == [{"name": "fake", "type": "CPU"}]


def test_child_killed_from_outside_between_frames(scratch: Path) -> None:
    with session() as opened:
        first = opened.run({"passes": ["draws"]}, [0], WANT)
        (child,) = children()
        os.kill(child, signal.SIGKILL)
        second = opened.run({"passes": ["draws"]}, [0], WANT)
    assert first.passes[0].created and second.passes[0].created


def test_interrupt_leaves_nothing(scratch: Path) -> None:
    threading.Timer(1.0, os.kill, (os.getpid(), signal.SIGINT)).start()
    with pytest.raises(KeyboardInterrupt), session() as opened:
        opened.run({"passes": ["sleeps"]}, [0], WANT)


def test_child_ends_when_its_parent_is_killed(tmp_path: Path) -> None:
    program = (
        "from tests.experiments.confirm.test_isolation import session, WANT, children\n"
        "with session() as opened:\n"
        "    opened.open()\n"
        "    print(children()[0], flush=True)\n"
        "    input()\n"
    )
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "TMPDIR": str(tmp_path)}
    parent = subprocess.Popen(
        [sys.executable, "-c", program],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
        cwd=ROOT,
        env=environment,
    )
    assert parent.stdout is not None and parent.stdin is not None
    child = int(parent.stdout.readline())
    parent.kill()
    parent.wait()
    parent.stdin.close()
    parent.stdout.close()
    for _ in range(100):
        if (
            not Path(f"/proc/{child}").exists()
            or Path(f"/proc/{child}/stat").read_text().rpartition(")")[2].split()[0] == "Z"
        ):
            return
        time.sleep(0.05)
    pytest.fail("the child goes on without its parent")


def test_signals_have_names() -> None:
    assert [signal_name(11), signal_name(6), signal_name(8), signal_name(40)] == [
        "SIGSEGV",
        "SIGABRT",
        "SIGFPE",
        "signal 40",
    ]
