"""A structure of a description as it was read: typed members, and where each is stated."""

from __future__ import annotations

from collections.abc import Container
from itertools import pairwise
from typing import Any, ClassVar

from msaa_lint.core.text.span import Span
from msaa_lint.core.text.tree import Node

from .scalars import enumerant

Shape = tuple[Any, ...]
"""What a member may hold: a kind and its parameters, as `generate` writes them and `bind` reads them."""


class Record:
    """One structure. The members of the subclasses are Vulkan's; what is not stated is None, or empty where absent means none.

    `key` is the name or index it stands under, `path` its structural path (`renderPasses.forward.attachments.color`), `head` where a reader
    sees it begin (its key, or its first member), `spelled` the key and the value of each member that the input states.
    """

    __slots__ = ("head", "key", "node", "path", "spelled")

    SHAPE: ClassVar[dict[str, Shape]] = {}

    ABSENT: ClassVar[dict[str, object]] = {}
    """What the members are that mean none, not unknown, where they are absent."""

    def __init__(self, node: Node, path: str, key: str, head: Span) -> None:
        self.node = node
        self.path = path
        self.key = key
        self.head = head
        self.spelled: dict[str, tuple[Node, Node]] = {}

    def states(self, name: str) -> bool:
        """Whether the input states the member."""
        return name in self.spelled

    def place(self, *names: str) -> Span:
        """Where the first of the members that is stated has its value (a structure, or a list of several lines: its key).

        The record's head where none is stated.
        """
        for name in names:
            if name in self.spelled:
                key, value = self.spelled[name]
                return key.span if _is_wide(value) else value.span
        return self.head

    def flag_place(self, name: str, flags: Container[str]) -> Span:
        """Where the first of some flags stands in a list that states the member; the member's place where it is written otherwise."""
        if name in self.spelled and self.spelled[name][1].kind == "sequence":
            items: list[Node] = self.spelled[name][1].value
            for item in items:
                if item.kind == "scalar" and enumerant(self.SHAPE[name][1], item.text) in flags:
                    return item.span
        return self.place(name)


def _is_wide(value: Node) -> bool:
    """Whether a value goes, or may go, over several lines: a structure, a list of structures, a list with more than `, ` between items."""
    if value.kind != "sequence":
        return value.kind == "mapping"
    items: list[Node] = value.value
    if any(item.kind == "mapping" for item in items):
        return True
    if not items or value.anchor is not None:
        return False
    # A list with an item a line and no brackets ends with its last item.
    gaps = [items[0].start - value.start, *(after.start - item.end for item, after in pairwise(items))]
    return value.end == items[-1].end or value.end - items[-1].end > 2 or max(gaps) > 2
