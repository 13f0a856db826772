"""Completion of the command line, through the protocols of the shells."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from msaa_lint.cli.commands import COMMANDS
from msaa_lint.cli.options import CHECK_FORMATS, SCHEMAS
from tests.command import run, run_process
from tests.paths import ROOT


def completed(folder: Path, line: str) -> list[str]:
    """What bash is told to complete the last word of a line with."""
    words = line.split(" ")
    done = run_process(
        folder, _MSAA_LINT_COMPLETE="complete_bash", COMP_WORDS=line, COMP_CWORD=str(len(words) - 1)
    )
    assert done.stderr == ""
    return done.stdout.split()


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        ("msaa-lint ", list(COMMANDS)),
        ("msaa-lint ch", ["check"]),
        ("msaa-lint check --stat", ["--statistics"]),
        ("msaa-lint check --output ", list(CHECK_FORMATS)),
        ("msaa-lint check --output sa", ["sarif"]),
        ("msaa-lint check --output=sa", ["sarif"]),
        ("msaa-lint check --output = sa", ["sarif"]),
        ("msaa-lint check --fail-on ", ["note", "warning", "error"]),
        ("msaa-lint check --min-severity w", ["warning"]),
        ("msaa-lint check --fail-confidence ", ["low", "medium", "high"]),
        ("msaa-lint check --input-format rend", ["renderdoc"]),
        ("msaa-lint check --edition ", ["2026.1"]),
        ("msaa-lint check --select multisampled-attachment-s", ["multisampled-attachment-stored"]),
        ("msaa-lint check --ignore MSAA201,MSAA20", [f"MSAA201,MSAA20{n}" for n in range(1, 10)]),
        ("msaa-lint check --extend-select AL", ["ALL"]),
        ("msaa-lint check --profile mali-g6", ["mali-g610"]),
        ("msaa-lint cost --profile portable-t", ["portable-tiler"]),
        ("msaa-lint cost --samples 1,1", ["1,1", "1,16"]),
        ("msaa-lint confirm --profile nv", ["nvidia"]),
        ("msaa-lint confirm --samples 6", ["64"]),
        ("msaa-lint study edge", ["edge-fan"]),
        ("msaa-lint study --techniques msaa,s", ["msaa,sample-shading", "msaa,ssaa"]),
        ("msaa-lint study --backend d", ["dask"]),
        ("msaa-lint study --bits ", ["4", "8"]),
        ("msaa-lint rule multisampled-attachment-s", ["multisampled-attachment-stored"]),
        ("msaa-lint rule MSAA921", ["MSAA921"]),
        ("msaa-lint rule --output ma", ["markdown"]),
        ("msaa-lint device apple-m", ["apple-m1"]),
        ("msaa-lint facts --profile apple-m", ["apple-m1"]),
        ("msaa-lint schema ", list(SCHEMAS)),
        ("msaa-lint convert --input-format fo", ["fossilize"]),
        # What is a path is left to the shell.
        ("msaa-lint check fra", []),
        ("msaa-lint check --config ", []),
        ("msaa-lint check --output = sarif = ", []),
    ],
)
def test_values_are_completed(tmp_path: Path, line: str, expected: list[str]) -> None:
    found = completed(tmp_path, line)
    assert (set(found) == set(expected) and len(found) == len(set(found))) or (
        "ignore" in line and set(expected) <= set(found)
    )


def test_rules_of_the_configuration_are_completed(tmp_path: Path) -> None:
    page = (ROOT / "rules" / "multisampled-attachment-stored.md").read_text(encoding="utf-8")
    page = (
        page.replace("multisampled-attachment-stored", "no-zebras")
        .replace("MSAA201", "ZOO001")
        .replace("edition: 2026.1\n", "")
    )
    (tmp_path / "no-zebras.md").write_text(page, encoding="utf-8")
    (tmp_path / "msaa-lint.toml").write_text('rules = ["no-zebras.md"]\n', encoding="utf-8")
    assert completed(tmp_path, "msaa-lint check --select no-z") == ["no-zebras"]
    assert completed(tmp_path, "msaa-lint check --select ZOO") == ["ZOO001"]


def test_a_broken_configuration_completes_all_the_same(tmp_path: Path) -> None:
    (tmp_path / "msaa-lint.toml").write_text("rules = [\n", encoding="utf-8")
    assert completed(tmp_path, "msaa-lint check --select multisampled-attachment-s") == [
        "multisampled-attachment-stored"
    ]


def test_zsh_and_fish_show_what_values_mean(tmp_path: Path) -> None:
    words = "msaa-lint check --select multisampled-attachment-s"
    assert (
        "MSAA201"
        in run_process(
            tmp_path, _MSAA_LINT_COMPLETE="complete_zsh", _TYPER_COMPLETE_ARGS=words
        ).stdout
    )
    fish = {"_MSAA_LINT_COMPLETE": "complete_fish", "_TYPER_COMPLETE_FISH_ACTION": "get-args"}
    assert (
        run_process(tmp_path, **fish, _TYPER_COMPLETE_ARGS=words).stdout.strip()
        == "multisampled-attachment-stored\tMSAA201"
    )


@pytest.mark.parametrize(
    ("line", "expected"),
    [("check --output sa", "sarif"), ("check --output=sa", "sarif"), ("cos", "cost")],
)
def test_bash_itself_completes(tmp_path: Path, line: str, expected: str) -> None:
    bash = shutil.which("bash")
    if bash is None:
        pytest.skip("no bash")
    command = tmp_path / "msaa-lint"
    command.write_text(
        f'#!/bin/sh\nPYTHONPATH={ROOT} exec {sys.executable} -m msaa_lint "$@"\n', encoding="utf-8"
    )
    command.chmod(0o755)
    words = line.replace("=", " = ").split()
    script = (
        'eval "$(_MSAA_LINT_COMPLETE=source_bash msaa-lint)"\n'
        f"COMP_WORDS=(msaa-lint {' '.join(words)}); COMP_CWORD={len(words)}\n"
        "$(complete -p msaa-lint | sed 's/.* -F \\([^ ]*\\) .*/\\1/') msaa-lint; printf '%s\\n' "
        '"${COMPREPLY[@]}"\n'
    )
    environment = {"PATH": f"{tmp_path}{os.pathsep}{os.environ['PATH']}", "HOME": str(tmp_path)}
    done = subprocess.run(
        [bash, "--norc"],
        input=script,
        capture_output=True,
        text=True,
        env=environment,
        cwd=tmp_path,
        check=False,
    )
    assert (done.stdout.split(), done.stderr) == ([expected], "")


def test_completion_can_be_shown(tmp_path: Path) -> None:
    shown = run(tmp_path, "--help").stdout
    assert "--install-completion" in shown and "--show-completion" in shown
