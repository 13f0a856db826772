"""`check --output parquet` and `sqlite`: the rows, that they are the same every time, and that
texts of inputs stay text.
"""

from __future__ import annotations

import json
import os
import sqlite3
import tracemalloc
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, given
from hypothesis import strategies as st

pytest.importorskip("pyarrow")

from msaa_lint.cli.report import Options, check_parquet, check_sqlite
from msaa_lint.cli.report.rows import rows
from msaa_lint.core.finding import Finding, PassTraffic, Result
from msaa_lint.core.package import VERSION
from msaa_lint.linter.corpus.tables import (
    BOOLEAN,
    FINDINGS,
    INPUTS,
    PASSES,
    RUN,
    TABLES,
    Table,
    parquet_paths,
)
from msaa_lint.linter.rules.rule import EDITIONS
from tests.benchmarks.rows import corpus
from tests.cli.corpora import SIZE, parquet_tables, sqlite_tables, write_inputs
from tests.cli.report.hostile import TOKENS, results, texts
from tests.command import run
from tests.descriptions import STORED
from tests.input.code.project import test_folders as folders
from tests.paths import ROOT
from tests.strength import examples

GOLDEN = ROOT / "tests" / "golden" / "corpus" / "rows.json"


def records(table: Table, found: list[tuple[Any, ...]]) -> list[dict[str, Any]]:
    """Rows with the names of their columns."""
    return [dict(zip((column.name for column in table.columns), row, strict=True)) for row in found]


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("rows")
    write_inputs(path / "inputs")
    done = run(
        path,
        "check",
        "--isolated",
        "inputs",
        "--output",
        "parquet=a.parquet",
        "--output",
        "sqlite=a.sqlite",
    )
    assert (done.returncode, done.stdout, done.stderr) == (2, "", "")
    return path


def test_the_rows_of_two_frames_and_a_capture(folder: Path) -> None:
    """UPDATE=1 rewrites the file."""
    found = sqlite_tables(folder / "a.sqlite")
    (stated,) = records(RUN, found["run"])
    assert (stated["version"], stated["edition"], len(stated["configuration"])) == (
        VERSION,
        EDITIONS[-1],
        32,
    )
    text = (
        json.dumps(
            {table.name: records(table, found[table.name]) for table in TABLES if table is not RUN},
            indent=1,
        )
        + "\n"
    )
    if os.environ.get("UPDATE"):
        GOLDEN.write_text(text)
    assert text == GOLDEN.read_text()


def test_a_row_is_what_json_says(folder: Path) -> None:
    done = run(folder, "check", "--isolated", "inputs", "--output", "json")
    stated = json.loads(done.stdout)
    found = records(FINDINGS, parquet_tables(folder / "a.parquet")["findings"])
    shown = [row for row in found if row["suppressed"] is None]
    assert len(shown) == len(stated["findings"]) > 20 and len(found) == len(shown) + len(
        stated["suppressed"]
    )
    for row, finding in zip(shown, stated["findings"], strict=True):
        for name in ("rule", "code", "severity", "confidence", "message", "subject", "line"):
            assert row[name] == finding[name]
        assert (row["input"], row["column_number"]) == (finding["file"], finding["column"])
        price = finding["price"] or dict.fromkeys(
            ("read_mb_per_s", "write_mb_per_s", "memory_mib", "milliwatts")
        )
        assert {name: row[name] for name in price} == pytest.approx(price, abs=1e-6)
        assert (row["call"], row["call_number"]) == (
            (finding["seen"]["by"], finding["seen"]["call"]) if finding["seen"] else (None, None)
        )


def test_the_traffic_of_passes_is_that_of_cost(folder: Path) -> None:
    stated = json.loads(run(folder, "cost", "--isolated", "inputs", "--output", "json").stdout)[
        "passes"
    ]
    found = records(PASSES, parquet_tables(folder / "a.parquet")["passes"])
    names = (
        "path",
        "kind",
        "times",
        "width",
        "height",
        "read_mb_per_s",
        "write_mb_per_s",
        "memory_mib",
        "milliwatts",
    )
    assert [
        [row["input"], row["frame"], row["pass"], *(row[name] for name in names)] for row in found
    ] == [
        [each["file"], each["document"], each["title"], *(each[name] for name in names)]
        for each in stated
    ]
    assert len(found) > 8


def test_a_finding_names_its_frame_and_pass(folder: Path) -> None:
    found = records(FINDINGS, parquet_tables(folder / "a.parquet")["findings"])
    places = [
        (row["frame"], row["pass"])
        for row in found
        if row["rule"] == "multisampled-attachment-stored" and "frames" in row["input"]
    ]
    assert places == [(0, "forward"), (1, "glow")]
    assert {row["frame"] for row in found if row["input"].endswith("wrong.msaa.yaml")} == {None}


def test_a_finding_in_another_file_of_a_program_names_its_pass(tmp_path: Path) -> None:
    """The passes of a program are those of its first file."""
    pytest.importorskip("tree_sitter_cpp")
    folders.write(tmp_path, {"lib/pass.cpp": folders.PASS, "lib/settings.h": folders.settings(4)})
    folders.write(
        tmp_path,
        {
            f"app{number}/main.cpp": f'#include "../lib/settings.h"\n{folders.MAIN}'
            for number in range(2)
        },
    )
    options = ("--isolated", "--profile", "mali-g76", "--output", "sqlite=a.sqlite")
    for jobs in ("1", "2", "2"):
        run(
            tmp_path, "check", ".", *options, "--jobs", jobs, XDG_CACHE_HOME=str(tmp_path / "cache")
        )
        tables = sqlite_tables(tmp_path / "a.sqlite")
        (stored,) = records(FINDINGS, tables["findings"])
        assert (stored["input"], stored["frame"], stored["pass"]) == (
            "lib/pass.cpp",
            0,
            "render_pass",
        )
        assert {row["input"] for row in records(PASSES, tables["passes"])} == {"lib/settings.h"}
        assert {row["device"] for row in records(INPUTS, tables["inputs"])} == {"Mali-G76"}


def test_programs_with_other_passes_at_the_same_place_leave_it_open() -> None:
    subject = "commands[0].beginRendering.colorAttachments[0]"
    found = Finding("MSAA201", "rule", "warning", "high", "message", "shared.h", None, subject)
    passes = [
        PassTraffic(
            f"{name}.cpp", 0, name, "commands[0]", "rendering", None, None, 1, 4, 0, 0, 0, 0, ""
        )
        for name in ("one", "two")
    ]
    for owners, name in ((["one.cpp"], "one"), (["one.cpp", "two.cpp"], None)):
        tables = rows(
            Result([found], [], [], [], {}, []), passes, "", Options(), {"shared.h": owners}
        )
        (row,) = records(FINDINGS, list(tables["findings"]))
        assert row["pass"] == name


@pytest.mark.parametrize("extra", [(), ("--jobs", "2"), ("--sort", "price"), ("--output", "full")])
def test_the_same_bytes_every_time(folder: Path, extra: tuple[str, ...]) -> None:
    cache = folder / "cache"
    for number in range(2):
        done = run(
            folder, "check", "--isolated", "inputs", "--output", "parquet=b.parquet", "--output",
            "sqlite=b.sqlite", *extra,
            XDG_CACHE_HOME=str(cache),
        )  # fmt: skip
        assert done.returncode == 2, number
        for one, other in zip(
            parquet_paths("a.parquet").values(), parquet_paths("b.parquet").values(), strict=True
        ):
            assert (folder / one).read_bytes() == (folder / other).read_bytes()
        assert (folder / "a.sqlite").read_bytes() == (folder / "b.sqlite").read_bytes()
    assert any((cache / "msaa-lint").iterdir())


def test_the_configuration_is_that_of_settings_and_not_of_places(tmp_path: Path) -> None:
    names = {}
    for place, text in {
        "one": 'ignore = ["MSAA4"]\n',
        "other/two": 'ignore = ["MSAA4"]\n',
        "three": 'ignore = ["MSAA5"]\n',
    }.items():
        folder = tmp_path / place
        folder.mkdir(parents=True)
        (folder / "msaa-lint.toml").write_text(text)
        (folder / "frame.msaa.yaml").write_text(STORED)
        run(folder, "check", ".", "--output", "sqlite=a.sqlite")
        names[place] = records(RUN, sqlite_tables(folder / "a.sqlite")["run"])[0]["configuration"]
    assert names["one"] == names["other/two"] != names["three"]


numbers = st.one_of(st.none(), st.integers(0, 2**40))
amounts = st.floats(0, 1e12)
traffic = st.builds(
    PassTraffic, texts, st.integers(0, 9), texts, texts, st.just("renderPass"), numbers, numbers,
    st.integers(1, 9), numbers,
    amounts, amounts, amounts, amounts, texts,
)  # fmt: skip


@examples(0.3, suppress_health_check=[HealthCheck.too_slow, HealthCheck.function_scoped_fixture])
@given(results(), st.lists(traffic, max_size=4))
def test_both_formats_have_the_same_rows(
    tmp_path: Path, result: Result, passes: list[PassTraffic]
) -> None:
    for name, write in (("parquet", check_parquet.write), ("sqlite", check_sqlite.write)):
        write(str(tmp_path / f"a.{name}"), rows(result, passes, "x", Options(version="1")), "1")
    found = sqlite_tables(tmp_path / "a.sqlite")
    for table in TABLES:
        for number in (
            number for number, column in enumerate(table.columns) if column.kind == BOOLEAN
        ):
            found[table.name] = [
                (*row[:number], bool(row[number]), *row[number + 1 :]) for row in found[table.name]
            ]
    assert parquet_tables(tmp_path / "a.parquet") == found
    assert len(found["findings"]) == len(result.findings) + len(result.suppressed)


@pytest.mark.parametrize("write", [check_parquet.write, check_sqlite.write])
def test_more_rows_take_no_more_memory(tmp_path: Path, write: Callable[..., None]) -> None:
    peaks = []
    for count in (30_000, 30_000, 60_000):
        result, passes = corpus(count)
        tracemalloc.start()
        write(str(tmp_path / "a.parquet"), rows(result, passes, "", Options()), "1")
        peaks.append(tracemalloc.get_traced_memory()[1])
        tracemalloc.stop()
    # What Python allocates once is in the first. Of each finding there are some references, and not
    # its row, which takes 2 KB.
    assert peaks[2] - peaks[1] < 30_000 * 128


def test_hostile_names_stay_text(tmp_path: Path) -> None:
    name = "".join(token for token in TOKENS if token.isprintable()) + "'; DROP TABLE findings; --"
    (tmp_path / "a.msaa.yaml").write_text(SIZE + STORED.replace("forward:", json.dumps(name) + ":"))
    strange = os.fsencode(str(tmp_path)) + b"/'\xff\n.msaa.yaml"
    with open(strange, "w") as file:
        file.write(SIZE + STORED)
    done = run(
        tmp_path,
        "check",
        "--isolated",
        ".",
        "--output",
        "parquet=a.parquet",
        "--output",
        "sqlite=a.sqlite",
    )
    assert (done.returncode, done.stderr) == (1, "")
    found = parquet_tables(tmp_path / "a.parquet")
    assert found["passes"] == sqlite_tables(tmp_path / "a.sqlite")["passes"]
    assert {row["pass"] for row in records(PASSES, found["passes"])} == {name, "forward"}
    assert {row["input"] for row in records(PASSES, found["passes"])} == {
        "a.msaa.yaml",
        "'\\udcff\n.msaa.yaml",
    }


@pytest.mark.parametrize(
    ("output", "message"),
    [
        ("parquet", "`--output parquet` needs a file: write `--output parquet=findings.parquet`"),
        ("sqlite=-", "`--output sqlite` needs a file: write `--output sqlite=findings.sqlite`"),
        ("parquet=findings", "`--output parquet` must name a .parquet file, found `findings`"),
        ("sqlite=.", "`--output sqlite` must name a regular file, found `.`"),
        (
            "sqlite=frame.msaa.yaml",
            "frame.msaa.yaml is an input, which the output would replace; write it to another file",
        ),
        ("sqlite=gone/a.sqlite", "cannot write gone/a.sqlite: No such file or directory"),
        ("parquet=gone/a.parquet", "cannot write gone/a.parquet: No such file or directory"),
    ],
)
def test_an_output_that_cannot_be_written_is_one_line(
    tmp_path: Path, output: str, message: str
) -> None:
    (tmp_path / "frame.msaa.yaml").write_text(STORED)
    done = run(tmp_path, "check", "--isolated", "frame.msaa.yaml", "--output", output)
    assert (done.returncode, done.stdout, done.stderr) == (2, "", f"msaa-lint: {message}\n")
    assert (
        os.listdir(tmp_path) == ["frame.msaa.yaml"]
        and (tmp_path / "frame.msaa.yaml").read_text() == STORED
    )


def test_two_outputs_never_share_a_file(tmp_path: Path) -> None:
    (tmp_path / "frame.msaa.yaml").write_text(STORED)
    done = run(
        tmp_path,
        "check",
        "frame.msaa.yaml",
        "--output",
        "parquet=a.parquet",
        "--output",
        "json=a.run.parquet",
    )
    assert (done.returncode, done.stderr) == (
        2,
        "msaa-lint: two outputs go to a.run.parquet; write each to a file of its own\n",
    )


def test_tables_are_not_written_through_a_link(tmp_path: Path) -> None:
    (tmp_path / "frame.msaa.yaml").write_text(STORED)
    links = [tmp_path / name for name in ("a.sqlite", "a.parquet", "a.run.parquet")]
    secrets = [tmp_path / f"secret-{link.name}" for link in links]
    for link, secret in zip(links, secrets, strict=True):
        secret.write_text("keep")
        link.symlink_to(secret)
    run(
        tmp_path,
        "check",
        "--isolated",
        "frame.msaa.yaml",
        "--output",
        "parquet=a.parquet",
        "--output",
        "sqlite=a.sqlite",
    )
    assert {secret.read_text() for secret in secrets} == {"keep"} and not any(
        link.is_symlink() for link in links
    )


def test_a_failure_leaves_the_old_tables(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "frame.msaa.yaml").write_text(STORED)
    command = (
        "check",
        "--isolated",
        "frame.msaa.yaml",
        "--output",
        "parquet=a.parquet",
        "--output",
        "sqlite=a.sqlite",
    )
    assert run(tmp_path, *command).returncode == 1
    before = {entry.name: entry.read_bytes() for entry in tmp_path.iterdir()}
    (tmp_path / "frame.msaa.yaml").write_text(STORED + "# changed\n")
    before["frame.msaa.yaml"] += b"# changed\n"

    def fail(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("msaa_lint.cli.report.rows._input", fail)
    done = run(tmp_path, *command)
    assert (done.returncode, done.stderr) == (
        2,
        "msaa-lint: cannot write a.parquet: No space left on device\n",
    )
    assert {entry.name: entry.read_bytes() for entry in tmp_path.iterdir()} == before


def test_a_configuration_cannot_ask_for_tables(tmp_path: Path) -> None:
    (tmp_path / "frame.msaa.yaml").write_text(STORED)
    (tmp_path / "msaa-lint.toml").write_text('output = ["sqlite"]\n')
    done = run(tmp_path, "check", "frame.msaa.yaml")
    assert done.returncode == 2 and "MSAA921" in done.stdout


def test_sqlite_holds_one_table_for_each_with_typed_columns(folder: Path) -> None:
    with sqlite3.connect(folder / "a.sqlite") as connection:
        names = [row[0] for row in connection.execute("SELECT name FROM sqlite_schema")]
        kinds = {row[2] for row in connection.execute("PRAGMA table_info(findings)")}
    assert (names, kinds) == ([table.name for table in TABLES], {"TEXT", "INTEGER", "REAL"})
