"""The code in the fences of a Markdown page (CommonMark 0.31, 4.5): everything else is blanked, so that offsets stay.

All blocks of one language are one code: a page shows a program piece by piece.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import NamedTuple

from .parsing import Code, ascii_only

NAMES = {
    "c": "c", "h": "c",
    "cpp": "cpp", "c++": "cpp", "cc": "cpp", "cxx": "cpp", "hpp": "cpp", "h++": "cpp", "hxx": "cpp",
    "swift": "swift",
    "glsl": "glsl", "vert": "glsl", "frag": "glsl", "comp": "glsl",
}  # fmt: skip
"""The language by the first word of an info string, in lower case."""

MAX_NESTED = 32
"""Lists and quotes within each other that are followed."""

_LINE = re.compile(r"[^\r\n]*(?:\r\n|\r|\n|\Z)")
_QUOTE = re.compile(r" {0,3}>[ \t]?")
_ITEM = re.compile(r"(?:[-*+]|\d{1,9}[.)])(?=[ \t]|$)")
_FENCE = re.compile(r"(`{3,})([^`\r\n]*)|(~{3,})([^\r\n]*)")
_WORD = re.compile(r"\s*\{?\s*\.?([^\s{},:]+)")
_LEFT_OUT = re.compile(r"[ \t]*(?://[ \t]*)?(?:\.\.\.|…)[ \t]*")
_VISIBLE = re.compile(r"[^\r\n]")


class Block(NamedTuple):
    """A fenced block: its language, and the lines of its code as spans without quote marks and indentation of the list around it."""

    language: str
    lines: tuple[tuple[int, int], ...]


def codes(text: str) -> tuple[Code, ...]:
    """The code of a page, one for each language, in the order in which they come; an ellipsis that stands for what is left out is blank."""
    lines_by_language: dict[str, list[tuple[int, int]]] = {}
    for block in blocks(text):
        lines_by_language.setdefault(block.language, []).extend(block.lines)
    return tuple(Code(_only(text, lines), language, True) for language, lines in lines_by_language.items())


def _only(text: str, lines: list[tuple[int, int]]) -> str:
    parts = []
    position = 0
    for start, end in lines:
        parts.append(_VISIBLE.sub(" ", text[position:start]))
        line = text[start:end]
        parts.append(" " * len(line) if _LEFT_OUT.fullmatch(line) else ascii_only(line))
        position = end
    parts.append(_VISIBLE.sub(" ", text[position:]))
    return "".join(parts)


def blocks(text: str) -> Iterator[Block]:
    """The fenced blocks of a page that are in a language of ours. One without an end reaches to that of the quote or list around it, or of
    the page."""
    around: list[int] = []
    fence = ""
    language: str | None = None
    lines: list[tuple[int, int]] = []
    for match in _LINE.finditer(text):
        start, end = match.start(), match.start() + len(match[0].rstrip("\r\n"))
        if fence:
            at = _inside(text, start, end, around)
            closing = at is not None and _closes(text[at:end], fence)
            if at is not None and not closing:
                if language is not None:
                    lines.append((at, end))
                continue
            if language is not None:
                yield Block(language, tuple(lines))
            fence, language, lines = "", None, []
            if closing:
                continue
        at = _entered(text, start, end, around)
        opening = _FENCE.fullmatch(text, at, end) if at is not None else None
        if opening is not None:
            fence = opening[1] or opening[3]
            word = _WORD.match(opening[2] if opening[1] else opening[4])
            language = NAMES.get(word[1].lower()) if word is not None else None
    if language is not None and fence:
        yield Block(language, tuple(lines))


QUOTE = -1
"""A block quote among the containers; a list item is the columns that its content is indented by."""


def _inside(text: str, start: int, end: int, around: list[int]) -> int | None:
    """Where a line of a block begins within the containers of the block; None where one of them has ended. The containers that have are
    taken away."""
    at = start
    for number, container in enumerate(around):
        if container == QUOTE:
            quote = _QUOTE.match(text, at, end)
            if quote is None:
                del around[number:]
                return None
            at = quote.end()
        elif text[at:end].strip():
            indent = _blanks(text, at, end)
            if indent < container:
                del around[number:]
                return None
            at += container
        else:
            at = min(at + container, end)
    return at


def _entered(text: str, start: int, end: int, around: list[int]) -> int | None:
    """Where the content of a line begins, and the containers that it then stands in; None where it is code by its indentation, or empty."""
    at = start
    number = 0
    while number < len(around):
        container = around[number]
        if container == QUOTE:
            quote = _QUOTE.match(text, at, end)
            if quote is None:
                break
            at = quote.end()
        elif not text[at:end].strip():
            return None
        elif _blanks(text, at, end) >= container:
            at += container
        else:
            break
        number += 1
    del around[number:]
    while len(around) < MAX_NESTED:
        indent = _blanks(text, at, end)
        if indent > 3:
            return None
        quote = _QUOTE.match(text, at, end)
        if quote is not None:
            around.append(QUOTE)
            at = quote.end()
            continue
        item = _ITEM.match(text, at + indent, end)
        if item is None:
            return at + indent
        after = _blanks(text, item.end(), end)
        # An item whose content begins with indented code is indented by one blank.
        width = item.end() - at + (after if 1 <= after <= 4 else 1)
        around.append(width)
        at = min(at + width, end)
    return None


def _blanks(text: str, at: int, end: int) -> int:
    """How many blanks stand at a place; a tab counts as one, as offsets do."""
    n = at
    while n < end and text[n] in " \t":
        n += 1
    return n - at


def _closes(line: str, fence: str) -> bool:
    """Whether a line is the closing fence of a block."""
    bare = line.strip(" \t")
    return len(bare) >= len(fence) and not bare.strip(fence[0]) and len(line) - len(line.lstrip(" \t")) <= 3
