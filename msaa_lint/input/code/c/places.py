"""Places in a preprocessed text, and where they come from."""

from __future__ import annotations

from bisect import bisect_right
from typing import NamedTuple

from msaa_lint.core.text.node import Node
from msaa_lint.core.text.span import Span


class Piece(NamedTuple):
    """A part of a preprocessed text, up to the next one: where it starts there, and its place in the file.

    `use` is the use of the macro that it is part of the expansion of, None for text as written. Each character of an `exact` piece has a
    place of its own, from `place.start` on.
    """

    start: int
    place: Span
    use: Span | None = None
    exact: bool = True


class Places:
    """The places of a preprocessed text in its file. Without pieces, they are the same."""

    def __init__(self, pieces: tuple[Piece, ...] = ()) -> None:
        self.pieces = pieces
        self._starts = [piece.start for piece in pieces]

    def original(self, at: Span) -> Span:
        """Returns the place in the file of a range of the preprocessed text: what is written there, or else the use of the macro."""
        if not self.pieces:
            return at
        first = bisect_right(self._starts, at.start) - 1
        last = max(bisect_right(self._starts, max(at.end - 1, at.start)) - 1, first)
        left, right = self.pieces[first], self.pieces[last]
        start, end = at.start - left.start + left.place.start, at.end - right.start + right.place.start
        if left.use is None and right.use is None:
            return Span(start, end)
        if left.use is not None and left.use == right.use:
            inside = [left.use.start <= piece.place.start < left.use.end for piece in self.pieces[first : min(last + 1, first + 500)]]
            alike = last - first < 500 and (all(inside) or not any(inside))
            return Span(start, end) if left.exact and right.exact and alike and start < end else left.use
        return Span(start if left.use is None else left.use.start, max(end if right.use is None else right.use.end, start + 1))

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
        keys = {key: self.moved(item) for key, item in node.keys.items()} if node.keys else node.keys
        return Node(node.kind, at.start, at.end, value, keys, node.text, node.plain, node.anchor)
