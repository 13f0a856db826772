"""What files of folders are, as an earlier run found."""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from msaa_lint.core.cache import Cache
from msaa_lint.core.text.files import COARSE_CLOCK, FINE_CLOCK, is_settled
from msaa_lint.input.discovery import discover
from msaa_lint.input.folder_search import MIN_ENTRIES
from msaa_lint.input.known_kinds import KnownKinds
from msaa_lint.linter.settings.settings import Settings

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="states of files say less")


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Two folders of files whose kind is their content."""
    for name in ("one", "two"):
        (tmp_path / name).mkdir()
        for number in range(10):
            (tmp_path / name / f"{number:02}\udc80.json").write_text(f"kind {number}")
    return tmp_path


def kinds(folder: Path, is_old: bool = True) -> tuple[dict[str, str], list[str]]:
    """What the files are according to a run, and which of them it opened."""
    if is_old:
        time.sleep(2 * FINE_CLOCK / 1e9)
    cache = Cache(str(folder / "cache"), "1")
    known = KnownKinds(lambda: cache)
    opened: list[str] = []

    def find(path: str) -> str:
        opened.append(path)
        return Path(path).read_text()

    found = {
        path: known.of(path, find)
        for name in ("one", "two")
        for path in sorted(map(str, (folder / name).iterdir()))
    }
    known.close()
    cache.close()
    assert found == {path: Path(path).read_text() for path in found}
    return found, opened


def test_files_are_opened_once(folder: Path) -> None:
    first, opened = kinds(folder)
    assert list(first) == opened
    second, opened = kinds(folder)
    assert second == first and opened == []


def test_a_file_that_changes_is_opened_again(folder: Path) -> None:
    kinds(folder)
    changed, renamed = (folder / "two" / f"{number:02}\udc80.json" for number in (3, 4))
    status = changed.stat()
    changed.write_text("kind X")
    os.utime(changed, ns=(status.st_atime_ns, status.st_mtime_ns))
    other = folder / "two" / "other.json"
    other.write_text("kind Y")
    other.replace(renamed)
    _, opened = kinds(folder)
    assert opened == [str(changed), str(renamed)]


def test_a_file_that_may_just_have_been_written_is_opened_again(folder: Path) -> None:
    """Within the resolution of a clock, it may have other content and the same state."""
    kinds(folder)
    young = folder / "two" / "05\udc80.json"
    young.write_text("kind Z")
    # The clock of the run is that of a file system whose next tick has not come.
    os.utime(young, ns=(time.time_ns() + 10**12,) * 2)
    assert str(young) in kinds(folder)[1]
    assert str(young) in kinds(folder)[1]


def test_a_coarse_clock_is_known_by_its_times() -> None:
    second, start = 10**9, 1000 * 10**9
    assert not is_settled([0, 0, start - second, start - second], start)
    assert is_settled([0, 0, start - COARSE_CLOCK - second, start - COARSE_CLOCK - second], start)
    assert is_settled([0, 0, start - second, start - 5 * FINE_CLOCK], start)
    assert not is_settled([0, 0, start - second, start - FINE_CLOCK // 2], start)


def test_what_a_function_says_is_not_what_another_one_says(tmp_path: Path) -> None:
    """The settings say by which one a file is judged."""
    cache = Cache(str(tmp_path / "cache"), "1")

    def one(path: str) -> str:
        return "one"

    def two(path: str) -> str:
        return "two"

    for number in range(3):
        (tmp_path / f"{number:02}.json").touch()
    time.sleep(2 * FINE_CLOCK / 1e9)
    for find in (one, two, one):
        known = KnownKinds(lambda: cache)
        assert {known.of(str(path), find) for path in sorted(tmp_path.glob("*.json"))} == {
            find.__name__
        }
        known.close()


def test_a_run_of_a_few_files_opens_no_database(tmp_path: Path) -> None:
    known: list[str] = []

    def known_kind(path: str, find: Callable[[str], str]) -> str:
        known.append(path)
        return find(path)

    for number in range(MIN_ENTRIES):
        assert known == []
        (tmp_path / f"{number:02}.json").write_text("{}")
        discover([str(tmp_path)], lambda _: Settings(), known_kind=known_kind)
    assert len(known) == MIN_ENTRIES
