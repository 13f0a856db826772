"""Objects of the classes of a program."""

from __future__ import annotations

from typing import Any

from msaa_lint.core.text.span import Span

from .classes import pointed
from .scope import MEMBER, Scope
from .terms import CALL, FIELD, INDEX, NAME, Term, at
from .types import array_size, element_type
from .values import (
    UNKNOWN_VALUE,
    Alternative,
    Array,
    Cell,
    Ref,
    SplitCell,
    Struct,
    Value,
    pointee,
    sole_value,
)
from .variables import Variables


class ClassObjects(Variables):
    """The members of objects of the classes of a program."""

    def field(self, operand: Term, name: str, scope: Scope) -> Cell | None:
        name = self.library.member(name)
        if operand[0] == NAME and operand[1] in ("this", "self"):
            if scope.this_object is not None:
                return self.own_member(name, scope.this_object, scope)
            return self.member_cell(self.member_key(name, scope))
        cell = self.object_cell(operand, scope)
        if cell is None:
            class_name = self.class_of_term(operand, scope)
            return self.class_member(class_name, name) if class_name is not None else None
        if isinstance(cell, SplitCell):
            structs = [
                (pointee(sole_value(part.read(scope.guards))), guards)
                for part, guards in cell.parts
            ]
            members = [
                (self.member_of(struct, name), guards)
                for struct, guards in structs
                if isinstance(struct, Struct)
            ]
            if len(members) < len(structs) and cell.kind == MEMBER:
                members = [(self.part_of_member(part, name), guards) for part, guards in cell.parts]
            return SplitCell(members) if len(members) == len(structs) else None
        value = self.object_in(cell, scope)
        member = self.member_of_object(value, cell, name, at(operand), scope)
        if member is not None:
            return member
        if isinstance(value, Struct):
            return self.member_of(value, name)
        if cell.kind == MEMBER:
            return self.part_of_member(cell, name)
        if (target := self.pointed_member(cell, scope)) is not None:
            return self.part_of_member(target, name)
        if cell.writes:
            class_name = self.class_of_term(operand, scope)
            return self.class_member(class_name, name) if class_name is not None else None
        elsewhere = bool(cell.key) or cell.kind.endswith("*")
        if elsewhere and not self.library.structure(cell.kind):
            kind = cell.kind.rstrip("*&")
            return self.class_member(self.class_of(kind, scope.enclosing) or kind, name)
        struct = Struct(
            self.library.structure(cell.kind),
            Span(0, 0) if elsewhere else at(operand),
            False,
            cell.name,
        )
        cell.writes = (Alternative(struct, struct.at),)
        return struct.cell(name)

    @staticmethod
    def pointed_member(cell: Cell, scope: Scope) -> Cell | None:
        """Returns the member or global variable that a pointer certainly points to, or None."""
        for _ in range(4):
            content = sole_value(cell.read(scope.guards))
            if not isinstance(content, Ref):
                return None
            cell = content.cell
            if cell.kind == MEMBER and not cell.writes:
                return cell
        return None

    def object_cell(self, operand: Term, scope: Scope) -> Cell | None:
        """Returns the cell of the object that an expression is or points to, or None if it is
        unknown.
        """
        if operand[0] in (NAME, FIELD, INDEX):
            return self.cell_of(operand, scope)
        content = (
            sole_value(self.call(operand, scope))
            if operand[0] == CALL
            else self.sole(operand, scope)
        )
        if isinstance(content, Ref):
            return content.cell
        return (
            Cell(writes=(Alternative(content, at(operand)),))
            if isinstance(content, (Struct, Array))
            else None
        )

    def object_in(self, cell: Cell, scope: Scope) -> Any:
        """Returns the structure, or the other value, in a cell. Alternative structures are merged,
        so that they are changed together.
        """
        content = cell.read(scope.guards)
        value = pointee(sole_value(content))
        if len(content) > 1 and all(isinstance(a.value, Struct) for a in content):
            value = self.copies.merged(content)
            cell.writes = (Alternative(value, content[0].at),)
        if isinstance(value, Array) and value.items:
            # A pointer to the first element of a list.
            value = pointee(sole_value(value.items[0].writes))
        return value

    def own_member(self, name: str, this_object: Cell, scope: Scope) -> Cell:
        """Returns a member of the object whose method is executed."""
        value = pointee(sole_value(this_object.read(scope.guards)))
        if isinstance(value, Struct):
            return self.member_of(value, name)
        if this_object.kind == MEMBER:
            return self.part_of_member(this_object, name)
        return self.class_member(scope.class_name, name)

    def member_of(self, struct: Struct, name: str) -> Cell:
        """Returns a member of an object, with its initial value if it was not used before."""
        cell = struct.fields.get(name)
        if cell is not None or not struct.type:
            return cell if cell is not None else struct.cell(name)
        term = self.classes.member(struct.type, name)
        cell = struct.cell(name)
        if term is not None:
            cell.kind = term[1]
            scope = Scope(struct.type, self.classes.namespace(struct.type))
            scope.this_object = Cell(struct.type, "", (Alternative(struct, struct.at),))
            cell.writes = self.initial_value(term, scope)
            if struct.type in self.classes.with_methods:
                # Methods that are not understood may change it: callbacks of events, for example.
                cell.writes = tuple(
                    a
                    for a in cell.writes
                    if a.value is not None and not isinstance(a.value, (bool, float))
                )
                if known := self.summary_of(f"{self.classes.owner(struct.type, name)}::{name}"):
                    cell.writes = tuple(a for a in cell.writes if self.lasts(a.value)) or known
        return cell

    def initial_value(self, term: Term, scope: Scope) -> Value:
        """Returns the value of a declared member of a new object."""
        _, kind, name, initializer, indirect, _, place = term
        if initializer is None:
            is_scalar = indirect or (
                self.class_of(kind, scope.enclosing) is None
                and not self.library.structure(kind)
                and not element_type(kind)
            )
            value = UNKNOWN_VALUE if is_scalar else self.default_value(kind, name, place, scope)
            for alternative in value:
                if isinstance(alternative.value, Array):
                    alternative.value.unset = True
            return value
        value = self.value(initializer, scope, kind)
        return tuple(
            Alternative(self.stored_value(a.value, kind, name), a.at, a.guards) for a in value
        )

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

    def default_value(
        self, kind: str, name: str, place: Span, scope: Scope, zeroed: bool = False
    ) -> Value:
        """Returns the value of a variable without an initializer. vulkan.hpp structures have
        default constructors.
        """
        struct_name = self.library.structure(kind)
        if struct_name:
            return (
                Alternative(
                    Struct(struct_name, place, zeroed or kind.startswith("vk::"), name), place
                ),
            )
        inner = element_type(kind)
        if inner is not None:
            array = Array(inner, place)
            array.name, array.zeroed = name, zeroed
            self.fill_array(array, kind, scope)
            return (Alternative(array, place),)
        class_name = self.class_of(kind, scope.enclosing) if pointed(kind) == kind else None
        if class_name is not None or (kind[:1].isupper() and not self.library.is_type(kind)):
            return (Alternative(self.new_object(class_name or "", place, name), place),)
        return UNKNOWN_VALUE
