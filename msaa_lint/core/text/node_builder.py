"""Builds trees from something other than their own text: source code, Metal frames, shorthands.
Each node has the place of its origin.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from .node import NO_KEYS, Node
from .span import Span

Value = str | bool | int | float | None


def scalar(value: Value, at: Span) -> Node:
    """A scalar at a place."""
    text = (
        "null"
        if value is None
        else ("true" if value else "false")
        if isinstance(value, bool)
        else str(value)
    )
    return Node("scalar", at.start, at.end, value, NO_KEYS, text, not isinstance(value, str))


def sequence(items: Sequence[Node], at: Span) -> Node:
    """A list at a place."""
    return Node("sequence", at.start, at.end, list(items), NO_KEYS)


def mapping(items: Iterable[tuple[str, Span, Node]], at: Span) -> Node:
    """A mapping at a place, of keys with their places and values. The first of equal keys
    counts.
    """
    keys: dict[str, Node] = {}
    values: dict[str, Node] = {}
    for key, place, value in items:
        if key not in values:
            keys[key], values[key] = scalar(key, place), value
    return Node("mapping", at.start, at.end, values, keys)


def words(values: Iterable[str], at: Span) -> Node:
    """A list of words, all at the same place."""
    return sequence([scalar(value, at) for value in values], at)
