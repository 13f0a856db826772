"""Runs rules on the subjects of a document."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import NamedTuple

from msaa_lint.core.allowance import Allowance
from msaa_lint.core.diagnostics import diagnostic
from msaa_lint.core.finding import CONFIDENCES, Finding, Fix, MissingKey, Undecided
from msaa_lint.core.quote import quoted, shortened
from msaa_lint.core.text.span import Label, Span
from msaa_lint.frame.facts.facts import Facts, Subject, Value
from msaa_lint.frame.facts.table import FACTS, PASS_PARTS

from .budget import REPORT, UNDECIDED, Budget, OverBudget
from .condition import Condition, activation, named
from .rule import PASSES, Case, FixSpec, Rule

_PLACEHOLDER = re.compile(r"\{([a-z_.0-9]+)\}")
_INTEGRAL = re.compile(r"\.0$")

Key = tuple[str, Span | None, str]
"""The code, location and message of a finding, which identify it in its file."""

FixSpecs = dict[Key, list[tuple[FixSpec, Subject]]]
"""By finding: the fix on its rule's page and the subject it applies to; several if the finding
stands for several subjects.
"""

Qualify = Callable[[Finding, Subject], Finding]
"""A finding about a subject with the confidence that what is known of the subject allows."""

FindKeys = Callable[[Subject, str], Sequence[MissingKey]]
"""The keys to write next so that a fact of a subject is known."""

Rules = list[tuple[Rule, Condition]]

Severity = Callable[[Rule, str, str | None], str | None]
"""`severity(rule, suggested, vendor)`: the severity of a rule's finding in one file; None where the
rule is off.
"""

RuleResult = tuple[Rule, "bool | ArithmeticError | None", tuple[str, ...]]
"""A rule, the value of its condition, and the facts that were missing if that is None."""

MAX_CACHED = 4096
"""Sets of facts whose results are cached, in some 6 MB."""

MAX_CACHED_CHARACTERS = 1 << 24
"""Of the names in these sets."""

MAX_LABEL = 120
"""Characters of a debug label in a message."""

MAX_LABELS = 2
"""Maximum number of debug labels in a message."""

MAX_VALUE = 500
"""Characters of a fact's value in a text."""


class Verdicts(NamedTuple):
    """The results of all rules for a document; `checked` is false if problems of the document kept
    them from running.
    """

    findings: list[Finding]
    undecided: list[Undecided]
    fix_specs: FixSpecs
    checked: bool = True


class RuleRunner:
    """A set of rules. Each condition is compiled once, when it is first needed, and evaluated once
    for the same facts.

    Most attachments of a frame are alike, and evaluating conditions takes most of the time.
    """

    def __init__(self, rules: Iterable[Rule], budget: Budget | None = None) -> None:
        self._budget = budget or Budget()
        self._by_subject: dict[str, dict[str, list[Rule]]] = {}
        """By API, then by kind of subject."""
        for rule in rules:
            for api in rule.apis:
                self._by_subject.setdefault(api.upper(), {}).setdefault(rule.subject, []).append(
                    rule
                )
        self._conditions: dict[str, Condition] = {}
        self._fact_names: dict[
            tuple[str, str], tuple[tuple[str, ...], tuple[str, ...], tuple[str, ...]]
        ] = {}
        self._cache: dict[tuple[object, ...], _Cached] = {}
        self._cached_characters = 0
        self._severity: object = None
        self._enabled: dict[tuple[str, str, bool], Rules] = {}
        """The rules that the last `severity` enables, by API, kind of subject, and whether it is of
        a pass that is only created.
        """
        self._off = 0
        """The number of pages that were turned off when these rules were determined."""

    def turned_off(self) -> set[str]:
        """The names of the rules whose pages the budget of the run has turned off."""
        off = self._budget.off
        every = (
            (
                rule
                for kinds in self._by_subject.values()
                for rules in kinds.values()
                for rule in rules
            )
            if off
            else ()
        )
        return {rule.name for rule in every if rule.path in off}

    def run(
        self,
        subjects: Iterable[Subject],
        file: str,
        severity: Severity,
        api: str = "VULKAN",
        missing_keys: FindKeys | None = None,
        all_keys: bool = False,
        key_budget: Allowance | None = None,
        qualify: Qualify | None = None,
    ) -> Verdicts:
        """The findings and undecided rules for the subjects of a document, from the rules for its
        API.

        `missing_keys` finds the keys that undecided rules name: those of one fact that it takes, or
        with `all_keys` of all facts. It is asked for as many of them as `key_budget` has left
        (None: for all). `qualify` may lower the confidence of findings.
        """
        findings: list[Finding] = []
        undecided: list[Undecided] = []
        fix_specs: FixSpecs = {}
        if self._severity is not severity:
            self._severity, self._enabled = severity, {}
        for subject in subjects:
            begun = subject.facts.values.get("pass.begun") if subject.kind in PASS_PARTS else None
            rules = self._rules(subject.kind, api, severity, only_created=begun == "NO")
            if not rules:
                continue
            vendor = subject.facts.values.get("device.vendor")
            evaluation = self._evaluation(subject, api)
            fired: list[tuple[Rule, Finding]] = []
            fixes: dict[str, FixSpec] = {}
            for rule, value, missing in evaluation.results(rules):
                at = rule.condition_at
                case: Case | None = None
                found: Finding | None = None
                try:
                    if value is None:
                        self._charge(rule, UNDECIDED)
                        keys: Mapping[str, MissingKey] = {}
                        if missing_keys is not None and (key_budget is None or key_budget.take()):
                            blocking = evaluation.blocking(
                                rule, self._condition(rule.when), missing, all_keys
                            )
                            keys = {
                                key.path: key
                                for fact in blocking
                                for key in missing_keys(subject, fact)
                            }
                        undecided.append(
                            Undecided(
                                rule.code,
                                rule.name,
                                file,
                                subject.path,
                                missing,
                                tuple(keys.values()),
                            )
                        )
                        continue
                    if isinstance(value, ArithmeticError):
                        raise value
                    for each in rule.cases:
                        at = each.condition_at
                        if evaluation.value(rule, self._condition(each.when)):
                            case = each
                            break
                    suggested = (
                        case.severity or rule.severity if case is not None else rule.severity
                    )
                    level = severity(rule, suggested, vendor if isinstance(vendor, str) else None)
                    if level is not None:
                        at = rule.places.get("message", at)
                        found = finding(rule, case, subject, file, level)
                        found = qualify(found, subject) if qualify is not None else found
                        self._charge(
                            rule,
                            REPORT
                            + len(found.message)
                            + len(found.help)
                            + sum(len(each.text) for each in found.labels),
                        )
                except OverBudget as error:
                    findings.append(
                        rule.problem(
                            f"{error}; it was turned off at {shortened(file, 200)}, and not run "
                            "from there on",
                            at,
                        )
                    )
                    continue
                except ArithmeticError as error:
                    findings.append(_failed(rule, error, file, at))
                    continue
                if found is not None:
                    fired.append(
                        (
                            rule,
                            _if_begun(found)
                            if begun == "NOT_STATED" and rule.passes == PASSES[0]
                            else found,
                        )
                    )
                    spec = rule.fix if case is None else case.fix
                    if spec is not None:
                        fixes[rule.code] = spec
            for found in _without_superseded(fired):
                findings.append(found)
                if found.code in fixes:
                    fix_specs.setdefault(finding_key(found), []).append(
                        (fixes[found.code], subject)
                    )
        return Verdicts(distinct(findings), undecided, fix_specs)

    def _charge(self, rule: Rule, steps: int) -> None:
        """Counts steps of a custom rule. Raises: OverBudget."""
        if rule.is_custom:
            self._budget.charge(rule.path, steps)

    def _rules(self, kind: str, api: str, severity: Severity, only_created: bool) -> Rules:
        key, off = (api, kind, only_created), self._budget.off
        if self._off != len(off):
            self._off, self._enabled = len(off), {}
        if key not in self._enabled:
            rules = [
                rule
                for rule in self._by_subject.get(api, {}).get(kind, ())
                if not only_created or rule.passes != PASSES[0]
            ]
            enabled = [
                rule
                for rule in rules
                if rule.path not in off and severity(rule, rule.severity, None) is not None
            ]
            self._enabled[key] = [(rule, self._condition(rule.when)) for rule in enabled]
        return self._enabled[key]

    def _condition(self, text: str) -> Condition:
        if text not in self._conditions:
            self._conditions[text] = Condition(text)
        return self._conditions[text]

    def _evaluation(self, subject: Subject, api: str) -> _Evaluation:
        names, single, lists = self._facts_used(api, subject.kind)
        values = subject.facts.values
        # A fact has one type and is never None: values that are equal here are equal in a
        # condition.
        of_lists = [
            tuple(value) if isinstance(value, list) else None for value in map(values.get, lists)
        ]
        facts = (api, subject.kind, *map(values.get, single), *of_lists)
        cached = self._cache.get(facts)
        if cached is None:
            self._cached_characters += sum(len(each) for each in facts if isinstance(each, str))
            if len(self._cache) >= MAX_CACHED or self._cached_characters > MAX_CACHED_CHARACTERS:
                self._cache.clear()
                self._cached_characters = 0
            cached = self._cache[facts] = _Cached()
        return _Evaluation(names, values, cached, self._budget)

    def _facts_used(
        self, api: str, kind: str
    ) -> tuple[tuple[str, ...], tuple[str, ...], tuple[str, ...]]:
        """The facts that the rules for a kind of subject name: all of them, those with single
        values, and those with lists.
        """
        found = self._fact_names.get((api, kind))
        if found is None:
            rules = self._by_subject.get(api, {}).get(kind, ())
            conditions = [
                text for rule in rules for text in (rule.when, *(case.when for case in rule.cases))
            ]
            names = tuple(dict.fromkeys(name for text in conditions for name in named(text)))
            lists = tuple(name for name in names if FACTS[name].type in ("LIST", "INTS"))
            found = self._fact_names[api, kind] = (
                names,
                tuple(name for name in names if name not in lists),
                lists,
            )
        return found


class _Cached:
    """The values of conditions for one set of facts, and the results of the rules that do not
    simply pass.
    """

    __slots__ = ("blocking", "results", "values")

    def __init__(self) -> None:
        self.blocking: dict[tuple[str, bool], tuple[str, ...]] = {}
        self.values: dict[str, bool | None] = {}
        self.results: tuple[Rules, list[RuleResult]] | None = None


class _Evaluation:
    """Evaluates conditions for one subject; `cached` is shared by the subjects with the same
    facts.
    """

    __slots__ = ("_activation", "_budget", "_cached", "_facts", "_names")

    def __init__(
        self, names: Sequence[str], facts: Mapping[str, Value], cached: _Cached, budget: Budget
    ) -> None:
        self._budget = budget
        self._names = names
        self._facts = facts
        self._cached = cached
        self._activation: object = None

    def value(self, rule: Rule, condition: Condition) -> bool | None:
        """The value of a condition of a rule; see `Condition.holds`. Raises: OverBudget."""
        values = self._cached.values
        if condition.text not in values:
            self._charge(rule, condition, self._facts)
            if self._activation is None:
                self._activation = activation(
                    None, {name: self._facts[name] for name in self._names if name in self._facts}
                )
            values[condition.text] = condition.holds(self._activation)
        return values[condition.text]

    def _charge(self, rule: Rule, condition: Condition, facts: Mapping[str, Value]) -> None:
        if rule.is_custom:
            self._budget.charge_evaluation(rule.path, condition.cost.steps(facts))

    def blocking(
        self, rule: Rule, condition: Condition, missing: Sequence[str], every: bool
    ) -> tuple[str, ...]:
        """A missing fact that an undecided condition depends on; if `every`, all that can decide it
        alone, or all if none can.
        """
        if len(missing) < 2:
            return tuple(missing)
        key = (condition.text, every)
        if key not in self._cached.blocking:
            known = {name: self._facts[name] for name in self._names if name in self._facts}
            if every:
                decisive = [
                    name for name in missing if self._is_decisive(rule, condition, name, known)
                ]
                self._cached.blocking[key] = tuple(decisive or missing)
            else:
                self._cached.blocking[key] = (condition.first_absent(activation(None, known)),)
        return self._cached.blocking[key]

    def _is_decisive(
        self, rule: Rule, condition: Condition, fact: str, known: Mapping[str, Value]
    ) -> bool:
        """Whether one of the values of a fact that a condition tells apart decides it, with what is
        known.
        """
        for value in condition.trials(fact):
            facts = {**known, fact: value}
            self._charge(rule, condition, facts)
            if condition.decides(activation(None, facts)):
                return True
        return False

    def results(self, rules: Rules) -> list[RuleResult]:
        """The rules that fire, fail or are undecided, in order."""
        cached = self._cached.results
        if cached is None or cached[0] is not rules:
            results: list[RuleResult] = []
            for rule, condition in rules:
                value: bool | ArithmeticError | None
                try:
                    value = self.value(rule, condition)
                except ArithmeticError as error:
                    value = error
                if value is not False:
                    missing = (
                        tuple(name for name in condition.facts if name not in self._facts)
                        if value is None
                        else ()
                    )
                    results.append((rule, value, missing))
            cached = self._cached.results = (rules, results)
        return cached[1]


def finding_key(finding: Finding) -> Key:
    """What identifies a finding in its file."""
    return (finding.code, finding.span, finding.message)


def finding(rule: Rule, case: Case | None, subject: Subject, file: str, severity: str) -> Finding:
    """The finding of a rule, or a case of it, for a subject. Its texts have their facts filled
    in.
    """
    facts = subject.facts
    message = case.message if case is not None and case.message is not None else rule.message
    confidence = (
        case.confidence if case is not None and case.confidence is not None else rule.confidence
    )
    help = case.help if case is not None and case.help is not None else rule.help
    spec = rule.fix if case is None else case.fix
    # Without `at`, the finding is at the first fact of the condition that has a location.
    names = rule.at or named(rule.when)
    span = (
        next((facts.places[name] for name in names if name in facts.places), None) or subject.head
    )
    # A pipeline may be used in other passes than the one that it is created for.
    context = _within(facts.values.get("pass.labels")) if subject.kind != "pipeline" else ""
    labels = []
    for fact, text in rule.labels:
        place = facts.places.get(fact)
        if place is not None and place != span and fact in facts.values:
            labels.append(Label(place, fill_in(text, facts)))
    return Finding(
        rule.code,
        rule.name,
        severity,
        confidence,
        context + fill_in(message, facts),
        file,
        span,
        subject.path,
        tuple(labels),
        (),
        fill_in(help, facts),
        Fix(
            fill_in(spec.title, facts),
            spec.safe,
            (),
            spec.safety == "shown",
            spec.safety == "shown",
        )
        if spec is not None
        else None,
        images=subject.images,
        context=context,
    )


def _within(labels: object) -> str:
    """The beginning of a message about a pass: ``in `Shadow / cascade 2`, ``; empty without debug
    labels.
    """
    if not isinstance(labels, list) or not labels:
        return ""
    names = [quoted(str(label), MAX_LABEL) for label in labels[:MAX_LABELS]]
    more = [f"{len(labels) - len(names)} more"] if len(labels) > len(names) else []
    *first, last = [*names, *more]
    return f"in {', '.join(first)} and {last}, " if first else f"in {last}, "


def fill_in(text: str, facts: Facts) -> str:
    """A page's text with the facts in braces replaced by their values."""
    if "{" not in text:
        return text
    return _PLACEHOLDER.sub(
        lambda match: shortened(_format(facts.values.get(match[1])), MAX_VALUE), text
    )


def _format(value: object) -> str:
    if value is None:
        return "unknown"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, list):
        return ", ".join(str(item) for item in value[:MAX_VALUE])
    return _INTEGRAL.sub("", str(value)) if isinstance(value, float) else str(value)


def _if_begun(found: Finding) -> Finding:
    """A finding about what a pass does, if the input does not state that a command begins it."""
    note = (
        "the input does not state whether a command begins this render pass, or it only serves "
        "to create pipelines"
    )
    return found._replace(confidence=CONFIDENCES[0], notes=(*found.notes, note))


def _without_superseded(fired: list[tuple[Rule, Finding]]) -> list[Finding]:
    """The findings of one subject without those that a more specific one supersedes, which says so
    in a note.
    """
    if len(fired) < 2:
        return [found for _, found in fired]
    by_name = {rule.name: found for rule, found in fired}
    superseded = {name for rule, _ in fired for name in rule.supersedes if name in by_name}
    findings = []
    for rule, found in fired:
        if rule.name not in superseded:
            others = sorted(
                (by_name[name] for name in {*rule.supersedes} if name in by_name),
                key=lambda other: other.code,
            )
            notes = tuple(f"covers {other.rule} ({other.code}) too" for other in others)
            findings.append(found._replace(notes=(*found.notes, *notes)) if notes else found)
    return findings


def distinct(findings: Iterable[Finding]) -> list[Finding]:
    """The first of the findings with the same code, location and message: a structure that two
    subjects share is one mistake.
    """
    by_key: dict[Key, Finding] = {}
    for found in findings:
        by_key.setdefault(finding_key(found), found)
    return list(by_key.values())


def _failed(rule: Rule, error: ArithmeticError, file: str, at: Span) -> Finding:
    message = f"cannot evaluate the condition of `{rule.name}` for {file}: {str(error)[:200]}"
    return diagnostic("MSAA921", message, rule.source.name, at, rule.name)
