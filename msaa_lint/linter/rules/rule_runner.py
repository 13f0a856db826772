"""Subjects and rules to findings."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import NamedTuple

from msaa_lint.core.diagnostics import diagnostic
from msaa_lint.core.finding import Finding, Fix, Undecided
from msaa_lint.core.text.span import Label, Span
from msaa_lint.frame.facts.facts import Facts, Subject, Value

from .condition import Condition, activation, named
from .rule_file import Case, FixSpec, Rule

_PLACEHOLDER = re.compile(r"\{([a-z_.0-9]+)\}")
_EVEN = re.compile(r"\.0$")


Key = tuple[str, Span | None, str]
"""The code, place and message of a finding: what tells it from others of its file."""

FixSpecs = dict[Key, list[tuple[FixSpec, Subject]]]
"""By finding: its page's fix, and the subject that it was found in; several where they are one finding."""


class Verdicts(NamedTuple):
    """What the rules said of a document."""

    findings: list[Finding]
    undecided: list[Undecided]
    fix_specs: FixSpecs


Rules = list[tuple[Rule, Condition]]

RuleResult = tuple[Rule, "bool | ArithmeticError | None", tuple[str, ...]]
"""A rule, what it says of some facts, and the facts that it lacks where that is None."""

MOST_REMEMBERED = 4096
"""Sets of facts whose answers are remembered: some 6 MB."""


class RuleRunner:
    """Rules made ready: a condition is compiled once, when it is first asked, and asked once of the same facts.

    Frames repeat themselves: most attachments of most passes are stated like another, and asking takes most of the time of judging.
    """

    def __init__(self, rules: Iterable[Rule]) -> None:
        self._by_subject: dict[str, dict[str, list[Rule]]] = {}
        """By API, then by kind of subject."""
        for rule in rules:
            for api in rule.apis:
                self._by_subject.setdefault(api.upper(), {}).setdefault(rule.subject, []).append(rule)
        self._conditions: dict[str, Condition] = {}
        self._asked: dict[tuple[str, str], tuple[str, ...]] = {}
        self._remembered: dict[tuple[object, ...], _Known] = {}
        self._severity: object = None
        self._on: dict[str, dict[str, Rules]] = {}
        """By API and kind of subject the rules that are on, by the last `severity` that was asked."""

    def judge(
        self,
        subjects: Iterable[Subject],
        file: str,
        severity: Callable[[Rule, str, str | None], str | None],
        api: str = "VULKAN",
    ) -> Verdicts:
        """The findings and undecided rules of a document's subjects, by the rules about frames of its API.

        `severity(rule, suggested, vendor)` gives what a finding weighs, None where the rule is off for the file.
        """
        findings: list[Finding] = []
        undecided: list[Undecided] = []
        mends: FixSpecs = {}
        if self._severity is not severity:
            self._severity, self._on = severity, {}
        on, about = self._on.setdefault(api, {}), self._by_subject.get(api, {})
        for subject in subjects:
            rules = on.get(subject.kind)
            if rules is None:
                every = about.get(subject.kind, ())
                enabled = [rule for rule in every if severity(rule, rule.severity, None) is not None]
                rules = on[subject.kind] = [(rule, self._condition(rule.when)) for rule in enabled]
            if not rules:
                continue
            values = subject.facts.values
            answers = self._answers(subject, api)
            fired: list[tuple[Rule, Finding]] = []
            fixes: dict[str, FixSpec] = {}
            for rule, answer, missing in answers.telling(rules):
                try:
                    if isinstance(answer, ArithmeticError):
                        raise answer
                    case = self._case(rule, answers) if answer else None
                except ArithmeticError as error:
                    findings.append(_failed(rule, error, file))
                    continue
                if answer:
                    suggested = case.severity or rule.severity if case is not None else rule.severity
                    vendor = values.get("device.vendor")
                    weight = severity(rule, suggested, vendor if isinstance(vendor, str) else None)
                    if weight is not None:
                        fired.append((rule, finding(rule, case, subject, file, weight)))
                        mend = rule.fix if case is None else case.fix
                        if mend is not None:
                            fixes[rule.code] = mend
                else:
                    undecided.append(Undecided(rule.code, rule.name, file, subject.path, missing))
            kept = _one_cause(fired)
            findings.extend(kept)
            for found in kept if fixes else ():
                if found.code in fixes:
                    mends.setdefault(finding_key(found), []).append((fixes[found.code], subject))
        return Verdicts(distinct(findings), undecided, mends)

    def _condition(self, text: str) -> Condition:
        if text not in self._conditions:
            self._conditions[text] = Condition(text)
        return self._conditions[text]

    def _answers(self, subject: Subject, api: str) -> _Answers:
        asked = self._facts_asked(api, subject.kind)
        values = subject.facts.values
        # A fact is of one type, and never None: what is equal here is equal to a condition.
        facts = (api, subject.kind, *[tuple(value) if type(value) is list else value for value in map(values.get, asked)])
        known = self._remembered.get(facts)
        if known is None:
            if len(self._remembered) >= MOST_REMEMBERED:
                self._remembered.clear()
            known = self._remembered[facts] = _Known()
        return _Answers(asked, values, known)

    def _facts_asked(self, api: str, kind: str) -> tuple[str, ...]:
        asked = self._asked.get((api, kind))
        if asked is None:
            rules = self._by_subject.get(api, {}).get(kind, ())
            texts = [text for rule in rules for text in (rule.when, *(case.when for case in rule.cases))]
            asked = self._asked[api, kind] = tuple(dict.fromkeys(name for text in texts for name in named(text)))
        return asked

    def _case(self, rule: Rule, answers: _Answers) -> Case | None:
        return next((case for case in rule.cases if answers.of(self._condition(case.when))), None)


class _Known:
    """What conditions said of some facts, and of which rules that tells something: they fire, fail or are undecided."""

    __slots__ = ("answers", "telling")

    def __init__(self) -> None:
        self.answers: dict[str, bool | None] = {}
        self.telling: tuple[Rules, list[RuleResult]] | None = None


class _Answers:
    """What conditions say of one subject; `known` is what they said of another with the same facts."""

    __slots__ = ("_asked", "_known", "_ready", "_values")

    def __init__(self, asked: Sequence[str], values: Mapping[str, Value], known: _Known) -> None:
        self._asked = asked
        self._values = values
        self._known = known
        self._ready: object = None

    def of(self, condition: Condition) -> bool | None:
        """As `Condition.holds`."""
        answers = self._known.answers
        if condition.text not in answers:
            if self._ready is None:
                self._ready = activation(None, {name: self._values[name] for name in self._asked if name in self._values})
            answers[condition.text] = condition.holds(self._ready)
        return answers[condition.text]

    def telling(self, rules: Rules) -> list[RuleResult]:
        """The rules that fire, that could not be asked, and that are undecided, these with the facts that they lack; in their order."""
        told = self._known.telling
        if told is None or told[0] is not rules:
            made: list[RuleResult] = []
            for rule, condition in rules:
                answer: bool | ArithmeticError | None
                try:
                    answer = self.of(condition)
                except ArithmeticError as error:
                    answer = error
                if answer is not False:
                    missing = tuple(name for name in condition.facts if name not in self._values) if answer is None else ()
                    made.append((rule, answer, missing))
            told = self._known.telling = (rules, made)
        return told[1]


def finding_key(found: Finding) -> Key:
    """What tells a finding from the others of its file."""
    return (found.code, found.span, found.message)


def finding(rule: Rule, case: Case | None, subject: Subject, file: str, severity: str) -> Finding:
    """The finding of a rule for a subject: its texts filled in, at the place of the fact that the page names."""
    facts = subject.facts
    message = case.message if case is not None and case.message is not None else rule.message
    confidence = case.confidence if case is not None and case.confidence is not None else rule.confidence
    # Without `at`, the first fact of the condition that is stated somewhere.
    span = _place(rule.at or named(rule.when), facts) or subject.head
    labels = []
    for fact, text in rule.labels:
        place = facts.places.get(fact)
        if place is not None and place != span and fact in facts.values:
            labels.append(Label(place, filled(text, facts)))
    mend = rule.fix if case is None else case.fix
    fix = Fix(filled(mend.title, facts), mend.safe, (), mend.safety == "shown") if mend is not None else None
    help = filled(case.help if case is not None and case.help is not None else rule.help, facts)
    return Finding(
        rule.code, rule.name, severity, confidence, filled(message, facts), file, span, subject.path, tuple(labels), (), help, fix
    )


def filled(text: str, facts: Facts) -> str:
    """A page's text with the facts that it names in braces."""
    return _PLACEHOLDER.sub(lambda match: _worded(facts.values.get(match[1])), text)


def _worded(value: object) -> str:
    if value is None:
        return "unknown"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, list):
        return ", ".join(str(item) for item in value)
    return _EVEN.sub("", str(value)) if isinstance(value, float) else str(value)


def _place(names: Sequence[str], facts: Facts) -> Span | None:
    return next((facts.places[name] for name in names if name in facts.places), None)


def _one_cause(fired: list[tuple[Rule, Finding]]) -> list[Finding]:
    """The findings about one subject, those left out that a more specific one supersedes; it says so in a note."""
    names = {rule.name for rule, _ in fired}
    dropped = {name for rule, _ in fired for name in rule.supersedes if name in names}
    kept = []
    for rule, found in fired:
        if rule.name in dropped:
            continue
        covered = tuple(f"covers {other.rule} ({other.code}) too" for r, other in fired if r.name in rule.supersedes)
        kept.append(found._replace(notes=(*found.notes, *covered)) if covered else found)
    return kept


def distinct(findings: Iterable[Finding]) -> list[Finding]:
    """The first of the findings with the same code, location and message: a structure that two subjects share is one mistake."""
    by_key: dict[Key, Finding] = {}
    for found in findings:
        by_key.setdefault(finding_key(found), found)
    return list(by_key.values())


def _failed(rule: Rule, error: ArithmeticError, file: str) -> Finding:
    message = f"the condition of `{rule.name}` cannot be worked out: {str(error)[:200]}"
    return diagnostic("MSAA921", message, rule.source.name, rule.condition_at, rule.name, help=f"met in {file}")
