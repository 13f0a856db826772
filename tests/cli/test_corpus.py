"""`msaa-lint corpus`: what it prints of the rows of runs, and that neither files nor SQL of a
stranger do more than be read.
"""

from __future__ import annotations

import functools
import json
import os
import re
import shutil
import sqlite3
from contextlib import closing
from pathlib import Path

import jsonschema
import pytest

pytest.importorskip("duckdb")
pytest.importorskip("pyarrow")

import msaa_lint.cli.report
from msaa_lint.core.package import VERSION
from msaa_lint.linter.corpus.tables import TABLES, parquet_paths
from tests.cli.corpora import SIZE, sqlite_tables, write_inputs
from tests.cli.report.hostile import TOKENS
from tests.command import run, run_process
from tests.descriptions import CLEAN, STORED
from tests.paths import ROOT

GOLDEN = ROOT / "tests" / "golden" / "corpus"
SUFFIXES = {"full": "txt", "markdown": "md", "json": "json", "html": "html"}


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Two runs: between `old` and `new`, one mistake is fixed, one is made, and an input is
    added.
    """
    path = tmp_path_factory.mktemp("corpus")
    write_inputs(path / "inputs")
    run(
        path,
        "check",
        "--isolated",
        "inputs",
        "--output",
        "parquet=old.parquet",
        "--output",
        "sqlite=old.sqlite",
    )
    frames = (path / "inputs" / "frames.msaa.yaml").read_text()
    (path / "inputs" / "frames.msaa.yaml").write_text(
        "# moved by a line\n" + frames.replace("storeOp: STORE", "storeOp: DONT_CARE", 1)
    )
    (path / "inputs" / "clean.msaa.yaml").write_text(SIZE + STORED)
    (path / "inputs" / "more.msaa.yaml").write_text(SIZE + CLEAN)
    done = run(
        path,
        "check",
        "--isolated",
        "inputs",
        "--output",
        "parquet=new.parquet",
        "--output",
        "sqlite=new.sqlite",
    )
    assert (done.returncode, done.stderr) == (2, "")
    return path


@functools.cache
def validator() -> jsonschema.Draft202012Validator:
    schema = json.loads(
        Path(msaa_lint.cli.report.__file__).with_name("corpus_v1.schema.json").read_text()
    )
    jsonschema.Draft202012Validator.check_schema(schema)
    return jsonschema.Draft202012Validator(schema)


def answer(folder: Path, *words: str) -> dict[str, object]:
    """What JSON says, which is as its schema says."""
    done = run(folder, "corpus", *words, "--output", "json")
    assert (done.returncode, done.stderr) == (0, "")
    found = json.loads(done.stdout)
    validator().validate(found)
    return found  # type: ignore[no-any-return]


@pytest.mark.parametrize("format", SUFFIXES)
@pytest.mark.parametrize("by", ["rule", "device"])
def test_outputs(folder: Path, format: str, by: str) -> None:
    """UPDATE=1 rewrites the files."""
    done = run(
        folder,
        "corpus",
        "new.parquet",
        "--since",
        "old.sqlite",
        "--by",
        by,
        "--top",
        "4",
        "--output",
        format,
    )
    assert (done.returncode, done.stderr) == (0, "")
    text = re.sub('"configuration": "[0-9a-f]{32}"', '"configuration": ""', done.stdout).replace(
        VERSION, "VERSION"
    )
    if format == "html":
        assert "default-src &#39;none&#39;" in text
        text = text[text.index("<body>") : text.index("<footer")]
    path = GOLDEN / f"{by}.{SUFFIXES[format]}"
    if os.environ.get("UPDATE"):
        path.write_text(text)
    assert text == path.read_text()
    if format == "full":
        assert max(map(len, done.stdout.splitlines())) <= 80


def test_the_sums_are_those_of_the_rows(folder: Path) -> None:
    found = sqlite_tables(folder / "new.sqlite")["findings"]
    names = [column.name for column in TABLES[0].columns]
    rows = [dict(zip(names, row, strict=True)) for row in found]
    shown = [row for row in rows if row["suppressed"] is None]
    groups = {group["rule"]: group for group in answer(folder, "new.sqlite")["groups"]}  # type: ignore[attr-defined]
    assert set(groups) == {row["rule"] for row in shown}
    for rule, group in groups.items():
        priced = [row for row in shown if row["rule"] == rule and row["is_saving"]]
        traffic = sorted(row["read_mb_per_s"] + row["write_mb_per_s"] for row in priced)
        assert group["findings"] == sum(row["rule"] == rule for row in shown)
        assert group["inputs"] == len({row["input"] for row in shown if row["rule"] == rule})
        assert (group["priced"], group["traffic_mb_per_s"]) == (
            len(priced),
            pytest.approx(sum(traffic), abs=1e-5),
        )
        assert group["milliwatts"] == pytest.approx(
            sum(row["milliwatts"] for row in priced), abs=1e-5
        )
        assert group["prices_mb_per_s"]["max"] == (
            pytest.approx(traffic[-1], abs=1e-5) if traffic else None
        )
        if len(traffic) % 2:
            assert group["prices_mb_per_s"]["p50"] == pytest.approx(
                traffic[len(traffic) // 2], abs=1e-5
            )


@pytest.mark.parametrize("by", ["rule", "engine", "device", "input"])
def test_parquet_and_sqlite_have_the_same_answers(folder: Path, by: str) -> None:
    one, other = (
        answer(folder, f"new.{kind}", "--since", f"old.{kind}", "--by", by)
        for kind in ("parquet", "sqlite")
    )
    for each in (one, other):
        each["runs"][0].pop("file")  # type: ignore[index]
        each["since"].pop("files")  # type: ignore[attr-defined]
    assert one == other and one["groups"]


def test_several_files_and_folders_are_one_corpus(folder: Path, tmp_path: Path) -> None:
    shutil.copytree(
        folder, tmp_path / "runs" / "a[1]*", ignore=shutil.ignore_patterns("*.sqlite", "inputs")
    )
    shutil.copy(folder / "new.sqlite", tmp_path / "b'.db")
    alone, both = answer(folder, "new.sqlite"), answer(tmp_path, "runs", "b'.db")
    old = answer(folder, "old.sqlite")
    assert both["findings"] == 2 * alone["findings"] + old["findings"]  # type: ignore[operator]
    assert [run["file"] for run in both["runs"]] == [  # type: ignore[attr-defined]
        os.path.join("runs", "a[1]*", "new.parquet"), os.path.join("runs", "a[1]*", "old.parquet"),
        "b'.db",
    ]  # fmt: skip


def test_since_knows_moved_findings_again(folder: Path) -> None:
    since = answer(folder, "new.parquet", "--since", "old.parquet")["since"]
    assert {key: since[key] for key in ("new", "gone", "new_inputs", "gone_inputs",
    "remarks")} == {  # type: ignore[index]
        "new": 2, "gone": 2, "new_inputs": 1, "gone_inputs": 0, "remarks": [],
    }  # fmt: skip
    same = answer(folder, "new.parquet", "--since", "new.sqlite")["since"]
    assert (same["new"], same["gone"], same["rules"]) == (0, 0, [])  # type: ignore[index]


def counts(since: object) -> dict[str, int]:
    assert isinstance(since, dict)
    return {
        key: since[key]
        for key in ("new", "gone", "new_inputs", "gone_inputs", "moved_inputs")
        if since[key]
    }


def test_since_knows_moved_inputs_again(tmp_path: Path) -> None:
    """One is renamed, one is moved and edited, one is replaced by another one, and the folder is
    named in another way.
    """

    def checked(folder: str, output: str) -> None:
        assert (
            run(
                tmp_path, "check", "--isolated", folder, "--output", f"sqlite={output}.sqlite"
            ).returncode
            == 1
        )

    def since(after: str, before: str) -> dict[str, int]:
        return counts(answer(tmp_path, f"{after}.sqlite", "--since", f"{before}.sqlite")["since"])

    folder = tmp_path / "inputs"
    glow = STORED.replace("forward", "glow")
    for name, text in {
        "a/one": STORED,
        "a/b/two": glow,
        "three": CLEAN,
        "c/same": CLEAN,
        "d/same": CLEAN,
    }.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / f"{name}.msaa.yaml").write_text(SIZE + text)
    checked("inputs", "old")
    shutil.copytree(folder, tmp_path / "data")
    checked("data", "data")
    assert since("data", "old") == since("old", "data") == {"moved_inputs": 5}
    (folder / "a/one.msaa.yaml").rename(folder / "renamed.msaa.yaml")
    (folder / "x").mkdir()
    (folder / "a/b").rename(folder / "x/b")
    (folder / "x/b/two.msaa.yaml").write_text(SIZE + glow + "---\n" + STORED)
    (folder / "three.msaa.yaml").unlink()
    (folder / "other.msaa.yaml").write_text(SIZE + STORED.replace("forward", "other"))
    checked("inputs", "new")
    per_frame = len(
        [row for row in sqlite_tables(tmp_path / "old.sqlite")["findings"] if "one" in row[0]]
    )
    assert since("new", "old") == {
        "new": 2 * per_frame,
        "new_inputs": 1,
        "gone_inputs": 1,
        "moved_inputs": 2,
    }
    assert since("old", "new") == {
        "gone": 2 * per_frame,
        "new_inputs": 1,
        "gone_inputs": 1,
        "moved_inputs": 2,
    }


def test_since_ignores_indices_and_numbers_of_captured_objects(
    folder: Path, tmp_path: Path
) -> None:
    for name in ("old", "new"):
        shutil.copy(folder / "new.sqlite", tmp_path / f"{name}.sqlite")
    subjects = {
        "old": ("commands[1].draw", "images.color 4x #3", "images.color 4x #7"),
        "new": ("commands[2].draw", "images.color 4x #4", "images.a"),
    }
    for name, stated in subjects.items():
        with closing(
            sqlite3.connect(tmp_path / f"{name}.sqlite", isolation_level=None)
        ) as connection:
            connection.execute("DELETE FROM findings WHERE rowid > ?", (len(stated),))
            for number, subject in enumerate(stated, 1):
                connection.execute(
                    "UPDATE findings SET input = 'i', rule = 'r', line = ?, subject = ? WHERE "
                    "rowid = ?",
                    (number, subject, number),
                )
    assert counts(answer(tmp_path, "new.sqlite", "--since", "old.sqlite")["since"]) == {
        "new": 1,
        "gone": 1,
    }


def test_since_says_what_else_differs(folder: Path, tmp_path: Path) -> None:
    run(
        folder,
        "check",
        "--isolated",
        "inputs",
        "--ignore",
        "MSAA4",
        "--output",
        f"sqlite={tmp_path / 'less.sqlite'}",
    )
    done = run(folder, "corpus", "new.sqlite", "--since", str(tmp_path / "less.sqlite"))
    assert (
        "since: the earlier run had another configuration: findings may be new or gone because of "
        "it\n" in done.stdout
    )


def test_a_query_of_ones_own(folder: Path) -> None:
    sql = (
        "select i.format, count(*) as n, sum(p.read_mb_per_s) from passes p join inputs i using "
        "(corpus, input) group by all order by n"
    )
    done = run(folder, "corpus", "new.parquet", "--sql", sql)
    assert (done.returncode, done.stderr) == (0, "") and done.stdout.splitlines()[0].split() == [
        "format",
        "n",
        "sum(p.read_mb_per_s)",
    ]
    found = answer(
        folder,
        "new.sqlite",
        "--since",
        "old.sqlite",
        "--sql",
        "select count(*) as n, null, 1.5 from since.findings",
    )
    assert (found["columns"], found["rows"]) == (
        ["n", "NULL", "1.5"],
        [[len(sqlite_tables(folder / "old.sqlite")["findings"]), None, 1.5]],
    )
    assert (
        run(folder, "corpus", "new.parquet", "--sql", "select * from run where false").stdout
        == "No rows\n"
    )


def secret(folder: Path) -> str:
    (folder / "secret.csv").write_text("secret\n1\n")
    return (folder / "secret.csv").as_posix()


@pytest.mark.parametrize(
    "sql",
    [
        "select * from read_text('{secret}')",
        "select * from read_csv('{secret}')",
        "select * from '{secret}'",
        "select * from read_blob('/etc/passwd')",
        "select * from glob('/etc/*')",
        "select * from sniff_csv('{secret}')",
        "select * from parquet_metadata('new.parquet')",
        "select * from json_execute_serialized_sql(json_serialize_sql('select * from "
        "read_text(''{secret}'')'))",
        "select * from query('select * from read_text(''{secret}'')')",
        "select getenv('HOME')",
        "select * from file",
        "select * from enable_logging(storage='file', storage_config={{'path': 'written'}})",
        "select * from enable_profiling(save_location='written')",
        "copy findings to 'written'",
        "copy (select 1) to 'written' (format parquet)",
        "export database 'written'",
        "attach 'written' as other",
        "install httpfs",
        "load 'written'",
        "set enable_external_access = true",
        "pragma enable_profiling = 'json'",
        "create table other as select 1",
        "drop view findings",
        "select 1; copy findings to 'written'",
        "with x as (select 1) insert into run select * from x",
        "call pragma_version()",
        "",
        "select",
    ],
)
def test_sql_reads_the_tables_and_nothing_else(folder: Path, sql: str) -> None:
    stated = sql.format(secret=secret(folder))
    before = sorted(os.listdir(folder))
    for corpus in ("new.parquet", "new.sqlite"):
        content = (folder / corpus).read_bytes()
        done = run(folder, "corpus", corpus, "--sql", stated)
        assert (done.returncode, done.stdout, done.stderr.count("\n")) == (2, "", 1)
        assert done.stderr.startswith(
            ("msaa-lint: --sql: ", "msaa-lint: `--sql` must be one SELECT")
        )
        assert "root:" not in done.stderr and (folder / corpus).read_bytes() == content
    assert sorted(os.listdir(folder)) == before


def test_a_process_says_nothing_else(folder: Path) -> None:
    """The binding of DuckDB complains of what is not collected at exit."""
    done = run_process(folder, "corpus", "new.parquet", "--quiet")
    assert (done.returncode, done.stderr) == (0, "") and "note:" not in done.stdout


def test_hostile_rows_are_escaped(tmp_path: Path) -> None:
    name = "".join(TOKENS).replace("\0", "").encode("utf-8", "replace").decode()
    (tmp_path / "a.msaa.yaml").write_text(SIZE + STORED)
    run(tmp_path, "check", "--isolated", "a.msaa.yaml", "--output", "sqlite=a.sqlite")
    with closing(sqlite3.connect(tmp_path / "a.sqlite", isolation_level=None)) as connection:
        connection.execute("UPDATE findings SET rule = ?, input = ?", (name, f"\x1b[31m{name}"))
        connection.execute("UPDATE inputs SET device = ?, input = ?", (name, f"\x1b[31m{name}"))
        connection.execute("UPDATE run SET version = ?, edition = ?", (name, name))
    for words in (
        ["--by", "device"],
        ["--by", "input"],
        ["--sql", "select rule, input from findings"],
    ):
        for format in ("full", "markdown", "html"):
            done = run(
                tmp_path, "corpus", "a.sqlite", *words, "--since", "a.sqlite", "--output", format
            )
            assert (done.returncode, done.stderr) == (0, "")
            assert not set("\x1b\u202e\r\x85\u2028") & set(done.stdout)
            assert format == "full" or "<script>alert" not in done.stdout
            assert not any(line.lstrip().startswith("::") for line in done.stdout.splitlines())


@pytest.mark.parametrize("format", SUFFIXES)
def test_every_value_may_be_null(folder: Path, tmp_path: Path, format: str) -> None:
    shutil.copy(folder / "new.sqlite", tmp_path / "a.sqlite")
    for table in TABLES:
        for column in (column.name for column in table.columns if column.name != "schema"):
            statement(tmp_path / "a.sqlite", f'UPDATE {table.name} SET "{column}" = NULL')
    for words in (["--by", "rule"], ["--by", "device"], ["--since", str(folder / "old.sqlite")]):
        done = run(tmp_path, "corpus", "a.sqlite", *words, "--output", format)
        assert (done.returncode, done.stderr) == (0, "")
        if format == "json":
            validator().validate(json.loads(done.stdout))


@pytest.mark.parametrize(
    ("sql", "message"),
    [
        (
            "select rul from findings",
            'Binder Error: Referenced column "rul" not found in FROM clause! Candidate bindings: '
            '"rule"',
        ),
        (
            "select *\nfrom finding",
            "Catalog Error: Table with name finding does not exist! Did you mean ",
        ),
        (
            "select error('two' || chr(10) || 'lines' || chr(27))",
            "Invalid Input Error: two lines\\x1b\n",
        ),
        (
            "select sum(message) from findings",
            "Binder Error: No function matches the given name and argument types",
        ),
    ],
)
def test_a_wrong_query_is_one_line(folder: Path, sql: str, message: str) -> None:
    done = run(folder, "corpus", "new.parquet", "--sql", sql)
    assert (done.returncode, done.stdout, done.stderr.count("\n")) == (2, "", 1)
    assert done.stderr.startswith(f"msaa-lint: --sql: {message}") and len(done.stderr) < 500


@pytest.mark.skipif(os.name == "nt", reason="Windows has no such names")
@pytest.mark.parametrize("format", ["full", "markdown", "html"])
def test_names_of_files_are_escaped(folder: Path, tmp_path: Path, format: str) -> None:
    name = "x\n::error::\x1b[31m|<script>alert(1).sqlite"
    shutil.copy(folder / "new.sqlite", tmp_path / name)
    done = run(tmp_path, "corpus", name, "--since", name, "--output", format)
    assert (done.returncode, done.stderr) == (0, "")
    assert "\x1b" not in done.stdout and not any(
        line.startswith("::") for line in done.stdout.splitlines()
    )
    assert format == "full" or "<script>alert" not in done.stdout


def with_metadata(path: Path, **stated: str) -> None:
    import pyarrow.parquet as pq

    table = pq.read_table(path)
    pq.write_table(
        table.replace_schema_metadata(
            {**{k.decode(): v.decode() for k, v in table.schema.metadata.items()}, **stated}
        ),
        path,
    )


def older(path: Path) -> None:
    if path.suffix == ".parquet":
        with_metadata(path, schema="msaa-lint/rows-v0", version="0.0.1")
    else:
        statement(path, "UPDATE run SET schema = 'msaa-lint/rows-v0', version = '0.0.1'")


def statement(path: Path, sql: str) -> None:
    with closing(sqlite3.connect(path, isolation_level=None)) as connection:
        connection.execute(sql)


WRONG = "written by msaa-lint 0.0.1 as `msaa-lint/rows-v0`; msaa-lint "
SPOILED = {
    "older parquet": ("new.parquet", older, WRONG),
    "older sqlite": ("new.sqlite", older, WRONG),
    "no table": (
        "new.sqlite",
        lambda path: statement(path, "DROP TABLE passes"),
        "the table `passes` is missing",
    ),
    "no file": (
        "new.parquet",
        lambda path: os.unlink(parquet_paths(str(path))["inputs"]),
        "the table `inputs` is missing: expected it in ",
    ),
    "a view": (
        "new.sqlite",
        lambda path: (
            statement(path, "DROP TABLE run"),
            statement(path, "CREATE VIEW run AS SELECT 1 AS schema"),
        ),
        "the table `run` is missing",
    ),
    "other columns": (
        "new.sqlite",
        lambda path: statement(path, "ALTER TABLE findings DROP COLUMN rule"),
        "the columns are not those of the table",
    ),
    "other types": (
        "new.sqlite",
        lambda path: statement(path, "UPDATE findings SET line = 'x'"),
        "",
    ),
    "other database": (
        "new.sqlite",
        lambda path: [statement(path, f"DROP TABLE {table.name}") for table in TABLES],
        "a SQLite database, but not",
    ),
    "other table": (
        "new.parquet",
        lambda path: shutil.copy(parquet_paths(str(path))["run"], path),
        "the table `run` of a corpus; name the file",
    ),
    "cut off": ("new.parquet", lambda path: path.write_bytes(path.read_bytes()[:500]), ""),
    "cut off database": ("new.sqlite", lambda path: path.write_bytes(path.read_bytes()[:5000]), ""),
    "damaged": (
        "new.parquet",
        lambda path: path.write_bytes(b"PAR1" + bytes(500) + path.read_bytes()[504:]),
        "",
    ),
    "empty": (
        "new.sqlite",
        lambda path: path.write_bytes(b""),
        "not a corpus: expected a file that `msaa-lint check` wrote",
    ),
}


@pytest.mark.parametrize("case", SPOILED)
def test_a_file_that_cannot_be_used_is_one_line(folder: Path, tmp_path: Path, case: str) -> None:
    name, spoil, message = SPOILED[case]
    for each in folder.glob("new.*"):
        shutil.copy(each, tmp_path)
    spoil(tmp_path / name)
    done = run(tmp_path, "corpus", name)
    assert (done.returncode, done.stdout, done.stderr.count("\n")) == (2, "", 1), done
    assert (
        message in done.stderr
        and name.split(".")[0] in done.stderr
        and "internal error" not in done.stderr
    )


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["gone"], "gone: No such file or directory"),
        (
            ["inputs"],
            "inputs: no corpus in this folder; `msaa-lint check --output parquet=findings.parquet` "
            "writes one",
        ),
        (
            ["new.parquet", "--by", "pass"],
            "unknown value `pass` of `--by`: expected one of rule, engine, device, input",
        ),
        (
            ["new.parquet", "--sql", "select 1", "--top", "3"],
            "`--sql` is instead of `--by` and `--top`: write ORDER BY and LIMIT in the query",
        ),
        (
            ["new.parquet", "--output", "json=new.run.parquet"],
            "new.run.parquet is an input, which the output would replace; write it to another file",
        ),
    ],
)
def test_wrong_words_are_one_line(folder: Path, words: list[str], message: str) -> None:
    done = run(folder, "corpus", *words)
    assert (done.returncode, done.stdout, done.stderr) == (2, "", f"msaa-lint: {message}\n")


def test_a_corpus_without_findings(tmp_path: Path) -> None:
    (tmp_path / "clean.msaa.yaml").write_text(CLEAN)
    assert (
        run(tmp_path, "check", "--isolated", ".", "--output", "parquet=a.parquet").returncode == 0
    )
    done = run(tmp_path, "corpus", "a.parquet", "--since", "a.parquet")
    assert done.returncode == 0 and done.stdout.splitlines()[-1] == "No findings"


def test_the_extra_is_named_where_it_is_missing(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for module in ("corpus", "table_outputs"):
        monkeypatch.setattr(f"msaa_lint.cli.{module}.find_spec", lambda name: None)
    for words in (["corpus", "new.parquet"], ["check", "inputs", "--output", "parquet=a.parquet"]):
        done = run(folder, *words)
        assert (
            done.returncode == 2
            and "needs the extra `corpus`: run `" in done.stderr
            and done.stderr.count("\n") == 1
        )
