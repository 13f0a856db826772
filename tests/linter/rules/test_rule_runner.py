"""Caching changes no result."""

from __future__ import annotations

import pytest

from msaa_lint.linter.engine import Engine
from msaa_lint.linter.lint_options import LintOptions
from msaa_lint.linter.results import FileResult
from msaa_lint.linter.rules import rule_runner as judge
from msaa_lint.linter.rules.condition import Condition
from msaa_lint.linter.rules.registry import load
from msaa_lint.linter.rules.rule import Rule
from tests.pages import all_examples

TEXTS = [example.text.encode() for example in all_examples()]


def as_written(rule: Rule, suggested: str, vendor: str | None) -> str:
    return suggested


def verdicts(engine: Engine, texts: list[bytes]) -> list[FileResult]:
    return [
        engine.lint(text, "example.yaml", LintOptions(as_written))._replace(
            source=None, documents=()
        )
        for text in texts
    ]


def test_verdicts_are_the_same_whatever_is_remembered(monkeypatch: pytest.MonkeyPatch) -> None:
    engine = Engine(load())
    first = verdicts(engine, TEXTS)
    assert any(linted.findings for linted in first)
    assert any(linted.undecided for linted in first)
    assert verdicts(engine, TEXTS) == first
    monkeypatch.setattr(judge, "MAX_CACHED", 1)
    assert verdicts(Engine(load()), TEXTS[::-1]) == first[::-1]


def test_a_condition_is_asked_once_of_the_same_facts(monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[str] = []
    holds = Condition.holds

    def noted(self: Condition, activation: object) -> bool | None:
        asked.append(self.text)
        return holds(self, activation)

    monkeypatch.setattr(Condition, "holds", noted)
    engine = Engine(load())
    verdicts(engine, TEXTS[:1])
    assert asked
    asked.clear()
    verdicts(engine, TEXTS[:1])
    assert asked == []
    verdicts(engine, [TEXTS[0].replace(b"samples: 4", b"samples: 2")])
    assert asked
