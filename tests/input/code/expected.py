"""Compares the findings in the corpus programs with the marks in their comments.

`// expect: MSAA201` requires a finding of that rule, a warning or error, on its line; `// may: MSAA201` allows one. `// expect-later:
MSAA201` marks a mistake that is not detected yet. Of several lines with `MSAA201#color`, one must have the finding. Any other warning or
error is false.
"""

from __future__ import annotations

import contextlib
import io
import json
import re
from dataclasses import dataclass
from pathlib import Path

from msaa_lint.cli.arguments import parse
from msaa_lint.cli.check import check

CORPUS = Path(__file__).parent / "corpus"
PROGRAMS = sorted(path for path in CORPUS.iterdir() if path.suffix in (".c", ".cpp"))

_MARK = re.compile(r"\b(?P<kind>expect-later|expect|may): (?P<codes>MSAA\d{3}(?:#\w+)?(?:, MSAA\d{3}(?:#\w+)?)*)")


@dataclass(frozen=True, order=True)
class Found:
    """A warning or an error: its line, the code of its rule, its message."""

    line: int
    code: str
    message: str


@dataclass(frozen=True)
class Outcome:
    """The comparison of a program with its marks. Expected findings are named by code and line, or code and group."""

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
            found += [(number, match["kind"], code[:7], code if "#" in code else f"{code}:{number}") for code in codes]
    return found


def findings(path: Path) -> list[Found]:
    """Returns the warnings and errors of `msaa-lint check`, which must not fail for any program."""
    given = parse("check", [str(path), "--isolated", "--output", "json"])
    assert given is not None
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        code = check(given)
    assert code == 0, f"{path.name}: exit code {code}: {err.getvalue()}"
    found = [finding for finding in json.loads(out.getvalue())["findings"] if finding["severity"] != "note"]
    assert all(finding["confidence"] == "low" for finding in found), path.name
    return sorted(Found(finding["line"], finding["code"], finding["message"]) for finding in found)


def outcome(path: Path) -> Outcome:
    """Compares the findings in a program with its marks."""
    marked = marks(path.read_text(encoding="utf-8"))
    found = findings(path)
    places = {(each.line, each.code) for each in found}
    met = {name for line, _, code, name in marked if (line, code) in places}
    expected = tuple(dict.fromkeys(name for _, kind, _, name in marked if kind == "expect"))
    later = tuple(dict.fromkeys(name for _, kind, _, name in marked if kind == "expect-later"))
    allowed = {(line, code) for line, _, code, _ in marked}
    return Outcome(
        expected,
        tuple(name for name in expected if name not in met),
        later,
        tuple(name for name in later if name in met),
        tuple(each for each in found if (each.line, each.code) not in allowed),
    )
