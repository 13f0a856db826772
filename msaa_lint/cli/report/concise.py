"""One line a finding: `file:line:column: severity[rule] message (CODE)`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .color import BOLD, SEVERITY, paint
from .escape import shown
from .paths import shown_path
from .place import place
from .statistics import table
from .summary import fixable, price_of_all, sentence

if TYPE_CHECKING:
    from msaa_lint.core.finding import Finding, Result

    from . import Options, Write


def render(result: Result, out: Write, options: Options) -> None:
    """Prints the findings, with `show_suppressed` the silenced ones after them, then the summary."""
    for finding in result.findings:
        out(line(finding, result, options) + "\n")
    closing(result, out, options)


def line(finding: Finding, result: Result, options: Options) -> str:
    """A finding on one line. An input without text has its subject where the place would be."""
    where = shown_path(finding.file, options.root)
    at = place(result, finding.file, finding.span)
    if at:
        where += f":{at.line}:{at.column}"
    elif finding.subject:
        where += f": {shown(finding.subject)}"
    kind = paint(f"{finding.severity}[{shown(finding.rule)}]", SEVERITY[finding.severity], options.color)
    return f"{paint(where, BOLD, options.color)}: {kind} {shown(finding.message)} ({shown(finding.code)})"


def closing(result: Result, out: Write, options: Options) -> None:
    """What stands below the findings in both text outputs: the silenced ones, the statistics, the summary."""
    if options.show_suppressed:
        for entry in result.suppressed:
            reason = f", {shown(entry.reason)}" if entry.reason.strip() else ""
            out(f"{line(entry.finding, result, options)} [suppressed: {entry.how}{reason}]\n")
    if options.statistics:
        out("".join(row + "\n" for row in table(result)))
    out(sentence(result, options) + "\n")
    for text in (price_of_all(result), fixable(result)):
        if text:
            out(text + "\n")
