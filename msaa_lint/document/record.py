"""A structure of a description as it was read: typed members, and where each is stated."""

from __future__ import annotations

from typing import Any, ClassVar

from ..finding import Span
from ..source.tree import Node

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
        """Where the first of the members that is stated has its value (a structure: its key); the record's head where none is."""
        for name in names:
            if name in self.spelled:
                key, value = self.spelled[name]
                if value.kind == "mapping" or (value.kind == "sequence" and any(item.kind == "mapping" for item in value.value)):
                    return key.span
                return value.span
        return self.head
