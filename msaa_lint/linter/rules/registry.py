"""The registry of rules: the built-in rule pages and the user's own."""

from __future__ import annotations

import os
from collections.abc import Callable, Collection, Mapping, Sequence
from functools import cache
from typing import NamedTuple

from msaa_lint.core.diagnostics import diagnostic, internal_error
from msaa_lint.core.finding import Finding, RuleInfo
from msaa_lint.core.hidden_characters import hidden_characters
from msaa_lint.core.project import project_root
from msaa_lint.core.text.source import Source
from msaa_lint.core.text.span import Span

from .budget import COMPILE, MISTAKE, READ, Budget, OverBudget
from .front_matter import split
from .page_files import folder, pages
from .rule import Rule, page_problem
from .rule_file import Page, read_page


class BrokenPage(NamedTuple):
    """A page of the user's that is not a usable rule. `code` is empty if it is not stated."""

    code: str
    name: str
    page: str


class Registry(NamedTuple):
    """Rules in order of code, the problems of unusable pages, the texts they point into, by name,
    and these pages.
    """

    rules: tuple[Rule, ...]
    problems: tuple[Finding, ...]
    sources: Mapping[str, Source] = {}
    broken: tuple[BrokenPage, ...] = ()

    @property
    def names(self) -> tuple[Rule | BrokenPage, ...]:
        """What a selector or a suppression may name: a rule whose page is broken is not unknown. A
        usable one of that name is last.
        """
        return (*self.broken, *self.rules)


def _name(path: str) -> str:
    """The name of the rule of a page."""
    return os.path.basename(path).removesuffix(".md")


@cache
def built_in() -> Registry:
    """The built-in rules, which are read once in a process."""
    read = [read_page(path, f"rules/{os.path.basename(path)}", None) for path in pages(folder())]
    rules = sorted(
        (page.rule for page in read if page.rule is not None), key=lambda rule: rule.code
    )
    return Registry(tuple(rules), tuple(problem for page in read for problem in page.problems))


CheckFixes = Callable[[Rule], list[Finding]]
"""The problems of a rule's fixes."""


def load(
    paths: Sequence[str] = (),
    check_fixes: CheckFixes = lambda _: [],
    projects: Mapping[str, str] = {},
    budget: Budget | None = None,
    traceback: bool = False,
) -> Registry:
    """The built-in rules, and the rules of the given rule pages and folders of rule pages.

    `projects` has the projects of the paths that a configuration names. The pages of a folder must
    be in its project. Only the user's own rules are checked here, fixes with `check_fixes`, within
    the `budget` of the run; the test suite checks the built-in rules. A rule with a problem is left
    out. `traceback` raises an exception that reading one of the user's pages causes, instead of
    reporting it.
    """
    if not paths:
        return built_in()
    rules: list[Rule] = [*built_in().rules]
    problems: list[Finding] = [*built_in().problems]
    sources: dict[str, Source] = {}
    broken: list[BrokenPage] = []
    budget = budget or Budget()
    user_pages: dict[str, str | None] = {}
    for path in paths:
        found = pages(path)
        project = projects.get(path) or (None if found == [path] else project_root(path))
        user_pages.update(dict.fromkeys(map(os.path.normpath, found), project))
        if not found:
            shown = os.path.relpath(path).replace(os.sep, "/")
            problems.append(diagnostic("MSAA921", "no rule pages in this folder", shown))
    names = {rule.name for rule in rules}.union(map(_name, user_pages))
    others = {word: rule for rule in rules for word in (rule.code, rule.name)}
    for path, project in user_pages.items():
        shown = os.path.relpath(path).replace(os.sep, "/")
        try:
            if budget.left:
                page = _checked(
                    read_page(path, shown, project), path, others, names, check_fixes, budget
                )
            else:
                page = _unread(path, shown, budget)
        except Exception as error:
            if traceback:
                raise
            page = Page(None, (diagnostic("MSAA941", internal_error(error), shown),))
        if page.source is not None:
            sources[shown] = page.source
            problems += hidden_characters(page.source)
        if page.rule is not None:
            rules.append(page.rule)
            others.update({page.rule.code: page.rule, page.rule.name: page.rule})
        else:
            broken.append(BrokenPage(page.code, _name(path), shown))
        problems.extend(sorted(page.problems, key=lambda found: found.span or Span(0, 0)))
    return Registry(
        tuple(sorted(rules, key=lambda rule: rule.code)), tuple(problems), sources, tuple(broken)
    )


def _unread(path: str, shown: str, budget: Budget) -> Page:
    """A page for which nothing of the budget is left."""
    message = (
        f"it was not read: the pages before it took the {budget.steps} steps that the custom "
        "rules of a run may take"
    )
    return Page(None, (page_problem(_name(path), shown, message, Span(0, 0)),))


def _checked(
    page: Page,
    path: str,
    others: Mapping[str, Rule],
    names: Collection[str],
    check_fixes: CheckFixes,
    budget: Budget,
) -> Page:
    """One of the user's pages with all its problems; without its rule if it has any."""
    rule, found = page.rule, [*page.problems]
    if rule is not None:
        from .page_checks import check_names, check_rule

        conditions = [rule.when, *(case.when for case in rule.cases)]
        texts = len(rule.source.text) + sum(len(text) for text, _ in rule.texts)
        try:
            budget.charge(path, READ * texts + COMPILE * sum(map(len, conditions)))
            found += [*check_names(rule, others, names), *check_rule(rule), *check_fixes(rule)]
        except OverBudget as error:
            found.append(
                rule.problem(f"{error}; it was not checked, and is not used", rule.condition_at)
            )
    budget.spend(path, MISTAKE * len(found))
    return page._replace(rule=None if found else rule, problems=tuple(found))


def markdown(rule: Rule) -> str:
    """The Markdown of a rule's page."""
    return split(rule.source.text)[1].lstrip("\n")


def info(rule: Rule, severity: str | None = None, full: bool = True) -> RuleInfo:
    """A rule as reports describe it; `full` includes its page."""
    text = markdown(rule) if full else ""
    severity = severity or rule.severity
    return RuleInfo(
        rule.code,
        rule.name,
        severity,
        rule.confidence,
        rule.summary,
        text,
        rule.references,
        bool(rule.fix_specs),
    )
