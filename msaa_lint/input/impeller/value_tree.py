"""Builds trees from plain data. Each part can have its own place in the source."""

from __future__ import annotations

from typing import Any, NamedTuple

from msaa_lint.core.text.node import Node
from msaa_lint.core.text.node_builder import mapping, scalar, sequence
from msaa_lint.core.text.span import Span


class Value(NamedTuple):
    """A value, and the place that determines it."""

    value: Any
    at: Span


def tree(value: Any, at: Span) -> Node:
    """The node for a dict, list or scalar at a place; a `Value` has its own place, and a node is kept.

    Members whose value is None are unknown and omitted.
    """
    if isinstance(value, Node):
        return value
    if isinstance(value, Value):
        return tree(value.value, value.at)
    if isinstance(value, dict):
        members = ((key, _place(each, at), tree(each, at)) for key, each in value.items() if not _unknown(each))
        return mapping(members, at)
    if isinstance(value, (list, tuple)):
        return sequence([tree(each, at) for each in value], at)
    return scalar(value, at)


def _unknown(value: Any) -> bool:
    return value is None or (isinstance(value, Value) and value.value is None)


def _place(value: Any, at: Span) -> Span:
    return value.at if isinstance(value, Value) else at
