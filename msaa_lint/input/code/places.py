"""Places in a preprocessed text, and where they come from."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence
from typing import NamedTuple

from msaa_lint.core.text.node import Node
from msaa_lint.core.text.span import Span

MAX_PIECES = 500
"""The maximum number of pieces that a range is compared over; a longer one is the use of the
macro.
"""


class Piece(NamedTuple):
    """A part of a preprocessed text, up to the next one: the offset where it starts, and the range
    in the file that it comes from.

    `use` and `use_end` are the range of the macro use that it is part of the expansion of; -1 for
    text as written. In an `exact` piece, each character has a place of its own, from `at` on.
    """

    start: int
    at: int
    end: int
    use: int = -1
    use_end: int = -1
    exact: bool = True

    def moved(self, start: int, at: int) -> Piece:
        """Returns the piece in a text and a file that start at some offsets of others."""
        use = (self.use + at, self.use_end + at) if self.use >= 0 else (-1, -1)
        return Piece(self.start + start, self.at + at, self.end + at, *use, self.exact)


class Places:
    """The places of a preprocessed text in its file. Without pieces, they are the same."""

    def __init__(self, pieces: Sequence[Piece] = ()) -> None:
        self.pieces = pieces
        self._starts = [piece.start for piece in pieces]

    def original(self, at: Span) -> Span:
        """Returns the place in the file of a range of the preprocessed text: what is written there,
        or else the use of the macro.
        """
        if not self.pieces:
            return at
        first = max(bisect_right(self._starts, at.start) - 1, 0)
        last = max(bisect_right(self._starts, max(at.end - 1, at.start)) - 1, first)
        left, right = self.pieces[first], self.pieces[last]
        start, end = at.start - left.start + left.at, at.end - right.start + right.at
        if left.use < 0 and right.use < 0:
            return Span(start, end)
        if left.use == right.use:
            inside = [
                left.use <= piece.at < left.use_end
                for piece in self.pieces[first : min(last + 1, first + MAX_PIECES)]
            ]
            alike = last - first < MAX_PIECES and (all(inside) or not any(inside))
            exact = left.exact and right.exact and alike and start < end
            return Span(start, end) if exact else Span(left.use, left.use_end)
        return Span(
            start if left.use < 0 else left.use,
            max(end if right.use < 0 else right.use_end, start + 1),
        )

    def moved(self, node: Node) -> Node:
        """Returns a tree with its places in the file."""
        if not self.pieces:
            return node
        at = self.original(node.span)
        value = node.value
        if node.kind == "sequence":
            value = [self.moved(item) for item in value]
        elif node.kind == "mapping":
            value = {key: self.moved(item) for key, item in value.items()}
        keys = (
            {key: self.moved(item) for key, item in node.keys.items()} if node.keys else node.keys
        )
        return Node(node.kind, at.start, at.end, value, keys, node.text, node.plain, node.anchor)
