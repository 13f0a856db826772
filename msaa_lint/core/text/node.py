"""The tree of a text: nodes that know their places, and the problems of the text."""

from __future__ import annotations

from typing import Any, NamedTuple

from .span import Label, Span


class Limits(NamedTuple):
    """Limits of an input: its nesting, its nodes (keys included, aliases expanded, all documents
    together), its bytes.
    """

    depth: int = 100
    nodes: int = 1_000_000
    bytes: int = 64 << 20


class Problem(NamedTuple):
    """A problem of a text: the code of a 9xx finding, a message and a place."""

    code: str
    message: str
    span: Span
    labels: tuple[Label, ...] = ()


class Parsed(NamedTuple):
    """The complete documents of a text, and its problems. Nothing is read after a syntax error."""

    documents: list[Node]
    problems: list[Problem]


class Stop(Exception):
    """Ends the reading of a text with a problem."""

    def __init__(self, code: str, message: str, start: int, end: int) -> None:
        self.problem = Problem(code, message, Span(start, max(end, start)))


_new = tuple.__new__

NO_KEYS: dict[str, Node] = {}
"""The keys of a node that is not a mapping; shared, so never changed."""


class Node:
    """A mapping, a sequence or a scalar, and its place as offsets into the text.

    `value` is a dict of nodes in order, a list of nodes, or a scalar's value in YAML 1.2; `keys`
    has the key nodes of a mapping; `text` is a scalar as written, without quotes; `plain` says that
    it has none. An alias is a node at its own place that shares the value of `anchor`. A place
    includes the anchor and the tag before a node, but not the blanks, comments and line ends after
    it.
    """

    __slots__ = ("anchor", "end", "keys", "kind", "plain", "start", "text", "value")

    value: Any

    def __init__(
        self,
        kind: str,
        start: int,
        end: int,
        value: Any,
        keys: dict[str, Node],
        text: str = "",
        plain: bool = False,
        anchor: Node | None = None,
    ) -> None:
        self.kind = kind
        self.start = start
        self.end = end
        self.value = value
        self.keys = keys
        self.text = text
        self.plain = plain
        self.anchor = anchor

    @property
    def span(self) -> Span:
        # Span() without the call of a function in between: a frame asks for some ten thousand.
        return _new(Span, (self.start, self.end))
