"""A structure of a description as it was read: typed members, and where each is stated."""

from __future__ import annotations

from collections.abc import Container
from typing import ClassVar

from msaa_lint.core.text.node import Node
from msaa_lint.core.text.span import Span

from .scalars import enumerant
from .shapes import Shape, member_shapes


class MemberShapes:
    """The shapes of a record class's members, worked out from their types when first read."""

    def __get__(self, record: Record | None, kind: type[Record]) -> dict[str, Shape]:
        shapes = member_shapes(kind)
        type.__setattr__(kind, "SHAPE", shapes)
        return shapes


class Record:
    """One structure. A subclass declares the members with their types; the value in the class is
    what an absent member is.

    None is unknown; an empty list or mapping is none. `key` is the name or index of the structure,
    `path` its structural path (`renderPasses.forward.attachments.color`), `head` the place that
    stands for it in a message (its key, or its first member), and `spelled` the key and the value
    of each member that the input states.
    """

    SHAPE: ClassVar[dict[str, Shape]]

    def __init_subclass__(cls) -> None:
        if "SHAPE" not in vars(cls):
            type.__setattr__(cls, "SHAPE", MemberShapes())

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
        """The place of the value of the first stated member (of its key, for a structure or a list
        that may take several lines).

        The record's head if none of them is stated.
        """
        spelled = self.spelled
        for name in names:
            if name in spelled:
                key, value = spelled[name]
                return key.span if value.kind != "scalar" and _is_wide(value) else value.span
        return self.head

    def flag_place(self, name: str, flags: Container[str]) -> Span:
        """The place of the first of some flags in the list that states a member; the member's place
        if it is not written as a list.
        """
        if name in self.spelled and self.spelled[name][1].kind == "sequence":
            items: list[Node] = self.spelled[name][1].value
            for item in items:
                if item.kind == "scalar" and enumerant(self.SHAPE[name][1], item.text) in flags:
                    return item.span
        return self.place(name)


def _is_wide(value: Node) -> bool:
    """Whether a value takes, or may take, several lines: a structure, a list of structures, a list
    with more than `, ` between items.
    """
    if value.kind != "sequence":
        return value.kind == "mapping"
    items: list[Node] = value.value
    if not items or value.anchor is not None:
        return any(item.kind == "mapping" for item in items)
    end = value.start
    for item in items:
        if item.kind == "mapping" or item.start - end > 2:
            return True
        end = item.end
    # A block list, which has no brackets, ends with its last item.
    return value.end == end or value.end - end > 2
