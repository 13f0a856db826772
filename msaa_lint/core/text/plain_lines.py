"""Lines that were meant to be `key: value` and are not."""

from __future__ import annotations

import re

from msaa_lint.core.quote import quoted

from .excerpts import MAX_SHOWN, line_end, syntax
from .node import Problem

_MEANT = r"([\"']?)([A-Za-z_]\w*)\1(?: *(=|:=|：) *| *(:)(?=[^\s:/\\])|( +)|$)([^\s#=:].*)?"
_COMMENTS = ("//", "/*", "*", "--", ";", "%")


def entry(text: str) -> str | None:
    """`samples: 4` for `samples:4`, `samples = 4` and `samples： 4`: the entry that was meant; None
    for another text.
    """
    match = re.match(_MEANT, text, re.DOTALL)
    if match is None or match[5] or not match[6]:
        return None
    return f"{match[2]}: {match[6].split()[0]}"


def keyless(text: str, at: int) -> Problem | None:
    """The mistake in a line that lacks its `:`, from its first character at an offset; None if it
    has one.
    """
    end = line_end(text, at)
    line = text[at:end].partition(" #")[0].rstrip()
    end = at + len(line)
    comment = next((mark for mark in _COMMENTS if line.startswith(mark)), None)
    if comment is not None:
        return syntax(f"`{comment}` does not begin a comment; write `#`", at, at + len(comment))
    item = re.match(r"(?:- +)++", line)
    if item is not None:
        at += item.end()
        line = line[item.end() :]
    if re.match(r"-\w", line):
        return syntax(
            f"a list item needs a space after its `-`; write {quoted('- ' + line[1:], MAX_SHOWN)}",
            at,
            at + 1,
        )
    match = re.match(_MEANT, line, re.DOTALL)
    if match is None or (match[5] and match[6] and " " in match[6] and match[6][0] not in "[{\"'"):
        if re.search(r":(?:\s|$)", line) or not line:
            return None
        return syntax(
            f"expected `key: value`, found {quoted(line, MAX_SHOWN)}; a `:` is missing", at, end
        )
    key = match[2]
    written = quoted(f"{key}: {match[6] or ''}".rstrip(), MAX_SHOWN)
    if match[4] is not None:
        colon = at + match.start(4)
        return syntax(f"a space is missing after this `:`; write {written}", colon, colon + 1)
    if re.search(r":(?:\s|$)", line):
        return None
    if match[3] is not None:
        sign = at + match.start(3)
        return syntax(
            f"`{match[3]}` does not separate a key and its value; write {written}",
            sign,
            sign + len(match[3]),
        )
    return syntax(
        f"`:` is missing after the key {quoted(key, MAX_SHOWN)}; write {written}",
        at,
        at + match.end(2) + len(match[1]),
    )


def word_at(text: str, at: int) -> tuple[str, int | None]:
    """The key with its `:` that a line states from an offset, after any `- `, and its place; the
    line and None if it states none.
    """
    line = text[at : line_end(text, at)]
    match = re.match(r"(?:- +)*+((?:\"[^\"]*\"|'[^']*'|[^\s:#][^:#]*):)(?:\s|$)", line)
    return (match[1], at + match.start(1)) if match is not None else (line, None)
