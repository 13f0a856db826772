"""Objects of the classes of a program."""

from __future__ import annotations

from .scope import MEMBER, Scope
from .terms import Term
from .types import element_type
from .values import UNKNOWN_VALUE, Alternative, Array, Cell, Struct, Value, pointee, sole_value
from .variables import Variables


class ClassObjects(Variables):
    """The members of objects of the classes of a program."""

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
                cell.writes = tuple(a for a in cell.writes if a.value is not None and not isinstance(a.value, (bool, float)))
                if known := self.summary.get(f"{self.classes.owner(struct.type, name)}::{name}"):
                    cell.writes = tuple(a for a in cell.writes if self.lasts(a.value)) or known
        return cell

    def initial_value(self, term: Term, scope: Scope) -> Value:
        """Returns the value of a declared member of a new object."""
        _, kind, name, initializer, indirect, _, place = term
        if initializer is None:
            is_scalar = indirect or (
                self.class_of(kind, scope.enclosing) is None and not self.library.structure(kind) and not element_type(kind)
            )
            value = UNKNOWN_VALUE if is_scalar else self.default_value(kind, name, place, scope)
            for alternative in value:
                if isinstance(alternative.value, Array):
                    alternative.value.unset = True
            return value
        value = self.value(initializer, scope, kind)
        return tuple(Alternative(self.stored_value(a.value, kind, name), a.at, a.guards) for a in value)
