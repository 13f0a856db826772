"""The variables and members that expressions refer to."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Any

from msaa_lint.core.text.span import Span

from .aliases import without_aliases
from .classes import Classes, pointed
from .copies import Copier
from .library import Library
from .limits import Work, WorkLimitExceeded
from .scope import MEMBER, Scope
from .terms import CALL, DECLARE, FIELD, INDEX, NAME, TARGET, Term, Unit
from .types import array_size, element_type
from .values import (
    UNKNOWN_VALUE,
    Alternative,
    Array,
    Cell,
    Flags,
    Instance,
    Ref,
    Struct,
    Value,
    pointee,
    sole_value,
)

MAX_KEY = 2000
"""The maximum length of the path of a member; those of longer ones are unknown."""

MAX_NESTING = 4
"""The maximum nesting of structures that are built from their members."""


def _element(kind: str, part: str) -> str:
    """Returns a type, or that of an element if a path has an index."""
    return (element_type(kind) or kind) if "[" in part else kind


class Variables(ABC):
    """The variables and members of one file."""

    def __init__(
        self, unit: Unit, library: Library, fragments: bool, is_cpp: bool, work: Work
    ) -> None:
        self.unit = unit = without_aliases(unit)
        self.library = library
        self.work = work
        self.copies = Copier(work)
        self.fragments = fragments
        """Whether the code consists of fragments of a page, not a whole program."""
        self.is_cpp = is_cpp
        """Whether the code is C++, where arguments may be passed by reference."""
        self.getters = {function.name for function in unit.functions if function.getter}
        self.globals: dict[str, Term] = {}
        for term in unit.outside:
            if term[0] == DECLARE:
                # Conflicting declarations, for example under different preprocessor conditions,
                # make the value unknown.
                before = self.globals.get(term[2])
                again = (
                    before is not None
                    and before[3] is not None
                    and term[3] is not None
                    and before[3][:-1] != term[3][:-1]
                )
                self.globals[term[2]] = (
                    (*term[:3], None, *term[4:]) if again and not fragments else term
                )
        self.classes = Classes(unit)
        self.members = self.classes.members
        self.summary: dict[str, Value] = {}
        """The values of members: the union of what all functions write."""
        self.class_objects: list[Struct] = []
        """The objects of classes that were created."""
        self.object_summary: dict[str, Value] = {}
        """The values of their members."""
        self.consulted: set[str] = set()
        """The members whose summary the current entry point uses, beside those in `initial`."""
        self.overlay: dict[str, Cell] = {}
        """The cells of members in the current entry point."""
        self.held: set[str] = set()
        """The members to which an object of the program is assigned where it is created; their
        members are known by their path.
        """
        self.initial: dict[str, Value] = {}
        """The values of those members before the entry point was executed."""
        self.declared_values: dict[str, Value] = {}
        self.changeable: set[str] = set()
        """The members that are taken to keep their initial value, although other code may change
        it.
        """
        self.initial_reads: dict[Span, str] = {}
        """Where such a value is read, with the assumption in words."""
        self.reading = False
        """Whether the cells of an expression are only read."""
        self.callable_names: set[str] = set()
        """The variables and members to which functions are assigned."""
        self.writers: dict[str, set[Span]] = {}
        """The entry points that write each member."""
        self.entry = Span(0, 0)
        """The current entry point."""
        self.started: dict[str, Array] = {}
        """The lists in members that start empty in the current entry point, because no other one
        writes them.
        """
        self._member_keys: dict[tuple[str, str, str], str] = {}
        self._types_of_keys: dict[str, str] = {}
        self.parts: dict[str, dict[str, None]] = {}
        """The names of members used with each member."""

    @abstractmethod
    def value(self, term: Term, scope: Scope, kind: str = "") -> Value:
        """Returns the possible values of an expression. `kind` is the target type, which braces
        need.
        """

    def sole(self, term: Term, scope: Scope) -> Any:
        """Returns the value of an expression if there is only one, otherwise UNKNOWN."""
        return sole_value(self.value(term, scope))

    def target(self, term: Term, scope: Scope) -> Any:
        """Returns the sole value of an expression; for a pointer, that of its target."""
        return pointee(self.sole(term, scope))

    @abstractmethod
    def call(self, term: Term, scope: Scope) -> Value:
        """Returns the value of a call."""

    def step(self, scope: Scope) -> None:
        """Counts the evaluation of a term, which takes longer under many conditions. Raises
        WorkLimitExceeded.
        """
        work = self.work
        work.left -= 1 + len(scope.guards) // 4
        if work.left < 0:
            raise WorkLimitExceeded

    def unset_element(self, kind: str, place: Span, zeroed: bool) -> Cell:
        """Returns an element of a list that is not initialized."""
        structure = self.library.structure(kind)
        return Cell(
            kind,
            writes=(Alternative(Struct(structure, place, zeroed), place),) if structure else (),
        )

    def lasts(self, value: object) -> bool:
        """Returns whether a variable's initial value is taken as its value: a format, a sample
        count above 1, an object.
        """
        if isinstance(value, str):
            return self.library.is_format(value)
        return (
            value is not None
            and not isinstance(value, (bool, float, Flags))
            and (not isinstance(value, int) or value > 1)
        )

    def stored_value(self, value: Any, kind: str, name: str) -> Any:
        """Returns a value as a variable holds it: structures and lists are copied and take the
        variable's name.
        """
        value = self.copies.value(value)
        if isinstance(value, Instance):
            value.name = value.name or name
        elif isinstance(value, Struct):
            value.kind = value.kind or self.library.structure(kind)
            if not value.kind and not value.type:
                value.type = self.class_of(kind, "") or ""
            value.name = name or value.name
        if isinstance(value, Array):
            value.kind = value.kind or element_type(kind) or ""
            value.name = name or value.name
        return value

    def cell_of(self, term: Term, scope: Scope) -> Cell | None:
        """Returns the cell that an expression refers to, or None if it is unknown."""
        self.step(scope)
        kind = term[0]
        if kind == NAME:
            return self.variable(term[1], scope)
        if kind == FIELD:
            return self.field(term[1], term[2], scope)
        if kind == INDEX:
            return self.indexed(term, scope)
        if kind == TARGET:
            value = self.sole(term[1], scope)
            array = pointee(value)
            if isinstance(array, Array) and array.items:
                return array.items[0]
            return value.cell if isinstance(value, Ref) else self.cell_of(term[1], scope)
        if kind == CALL:
            value = sole_value(self.call(term, scope))
            return value.cell if isinstance(value, Ref) else None
        return None

    @abstractmethod
    def indexed(self, term: Term, scope: Scope) -> Cell | None:
        """Returns the cell of an element of a list, or None if it is unknown."""

    def variable(self, name: str, scope: Scope) -> Cell | None:
        name = name.removeprefix("this->")
        for variables in reversed(scope.scopes):
            if name in variables:
                return variables[name]
        if self.library.constant(name) is not None:
            return None
        if (
            scope.this_object is not None
            and self.classes.member(scope.class_name, name) is not None
        ):
            return self.own_member(name, scope.this_object, scope)
        return self.member_cell(self.member_key(name, scope))

    @abstractmethod
    def own_member(self, name: str, this_object: Cell, scope: Scope) -> Cell:
        """Returns a member of the object whose method is executed."""

    @abstractmethod
    def member_of(self, struct: Struct, name: str) -> Cell:
        """Returns a member of an object, with its initial value if it was not used before."""

    def class_member(self, class_name: str, name: str) -> Cell:
        """Returns a member of an unknown object of a class."""
        return self.member_cell(f"{self.classes.owner(class_name, name)}::{name}")

    def new_object(self, class_name: str, place: Span, name: str = "") -> Struct:
        """Returns a new object of a class."""
        struct = Struct("", place, False, name)
        struct.type = class_name
        if class_name:
            self.class_objects.append(struct)
        return struct

    def type_of(self, cell: Cell) -> str:
        """Returns the declared type of a variable or member, or an empty string."""
        return self.type_of_key(cell.name) if cell.kind == MEMBER else cell.kind

    def type_of_key(self, key: str) -> str:
        """Returns the declared type of a member by its path, or an empty string."""
        if key not in self._types_of_keys:
            self._types_of_keys[key] = self._type_of_key(key)
        return self._types_of_keys[key]

    def _type_of_key(self, key: str) -> str:
        first, *rest = key.split(".")
        name = first.partition("[")[0]
        class_name, _, short = name.rpartition("::")
        term = (
            self.classes.member(class_name, short)
            if class_name
            else self.globals.get(name.removeprefix("::"))
        )
        term = term or self.globals.get(name.removeprefix("::"))
        kind = _element(str(term[1]), first) if term is not None else ""
        for part in rest:
            owner = self.class_of(kind, class_name) if kind else None
            term = self.classes.member(owner, part.partition("[")[0]) if owner is not None else None
            if term is None:
                return ""
            kind = _element(str(term[1]), part)
        return kind

    def member_key(self, name: str, scope: Scope) -> str:
        """Returns the key of a name that is not a local variable: a class member or a global
        variable.
        """
        key = (name, scope.namespace, scope.class_name)
        if key not in self._member_keys:
            self._member_keys[key] = self._member_key(name, scope)
        return self._member_keys[key]

    def _member_key(self, name: str, scope: Scope) -> str:
        first, _, rest = name.partition("::")
        if rest and first in self.unit.aliases:
            name = f"{self.unit.aliases[first]}::{rest}"
        qualifier, _, short = name.rpartition("::")
        owner = self.class_of(qualifier, scope.enclosing) if qualifier else None
        if owner is not None and self.classes.member(owner, short) is not None:
            return f"{self.classes.owner(owner, short)}::{short}"
        namespace = scope.namespace
        while True:
            if (
                namespace + name in self.globals
                and self.classes.member(scope.class_name, name) is None
            ):
                return f"::{namespace}{name}"
            if not namespace:
                break
            namespace = namespace[:-2].rpartition("::")[0]
            namespace += "::" if namespace else ""
        in_class = scope.class_name and not self.fragments
        return (
            f"{self.classes.owner(scope.class_name, short)}::{short}" if in_class else f"::{short}"
        )

    def member_cell(self, key: str) -> Cell:
        """Returns the cell of a member of an object by its path."""
        cell = self.overlay.get(key)
        if cell is None and len(key) > MAX_KEY:
            return Cell()
        if cell is None:
            cell = self.overlay[key] = Cell(MEMBER, key, (), key)
            owner, _, name = key.rpartition(".")
            if owner and "[" not in name:
                self.parts.setdefault(owner, {})[name] = None
            if self.writers.get(key) == {self.entry} and (started := self.started_list(cell)):
                cell.writes, self.initial[key] = started, UNKNOWN_VALUE
                return cell
            writes = self.summary.get(key) or self.object_summary.get(key) or self.declared(key)
            if len(writes) > 1:
                # The first is the value where none of the others is.
                others = (
                    Alternative(w.value, w.at, w.guards | {(f"{key}={n}", True)})
                    for n, w in enumerate(writes[1:], 1)
                )
                writes = (writes[0], *others)
            cell.writes = self.initial[key] = writes
        return cell

    def started_list(self, cell: Cell) -> Value:
        """Returns an empty list for a member that is one, and that the current entry point fills;
        nothing for other members.
        """
        kind = element_type(self.type_of_key(cell.key))
        if kind is None or array_size(self.type_of_key(cell.key)) or self.declared(cell.key):
            return UNKNOWN_VALUE
        array = self.started[cell.key] = Array(
            kind, self.entry, self.writers.get(cell.key, {self.entry}) == {self.entry}
        )
        array.name = cell.key.rpartition("::")[2].rpartition(".")[2]
        return (Alternative(array, self.entry),)

    def summary_of(self, key: str) -> Value:
        """Returns what entry points write to a member."""
        self.consulted.add(key)
        return self.summary.get(key, UNKNOWN_VALUE)

    def is_held(self, cell: Cell) -> bool:
        """Returns whether the object that a member points to is the one that is created for it."""
        return cell.name in self.held and all(write.value is None for write in cell.writes)

    def part_of_member(self, cell: Cell, name: str) -> Cell:
        """Returns a member of the object that a member is, or that it points to."""
        owner = "" if self.is_held(cell) else self.pointed_class(cell.name)
        return self.member_cell(f"{owner or cell.name + '.'}{name}")

    def names_of(self, key: str) -> tuple[str, ...]:
        """Returns the names of the members that are used with a key."""
        return tuple(self.parts.get(key.removesuffix("."), ()))

    def member_of_object(
        self, value: Any, cell: Cell, name: str, place: Span, scope: Scope
    ) -> Cell | None:
        """Returns a member of an object of the API; None for other values. `cell` holds the value,
        or what is unknown.
        """
        return value.cell(name) if isinstance(value, Instance) else None

    def typed_value(self, kind: str, name: str, place: Span) -> Value:
        """Returns what is known of a variable of unknown value by its type."""
        return UNKNOWN_VALUE

    def gathered_struct(self, key: str, place: Span, depth: int = 0) -> Value:
        """Returns an undeclared structure built from the members that are written, and from
        theirs.
        """
        names = self.parts.get(key)
        if not names or depth > MAX_NESTING:
            return UNKNOWN_VALUE
        struct = Struct("", place, False, key.rpartition("::")[2])
        for name in names:
            cell = self.member_cell(f"{key}.{name}")
            inner = () if cell.writes else self.gathered_struct(cell.name, place, depth + 1)
            struct.fields[name] = Cell(MEMBER, cell.name, inner, cell.key) if inner else cell
        return (Alternative(struct, place),)

    def declared(self, key: str) -> Value:
        """Returns the initial value of a class member or a global variable."""
        owner, _, name = key.rpartition(".")
        if key not in self.declared_values:
            self.declared_values[key] = UNKNOWN_VALUE
        elif not owner:
            return self.declared_values[key]
        if owner:
            # What is written to it through other objects of its class.
            parent = self.class_of(self.type_of_key(owner), "")
            key_of_class = (
                f"{self.classes.owner(parent, name)}::{name}" if parent is not None else ""
            )
            return (
                (self.summary_of(key_of_class) or self.declared(key_of_class))
                if key_of_class
                else UNKNOWN_VALUE
            )
        class_name, _, name = key.rpartition("::")
        term = self.members.get(class_name, {}).get(name) if class_name else self.globals.get(name)
        if key.startswith("::"):
            class_name, term = "", self.globals.get(key[2:])
        elif term is None or term[3] is None:
            # A static member is defined outside of its class.
            term = self.globals.get(key, term)
        if term is None:
            return UNKNOWN_VALUE
        _, kind, name, initializer, indirect, fixed, place = term
        name = name.rpartition("::")[2]
        if initializer is not None:
            namespace = (class_name or key[2:]).rpartition("::")[0]
            value = self.value(
                initializer, Scope(class_name, f"{namespace}::" if namespace else ""), kind
            )
            lasting = [
                a
                for a in value
                if not (isinstance(a.value, Struct) and not a.value.kind and not a.value.fields)
            ]
            if not fixed:
                # Other code may change the value; discard values that are typical placeholders: one
                # sample, null, false, an operation. Any code may change a public member.
                lasting = [
                    a
                    for a in lasting
                    if self.lasts(a.value) and (key not in self.unit.visible or key in self.globals)
                ]
                self.changeable.add(key)
            self.declared_values[key] = tuple(
                Alternative(self.stored_value(a.value, kind, name), a.at, a.guards) for a in lasting
            )
        elif value := self.typed_value(kind, name, place):
            self.declared_values[key] = value
        elif (
            not indirect
            and not class_name
            and (self.library.structure(kind) or self.library.structure(element_type(kind) or ""))
        ):
            # Global variables are zero-initialized.
            self.declared_values[key] = self.default_value(kind, name, place, Scope(), zeroed=True)
        return self.declared_values[key]

    @abstractmethod
    def field(self, operand: Term, name: str, scope: Scope) -> Cell | None:
        """Returns the cell of a member of an object, or None if it is unknown."""

    @abstractmethod
    def class_of_term(self, term: Term, scope: Scope) -> str | None:
        """Returns the class of the object that an expression is or points to, by its declaration,
        or None.
        """

    def class_of(self, kind: str, namespace: str) -> str | None:
        """Returns the class in the program that a type refers to, or None."""
        return self.classes.of_type(kind, namespace)

    def pointed_class(self, key: str) -> str:
        """Returns the class, with a trailing `::`, that a pointer member refers to; which object it
        points to is unknown.
        """
        class_name, _, name = key.rpartition("::")
        kind = self.type_of_key(key)
        term = self.classes.member(class_name, name) if class_name else self.globals.get(name)
        if not kind or not ((term is not None and term[4]) or pointed(kind) != kind):
            return ""
        target = self.class_of(kind, class_name)
        return f"{target}::" if target is not None else ""

    @abstractmethod
    def default_value(
        self, kind: str, name: str, place: Span, scope: Scope, zeroed: bool = False
    ) -> Value:
        """Returns the value of a variable without an initializer. vulkan.hpp structures have
        default constructors.
        """
