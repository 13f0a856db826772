"""What there is to know of a YAML text before its whitespace is changed: its content, and what is
in brackets.
"""

from __future__ import annotations

from yaml.tokens import (
    BlockEndToken,
    BlockMappingStartToken,
    BlockSequenceStartToken,
    FlowMappingEndToken,
    FlowMappingStartToken,
    FlowSequenceEndToken,
    FlowSequenceStartToken,
)

from .comments import comments_within
from .events import events, parser, readable
from .source import Source
from .span import Span

_FIELDS = (
    "anchor",
    "tag",
    "implicit",
    "value",
    "style",
    "flow_style",
    "explicit",
    "version",
    "tags",
)


def content_of(text: str) -> tuple[list[tuple[object, ...]], list[str]]:
    """What whitespace must not change: the events of a text without their places, and its comments.
    Raises Stop and ERRORS.
    """
    read = [
        (type(event), *(getattr(event, field, None) for field in _FIELDS))
        for event in iter(events(text), None)
    ]
    return read, [
        comment.text.rstrip() for comment in comments_within(Source("", text), 0, len(text))
    ]


def brackets_of(text: str) -> list[Span]:
    """The collections in brackets within block collections, without those inside of them. Raises
    Stop and ERRORS.
    """
    found: list[Span] = []
    depth = blocks = start = 0
    for token in iter(parser(readable(text)[0]).get_token, None):
        kind = type(token)
        if kind is FlowMappingStartToken or kind is FlowSequenceStartToken:
            start = start if depth else token.start_mark.index
            depth += 1
        elif kind is FlowMappingEndToken or kind is FlowSequenceEndToken:
            depth -= 1
            if not depth and blocks:
                found.append(Span(start, token.end_mark.index))
        elif kind is BlockMappingStartToken or kind is BlockSequenceStartToken:
            blocks += 1
        elif kind is BlockEndToken:
            blocks -= 1
    return found
