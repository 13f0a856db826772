"""Objects of the classes of a program, and copies of descriptors."""

from __future__ import annotations

from collections.abc import Sequence

from msaa_lint.core.text.span import Span
from msaa_lint.input.code.core.guards import ALWAYS
from msaa_lint.input.code.core.lists import Receiver
from msaa_lint.input.code.core.scope import Scope
from msaa_lint.input.code.core.terms import NAME, Function, Term, labeled
from msaa_lint.input.code.core.values import (
    Alternative,
    Cell,
    Instance,
    Struct,
    Value,
    pointee,
    sole_value,
)

from .names import kind_of
from .objects import MetalObjects


class MetalInstances(MetalObjects):
    """Creates objects by the classes of a program or from other objects."""

    def begin(self) -> None:
        super().begin()
        self.used: set[str] = set()
        """The keys of descriptors that calls take."""

    def copy_of(self, original: Instance, place: Span, scope: Scope) -> Value:
        """Returns a copy of a descriptor and its attachments."""
        copy = self.construct_object(original.kind, place, scope)
        instance: Instance = copy[0].value
        instance.complete = original.complete
        self.used.add(original.key)
        self.copy_members(original, instance, place)
        return copy

    def copy_members(self, original: Instance, copy: Instance, place: Span) -> None:
        for name, cell in original.fields.items():
            self.work.spend()
            inner = sole_value(cell.writes)
            if isinstance(inner, Instance) and inner.kind == "attachment":
                target = sole_value(self.slot(copy, name, place).writes)
                if target is not inner:
                    self.copy_members(inner, target, place)
            else:
                copy.cell(name).writes = cell.writes

    def class_object(
        self,
        class_name: str,
        arguments: Sequence[Term],
        values: Sequence[Value],
        place: Span,
        scope: Scope,
    ) -> Value:
        """Returns an object of a class of the program: its members, where its arguments are labeled
        with them.
        """
        members = self.members.get(class_name, {})
        labels = [labeled(argument)[0] for argument in arguments]
        if not labels or not all(label in members for label in labels):
            return self.of_class(class_name, place)
        struct = Struct("", place)
        for label, value in zip(labels, values, strict=True):
            struct.cell(label).write(value, place, ALWAYS)
            self.member_cell(f"{class_name}::{label}").write(value, place, scope.guards)
        return (Alternative(struct, place),)

    def find_function(
        self,
        name: str,
        arguments: Sequence[Term],
        function: Term,
        receiver: Receiver | None,
        scope: Scope,
    ) -> Function | None:
        # An initializer that an extension adds to a descriptor is called for a new one.
        constructs = function[0] == NAME and bool(kind_of(str(function[1])))
        return (
            None
            if constructs
            else super().find_function(name, arguments, function, receiver, scope)
        )

    def construct_class(self, kind: str, term: Term, scope: Scope) -> Value | None:
        """Returns an object of a class of the program after its constructor; None where there is
        none, or several match.
        """
        # An extension of a descriptor is not a class of the program.
        class_name = None if kind_of(kind) else self.class_of(kind, scope.enclosing)
        if class_name is None and not kind_of(kind):
            return None
        owner = class_name or kind
        short = owner.rpartition("::")[2]
        group = self.functions.of_class(short, len(term[2]), owner).of_labels(
            [labeled(argument)[0] for argument in term[2]]
        )
        if len(group.every) != 1:
            return None
        value = (
            self.construct_object(kind_of(kind), term[3], scope)
            if class_name is None
            else self.of_class(owner, term[3])
        )
        if self.may_follow(group.every[0], term[3], scope):
            self.call_function(group.every[0], term, scope, Cell(owner, "", value))
        return value

    def own_member(self, name: str, this_object: Cell, scope: Scope) -> Cell:
        """Returns a member of the object whose method is executed: all objects of a class are taken
        for one.
        """
        value = pointee(sole_value(this_object.read(scope.guards)))
        return (
            value.cell(name)
            if isinstance(value, Struct)
            else self.member_cell(f"{scope.class_name}::{name}")
        )
