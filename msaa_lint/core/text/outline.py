"""What is open at a place of a text that cannot be parsed: its brackets, its blocks, and the tokens
before it.
"""

from collections import deque
from typing import Any, NamedTuple

from yaml.error import YAMLError
from yaml.tokens import (
    BlockEndToken,
    BlockMappingStartToken,
    BlockSequenceStartToken,
    FlowMappingEndToken,
    FlowMappingStartToken,
    FlowSequenceEndToken,
    FlowSequenceStartToken,
    ScalarToken,
)

from .excerpts import indent_of

MAX_TOKENS = 4


class Bracket(NamedTuple):
    """An open `[` or `{`: its offset, its line, counted from 0, and the number of spaces that this
    line begins with.
    """

    start: int
    line: int
    indent: int


class Block(NamedTuple):
    """An open block collection: its place, its column, counted from 0, and whether it is a list."""

    start: int
    column: int
    is_list: bool


class Outline(NamedTuple):
    """What surrounds an offset. `closed` has the blocks that end just before it, innermost first;
    `misaligned` is the first bracket whose closing one begins a line that is indented less than the
    line of the bracket.
    """

    brackets: list[Bracket]
    blocks: list[Block]
    closed: list[Block]
    tokens: list[Any]
    misaligned: Bracket | None


def outline(parser: Any, text: str, at: int) -> Outline:
    """The outline at an offset of a text, from a parser of that text that has read nothing yet."""
    brackets: list[Bracket] = []
    blocks: list[Block] = []
    closed: list[Block] = []
    tokens: deque[Any] = deque(maxlen=MAX_TOKENS)
    misaligned: Bracket | None = None
    line, indent = -1, 0
    while True:
        try:
            token = parser.get_token()
        except (YAMLError, ValueError):
            break
        if token is None:
            break
        kind, mark = type(token), token.start_mark
        if kind is BlockEndToken:
            # It stands where the next token does.
            if mark.index <= at and blocks:
                closed.append(blocks.pop())
            continue
        if mark.index >= at:
            break
        closed = []
        if kind is FlowMappingStartToken or kind is FlowSequenceStartToken:
            if mark.line != line:
                line, indent = mark.line, indent_of(text, mark.index)
            brackets.append(Bracket(mark.index, line, indent))
        elif kind is FlowMappingEndToken or kind is FlowSequenceEndToken:
            if brackets:
                bracket = brackets.pop()
                if (
                    misaligned is None
                    and mark.line > bracket.line
                    and mark.column < bracket.indent
                    and tokens[-1].end_mark.line < mark.line
                ):
                    misaligned = bracket
        elif kind is BlockMappingStartToken or kind is BlockSequenceStartToken:
            blocks.append(Block(mark.index, mark.column, kind is BlockSequenceStartToken))
        if kind is ScalarToken or token.end_mark.index > mark.index:
            tokens.append(token)
    return Outline(brackets, blocks, closed, list(tokens), misaligned)
