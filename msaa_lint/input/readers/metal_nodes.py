"""Builds nodes of a Vulkan description from members of Metal structures, at the members' places."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TypeVar

from msaa_lint.core.text.node import Node
from msaa_lint.core.text.node_builder import scalar
from msaa_lint.core.text.span import Span
from msaa_lint.frame.description.record import Record

Kind = TypeVar("Kind")
Items = list[tuple[str, Span, Node]]
"""The items of a mapping: key, place of the key, and value."""


def by_index(stated: Mapping[str, Kind | None] | Sequence[Kind | None]) -> list[Kind | None]:
    """Color attachments in index order; None for an unused index."""
    if not isinstance(stated, Mapping):
        return list(stated)
    attachments: list[Kind | None] = [None] * (max((int(index) for index in stated), default=-1) + 1)
    for index, attachment in stated.items():
        attachments[int(index)] = attachment
    return attachments


def first_stated(record: Record, members: Sequence[str]) -> str | None:
    """The first stated member among several names of the same property."""
    return next((member for member in members if getattr(record, member) is not None), None)


def key_of(record: Record, member: str) -> Span:
    """The place of a member's key; the record's head if it is not stated."""
    return record.spelled[member][0].span if member in record.spelled else record.head


def placed(record: Record, member: str, value: str | int | bool) -> tuple[Span, Node]:
    """Another value, at a member's place."""
    return key_of(record, member), scalar(value, record.place(member))
