"""Everything that the documentation tells to run works: the commands of each page, in order, in an
empty folder or in a clone.

`python -m tests.doc_blocks` counts them.
"""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
import yaml

from msaa_lint import lint
from msaa_lint.cli.commands import COMMANDS
from msaa_lint.frame.description.models import Description
from tests.command import environment_of, run
from tests.doc_blocks import PAGES, Block, blocks
from tests.paths import ROOT

LANGUAGES = {
    "sh",
    "console",
    "python",
    "yaml",
    "toml",
    "json",
    "cpp",
    "markdown",
    "text",
    "inline",
    "lua",
    "elisp",
    "groovy",
}

NOT_RUN = {
    "README.md": {
        "installs packages; tests/integration/test_release.py runs it",
        "runs all tests; .ci/run runs it",
    },
    "CONTRIBUTING.md": {
        "installs packages; tests/integration/test_release.py runs it",
        "publishes",
    },
    "docs/ci.md": {
        "URL stands for a repository; tests/integration/test_release.py runs it",
        "needs reviewdog and a token",
    },
    "docs/confirm.md": {"needs root", "needs a GPU"},
    "docs/devices.md": {"needs reports and a phone"},
    "docs/editors.md": {
        "installs packages from npm; tests/integration/test_vscode.py builds the extension"
    },
    "docs/guides/editor.md": {"runs until it is interrupted"},
    "docs/scale.md": {"needs a corpus, a cluster, and a bucket"},
    "docs/study.md": {"needs a GPU"},
}
"""Why blocks are not run, page by page."""

needs_tools = {"docs/ci.md": "git", "examples/capture/README.md": "gfxrecon-convert"}


class Reader:
    """Someone who types what a page says, in a folder that is empty at first, or in a clone."""

    def __init__(self, folder: Path) -> None:
        self.clone = folder / "clone"
        self.empty = folder / "empty"
        self.empty.mkdir()
        programs = folder / "bin"
        programs.mkdir()
        for name, arguments in {"msaa-lint": "-m msaa_lint", "python": "", "python3": ""}.items():
            (programs / name).write_text(
                f'#!/bin/sh\nexec {sys.executable} {arguments} "$@"\n', encoding="utf-8"
            )
            (programs / name).chmod(0o755)
        self.environment = environment_of(
            {"COLUMNS": "140", "PATH": f"{programs}{os.pathsep}{os.environ['PATH']}"}
        )

    def folder_of(self, block: Block) -> Path:
        if not block.in_clone:
            return self.empty
        if not self.clone.exists():
            names = subprocess.run(
                ["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, text=True, check=True
            ).stdout.split("\0")
            for name in names:
                if name and (ROOT / name).is_file():
                    (self.clone / name).parent.mkdir(parents=True, exist_ok=True)
                    shutil.copy(ROOT / name, self.clone / name)
        return self.clone

    def types(self, block: Block, command: str) -> subprocess.CompletedProcess[str]:
        done = subprocess.run(
            ["bash", "-c", command], cwd=self.folder_of(block), env=self.environment,
            stdin=subprocess.DEVNULL,
            capture_output=True, text=True, check=False,
        )  # fmt: skip
        assert "Traceback" not in done.stderr, done.stderr
        return done

    def saves(self, block: Block, name: str, text: str) -> None:
        path = self.folder_of(block) / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")


@pytest.mark.parametrize(
    "page", [page for page in PAGES if any(block.commands() for block in blocks(page))]
)
def test_commands(page: str, tmp_path: Path) -> None:
    if shutil.which(needs_tools.get(page, "sh")) is None:
        pytest.skip(f"{needs_tools[page]} is not installed")
    reader = Reader(tmp_path)
    text = (ROOT / page).read_text(encoding="utf-8")
    for block in blocks(page):
        if block.file_name:
            reader.saves(block, block.file_name, block.text)
        if block.language == "markdown":
            named = re.search(r"As `([\w./-]+\.md)`", text)
            assert named, f"{block.place}: no file name follows"
            reader.saves(block, named[1], block.text)
        if block.skipped:
            continue
        if block.language == "sh":
            for command in block.commands():
                stated = re.search(r"# .*\bexits with (\d)", command)
                done = reader.types(block, command)
                assert done.returncode == (int(stated[1]) if stated else 0), (
                    f"{block.place}: {command}\n{done.stdout}{done.stderr}"
                )
        elif block.language == "console":
            (command,) = block.commands()
            done = reader.types(
                block, command if "--output" in command else f"{command} --output full"
            )
            assert done.returncode in (0, 1), f"{block.place}: {done.stderr}"
            shown = f"$ {command}\n{done.stdout}"
            if os.environ.get("UPDATE"):
                text = text.replace(block.text, shown)
                (ROOT / page).write_text(text, encoding="utf-8")
            else:
                assert block.text == shown, block.place
        elif block.language == "python":
            reader.saves(block, "script.py", block.text)
            done = reader.types(block, "python script.py")
            assert (done.returncode, done.stderr) == (0, ""), block.place
            assert done.stdout
        elif block.language == "inline":
            done = reader.types(block, block.text)
            assert done.returncode in (0, 1), f"{block.place}: {block.text}\n{done.stderr}"


def flags_of(command: str) -> set[str]:
    return {option.flag for option in COMMANDS[command].options}


@pytest.mark.parametrize("page", PAGES)
def test_what_is_only_mentioned_exists(page: str) -> None:
    """The command and the options of inline commands that are not run, the files of scripts, and
    options in prose.
    """
    known = set(re.findall(r"--[a-z-]+", run(ROOT, "--help").stdout)).union(
        *map(flags_of, COMMANDS)
    )
    for block in blocks(page):
        words = block.text.split()
        if block.language == "inline" and block.skipped and words[0] == "msaa-lint":
            assert words[1] in (*COMMANDS, *known), block
            assert words[1] in known or {
                word for word in words if word.startswith("--")
            } <= flags_of(words[1]), block
        elif block.language == "inline" and block.skipped:
            assert all((ROOT / word).exists() for word in words if "/" in word), block
    text = re.sub(r"```.*?```", "", (ROOT / page).read_text(encoding="utf-8"), flags=re.DOTALL)
    others = {
        "--check",
        "--format",
        "--expand-flags",
        "--include-binaries",
        "--summary",
        "--json",
        "--fixed",
        "--mistake",
    }
    assert set(re.findall(r"`(--[a-z][a-z-]+)", text)) - others <= known


@pytest.mark.parametrize("page", PAGES)
def test_blocks_are_of_a_known_language(page: str) -> None:
    assert [block.place for block in blocks(page) if block.language not in LANGUAGES] == []


def test_what_is_not_run_has_a_reason() -> None:
    reasons = {
        page: {
            block.skipped for block in blocks(page) if block.skipped and block.language != "inline"
        }
        for page in PAGES
    }
    assert {page: found for page, found in reasons.items() if found} == NOT_RUN


@pytest.mark.parametrize("page", PAGES)
def test_yaml_toml_and_json_are_valid(page: str, tmp_path: Path) -> None:
    """A block with the sections of a description is one without errors."""
    for block in blocks(page):
        if block.language == "toml":
            tomllib.loads(block.text)
        elif block.language == "json":
            json.loads(block.text)
        elif block.language == "yaml":
            data = yaml.safe_load(block.text)
            if isinstance(data, dict) and data.keys() <= set(Description.__annotations__):
                (tmp_path / "block.msaa.yaml").write_text(block.text, encoding="utf-8")
                findings = lint(str(tmp_path / "block.msaa.yaml"), isolated=True).findings
                assert [
                    (block.place, finding.message)
                    for finding in findings
                    if finding.severity == "error"
                ] == []
