"""The registry of rules: the built-in rule pages and the user's own."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import NamedTuple

from msaa_lint.core import package
from msaa_lint.core.diagnostics import DIAGNOSTICS, diagnostic
from msaa_lint.core.finding import Finding, RuleInfo
from msaa_lint.core.text.source import Source
from msaa_lint.core.text.span import Span

from .condition import ConditionError, check
from .rule_file import Rule, read_page, split

EDITIONS = ("2026.1",)
"""In order. A rule of an edition later than the pinned one is off by default."""

_FENCE = Span(0, 3)
"""The place of problems of a whole page."""


class Registry(NamedTuple):
    """Rules in order of code, the problems of unusable pages, and the texts they point into, by name."""

    rules: tuple[Rule, ...]
    problems: tuple[Finding, ...]
    sources: Mapping[str, Source] = {}


def folder() -> str:
    """The folder of the built-in pages: in the installed package, or at the top of a checkout."""
    installed = os.path.join(package.FOLDER, "rules")
    return installed if os.path.isdir(installed) else os.path.join(os.path.dirname(package.FOLDER), "rules")


def pages(path: str) -> list[str]:
    """The rule pages at a path: the file itself, or the pages of the folder except its README, sorted."""
    try:
        names = sorted(os.listdir(path))
    except OSError:
        # Either a file, or a folder that cannot be read, which is then reported as an unreadable page.
        return [path]
    return [os.path.join(path, name) for name in names if name.endswith(".md") and name != "README.md"]


CheckFixes = Callable[[Rule], list[Finding]]
"""The problems of a rule's fixes."""


def load(paths: Sequence[str] = (), check_fixes: CheckFixes = lambda _: []) -> Registry:
    """The built-in rules, and the rules of the given rule pages and folders of rule pages.

    Only the user's own rules are checked here, fixes with `check_fixes`; the test suite checks the built-in rules. A rule with a problem
    is left out.
    """
    rules: list[Rule] = []
    problems: list[Finding] = []
    sources: dict[str, Source] = {}
    for path in pages(folder()):
        page = read_page(path, f"rules/{os.path.basename(path)}")
        problems.extend(page.problems)
        if page.rule is not None:
            rules.append(page.rule)
    user_pages: dict[str, None] = {}
    for path in paths:
        found = pages(path)
        user_pages.update(dict.fromkeys(map(os.path.normpath, found)))
        if not found:
            shown = os.path.relpath(path).replace(os.sep, "/")
            problems.append(diagnostic("MSAA921", "no rule pages in this folder", shown))
    for path in user_pages:
        shown = os.path.relpath(path).replace(os.sep, "/")
        page = read_page(path, shown)
        problems.extend(page.problems)
        if page.source is not None:
            sources[shown] = page.source
        if page.rule is None:
            continue
        of_rule = [*conflicts(page.rule, rules), *misnamed(page.rule), *check_rule(page.rule), *check_fixes(page.rule)]
        problems.extend(of_rule)
        if not of_rule:
            rules.append(page.rule)
    return Registry(tuple(sorted(rules, key=lambda rule: rule.code)), tuple(problems), sources)


def conflicts(rule: Rule, others: Iterable[Rule]) -> list[Finding]:
    """Problems of a page with the code or the name of another rule."""
    found = []
    for other in others:
        if rule.code == other.code or rule.name == other.name:
            shared = f"code {rule.code}" if rule.code == other.code else f"name {rule.name}"
            found.append(rule.problem(f"the {shared} is already used by `{other.name}`", _FENCE))
    return found


def misnamed(rule: Rule) -> list[Finding]:
    """Problems of a user's page with a code or name that cannot be used in selectors, suppressions or outputs."""
    found = []
    if re.fullmatch(r"(?!MSAA)[A-Z]{2,12}-?[0-9]{1,6}", rule.code) is None:
        found.append("the code must be 2 to 12 capital letters other than MSAA and a number, for example ACME001")
    if re.fullmatch(r"[a-z0-9]+(-[a-z0-9]+)*", rule.name) is None or any(rule.name == info.name for info in DIAGNOSTICS.values()):
        found.append("the file name must be lowercase words with hyphens, for example no-multisampled-storage.md")
    if rule.name in rule.supersedes:
        found.append("the rule supersedes itself")
    return [rule.problem(text, _FENCE) for text in found]


def check_rule(rule: Rule) -> list[Finding]:
    """The problems of a rule's conditions, and the facts its texts name that do not exist. Fixes are not checked."""
    from msaa_lint.frame.facts.table import SUBJECTS

    found = []
    for when, at in ((rule.when, rule.condition_at), *((case.when, case.condition_at) for case in rule.cases)):
        try:
            check(when, rule.subject)
        except ConditionError as error:
            found.append(rule.problem(str(error), _within(rule.source.text, at, when, error)))
    known = {fact.name for fact in SUBJECTS[rule.subject]}
    texts = [rule.message, rule.help, *(text or "" for case in rule.cases for text in (case.message, case.help))]
    texts += [*(spec.title for spec in rule.fix_specs), *(text for _, text in rule.labels)]
    named = [*rule.at, *(fact for fact, _ in rule.labels), *(name for text in texts for name in placeholders(text))]
    unknown = [name for name in dict.fromkeys(named) if name not in known]
    return found + [rule.problem(f"unknown fact {name} of {rule.subject}", rule.condition_at) for name in unknown]


def _within(text: str, at: Span, when: str, error: ConditionError) -> Span:
    """The location of an error in a condition on a page; the whole condition if YAML folded its lines."""
    if error.offset is None:
        return at
    begin = when.rfind("\n", 0, error.offset) + 1
    line = when[begin:].split("\n", 1)[0]
    found = text.find(line, at.start, at.end) if line else -1
    start = found + error.offset - begin
    return Span(start, min(start + error.length, at.end)) if found >= 0 else at


def placeholders(text: str) -> list[str]:
    """The names of the facts in braces in a text."""
    parts = text.split("{")[1:]
    return [part[: part.index("}")] for part in parts if "}" in part]


def markdown(rule: Rule) -> str:
    """The Markdown of a rule's page."""
    return split(rule.source.text)[1].lstrip("\n")


def info(rule: Rule, severity: str | None = None, full: bool = True) -> RuleInfo:
    """A rule as reports describe it; `full` includes its page."""
    text = markdown(rule) if full else ""
    severity = severity or rule.severity
    return RuleInfo(rule.code, rule.name, severity, rule.confidence, rule.summary, text, rule.references, bool(rule.fix_specs))
