"""The database of what is kept between runs."""

from __future__ import annotations

import os
import sqlite3
import sys
from multiprocessing import get_context
from pathlib import Path

import pytest

from msaa_lint.core import cache
from msaa_lint.core.cache import FILE, Cache, user_cache


@pytest.fixture
def kept(tmp_path: Path) -> Cache:
    return Cache(str(tmp_path / "msaa-lint"), "1")


def again(kept: Cache, version: str = "1") -> Cache:
    """The cache as another process opens it."""
    kept.flush()
    return Cache(kept.folder, version)


def test_entries_are_found_by_kind_name_and_version(kept: Cache) -> None:
    kept.write("part", "a", b"1")
    kept.write("part", "b\udc80", b"2")
    kept.write("words", "a", b"3")
    for found in (kept, again(kept)):
        assert found.read_all("part", ["a", "b\udc80", "c"]) == {"a": b"1", "b\udc80": b"2"}
        assert found.read("words", "a") == b"3" and found.read("words", "b") is None
    assert again(kept, "2").read("part", "a") is None
    kept.write("part", "a", b"")
    assert again(kept).read("part", "a") == b""


def test_many_entries_are_looked_up_together(kept: Cache) -> None:
    names = [str(number) for number in range(3 * cache.MAX_NAMES)]
    for name in names[::2]:
        kept.write("part", name, name.encode())
    assert again(kept).read_all("part", names) == {name: name.encode() for name in names[::2]}


def test_nothing_is_created_to_read(kept: Cache) -> None:
    assert kept.read("part", "a") is None
    kept.close()
    assert not os.path.exists(kept.folder)


@pytest.mark.skipif(sys.platform == "win32", reason="owners of files")
def test_what_others_could_have_written_is_not_read(
    kept: Cache, monkeypatch: pytest.MonkeyPatch
) -> None:
    kept.write("part", "a", b"1")
    found = again(kept)
    database = Path(kept.folder, FILE)
    assert (
        database.stat().st_mode & 0o777 == 0o600
        and Path(kept.folder).stat().st_mode & 0o777 == 0o700
    )
    database.chmod(0o666)
    assert found.read("part", "a") is None
    database.chmod(0o600)
    assert again(kept).read("part", "a") == b"1"
    monkeypatch.setenv("XDG_CACHE_HOME", os.path.dirname(kept.folder))
    assert user_cache("1") is not None
    Path(kept.folder).chmod(0o777)
    assert user_cache("1") is None


@pytest.mark.skipif(sys.platform == "win32", reason="links")
def test_a_link_is_not_followed(kept: Cache, tmp_path: Path) -> None:
    kept.write("part", "a", b"1")
    kept.close()
    database = Path(kept.folder, FILE)
    database.rename(tmp_path / "elsewhere")
    database.symlink_to(tmp_path / "elsewhere")
    assert again(kept).read("part", "a") is None


@pytest.mark.parametrize("damage", [b"no database", b"SQLite format 3\0" + bytes(5000)])
def test_a_damaged_database_is_begun_anew(kept: Cache, damage: bytes) -> None:
    kept.write("part", "a", b"1")
    kept.close()
    Path(kept.folder, FILE).write_bytes(damage)
    found = again(kept)
    assert found.read("part", "a") is None
    assert [note for note in found.notes if "was damaged" in note] == found.notes != []
    found.write("part", "b", b"2")
    assert again(found).read("part", "b") == b"2"


def test_an_entry_under_another_name_is_not_used(kept: Cache) -> None:
    kept.write("part", "a", b"1")
    kept.write("part", "b", b"2")
    kept.close()
    database = sqlite3.connect(os.path.join(kept.folder, FILE))
    (one, other) = (number for (number,) in database.execute("select number from entries"))
    with database:
        database.execute(
            "update entries set data = (select data from entries where number = ?) where number = "
            "?",
            (other, one),
        )
    database.close()
    assert sorted(again(kept).read_all("part", ["a", "b"]).values()) in ([b"1"], [b"2"])


def test_a_database_that_is_locked_is_done_without(
    kept: Cache, monkeypatch: pytest.MonkeyPatch
) -> None:
    kept.write("part", "a", b"1")
    kept.close()
    monkeypatch.setattr(cache, "WAIT_SECONDS", 0.01)
    other = sqlite3.connect(os.path.join(kept.folder, FILE), isolation_level=None)
    other.execute("begin exclusive")
    found = again(kept)
    assert found.read("part", "a") is None
    found.write("part", "b", b"2")
    found.close()
    other.execute("rollback")
    other.close()
    assert again(kept).read_all("part", ["a", "b"]) == {"a": b"1"}


def test_entries_that_were_not_used_for_the_longest_time_are_removed(
    kept: Cache, monkeypatch: pytest.MonkeyPatch
) -> None:
    now = 0.0
    monkeypatch.setattr(cache.time, "time", lambda: now)
    for day in range(12):
        now = day * 86_400.0
        kept.write("part", str(day), os.urandom(10_000))
        kept.flush()
    # Two are used again.
    assert len(kept.read_all("part", ["0", "3"])) == 2
    monkeypatch.setattr(cache, "MAX_BYTES", 100_000)
    kept.write("part", "last", b"")
    found = again(kept).read_all("part", [*map(str, range(12)), "last"])
    assert {"0", "3", "10", "11", "last"} <= found.keys() and not {"1", "2", "4"} & found.keys()
    assert sum(map(len, found.values())) <= 75_000


def _write(folder: str, number: int) -> None:
    kept = Cache(folder, "1")
    for index in range(50):
        kept.write("part", f"{number} {index}", b"%d" % index)
        kept.flush()


def test_processes_write_at_the_same_time(kept: Cache) -> None:
    context = get_context("spawn")
    processes = [context.Process(target=_write, args=(kept.folder, number)) for number in range(4)]
    for process in processes:
        process.start()
    for process in processes:
        process.join()
    assert (
        len(
            kept.read_all(
                "part", [f"{number} {index}" for number in range(4) for index in range(50)]
            )
        )
        == 200
    )


@pytest.mark.skipif(not hasattr(os, "fork"), reason="copies of processes")
def test_a_copy_of_a_process_opens_its_own(kept: Cache) -> None:
    """What waits to be written is written by the process that it belongs to."""
    kept.write("part", "a", b"1")
    kept.flush()
    assert kept.read("part", "a") == b"1"
    kept.write("part", "b", b"2")
    process = os.fork()
    if not process:
        is_right = kept.read_all("part", ["a", "b"]) == {"a": b"1"}
        kept.write("part", "c", b"3")
        kept.close()
        os._exit(0 if is_right else 1)
    assert os.waitstatus_to_exitcode(os.waitpid(process, 0)[1]) == 0
    assert again(kept).read_all("part", ["a", "b", "c"]) == {"a": b"1", "b": b"2", "c": b"3"}
