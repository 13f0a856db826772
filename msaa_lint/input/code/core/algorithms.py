"""Algorithms of C++'s library that call a function for each element of a list, or copy a list."""

from __future__ import annotations

from collections.abc import Sequence

from msaa_lint.core.text.span import Span

from .calls import Calls
from .lists import few_elements
from .scope import Scope
from .terms import CALL, FIELD, NAME, Term, short_name
from .values import UNKNOWN_VALUE, Array, Cell, Closure, Routine, Value

ALGORITHMS = frozenset({"for_each", "transform", "copy"})

_BEGIN = frozenset({"begin", "cbegin"})
_END = frozenset({"end", "cend"})
_INSERTERS = frozenset({"back_inserter", "inserter"})

_ELEMENT = "an element"
"""The name of the variable that stands for the element; no variable of a program has it."""


class Algorithms(Calls):
    """Executes algorithms."""

    def algorithm(self, name: str, arguments: Sequence[Term], place: Span, scope: Scope) -> bool:
        """Executes an algorithm on a list. Returns False if it is not one, or if it has other
        arguments.
        """
        rest = list(arguments)
        if name not in ALGORITHMS or not rest or _called(rest[0])[0] in _END:
            return False
        source = rest.pop(0)
        name_of_begin, list_term = _called(source)
        if name_of_begin in _BEGIN and list_term is not None:
            if not rest or _called(rest[0])[0] not in _END:
                return False
            rest.pop(0)
            source = list_term
        target = rest.pop(0) if name != "for_each" and rest else None
        function = rest.pop(0) if name != "copy" and rest else None
        if (
            rest
            or (target is None) != (name == "for_each")
            or (function is None) != (name == "copy")
        ):
            return False
        self.apply(source, target, function, place, scope)
        return True

    def apply(
        self, source: Term, target: Term | None, function: Term | None, place: Span, scope: Scope
    ) -> None:
        """Calls a function for each element of a list, and writes the results, or the elements, to
        the target.
        """
        content = self.target(source, scope)
        few = few_elements(content)
        known = few is not None
        items = (
            few if few is not None else [Cell(content.kind if isinstance(content, Array) else "")]
        )
        called = self.sole(function, scope) if function is not None else None
        outer, scope.scopes = scope.scopes, (*scope.scopes, {})
        iterations = scope.iterations
        scope.unknown_loops += not known
        for turn, item in enumerate(items):
            scope.iterations = (*iterations, turn)
            scope.scopes[-1][_ELEMENT] = item
            element = (NAME, _ELEMENT, place)
            result = (
                self.applied(called, (CALL, function, (element,), place), scope)
                if function is not None
                else item.read(scope.guards)
            )
            if target is not None:
                self.write_result(target, turn if known else None, result, place, scope)
        scope.unknown_loops -= not known
        scope.scopes, scope.iterations = outer, iterations

    def applied(self, called: object, term: Term, scope: Scope) -> Value:
        """Returns the result of a function for an element."""
        if isinstance(called, Closure):
            return self.without_aliases(self.call_closure(called, term, scope), scope)
        if isinstance(called, Routine) and self.may_follow(called.function, term[-1], scope):
            return self.without_aliases(self.call_function(called.function, term, scope), scope)
        return UNKNOWN_VALUE

    def write_result(
        self, target: Term, turn: int | None, value: Value, place: Span, scope: Scope
    ) -> None:
        """Appends a value to the list that an inserter names, or writes it to an element of the
        list that starts at an iterator.
        """
        name, list_term = _called(target)
        if list_term is None:
            return
        array = self.target(list_term, scope)
        if not isinstance(array, Array):
            return
        if name in _INSERTERS:
            self.append(array, value, place, scope)
        elif name in (*_BEGIN, "data") and turn is not None and turn < len(array.items):
            array.items[turn].write(self.copies.alternatives(value), place, scope.guards)
        else:
            array.complete = False


def _called(term: Term) -> tuple[str, Term | None]:
    """Returns the name of a called function and its list: `list.begin()`, `std::begin(list)`."""
    if term[0] != CALL:
        return "", None
    function, arguments = term[1], term[2]
    if function[0] == FIELD and not arguments:
        return str(function[2]), function[1]
    if function[0] == NAME and arguments:
        return short_name(function[1]), arguments[0]
    return "", None
