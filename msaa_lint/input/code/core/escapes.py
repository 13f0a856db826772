"""Values that external code may change or keep."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from msaa_lint.core.text.span import Span

from .guards import compared
from .limits import Work
from .terms import NAME
from .values import (
    ApiObject,
    Array,
    Cell,
    Closure,
    Struct,
    Value,
    inner_cells,
    pointee,
    possible_writes,
    structures_in,
)

MAX_DEPTH = 4
"""The maximum nesting of values that external code reaches."""


def mark_escaped(value: Value, work: Work) -> None:
    """Marks the Vulkan objects in a value, and the images of image views, as used by external
    code.
    """
    stack = [(write.value, 0) for write in value]
    seen: set[int] = set()
    while stack:
        inner, depth = stack.pop()
        cells: Iterable[Cell] = ()
        if isinstance(inner, ApiObject):
            inner.escaped = True
            if inner.kind == "view" and "image" in inner.info.fields:
                cells = (inner.info.fields["image"],)
        elif depth < MAX_DEPTH and not (isinstance(inner, Struct) and inner.kind):
            cells = inner_cells(inner)
        for cell in cells:
            if id(cell) not in seen:
                seen.add(id(cell))
                work.spend()
                stack += [(write.value, depth + 1) for write in cell.writes]


def forget(value: Any) -> None:
    """Discards what is known of a structure or a list."""
    if isinstance(value, Array):
        value.complete = False
    for struct in structures_in(value):
        struct.zeroed = False
        struct.fields.clear()


def forget_captures(closure: Closure) -> None:
    """Discards the values of variables that a lambda names, which an external function may call."""
    names: set[str] = set()
    stack: list[Any] = list(closure.body)
    while stack:
        term = stack.pop()
        if isinstance(term, tuple) and term and not isinstance(term, Span):
            if term[0] == NAME and len(term) == 3 and isinstance(term[1], str):
                names.add(term[1])
            else:
                stack.extend(term)
    for variables in closure.scopes:
        for name in names & variables.keys():
            for write in variables[name].writes:
                forget(pointee(write.value))


def mark_used(value: Struct, work: Work) -> None:
    """Marks a structure and those in it, including the ones that it points to, as used by a
    call.
    """
    value.used = True
    for cell in _cells_in(value, work):
        for write in cell.writes:
            if isinstance(write.value, Struct):
                write.value.used = True


class _Conditions(dict[str, bool]):
    """The values of conditions where some hold. What equals one constant does not equal another."""

    def __init__(self, conditions: Mapping[str, bool]) -> None:
        super().__init__(conditions)
        self.equal = {
            subject: text for text, way in conditions.items() if way and (subject := compared(text))
        }

    def get(self, text: str, default: Any = None) -> Any:
        value = super().get(text)
        return (
            False
            if value is None and self.equal and self.equal.get(compared(text), text) != text
            else value
        )


def settle_under(value: Struct, conditions: Mapping[str, bool], work: Work) -> None:
    """Reduces the cells of a structure to the writes that are possible under some conditions, and
    its lists to the elements.
    """
    if not conditions:
        return
    known = _Conditions(conditions)
    lists: list[Array] = []
    absent: set[int] = set()
    for cell in _cells_in(value, work):
        had_writes = bool(cell.writes)
        cell.writes = possible_writes(cell.writes, known)
        lists += [write.value for write in cell.writes if isinstance(write.value, Array)]
        if had_writes and not cell.writes:
            absent.add(id(cell))
    for array in lists if absent else ():
        array.items = [item for item in array.items if id(item) not in absent]


def _cells_in(value: Struct, work: Work) -> Iterator[Cell]:
    """Yields the cells that a structure consists of and points to, each once, before what is in
    it.
    """
    stack = inner_cells(value)[::-1]
    seen: set[int] = set()
    while stack:
        cell = stack.pop()
        if id(cell) in seen:
            continue
        seen.add(id(cell))
        work.spend(1 + len(cell.writes))
        yield cell
        for write in cell.writes:
            stack += inner_cells(write.value)
