"""Frames in Markdown, as on the rule pages: a line of carets under a line of input marks what must
be found there, and no other rule of the page's list may fire. `$name` in a frame takes each of the
values listed below it.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import pytest
import yaml

from tests.linter.lifetimes import watched

_RULES = re.compile(r"^Rules: (.*)$", re.MULTILINE)
_CASE = re.compile(
    r"^### (?P<title>[^\n]*)$|^```yaml\n(?P<frame>.*?)^```$(?:\s*^```yaml "
    r"values\n(?P<values>.*?)^```$)?",
    re.MULTILINE | re.DOTALL,
)
_UNDECIDED = re.compile(r"^# undecided: (MSAA\d{3}) (\S+)$", re.MULTILINE)


class Case(NamedTuple):
    title: str
    frame: str
    values: dict[str, Any]
    rules: frozenset[str]


def cases() -> Iterator[Case]:
    for page in sorted(Path(__file__).parent.glob("*.md")):
        text = page.read_text(encoding="utf-8")
        listed = _RULES.search(text)
        assert listed is not None, f"{page.name}: no line `Rules:`"
        title = ""
        for match in _CASE.finditer(text):
            if match["title"] is not None:
                title = match["title"]
                continue
            for values in yaml.safe_load(match["values"]) if match["values"] else [{}]:
                yield Case(
                    f"{page.stem}: {title}",
                    match["frame"],
                    values,
                    frozenset(listed[1].split(", ")),
                )


CASES = list(cases())


def test_pages_are_read() -> None:
    assert len(CASES) > 200


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.title)
def test_what_is_marked_is_found_and_nothing_else(case: Case) -> None:
    values = {name: value for name, value in case.values.items() if name != "undecided"}
    linted = watched.check(watched.given_text(case.frame, **values), case.rules)
    expected = {*_UNDECIDED.findall(case.frame), *map(tuple, case.values.get("undecided", []))}
    if expected or "undecided" in case.values:
        assert {
            (each.code, each.subject) for each in linted.undecided if each.code in case.rules
        } == expected
