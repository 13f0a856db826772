"""Lints and fixes descriptions for the tests of fixes."""

from __future__ import annotations

import re
from collections import Counter

from msaa_lint.core.finding import Finding
from msaa_lint.core.text.comments import comments
from msaa_lint.core.text.source import Source
from msaa_lint.core.text.tree import Limits, parse
from msaa_lint.frame.description.models import Command
from msaa_lint.frame.description.record import Record
from msaa_lint.linter.engine import Engine
from msaa_lint.linter.fixes.fixer import FixResult, fix_text
from msaa_lint.linter.lint_options import LintOptions
from msaa_lint.linter.results import FileResult
from msaa_lint.linter.rules.registry import load
from msaa_lint.linter.rules.rule import Rule
from tests.pages import RULES

ENGINE = Engine(load())


def as_written(rule: Rule, suggested: str, vendor: str | None) -> str:
    """The severities without a configuration."""
    return "note" if rule.vendors and vendor not in rule.vendors else suggested


def lint(text: str) -> FileResult:
    return ENGINE.lint(text.encode(), str(RULES / "frame.yaml"), LintOptions(as_written))


def fix_findings(text: str, unsafe: bool = False) -> FixResult:
    return fix_text(lint(text), lint, unsafe)


def comments_of(text: str) -> list[str]:
    source = Source("", text)
    return [comment.text for comment in comments(source, parse(source, Limits()).documents)]


def kinds(result: FileResult) -> Counter[tuple[str, str]]:
    """How many findings there are by rule and subject, without indices."""
    return Counter((found.rule, re.sub(r"\[\d+\]", "", found.subject)) for found in result.findings)


def rules(findings: tuple[Finding, ...] | list[Finding]) -> list[str]:
    return sorted(found.rule for found in findings)


def meaning(result: FileResult) -> list[object]:
    """What the documents of a text state, without places and spellings."""
    return [_meaning(document.document.description) for document in result.documents]


def _meaning(value: object) -> object:
    if isinstance(value, Record):
        if isinstance(value, Command):
            return (value.kind, _meaning(value.body))
        stated = {name: getattr(value, name) for name in value.SHAPE}
        # The order of flags says nothing.
        flags = {
            name: sorted(each)
            for name, each in stated.items()
            if value.SHAPE[name][0] == "flags" and each is not None
        }
        return (
            type(value).__name__,
            value.key,
            [(name, flags.get(name, _meaning(each))) for name, each in stated.items()],
        )
    if isinstance(value, (tuple, list)):
        return [_meaning(item) for item in value]
    return (
        {name: _meaning(item) for name, item in value.items()} if isinstance(value, dict) else value
    )
