"""The edits between two texts, so that an editor keeps its cursor, marks, and folds outside of
them.
"""

from __future__ import annotations

from difflib import SequenceMatcher
from itertools import accumulate

from msaa_lint.core.text.span import Edit, Span

MAX_LINES = 2000
"""Lines between the first and the last difference up to which several edits are determined, in time
that may grow with their square.
"""


def line_edits(before: str, after: str) -> list[Edit]:
    """The edits that make one text of another, in order."""
    old, new = before.splitlines(keepends=True), after.splitlines(keepends=True)
    first = 0
    while first < min(len(old), len(new)) and old[first] == new[first]:
        first += 1
    last = 0
    while last < min(len(old), len(new)) - first and old[-1 - last] == new[-1 - last]:
        last += 1
    starts = [0, *accumulate(map(len, old))]
    old_part, new_part = old[first : len(old) - last], new[first : len(new) - last]
    if max(len(old_part), len(new_part)) > MAX_LINES:
        return [Edit(Span(starts[first], starts[len(old) - last]), "".join(new_part))]
    changes = SequenceMatcher(None, old_part, new_part, autojunk=False).get_opcodes()
    return [
        Edit(Span(starts[first + start], starts[first + end]), "".join(new_part[new_start:new_end]))
        for tag, start, end, new_start, new_end in changes
        if tag != "equal"
    ]
