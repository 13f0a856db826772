"""An abstract interpreter that tracks the structures of an API that a program fills in.

Each function that no other function of the file calls is an entry point. Calls of functions in the
file are executed with their arguments. Conditions are not decided; they are recorded with the
values written under them. The value of a class member is the union of what all functions write to
it, so the file is executed repeatedly, each time with the members found before. Unknown values stay
unknown.
"""

from __future__ import annotations

import sys
from abc import abstractmethod
from collections.abc import Iterable, Iterator, Sequence
from typing import Any

from msaa_lint.core.text.span import Span
from msaa_lint.input.code.parsing import Unread

from .aliases import resolved
from .classes import pointed
from .conditions import canonical_text
from .escapes import mark_escaped
from .evaluate import ALLOCATORS
from .executions import Execution, Seen, Summary, add, contents, emptied, joined, mark
from .guards import ALWAYS, Guards, brief, contradicts, decided, either, negated
from .limits import WorkLimitExceeded
from .loops import Loops
from .scope import MAX_CASES, MAX_FRAMES, MAX_PASSES, Scope, name_objects
from .terms import (
    BINARY,
    BLOCK,
    BREAK,
    CALL,
    DECLARE,
    DO,
    FIELD,
    IF,
    INDEX,
    LEAVE,
    LOOP,
    NAME,
    RETURN,
    SOME,
    SWITCH,
    TARGET,
    Function,
    Term,
    called_names,
)
from .types import element_type
from .values import (
    MAX_ALTERNATIVES,
    UNKNOWN,
    Alternative,
    Array,
    Cell,
    Flags,
    Ref,
    Struct,
    Symbol,
    Value,
    sole_value,
)


class Interpreter(Loops):
    """Executes one program. The library of an API derives from it."""

    unread: Unread | None = None
    """Set if the file exceeds a limit, which leaves no objects."""

    @abstractmethod
    def create_unused(self, scope: Scope) -> None:
        """Creates objects for the structures of an entry point that no call takes."""

    @abstractmethod
    def create_from_fragments(self, overlay: dict[str, Cell]) -> None:
        """On a page of code fragments, creates objects for structures that it does not declare."""

    def run(self) -> None:
        """Executes the file until the values of members no longer change, or until it exceeds a
        limit, which `unread` then says.
        """
        function = None
        depth = sys.getrecursionlimit()
        sys.setrecursionlimit(max(depth, MAX_FRAMES))
        try:
            executions: dict[Span, Execution] = {}
            seen, changed = Seen(), set[str]()
            for _ in range(MAX_PASSES):
                self.begin()
                results, writes = emptied(self.collected()), Summary()
                for function in self.reached_functions():
                    execution = executions.get(function.at)
                    if (
                        execution is None
                        or not self.repeatable
                        or not changed.isdisjoint(execution.used)
                    ):
                        execution = executions[function.at] = self.executed(function)
                    add(results, execution.results)
                    writes.add(function.at, execution.writes)
                add(self.collected(), results)
                if self.fragments:
                    self.create_from_fragments(self.overlay)
                changed = self.summarize(writes, seen)
                if not changed:
                    break
        except (WorkLimitExceeded, RecursionError) as error:
            # Of half a frame, too much would be said: that nothing reads an image, for example.
            self.begin()
            self.unread = Unread(
                self.work.message(error), function.at if function is not None else Span(0, 0)
            )
        finally:
            sys.setrecursionlimit(depth)

    def add_to_classes(self, writes_by_key: dict[str, dict[tuple[Any, ...], Alternative]]) -> None:
        """Adds what is written to members of known objects to what an unknown object of their class
        may hold, except for objects.
        """
        for key, writes in list(writes_by_key.items()):
            owner, _, name = key.rpartition(".")
            class_name = (
                self.class_of(self.type_of_key(owner), "") if owner and "[" not in name else None
            )
            values = [
                (each, write)
                for each, write in writes.items()
                if isinstance(write.value, (int, float, str, Flags, Symbol))
            ]
            if class_name is not None and values:
                of_class = writes_by_key.setdefault(
                    f"{self.classes.owner(class_name, name)}::{name}", {}
                )
                of_class.update((each, write) for each, write in values if each not in of_class)

    @property
    def repeatable(self) -> bool:
        """Whether an entry point does the same in each execution unless what is known of the
        members that it uses changes.
        """
        return not self.fragments

    def executed(self, function: Function) -> Execution:
        """Executes an entry point, whose results alone are collected."""
        self.overlay, self.initial, self.started, self.entry = {}, {}, {}, function.at
        self.consulted = set()
        self.run_entry_point(function)
        writes: list[tuple[str, Alternative]] = []
        for key, cell in self.overlay.items():
            before = {id(write) for write in self.initial.get(key, ())}
            writes += (
                (key, self.summarized(write, key))
                for write in cell.writes
                if id(write) not in before
            )
        return Execution(self.consulted.union(self.initial), writes, emptied(self.collected()))

    def summarize(self, writes: Summary, seen: Seen) -> set[str]:
        """Learns what entry points write to members. Returns the members of which something is
        known that was not.
        """
        lists = (
            key
            for key, entries in writes.writers.items()
            if entries != self.writers.get(key) and element_type(self.type_of_key(key))
        )
        changed = set(lists)
        self.add_to_classes(writes.writes)
        self.summary, self.writers = writes.values(), writes.writers
        self.object_summary = self.members_of_objects()
        known = contents({**self.object_summary, **self.summary}, self.work)
        return changed | seen.news(known, self.parts, self.callable_names)

    def summarized(self, write: Alternative, key: str) -> Alternative:
        """Returns what an entry point writes to a member as others find it. A list that it appends
        to may have other elements, too.
        """
        if write.value is UNKNOWN:
            return write._replace(value=Symbol(key, key.rpartition("::")[2]))
        if isinstance(write.value, Array) and self.started.get(key) is write.value:
            array = self.copies.value(write.value)
            array.complete = False
            return write._replace(value=array)
        return write

    def members_of_objects(self) -> dict[str, Value]:
        """Returns the values of members of the objects that were created, which methods of an
        unknown object may find in them.
        """
        writes_by_key: dict[str, dict[tuple[Any, ...], Alternative]] = {}
        for struct in self.class_objects:
            for name, cell in struct.fields.items():
                self.work.spend(1 + len(cell.writes))
                writes = writes_by_key.setdefault(
                    f"{self.classes.owner(struct.type, name)}::{name}", {}
                )
                for write in cell.writes:
                    if write.value is not UNKNOWN and len(writes) <= MAX_ALTERNATIVES:
                        writes.setdefault(mark(write), write)
        for path, values in self.summary.items():
            owner, _, rest = path.partition(".")
            class_name = self.class_of(self.type_of_key(owner), "") if rest else None
            if class_name is not None:
                self.work.spend(1 + len(values))
                name = rest.partition(".")[0].partition("[")[0]
                writes = writes_by_key.setdefault(
                    f"{self.classes.owner(class_name, name)}::{rest}", {}
                )
                for write in values:
                    if len(writes) <= MAX_ALTERNATIVES:
                        writes.setdefault(mark(write), write)
        return {
            key: joined(key, list(writes.values()))
            for key, writes in writes_by_key.items()
            if writes
        }

    def reached_functions(self) -> Iterator[Function]:
        """Yields the entry points, and then the functions that no call was followed to: a lambda or
        an unknown object calls them.
        """
        entry_points = self.entry_points()
        yield from entry_points
        known = {function.at for function in entry_points}
        relevant = {function.name for function in self.unit.functions if not function.only_called}
        for function in self.unit.functions:
            if function.at in known or function.at in self.followed:
                continue
            if not function.only_called or not relevant.isdisjoint(called_names(function.body)):
                yield function

    def entry_points(self) -> list[Function]:
        # The constructor of a member runs where the object is created; no call of it appears.
        types = {pointed(term[1]) for terms in self.members.values() for term in terms.values()}
        constructors = {
            f.name
            for f in self.unit.functions
            if f.class_name.rpartition("::")[2] == f.name and f.parameters and f.name in types
        }
        entry_points = [
            f
            for f in self.unit.functions
            if not f.only_called and f.name not in self.unit.called and f.name not in constructors
        ]
        return (
            [*entry_points, Function("", "", "", (), tuple(self.unit.outside), Span(0, 0))]
            if self.fragments
            else entry_points
        )

    def entry_scope(self, function: Function) -> Scope:
        """Returns the scope of an entry point, with what is known of its parameters."""
        scope = Scope(function.class_name, function.namespace)
        scope.active_functions = (function.at,)
        scope.this_object = self.own_object(function)
        for parameter in function.parameters:
            if parameter.name:
                known = self.typed_value(parameter.type, parameter.name, function.at)
                scope.scopes[-1][parameter.name] = Cell(
                    parameter.type, parameter.name, known, f"{function.name}({parameter.name})"
                )
        return scope

    def run_entry_point(self, function: Function) -> None:
        scope = self.entry_scope(function)
        self.block(function.body, scope)
        if (
            not function.class_name
            or self.class_of(function.return_type, function.namespace) != function.class_name
        ):
            # A function that creates an object of its own class is a constructor.
            mark_escaped(tuple(scope.return_values), self.work)
        self.create_unused(scope)

    def own_object(self, function: Function) -> Cell | None:
        """Returns the object of the API whose method an entry point is, or None."""
        return None

    def block(self, statements: Iterable[Term], scope: Scope) -> None:
        for statement in statements:
            if scope.unreachable:
                return
            self.statement(statement, scope)

    def run_block(
        self, statements: Iterable[Term], scope: Scope, guards: Guards, scoped: bool = True
    ) -> bool:
        """Executes a block under guards with its own variables. Returns whether the block leaves
        the enclosing one.
        """
        outer, scopes = scope.guards, scope.scopes
        scope.guards = outer | guards
        scope.scopes = (*scopes, {}) if scoped else scopes
        self.block(statements, scope)
        scope.guards, scope.scopes = outer, scopes
        left, scope.unreachable = scope.unreachable, False
        return left

    def statement(self, term: Term, scope: Scope) -> None:
        self.step(scope)
        kind = term[0]
        if kind == DECLARE:
            self.declare(term, scope)
        elif kind == DO:
            self.value(term[1], scope)
        elif kind == RETURN:
            if term[1] is not None:
                cell = (
                    self.cell_of(term[1], scope)
                    if scope.by_reference and term[1][0] in (NAME, FIELD, INDEX, TARGET)
                    else None
                )
                if cell is not None:
                    value: Value = (Alternative(Ref(cell, True), term[-1]),)
                else:
                    value = self.value(term[1], scope, scope.return_type)
                base = scope.guards
                scope.return_values += [
                    Alternative(a.value, a.at, a.guards | base) for a in value
                ] or [Alternative(UNKNOWN, term[-1], base)]
            scope.unreachable = True
        elif kind in (LEAVE, BREAK):
            scope.unreachable = True
            scope.interrupted = scope.interrupted or kind == BREAK
        elif kind == IF:
            self.test(self.condition(term[1], scope), term, scope)
        elif kind == SOME:
            self.test(self.preprocessor_condition(term[1]), term, scope)
        elif kind == LOOP:
            self.loop(term, scope)
        elif kind == SWITCH:
            self.switch(term, scope)
        elif kind == BLOCK:
            scope.unreachable = self.run_block(term[1], scope, ALWAYS)

    def test(self, condition: bool | Guards, term: Term, scope: Scope) -> None:
        then, otherwise = term[2], term[3]
        # Preprocessor conditions do not open a scope.
        scoped = term[0] == IF
        known = decided(condition, scope.guards)
        if isinstance(condition, bool) or known is not None:
            scope.unreachable = self.run_block(then if known else otherwise, scope, ALWAYS, scoped)
            return
        against = negated(condition)
        left = self.run_block(then, scope, condition, scoped)
        leaves = self.run_block(otherwise, scope, against, scoped)
        scope.unreachable = left and leaves
        if left is not leaves:
            scope.guards |= against if left else condition

    def switch(self, term: Term, scope: Scope) -> None:
        """Executes the statements at each label that the value may have. Those of the next label
        follow unless they are left before.
        """
        _, subject, cases, place = term
        if subject[0] not in (NAME, FIELD):
            # A call is executed once.
            name = f"switch {place.start}"
            scope.scopes[-1][name] = Cell(
                "", name, self.value(subject, scope), brief(canonical_text(subject))
            )
            subject = (NAME, name, subject[-1])
        conditions = [self.label_condition(subject, labels, scope) for labels, _ in cases]
        others = [
            condition
            for (labels, _), condition in zip(cases, conditions, strict=True)
            if None not in labels
        ]
        undecided = [condition for condition in others if not isinstance(condition, bool)]
        otherwise = False if True in others else ALWAYS.union(*map(negated, undecided))
        returns = any(None in labels for labels, _ in cases)
        # The labels exclude one another; that a case was left only says something about what
        # follows the switch.
        after: list[Guards] = []
        for n, (labels, _) in enumerate(cases):
            condition = conditions[n] if None not in labels or conditions[n] is True else otherwise
            known = decided(condition, scope.guards)
            if known is False:
                continue
            guards = ALWAYS if isinstance(condition, bool) else condition
            outer, scope.interrupted = scope.interrupted, False
            left = self.run_block(_from_case(cases, n), scope, guards) and not scope.interrupted
            scope.interrupted = outer
            if known:
                scope.unreachable = left
                return
            returns = returns and left
            if left:
                after.append(negated(guards))
        scope.guards = scope.guards.union(*after)
        scope.unreachable = returns

    def label_condition(
        self, subject: Term, labels: Sequence[Term | None], scope: Scope
    ) -> bool | Guards:
        """Returns the condition under which a value is one of several labels."""
        result: bool | Guards = False
        for label in labels:
            if label is None or result is True:
                continue
            condition = self.comparison((BINARY, "==", subject, label, label[-1]), scope)
            if condition is not False:
                result = (
                    condition
                    if isinstance(condition, bool) or isinstance(result, bool)
                    else either(result, condition)
                )
        return result

    def declare(self, term: Term, scope: Scope) -> None:
        _, kind, name, initializer, indirect, _, place = term
        kind = resolved(kind, self.unit.aliases) if self.unit.aliases else kind
        if (
            self.fragments
            and len(scope.scopes) == 1
            and not scope.calls
            and f"::{name}" in self.summary
        ):
            # Other fragments of the page assign it.
            scope.scopes[-1][name] = self.member_cell(f"::{name}")
            return
        result: Value | None = None
        if indirect and initializer is not None:
            cell = None
            if initializer[0] == CALL and initializer[1][1] not in ALLOCATORS:
                result = self.call(initializer, scope)
                known = sole_value(result)
                cell = known.cell if isinstance(known, Ref) and known.alias else None
            elif initializer[0] in (NAME, FIELD, INDEX) and not kind.endswith("*"):
                cell = self.cell_of(initializer, scope)
            if cell is not None and not isinstance(sole_value(cell.read(scope.guards)), Ref):
                scope.scopes[-1][name] = cell
                return
        cell = self.other_branch_variable(name, kind, scope) or Cell(kind, name)
        if initializer is None:
            value = self.typed_value(kind, name, place)
            if not value and not indirect:
                value = self.construct_class(
                    kind, (CALL, (NAME, kind, place), (), place), scope
                ) or self.default_value(kind, name, place, scope)
        else:
            value = (
                self.value(initializer, scope, kind)
                if result is None
                else self.without_aliases(result, scope)
            )
            value = (
                value
                if any(not isinstance(a.value, Symbol) for a in value)
                else self.typed_value(kind, name, place) or value
            )
            value = tuple(
                Alternative(self.stored_value(a.value, kind, name), a.at, a.guards) for a in value
            )
            if kind == "auto" and (declared := self.class_of_term(initializer, scope)) is not None:
                cell.kind = declared
        # An initializer can refer to a variable of the same name that this one shadows.
        scope.scopes[-1][name] = cell
        cell.write(value, place, scope.guards)
        name_objects(value, name, scope)
        self.declared_structs += [
            (a.value, scope.guards) for a in value if isinstance(a.value, Struct) and a.value.kind
        ]

    @staticmethod
    def other_branch_variable(name: str, kind: str, scope: Scope) -> Cell | None:
        """Returns a variable that the other branch of an #if declares, or None."""
        before = scope.scopes[-1].get(name)
        if (
            before is None
            or before.kind.partition("[")[0] != kind.partition("[")[0]
            or not scope.guards
            or not before.writes
        ):
            return None
        return (
            before
            if all(contradicts(write.guards, scope.guards) for write in before.writes)
            else None
        )


def _from_case(
    cases: Sequence[tuple[Sequence[Term | None], Sequence[Term]]], start: int
) -> Iterator[Term]:
    """Yields the statements of a switch from a label on, up to where they certainly leave it."""
    for _, statements in cases[start : start + MAX_CASES]:
        for statement in statements:
            yield statement
            if statement[0] in (BREAK, LEAVE, RETURN):
                return
