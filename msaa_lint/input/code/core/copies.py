"""Copies of values: structures and lists are copied when they are assigned, passed, or returned."""

from __future__ import annotations

from typing import Any

from .guards import ALWAYS, Guards
from .limits import Work
from .values import UNKNOWN, Alternative, Array, Cell, Instance, Ref, Struct, Value, limited

MAX_DEPTH = 10
"""The maximum nesting of structures that are copied."""


class Copier:
    """Copies values; `work` counts the members and alternatives that are copied."""

    def __init__(self, work: Work) -> None:
        self.work = work

    def alternatives(self, value: Value, guards: Guards = ALWAYS) -> Value:
        """Returns copies of the alternatives of a value, under additional conditions."""
        return tuple(Alternative(self.value(a.value), a.at, a.guards | guards) for a in value)

    def value(self, value: Any) -> Any:
        """Returns a deep copy of a structure or list; other values, pointers among them, are
        returned as is.
        """
        return self._copy(value, 0, None)

    def with_targets(self, value: Any) -> Any:
        """Returns a deep copy of a structure or list, and of the targets of its pointers, each of
        which is copied once.
        """
        return self._copy(value, 0, {})

    def merged(self, value: Value) -> Struct:
        """Returns one structure for several alternative ones: what differs has alternatives, the
        first where none of the others is.
        """
        structs = [(a.value, a.guards if n else ALWAYS) for n, a in enumerate(value)]
        first: Struct = structs[0][0]
        merged = Struct(
            first.kind, first.at, all(struct.zeroed for struct, _ in structs), first.name
        )
        merged.type = first.type if all(struct.type == first.type for struct, _ in structs) else ""
        for name in dict.fromkeys(name for struct, _ in structs for name in struct.fields):
            writes: Value = ()
            for struct, guards in structs:
                cell = struct.fields.get(name)
                unset = (Alternative(None if struct.zeroed else UNKNOWN, struct.at),)
                writes += self.alternatives(
                    cell.writes if cell is not None and cell.writes else unset, guards
                )
            merged.cell(name).writes = limited(writes, first.at)
        return merged

    def _copy(self, value: Any, depth: int, targets: dict[int, Cell] | None) -> Any:
        if depth > MAX_DEPTH:
            return UNKNOWN
        if isinstance(value, Struct) and not isinstance(value, Instance):
            struct = Struct(value.kind, value.at, value.zeroed, value.name)
            struct.type = value.type
            for name, cell in value.fields.items():
                struct.fields[name] = self._cell(cell, Cell(cell.kind, cell.name), depth, targets)
            return struct
        if isinstance(value, Array):
            array = Array(value.kind, value.at, value.complete)
            array.zeroed, array.name, array.others = value.zeroed, value.name, dict(value.others)
            array.unset, array.alike = value.unset, value.alike
            array.items = [
                self._cell(cell, Cell(cell.kind, cell.name), depth, targets) for cell in value.items
            ]
            return array
        if isinstance(value, Ref) and targets is not None:
            cell = value.cell
            copy = targets.get(id(cell))
            if copy is None:
                copy = targets[id(cell)] = Cell(cell.kind, cell.name)
                self._cell(cell, copy, depth, targets)
            return Ref(copy, value.alias)
        return value

    def _cell(self, cell: Cell, copy: Cell, depth: int, targets: dict[int, Cell] | None) -> Cell:
        self.work.spend(1 + len(cell.writes))
        copy.writes = tuple(
            Alternative(self._copy(a.value, depth + 1, targets), a.at, a.guards)
            if isinstance(a.value, (Struct, Array, Ref))
            else a
            for a in cell.writes
        )
        return copy
