"""Loops: those over few known elements are executed once for each, others once with unknown
variables.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterable, Sequence

from .algorithms import Algorithms
from .guards import ALWAYS, Guards
from .lists import few_elements
from .scope import MAX_TURNS, Scope
from .terms import ASSIGN, BINARY, DO, NAME, UNARY, Term, at
from .values import UNKNOWN, UNKNOWN_VALUE, Alternative, Array, Cell, sole_value


class Loops(Algorithms):
    """Executes loops."""

    @abstractmethod
    def declare(self, term: Term, scope: Scope) -> None:
        """Executes a declaration."""

    @abstractmethod
    def run_block(
        self, statements: Iterable[Term], scope: Scope, guards: Guards, scoped: bool = True
    ) -> bool:
        """Executes a block under guards with its own variables. Returns whether the block leaves
        the enclosing one.
        """

    def loop(self, term: Term, scope: Scope) -> None:
        declared, over, body = term[1], term[2], term[3]
        scopes, iterations, interrupted = scope.scopes, scope.iterations, scope.interrupted
        counted = "" if declared or over is not None else _counted(body)
        counter = (
            next((names[counted] for names in reversed(scopes) if counted in names), None)
            if counted
            else None
        )
        scope.scopes, scope.interrupted = (*scopes, {}), False
        turns = (
            self.range_elements(declared, over, scope)
            if over is not None
            else self.counter_values(declared, counter, body, scope)
        )
        if turns is not None:
            for turn, cell in enumerate(turns):
                scope.scopes[-1][declared[0][2] if declared else counted] = cell
                scope.iterations = (*iterations, turn)
                self.run_block(body, scope, ALWAYS)
        else:
            for statement in declared:
                self.declare(statement, scope)
            listed = self.target(over, scope) if over is not None else None
            one = (
                listed.items[0]
                if isinstance(listed, Array) and listed.alike and len(listed.items) == 1
                else None
            )
            for statement in declared:
                scope.scopes[-1][statement[2]] = one or Cell(statement[1], statement[2])
            if counter is not None:
                counter.write(UNKNOWN_VALUE, at(term), scope.guards)
            scope.unknown_loops += 1
            self.run_block(body, scope, ALWAYS)
            scope.unknown_loops -= 1
        if counter is not None and turns:
            # A variable that is declared before the loop has a value after it.
            last = sole_value(turns[-1].writes) if not scope.interrupted else UNKNOWN
            counter.write((Alternative(last, at(term)),), at(term), scope.guards)
        scope.scopes, scope.iterations, scope.interrupted = scopes, iterations, interrupted

    def counter_values(
        self, declared: Sequence[Term], counter: Cell | None, body: Sequence[Term], scope: Scope
    ) -> list[Cell] | None:
        """Returns the variable of a loop that counts, one for each iteration, if they are known and
        few; otherwise None.
        """
        if not body or body[0][0] != DO or len(declared) + (counter is not None) != 1:
            return None
        kind, name, start = declared[0][1:4] if declared else ("int", _counted(body), None)
        test = body[0][1]
        update = _update(body)
        if update[0] != UNARY or update[1] not in ("++", "post++") or update[2][:2] != (NAME, name):
            return None
        if test[0] != BINARY or test[1] not in ("<", "!=", "<=") or test[2][:2] != (NAME, name):
            return None
        value = (
            counter.read(scope.guards)
            if counter is not None
            else self.value(start, scope)
            if start is not None
            else ()
        )
        first, last = sole_value(value), self.sole(test[3], scope)
        if type(first) is not int or type(last) is not int:
            return None
        last += test[1] == "<="
        if not 0 <= last - first <= MAX_TURNS:
            return None
        return [Cell(kind, name, (Alternative(turn, value[-1].at),)) for turn in range(first, last)]

    def range_elements(
        self, declared: Sequence[Term], over: Term, scope: Scope
    ) -> list[Cell] | None:
        """Returns the elements of a list if they are known and few, otherwise None."""
        return few_elements(self.target(over, scope)) if declared else None


def _update(body: Sequence[Term]) -> Term:
    """Returns what a loop ends each iteration with."""
    update: Term = body[-1][1] if body[-1][0] == DO else body[-1]
    return update


def _counted(body: Sequence[Term]) -> str:
    """Returns the variable that a loop changes at the end of each iteration, or an empty string."""
    update = _update(body) if body else ()
    target = update[2] if update and update[0] in (UNARY, ASSIGN) else ()
    return str(target[1]) if target and target[0] == NAME else ""
