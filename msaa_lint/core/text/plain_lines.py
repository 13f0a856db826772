"""Lines that were meant to be `key: value` and are not."""

from __future__ import annotations

import re

from msaa_lint.core.quote import quoted

from .node import Problem
from .outline import line_end
from .span import Span

MAX_SHOWN = 40

_MEANT = re.compile(r"([\"']?)([A-Za-z_]\w*)\1(?: *(=|:=|：) *| *(:)(?=[^\s:/\\])|( +)|$)([^\s#=:].*)?", re.DOTALL)
_COMMENTS = ("//", "/*", "*", "--", ";", "%")


def entry(text: str) -> str | None:
    """`samples: 4` for `samples:4`, `samples = 4` and `samples： 4`: the entry that was meant; None for another text."""
    match = _MEANT.match(text)
    if match is None or match[5] or not match[6]:
        return None
    return f"{match[2]}: {match[6].split()[0]}"


def keyless(text: str, at: int) -> Problem | None:
    """The mistake in a line that lacks its `:`, from its first character at an offset; None if it has one."""
    end = line_end(text, at)
    line = text[at:end].partition(" #")[0].rstrip()
    end = at + len(line)
    comment = next((mark for mark in _COMMENTS if line.startswith(mark)), None)
    if comment is not None:
        return Problem("MSAA901", f"`{comment}` does not begin a comment; write `#`", Span(at, at + len(comment)))
    item = re.match(r"(?:- +)+", line)
    if item is not None:
        at += item.end()
        line = line[item.end() :]
    if re.match(r"-\w", line):
        return Problem("MSAA901", f"a list item needs a space after its `-`; write `- {_shown(line[1:])}`", Span(at, at + 1))
    match = _MEANT.match(line)
    if match is None or (match[5] and " " in match[6] and match[6][0] not in "[{\"'"):
        if re.search(r":(?:\s|$)", line) or not line:
            return None
        return Problem("MSAA901", f"expected `key: value`, found {quoted(line, MAX_SHOWN)}; a `:` is missing", Span(at, end))
    key, value = match[2], match[6] or ""
    if match[4] is not None:
        colon = at + match.start(4)
        return Problem("MSAA901", f"a space is missing after this `:`; write `{_shown(f'{key}: {value}')}`", Span(colon, colon + 1))
    if re.search(r":(?:\s|$)", line):
        return None
    if match[3] is not None:
        sign = at + match.start(3)
        return Problem(
            "MSAA901",
            f"`{match[3]}` does not separate a key and its value; write `{_shown(f'{key}: {value}')}`",
            Span(sign, sign + len(match[3])),
        )
    return Problem(
        "MSAA901",
        f"`:` is missing after the key `{_shown(key)}`; write `{_shown(f'{key}: {value}'.rstrip())}`",
        Span(at, at + match.end(2) + len(match[1])),
    )


def word_at(text: str, at: int) -> tuple[str, int | None]:
    """The key with its `:` that a line states from an offset, after any `- `, and its place; the line and None if it states none."""
    line = text[at : line_end(text, at)]
    match = re.match(r"(?:- +)*((?:\"[^\"]*\"|'[^']*'|[^\s:#][^:#]*):)(?:\s|$)", line)
    return (match[1], at + match.start(1)) if match is not None else (line, None)


def _shown(text: str) -> str:
    return text if len(text) <= MAX_SHOWN else f"{text[: MAX_SHOWN - 1]}…"
