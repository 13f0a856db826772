"""What is kept of source code between runs, through the command."""

from __future__ import annotations

import contextlib
import os
import sqlite3
from pathlib import Path

import pytest

from msaa_lint.core.cache import FILE
from msaa_lint.core.text.files import open_entry
from msaa_lint.input.code.c.description_trees import file_syntax
from msaa_lint.input.code.project.index import MIN_KEPT
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
    return run(
        project, "check", ".", "--isolated", "--output", "json", *options, XDG_CACHE_HOME=str(kept)
    )


def test_a_second_run_says_the_same(
    project: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    first = check(project, tmp_path / "kept")
    assert "MSAA201" in first.stdout

    def read(*_: object) -> None:
        raise AssertionError("the program is read again")

    monkeypatch.setattr("msaa_lint.input.code.c.description_trees.file_syntax", read)
    second = check(project, tmp_path / "kept")
    assert (second.stdout, second.returncode) == (first.stdout, first.returncode)


def test_a_second_run_lints_nothing(
    project: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    first = check(project, tmp_path / "kept")

    def lint(*_: object) -> None:
        raise AssertionError("the program is linted again")

    with monkeypatch.context() as patch:
        patch.setattr("msaa_lint.linter.engine.Engine.lint", lint)
        second = check(project, tmp_path / "kept")
        other = check(project, tmp_path / "kept", "--ignore", "MSAA201")
    assert (second.stdout, second.returncode) == (first.stdout, first.returncode)
    assert "MSAA941" in other.stdout
    assert "MSAA201" not in check(project, tmp_path / "kept", "--ignore", "MSAA201").stdout


def test_of_a_program_only_the_files_that_change_are_parsed(
    project: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write(project, {"settings.h": settings(4) + FILLER})
    check(project, tmp_path / "kept")
    parsed = []
    monkeypatch.setattr(
        "msaa_lint.input.code.c.description_trees.file_syntax",
        lambda code, macros: parsed.append(code.text) or file_syntax(code, macros),
    )
    write(project, {"settings.h": settings(1) + FILLER})
    done = check(project, tmp_path / "kept")
    assert "MSAA201" not in done.stdout
    assert parsed == [settings(1) + FILLER]
    # What a header defines changes what the files that use it say.
    write(project, {"settings.h": settings(1) + FILLER + "#define vkCreateRenderPass createPass\n"})
    check(project, tmp_path / "kept")
    assert len(parsed) == 3


def test_a_run_of_many_programs_says_the_same_as_their_runs(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Above `MIN_DIVIDED`, processes divide the programs."""
    filler = "".join(
        f"void unrelated_{number}(int a) {{ work(a + {number}); }}\n" for number in range(4000)
    )
    for name in "abc":
        write(tmp_path / name, {"pass.cpp": PASS + filler, "settings.h": settings(4)})
    divided = run(tmp_path, "check", "a", "b", "c", "--isolated", "--no-cache", "--output", "json")
    monkeypatch.setattr("msaa_lint.linter.input_runs.MIN_DIVIDED", 1 << 40)
    assert (
        divided.stdout
        == run(
            tmp_path, "check", "a", "b", "c", "--isolated", "--no-cache", "--output", "json"
        ).stdout
    )
    assert divided.stdout.count("MSAA201") == 3


@pytest.fixture
def many(tmp_path: Path) -> Path:
    """A project with more files than are read in any case, all of them old."""
    folder = tmp_path / "many"
    write(
        folder,
        {f"other{number:03}.cpp": f"int other{number};\n" for number in range(MIN_KEPT + 10)},
    )
    write(folder, {"pass.cpp": PASS + FILLER, "settings.h": settings(4)})
    for path in folder.iterdir():
        os.utime(path, (1, 1))
    return folder


def test_files_that_have_not_been_written_are_not_opened(
    many: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("msaa_lint.core.text.files.FINE_CLOCK", -(10**12))
    first = check(many, tmp_path / "kept")
    opened = []
    monkeypatch.setattr(
        "msaa_lint.input.code.project.index.open_entry",
        lambda path: opened.append(path) or open_entry(path),
    )
    assert check(many, tmp_path / "kept").stdout == first.stdout
    assert len(opened) == MIN_KEPT
    # Neither the size nor the time of modification shows it.
    write(many, {"settings.h": settings(1)})
    os.utime(many / "settings.h", (1, 1))
    assert "MSAA201" not in check(many, tmp_path / "kept").stdout


def test_files_that_are_too_young_are_read_again(
    many: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Within the resolution of times, another content may have the same."""
    monkeypatch.setattr("msaa_lint.core.text.files.FINE_CLOCK", 10**12)
    check(many, tmp_path / "kept")
    opened = []
    monkeypatch.setattr(
        "msaa_lint.input.code.project.index.open_entry",
        lambda path: opened.append(path) or open_entry(path),
    )
    check(many, tmp_path / "kept")
    assert len(opened) == len(list(many.iterdir()))


def test_a_file_that_changes_is_read_again(project: Path, tmp_path: Path) -> None:
    check(project, tmp_path / "kept")
    write(project, {"settings.h": settings(1)})
    done = check(project, tmp_path / "kept")
    assert "MSAA201" not in done.stdout
    assert "MSAA304" in done.stdout


def test_no_cache_keeps_nothing(project: Path, tmp_path: Path) -> None:
    check(project, tmp_path / "kept", "--no-cache")
    assert not (tmp_path / "kept" / "msaa-lint").exists()


@pytest.mark.parametrize("damage", [b"", b"\x00" * 40, None])
def test_a_damaged_entry_is_ignored(project: Path, tmp_path: Path, damage: bytes | None) -> None:
    first = check(project, tmp_path / "kept")
    with (
        contextlib.closing(sqlite3.connect(tmp_path / "kept" / "msaa-lint" / FILE)) as database,
        database,
    ):
        rows = database.execute("select number, data from entries").fetchall()
        damaged = ((data[:-1] if damage is None else damage, number) for number, data in rows)
        assert (
            database.executemany("update entries set data = ? where number = ?", damaged).rowcount
            > 1
        )
    assert check(project, tmp_path / "kept").stdout == first.stdout


@pytest.mark.parametrize("data", [b"", b"cos\nsystem\n(S'true'\ntR.", b"\x80\x05K\x01."])
def test_bytes_that_hold_something_else_are_refused(data: bytes) -> None:
    """The second calls a function if it is unpickled as usual."""
    with pytest.raises(ValueError):
        loads(data, 0)
    with pytest.raises(ValueError):
        loads_reads(data)
