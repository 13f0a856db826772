"""Findings with their source lines, for a person at a terminal."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .color import BOLD, SECONDARY, SEVERITY, paint
from .concise import closing
from .escape import shown
from .excerpt import MOST_MARKS, Mark, excerpt
from .paths import shown_path
from .place import place
from .summary import cost

if TYPE_CHECKING:
    from collections.abc import Set

    from msaa_lint.core.finding import CaptureLocation, Finding, Result

    from . import Options, Write


def render(result: Result, out: Write, options: Options) -> None:
    """Prints each finding with an excerpt, what it costs and what helps, then the summary."""
    rules = {rule.name for rule in result.rules}
    for finding in result.findings:
        out(paragraph(finding, result, options, rules) + "\n\n")
    closing(result, out, options)


def paragraph(finding: Finding, result: Result, options: Options, rules: Set[str]) -> str:
    """One finding, without a line end after its last line. `rules` are the names that `msaa-lint rule` knows."""
    style = SEVERITY[finding.severity]
    kind = paint(f"{finding.severity}[{shown(finding.rule)}]", style, options.color)
    head = f"{kind}{paint(': ' + shown(finding.message), BOLD, options.color)}"
    where = shown_path(finding.file, options.root)
    at = place(result, finding.file, finding.span)
    digits, lines = 1, []
    if at:
        where += f":{at.line}:{at.column}"
    source = result.sources.get(finding.file)
    if finding.span is not None and source is not None and (at or source.origins is not None):
        view = excerpt(result.sources[finding.file], marks(finding), options.width, options.color)
        digits, lines = view.digits, view.lines
    if not at and finding.subject:
        where += f": {shown(finding.subject)}"
    indent = " " * digits
    bar = paint(f"{indent} |", SECONDARY, options.color)
    said = [
        paint(f"{indent} =", SECONDARY, options.color) + " " + paint(f"{word}:", BOLD, options.color) + " " + text
        for word, text in remarks(finding, rules)
    ]
    arrow = paint(f"{indent}-->", SECONDARY, options.color)
    return "\n".join([head, f"{arrow} {where}", *lines, bar, *said])


def marks(finding: Finding) -> list[Mark]:
    """The primary mark and the labels. A label at the finding's own place is what the primary mark says."""
    assert finding.span is not None
    own = "; ".join(shown(label.text) for label in finding.labels if label.span == finding.span)
    said: dict[tuple[int, int], str] = {}
    for label in finding.labels:
        if label.span != finding.span:
            text = shown(label.text)
            said[label.span] = f"{said[label.span]}; {text}" if label.span in said else text
    primary = Mark(*finding.span, own, SEVERITY[finding.severity], True)
    return [primary, *(Mark(*span, text, SECONDARY, False) for span, text in said.items())]


def seen(where: CaptureLocation) -> str:
    """Where in a capture a finding is from, in words."""
    call = where.by if where.call is None else f"{where.by}, call {where.call}"
    return call if where.frames is None or where.of < 2 else f"{call}; in {where.frames} of {where.of} frames"


def remarks(finding: Finding, rules: Set[str]) -> list[tuple[str, str]]:
    """What stands below the excerpt: word and text."""
    said = [("note", f"{shown(finding.code)}, confidence {finding.confidence}")]
    if finding.seen is not None:
        said.append(("from", shown(seen(finding.seen)) + " (the lines are those that `msaa-lint convert` writes)"))
    said += [("note", shown(note)) for note in finding.notes if note.strip()]
    places = len({label.span for label in finding.labels} | {finding.span})
    if places > MOST_MARKS:
        said.append(("note", f"{places - MOST_MARKS} more places are not shown"))
    price = cost(finding)
    if price:
        said.append(("cost", price))
    help_text, fix = shown(finding.help), finding.fix
    how = ""
    if fix and fix.edits:
        how = " (safe: --fix)" if fix.safe else " (unsafe: --fix --unsafe-fixes)"
    elif fix and fix.shown:
        how = " (yours to decide)"
    title = shown(fix.title) if fix else ""
    if help_text and title and title != help_text:
        said += [("help", help_text), ("fix", title + how)]
    elif help_text or title:
        said.append(("help", (help_text or title) + how))
    if finding.rule in rules:
        said.append(("docs", f"msaa-lint rule {shown(finding.rule)}"))
    return said
