"""Extracts fenced code blocks from Markdown (CommonMark 0.31, 4.5). Everything else is blanked, so that offsets are preserved.

The blocks of one language form one program, since pages present programs piece by piece.
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
"""Languages by the first word of an info string, in lowercase."""

MAX_NESTED = 32
"""The maximum nesting of lists and block quotes."""

_LINE = re.compile(r"[^\r\n]*(?:\r\n|\r|\n|\Z)")
_QUOTE = re.compile(r" {0,3}>[ \t]?")
_ITEM = re.compile(r"(?:[-*+]|\d{1,9}[.)])(?=[ \t]|$)")
_FENCE = re.compile(r"(`{3,})([^`\r\n]*)|(~{3,})([^\r\n]*)")
_WORD = re.compile(r"\s*\{?\s*\.?([^\s{},:]+)")
_LEFT_OUT = re.compile(r"[ \t]*(?://[ \t]*)?(?:\.\.\.|…)[ \t]*")
_VISIBLE = re.compile(r"[^\r\n]")


class Block(NamedTuple):
    """A fenced block: its language, and the ranges of its lines without quote marks and list indentation."""

    language: str
    lines: tuple[tuple[int, int], ...]


def codes(text: str) -> tuple[Code, ...]:
    """Returns the code of a page, one for each language in order of appearance. Ellipses for omitted code are blanked."""
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
    """Yields the fenced blocks of a page in supported languages. An unclosed block extends to the end of its container or of the page."""
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
"""A block quote among the containers. List items are represented by the indentation of their content."""


def _inside(text: str, start: int, end: int, around: list[int]) -> int | None:
    """Returns where a line starts inside the containers of a block, or None if one of them has ended. Removes the ended containers."""
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
    """Returns where the content of a line starts and updates its containers; None for indented code and blank lines."""
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
        # If an item starts with indented code, its content is indented by one space.
        width = item.end() - at + (after if 1 <= after <= 4 else 1)
        around.append(width)
        at = min(at + width, end)
    return None


def _blanks(text: str, at: int, end: int) -> int:
    """Returns the number of blanks at an offset. A tab counts as one, as in offsets."""
    n = at
    while n < end and text[n] in " \t":
        n += 1
    return n - at


def _closes(line: str, fence: str) -> bool:
    """Returns whether a line is the closing fence of a block."""
    bare = line.strip(" \t")
    return len(bare) >= len(fence) and not bare.strip(fence[0]) and len(line) - len(line.lstrip(" \t")) <= 3
