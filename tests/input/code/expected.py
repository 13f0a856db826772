"""Compares the findings in the corpus programs with the marks in their comments.

`// expect: MSAA201` requires a finding of that rule, a warning or error, on its line; `// may:
MSAA201` allows one. `// expect-later: MSAA201` marks a mistake that is not detected yet. Of several
lines with `MSAA201#color`, one must have the finding. Any other warning or error is false. A folder
is a program of several files, which is checked as a whole; its headers without a mistake need no
marks.
"""

from __future__ import annotations

import contextlib
import io
import json
import os
import re
from dataclasses import dataclass
from pathlib import Path

from msaa_lint.cli.arguments import parse
from msaa_lint.cli.check import check

CORPUS = Path(__file__).parent / "corpus"
PROGRAMS = sorted(
    path for path in CORPUS.iterdir() if path.suffix in (".c", ".cpp", ".rs") or path.is_dir()
)

_MARK = re.compile(
    r"\b(?P<kind>expect-later|expect|may): (?P<codes>MSAA\d{3}(?:#\w+)?(?:, MSAA\d{3}(?:#\w+)?)*)"
)


@dataclass(frozen=True, order=True)
class Found:
    """A warning or an error: its line, the code of its rule, its message, and its file in a program
    of several.
    """

    line: int
    code: str
    message: str
    file: str = ""


@dataclass(frozen=True)
class Outcome:
    """The comparison of a program with its marks. Expected findings are named by code and line, or
    code and group.
    """

    expected: tuple[str, ...]
    missed: tuple[str, ...]
    later: tuple[str, ...]
    later_found: tuple[str, ...]
    false: tuple[Found, ...]


def marks(text: str) -> list[tuple[int, str, str, str]]:
    """Returns the marks of a program: line, kind, code, and the name of the expected finding."""
    found = []
    for number, line in enumerate(text.split("\n"), 1):
        for match in _MARK.finditer(line):
            codes = match["codes"].split(", ")
            found += [
                (number, match["kind"], code[:7], code if "#" in code else f"{code}:{number}")
                for code in codes
            ]
    return found


def program_marks(program: Path) -> list[tuple[str, int, str, str, str]]:
    """Returns the marks of all files of a program: file (empty if there is only one), line, kind,
    code, and the name of the finding.
    """
    if program.is_file():
        return [("", *mark) for mark in marks(program.read_text(encoding="utf-8"))]
    return [
        (
            str(path.relative_to(program)),
            line,
            kind,
            code,
            name if "#" in name else f"{code}:{path.name}:{line}",
        )
        for path in sorted(program.rglob("*"))
        if path.is_file()
        for line, kind, code, name in marks(path.read_text(encoding="utf-8"))
    ]


def findings(program: Path) -> list[Found]:
    """Returns the warnings and errors of `msaa-lint check`, which must not fail for any program."""
    given = parse("check", [str(program), "--isolated", "--output", "json"])
    assert given is not None
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        code = check(given)
    assert code in (0, 1), f"{program.name}: exit code {code}: {err.getvalue()}"
    found = [
        finding
        for finding in json.loads(out.getvalue())["findings"]
        if finding["severity"] != "note"
    ]
    assert all(finding["confidence"] in ("low", "medium") for finding in found), program.name
    whole = program.is_dir()
    return sorted(
        Found(
            entry["line"],
            entry["code"],
            entry["message"],
            os.path.relpath(entry["file"], program) if whole else "",
        )
        for entry in found
    )


def outcome(program: Path) -> Outcome:
    """Compares the findings in a program with its marks."""
    marked = program_marks(program)
    found = findings(program)
    places = {(each.file, each.line, each.code) for each in found}
    met = {name for file, line, _, code, name in marked if (file, line, code) in places}
    expected = tuple(dict.fromkeys(name for *_, kind, _, name in marked if kind == "expect"))
    later = tuple(dict.fromkeys(name for *_, kind, _, name in marked if kind == "expect-later"))
    allowed = {(file, line, code) for file, line, _, code, _ in marked}
    return Outcome(
        expected,
        tuple(name for name in expected if name not in met),
        later,
        tuple(name for name in later if name in met),
        tuple(each for each in found if (each.file, each.line, each.code) not in allowed),
    )
