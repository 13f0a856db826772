"""Terms: the syntax trees of Swift reduced to about two dozen kinds of nodes.

A term is a tuple of its kind, its parts, and its location. Unwrapping, `try`, `await`, and casts are removed: `a!`, `try a`, and `a as! B`
are `a`. Expressions:

    (NAME, text, at)                          including `self`
    (LITERAL, value, at)                      a number, a boolean, a string, or None for nil
    (MEMBER, object or None, name, at)        `object.name`, or `.name` for None; `name_at` is the location of the name
    (INDEX, object, index, at)
    (LIST, items, at)
    (TUPLE, ((label, item), ...), at)
    (CALL, function, ((label, argument), ...), closure or None, at)
    (CLOSURE, parameter names, statements, at)
    (BINARY, operator, left, right, at), (NOT, of, at)
    (CHOICE, conditions, then, otherwise, at)
    (OTHER, text, at)

Statements:

    (LET, names, type, value or None, at)     several names destructure a tuple
    (SET, operator, target, value, at)
    (DO, expression, at), (RETURN, expression or None, at), (LEAVE, at)
    (IF, conditions, then, otherwise, at)     also #if, with a single condition of the kind OTHER
    (GUARD, conditions, otherwise, at)
    (CASES, bodies, at)                       a switch
    (BLOCK, statements, at), (LOOP, names, statements, at)
    (FUNC, function, at)                      a nested function

A condition is an expression, or (BIND, name, expression or None, at) for `let name = expression`.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from msaa_lint.core.text.span import Span
from msaa_lint.input.code.parsing import SyntaxNode

Term = tuple[Any, ...]

NAME, LITERAL, MEMBER, INDEX, LIST, TUPLE, CALL, CLOSURE, BINARY, NOT, CHOICE, OTHER, BIND = range(13)
LET, SET, DO, RETURN, LEAVE, IF, GUARD, CASES, BLOCK, LOOP, FUNC = range(20, 31)

MAX_ITEMS = 32
"""The maximum number of items in a tuple or structure."""


class Parameter(NamedTuple):
    """A parameter: its argument label (empty for `_`), its name, its type as written, its default."""

    label: str
    name: str
    type: str
    default: Term | None


class Function(NamedTuple):
    """A function, an initializer (`init`), a computed property or an observer.

    `type_name` is the type that declares it, or empty; `gives` are the labels of the tuple that it returns; `body` is parsed on demand.
    """

    name: str
    type_name: str
    parameters: tuple[Parameter, ...]
    gives: tuple[str, ...]
    body: SyntaxNode | None
    at: Span


class Member(NamedTuple):
    """A stored property: its type as written, its initial value, whether it is a variable, whether other files can access it."""

    type: str
    value: Term | None
    variable: bool
    open: bool


class Type(NamedTuple):
    """A class, structure, or enumeration with its extensions: its declarations, supertypes, and cases with raw values."""

    name: str
    members: dict[str, Member]
    computed: dict[str, Function]
    functions: dict[str, list[Function]]
    cases: dict[str, Term | None]
    inherits: set[str]

    def add(self, function: Function) -> None:
        self.functions.setdefault(function.name, []).append(function)


class Unit(NamedTuple):
    """The contents of a file: its types by name, with global declarations under the empty name, and its global statements."""

    types: dict[str, Type]
    outside: tuple[Term, ...]


def name_at(member: Term) -> Span:
    """Returns the location of a member's name, which ends where the term ends."""
    end = member[-1].end
    return Span(end - len(member[2]), end)
