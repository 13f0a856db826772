"""The tree of a text while it is typed: lines that cannot be parsed are left out, and a mark stands
for the word at the cursor.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from itertools import islice
from typing import NamedTuple

from msaa_lint.core.text.events import parser, readable
from msaa_lint.core.text.node import Limits, Node
from msaa_lint.core.text.outline import outline
from msaa_lint.core.text.source import Source
from msaa_lint.core.text.tree import beginning, documents, parse

MARK = "msaaLintCursor"
"""Stands for the word that is being typed."""

MAX_REPAIRS = 4
"""Lines that are left out of one text; each costs reading it once more."""

_WORD = re.compile(r"[\w./-]*")
_WORD_BEFORE = re.compile(r"[\w./-]*\Z")
_TOKEN = re.compile(r"""[\[\]{}]|"(?:[^"\\]|\\.)*"?|'[^']*'?|(?:^|(?<=\s))#.*""")
_CLOSERS = {"[": "]", "{": "}"}
SYNTAX = ("MSAA901", "MSAA906")


class Word(NamedTuple):
    """The word at a cursor, quotes included: its place, the quote it begins with, and its part
    before the cursor.
    """

    start: int
    end: int
    quote: str
    prefix: str


class Marked(NamedTuple):
    """A text with MARK in place of the word at the cursor, its documents, and the offset of the
    mark.
    """

    text: str
    roots: list[Node]
    at: int


def repaired(text: str, limits: Limits) -> list[Node]:
    """The documents of a text; of one with errors of its syntax, without the lines that have them,
    as far as that helps.
    """
    text, roots = _without_errors(text, limits)
    return roots if roots is not None else beginning(text, limits)


def _without_errors(text: str, limits: Limits) -> tuple[str, list[Node] | None]:
    """The text with lines that have errors left blank, and its documents; None for them if it still
    cannot be read.
    """
    for _ in range(MAX_REPAIRS):
        parsed = parse(Source("", text), limits)
        if not parsed.problems or parsed.problems[-1].code not in SYNTAX:
            return text, parsed.documents
        start, end = _line(text, parsed.problems[-1].span.start)
        if not text[start:end].strip():
            break
        text = _blanked(text, start, end)
    return text, None


def word_at(text: str, offset: int) -> Word:
    """The word at a cursor."""
    before = _WORD_BEFORE.search(text, _line(text, offset)[0], offset)
    after = _WORD.match(text, offset)
    start = before.start() if before is not None else offset
    end = after.end() if after is not None else offset
    prefix = text[start:offset]
    quote = text[start - 1 : start] if start and text[start - 1] in "\"'" else ""
    if quote and text.count(quote, _line(text, start)[0], start) % 2:
        return Word(start - 1, end + text.startswith(quote, end), quote, prefix)
    return Word(start, end, "", prefix)


def marked(text: str, word: Word, limits: Limits) -> Marked | None:
    """The text with a mark for a word, completed in the way that needs the fewest changes; None if
    no way makes it readable.

    Lines are only left out if they have an error without the mark as well.
    """
    found = _marked(islice(_completions(text, word), 2), limits)
    if found is None:
        start, end = _line(text, word.start)
        others, _ = _without_errors(_blanked(text, start, end), limits)
        text = others[:start] + text[start:end] + others[end:]
        found = _marked(_completions(text, word), limits)
    if found is None:
        head = text[: word.start]
        found = Marked(head + MARK, beginning(head + MARK, limits), len(head))
    return found if found.roots else None


def _marked(completions: Iterable[tuple[str, str]], limits: Limits) -> Marked | None:
    for head, tail in completions:
        candidate = f"{head}{MARK}{tail}"
        roots = documents(candidate, limits)
        if roots is not None:
            return Marked(candidate, roots, len(head))
    return None


def _completions(text: str, word: Word) -> Iterator[tuple[str, str]]:
    """What may stand before and after the mark, the most likely first."""
    head, tail = text[: word.start] + lead(text, word), text[word.end :]
    line_start, line_end = _line(text, word.start)
    rest = text[word.end : line_end].lstrip()
    begins_line = not text[line_start : word.start].strip(" -\t?")
    colon = begins_line and not rest.startswith(":")
    if _closers(text[line_start:line_end]):
        yield head, _closers(text[line_start : word.start]) + text[line_end:]
    yield head, f":{tail}" if colon and not rest.startswith((",", "}", "]")) else tail
    yield head, f"{':' if colon else ''},{tail}"
    yield head, tail if colon else f":{tail}"
    yield head, text[line_end:]
    brackets = outline(parser(readable(head + MARK)[0]), head + MARK, word.start).brackets
    if brackets:
        everything = "".join(
            "}" if text[bracket.start] == "{" else "]" for bracket in reversed(brackets)
        )
        yield f"{head}, ", f":{tail}"
        yield head, everything
        yield f"{head}, ", everything


def _closers(line: str) -> str:
    """What closes the brackets that a line opens and does not close."""
    opened: list[str] = []
    for token in _TOKEN.findall(line):
        if token in _CLOSERS:
            opened.append(_CLOSERS[token])
        elif opened and token == opened[-1]:
            opened.pop()
    return "".join(reversed(opened))


def lead(text: str, word: Word) -> str:
    """The space that a word lacks after the `:` of a plain key."""
    return (
        " "
        if text[word.start - 1 : word.start] == ":"
        and text[word.start - 2 : word.start - 1] not in ("'", '"')
        else ""
    )


def _line(text: str, at: int) -> tuple[int, int]:
    """Where the line of an offset begins and ends."""
    end = text.find("\n", at)
    return text.rfind("\n", 0, at) + 1, len(text) if end < 0 else end


def _blanked(text: str, start: int, end: int) -> str:
    return text[:start] + " " * (end - start) + text[end:]
