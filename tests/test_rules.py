"""The pages of rules/: their examples are the rules' tests."""

from __future__ import annotations

import re
from collections.abc import Callable

import pytest

from msaa_lint.input.source_file import read_source_file
from msaa_lint.linter.engine import Engine
from msaa_lint.linter.fixes.actions import PRICE_ONLY
from msaa_lint.linter.fixes.fix_checks import problems
from msaa_lint.linter.lint_options import LintOptions
from msaa_lint.linter.results import FileResult
from msaa_lint.linter.rules.condition import Condition
from msaa_lint.linter.rules.page_checks import check_rule
from msaa_lint.linter.rules.registry import load, markdown
from msaa_lint.linter.rules.rule import EDITIONS, Rule
from tests.pages import DESCRIPTIONS, PROGRAMS, RULES, Example, all_examples, examples

CATALOGUE = load()
BY_NAME = {rule.name: rule for rule in CATALOGUE.rules}
ENGINE = Engine(CATALOGUE)
EXAMPLES = all_examples((*DESCRIPTIONS, *PROGRAMS))


def as_written(rule: Rule, suggested: str, vendor: str | None) -> str:
    """Severities without configuration: a vendor's rule is a note unless the device is that
    vendor's.
    """
    return "note" if rule.vendors and vendor not in rule.vendors else suggested


def lint(
    text: str,
    severity: Callable[[Rule, str, str | None], str | None] = as_written,
    language: str = "yaml",
) -> FileResult:
    name = str(RULES / f"example.{language}")
    if language in PROGRAMS:
        return ENGINE.lint(
            read_source_file(text.encode(), name, language), name, LintOptions(severity)
        )
    return ENGINE.lint(text.encode(), name, LintOptions(severity))


def places(linted: FileResult, rule: str) -> list[tuple[int, int, int]]:
    found = []
    for finding in linted.findings:
        if finding.rule == rule:
            assert linted.source is not None and finding.span is not None
            start, end = (
                linted.source.position(finding.span.start),
                linted.source.position(finding.span.end),
            )
            assert start.line == end.line, f"{rule} points at several lines"
            found.append((start.line, start.column, end.column))
    return sorted(found)


def test_every_page_loads() -> None:
    assert not CATALOGUE.problems
    assert len(CATALOGUE.rules) == len(
        [page for page in RULES.glob("*.md") if page.name != "README.md"]
    )


@pytest.mark.parametrize("rule", CATALOGUE.rules, ids=lambda rule: rule.name)
def test_page(rule: Rule) -> None:
    """A page's conditions compile, its facts and words exist, its form is the catalogue's."""
    assert check_rule(rule) == problems(rule) == []
    assert re.fullmatch(r"MSAA[1-8]\d\d", rule.code)
    assert rule.edition in EDITIONS
    assert rule.at, "a built-in rule says where it points"
    assert rule.help, "a built-in rule says what to write instead"
    assert rule.references, "a rule answers to something"
    assert rule.summary.endswith(".")
    assert set(rule.supersedes) <= set(BY_NAME)
    body = markdown(rule)
    assert "## Why" in body
    for line in body.splitlines():
        assert len(line) <= 160


@pytest.mark.parametrize("rule", CATALOGUE.rules, ids=lambda rule: rule.name)
def test_page_has_examples(rule: Rule) -> None:
    kinds = [
        example.kind for example in examples(RULES / f"{rule.name}.md", (*DESCRIPTIONS, *PROGRAMS))
    ]
    assert "bad" in kinds
    assert "good" in kinds
    assert ("fixed" in kinds) == any(spec.do not in PRICE_ONLY for spec in rule.fix_specs)


@pytest.mark.parametrize("example", [e for e in EXAMPLES if e.kind == "bad"], ids=str)
def test_bad_example_fires_at_its_marks(example: Example) -> None:
    linted = lint(example.text, language=example.language)
    assert not [finding for finding in linted.findings if finding.fatal]
    assert example.marks, "a bad example marks where"
    assert places(linted, example.rule) == sorted(
        (mark.line, mark.column, mark.end_column) for mark in example.marks
    )
    for mark in example.marks:
        at = [
            f
            for f in linted.findings
            if f.rule == example.rule
            and linted.source
            and linted.source.position(f.span.start)[:2] == (mark.line, mark.column)
        ]
        if mark.severity is not None:
            assert at[0].severity == mark.severity
        if mark.confidence is not None:
            assert at[0].confidence == mark.confidence


@pytest.mark.parametrize("example", [e for e in EXAMPLES if e.kind != "bad"], ids=str)
def test_good_and_fixed_examples_do_not_fire(example: Example) -> None:
    linted = lint(example.text, language=example.language)
    assert not [finding for finding in linted.findings if finding.fatal]
    assert places(linted, example.rule) == []
    assert not example.marks


@pytest.mark.parametrize("rule", CATALOGUE.rules, ids=lambda rule: rule.name)
def test_nothing_known_decides_nothing(rule: Rule) -> None:
    """Without facts no condition holds: unknown is not wrong."""
    from msaa_lint.linter.rules.condition import activation

    assert Condition(rule.when, rule.subject).holds(activation(rule.subject, {})) is not True


NAMED = {
    r"Arm\b|Mali\b|Immortalis|AFBC|AFRC": r"Arm\b|Mali|Panfrost",
    r"Qualcomm|Adreno|UBWC": r"Qualcomm|Adreno|Turnip|Meta\b",
    r"Apple\b": r"Apple|Asahi",
    r"Imagination|PowerVR": r"Imagination|PowerVR|IMG\b",
    r"AMD\b|RDNA": r"AMD\b|RADV",
    r"NVIDIA|Tegra": r"NVIDIA",
    r"Intel\b": r"Intel\b|Apple",
    r"[Oo]n llvmpipe|SwiftShader": r"[Mm]easured",
    r"devices in reports|devices that report": r"gpuinfo",
    r"(?:issues?|pull request) \d": r"(?:issues?|pull request) \d",
}
"""What the text of a page may name, and what a reference for that names. Statistics of devices and
measurements name any vendor.
"""


@pytest.mark.parametrize("rule", CATALOGUE.rules, ids=lambda rule: rule.name)
def test_what_a_page_names_has_a_reference(rule: Rule) -> None:
    """A vendor, a measurement, and a report of somebody else's are quoted from somewhere, which the
    page names.
    """
    text = re.sub(r"^```.*?^```$", "", markdown(rule), flags=re.MULTILINE | re.DOTALL)
    text = text.partition("## References")[0]
    missing = [
        named
        for named, source in NAMED.items()
        if re.search(rf"\b(?:{named})", text)
        and not any(re.search(rf"{source}|gpuinfo|Measured", each) for each in rule.references)
    ]
    assert not missing, f"{rule.name}: {rule.references}"
