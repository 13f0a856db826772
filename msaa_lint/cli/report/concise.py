"""One line per finding: `file:line:column: severity[rule] message (CODE)`."""

from __future__ import annotations

from msaa_lint.core.finding import Finding, Result
from msaa_lint.linter.rules.reference_links import rule_address

from . import Options, Write
from .color import BOLD, SEVERITY, hyperlink, paint
from .escape import display
from .paths import display_path
from .place import place
from .summary import summary
from .undecided import explanation


def render(result: Result, out: Write, options: Options) -> None:
    """Prints the findings, with `show_suppressed` the suppressed ones after them, then the
    summary.
    """
    for finding in result.findings:
        out(line(finding, result, options) + "\n")
    render_end(result, out, options)


def line(finding: Finding, result: Result, options: Options) -> str:
    """A finding on one line."""
    where = location(finding, result, options)
    return (
        f"{paint(where, BOLD, options.color)}: {kind(finding, options)} "
        f"{display(finding.message)} ({display(finding.code)})"
    )


def kind(finding: Finding, options: Options) -> str:
    """The severity and the rule of a finding, as a link to the rule's page on a terminal that shows
    links.
    """
    address = (
        rule_address(options.docs_url, finding.code, finding.rule) if options.hyperlinks else ""
    )
    return paint(
        f"{finding.severity}[{hyperlink(display(finding.rule), address)}]",
        SEVERITY[finding.severity],
        options.color,
    )


def location(finding: Finding, result: Result, options: Options) -> str:
    """The path of a finding with its line and column, or for an input without text, with its
    subject.
    """
    path = display_path(finding.file, options.root)
    at = place(result, finding.file, finding.span)
    if at:
        return f"{path}:{at.line}:{at.column}"
    return f"{path}: {display(finding.subject)}" if finding.subject else path


def render_end(result: Result, out: Write, options: Options) -> None:
    """Prints what follows the findings in both text outputs: the suppressed ones, the statistics,
    and unless `quiet` the summary.
    """
    if options.show_suppressed:
        for entry in result.suppressed:
            reason = f", {display(entry.reason)}" if entry.reason.strip() else ""
            out(f"{line(entry.finding, result, options)} [suppressed: {entry.how}{reason}]\n")
    if options.explain_undecided:
        for text in explanation(result, options):
            out(text + "\n")
    if options.statistics:
        from . import statistics

        statistics.render(result, out, options)
    for text in () if options.quiet else summary(result, options):
        out(text + "\n")
