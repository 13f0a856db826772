"""Pairs and tuples of C++: their elements by number, as `first` and `second`, and by structured
bindings.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from msaa_lint.core.text.span import Span

from .scope import Scope
from .structures import Structures
from .terms import CALL, NAME, TUPLE, Term
from .values import Alternative, Array, Cell, Ref, Struct, Value

MAKERS = frozenset({"make_pair", "make_tuple", "forward_as_tuple"})

_TUPLE = re.compile(r"(?:std::)?(?:pair|tuple)(?:<.*>)?$")
_GET = re.compile(r"(?:std::)?get<(\d{1,2})>$")
_PAIR = {"first": 0, "second": 1}


class Tuples(Structures):
    """The pairs and tuples of one file, which are lists whose element type is TUPLE."""

    def braced_value(self, term: Term, scope: Scope, kind: str) -> Value:
        if _TUPLE.match(term[1] or kind):
            return self.tuple_of([item for _, item in term[2]], term[3], scope)
        return super().braced_value(term, scope, kind)

    def tuple_of(self, items: Sequence[Term], place: Span, scope: Scope) -> Value:
        """Returns a pair or tuple of values."""
        value = self.list_value("", [(None, item) for item in items], place, scope)
        array = value[0].value
        if isinstance(array, Array):
            array.kind = TUPLE
        return value

    def tuple_call(
        self, function: Term, arguments: Sequence[Term], place: Span, scope: Scope
    ) -> Value | None:
        """Returns what a call constructs or refers to that has to do with tuples; None for other
        calls.
        """
        if function[0] != NAME:
            return None
        text = function[1]
        number = _GET.match(text)
        if number is not None and len(arguments) == 1:
            cell = self.tuple_element(arguments[0], int(number[1]), scope)
            return (Alternative(Ref(cell, True), place),) if cell is not None else None
        is_made = text.rpartition("::")[2] in MAKERS or _TUPLE.match(text) is not None
        return self.tuple_of(arguments, place, scope) if is_made and len(arguments) > 1 else None

    def tuple_element(self, term: Term, number: int, scope: Scope) -> Cell | None:
        """Returns an element of a tuple, a list, or a structure of the program by its number, or
        None.
        """
        value = self.target(term, scope)
        if isinstance(value, Array) and number < len(value.items):
            return value.items[number]
        names = (
            list(self.members.get(value.type, ()))
            if isinstance(value, Struct) and value.type
            else []
        )
        return (
            self.member_of(value, names[number])
            if isinstance(value, Struct) and number < len(names)
            else None
        )

    def field(self, operand: Term, name: str, scope: Scope) -> Cell | None:
        if name in _PAIR and operand[0] in (NAME, CALL):
            value = self.target(operand, scope)
            if isinstance(value, Array) and value.kind == TUPLE and len(value.items) == len(_PAIR):
                return value.items[_PAIR[name]]
        return super().field(operand, name, scope)
