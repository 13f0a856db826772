"""The comments of a YAML text. libyaml drops them; they are found between the scalars."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from typing import NamedTuple

from yaml.error import MarkedYAMLError
from yaml.tokens import (
    BlockEndToken,
    DirectiveToken,
    DocumentEndToken,
    DocumentStartToken,
    ScalarToken,
    StreamEndToken,
    StreamStartToken,
)

from .events import ERRORS, parser, readable
from .node import Node, Stop
from .source import Source
from .span import Span


class Comment(NamedTuple):
    """A comment, from its # to the end of its line."""

    span: Span
    text: str


_COMMENT = re.compile(r"#[^\r\n]*")
_HEADER = re.compile(r"[|>][-+0-9]*[ \t]*(?=#)")
_OUTSIDE = (
    StreamStartToken,
    StreamEndToken,
    DirectiveToken,
    DocumentStartToken,
    DocumentEndToken,
    BlockEndToken,
)
"""Tokens outside the content of a document."""


def comments(source: Source, roots: Iterable[Node]) -> list[Comment]:
    """Every comment of a text in order, also before and after its documents.

    `roots` are the documents that could be read. Comments cannot be told apart in one that could
    not: the search ends where it begins.
    """
    return list(_comments(source.text, max((root.end for root in roots), default=0)))


def comments_within(source: Source, start: int, end: int) -> list[Comment]:
    """The comments between two places of a text, which are outside scalars and have a whole
    document between them. Nothing else is read.
    """
    return list(_comments(source.text[start:end], end - start, start))


def _comments(text: str, known: int, offset: int = 0) -> Iterator[Comment]:
    for start, end in _between(text, known):
        for match in _COMMENT.finditer(text, start, end):
            yield Comment(Span(match.start() + offset, match.end() + offset), match[0])


def _between(text: str, known: int) -> Iterator[tuple[int, int]]:
    """The spans between scalars, and the line ends after the headers of block scalars, up to the
    first document after `known`.
    """
    position = 0
    try:
        for token in iter(parser(readable(text)[0]).get_token, None):
            kind = type(token)
            start = token.start_mark.index
            if kind is ScalarToken:
                yield position, start
                position = token.end_mark.index
                header = _HEADER.match(text, start) if token.style in ("|", ">") else None
                if header is not None:
                    end = _COMMENT.match(text, header.end())
                    yield header.end(), end.end() if end is not None else header.end()
            if start >= known and kind not in _OUTSIDE:
                yield position, start
                return
        yield position, len(text)
    except MarkedYAMLError as error:
        marks = [
            mark.index for mark in (error.context_mark, error.problem_mark) if mark is not None
        ]
        yield position, min(marks, default=position)
    except (*ERRORS, Stop):
        return
