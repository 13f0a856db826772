"""The unit of every fix: a change of one member of a description's record."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any, NamedTuple

from msaa_lint.frame.description.models import MetalRecord
from msaa_lint.frame.description.record import Record


class Change(NamedTuple):
    """A change of one member of a record.

    | action | value | effect |
    |---|---|---|
    | `set` | a canonical name, a number or a boolean | replaces the value |
    | `unset` | | removes the member |
    | `add`, `remove` | a canonical name | adds a flag or removes it |
    | `entry` | a name and plain data | adds an entry at the end of a mapping or a list |
    | `append` | plain data | adds an item at the end of a list |
    | `insert-after` | an index and plain data | inserts an item after another |
    | `replace` | an index and a scalar | replaces an item |
    | `drop` | an index | removes an entry |

    The actions from `entry` on are structural.
    """

    record: Record
    member: str
    action: str
    value: Any = None

    @property
    def structural(self) -> bool:
        """Whether the change adds, replaces or removes entries."""
        return self.action not in ("set", "unset", "add", "remove")

    @property
    def effective(self) -> bool:
        """Whether the change makes a difference to its record."""
        if self.structural:
            return True
        if self.action == "unset":
            return self.record.states(self.member)
        before = getattr(self.record, self.member)
        return bool(self.applied_to(before) != before)

    def applied_to(self, before: Any) -> Any:
        """The member's value after a non-structural change."""
        if self.action == "set":
            return self.value
        if self.action == "unset":
            return getattr(type(self.record), self.member)
        if self.action == "add":
            return tuple(dict.fromkeys((*(before or ()), self.value)))
        return before if before is None else tuple(flag for flag in before if flag != self.value)


def distinct(changes: Iterable[Change]) -> list[Change]:
    """The changes without repetitions."""
    return list(
        {
            (id(change.record), change.member, change.action, repr(change.value)): change
            for change in changes
        }.values()
    )


class NoFix(Exception):
    """A fix cannot be planned or written. The message is the reason that users see."""


class SharedText(NoFix):
    """Anchors, aliases, or merge keys share a text that a fix changes with structures that it does
    not change.
    """


class StructuralChange(Exception):
    """A change cannot be applied in place: it is structural, or it concerns a Metal record, from
    which other records are derived.
    """


@contextmanager
def apply_temporarily(changes: Sequence[Change]) -> Iterator[None]:
    """Applies changes to the records within a `with` statement, then restores the exact previous
    values, even after an exception.

    Raises StructuralChange, before any record changes, if one of the changes cannot be applied in
    place.
    """
    if any(change.structural or isinstance(change.record, MetalRecord) for change in changes):
        raise StructuralChange
    values = [(record, member, getattr(record, member)) for record, member, *_ in changes]
    try:
        for change in changes:
            setattr(
                change.record,
                change.member,
                change.applied_to(getattr(change.record, change.member)),
            )
        yield
    finally:
        for record, member, value in values:
            setattr(record, member, value)
