"""The rules there are: the pages of the catalogue, and a user's own."""

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
"""In their order; a rule of a later edition than the one pinned is off."""


class Registry(NamedTuple):
    """Rules by code, what is wrong with the pages that could not be used, and the texts that this points into, by name."""

    rules: tuple[Rule, ...]
    problems: tuple[Finding, ...]
    sources: Mapping[str, Source] = {}


def folder() -> str:
    """Where the built-in pages stand: inside the installed package, or at the top of a checkout."""
    installed = os.path.join(package.FOLDER, "rules")
    return installed if os.path.isdir(installed) else os.path.join(os.path.dirname(package.FOLDER), "rules")


def pages(path: str) -> list[str]:
    """The pages at a path: itself, or those of a folder (not its README), sorted."""
    try:
        names = sorted(os.listdir(path))
    except OSError:
        # What is no folder is a page; a folder that cannot be read is said to be none.
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
    given: dict[str, None] = {}
    for each in paths:
        found_there = pages(each)
        given.update(dict.fromkeys(os.path.normpath(page) for page in found_there))
        if not found_there:
            shown = os.path.relpath(each).replace(os.sep, "/")
            problems.append(diagnostic("MSAA921", "there are no rule pages in this folder", shown))
    for path in given:
        shown = os.path.relpath(path).replace(os.sep, "/")
        page = read_page(path, shown)
        problems.extend(page.problems)
        if page.source is not None:
            sources[shown] = page.source
        if page.rule is None:
            continue
        found = [*conflicts(page.rule, rules), *misnamed(page.rule), *check_rule(page.rule), *check_fixes(page.rule)]
        problems.extend(found)
        if not found:
            rules.append(page.rule)
    return Registry(tuple(sorted(rules, key=lambda rule: rule.code)), tuple(problems), sources)


def conflicts(rule: Rule, others: Iterable[Rule]) -> list[Finding]:
    """A page whose code or name another rule has already."""
    found = []
    for other in others:
        if rule.code == other.code or rule.name == other.name:
            shared = f"code {rule.code}" if rule.code == other.code else f"name {rule.name}"
            message = f"rule page `{rule.name}`: the {shared} is `{other.name}`'s already"
            found.append(diagnostic("MSAA921", message, rule.source.name, Span(0, 3), rule.name))
    return found


def misnamed(rule: Rule) -> list[Finding]:
    """A page of a user's whose code or name cannot stand in a selection, a suppression or an output."""
    found = []
    if re.fullmatch(r"(?!MSAA)[A-Z]{2,12}-?[0-9]{1,6}", rule.code) is None:
        found.append("its code is a few capital letters of yours, not MSAA, and a number, e.g. ACME001")
    if re.fullmatch(r"[a-z0-9]+(-[a-z0-9]+)*", rule.name) is None or any(rule.name == info.name for info in DIAGNOSTICS.values()):
        found.append("its file is named in small letters with hyphens, as no other rule is, e.g. no-multisampled-storage.md")
    if rule.name in rule.supersedes:
        found.append("it supersedes itself")
    return [diagnostic("MSAA921", f"rule page `{rule.name}`: {text}", rule.source.name, Span(0, 3), rule.name) for text in found]


def check_rule(rule: Rule) -> list[Finding]:
    """The problems of a rule's conditions, and the facts its texts name that do not exist. Fixes are not checked."""
    from msaa_lint.frame.facts.table import SUBJECTS

    found = []
    for when, at in ((rule.when, rule.condition_at), *((case.when, case.condition_at) for case in rule.cases)):
        try:
            check(when, rule.subject)
        except ConditionError as error:
            span = _within(rule.source.text, at, when, error)
            found.append(diagnostic("MSAA921", f"rule page `{rule.name}`: {error}", rule.source.name, span, rule.name))
    known = {fact.name for fact in SUBJECTS[rule.subject]}
    named = [*rule.at, *(fact for fact, _ in rule.labels), *placeholders(rule.message), *placeholders(rule.help)]
    named.extend(name for case in rule.cases for text in (case.message, case.help) for name in placeholders(text or ""))
    named.extend(name for mend in rule.fix_specs for name in placeholders(mend.title))
    for text in (text for _, text in rule.labels):
        named.extend(placeholders(text))
    for name in dict.fromkeys(named):
        if name not in known:
            message = f"rule page `{rule.name}`: there is no fact {name} of {rule.subject}"
            found.append(diagnostic("MSAA921", message, rule.source.name, rule.condition_at, rule.name))
    return found


def _within(text: str, at: Span, when: str, error: ConditionError) -> Span:
    """Where a condition that is written at a place of a page is wrong: the line it is in stands there as it is, unless it is folded."""
    if error.offset is None:
        return at
    begin = when.rfind("\n", 0, error.offset) + 1
    line = when[begin:].split("\n", 1)[0]
    found = text.find(line, at.start, at.end) if line else -1
    start = found + error.offset - begin
    return Span(start, min(start + error.length, at.end)) if found >= 0 else at


def placeholders(text: str) -> list[str]:
    """The facts that a text names in braces."""
    parts = text.split("{")[1:]
    return [part[: part.index("}")] for part in parts if "}" in part]


def markdown(rule: Rule) -> str:
    """A rule's page without its front matter."""
    return split(rule.source.text)[1].lstrip("\n")


def info(rule: Rule, severity: str | None = None, full: bool = True) -> RuleInfo:
    """What reports say of a rule; `full` with its page."""
    text = markdown(rule) if full else ""
    severity = severity or rule.severity
    return RuleInfo(rule.code, rule.name, severity, rule.confidence, rule.summary, text, rule.references, bool(rule.fix_specs))
