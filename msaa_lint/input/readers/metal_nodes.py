"""Members of Metal's structures as nodes of a Vulkan description, at their places."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TypeVar

from msaa_lint.core.text.node import Node
from msaa_lint.core.text.node_builder import scalar
from msaa_lint.core.text.span import Span
from msaa_lint.frame.description.record import Record

Kind = TypeVar("Kind")
Items = list[tuple[str, Span, Node]]
"""What a mapping is made of: keys, where they stand, and values."""


def by_index(stated: Mapping[str, Kind | None] | Sequence[Kind | None]) -> list[Kind | None]:
    """Colour attachments in the order of their indices, None where one is not used."""
    if not isinstance(stated, Mapping):
        return list(stated)
    found: list[Kind | None] = [None] * (max((int(index) for index in stated), default=-1) + 1)
    for index, each in stated.items():
        found[int(index)] = each
    return found


def first_stated(record: Record, members: Sequence[str]) -> str | None:
    """The first of some members, names of one property, that is stated."""
    return next((member for member in members if getattr(record, member) is not None), None)


def key_of(record: Record, member: str) -> Span:
    """Where the key of a member stands; the record's head where it is not stated."""
    return record.spelled[member][0].span if member in record.spelled else record.head


def placed(record: Record, member: str, value: str | int | bool) -> tuple[Span, Node]:
    """Another value in the place of a member's."""
    return key_of(record, member), scalar(value, record.place(member))
