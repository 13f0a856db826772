"""What a stranger's rule page says acts on no terminal, log, or reader of a report."""

from __future__ import annotations

import json
import os
import re
import sys
from pathlib import Path

import pytest

from tests.command import environment_of, run
from tests.linter.test_internal_errors import STORED

PAGE = """\
---
code: ACME001
severity: warning
subject: image
when: image.samples > 1
message: "four samples"
references: ["see \\e[31m \\u202e here"]
---
Summary \x1b[31mred\x1b[0m \u202etxet\u2069 \u200b | <img src=x> [x](javascript:alert(1)) @octocat.

[docs](http://evil.example/) &#27;[2J &#x9b;2J &#x202e; &#8203; \x1b]8;;http://evil.example\x1b\\link\x1b]8;;\x1b\\ [red]x[/red]

::error::x

##vso[task.complete]
"""
HIDDEN = re.compile("[^\\S\n ]|[\x00-\x09\x0b-\x1f\x7f-\x9f\u200b\u202a-\u202e\u2066-\u2069]")


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "acme-rule.md").write_text(PAGE, encoding="utf-8")
    (tmp_path / "frame.msaa.yaml").write_text(STORED)
    return tmp_path


@pytest.mark.parametrize(
    "words",
    [
        "ACME001",
        "ACME001 --output markdown",
        "ACME001 --output json",
        "--all",
        "--all --output markdown",
        "--all --output json",
    ],
)
def test_pages_and_lists_are_escaped(words: str, folder: Path) -> None:
    done = run(folder, "rule", *words.split(), "--isolated", "--rules", "acme-rule.md")
    assert done.returncode == 0, done.stderr
    assert not HIDDEN.search(done.stdout + done.stderr)
    assert "json" in words or not re.search(r"(?m)^\s*::|##\w*\[", done.stdout)
    if "json" in words:
        pages = json.loads(done.stdout)
        page = (
            pages
            if isinstance(pages, dict)
            else next(each for each in pages if each["code"] == "ACME001")
        )
        assert "\x1b[31mred" in page["summary"] and done.stdout.isascii()
    else:
        assert "x1b" in done.stdout and "u202etxet" in done.stdout
    if words == "--all --output markdown":
        (row,) = [line for line in done.stdout.splitlines() if "ACME001" in line]
        assert (
            row.count("|") == 5
            and "<" not in row
            and "](javascript" not in row
            and "@octocat" not in row
        )


def test_a_terminal_shows_a_page_without_its_escapes_and_links(folder: Path) -> None:
    """Character references, which rich resolves, are escaped too, and the address of a link is
    shown.
    """
    pty = pytest.importorskip("pty")
    words = [
        sys.executable,
        "-m",
        "msaa_lint",
        "rule",
        "ACME001",
        "--isolated",
        "--rules",
        "acme-rule.md",
    ]
    child, terminal = pty.fork()
    if child == 0:  # pragma: no cover
        os.chdir(folder)
        os.execve(
            words[0], words, {**environment_of({}), "TERM": "xterm-256color", "COLUMNS": "200"}
        )
    shown = b""
    while True:
        try:
            data = os.read(terminal, 65536)
        except OSError:
            break
        if not data:
            break
        shown += data
    os.waitpid(child, 0)
    text = shown.decode().replace("\r\n", "\n")
    plain = re.sub(r"\x1b\[[0-9;]*m", "", text)
    assert "ACME001" in plain and text != plain
    assert not HIDDEN.search(plain)
    assert "docs (http://evil.example/)" in plain and "[red]x[/red]" in plain


def test_help_in_sarif_is_escaped(folder: Path) -> None:
    done = run(
        folder,
        "check",
        "--isolated",
        "--rules",
        "acme-rule.md",
        "--output",
        "sarif",
        "frame.msaa.yaml",
    )
    rules = json.loads(done.stdout)["runs"][0]["tool"]["driver"]["rules"]
    (rule,) = [rule for rule in rules if rule["id"] == "ACME001"]
    for text in (rule["help"]["text"], rule["help"]["markdown"], rule["shortDescription"]["text"]):
        assert not HIDDEN.search(text), text
    assert (
        "\\x1b[31mred" in rule["help"]["markdown"]
        and "see \\x1b[31m \\u202e here" in rule["help"]["markdown"]
    )


def test_a_page_with_hidden_characters_is_noted(folder: Path) -> None:
    done = run(
        folder,
        "check",
        "--isolated",
        "--rules",
        "acme-rule.md",
        "--output",
        "concise",
        "frame.msaa.yaml",
    )
    (line,) = [line for line in done.stdout.splitlines() if "MSAA914" in line]
    assert line.startswith(
        "acme-rule.md:9:22: note[hidden-character] the line contains U+202E RIGHT-TO-LEFT OVERRIDE "
        "and 2 more hidden characters"
    )
