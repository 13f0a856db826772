"""The comments of a YAML text: libyaml drops them, so they are what is left between the scalars."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

from ..finding import Span
from .text import Source
from .tree import Node


class Comment(NamedTuple):
    """A comment from its # to the end of its line."""

    span: Span
    text: str


def comments(source: Source, roots: Iterable[Node]) -> list[Comment]:
    """Every comment of the text, in order: a # at the start of a line or after white space that no scalar holds."""
    text = source.text
    scalars = _scalar_spans(roots)
    found: list[Comment] = []
    position, nth = 0, 0
    while True:
        at = text.find("#", position)
        if at < 0:
            return found
        while nth < len(scalars) and scalars[nth].end <= at:
            nth += 1
        if nth < len(scalars) and scalars[nth].start <= at:
            position = max(scalars[nth].end, at + 1)
            continue
        if at > 0 and text[at - 1] not in " \t\r\n":
            position = at + 1
            continue
        end = at
        while end < len(text) and text[end] not in "\r\n":
            end += 1
        found.append(Comment(Span(at, end), text[at:end]))
        position = end


def _scalar_spans(roots: Iterable[Node]) -> list[Span]:
    """The places of all scalars, keys too, in order. Aliases hold no text of their own."""
    spans = []
    seen: set[int] = set()
    stack = list(roots)
    while stack:
        node = stack.pop()
        if id(node) in seen or node.anchor is not None:
            continue
        seen.add(id(node))
        if node.kind == "scalar":
            spans.append(node.span)
        elif node.kind == "sequence":
            stack.extend(node.value)
        else:
            stack.extend(node.keys.values())
            stack.extend(node.value.values())
    return sorted(spans)
