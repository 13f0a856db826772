"""Extracts the code blocks of pages, those of Markdown by CommonMark 0.31, 4.5. Everything else is
blanked, so that offsets are preserved.

The blocks of one language form one program, since pages present programs piece by piece.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import TYPE_CHECKING

from .pages import BLOCKS, NAMES, Block, lines_of
from .parsing import Code, ascii_only

if TYPE_CHECKING:
    from markdown_it import MarkdownIt

_WORD = re.compile(r"\s*\{?\s*\.?([^\s{},:]+)")
_LEFT_OUT = re.compile(r"[ \t]*(?://[ \t]*)?(?:\.\.\.|…)[ \t]*")
_VISIBLE = re.compile(r"[^\r\n]")


def codes(text: str, page: str = "markdown") -> tuple[Code, ...]:
    """Returns the code of a page of a format, one for each language in order of appearance.
    Ellipses for omitted code are blanked.
    """
    lines_by_language: dict[str, list[tuple[int, int]]] = {}
    for block in BLOCKS.get(page, blocks)(text):
        lines_by_language.setdefault(block.language, []).extend(block.lines)
    return tuple(
        Code(_only(text, lines), language, True) for language, lines in lines_by_language.items()
    )


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
    """Yields the fenced blocks of a Markdown page in supported languages. An unclosed one extends
    to the end of its container.
    """
    ends = [end for _, end in lines_of(text)]
    for token in _parser().parse(text):
        word = _WORD.match(token.info)
        language = (
            NAMES.get(word[1].lower())
            if token.type == "fence" and token.map and word is not None
            else None
        )
        if language is not None and token.map is not None:
            # The parser removes quote marks and indentation, so what is left of a line is its end.
            numbered = enumerate(
                token.content.removesuffix("\n").split("\n") if token.content else (),
                token.map[0] + 1,
            )
            yield Block(
                language,
                tuple((ends[number] - len(line), ends[number]) for number, line in numbered),
            )


def _parser() -> MarkdownIt:
    """Returns a parser of the structure of blocks, which leaves their text alone."""
    from markdown_it import MarkdownIt

    parser = MarkdownIt("commonmark")
    parser.core.ruler.enableOnly(["normalize", "block"])
    return parser
