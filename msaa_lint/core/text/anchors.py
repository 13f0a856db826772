"""The anchors and aliases of a YAML text."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from yaml.tokens import AliasToken, AnchorToken, DocumentStartToken

from .events import ERRORS, parser, readable
from .node import Stop
from .span import Span


class Anchor(NamedTuple):
    """An anchor's name without its `&`, and the aliases of it without their `*`."""

    text: str
    span: Span
    aliases: list[Span]

    @property
    def spans(self) -> list[Span]:
        return [self.span, *self.aliases]


def anchors_of(text: str) -> list[Anchor]:
    """The anchors of a text, in order, up to the first error of its syntax."""
    found: list[Anchor] = []
    if "&" not in text:
        return found
    current: dict[str, Anchor] = {}
    for token in _tokens(text):
        if isinstance(token, DocumentStartToken):
            current = {}
        elif isinstance(token, (AnchorToken, AliasToken)):
            span = Span(token.start_mark.index + 1, token.end_mark.index)
            if isinstance(token, AnchorToken):
                current[token.value] = Anchor(token.value, span, [])
                found.append(current[token.value])
            elif token.value in current:
                current[token.value].aliases.append(span)
    return found


def _tokens(text: str) -> Iterator[object]:
    try:
        yield from iter(parser(readable(text)[0]).get_token, None)
    except (*ERRORS, Stop):
        return
