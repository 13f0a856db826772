"""Texts that are linted as frames, with marks: a line of carets under a line of input marks what
must be found there.
"""

from __future__ import annotations

import re
import textwrap
from collections.abc import Set
from string import Template

from msaa_lint.core.finding import Finding
from msaa_lint.linter.engine import Engine
from msaa_lint.linter.lint_options import LintOptions
from msaa_lint.linter.results import FileResult
from msaa_lint.linter.rules.registry import load
from msaa_lint.linter.rules.rule import Rule

CATALOGUE = load()
ENGINE = Engine(CATALOGUE)

_MARK = re.compile(
    r"^#\s*(?P<carets>\^+)\s*(?P<code>MSAA\d{3})(?: (?P<severity>error|warning|note))?(?: "
    r"(?P<confidence>high|medium|low))?$"
)


def as_written(rule: Rule, suggested: str, vendor: str | None) -> str:
    return suggested


def given_text(text: str, **values: str) -> str:
    """A text, in which `$name` stands for a value."""
    return textwrap.dedent(Template(text).substitute(values)).strip("\n") + "\n"


def lint(text: str, prices: bool = False) -> FileResult:
    """What is found in a text without mistakes of its own."""
    linted = ENGINE.lint(text.encode(), "frame.yaml", LintOptions(as_written, prices=prices))
    assert not [found.message for found in linted.findings if found.fatal]
    return linted


def watched(linted: FileResult, codes: Set[str]) -> list[Finding]:
    """The findings of some rules."""
    return [finding for finding in linted.findings if finding.code in codes]


def check(text: str, codes: Set[str], prices: bool = False) -> FileResult:
    """The rules fire at the text's marks and nowhere else, weighing what the marks say. Gives what
    was found.
    """
    linted = lint(text, prices)
    assert linted.source is not None
    found = {}
    for finding in watched(linted, codes):
        assert finding.span is not None
        start, end = (
            linted.source.position(finding.span.start),
            linted.source.position(finding.span.end),
        )
        found[finding.code, start.line, start.column, end.line, end.column] = finding
    above = 0
    expected = {}
    for number, line in enumerate(text.splitlines(), 1):
        mark = _MARK.match(line)
        if mark is None:
            above = number
        else:
            expected[
                mark["code"], above, mark.start("carets") + 1, above, mark.end("carets") + 1
            ] = mark
    assert sorted(found) == sorted(expected)
    for key, mark in expected.items():
        assert mark["severity"] in (None, found[key].severity)
        assert mark["confidence"] in (None, found[key].confidence)
    return linted
