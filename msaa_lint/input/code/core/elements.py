"""The elements of lists that expressions refer to."""

from __future__ import annotations

from abc import abstractmethod
from typing import Any

from msaa_lint.core.text.span import Span

from .guards import ALWAYS, contradicts
from .scope import MEMBER, Scope
from .static_types import StaticTypes
from .terms import NAME, Term
from .values import (
    MAX_ALTERNATIVES,
    UNKNOWN,
    UNKNOWN_VALUE,
    Alternative,
    Array,
    Cell,
    SplitCell,
    Struct,
    Symbol,
    Value,
    are_equal,
    limited,
    pointee,
    sole_value,
)

MAX_SPLIT = 4
"""The maximum number of elements of a list one of which is written, depending on a condition."""


class Elements(StaticTypes):
    """The elements of lists."""

    def index_key(self, index: Term, scope: Scope) -> str:
        """Returns what tells an unknown index from others: the variable and its last write, or its
        place.
        """
        written = self.variable(index[1], scope) if index[0] == NAME else None
        version = written.writes[-1].at.start if written is not None and written.writes else 0
        return f"{index[1]} {version}" if index[0] == NAME else f"at {index[-1].start}"

    def element_of(self, array: Array, index: Term, place: Span, scope: Scope) -> Cell:
        """Returns the element of a list at an unknown index. Others may follow or be the same, so
        the list is not complete.
        """
        if array.alike and len(array.items) == 1 and scope.unknown_loops:
            return array.items[0]
        key = self.index_key(index, scope)
        array.complete = array.alike = False
        cell = array.others.get(key)
        if cell is None:
            cell = array.others[key] = self.unset_element(array.kind, place, array.zeroed)
            if len(array.others) == 1 and not any(_is_set(item) for item in array.items):
                array.items.clear()
            for item in array.items:
                _make_uncertain(item, place)
            if len(array.items) < 64:
                array.items.append(cell)
        return cell

    def indexed(self, term: Term, scope: Scope) -> Cell | None:
        reading, self.reading = self.reading, False
        cell = self.cell_of(term[1], scope)
        indices = self.value(term[2], scope)
        self.reading = reading
        index = sole_value(indices)
        if cell is None:
            return None
        value = pointee(sole_value(cell.read(scope.guards)))
        element = self.element_of_object(value, index, term[-1])
        if element is not None:
            return element
        if isinstance(value, Array):
            if type(index) is not int or not 0 <= index < 64:
                if reading:
                    return self.looked_up(value, indices, term, scope)
                if (split := self.split_element(value, indices, term[-1], scope)) is not None:
                    return split
                return self.element_of(value, term[2], term[-1], scope)
            return Cell() if value.others else self.element_at(value, index, term[-1])
        if cell.kind == MEMBER:
            return self.member_element(cell, indices, scope)
        if isinstance(value, Struct) and index == 0:
            return cell
        return None

    def member_element(self, cell: Cell, indices: Value, scope: Scope) -> Cell:
        """Returns the element of a member that is a list whose length is unknown."""
        index = sole_value(indices)
        chosen = [a for a in indices if not contradicts(a.guards, scope.guards)]
        owners = cell.parts if isinstance(cell, SplitCell) else ((cell, ALWAYS),)
        if (
            type(index) is int
            or not 1 < len(chosen) * len(owners) <= MAX_SPLIT
            or not all(type(a.value) is int for a in chosen)
        ):
            chosen = [
                Alternative(
                    index if type(index) is int else "",
                    cell.writes[0].at if cell.writes else Span(0, 0),
                )
            ]
        parts = [
            (self.member_cell(f"{owner.name}[{a.value}]"), guards | (a.guards - scope.guards))
            for owner, guards in owners
            for a in chosen
        ]
        return parts[0][0] if len(parts) == 1 else SplitCell(parts)

    def element_at(self, array: Array, index: int, place: Span) -> Cell:
        """Returns the element of a list at a known index, to which the list is extended."""
        while len(array.items) <= index:
            array.items.append(self.unset_element(array.kind, place, array.zeroed))
        return array.items[index]

    def split_element(self, array: Array, indices: Value, place: Span, scope: Scope) -> Cell | None:
        """Returns the element of a list at one of a few known indices, to be written; None for
        other indices.
        """
        chosen = [a for a in indices if not contradicts(a.guards, scope.guards)]
        if (
            array.others
            or not 1 < len(chosen) <= MAX_SPLIT
            or not all(type(a.value) is int and 0 <= a.value < 64 for a in chosen)
        ):
            return None
        return SplitCell(
            [(self.element_at(array, a.value, place), a.guards - scope.guards) for a in chosen]
        )

    def element_of_object(self, value: Any, index: Any, place: Span) -> Cell | None:
        """Returns an element of an object of the API; None for other values."""
        return None

    def looked_up(self, array: Array, indices: Value, term: Term, scope: Scope) -> Cell:
        """Returns a cell with the element of a list at an unknown index, to be read: the same index
        gives elements that belong together.
        """
        element = array.others.get(self.index_key(term[2], scope))
        if element is None and array.alike and len(array.items) == 1:
            return array.items[0]
        if element is not None or not array.complete or not array.items:
            return element or Cell()
        if indices and all(type(a.value) is int for a in indices):
            chosen = [(a.value, a.guards) for a in indices]
        else:
            subject = self.subject(indices, term[2], scope)
            if all(type(sole_value(item.writes)) is int for item in array.items):
                # Which number it is, a caller decides.
                return Cell(
                    writes=(Alternative(Symbol(f"{array.name}[{subject}]", array.name), term[-1]),)
                )
            chosen = [(n, frozenset({(f"{subject}={n}", True)})) for n in range(len(array.items))]
        if len(chosen) > MAX_ALTERNATIVES:
            values = [sole_value(item.writes) for item in array.items]
            return Cell(
                writes=array.items[0].writes
                if all(are_equal(value, values[0]) for value in values)
                else ()
            )
        writes: Value = ()
        for n, guards in chosen:
            content = array.items[n].writes if 0 <= n < len(array.items) else ()
            writes += self.copies.alternatives(content or (Alternative(UNKNOWN, term[-1]),), guards)
        return Cell(array.kind, writes=limited(writes, term[-1]))

    @abstractmethod
    def subject(self, value: Value, term: Term, scope: Scope) -> str:
        """Returns the text that stands for an unknown value in conditions."""


def _is_set(item: Cell) -> bool:
    """Returns whether anything was written to an element of a list."""
    return any(not isinstance(write.value, Struct) or write.value.fields for write in item.writes)


_OTHER = "the element at "


def is_other_element(text: str) -> bool:
    """Returns whether a condition says that two unknown indices are the same."""
    return text.startswith(_OTHER)


def _make_uncertain(item: Cell, place: Span) -> None:
    """Makes an element of a list unknown that a write at an unknown index may change."""
    guards = frozenset({(f"{_OTHER}{place.start}", True)})
    struct = sole_value(item.writes)
    for cell in struct.fields.values() if isinstance(struct, Struct) else (item,):
        cell.write(UNKNOWN_VALUE, place, guards)
