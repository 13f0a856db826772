"""The commands around `check`."""

from __future__ import annotations

import json
from importlib import import_module
from pathlib import Path

import pytest

from msaa_lint import __version__
from msaa_lint.cli.commands import COMMANDS
from msaa_lint.cli.options import CAPTURE_FORMATS, INPUT_FORMATS, SCHEMAS, SHARED
from msaa_lint.input import readers
from msaa_lint.input.file_types import LANGUAGES
from msaa_lint.linter.settings.settings import OUTPUT_FORMATS
from tests.command import run
from tests.paths import ROOT


def test_version_and_help(tmp_path: Path) -> None:
    assert run(tmp_path, "--version").stdout == f"msaa-lint {__version__}\n"
    shown = run(tmp_path, "check", "--help").stdout
    assert all(option.flag in shown for option in COMMANDS["check"].options)


def test_did_you_mean(tmp_path: Path) -> None:
    done = run(tmp_path, "chek")
    assert done.returncode == 2
    assert "`check`" in done.stderr
    done = run(tmp_path, "rule", "multisampled-stored")
    assert done.returncode == 2
    assert "multisampled-attachment-stored" in done.stderr


def test_rule(tmp_path: Path) -> None:
    page = run(tmp_path, "rule", "MSAA201").stdout
    assert page.startswith("# multisampled-attachment-stored\n")
    assert "## Why" in page
    assert (
        json.loads(run(tmp_path, "rule", "MSAA201", "--output", "json").stdout)["name"]
        == "multisampled-attachment-stored"
    )
    every = json.loads(run(tmp_path, "rule", "--all", "--output", "json").stdout)
    assert len({rule["code"] for rule in every}) == len(every) >= 59


def test_facts(tmp_path: Path) -> None:
    (tmp_path / "a.yaml").write_text(
        "images: {a: {format: R8_UNORM, samples: 4}}\n", encoding="utf-8"
    )
    (row,) = json.loads(run(tmp_path, "facts", "a.yaml", "--output", "json").stdout)
    assert row["path"] == "images.a"
    assert row["facts"]["image.samples"] == {"value": 4, "line": 1}
    assert row["facts"]["image.usage"]["value"] is None
    assert run(tmp_path, "facts", "missing.yaml").returncode == 2


def test_schema(tmp_path: Path) -> None:
    schema = json.loads(run(tmp_path, "schema").stdout)
    assert "renderPasses" in schema["properties"]
    for which in SCHEMAS[1:]:
        assert json.loads(run(tmp_path, "schema", which).stdout)["$id"] == f"urn:msaa-lint:{which}"


def test_the_formats_are_those_there_are() -> None:
    modules = {"html": "html/check.py"}
    assert all(
        (ROOT / "msaa_lint/cli/report" / modules.get(name, f"{name}.py")).exists()
        for name in OUTPUT_FORMATS
    )
    assert tuple(readers.CAPTURES) == CAPTURE_FORMATS
    assert sorted(INPUT_FORMATS) == sorted([*readers.FORMATS, *readers.CAPTURES, *LANGUAGES])


@pytest.mark.parametrize("command", ["check", "cost", "confirm", "study"])
def test_commands_share_options(tmp_path: Path, command: str) -> None:
    shown = run(tmp_path, command, "--help").stdout
    assert [option.flag for option in SHARED if option.flag not in shown] == []


def test_cost_reads_as_the_format_that_is_named(tmp_path: Path) -> None:
    (tmp_path / "a.yaml").write_text("images: {}\n", encoding="utf-8")
    assert run(tmp_path, "cost", "--input-format", "description", "a.yaml").returncode == 0
    done = run(tmp_path, "cost", "--input-format", "vulkan-sc", "a.yaml")
    assert done.returncode == 2
    assert "MSAA903" in done.stderr


@pytest.mark.parametrize("command", ["check", "cost", "confirm", "study"])
def test_commands_end_alike_where_an_output_is_wrong(tmp_path: Path, command: str) -> None:
    (tmp_path / "a.yaml").write_text("images: {}\n", encoding="utf-8")
    done = run(tmp_path, command, "a.yaml", "--output", "jsn=\u202e")
    assert (done.returncode, done.stdout, done.stderr) == (
        2,
        "",
        "msaa-lint: unknown output format `jsn`: did you mean `json`?\n",
    )
    done = run(tmp_path, command, "a.yaml", "--output", "json", "--output", "full=-")
    assert (done.returncode, done.stdout) == (2, "")
    assert (
        "msaa-lint: only one output can go to standard output; write the others to files, as in "
        "--output " in done.stderr
    )
    done = run(tmp_path, command, "a.yaml", "--output", "\u202e")
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith("msaa-lint: unknown output format `\\u202e`: ")


@pytest.mark.parametrize(
    ("words", "function"),
    [
        (["rule", "--all"], "list_rules"),
        (["rule", "x"], "explain_rule"),
        (["device", "x"], "print_devices"),
        (["facts"], "print_reference"),
        (["facts", "a.yaml"], "print_facts"),
        (["convert", "a.yaml"], "convert_input"),
        (["schema"], "print_schema"),
        (["baseline", "a.yaml"], "write_baseline"),
        (["init"], "write_files"),
    ],
)
def test_internal_errors_are_one_line(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, words: list[str], function: str
) -> None:
    def fail(*values: object) -> int:
        raise ZeroDivisionError("division by zero")

    monkeypatch.setattr(import_module(f"msaa_lint.cli.{words[0]}"), function, fail)
    done = run(tmp_path, *words)
    assert (done.returncode, done.stdout) == (2, "")
    assert (
        done.stderr
        == "msaa-lint: internal error: ZeroDivisionError: division by zero (--traceback shows "
        "where)\n"
    )
