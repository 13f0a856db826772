"""What `check --fix` and `check --diff` print beside the findings that are left."""

from __future__ import annotations

import sys

from msaa_lint.core.finding import Finding, Result
from msaa_lint.linter.fixes.file_fixes import FixedText
from msaa_lint.linter.run import Outcome

from .report.diff import unified
from .report.escape import visible


def print_text(outcome: Outcome, name: str) -> None:
    """The mended text of standard input, byte for byte, on standard output."""
    for each in outcome.mended:
        if each.file == name:
            sys.stdout.flush()
            sys.stdout.buffer.write(each.data)
            sys.stdout.buffer.flush()


def print_diff(outcome: Outcome, color: bool) -> bool:
    """What fixes would change; whether that is anything."""
    changed = [each for each in outcome.mended if each.changed]
    out = sys.stdout
    if hasattr(out, "reconfigure"):
        out.reconfigure(encoding="utf-8", errors="backslashreplace", newline="\n")
    for each in changed:
        for line in unified(each.before, each.after, visible(each.file), color):
            out.write(line)
    out.flush()
    return bool(changed)


def remarks(outcome: Outcome, written: bool, unsafe: bool) -> list[str]:
    """How many findings are fixed and left, and why a fix was not made: lines for the standard error stream."""
    fixed = sum(len(each.fixed_findings) for each in outcome.mended)
    left = len([found for found in outcome.result.findings if not found.fatal]) - (0 if written else fixed)
    more = "" if unsafe else _more(outcome.result)
    lines = [f"{fixed} {'' if written else 'would be '}fixed, {max(left, 0)} left{more}"]
    for each in outcome.mended:
        for finding, reason in each.failed_fixes:
            lines.append(f"{visible(each.file)}{_line(each, finding)}: {visible(finding.rule)} is not fixed: {visible(reason)}")
    return lines


def _more(result: Result) -> str:
    unsafe = [found for found in result.findings if found.fix is not None and not found.fix.safe and not found.fix.shown]
    return f", {len(unsafe)} of them with an unsafe fix (--unsafe-fixes)" if unsafe else ""


def _line(each: FixedText, finding: Finding) -> str:
    source = each.result.source
    return f":{source.position(finding.span.start).line}" if source is not None and finding.span is not None else ""
