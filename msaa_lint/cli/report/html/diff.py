"""A fix as a diff of the lines that it changes."""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from msaa_lint.core.text.edits import apply
from msaa_lint.core.text.source import Source
from msaa_lint.core.text.span import Edit, Span

from ..escape import clip

MAX_EDITS = 20
MAX_LINES = 80
MAX_CHARACTERS = 20_000
"""What the diff of one finding shows at most: edits, lines, and characters of the text that they
change.
"""

_CONTEXT = 1
_MAX_LINE = 500
_LINE_END = re.compile(r"\r\n|\r|\n")


class DiffLine(NamedTuple):
    """A line; `kind` is `hunk`, `removed`, `added`, or `context`."""

    kind: str
    sign: str
    text: str


def fix_diff(source: Source, edits: Sequence[Edit]) -> list[DiffLine]:
    """The lines that edits change, with one around them. Its size, and the time it takes, do not
    depend on the size of the text.
    """
    lines = list(_lines(source, sorted(edits[:MAX_EDITS])))
    left = len(edits) - MAX_EDITS
    if len(lines) > MAX_LINES:
        lines = [
            *lines[:MAX_LINES],
            DiffLine("hunk", "", "more lines are not shown; `msaa-lint check --diff` prints all"),
        ]
    elif left > 0:
        lines.append(
            DiffLine(
                "hunk", "", f"{left} more edits are not shown; `msaa-lint check --diff` prints all"
            )
        )
    return lines


def _lines(source: Source, edits: Sequence[Edit]) -> Iterator[DiffLine]:
    for first, last, group in _groups(source, edits):
        starts = source.starts
        start, end = starts[first - 1], starts[last] if last < len(starts) else len(source.text)
        yield DiffLine("hunk", "", f"@@ line {first} @@")
        if end - start > MAX_CHARACTERS:
            yield DiffLine(
                "hunk",
                "",
                f"{last - first + 1} lines, too long to show; `msaa-lint check --diff` prints them",
            )
            continue
        before = source.text[start:end]
        try:
            after = apply(
                before,
                [
                    Edit(Span(edit.span.start - start, edit.span.end - start), edit.text)
                    for edit in group
                ],
            )
        except ValueError:
            continue  # overlapping edits, or some that are not within the text, have no diff
        changes = difflib.unified_diff(_split(before), _split(after), n=_CONTEXT, lineterm="")
        for number, line in enumerate(changes):
            if number > 1 and not line.startswith("@@"):
                kind = {"-": "removed", "+": "added"}.get(line[0], "context")
                yield DiffLine(kind, line[0], clip(line[1:], _MAX_LINE))


def _split(text: str) -> list[str]:
    """The lines of a text, without their ends."""
    lines = _LINE_END.split(text)
    return lines if lines[-1] else lines[:-1]


def _groups(source: Source, edits: Sequence[Edit]) -> list[tuple[int, int, list[Edit]]]:
    """Edits that are close to each other, with the first and the last of their lines."""
    groups: list[tuple[int, int, list[Edit]]] = []
    for edit in edits:
        first = max(source.position(edit.span.start).line - _CONTEXT, 1)
        last = min(source.position(edit.span.end).line + _CONTEXT, source.line_count)
        last = max(last, first)
        if groups and first <= groups[-1][1] + 1:
            begin, end, group = groups[-1]
            groups[-1] = (begin, max(end, last), [*group, edit])
        else:
            groups.append((first, last, [edit]))
    return groups
