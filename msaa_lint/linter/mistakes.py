"""Finds out which findings in source code are one mistake: those that the same change of one place
in the code removes.

A render pass that several calls, documents, or rules describe is written once in the code. In
captures and descriptions, where each value stands for itself, every finding is a mistake of its
own.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Hashable, Iterable, Sequence
from itertools import chain

from msaa_lint.core.finding import CONFIDENCES, Finding, rank
from msaa_lint.core.quote import quoted
from msaa_lint.core.text.span import Span
from msaa_lint.frame.description.record import Record
from msaa_lint.frame.facts.facts import Subject

from .results import DocumentResult
from .rules.rule import FixSpec
from .rules.rule_runner import finding_key

MAX_SHARED = 2
"""The number of members that take their value from the same place in ordinary code: the operations
of depth and of stencil.
"""

_NUMBER = re.compile(r" \(\d+\)\Z")

_KINDS = frozenset({"aspect", "attachment", "image", "pipeline", "resolve"})
"""The subjects of rules about the value of a member, which the code states at one place."""


def one_per_mistake(
    findings: Sequence[Finding], results: Sequence[DocumentResult], fact_of: Callable[[str], str]
) -> list[Finding]:
    """The findings, with the most severe one in place of those that the same change removes. The
    others are named in its notes, and their fixes in `results` become part of its fix. `fact_of`
    returns the fact at whose place a rule, given by its code, reports.
    """
    by_span: dict[Span, list[Finding]] = {}
    for finding in findings:
        if finding.span is not None:
            by_span.setdefault(finding.span, []).append(finding)
    merged: dict[int, Finding | None] = {}
    for group in by_span.values():
        for mistake in _mistakes(group, results, fact_of) if len(group) > 1 else ():
            first, *others = sorted(mistake, key=_order)
            merged.update((id(other), None) for other in others)
            merged[id(first)] = _covering(first, others)
            _join_fixes(first, others, results)
    kept = (merged.get(id(finding), finding) for finding in findings)
    return [finding for finding in kept if finding is not None]


def _order(finding: Finding) -> tuple[int, int, bool, str, str]:
    return (
        -rank(finding.severity),
        -CONFIDENCES.index(finding.confidence),
        finding.fix is None,
        finding.code,
        finding.subject,
    )


def _mistakes(
    group: Sequence[Finding], results: Sequence[DocumentResult], fact_of: Callable[[str], str]
) -> Iterable[list[Finding]]:
    """The findings at one place that the same change removes."""
    fixes = {id(finding): _fixes(finding, results) for finding in group}
    every = list(chain.from_iterable(fixes.values()))
    is_stated = not any(
        _is_default(subject, finding.span) for finding in group for _, subject in fixes[id(finding)]
    )
    if not any(
        subject.kind in _KINDS and (spec.set or spec.add or spec.remove or spec.do)
        for spec, subject in every
    ):
        return []
    mistakes: dict[Hashable, list[Finding]] = {}
    for finding in group:
        changed = next(
            (setting.fact for spec, _ in fixes[id(finding)] for setting in spec.set),
            fact_of(finding.code),
        )
        key = None if is_stated else (_origin(finding.subject), changed)
        mistakes.setdefault(key, []).append(finding)
    return [mistake for mistake in mistakes.values() if len(mistake) > 1]


def _is_default(subject: Subject, span: Span | None) -> bool:
    """Whether a place is that of a structure whose members are not set one by one, and so have the
    same place.
    """
    parts = (subject.attachment, subject.image, subject.resolve)
    records: list[Record] = [part.record for part in parts if part is not None]
    records += [subject.pipeline] if subject.pipeline is not None else []
    return any(
        sum(value.span == span for _, value in record.spelled.values()) > MAX_SHARED
        for record in records
    )


def _origin(path: str) -> str:
    """What structures that the same code creates have in common: the path in their document,
    without the number that tells them apart.
    """
    return _NUMBER.sub("", path.partition("].")[2] if path.startswith("documents[") else path)


def _fixes(finding: Finding, results: Iterable[DocumentResult]) -> list[tuple[FixSpec, Subject]]:
    key = finding_key(finding)
    return [entry for result in results for entry in result.fix_specs.get(key, ())]


def _covering(finding: Finding, others: Sequence[Finding]) -> Finding:
    """A finding with notes that name the rules that it covers, and the other objects that it is
    about, too.
    """
    rules = dict.fromkeys(
        (other.code, other.rule) for other in others if other.code != finding.code
    )
    notes = [f"covers {rule} ({code}) too" for code, rule in sorted(rules)]
    names = dict.fromkeys(
        _name(other)
        for other in others
        if other.code == finding.code and _name(other) != _name(finding)
    )
    if names:
        notes.append(f"the same applies to {', '.join(map(quoted, names))}")
    return finding._replace(notes=tuple(dict.fromkeys((*finding.notes, *notes))))


def _name(finding: Finding) -> str:
    return finding.subject.rpartition(".")[2]


def _join_fixes(
    finding: Finding, others: Iterable[Finding], results: Iterable[DocumentResult]
) -> None:
    """Adds the fixes of the same rule for other subjects to those of a finding, and removes those
    of other rules.
    """
    for result in results:
        for other in others:
            specs = result.fix_specs.pop(finding_key(other), [])
            if specs and other.code == finding.code:
                result.fix_specs.setdefault(finding_key(finding), []).extend(specs)
