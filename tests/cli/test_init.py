"""`msaa-lint init`: what it writes is a project that can be linted and edited at once."""

from __future__ import annotations

import json
import os
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

import jsonschema
import pytest
import yaml

from tests.command import run
from tests.paths import ROOT


def test_init_makes_a_project_that_lints(tmp_path: Path) -> None:
    done = run(tmp_path, "init", "a b")
    assert done.returncode == 0
    assert "The frame in 'a b/frame.msaa.yaml' has a mistake on purpose" in done.stdout
    frame = (tmp_path / "a b" / "frame.msaa.yaml").read_text(encoding="utf-8")
    schema = tmp_path / "a b" / re.findall(r"\$schema=(\S+)", frame)[0]
    assert schema.read_text(encoding="utf-8") == run(tmp_path, "schema").stdout
    jsonschema.validate(yaml.safe_load(frame), json.loads(schema.read_text(encoding="utf-8")))
    checked = run(tmp_path, *shlex.split(re.findall(r"  msaa-lint (check .*)", done.stdout)[0]))
    assert checked.returncode == 1
    assert {
        line.split(":")[1] for line in checked.stdout.splitlines() if line.startswith("a b/")
    } == {"24"}


def test_what_init_wrote_is_one_input(tmp_path: Path) -> None:
    run(tmp_path, "init")
    done = run(tmp_path, "check", "--output", "json", ".")
    assert {finding["file"] for finding in json.loads(done.stdout)["findings"]} == {
        "frame.msaa.yaml"
    }
    assert run(tmp_path, "check", "--fix", ".").returncode == 0


def test_init_changes_no_file(tmp_path: Path) -> None:
    for name in ("msaa-lint.toml", "frame.msaa.yaml", "msaa-lint.schema.json"):
        (tmp_path / name).write_text("# one's own\n", encoding="utf-8")
    done = run(tmp_path, "init")
    assert done.returncode == 0
    assert done.stderr.count("already exists: left unchanged") == 3
    assert "on purpose" not in done.stdout
    assert {path.read_text(encoding="utf-8") for path in tmp_path.iterdir()} == {"# one's own\n"}


def test_init_keeps_a_configuration_in_pyproject(tmp_path: Path) -> None:
    """msaa-lint.toml would take its place."""
    (tmp_path / "pyproject.toml").write_text(
        "[tool.msaa-lint]\nfail-on = 'error'\n", encoding="utf-8"
    )
    done = run(tmp_path, "init")
    assert "pyproject.toml configures msaa-lint: wrote no msaa-lint.toml" in done.stderr
    assert not (tmp_path / "msaa-lint.toml").exists()
    assert run(tmp_path, "check", ".").returncode == 0
    (tmp_path / "new").mkdir()
    (tmp_path / "new" / "pyproject.toml").write_text("[project]\n", encoding="utf-8")
    run(tmp_path, "init", "new")
    assert (tmp_path / "new" / "msaa-lint.toml").exists()


def test_the_examples_of_help_run_in_a_new_project(tmp_path: Path) -> None:
    run(tmp_path, "init")
    commands = re.findall(
        r"^ +msaa-lint (check .*)$", run(tmp_path, "check", "--help").stdout, re.MULTILINE
    )
    assert [run(tmp_path, *command.split()).returncode for command in commands] == [1, 0]


@pytest.mark.skipif(shutil.which("git") is None, reason="git is not installed")
def test_the_hook_that_init_prints_runs(tmp_path: Path) -> None:
    """By pre-commit, with the command `msaa-lint` of this checkout."""
    pytest.importorskip("pre_commit")
    done = run(tmp_path, "init")
    (tmp_path / "bin").mkdir()
    program = tmp_path / "bin" / "msaa-lint"
    program.write_text(
        f'#!/bin/sh\nPYTHONPATH={ROOT} exec {sys.executable} -m msaa_lint "$@"\n', encoding="utf-8"
    )
    program.chmod(0o755)
    (tmp_path / ".pre-commit-config.yaml").write_text(
        "repos:\n" + done.stdout[done.stdout.index("  - repo:") :], encoding="utf-8"
    )
    environment = {
        "PATH": f"{program.parent}:{os.environ['PATH']}",
        "HOME": str(tmp_path),
        "PRE_COMMIT_HOME": str(tmp_path / "cache"),
    }
    subprocess.run(["git", "init", "--quiet"], cwd=tmp_path, env=environment, check=True)
    subprocess.run(["git", "add", "."], cwd=tmp_path, env=environment, check=True)
    hook = subprocess.run(
        [sys.executable, "-m", "pre_commit", "run"],
        cwd=tmp_path,
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )
    assert hook.returncode == 1
    assert "frame.msaa.yaml:24:18: warning[multisampled-attachment-stored]" in hook.stdout
