"""What an editor may fold, and what it selects around a cursor: the structures of a text."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

from msaa_lint.core.text.source import Source
from msaa_lint.core.text.span import Span

from .places import content, descriptions, place_at, walk
from .symbols import Symbol, symbols

if TYPE_CHECKING:
    from .view import View

_HEADER = re.compile(r"^[ \t]*\[", re.MULTILINE)
_COMMENTS = re.compile(r"(?:^[ \t]*#[^\n]*(?:\n|\Z)){2,}", re.MULTILINE)
_FENCE = re.compile(r"^---[ \t]*\r?$", re.MULTILINE)


class Fold(NamedTuple):
    """The first and the last line of what can be folded, from 0."""

    first: int
    last: int
    is_comment: bool = False


def folds(view: View) -> list[Fold]:
    """The folds of a text, each line with the longest that begins on it: structures, passes with
    their commands, tables, and comments.
    """
    source = Source("", view.text)
    longest: dict[int, Fold] = {}
    for span, is_comment in _spans(view):
        end = span.start + len(view.text[span.start : span.end].rstrip())
        first, last = source.position(span.start).line - 1, source.position(end).line - 1
        if first < last and (first not in longest or longest[first].last < last):
            longest[first] = Fold(first, last, is_comment)
    return [longest[first] for first in sorted(longest)]


def _spans(view: View) -> Iterator[tuple[Span, bool]]:
    if view.kind == "description":
        for root in descriptions(view.roots):
            for place in walk(root):
                if place.node.kind != "scalar" and place.parent is not None:
                    yield Span((place.key or place.node).start, place.node.end), False
        yield from ((span, False) for span in _enclosed(symbols(view)))
    elif view.kind == "configuration":
        headers = [match.start() for match in _HEADER.finditer(view.text)]
        yield from ((Span(*both), False) for both in pairwise([*headers, len(view.text)]))
    elif view.kind == "rule":
        fences = [match.end() for match in _FENCE.finditer(view.text)][:2]
        yield from ((Span(0, end), False) for end in fences[1:])
    if view.kind != "code":
        yield from ((Span(*match.span()), True) for match in _COMMENTS.finditer(view.text))


def _enclosed(outline: Iterable[Symbol]) -> Iterator[Span]:
    """The places of symbols with others in them: passes end with the command that ends them."""
    for symbol in outline:
        if symbol.children:
            yield symbol.span
            yield from _enclosed(symbol.children)


def selection(view: View, offset: int) -> list[Span]:
    """What contains an offset of a description, from its value outward; empty elsewhere."""
    found = place_at(view.roots, offset)
    if found is None:
        return []
    spans: list[Span] = []
    for place in found[0].ancestors:
        key = [content(view.text, place.key)] if place.key is not None else []
        inside = [] if found[1] and place is found[0] else [content(view.text, place.node)]
        whole = (
            [Span(place.key.start, max(place.node.end, place.key.end))]
            if place.key is not None
            else []
        )
        spans += [*(key if found[1] and place is found[0] else inside), *whole]
    return [span for number, span in enumerate(spans) if number == 0 or span != spans[number - 1]]
