"""What is kept of source code between runs, through the command."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from msaa_lint.core import cache
from msaa_lint.core.cache import Cache, user_cache
from msaa_lint.input.code.project.serialized import loads, loads_reads
from tests.command import Done, run
from tests.input.code.project.test_folders import PASS, settings, write

pytest.importorskip("tree_sitter_cpp")

FILLER = "".join(f"void unrelated_{number}(int a);\n" for number in range(200))


@pytest.fixture
def project(tmp_path: Path) -> Path:
    folder = tmp_path / "project"
    write(folder, {"pass.cpp": PASS + FILLER, "settings.h": settings(4)})
    return folder


def check(project: Path, kept: Path, *options: str) -> Done:
    return run(project, "check", ".", "--isolated", "--output", "json", *options, XDG_CACHE_HOME=str(kept))


def entries(kept: Path) -> list[Path]:
    return sorted((kept / "msaa-lint").iterdir()) if (kept / "msaa-lint").exists() else []


def test_a_second_run_says_the_same(project: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    first = check(project, tmp_path / "kept")
    assert "MSAA201" in first.stdout
    assert [entry.stat().st_mode & 0o777 for entry in entries(tmp_path / "kept")] == [0o600]

    def read(*_: object) -> None:
        raise AssertionError("the program is read again")

    monkeypatch.setattr("msaa_lint.input.code.project.reading.file_syntax", read)
    second = check(project, tmp_path / "kept")
    assert (second.stdout, second.returncode) == (first.stdout, first.returncode)


def test_a_file_that_changes_is_read_again(project: Path, tmp_path: Path) -> None:
    check(project, tmp_path / "kept")
    write(project, {"settings.h": settings(1)})
    done = check(project, tmp_path / "kept")
    assert "MSAA201" not in done.stdout
    assert "MSAA304" in done.stdout


def test_no_cache_keeps_nothing(project: Path, tmp_path: Path) -> None:
    check(project, tmp_path / "kept", "--no-cache")
    assert entries(tmp_path / "kept") == []


@pytest.mark.parametrize("damage", [b"", b"\x00" * 40, None])
def test_a_damaged_entry_is_ignored(project: Path, tmp_path: Path, damage: bytes | None) -> None:
    first = check(project, tmp_path / "kept")
    (entry,) = entries(tmp_path / "kept")
    entry.write_bytes(entry.read_bytes()[:-1] if damage is None else damage)
    assert check(project, tmp_path / "kept").stdout == first.stdout


def test_entries_that_others_could_have_written_are_ignored(project: Path, tmp_path: Path) -> None:
    check(project, tmp_path / "kept")
    (entry,) = entries(tmp_path / "kept")
    name = entry.name
    kept = Cache(str(tmp_path / "kept" / "msaa-lint"), "1")
    kept.write("program", "x", b"content")
    (own,) = (each for each in entries(tmp_path / "kept") if each.name != name)
    assert kept.read("program", "x") == b"content"
    own.chmod(0o666)
    assert kept.read("program", "x") is None
    (tmp_path / "kept" / "msaa-lint").chmod(0o777)
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_CACHE_HOME", str(tmp_path / "kept"))
        assert user_cache("1") is None


def test_a_link_is_not_followed(tmp_path: Path) -> None:
    kept = Cache(str(tmp_path), "1")
    kept.write("program", "x", b"content")
    (entry,) = tmp_path.iterdir()
    entry.rename(tmp_path / "elsewhere")
    entry.symlink_to(tmp_path / "elsewhere")
    assert kept.read("program", "x") is None


def test_the_oldest_entries_are_removed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cache, "MAX_BYTES", 1000)
    kept = Cache(str(tmp_path), "1")
    for number in range(12):
        kept.write("program", str(number), bytes(100))
        os.utime(sorted(tmp_path.iterdir(), key=lambda path: path.stat().st_mtime)[-1], (number, number))
    kept.close()
    assert sum(path.stat().st_size for path in tmp_path.iterdir()) <= 750
    assert kept.read("program", "11") is not None
    assert kept.read("program", "0") is None


@pytest.mark.parametrize("data", [b"", b"cos\nsystem\n(S'true'\ntR.", b"\x80\x05K\x01."])
def test_bytes_that_hold_something_else_are_refused(data: bytes) -> None:
    """The second calls a function if it is unpickled as usual."""
    with pytest.raises(ValueError):
        loads(data, 0)
    with pytest.raises(ValueError):
        loads_reads(data)
