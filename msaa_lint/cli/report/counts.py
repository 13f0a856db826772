"""What the summary of a report counts."""

from __future__ import annotations

from collections import Counter

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
        total.undecided.add((entry.code, "", ""))
        total.undecided.update((entry.code, "fact", fact) for fact in entry.missing)
        total.undecided.update((entry.code, "key", pattern(key)) for key in entry.keys)
    numbers = {
        "suppressed": len(result.suppressed),
        "undecided": len(result.undecided),
        "unread": 0,
        **dict.fromkeys(COUNTS, 0),
    }
    for each in result.inputs:
        numbers["unread"] += each.unread is not None
        for name in COUNTS:
            numbers[name] += getattr(each, name)
    total.numbers.update(numbers)
    return total


def undecided_rules(figures: Counts) -> int:
    """The number of rules that are undecided anywhere."""
    return len({code for code, _, _ in figures.undecided})


def missing(figures: Counts, kind: str) -> list[tuple[str, int]]:
    """The missing facts, or keys, with the number of rules that lack each, the largest number
    first.
    """
    found = Counter(name for _, of_kind, name in figures.undecided if of_kind == kind)
    return sorted(found.items(), key=lambda item: (-item[1], item[0]))
