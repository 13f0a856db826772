"""Inputs that a person would write, each with one mistake: what the command says of it, on one
line.

`tests/data/wrong/cases.txt` states for each input what its message must say: the place, the key or
text that it names, and the word to write instead. `tests/golden/wrong` has the whole lines, by
group; UPDATE=1 rewrites these, but not the cases.
"""

from __future__ import annotations

import os
import re
import shutil
from pathlib import Path
from typing import NamedTuple

import pytest

from tests.command import run
from tests.paths import ROOT

INPUTS = ROOT / "tests" / "data" / "wrong"
GOLDEN = ROOT / "tests" / "golden" / "wrong"
FRAME = "images:\n  color_ms: {format: R8G8B8A8_UNORM, samples: 4}\n"
NAMES = {"config": "msaa-lint.toml", "pyproject": "pyproject.toml", "baseline": "baseline.json"}
"""Groups of files that go with a valid description, and the name that each such file has."""

WARNINGS = "suppressions"
"""The group whose mistakes are warnings: the exit code is 1."""

FOREIGN = re.compile(
    r"not allowed in this context|not allowed here$|did not find expected|could not find|found "
    r"character|cannot start any token"
    r"|block (?:mapping|collection)|flow (?:node|mapping|sequence)|simple key|found "
    r"unexpected|document start|control characters"
    r"|while (?:parsing|scanning)|stream end|Input should be|Field required|[Ee]xtra "
    r"inputs|value_error|Expecting |Extra data|Unterminated"
    r"|Invalid (?:value|statement|initial)|Illegal character|Unclosed|Cannot "
    r"(?:overwrite|declare)|Expected '|codec"
    r"|invalid (?:start|continuation) byte|line \d+ column|Traceback"
)
"""Words of libyaml, pydantic, json, orjson, tomllib and Python."""

ACTION = re.compile(
    r"\b(?:write|remove|delete|add|put|align|indent|leave out|leave it "
    r"out|list|save|move|keep|fill in|close|replace|did you mean|expected"
    r"|must|never closed|missing|convert|decompress|run|use|lists the|ends here|not a text "
    r"file|the description has no|unused|without its"
    r"|unknown rule|can(?:not)?|there are|needs|is not there)\b"
)
"""What every message has: what to do, or what is expected."""


class Case(NamedTuple):
    """`place` is `line:column`, `-` for a file without text; `named` is in the message, as `word`
    is, `-` for none.
    """

    place: str
    named: str
    word: str


def cases() -> dict[str, Case]:
    rows = (
        line.split("\t")
        for line in (INPUTS / "cases.txt").read_text(encoding="utf-8").splitlines()
        if line and line[0] != "#"
    )
    return {path: Case(*row) for path, *row in rows}


CASES = cases()
FILES = sorted(path.relative_to(INPUTS).as_posix() for path in INPUTS.glob("*/*"))


def findings(folder: Path, path: str) -> list[str]:
    """The lines that `check --output concise` prints of an input alone in a folder."""
    group, _, name = path.partition("/")
    beside = NAMES.get(group)
    shutil.copy(INPUTS / path, folder / (beside or name))
    arguments = [name]
    if beside is not None:
        (folder / "frame.msaa.yaml").write_text(FRAME, encoding="utf-8")
        arguments = ["frame.msaa.yaml", *(["--baseline", beside] if group == "baseline" else [])]
    # Without programs: whether a converter is installed does not matter.
    done = run(folder, "check", "--output", "concise", *arguments, PATH=str(folder))
    assert done.returncode == (1 if group == WARNINGS else 2), done.stdout + done.stderr
    assert done.stderr == ""
    shown = beside or name
    return [
        name + line.removeprefix(shown)
        for line in done.stdout.splitlines()
        if line.startswith((f"{shown}:", f"{name}:"))
    ]


def test_every_input_is_a_case() -> None:
    assert sorted(CASES) == FILES
    assert len(FILES) >= 400


@pytest.mark.parametrize("path", FILES)
def test_message(path: str, tmp_path: Path) -> None:
    """One mistake is one finding, at its place, which names the key and says what to write."""
    case = CASES[path]
    lines = findings(tmp_path, path)
    assert len(lines) == 1, lines
    (line,) = lines
    name = path.partition("/")[2]
    at = "" if case.place == "-" else f":{case.place}"
    start = re.match(rf"{re.escape(name + at)}: (?:error|warning)\[[a-z-]+\] ", line)
    assert start is not None, line
    message = line[start.end() :]
    assert case.named in message, line
    assert case.word == "-" or case.word in message, line
    assert FOREIGN.search(message) is None, line
    assert ACTION.search(message) is not None, line
    assert line.isprintable(), line
    assert len(line) < 700, line


@pytest.mark.parametrize("group", sorted({path.partition("/")[0] for path in FILES}))
def test_golden(group: str, tmp_path_factory: pytest.TempPathFactory) -> None:
    lines = [
        line
        for path in FILES
        if path.startswith(f"{group}/")
        for line in findings(tmp_path_factory.mktemp(group), path)
    ]
    text = "".join(f"{line}\n" for line in lines)
    golden = GOLDEN / f"{group}.txt"
    if os.environ.get("UPDATE"):
        golden.parent.mkdir(parents=True, exist_ok=True)
        golden.write_text(text, encoding="utf-8")
    assert text == golden.read_text(encoding="utf-8")


def test_the_other_files_are_linted(tmp_path: Path) -> None:
    """A syntax error in one file does not keep the findings of another from the report, in either
    order.
    """
    shutil.copy(INPUTS / "yaml" / "unclosed-bracket.yaml", tmp_path / "b.msaa.yaml")
    for name in ("a.msaa.yaml", "c.msaa.yaml"):
        (tmp_path / name).write_text("images:\n  color_ms: {samples: 3}\n", encoding="utf-8")
    done = run(
        tmp_path, "check", "--output", "concise", "a.msaa.yaml", "b.msaa.yaml", "c.msaa.yaml"
    )
    assert done.returncode == 2
    assert re.findall(r"^\w\.msaa\.yaml:\d+:\d+", done.stdout, re.MULTILINE) == [
        "a.msaa.yaml:2:23",
        "b.msaa.yaml:3:12",
        "c.msaa.yaml:2:23",
    ]
