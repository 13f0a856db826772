"""Findings with their source lines, for a person at a terminal."""

from __future__ import annotations

from collections.abc import Iterator, Sequence, Set

from msaa_lint.core.finding import CaptureLocation, Finding, Result
from msaa_lint.core.text.span import Label

from . import Options, Write
from .color import BOLD, SECONDARY, SEVERITY, paint
from .concise import kind, location, render_end
from .escape import display
from .excerpt import MAX_MARKS, Mark, excerpt
from .paths import display_path
from .place import place
from .summary import is_choice, price_text


def render(result: Result, out: Write, options: Options) -> None:
    """Prints each finding with an excerpt, its price, and its remedy, then the summary."""
    rules = {rule.name for rule in result.rules}
    for finding in result.findings:
        out(paragraph(finding, result, options, rules) + "\n\n")
    render_end(result, out, options)


def paragraph(finding: Finding, result: Result, options: Options, rules: Set[str]) -> str:
    """One finding, without a line end after its last line. `rules` are the names that `msaa-lint
    rule` knows.
    """
    head = f"{kind(finding, options)}{paint(': ' + display(finding.message), BOLD, options.color)}"
    digits, lines = 1, list[str]()
    source = result.sources.get(finding.file)
    if finding.span is not None and source is not None:
        digits, lines = excerpt(source, marks(finding), options.width, options.color)
    indent = " " * digits
    bar = paint(f"{indent} |", SECONDARY, options.color)
    equals = paint(f"{indent} =", SECONDARY, options.color)
    notes = [
        f"{equals} {paint(f'{word}:', BOLD, options.color)} {text}"
        for word, text in remarks(finding, rules)
    ]
    arrow = paint(f"{indent}-->", SECONDARY, options.color)
    others = [
        line
        for file, labels in elsewhere(finding).items()
        for line in _excerpt_of(file, labels, digits, result, options)
    ]
    return "\n".join(
        [head, f"{arrow} {location(finding, result, options)}", *lines, *others, bar, *notes]
    )


def marks(finding: Finding) -> list[Mark]:
    """The primary mark, with the labels at the finding's own span, and a mark for each other label
    of its file.
    """
    assert finding.span is not None
    texts: dict[tuple[int, int], list[str]] = {finding.span: []}
    for label in finding.labels:
        if label.file is None:
            texts.setdefault(label.span, []).append(display(label.text))
    primary = Mark(
        *finding.span, "; ".join(texts.pop(finding.span)), SEVERITY[finding.severity], True
    )
    return [
        primary,
        *(Mark(*span, "; ".join(parts), SECONDARY, False) for span, parts in texts.items()),
    ]


def elsewhere(finding: Finding) -> dict[str, list[Label]]:
    """The labels in other files, by file."""
    labels: dict[str, list[Label]] = {}
    for label in finding.labels:
        if label.file is not None:
            labels.setdefault(label.file, []).append(label)
    return labels


def _excerpt_of(
    file: str, labels: Sequence[Label], digits: int, result: Result, options: Options
) -> Iterator[str]:
    """Yields the lines of another file that have labels."""
    source = result.sources.get(file)
    at = place(result, file, labels[0].span)
    if source is not None and at is not None:
        marks = [Mark(*label.span, display(label.text), SECONDARY, False) for label in labels]
        wider, lines = excerpt(source, marks, options.width, options.color)
        colons = paint(" " * max(digits, wider) + ":::", SECONDARY, options.color)
        yield f"{colons} {display_path(file, options.root)}:{at.line}:{at.column}"
        yield from lines


def capture_location(where: CaptureLocation) -> str:
    """Where in a capture a finding is from, in words."""
    call = where.by if where.call is None else f"{where.by}, call {where.call}"
    return (
        call
        if where.frames is None or where.of < 2
        else f"{call}; in {where.frames} of {where.of} frames"
    )


def remarks(finding: Finding, rules: Set[str]) -> list[tuple[str, str]]:
    """What follows the excerpt: word and text."""
    lines = [("note", f"{display(finding.code)}, confidence {finding.confidence}")]
    if finding.capture_location is not None:
        lines.append(
            (
                "from",
                display(capture_location(finding.capture_location))
                + " (line numbers are those of `msaa-lint convert` output)",
            )
        )
    lines += [("note", display(note)) for note in finding.notes if note.strip()]
    places = len({label.span for label in finding.labels if label.file is None} | {finding.span})
    if places > MAX_MARKS:
        lines.append(("note", f"{places - MAX_MARKS} more places are not shown"))
    price = price_text(finding)
    if price:
        lines.append(("price" if is_choice(finding) else "cost", price))
    help_text, fix = display(finding.help), finding.fix
    how = ""
    if fix and fix.refusal:
        how = f" (not made: {display(fix.refusal)})"
    elif fix and fix.edits:
        how = " (safe: --fix)" if fix.safe else " (unsafe: --fix --unsafe-fixes)"
    elif fix and fix.choice:
        how = " (a choice: not applied)"
    elif fix and fix.shown:
        how = " (not applied automatically)"
    title = display(fix.title) if fix else ""
    if help_text and title and title != help_text:
        lines += [("help", help_text), ("fix", title + how)]
    elif help_text or title:
        lines.append(("help", (help_text or title) + how))
    if finding.rule in rules:
        lines.append(("docs", f"msaa-lint rule {display(finding.rule)}"))
    return lines
