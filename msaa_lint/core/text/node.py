"""What a text is read into: nodes that know their places, and what is wrong with it."""

from __future__ import annotations

from typing import Any, NamedTuple

from .span import Label, Span


class Limits(NamedTuple):
    """How deep an input nests; how many nodes it has, keys too, once aliases are expanded, in all its documents; how many bytes."""

    depth: int = 100
    nodes: int = 1_000_000
    bytes: int = 64 << 20


class Problem(NamedTuple):
    """What is wrong with a text as such: the code of a 9xx finding, and where."""

    code: str
    message: str
    span: Span
    labels: tuple[Label, ...] = ()


class Parsed(NamedTuple):
    """The documents of a text, whole ones only, and what is wrong with it. After a syntax error nothing further is read."""

    documents: list[Node]
    problems: list[Problem]


class Stop(Exception):
    """Ends the reading of a text with a problem."""

    def __init__(self, code: str, message: str, start: int, end: int) -> None:
        self.problem = Problem(code, message, Span(start, max(end, start)))


NO_KEYS: dict[str, Node] = {}
"""The keys of what is no mapping."""


class Node:
    """A mapping, a sequence or a scalar, and its place as offsets into the text.

    `value` is a dict of nodes in order, a list of nodes, or the scalar by YAML 1.2; `keys` has the key nodes of a mapping; `text` a
    scalar as it was written, unquoted; `plain` says that it had no quotes. An alias is a node at its own place that shares the value of
    `anchor`. The place is without the blanks, comments and line ends after it, and with the anchor and the tag before it: what replaces
    `&a 4` replaces the anchor.
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
        return Span(self.start, self.end)
