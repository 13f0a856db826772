"""What `check --fix` and `check --diff` print besides the remaining findings."""

from __future__ import annotations

import difflib
import re
import sys
from collections.abc import Iterator

from msaa_lint.core.finding import Finding, Result
from msaa_lint.linter.fixes.file_fixes import FixedText
from msaa_lint.linter.programs import merge
from msaa_lint.linter.run import Outcome

from .report.color import paint
from .report.escape import escape, escape_lines
from .report.summary import files_saving

_LINE = re.compile(r"[^\r\n]*(?:\r\n|\r|\n)|[^\r\n]+")
_STYLES = {"+": "32", "-": "31", "@": "36"}


def print_text(outcome: Outcome, name: str) -> None:
    """Prints the fixed text of standard input to standard output, byte for byte."""
    for text in outcome.fixed:
        if text.file == name:
            sys.stdout.flush()
            sys.stdout.buffer.write(text.data)
            sys.stdout.buffer.flush()


def print_diff(outcome: Outcome, color: bool) -> bool:
    """Prints what fixes would change; returns whether that is anything."""
    changed = [text for text in outcome.fixed if text.changed]
    if hasattr(sys.stdout, "reconfigure"):
        sys.stdout.reconfigure(newline="\n")
    for text in changed:
        for line in unified_diff(text.before, text.after, escape(text.file), color):
            sys.stdout.write(line)
    sys.stdout.flush()
    return bool(changed)


def unified_diff(before: str, after: str, name: str, color: bool = False) -> Iterator[str]:
    """The lines of a unified diff, with line ends. Control characters are escaped, except tabs and
    the line's own end, and what a CI runner obeys.
    """
    lines = difflib.unified_diff(
        _LINE.findall(before), _LINE.findall(after), f"a/{name}", f"b/{name}"
    )
    for number, line in enumerate(lines):
        text = line.rstrip("\r\n")
        end = line[len(text) :]
        escaped = escape_lines(text)
        style = "1" if number < 2 else _STYLES.get(text[:1], "")
        # A carriage return before the line end stays, so that the diff can be applied.
        yield paint(escaped, style, color) + (end if end in ("\r\n", "\n") else "\n")
        if not end:
            yield "\\ No newline at end of file\n"


def fix_summary(outcome: Outcome, applied: bool, unsafe: bool) -> list[str]:
    """How many findings are fixed and how many remain, then why the others are not fixed."""
    fixed = sum(len(merge(text.fixed_findings, text.result.documents)) for text in outcome.fixed)
    remaining = sum(not finding.fatal for finding in outcome.result.findings) - (
        0 if applied else fixed
    )
    summary = f"{fixed} {'' if applied else 'would be '}fixed, {max(remaining, 0)} remaining"
    lines = [summary if unsafe else summary + _unsafe_hint(outcome.result)]
    for text in outcome.fixed:
        for finding, reason in text.failed_fixes:
            lines.append(
                f"{text.file}{_line(text, finding)}: {finding.rule} is not fixed: {reason}"
            )
    return lines


def _unsafe_hint(result: Result) -> str:
    savings = files_saving(result)
    unsafe = savings.all.findings - savings.safe.findings
    return f", {unsafe} of them fixable with --unsafe-fixes" if unsafe > 0 else ""


def _line(text: FixedText, finding: Finding) -> str:
    source = text.result.source
    return (
        f":{source.position(finding.span.start).line}"
        if source is not None and finding.span is not None
        else ""
    )
