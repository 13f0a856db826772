"""How often each rule fired, as a text table."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..finding import rank
from .escape import shown

if TYPE_CHECKING:
    from ..finding import Result
    from . import Options, Write


def render(result: Result, out: Write, options: Options) -> None:
    """Prints the table: count, code, rule and severity, the most frequent rule first. Nothing where there is no finding."""
    for line in table(result):
        out(line + "\n")


def table(result: Result) -> list[str]:
    """The lines of the table. A rule whose findings differ in severity has a line for each."""
    counts: dict[tuple[str, str, str], int] = {}
    for finding in result.findings:
        key = (shown(finding.code), shown(finding.rule), finding.severity)
        counts[key] = counts.get(key, 0) + 1
    if not counts:
        return []
    rows = sorted(counts.items(), key=lambda item: (-item[1], -rank(item[0][2]), item[0]))
    cells = [("count", "code", "rule", "severity")]
    cells += [(str(n), code, rule, severity) for (code, rule, severity), n in rows]
    # The count comes first, so that no line begins with text of an input.
    count, code, rule = (max(len(row[column]) for row in cells) for column in range(3))
    return [f"{row[0]:>{count}}  {row[1]:<{code}}  {row[2]:<{rule}}  {row[3]}" for row in cells]
