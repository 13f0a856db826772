"""A file is wholly old or wholly new, whatever fails, and whenever the process is killed."""

from __future__ import annotations

import os
import signal
import stat
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from msaa_lint.core import atomic_write as write
from msaa_lint.core.atomic_write import NotWritten
from tests.paths import ROOT

OLD, NEW = b"old: 1\n" * 5000, b"new: 22\n" * 9000
CALLS = (
    "open",
    "fstat",
    "access",
    "write",
    "fchown",
    "fchmod",
    "fsync",
    "close",
    "replace",
    "unlink",
    "urandom",
    "getpid",
)


class Faulty:
    """The functions of `os` that the writer calls, of which the one with a number does something
    else.
    """

    def __init__(self, number: int, fault: Callable[[], None]) -> None:
        self.number = number
        self.fault = fault
        self.made: list[str] = []

    def __getattr__(self, name: str) -> Any:
        real = getattr(os, name)
        if name not in CALLS:
            return real

        def call(*arguments: Any, **named: Any) -> Any:
            self.made.append(name)
            if len(self.made) == self.number:
                self.fault()
            return real(*arguments, **named)

        return call


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "frame.yaml"
    path.write_bytes(OLD)
    return path


def calls(file: Path) -> list[str]:
    """The calls of one write that goes well."""
    faulty = Faulty(0, lambda: None)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(write, "os", faulty)
        write.replace(str(file), OLD, NEW)
    file.write_bytes(OLD)
    return faulty.made


def test_it_writes(file: Path) -> None:
    file.chmod(0o640)
    write.replace(str(file), OLD, NEW)
    assert file.read_bytes() == NEW
    assert stat.S_IMODE(file.stat().st_mode) == 0o640
    assert [each.name for each in file.parent.iterdir()] == ["frame.yaml"]


@pytest.mark.parametrize(
    "error", [OSError(28, "No space left on device"), KeyboardInterrupt(), MemoryError()]
)
def test_a_fault_at_any_call_leaves_it_old_or_new_and_nothing_beside_it(
    file: Path, error: BaseException
) -> None:
    count = len(calls(file))
    assert count > 10
    for number in range(1, count + 1):
        file.write_bytes(OLD)

        def fault() -> None:
            raise error

        faulty = Faulty(number, fault)
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(write, "os", faulty)
            try:
                write.replace(str(file), OLD, NEW)
            except (NotWritten, KeyboardInterrupt, MemoryError) as raised:
                failed = True
                assert isinstance(error, OSError) == isinstance(raised, NotWritten)
            else:
                failed = False
        after = file.read_bytes()
        assert after in (OLD, NEW)
        if isinstance(error, OSError):
            # What is said is true.
            assert failed == (after == OLD), faulty.made
        assert [each.name for each in file.parent.iterdir()] == ["frame.yaml"], faulty.made[
            number - 1
        ]


def test_short_writes_are_gone_on_with(file: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    real = os.write
    monkeypatch.setattr(write.os, "write", lambda descriptor, data: real(descriptor, data[:1000]))
    write.replace(str(file), OLD, NEW)
    assert file.read_bytes() == NEW


KILLED = """\
import os, signal, sys
sys.path.insert(0, {root!r})
from tests.core.test_atomic_write import Faulty, OLD, NEW
from msaa_lint.core import atomic_write
atomic_write.os = Faulty(int(sys.argv[2]), lambda: os.kill(os.getpid(), signal.SIGKILL))
atomic_write.replace(sys.argv[1], OLD, NEW)
"""


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="there is no SIGKILL here")
def test_killed_at_any_call_it_is_old_or_new(file: Path) -> None:
    names = calls(file)
    seen = set()
    for number in range(1, len(names) + 1):
        file.write_bytes(OLD)
        done = subprocess.run(
            [sys.executable, "-c", KILLED.format(root=str(ROOT)), str(file), str(number)],
            check=False,
        )
        assert done.returncode == -signal.SIGKILL
        seen.add(file.read_bytes())
        assert seen <= {OLD, NEW}, names[number - 1]
    assert seen == {OLD, NEW}


def test_a_file_that_changed_is_left(file: Path) -> None:
    file.write_bytes(OLD + b"# mine\n")
    with pytest.raises(NotWritten, match="changed since it was read"):
        write.replace(str(file), OLD, NEW)
    assert file.read_bytes() == OLD + b"# mine\n"


def test_a_file_that_changes_meanwhile_is_left(file: Path) -> None:
    number = calls(file).index("fsync") + 1

    def other() -> None:
        file.write_bytes(OLD[:-2] + b"9\n")

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(write, "os", Faulty(number, other))
        with pytest.raises(NotWritten, match="changed since it was read"):
            write.replace(str(file), OLD, NEW)
    assert file.read_bytes() == OLD[:-2] + b"9\n"
    assert [each.name for each in file.parent.iterdir()] == ["frame.yaml"]


def test_a_read_only_file_is_left(file: Path) -> None:
    file.chmod(0o444)
    with pytest.raises(NotWritten, match="the file is read-only"):
        write.replace(str(file), OLD, NEW)
    assert file.read_bytes() == OLD


def test_of_a_link_what_it_leads_to_is_written(file: Path) -> None:
    (file.parent / "deep").mkdir()
    link = file.parent / "deep" / "link.yaml"
    link.symlink_to(file)
    write.replace(str(link), OLD, NEW)
    assert link.is_symlink()
    assert file.read_bytes() == NEW
    assert [each.name for each in (file.parent / "deep").iterdir()] == ["link.yaml"]


def test_what_is_no_file_is_left(tmp_path: Path) -> None:
    with pytest.raises(NotWritten):
        write.replace(str(tmp_path), OLD, NEW)
    with pytest.raises(NotWritten):
        write.replace(str(tmp_path / "none"), OLD, NEW)
    assert list(tmp_path.iterdir()) == []


def test_the_owner_is_kept_where_that_is_permitted(
    file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: list[tuple[int, int]] = []

    def refused(descriptor: int, user: int, group: int) -> None:
        asked.append((user, group))
        raise PermissionError

    monkeypatch.setattr(write.os, "fchown", refused)
    like = os.stat(file)
    other = SimpleNamespace(st_uid=like.st_uid + 1, st_gid=like.st_gid, st_mode=like.st_mode)
    descriptor = os.open(file.parent / "x", os.O_CREAT | os.O_WRONLY)
    write._copy_status(descriptor, other)  # type: ignore[arg-type]
    os.close(descriptor)
    assert asked == [(like.st_uid + 1, like.st_gid)]


def test_writing_creates_or_replaces_and_leaves_nothing_beside(tmp_path: Path) -> None:
    path = tmp_path / "new.json"
    write.write_file(str(path), OLD)
    write.write_file(str(path), NEW)
    assert path.read_bytes() == NEW
    link = tmp_path / "link.json"
    link.symlink_to(path)
    write.write_file(str(link), OLD)
    assert not link.is_symlink()
    assert (link.read_bytes(), path.read_bytes()) == (OLD, NEW)
    with pytest.raises(OSError):
        write.write_file(str(tmp_path), NEW)
    assert sorted(each.name for each in tmp_path.iterdir()) == ["link.json", "new.json"]
