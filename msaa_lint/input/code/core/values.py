"""Values of C and C++ expressions.

A value is a tuple of alternatives, empty if nothing is known. Each alternative has the conditions
under which it is the value. In a configuration, which decides conditions, a value may have a single
alternative.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple, Protocol

from msaa_lint.core.text.span import Span

from .guards import ALWAYS, Conjunction, Guards, contradicts, covers, remaining, remaining_under

MAX_ALTERNATIVES = 12
"""The maximum number of alternatives of a value; with more, it is unknown."""


class Symbol(NamedTuple):
    """An unknown value that is the same wherever it occurs. `chosen` is set if it comes from a
    function that selects a sample count.
    """

    key: str
    name: str
    chosen: bool = False


class Flags(NamedTuple):
    """Flag bits with their locations."""

    bits: tuple[tuple[str, Span], ...]


class Alternative(NamedTuple):
    """A possible value of an expression, its location, and the conditions under which it
    applies.
    """

    value: Any
    at: Span
    guards: Guards = ALWAYS


Value = tuple[Alternative, ...]

UNKNOWN_VALUE: Value = ()


class Cell:
    """A variable or member: the writes to it, in order."""

    __slots__ = ("key", "kind", "name", "writes")

    def __init__(self, kind: str = "", name: str = "", writes: Value = (), key: str = "") -> None:
        self.kind = kind
        self.name = name
        self.writes = writes
        self.key = key
        """The key of the symbol that stands for an unknown value in it, for a parameter or
        member.
        """

    def write(self, value: Value, at: Span, guards: Guards) -> None:
        """Writes under conditions; replaces earlier writes that these conditions imply."""
        fresh = tuple(Alternative(a.value, a.at, a.guards | guards) for a in value) or (
            Alternative(UNKNOWN, at, guards),
        )
        if guards and self.writes and len(fresh) == 1 and self.certainly_holds(fresh[0]):
            return
        before = tuple(w for w in self.writes if not guards <= w.guards) if guards else ()
        self.writes = limited((*before, *fresh), at)

    def certainly_holds(self, write: Alternative) -> bool:
        """Returns whether a conditional write changes nothing. What a member holds comes from such
        writes, which are collected.
        """
        if self.kind == "member":
            return False
        current = self.read(write.guards)
        return (
            not current[0].guards and all(are_equal(a.value, write.value) for a in current)
            if current
            else False
        )

    def read(self, guards: Guards) -> Value:
        """Returns the possible values under some conditions."""
        return _visible(self.writes, lambda own: remaining_under(own, guards))


class SplitCell(Cell):
    """One of several cells, each under its conditions: the element of a list at an index that a
    condition decides.
    """

    __slots__ = ("parts",)

    def __init__(self, parts: Sequence[tuple[Cell, Guards]]) -> None:
        self.parts = parts
        super().__init__(parts[0][0].kind, parts[0][0].name)

    @property
    def writes(self) -> Value:
        """The writes to any of the cells."""
        return tuple(
            Alternative(w.value, w.at, w.guards | guards)
            for cell, guards in self.parts
            for w in cell.writes
        )

    @writes.setter
    def writes(self, value: Value) -> None:
        for cell, guards in self.parts if value else ():
            cell.write(value, value[0].at, guards)

    def write(self, value: Value, at: Span, guards: Guards) -> None:
        for cell, own in self.parts:
            if not contradicts(own, guards):
                cell.write(value, at, guards | own)


class Unknown:
    """Marks an alternative whose value is unknown."""

    def __repr__(self) -> str:
        return "UNKNOWN"


UNKNOWN = Unknown()


def limited(writes: Value, at: Span) -> Value:
    """Returns writes, of which at most MAX_ALTERNATIVES are kept apart: an unconditional one stays,
    and what others write is unknown.
    """
    if len(writes) <= MAX_ALTERNATIVES:
        return writes
    first = () if writes[0].guards else writes[:1]
    rest = writes[len(first) :]
    value = rest[0].value if all(are_equal(w.value, rest[0].value) for w in rest) else UNKNOWN
    return (*first, Alternative(value, at, frozenset({(f"a write before {at.start}", True)})))


def possible_writes(writes: Value, conditions: Mapping[str, bool]) -> Value:
    """Returns the writes that are visible under conditions."""
    return _visible(writes, lambda guards: remaining(guards, conditions))


def _visible(writes: Value, remainder: Callable[[Guards], Guards | None]) -> Value:
    """Returns the writes from the last back to the first from which on one certainly happens.
    `remainder` returns the conditions under which a write happens, or None.
    """
    if not writes or not writes[-1].guards:
        # Nothing shows through an unconditional write.
        return writes[-1:]
    alternatives: list[Alternative] = []
    tests: set[tuple[str, bool]] = set()
    opposite = False
    for write in reversed(writes):
        rest = remainder(write.guards)
        if rest is None:
            continue
        alternatives.append(
            write if rest is write.guards else Alternative(write.value, write.at, rest)
        )
        if not rest:
            break
        # Conditions can only cover all cases if some of them are opposite.
        opposite = opposite or any(
            (text, not way) in tests or isinstance(text, Conjunction) for text, way in rest
        )
        tests.update(rest)
        if opposite and covers(tuple(a.guards for a in alternatives)):
            break
    return tuple(reversed(alternatives))


class Struct:
    """A structure of Vulkan or the program. In a zeroed structure, unset members are zero. `name`
    is the first variable that held it.
    """

    __slots__ = ("at", "fields", "kind", "name", "type", "used", "zeroed")

    def __init__(self, kind: str, at: Span, zeroed: bool = False, name: str = "") -> None:
        self.kind = kind
        self.at = at
        self.zeroed = zeroed
        self.name = name
        self.type = ""
        """The class of the program that it is an object of, if known."""
        self.used = False
        """Whether a call takes it."""
        self.fields: dict[str, Cell] = {}

    def cell(self, name: str) -> Cell:
        """Returns the cell of a member."""
        if name not in self.fields:
            self.fields[name] = Cell(name=name)
        return self.fields[name]


class Instance(Struct):
    """An object that all variables refer to. Its members are those of a key in the current entry
    point, as those of classes are.

    `complete` is set if the program creates it, so that members that it does not set have their
    defaults.
    """

    __slots__ = ("complete", "key", "members")

    def __init__(self, kind: str, key: str, at: Span, members: Members, complete: bool) -> None:
        self.members = members
        super().__init__(kind, at)
        self.key = key
        """What the names of its members start with in the program: `@3.`, or `Renderer::` for any
        object of a class.
        """
        self.complete = complete

    @property
    def fields(self) -> dict[str, Cell]:
        """The members that are set."""
        return {
            name: cell
            for name in self.members.names_of(self.key)
            if (cell := self.cell(name)).writes
        }

    @fields.setter
    def fields(self, _: dict[str, Cell]) -> None:
        """Its members are in the entry point."""

    def cell(self, name: str) -> Cell:
        return self.members.member_cell(self.key + name)


class Members(Protocol):
    """The members of all objects in the current entry point."""

    def names_of(self, key: str) -> Sequence[str]:
        """Returns the names of the members that are used with a key."""

    def member_cell(self, key: str) -> Cell:
        """Returns the cell of a member of an object by its path."""


class Array:
    """A list. `complete` means that all its elements are known; `zeroed` that further elements are
    zero.
    """

    __slots__ = ("alike", "at", "complete", "items", "kind", "name", "others", "unset", "zeroed")

    def __init__(self, kind: str, at: Span, complete: bool = True) -> None:
        self.kind = kind
        self.at = at
        self.items: list[Cell] = []
        self.complete = complete
        self.zeroed = False
        self.name = ""
        self.others: dict[str, Cell] = {}
        """The elements at unknown indices, by the index."""
        self.unset = False
        """Whether it is a member that was not used yet. Then its length is not known, although it
        starts empty.
        """
        self.alike = False
        """Whether it consists of what one loop of unknown length appends, of which one element is
        known.
        """

    @property
    def is_known(self) -> bool:
        """Whether all its elements are known."""
        return self.complete and bool(self.items or not self.unset)


class Ref(NamedTuple):
    """A pointer to a cell; an alias is a reference, which stands for what is in the cell."""

    cell: Cell
    alias: bool = False


class ApiObject:
    """A Vulkan object created by a call: an image, a view, a render pass. `info` is a copy of its
    creation structure.
    """

    __slots__ = (
        "at",
        "escaped",
        "guards",
        "info",
        "key",
        "kind",
        "memory",
        "name",
        "name_depth",
        "repeated",
    )

    def __init__(self, kind: str, key: tuple[Any, ...], at: Span, info: Struct) -> None:
        self.kind = kind
        self.key = key
        self.info = info
        self.at = at
        self.name = ""
        self.name_depth = 99
        """The call depth at which it was named."""
        self.escaped = False
        """Whether it is passed to external code."""
        self.memory: Value = ()
        self.guards: Guards = ALWAYS
        self.repeated = False
        """Whether a loop of unknown length creates it."""

    def signature(self) -> tuple[Any, ...]:
        """Returns what identical objects created by the same call have in common."""
        members = [
            (name, tuple(_said(write.value) for write in cell.writes))
            for name, cell in self.info.fields.items()
        ]
        return (self.kind, self.at, tuple(sorted(members)))


def _said(value: Any) -> str:
    if isinstance(value, ApiObject):
        return f"{value.kind} at {value.at}"
    return (
        f"at {value.at}"
        if isinstance(value, (Struct, Array))
        else "reference"
        if isinstance(value, (Ref, Closure, Routine))
        else repr(value)
    )


class Closure(NamedTuple):
    """A lambda and its enclosing variables."""

    parameters: tuple[Any, ...]
    body: tuple[Any, ...]
    scopes: tuple[dict[str, Cell], ...]
    this_object: Cell | None = None
    class_name: str = ""
    namespace: str = ""


class Routine:
    """A pointer to a function of the program."""

    __slots__ = ("function",)

    def __init__(self, function: Any) -> None:
        self.function = function

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Routine) and other.function is self.function

    def __hash__(self) -> int:
        return id(self.function)


def inner_cells(value: Any) -> list[Cell]:
    """Returns the cells in a value: members of a structure, elements of a list, the target of a
    pointer.
    """
    if isinstance(value, Struct):
        return list(value.fields.values())
    if isinstance(value, Array):
        return value.items
    return [value.cell] if isinstance(value, Ref) else []


def structures_in(value: Any) -> list[Struct]:
    """Returns a structure, or the structures that a list consists of."""
    values = (
        [sole_value(cell.writes) for cell in value.items] if isinstance(value, Array) else [value]
    )
    return [item for item in values if isinstance(item, Struct)]


def sole_value(value: Value) -> Any:
    """Returns the value if there is only one, otherwise UNKNOWN."""
    if len(value) == 1:
        return value[0].value
    if value and all(are_equal(a.value, value[0].value) for a in value):
        return value[0].value
    return UNKNOWN


def pointee(value: Any) -> Any:
    """Returns the target of a pointer; any other value is returned as is."""
    for _ in range(4):
        if not isinstance(value, Ref):
            return value
        value = sole_value(value.cell.writes)
    return value


def are_equal(left: Any, right: Any, depth: int = 0) -> bool:
    """Returns whether two values are certainly equal."""
    if isinstance(left, Flags) and isinstance(right, Flags):
        return {bit for bit, _ in left.bits} == {bit for bit, _ in right.bits}
    if isinstance(left, ApiObject) and isinstance(right, ApiObject):
        # The same call creates the same object again, when a window is resized, for example.
        return left is right or left.signature() == right.signature()
    if isinstance(left, Unknown) or left is right:
        return left is not UNKNOWN
    if isinstance(left, Struct) and isinstance(right, Struct):
        return bool(left.kind or depth) and _have_equal_members(left, right, depth)
    if isinstance(left, Ref) and isinstance(right, Ref):
        return left == right or (
            left.alias == right.alias and _hold_equal(left.cell, right.cell, depth)
        )
    return (
        not isinstance(left, (Struct, Array)) and type(left) is type(right) and bool(left == right)
    )


MAX_COMPARED = 4
"""The maximum nesting of structures whose members are compared."""


def _have_equal_members(left: Struct, right: Struct, depth: int) -> bool:
    """Returns whether the same code fills two structures with equal values, as a function does that
    is called again.
    """
    same = (
        left.at == right.at
        and left.kind == right.kind
        and left.zeroed == right.zeroed
        and depth < MAX_COMPARED
    )
    return (
        same
        and not isinstance(left, Instance)
        and left.fields.keys() == right.fields.keys()
        and all(_hold_equal(cell, right.fields[name], depth) for name, cell in left.fields.items())
    )


def _hold_equal(left: Cell, right: Cell, depth: int) -> bool:
    """Returns whether two variables hold equal values, or what is unknown of both."""
    if len(left.writes) != len(right.writes) or depth >= MAX_COMPARED:
        return False
    pairs = zip(left.writes, right.writes, strict=True)
    return all(
        (a.value is UNKNOWN and b.value is UNKNOWN and a.at == b.at)
        or are_equal(a.value, b.value, depth + 1)
        for a, b in pairs
    )
