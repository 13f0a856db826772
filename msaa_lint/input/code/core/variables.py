"""The variables and members that expressions refer to."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Any

from msaa_lint.core.text.span import Span

from .library import Library
from .limits import Work
from .scope import MEMBER, Scope
from .terms import CALL, DECLARE, FIELD, INDEX, NAME, TARGET, Term, Unit, at
from .types import array_size, element_type
from .values import UNKNOWN_VALUE, Alternative, Array, Cell, Copier, Flags, Instance, Ref, Struct, Value, pointee, sole_value

MAX_KEY = 2000
"""The maximum length of the path of a member; those of longer ones are unknown."""


def is_element_access(term: Term) -> bool:
    """Returns whether an expression calls a method that returns a reference to an element of a list."""
    return bool(term[0] == CALL and term[1][0] == FIELD and term[1][2] in ("front", "back", "at"))


class Variables(ABC):
    """The variables and members of one file."""

    def __init__(self, unit: Unit, library: Library, fragments: bool, is_cpp: bool, work: Work) -> None:
        self.unit = unit
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
                # Conflicting declarations, for example under different preprocessor conditions, make the value unknown.
                before = self.globals.get(term[2])
                again = before is not None and before[3] is not None and term[3] is not None and before[3][:-1] != term[3][:-1]
                self.globals[term[2]] = (*term[:3], None, *term[4:]) if again and not fragments else term
        self.members = {name: {term[2]: term for term in terms if term[0] == DECLARE} for name, terms in unit.members.items()}
        self.summary: dict[str, Value] = {}
        """The values of members: the union of what all functions write."""
        self.overlay: dict[str, Cell] = {}
        """The cells of members in the current entry point."""
        self.initial: dict[str, Value] = {}
        """The values of those members before the entry point was executed."""
        self.declared_values: dict[str, Value] = {}
        self.changeable: set[str] = set()
        """The members that are taken to keep their initial value, although other code may change it."""
        self.initial_reads: dict[Span, str] = {}
        """Where such a value is read, with the assumption in words."""
        self.parts: dict[str, dict[str, None]] = {}
        """The names of members used with each member."""
        self._classes: dict[str, list[str]] = {}
        """The classes by the last part of their names."""
        for name in self.members:
            self._classes.setdefault(name.rpartition("::")[2], []).append(name)

    @abstractmethod
    def value(self, term: Term, scope: Scope, kind: str = "") -> Value:
        """Returns the possible values of an expression. `kind` is the target type, which braces need."""

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
        """Counts the evaluation of a term, which takes longer under many conditions. Raises WorkLimitExceeded."""
        self.work.spend(1 + len(scope.guards) // 4)

    def unset_element(self, kind: str, place: Span, zeroed: bool) -> Cell:
        """Returns an element of a list that is not initialized."""
        structure = self.library.structure(kind)
        return Cell(kind, writes=(Alternative(Struct(structure, place, zeroed), place),) if structure else ())

    def lasts(self, value: object) -> bool:
        """Returns whether a variable's initial value is taken as its value: a format, a sample count above 1, an object."""
        if isinstance(value, str):
            return self.library.is_format(value)
        return value is not None and not isinstance(value, (bool, float, Flags)) and (not isinstance(value, int) or value > 1)

    def stored_value(self, value: Any, kind: str, name: str) -> Any:
        """Returns a value as a variable holds it: structures and lists are copied and take the variable's name."""
        value = self.copies.value(value)
        if isinstance(value, Instance):
            value.name = value.name or name
        elif isinstance(value, Struct):
            value.kind = value.kind or self.library.structure(kind)
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

    def variable(self, name: str, scope: Scope) -> Cell | None:
        name = name.removeprefix("this->")
        for variables in reversed(scope.scopes):
            if name in variables:
                return variables[name]
        if self.library.constant(name) is not None:
            return None
        if scope.this_object is not None and name in self.members.get(scope.class_name, ()):
            return self.own_member(name, scope.this_object, scope)
        return self.member_cell(self.member_key(name, scope))

    def own_member(self, name: str, this_object: Cell, scope: Scope) -> Cell:
        """Returns a member of the object whose method is executed."""
        value = pointee(sole_value(this_object.read(scope.guards)))
        if isinstance(value, Struct):
            return value.cell(name)
        if this_object.kind == MEMBER:
            return self.member_cell(f"{self.pointed_class(this_object.name) or this_object.name + '.'}{name}")
        return self.member_cell(f"{scope.class_name}::{name}")

    def type_of(self, cell: Cell) -> str:
        """Returns the declared type of a variable or member, or an empty string."""
        if cell.kind != MEMBER:
            return cell.kind
        class_name, _, name = cell.name.rpartition("::")
        term = self.members.get(class_name, {}).get(name) if class_name else self.globals.get(name)
        return str(term[1]) if term is not None else ""

    def member_key(self, name: str, scope: Scope) -> str:
        """Returns the key of a name that is not a local variable: a class member or a global variable."""
        namespace = scope.namespace
        while True:
            if namespace + name in self.globals and name not in self.members.get(scope.class_name, ()):
                return f"::{namespace}{name}"
            if not namespace:
                break
            namespace = namespace[:-2].rpartition("::")[0]
            namespace += "::" if namespace else ""
        short = name.rpartition("::")[2]
        return f"{scope.class_name}::{short}" if scope.class_name and not self.fragments else f"::{short}"

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
            writes = self.summary.get(key) or self.declared(key)
            if len(writes) > 1:
                writes = tuple(Alternative(w.value, w.at, w.guards | {(f"{key}={n}", True)}) for n, w in enumerate(writes))
            cell.writes = self.initial[key] = writes
        return cell

    def names_of(self, key: str) -> tuple[str, ...]:
        """Returns the names of the members that are used with a key."""
        return tuple(self.parts.get(key.removesuffix("."), ()))

    def member_of_object(self, value: Any, cell: Cell, name: str, place: Span, scope: Scope) -> Cell | None:
        """Returns a member of an object of the API; None for other values. `cell` holds the value, or what is unknown."""
        return value.cell(name) if isinstance(value, Instance) else None

    def element_of_object(self, value: Any, index: Any, place: Span) -> Cell | None:
        """Returns an element of an object of the API; None for other values."""
        return None

    def typed_value(self, kind: str, name: str, place: Span) -> Value:
        """Returns what is known of a variable of unknown value by its type."""
        return UNKNOWN_VALUE

    def gathered_struct(self, key: str, place: Span) -> Value:
        """Returns an undeclared structure built from the members that are written."""
        names = self.parts.get(key)
        if not names:
            return UNKNOWN_VALUE
        struct = Struct("", place, False, key.rpartition("::")[2])
        for name in names:
            struct.fields[name] = self.member_cell(f"{key}.{name}")
        return (Alternative(struct, place),)

    def declared(self, key: str) -> Value:
        """Returns the initial value of a class member or a global variable."""
        if key in self.declared_values:
            return self.declared_values[key]
        self.declared_values[key] = UNKNOWN_VALUE
        if key.startswith("::"):
            class_name, term = "", self.globals.get(key[2:])
        else:
            class_name, _, name = key.rpartition("::")
            term = self.members.get(class_name, {}).get(name)
        if term is None:
            return UNKNOWN_VALUE
        _, kind, name, initializer, indirect, fixed, place = term
        name = name.rpartition("::")[2]
        if initializer is not None:
            namespace = (class_name or key[2:]).rpartition("::")[0]
            value = self.value(initializer, Scope(class_name, f"{namespace}::" if namespace else ""), kind)
            lasting = [a for a in value if not (isinstance(a.value, Struct) and not a.value.kind and not a.value.fields)]
            if not fixed:
                # Other code may change the value; discard values that are typical placeholders: one sample, null, false, an operation.
                lasting = [a for a in lasting if self.lasts(a.value)]
                self.changeable.add(key)
            self.declared_values[key] = tuple(Alternative(self.stored_value(a.value, kind, name), a.at, a.guards) for a in lasting)
        elif value := self.typed_value(kind, name, place):
            self.declared_values[key] = value
        elif not indirect and not class_name and (self.library.structure(kind) or self.library.structure(element_type(kind) or "")):
            # Global variables are zero-initialized.
            self.declared_values[key] = self.default_value(kind, name, place, Scope(), zeroed=True)
        return self.declared_values[key]

    def field(self, operand: Term, name: str, scope: Scope) -> Cell | None:
        name = self.library.member(name)
        if operand[0] == NAME and operand[1] in ("this", "self"):
            if scope.this_object is not None:
                return self.own_member(name, scope.this_object, scope)
            return self.member_cell(self.member_key(name, scope))
        if operand[0] in (NAME, FIELD, INDEX):
            cell = self.cell_of(operand, scope)
            if cell is None:
                return None
        else:
            content = self.sole(operand, scope)
            if not isinstance(content, Ref):
                member = self.member_of_object(content, Cell(), name, at(operand), scope)
                if member is not None:
                    return member
                return content.cell(name) if isinstance(content, Struct) else None
            cell = content.cell
        value = pointee(sole_value(cell.read(scope.guards)))
        member = self.member_of_object(value, cell, name, at(operand), scope)
        if member is not None:
            return member
        if isinstance(value, Array) and value.items:
            # A pointer to the first element of a list.
            value = pointee(sole_value(value.items[0].writes))
        if isinstance(value, Struct):
            return value.cell(name)
        if cell.kind == MEMBER:
            return self.member_cell(f"{self.pointed_class(cell.name) or cell.name + '.'}{name}")
        if cell.writes:
            return None
        elsewhere = bool(cell.key) or cell.kind.endswith("*")
        if elsewhere and not self.library.structure(cell.kind):
            kind = cell.kind.rstrip("*&")
            return self.member_cell(f"{self.class_of(kind, scope.namespace) or kind}::{name}")
        struct = Struct(self.library.structure(cell.kind), Span(0, 0) if elsewhere else at(operand), False, cell.name)
        cell.writes = (Alternative(struct, struct.at),)
        return struct.cell(name)

    def class_of(self, kind: str, namespace: str) -> str | None:
        """Returns the class in the file that a type refers to, or None."""
        if f"{namespace}{kind}" in self.members:
            return f"{namespace}{kind}"
        if kind in self.members:
            return kind
        classes = self._classes.get(kind.rpartition("::")[2], ())
        return classes[0] if len(classes) == 1 else None

    def pointed_class(self, key: str) -> str:
        """Returns the class, with a trailing `::`, that a pointer member refers to; which object it points to is unknown."""
        class_name, _, name = key.rpartition("::")
        term = self.members.get(class_name, {}).get(name)
        if term is None or not term[4]:
            return ""
        target = self.class_of(term[1], class_name.rpartition("::")[0])
        return f"{target}::" if target is not None else ""

    def indexed(self, term: Term, scope: Scope) -> Cell | None:
        cell = self.cell_of(term[1], scope)
        index = self.sole(term[2], scope)
        if cell is None:
            return None
        value = pointee(sole_value(cell.read(scope.guards)))
        element = self.element_of_object(value, index, term[-1])
        if element is not None:
            return element
        if isinstance(value, Array):
            if type(index) is not int or not 0 <= index < 64:
                value.complete = False
                return Cell()
            while len(value.items) <= index:
                value.items.append(self.unset_element(value.kind, term[-1], value.zeroed))
            return value.items[index]
        if cell.kind == MEMBER:
            return self.member_cell(f"{cell.name}[{index}]" if type(index) is int else f"{cell.name}[]")
        if isinstance(value, Struct) and index == 0:
            return cell
        return None

    def fill_array(self, array: Array, kind: str, scope: Scope) -> None:
        """Adds elements to an array up to the size of its type."""
        size = array_size(kind)
        if not size:
            return
        count = int(size[:9]) if size.isdecimal() else self.sole((NAME, size, array.at), scope)
        if type(count) is not int or not 0 <= count <= 64:
            array.complete = False
            return
        while len(array.items) < count:
            array.items.append(self.unset_element(array.kind, array.at, array.zeroed))

    def default_value(self, kind: str, name: str, place: Span, scope: Scope, zeroed: bool = False) -> Value:
        """Returns the value of a variable without an initializer. vulkan.hpp structures have default constructors."""
        struct_name = self.library.structure(kind)
        if struct_name:
            return (Alternative(Struct(struct_name, place, zeroed or kind.startswith("vk::"), name), place),)
        inner = element_type(kind)
        if inner is not None:
            array = Array(inner, place)
            array.name, array.zeroed = name, zeroed
            self.fill_array(array, kind, scope)
            return (Alternative(array, place),)
        if kind[:1].isupper() and not self.library.is_type(kind):
            return (Alternative(Struct("", place, False, name), place),)
        return UNKNOWN_VALUE
