"""The pages that set texts on multisampling beside the linter are true: their tables are what the
examples give.
"""

from __future__ import annotations

import re
from functools import cache

import pytest

from msaa_lint import lint
from tests.paths import ROOT

EXAMPLES = ROOT / "examples"
PAIR = re.compile(r"`([a-z0-9-]+)` at `([\w./-]+):(\d+)`")

Found = tuple[str, str, int]


def sections(page: str) -> dict[str, str]:
    """The sections of a page that have a table of mistakes, by their titles."""
    text = (ROOT / "docs" / page).read_text(encoding="utf-8")
    parts = (part.partition("\n") for part in text.split("\n## ")[1:])
    return {title: body for title, _, body in parts if "| found by |" in body}


TABLES = {
    **{title: ("", body) for title, body in sections("texts.md").items()},
    **{title: ("impeller/", body) for title, body in sections("impeller.md").items()},
}
"""By title: where its examples lie, and its text."""

ROWS = {
    "A tutorial's chapter, in C++": 11,
    "Notes on that chapter": 5,
    "A note on resolving in a shader": 8,
    "A vendor's sample, retold": 8,
    "The article's mistakes, one by one": 30,
}


@cache
def found(name: str) -> frozenset[Found]:
    """The rules that speak in an example, with the lines."""
    result = lint(str(EXAMPLES / name), isolated=True)
    out = set()
    for each in result.findings:
        assert each.span is not None
        out.add((each.rule, name, result.sources[each.file].position(each.span.start).line))
    return frozenset(out)


def test_five_texts_have_a_table() -> None:
    assert TABLES.keys() == ROWS.keys()


@pytest.mark.parametrize("title", ROWS)
def test_every_mistake_has_a_rule_and_a_line_or_a_reason(title: str) -> None:
    rows = {
        int(number): said
        for number, said in re.findall(
            r"^\| (\d+) \| [^|]+ \| ([^|]+) \|$", TABLES[title][1], re.MULTILINE
        )
    }
    assert list(rows) == list(range(1, ROWS[title] + 1))
    for number, said in rows.items():
        assert PAIR.search(said) or re.match(r"nothing: \w", said), number


@pytest.mark.parametrize("title", ROWS)
def test_the_table_is_what_is_found(title: str) -> None:
    """Every rule that it names is found where it says, and whatever is found in the files that it
    names stands in it.
    """
    folder, text = TABLES[title]
    said = {(rule, folder + name, int(line)) for rule, name, line in PAIR.findall(text)}
    names = {name for _, name, _ in said}
    if folder:
        names |= {
            path.relative_to(EXAMPLES).as_posix() for path in (EXAMPLES / folder).glob("article*")
        }
    assert said == {each for name in names for each in found(name)}


@pytest.mark.parametrize("title", ROWS)
def test_rules_that_are_only_mentioned_exist(title: str) -> None:
    for name in re.findall(r"`([a-z]+(?:-[a-z]+)+)`", TABLES[title][1]):
        assert (ROOT / "rules" / f"{name}.md").exists(), name
