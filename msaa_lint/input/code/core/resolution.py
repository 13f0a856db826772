"""The functions that calls refer to."""

from __future__ import annotations

from collections.abc import Sequence

from .aliases import resolved
from .library import Library
from .limits import Work
from .lists import ListMethods, Receiver
from .overloads import Overloads, matches
from .scope import MEMBER, Scope
from .terms import CALL, FIELD, INDEX, LABEL, LITERAL, NAME, Function, Term, Unit, labeled
from .values import Array, Cell, Instance, Ref, Routine, Struct, pointee, sole_value


class Resolution(ListMethods):
    """Determines the functions of the program that calls refer to."""

    def __init__(
        self, unit: Unit, library: Library, fragments: bool, is_cpp: bool, work: Work
    ) -> None:
        super().__init__(unit, library, fragments, is_cpp, work)
        self.functions = Overloads(unit.functions)

    def free_functions(self, name: str, count: int) -> Sequence[Function]:
        return self.functions.of_class(name, count, "").every

    def routine(self, name: str, scope: Scope) -> Routine | None:
        """Returns the function outside of classes that a name stands for as a value, or None."""
        if name not in self.functions.free or any(name in variables for variables in scope.scopes):
            return None
        return Routine(self.functions.free[name])

    def received(self, owner: Term, scope: Scope) -> Receiver:
        """Returns what a method is called on."""
        if owner[:2] == (NAME, "this"):
            cell = scope.this_object
            return Receiver(owner, cell, cell.read(scope.guards) if cell is not None else ())
        if owner[0] in (NAME, FIELD, INDEX):
            cell = self.cell_of(owner, scope)
            return Receiver(owner, cell, cell.read(scope.guards) if cell is not None else ())
        value = self.call(owner, scope) if owner[0] == CALL else self.value(owner, scope)
        known = sole_value(value)
        if isinstance(known, Ref):
            return Receiver(owner, known.cell, known.cell.read(scope.guards))
        return Receiver(owner, Cell(writes=value) if isinstance(known, Struct) else None, value)

    def find_function(
        self,
        name: str,
        arguments: Sequence[Term],
        function: Term,
        receiver: Receiver | None,
        scope: Scope,
    ) -> Function | None:
        """Returns the only function of the program that a call can refer to, or None."""
        count = len(arguments)
        self.work.spend(1 + len(self.functions.of_count(name, count).every) // 16)
        group = self.functions.of_count(name, count).of_labels(
            [labeled(argument)[0] for argument in arguments]
        )
        if not group.every:
            return None
        if self.fragments:
            return group.fixed[-1] if group.fixed else None
        if receiver is not None:
            return self.find_method(name, arguments, receiver, scope)
        qualifier = (
            resolved(str(function[1]).rpartition("::")[0], self.unit.aliases)
            if function[0] == NAME
            else ""
        )
        if qualifier:
            owner = self.class_of(qualifier, scope.enclosing)
            if owner is not None and (methods := self.taking(self.methods(owner, name), arguments)):
                return self.matching(methods, arguments, scope)
            self.work.spend(1 + len(group.every) // 16)
            named = [
                f
                for f in group.every
                if (f.class_name or f.namespace.rstrip(":")).endswith(qualifier)
            ]
            return self.matching(named, arguments, scope)
        if scope.class_name and (
            methods := self.taking(self.methods(scope.object_class, name), arguments)
        ):
            return self.dispatched(methods, scope.object_class, scope.this_object, arguments, scope)
        free = self.taking(
            self.functions.of_scope(name, count, "", scope.namespace).every
            or self.free_functions(name, count),
            arguments,
        )
        # Swift's `.target(...)` is a method of the type that is expected.
        return self.matching(free, arguments, scope) if free or self.is_cpp else group.sole()

    def find_method(
        self, name: str, arguments: Sequence[Term], receiver: Receiver, scope: Scope
    ) -> Function | None:
        count = len(arguments)
        known = pointee(sole_value(receiver.content))
        if isinstance(known, Array):
            return None
        class_name = known.type if isinstance(known, Struct) else ""
        declared = class_name or self.class_of_term(receiver.owner, scope)
        if declared:
            methods = self.taking(self.methods(declared, name), arguments)
            return self.dispatched(methods, declared, receiver.cell, arguments, scope)
        if isinstance(known, Struct) and known.kind and not isinstance(known, Instance):
            return None
        methods = self.taking(
            [f for f in self.functions.of_count(name, count).every if f.class_name], arguments
        )
        return (
            self.matching(methods, arguments, scope)
            if len({f.class_name for f in methods}) == 1
            else None
        )

    def dispatched(
        self,
        methods: Sequence[Function],
        class_name: str,
        this_object: Cell | None,
        arguments: Sequence[Term],
        scope: Scope,
    ) -> Function | None:
        """Returns the method of a class that a call executes: for a virtual one, the only one of
        the classes that the object may have.
        """
        known = pointee(sole_value(this_object.writes)) if this_object is not None else None
        exact = isinstance(known, Struct) and bool(known.type)
        method = self.matching(methods, arguments, scope)
        if method is None or exact or not method.open:
            return method
        others = [
            other
            for derived in self.classes.derived(class_name)
            for other in self.taking(
                self.classes.methods.get((derived, method.name), ()), arguments
            )
            if other is not method
        ]
        return method if not others else None

    def taking(self, functions: Sequence[Function], arguments: Sequence[Term]) -> list[Function]:
        """Returns the functions that take as many arguments, with their labels."""
        self.work.spend(1 + len(functions) // 2)
        count = len(arguments)
        fitting = [
            f
            for f in functions
            if sum(p.default is None for p in f.parameters) <= count <= len(f.parameters)
        ]
        if any(argument[0] == LABEL for argument in arguments) or any(
            p.label for f in fitting for p in f.parameters
        ):
            fitting = [
                f
                for f in fitting
                if matches(f.parameters, [labeled(argument)[0] for argument in arguments])
            ]
        return fitting

    def matching(
        self, functions: Sequence[Function], arguments: Sequence[Term], scope: Scope
    ) -> Function | None:
        """Returns the only function whose parameters have the types of the arguments, as far as
        they are known, or None.
        """
        if len(functions) <= 1:
            return functions[0] if functions else None
        self.work.spend(len(functions) * len(arguments))
        types = [self.argument_type(argument, scope) for argument in arguments]
        fitting = [
            f
            for f in functions[:64]
            if all(
                not kind or self.accepts(p.type, kind, scope)
                for p, kind in zip(f.parameters, types, strict=False)
            )
        ]
        if len(fitting) > 1:
            # Of several enumerations, each is an integer.
            fitting = [
                f
                for f in fitting
                if all(
                    not kind or _is_named(p.type, kind)
                    for p, kind in zip(f.parameters, types, strict=False)
                )
            ]
        return fitting[0] if len(fitting) == 1 else None

    def argument_type(self, argument: Term, scope: Scope) -> str:
        """Returns the type of an argument, or an empty string."""
        if argument[0] == LITERAL:
            return (
                "bool"
                if isinstance(argument[1], bool)
                else "int"
                if isinstance(argument[1], int)
                else ""
            )
        return self.type_of_term(argument, scope)

    def accepts(self, parameter: str, argument: str, scope: Scope) -> bool:
        """Returns whether a parameter may take an argument, by their types; one of a class of the
        program does not take another one.
        """
        if parameter == argument or "auto" in (parameter, argument):
            return True
        left, right = (
            self.class_of(parameter, scope.enclosing),
            self.class_of(argument, scope.enclosing),
        )
        if left is not None and right is not None:
            return left in self.classes.chain(right)
        if (left is None) != (right is None):
            return False
        structures = self.library.structure(parameter), self.library.structure(argument)
        if any(structures):
            return structures[0] == structures[1]
        return not (
            self.library.is_type(parameter)
            or self.library.is_type(argument)
            or "char" in (parameter, argument)
        )

    def this_of(self, function: Function, receiver: Receiver | None, scope: Scope) -> Cell | None:
        """Returns the object that a method is executed for, or None if it is unknown."""
        if not function.class_name:
            return None
        if receiver is None:
            return (
                scope.this_object
                if function.class_name in self.classes.chain(scope.class_name)
                else None
            )
        cell = receiver.cell
        if cell is None:
            return None
        known = cell.kind == MEMBER or isinstance(
            pointee(sole_value(cell.read(scope.guards))), Struct
        )
        return cell if known else None

    def is_pointed(self, cell: Cell, scope: Scope) -> bool:
        """Returns whether a member points to an object of a class, but which one is unknown."""
        known = pointee(sole_value(cell.read(scope.guards)))
        return (
            cell.kind == MEMBER
            and not isinstance(known, Struct)
            and not self.is_held(cell)
            and bool(self.pointed_class(cell.name))
        )


def _is_named(kind: str, other: str) -> bool:
    """Returns whether two types have the same name, whatever their qualifiers are."""
    return kind.rpartition("::")[2] == other.rpartition("::")[2]
