"""What the summary of a report counts."""

from __future__ import annotations

from collections.abc import Mapping, Set

from msaa_lint.core.finding import Result
from msaa_lint.core.rendered import Counts, no_counts

from .inputs import COUNTS
from .undecided import pattern


def counts(result: Result) -> Counts:
    """What a summary counts; missing keys by the pattern of their paths."""
    if result.rendered is not None:
        return result.rendered.counts
    total = no_counts()
    for finding in result.findings:
        total.add_finding(finding.level, finding.file)
    for entry in result.undecided:
        total.codes.add(entry.code)
        for fact in entry.missing:
            total.facts.setdefault(fact, set()).add(entry.code)
        for key in entry.keys:
            total.keys.setdefault(pattern(key), set()).add(entry.code)
    numbers = {"suppressed": len(result.suppressed), "undecided": len(result.undecided), "unread": 0, **dict.fromkeys(COUNTS, 0)}
    for each in result.inputs:
        numbers["unread"] += each.unread is not None
        for name in COUNTS:
            numbers[name] += getattr(each, name)
    total.numbers.update(numbers)
    return total


def most_rules(codes: Mapping[str, Set[str]]) -> list[tuple[str, int]]:
    """What rules lack with the number of rules that lack it, the largest number first."""
    return sorted(((name, len(lacking)) for name, lacking in codes.items()), key=lambda item: (-item[1], item[0]))
