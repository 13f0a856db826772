"""Values that external code may change or keep."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from msaa_lint.core.text.span import Span

from .terms import NAME
from .values import Array, Closure, Struct, VulkanObject, inner_cells, pointee, possible_writes, structures_in

MAX_DEPTH = 10
"""The maximum nesting of structures, lists, and pointers."""


def mark_escaped(value: Any, depth: int = 0) -> None:
    """Marks the Vulkan objects in a value, and the images of image views, as used by external code."""
    if isinstance(value, VulkanObject):
        value.escaped = True
        if value.kind == "view" and "image" in value.info.fields:
            for write in value.info.fields["image"].writes:
                mark_escaped(write.value, depth + 1)
    elif depth < 4 and not (isinstance(value, Struct) and value.kind):
        for cell in inner_cells(value):
            for write in cell.writes:
                mark_escaped(write.value, depth + 1)


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


def mark_used(value: Any, depth: int = 0) -> None:
    """Marks the structures in a value, including the ones that it points to, as used by a call."""
    if isinstance(value, Struct):
        value.used = True
    for cell in inner_cells(value) if depth < 8 else ():
        for write in cell.writes:
            mark_used(write.value, depth + 1)


def settled_under(value: Any, conditions: Mapping[str, bool], depth: int = 0) -> Any:
    """Reduces the cells of a value, in place, to the writes that are possible under some conditions. Returns the value."""
    if depth <= MAX_DEPTH and conditions:
        for cell in inner_cells(value):
            cell.writes = possible_writes(cell.writes, conditions)
            for write in cell.writes:
                settled_under(write.value, conditions, depth + 1)
    return value
