"""What annotations of lines say, in the log of a CI system or in a review: the findings to show,
and the text of each.
"""

from __future__ import annotations

from bisect import insort
from collections.abc import Iterable, Iterator

from msaa_lint.core.diagnostics import diagnostic
from msaa_lint.core.finding import SEVERITIES, Finding, Result, rank
from msaa_lint.core.spool import Spool, SpooledSort
from msaa_lint.linter.rules.reference_links import rule_address

from . import Options
from .escape import display
from .inputs import unread_inputs
from .summary import is_choice, price_text, usable_price


def by_importance(findings: Iterable[Finding]) -> Iterator[Finding]:
    """The most important first: by severity, then inputs that cannot be used, then power and
    memory.
    """
    rows: SpooledSort[Finding] = SpooledSort(Spool(), 4)
    for finding in findings:
        rows.add(_importance(finding), [finding])
    for _, (finding,) in rows:
        yield finding


def most_important(findings: Iterable[Finding], most: int) -> list[Finding]:
    """The first ones of each severity `by_importance`, at most so many."""
    kept: dict[str, list[tuple[tuple[int, int, float, float], int, Finding]]] = {
        severity: [] for severity in reversed(SEVERITIES)
    }
    for number, finding in enumerate(findings):
        of_severity = kept[finding.severity]
        insort(of_severity, (_importance(finding), number, finding))
        del of_severity[most:]
    return [finding for of_severity in kept.values() for _, _, finding in of_severity]


def _importance(finding: Finding) -> tuple[int, int, float, float]:
    """A key to sort by."""
    price = usable_price(finding)
    return (
        -rank(finding.severity),
        -finding.fatal,
        *((-price.milliwatts, -price.memory_mib) if price else (0.0, 0.0)),
    )


def unread_notes(result: Result) -> list[Finding]:
    """A note for each input that shows no pass to check."""
    pairs = [(each.file, each.unread) for each in unread_inputs(result)]
    return [
        diagnostic("MSAA931", unread.message, file, unread.span)._replace(severity="note")
        for file, unread in pairs
        if unread
    ]


def annotation_lines(finding: Finding, options: Options) -> list[str]:
    """The message, and as far as there are any the price, what to do, and the address of the rule's
    page.
    """
    remedy = finding.help or (finding.fix.title if finding.fix else "")
    remarks = (
        ("price" if is_choice(finding) else "cost", price_text(finding)),
        ("help", display(remedy)),
        ("docs", rule_address(options.docs_url, finding.code, finding.rule)),
    )
    return [display(finding.message), *(f"{word}: {text}" for word, text in remarks if text)]
