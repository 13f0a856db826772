"""What C and C++ expressions come to, as far as a file says.

A value is a tuple of alternatives, empty where nothing is known. Each has the conditions under which it is the value. A world is a choice
of conditions; in one world a value may come down to one alternative.
"""

# No `from __future__ import annotations`: a NamedTuple then compiles the text of every annotation, which takes four times as long.
from collections.abc import Mapping
from typing import Any, NamedTuple

from msaa_lint.core.text.span import Span

Guards = frozenset[tuple[str, bool]]
"""Conditions that all hold: their texts, and which way."""

ALWAYS: Guards = frozenset()

MAX_ALTERNATIVES = 12
"""Alternatives of a value that are followed; with more, nothing is known."""


class Symbol(NamedTuple):
    """A value that is not known, and is the same wherever it stands. `chosen`: it comes from a function that looks for a sample count."""

    key: str
    name: str
    chosen: bool = False


class Flags(NamedTuple):
    """Bits, each with its place."""

    bits: tuple[tuple[str, Span], ...]


class Alternative(NamedTuple):
    """One of the values that an expression may have: what it is, where that stands, and when it is so."""

    value: Any
    at: Span
    guards: Guards = ALWAYS


Value = tuple[Alternative, ...]

UNKNOWN_VALUE: Value = ()


class Cell:
    """A variable or member: what was written to it, in order."""

    __slots__ = ("key", "kind", "name", "writes")

    def __init__(self, kind: str = "", name: str = "", writes: Value = (), key: str = "") -> None:
        self.kind = kind
        self.name = name
        self.writes = writes
        self.key = key
        """What a value in it is known by that is not known itself: a parameter's, a member's."""

    def write(self, value: Value, at: Span, guards: Guards) -> None:
        """A write under conditions, which ends what was there wherever they hold."""
        fresh = tuple(Alternative(a.value, a.at, a.guards | guards) for a in value) or (Alternative(UNKNOWN, at, guards),)
        before = tuple(w for w in self.writes if not guards <= w.guards) if guards else ()
        writes = (*before, *fresh)
        # Without its earliest alternatives, a value would be known where it is not.
        self.writes = writes if len(writes) <= MAX_ALTERNATIVES else (Alternative(UNKNOWN, at),)

    def read(self, guards: Guards) -> Value:
        """What may be in it where some conditions hold."""
        return possible_writes(self.writes, dict(guards)) if self.writes else UNKNOWN_VALUE


class Unknown:
    """What is known of a value of which nothing is known; it stands beside others that are."""

    def __repr__(self) -> str:
        return "UNKNOWN"


UNKNOWN = Unknown()


def possible_writes(writes: Value, configuration: Mapping[str, bool]) -> Value:
    """The writes that may be seen in a world: from the last one back to the first that certainly happened."""
    if len(writes) == 1 and not writes[0].guards:
        return writes
    alternatives: list[Alternative] = []
    for write in reversed(writes):
        rest = []
        for guard in write.guards:
            way = configuration.get(guard[0])
            if way is None:
                rest.append(guard)
            elif way is not guard[1]:
                break
        else:
            alternatives.append(Alternative(write.value, write.at, frozenset(rest)) if len(rest) < len(write.guards) else write)
            if not rest:
                break
    return tuple(reversed(alternatives))


class Struct:
    """A structure, Vulkan's or the program's. `zeroed`: what no one set is zero. `name` is the variable's that it was first in."""

    __slots__ = ("at", "fields", "kind", "name", "used", "zeroed")

    def __init__(self, kind: str, at: Span, zeroed: bool = False, name: str = "") -> None:
        self.kind = kind
        self.at = at
        self.zeroed = zeroed
        self.name = name
        self.used = False
        """Whether a call takes it."""
        self.fields: dict[str, Cell] = {}

    def cell(self, name: str) -> Cell:
        """The member's cell."""
        if name not in self.fields:
            self.fields[name] = Cell(name=name)
        return self.fields[name]


class Array:
    """A list. `complete`: these are all its elements, in their places. `zeroed`: further structures in it are zero."""

    __slots__ = ("at", "complete", "items", "kind", "name", "zeroed")

    def __init__(self, kind: str, at: Span, complete: bool = True) -> None:
        self.kind = kind
        self.at = at
        self.items: list[Cell] = []
        self.complete = complete
        self.zeroed = False
        self.name = ""


class Ref(NamedTuple):
    """A pointer or reference to a cell."""

    cell: Cell


class VulkanObject:
    """An object of Vulkan's that a call made: an image, a view, a render pass. `info` is what it was made with, copied at the call."""

    __slots__ = ("at", "escaped", "guards", "info", "key", "kind", "memory", "name", "name_depth")

    def __init__(self, kind: str, key: tuple[Any, ...], at: Span) -> None:
        self.kind = kind
        self.key = key
        self.at = at
        self.name = ""
        self.name_depth = 99
        """How many calls deep it was named."""
        self.escaped = False
        """Whether it is handed to code that is not the file's."""
        self.info: Struct | None = None
        self.memory: Value = ()
        self.guards: Guards = ALWAYS

    def signature(self) -> tuple[Any, ...]:
        """What it has in common with what the same call makes again alike."""
        fields = self.info.fields if self.info is not None else {}
        members = [(name, tuple(_said(write.value) for write in cell.writes)) for name, cell in fields.items()]
        return (self.kind, self.at, tuple(sorted(members)))


def _said(value: Any) -> str:
    if isinstance(value, VulkanObject):
        return f"{value.kind} at {value.at}"
    return f"at {value.at}" if isinstance(value, (Struct, Array)) else "reference" if isinstance(value, (Ref, Closure)) else repr(value)


class Closure(NamedTuple):
    """A lambda, and the variables around it."""

    parameters: tuple[Any, ...]
    body: tuple[Any, ...]
    scopes: tuple[dict[str, Cell], ...]


def inner_cells(value: Any) -> list[Cell]:
    """The cells that a value leads to: a structure's members, a list's elements, what a pointer points to."""
    if isinstance(value, Struct):
        return list(value.fields.values())
    if isinstance(value, Array):
        return value.items
    return [value.cell] if isinstance(value, Ref) else []


MAX_DEPTH = 10


def copy_alternatives(value: Value, guards: Guards = ALWAYS) -> Value:
    """The alternatives of a value, with structures and lists copied, under further conditions."""
    return tuple(Alternative(copy_value(a.value), a.at, a.guards | guards) for a in value)


def copy_value(value: Any, depth: int = 0, follow_pointers: bool = False) -> Any:
    """A copy of what is in a value. `follow_pointers` follows pointers as well: what a call is handed, as it is at that moment."""
    if depth > MAX_DEPTH:
        return UNKNOWN
    if isinstance(value, Struct):
        struct = Struct(value.kind, value.at, value.zeroed, value.name)
        for name, cell in value.fields.items():
            struct.fields[name] = copy_cell(cell, depth, follow_pointers)
        return struct
    if isinstance(value, Array):
        array = Array(value.kind, value.at, value.complete)
        array.zeroed, array.name = value.zeroed, value.name
        array.items = [copy_cell(cell, depth, follow_pointers) for cell in value.items]
        return array
    if isinstance(value, Ref) and follow_pointers:
        return Ref(copy_cell(value.cell, depth, follow_pointers))
    return value


def copy_cell(cell: Cell, depth: int = 0, follow_pointers: bool = False) -> Cell:
    copy = Cell(cell.kind, cell.name)
    copy.writes = tuple(
        Alternative(copy_value(a.value, depth + 1, follow_pointers), a.at, a.guards) if isinstance(a.value, (Struct, Array, Ref)) else a
        for a in cell.writes
    )
    return copy


def sole_value(value: Value) -> Any:
    """What a value is, where it is one thing alone; UNKNOWN otherwise."""
    if len(value) == 1:
        return value[0].value
    if value and all(are_equal(a.value, value[0].value) for a in value):
        return value[0].value
    return UNKNOWN


def pointee(value: Any) -> Any:
    """What a pointer points to; any other value is itself."""
    for _ in range(4):
        if not isinstance(value, Ref):
            return value
        value = sole_value(value.cell.writes)
    return value


def are_equal(left: Any, right: Any) -> bool:
    """Whether two values are alike for sure."""
    if isinstance(left, Flags) and isinstance(right, Flags):
        return {bit for bit, _ in left.bits} == {bit for bit, _ in right.bits}
    if isinstance(left, (Struct, Array, Unknown)):
        return left is right and left is not UNKNOWN
    return type(left) is type(right) and bool(left == right)
