"""Evaluates C and C++ expressions."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterable, Sequence
from typing import Any

from msaa_lint.core.text.span import Span

from .conditions import ConditionEvaluator
from .guards import contradicts, negated
from .scope import MEMBER, Scope, name_objects
from .terms import (
    ADDRESS,
    ASSIGN,
    BINARY,
    BRACES,
    CALL,
    CHOICE,
    FIELD,
    INDEX,
    LABEL,
    LAMBDA,
    LITERAL,
    NAME,
    TARGET,
    UNARY,
    Term,
    at,
)
from .values import (
    MAX_ALTERNATIVES,
    UNKNOWN,
    UNKNOWN_VALUE,
    Alternative,
    Array,
    Cell,
    Closure,
    Flags,
    Ref,
    Routine,
    Struct,
    Symbol,
    Value,
    pointee,
    sole_value,
)

ALLOCATORS = frozenset({"malloc", "calloc", "alloca", "_alloca"})
"""Functions that return memory."""


class Evaluator(ConditionEvaluator):
    """Evaluates expressions."""

    def value(self, term: Term, scope: Scope, kind: str = "") -> Value:
        """Returns the possible values of an expression. `kind` is the target type, which braces
        need.
        """
        self.step(scope)
        tag = term[0]
        place = term[-1]
        if tag == LITERAL:
            return (Alternative(term[1], place),)
        if tag == NAME:
            known = self.library.constant(term[1])
            if known is not None:
                return (Alternative(known, place),)
            if term[1] == "this":
                return (
                    (Alternative(Ref(scope.this_object), place),)
                    if scope.this_object is not None
                    else UNKNOWN_VALUE
                )
            routine = self.routine(term[1], scope)
            return self.read(term, scope) if routine is None else (Alternative(routine, place),)
        if tag in (FIELD, INDEX):
            return self.read(term, scope)
        if tag == ADDRESS:
            routine = self.routine(term[1][1], scope) if term[1][0] == NAME else None
            return (
                self.address(term[1], scope, place)
                if routine is None
                else (Alternative(routine, place),)
            )
        if tag == TARGET:
            return _targets(self.value(term[1], scope), scope)
        if tag == BINARY:
            return self.binary(term, scope)
        if tag == UNARY:
            return self.unary(term, scope)
        if tag == ASSIGN:
            return self.assign(term, scope)
        if tag == CHOICE:
            return self.choice(term, scope, kind)
        if tag == CALL:
            name = term[1][1] if term[1][0] == NAME else ""
            if (
                name in ALLOCATORS
                and kind
                and (
                    self.library.structure(kind) or self.class_of(kind, scope.enclosing) is not None
                )
            ):
                return self.allocated(name, term[2], kind, place, scope)
            return self.without_aliases(self.call(term, scope), scope)
        if tag == BRACES:
            return self.braced_value(term, scope, kind)
        if tag == LABEL:
            return self.value(term[2], scope, kind)
        if tag == LAMBDA:
            return (
                Alternative(
                    Closure(
                        term[1],
                        term[2],
                        scope.scopes,
                        scope.this_object,
                        scope.class_name,
                        scope.namespace,
                    ),
                    place,
                ),
            )
        return UNKNOWN_VALUE

    @abstractmethod
    def braced_value(self, term: Term, scope: Scope, kind: str) -> Value:
        """Returns the value of a braced list for a target type."""

    @abstractmethod
    def allocated(
        self, name: str, arguments: Sequence[Term], kind: str, place: Span, scope: Scope
    ) -> Value:
        """Returns memory for one or several structures of a type."""

    @abstractmethod
    def routine(self, name: str, scope: Scope) -> Routine | None:
        """Returns the function outside of classes that a name stands for as a value, or None."""

    @abstractmethod
    def construct_class(self, kind: str, term: Term, scope: Scope) -> Value | None:
        """Returns an object of a class in the file, built by its constructor; None for other types
        and if several constructors match.
        """

    @abstractmethod
    def get(self, term: Term, scope: Scope) -> Value | None:
        """Returns the result of the getter that a name or member calls, or None."""

    @abstractmethod
    def forget_target(self, target: Term, scope: Scope) -> None:
        """Handles a write to an unknown target."""

    @abstractmethod
    def block(self, statements: Iterable[Term], scope: Scope) -> None:
        """Executes statements."""

    def read(self, term: Term, scope: Scope) -> Value:
        name = term[1] if term[0] == NAME else term[2] if term[0] == FIELD else ""
        if name in self.getters and (value := self.get(term, scope)) is not None:
            return value
        reading, self.reading = self.reading, True
        cell = self.cell_of(term, scope)
        self.reading = reading
        return self.content(cell, term[-1], scope) if cell is not None else UNKNOWN_VALUE

    def content(self, cell: Cell, place: Span, scope: Scope) -> Value:
        """Returns the value in a cell, as it is read at a place."""
        value = cell.read(scope.guards)
        if (
            cell.kind == MEMBER
            and cell.key in self.changeable
            and cell.writes is self.initial.get(cell.key)
            and cell.key not in self.summary
        ):
            self.initial_reads[place] = f"`{cell.name.rpartition('::')[2]}` keeps its initial value"
        if not value and cell.kind == MEMBER:
            value = self.gathered_struct(cell.name, place)
        if not value:
            return (
                (Alternative(Symbol(cell.key, cell.name.rpartition("::")[2]), place),)
                if cell.key
                else UNKNOWN_VALUE
            )
        if cell.key and cell.kind != MEMBER:
            # For a parameter, keep the location of the argument.
            return value
        if cell.kind == MEMBER:
            return tuple(
                a._replace(at=place) if not isinstance(a.value, (Struct, Array)) else a
                for a in value
            )
        # What a caller wrote stays where it is written.
        return tuple(
            a._replace(at=place)
            if not isinstance(a.value, (Struct, Array)) and scope.contains(a.at)
            else a
            for a in value
        )

    def without_aliases(self, value: Value, scope: Scope) -> Value:
        """Returns a value with what references refer to in their place."""
        if not any(isinstance(a.value, Ref) and a.value.alias for a in value):
            return value
        alternatives: list[Alternative] = []
        for a in value:
            if isinstance(a.value, Ref) and a.value.alias:
                alternatives += [
                    Alternative(b.value, b.at, a.guards | b.guards)
                    for b in self.content(a.value.cell, a.at, scope)
                ]
            else:
                alternatives.append(a)
        return tuple(alternatives)

    def address(self, operand: Term, scope: Scope, place: Span) -> Value:
        if operand[0] == INDEX:
            rest = self.offset_pointer(
                self.value(operand[1], scope), self.value(operand[2], scope), place
            )
            if rest is not None:
                # Writes through the pointer change the list.
                return (Alternative(Ref(Cell(writes=rest)), place),)
        cell = self.cell_of(operand, scope)
        if cell is not None:
            if self.fragments and cell.kind == MEMBER and not cell.writes:
                # A page may not show the structure, only its name.
                struct = self.gathered_struct(cell.name, place) or (
                    Alternative(Struct("", place, False, cell.name.rpartition("::")[2]), place),
                )
                cell = Cell(MEMBER, cell.name, struct, cell.key)
            return (Alternative(Ref(cell), place),)
        value = self.value(operand, scope)
        return tuple(Alternative(Ref(Cell(writes=(a,))), place, a.guards) for a in value)

    def truth(self, term: Term, scope: Scope) -> Value:
        """Returns the value of a condition."""
        condition = self.condition(term, scope)
        if isinstance(condition, bool):
            return (Alternative(condition, term[-1]),)
        return (
            Alternative(True, term[-1], condition),
            Alternative(False, term[-1], negated(condition)),
        )

    def binary(self, term: Term, scope: Scope) -> Value:
        sign = term[1]
        if sign in ("&&", "||", "==", "!=", "<", ">", "<=", ">="):
            return self.truth(term, scope)
        left, right = self.value(term[2], scope), self.value(term[3], scope)
        if sign == "??":
            present = tuple(a for a in left if a.value is not None)
            return (
                left
                if len(present) == len(left)
                else (*right, *present)
                if len(present) + len(right) <= MAX_ALTERNATIVES
                else ()
            )
        if sign == "+" and (pointer := self.offset_pointer(left, right, term[-1])) is not None:
            return pointer
        return _combined(sign, left, right, term[-1])

    def offset_pointer(self, left: Value, right: Value, place: Span) -> Value | None:
        """Returns a pointer to an element of a list plus an offset, or None."""
        array, count = pointee(sole_value(left)), sole_value(right)
        if (
            not isinstance(array, Array)
            or type(count) is not int
            or not 0 <= count < len(array.items)
        ):
            return None
        rest = Array(array.kind, array.at, array.complete)
        rest.items = array.items[count:]
        return (Alternative(rest, place),)

    def unary(self, term: Term, scope: Scope) -> Value:
        sign = term[1]
        if sign == "!":
            return self.truth(term, scope)
        if sign in ("++", "--", "post++", "post--"):
            cell = self.cell_of(term[2], scope)
            if cell is None:
                return UNKNOWN_VALUE
            before = sole_value(cell.read(scope.guards))
            if isinstance(before, Ref) and sign.endswith("++") and not scope.unknown_loops:
                return self.next(cell, before, sign, term[-1], scope)
            if type(before) is not int or scope.unknown_loops:
                cell.writes = (Alternative(UNKNOWN, term[-1]),)
                return UNKNOWN_VALUE
            after = before + (1 if sign.endswith("++") else -1)
            cell.write((Alternative(after, term[-1]),), term[-1], scope.guards)
            return (Alternative(before if sign.startswith("post") else after, term[-1]),)
        value = self.value(term[2], scope)
        operand = sole_value(value)
        if sign == "-" and isinstance(operand, (int, float)):
            return (Alternative(-operand, term[-1]),)
        if sign == "~" and operand == 0:
            return (Alternative(2**32 - 1, term[-1]),)
        return value if sign == "+" else UNKNOWN_VALUE

    def next(self, cell: Cell, before: Ref, sign: str, place: Span, scope: Scope) -> Value:
        """Increments a pointer to an element of a list."""
        rest = self.offset_pointer((Alternative(before, place),), (Alternative(1, place),), place)
        after = Ref(Cell(writes=rest)) if rest is not None else UNKNOWN
        cell.write((Alternative(after, place),), place, scope.guards)
        return (Alternative(before if sign.startswith("post") else after, place),)

    def choice(self, term: Term, scope: Scope, kind: str) -> Value:
        condition = self.condition(term[1], scope)
        if isinstance(condition, bool):
            return self.value(term[2] if condition else term[3], scope, kind)
        alternatives: list[Alternative] = []
        for guards, branch in ((condition, term[2]), (negated(condition), term[3])):
            if contradicts(guards, scope.guards):
                continue
            value = self.value(branch, scope, kind) or (Alternative(UNKNOWN, at(branch)),)
            alternatives += [
                Alternative(a.value, a.at, a.guards | guards)
                for a in value
                if not contradicts(a.guards, guards)
            ]
        if len(alternatives) > 1 and all(type(a.value) is Struct for a in alternatives):
            return (Alternative(self.copies.merged(tuple(alternatives)), alternatives[0].at),)
        return tuple(alternatives) if len(alternatives) <= MAX_ALTERNATIVES else UNKNOWN_VALUE

    def assign(self, term: Term, scope: Scope) -> Value:
        _, sign, target, source, place = term
        if (
            target[0] == FIELD
            and target[1][:2] == (NAME, "this")
            and self.is_base(target[2], scope)
        ):
            # A base class in the list of initializers.
            arguments = (
                source[2] if source[0] == CALL and source[1][:2] == (NAME, "") else (source,)
            )
            self.construct_base(
                target[2], (CALL, (NAME, target[2], place), tuple(arguments), place), scope
            )
            return UNKNOWN_VALUE
        cell = self.cell_of(target, scope)
        kind = self.type_of(cell) if cell is not None else ""
        if source[0] == CALL and source[1][:2] == (NAME, "") and cell is not None:
            # A member initialized by a constructor before its body.
            instance = self.construct_class(self.type_of(cell), source, scope)
            if instance is not None:
                self.store(cell, instance, place, scope)
                return instance
        value = self.value(source, scope, kind)
        value = self.as_pointer(_name_of(target), value, source, scope)
        if cell is None:
            self.forget_target(target, scope)
            return value
        content = sole_value(cell.writes)
        if (
            isinstance(content, Ref)
            and not any(isinstance(a.value, Ref) or a.value is None for a in value)
            and not cell.kind.endswith("*")
        ):
            cell = content.cell
        if sign != "=":
            value = (
                _combined(sign[:-1], cell.read(scope.guards), value, place)
                if not scope.unknown_loops
                else UNKNOWN_VALUE
            )
            if sign in (">>=", "/=") and sole_value(value) is UNKNOWN:
                # What is halved until it fits is chosen by that.
                value = (
                    Alternative(
                        Symbol(f"{_name_of(target)} at {place.start}", _name_of(target), True),
                        place,
                    ),
                )
        if any(isinstance(a.value, (Closure, Routine)) for a in value):
            self.callable_names.add(_name_of(target))
        stored = tuple(
            Alternative(self.stored_value(a.value, cell.kind, _name_of(target)), a.at, a.guards)
            for a in value
        )
        self.store(cell, stored, place, scope)
        return value

    def is_base(self, name: str, scope: Scope) -> bool:
        """Returns whether a name is that of a class from which the class of the scope derives."""
        if not scope.class_name or not self.classes.has_bases(scope.class_name):
            return False
        base = self.class_of(name, scope.enclosing)
        return (
            base is not None
            and base != scope.class_name
            and base in self.classes.chain(scope.class_name)
        )

    @abstractmethod
    def construct_base(self, name: str, term: Term, scope: Scope) -> None:
        """Executes a constructor of a base class for the object that is constructed."""

    def as_pointer(self, name: str, value: Value, term: Term, scope: Scope) -> Value:
        """Returns a pointer to a list that is assigned to a pointer member, so that later writes to
        the list are seen.
        """
        if self.library.member(name) == name or term[0] not in (NAME, FIELD, INDEX):
            return value
        if not isinstance(sole_value(value), Array):
            return value
        cell = self.cell_of(term, scope)
        return value if cell is None else (Alternative(Ref(cell), term[-1]),)

    def store(self, cell: Cell, value: Value, place: Span, scope: Scope) -> None:
        """Writes to a cell. A structure assigned to a member is written member by member."""
        known = sole_value(value)
        if cell.kind == MEMBER and isinstance(known, Struct) and not known.kind:
            self.held.add(cell.name)
            for name, inner in known.fields.items():
                self.store(
                    self.member_cell(f"{cell.name}.{name}"), inner.read(scope.guards), place, scope
                )
            return
        cell.write(value, place, scope.guards)
        name_objects(value, cell.name, scope)


def _name_of(term: Term) -> str:
    return (
        str(term[1]).rpartition("::")[2]
        if term[0] == NAME
        else str(term[2])
        if term[0] == FIELD
        else ""
    )


def _targets(value: Value, scope: Scope) -> Value:
    """Returns a value with the targets of references in their place."""
    return tuple(
        b
        for a in value
        for b in (a.value.cell.read(scope.guards) if isinstance(a.value, Ref) else (a,))
    )


def _combined(sign: str, left: Value, right: Value, place: Span) -> Value:
    """Returns the result of an operator for every combination of alternatives."""
    alternatives = [
        Alternative(_calculated(sign, a, b, place), place, a.guards | b.guards)
        for a in left
        for b in right
        if not contradicts(a.guards, b.guards)
    ]
    return tuple(alternatives) if len(alternatives) <= MAX_ALTERNATIVES else UNKNOWN_VALUE


def _bits(value: Any, place: Span) -> tuple[tuple[str, Span], ...] | None:
    if isinstance(value, Flags):
        return value.bits
    if isinstance(value, str):
        return ((value, place),)
    return () if value == 0 and not isinstance(value, (bool, float)) else None


def _calculated(sign: str, left: Alternative, right: Alternative, place: Span) -> Any:
    a, b = left.value, right.value
    if sign == "|":
        first, second = _bits(a, left.at), _bits(b, right.at)
        if (
            first is not None
            and second is not None
            and not (isinstance(a, int) and isinstance(b, int))
        ):
            names = {name for name, _ in first}
            return Flags((*first, *(bit for bit in second if bit[0] not in names)))
    if sign == "&" and (
        isinstance(a, Flags) or isinstance(b, Flags) or (isinstance(a, str) and isinstance(b, str))
    ):
        first, second = _bits(a, left.at), _bits(b, right.at)
        if first is not None and second is not None:
            names = {name for name, _ in second}
            return (
                Flags(tuple(bit for bit in first if bit[0] in names))
                if not names.isdisjoint(name for name, _ in first)
                else 0
            )
    if type(a) is int and type(b) is int and abs(a) < 2**40 and abs(b) < 2**40:
        if sign == "<<":
            return a << b if 0 <= b < 40 else UNKNOWN
        results = {"+": a + b, "-": a - b, "*": a * b, "|": a | b, "&": a & b}
        return results.get(sign, a // b if sign == "/" and b else UNKNOWN)
    if isinstance(a, (int, float)) and isinstance(b, (int, float)) and not isinstance(a, bool):
        return {"+": a + b, "-": a - b, "*": a * b}.get(sign, UNKNOWN)
    return UNKNOWN
