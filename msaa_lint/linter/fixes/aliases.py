"""Finds members that share their text through aliases and merge keys, and whether several fixes
request the same change of them.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence

from msaa_lint.core.text.node import Node
from msaa_lint.frame.description.models import Command
from msaa_lint.frame.description.record import Record

from .changes import Change

Member = tuple[int, str]
"""The identity of a record, and the name of a member."""

Requests = Mapping[Member, Collection[tuple[str, str]]]
"""The actions and values that fixes request, by member."""

MAX_SHARED = 1000
"""How many members of a shared text are compared. With more, the fixes are taken to disagree."""

_TOO_MANY: Member = (0, "")
"""Stands for more members than are compared: no fix requests anything of it."""


def requests(changes: Iterable[Change]) -> dict[Member, set[tuple[str, str]]]:
    """What changes request of each member."""
    requested: dict[Member, set[tuple[str, str]]] = {}
    for change in changes:
        requested.setdefault((id(change.record), change.member), set()).add(
            (change.action, str(change.value))
        )
    return requested


def all_request(members: Iterable[Member], changes: Sequence[Change], requested: Requests) -> bool:
    """Whether the changes of one member are requested of all the given members."""
    actions = {(change.action, str(change.value)) for change in changes}
    return all(actions.issubset(requested.get(member, ())) for member in members)


class Aliases:
    """The members of records by the key that states them and by their value, and the records by
    their mapping.
    """

    def __init__(self, records: Iterable[Record]) -> None:
        self._by_key: dict[int, list[Member]] = {}
        self._by_value: dict[int, list[Member]] = {}
        self._by_node: dict[int, list[int]] = {}
        self._by_mapping: dict[int, list[int]] = {}
        for record in records:
            self._by_node.setdefault(id(record.node), []).append(id(record))
            self._by_mapping.setdefault(_origin(record.node), []).append(id(record))
            members = [(name, key, value) for name, (key, value) in record.spelled.items()]
            if isinstance(record, Command) and record.node.kind == "mapping":
                members += [
                    (name, record.node.keys[name], value)
                    for name, value in record.node.value.items()
                ]
            for name, key, value in members:
                self._by_key.setdefault(id(key), []).append((id(record), name))
                self._by_value.setdefault(_origin(value), []).append((id(record), name))

    def of_key(self, record: Record, member: str) -> list[Member]:
        """The other members that the same key and value state."""
        members = self._by_key[id(record.spelled[member][0])]
        if len(members) > MAX_SHARED:
            return [_TOO_MANY]
        return [other for other in members if other != (id(record), member)]

    def of_value(self, record: Record, member: str) -> list[Member]:
        """The other members that an alias gives the same value."""
        key, value = record.spelled[member]
        members, same_key = self._by_value[_origin(value)], self._by_key[id(key)]
        if len(members) == len(same_key):
            return []
        return (
            [_TOO_MANY]
            if len(members) > MAX_SHARED
            else [other for other in members if other not in same_key]
        )

    def has_same_node(self, record: Record) -> bool:
        """Whether another record is stated at the same place of the text."""
        return any(other != id(record) for other in self._by_node[id(record.node)])

    def of_mapping(self, record: Record) -> set[int]:
        """The identities of the other records that take members from a record's mapping."""
        others = set(self._by_mapping[_origin(record.node)][: MAX_SHARED + 2])
        for key, _ in record.spelled.values():
            if record.node.start <= key.start < record.node.end:
                others.update(other for other, _ in self._by_key[id(key)][: MAX_SHARED + 2])
        return others - {id(record)} if len(others) <= MAX_SHARED else {_TOO_MANY[0]}


def _origin(node: Node) -> int:
    return id(node.anchor or node)
