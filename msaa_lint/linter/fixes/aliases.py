"""Which members of a document are stated by the same text: aliases and merge keys."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping

from msaa_lint.core.text.node import Node
from msaa_lint.frame.description.models import Command
from msaa_lint.frame.description.record import Record

from .changes import Change

Member = tuple[int, str]
"""A record, by identity, and a member of it."""

Wishes = Mapping[Member, Collection[str]]
"""By member: what is wanted of it."""

NOBODY: Wishes = {}

MAX_SHARED = 1000
"""So many members are looked at that share a text. Of more it is taken that they do not agree."""

_MANY: list[Member] = [(0, "")]


class Sharing:
    """What anchors share: members by the key that states them, and by their value; records by their mapping."""

    def __init__(self, records: list[Record]) -> None:
        self._keys: dict[int, list[Member]] = {}
        self._values: dict[int, list[Member]] = {}
        self._nodes: dict[int, list[int]] = {}
        self._mappings: dict[int, list[int]] = {}
        for record in records:
            self._nodes.setdefault(id(record.node), []).append(id(record))
            self._mappings.setdefault(_origin(record.node), []).append(id(record))
            stated = [(name, key, value) for name, (key, value) in record.spelled.items()]
            if isinstance(record, Command) and record.node.kind == "mapping":
                stated += [(name, record.node.keys[name], value) for name, value in record.node.value.items()]
            for name, key, value in stated:
                self._keys.setdefault(id(key), []).append((id(record), name))
                self._values.setdefault(_origin(value), []).append((id(record), name))

    def of_key(self, record: Record, member: str) -> list[Member]:
        """The other members that the same key and value state."""
        every = self._keys[id(record.spelled[member][0])]
        return [other for other in every if other != (id(record), member)] if len(every) <= MAX_SHARED else _MANY

    def of_value(self, record: Record, member: str) -> list[Member]:
        """The other members that have the same value, by an alias."""
        key, value = record.spelled[member]
        every, same = self._values[_origin(value)], self._keys[id(key)]
        if len(every) > MAX_SHARED:
            return _MANY if len(every) != len(same) else []
        return [other for other in every if other not in set(same)] if len(every) != len(same) else []

    def of_node(self, record: Record) -> set[int]:
        """The other records that are the same place of the text."""
        return {other for other in self._nodes[id(record.node)][: MAX_SHARED + 2] if other != id(record)}

    def of_mapping(self, record: Record) -> set[int]:
        """The other records that take something from a record's mapping."""
        others = set(self._mappings[_origin(record.node)][: MAX_SHARED + 2])
        for key, _ in record.spelled.values():
            if record.node.start <= key.start < record.node.end:
                others.update(other for other, _ in self._keys[id(key)][: MAX_SHARED + 2])
        return others - {id(record)} if len(others) <= MAX_SHARED else {0}


def wishes(changes: Iterable[Change]) -> dict[Member, set[str]]:
    """What changes want of each member."""
    found: dict[Member, set[str]] = {}
    for change in changes:
        found.setdefault((id(change.record), change.member), set()).add(wish(change))
    return found


def wish(change: Change) -> str:
    """What a change wants of its member."""
    return f"{change.action} {change.value}"


def _origin(node: Node) -> int:
    return id(node.anchor or node)


def records_of(record: Record) -> Iterator[Record]:
    """A record and all that it holds."""
    yield record
    for member in record.SHAPE if not isinstance(record, Command) else ("body",):
        yield from _within(getattr(record, member))


def _within(value: object) -> Iterator[Record]:
    if isinstance(value, Record):
        yield from records_of(value)
    elif isinstance(value, tuple):
        for item in value:
            yield from _within(item)
    elif isinstance(value, dict):
        for item in value.values():
            yield from _within(item)
