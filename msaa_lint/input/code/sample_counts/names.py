"""What the names in the functions of a program refer to: local variables, members of classes,
global variables, and functions.
"""

from __future__ import annotations

import re
from collections.abc import Hashable, Iterator

from msaa_lint.core.text.span import Span
from msaa_lint.input.code.core.terms import (
    ADDRESS,
    CALL,
    DECLARE,
    FIELD,
    INDEX,
    LAMBDA,
    NAME,
    TARGET,
    Function,
    Term,
    Unit,
)

MAX_DEPTH = 12
"""The maximum number of types and base classes followed for a name."""

MAX_OVERLOADS = 8
"""The maximum number of classes or functions that a name is compared with; if there are more, it is
ambiguous.
"""

Identity = tuple[Hashable, ...]
"""A variable or function: its kind, and its class or the number of its function, and its name."""

LOCAL, PARAMETER, MEMBER, GLOBAL, FUNCTION, UNDECLARED = (
    "local",
    "parameter",
    "member",
    "global",
    "function",
    "undeclared",
)

_ARGUMENT = re.compile(r"<\s*(?:const\s+)?([\w:]+(?:<.*>)?)")
_CONSTRUCTING = re.compile(r"make_(?:unique|shared)$")


def parts(term: Term) -> Iterator[Term]:
    """Yields a term and all terms in it, in no order."""
    stack = [term]
    while stack:
        item = stack.pop()
        if item and isinstance(item[-1], Span) and isinstance(item[0], int):
            yield item
        stack += [part for part in item if isinstance(part, tuple) and not isinstance(part, Span)]


def last(name: str) -> str:
    """Returns the last part of a qualified name, without template arguments."""
    return name.partition("<")[0].rpartition("::")[2]


class Names:
    """The names of a program. A name that may refer to several things refers to none."""

    def __init__(self, unit: Unit) -> None:
        self.functions = unit.functions
        self.bases = unit.bases
        self._members = {
            name: {term[2]: term for term in terms if term[0] == DECLARE}
            for name, terms in unit.members.items()
        }
        self._owners: dict[str, list[str]] = {}
        for name, members in self._members.items():
            for member in members:
                self._owners.setdefault(member, []).append(name)
        self._classes: dict[str, list[str]] = {}
        for name in {
            *unit.members,
            *(function.class_name for function in unit.functions if function.class_name),
        }:
            self._classes.setdefault(last(name), []).append(name)
        self._by_name: dict[str, list[int]] = {}
        self._by_class: dict[tuple[str, str], list[int]] = {}
        self._ancestors: dict[str, list[str]] = {}
        for number, function in enumerate(unit.functions):
            name = last(function.name)
            self._by_name.setdefault(name, []).append(number)
            self._by_class.setdefault((function.class_name, name), []).append(number)
        self.globals = {last(term[2]): term for term in unit.outside if term[0] == DECLARE}
        self.locals: list[dict[str, tuple[Identity, str, Term | None]]] = [
            _locals(n, item) for n, item in enumerate(unit.functions)
        ]

    def members(self) -> Iterator[tuple[Identity, Term]]:
        """Yields the members of classes with their declarations."""
        for name, members in self._members.items():
            for member, term in members.items():
                yield (MEMBER, name, member), term

    def variable(self, term: Term, function: int) -> Identity | None:
        """Returns the variable that an expression names in a function, or None."""
        if term[0] == NAME:
            known = self.locals[function].get(term[1])
            if known is not None:
                return known[0]
            scope, _, name = term[1].rpartition("::")
            owner = self._class(scope) if scope else self.functions[function].class_name
            found = self._member(owner, name) if owner else None
            if found is None and name not in self.globals:
                # A member of a class that is declared in a file that is not read.
                return (
                    (UNDECLARED, self.functions[function].class_name, name)
                    if not scope and not name.isupper()
                    else None
                )
            return found or (GLOBAL, name)
        if term[0] != FIELD:
            return None
        owner = self._class_of(term[1], function)
        if owner is not None:
            member = self._member(owner, term[2]) if owner else None
            return member or (
                (UNDECLARED, owner, term[2]) if term[1][:2] == (NAME, "this") else None
            )
        owners = self._owners.get(term[2], ())
        return (MEMBER, owners[0], term[2]) if len(owners) == 1 else None

    def callee(self, call: Term, function: int, target: Term | None = None) -> int | None:
        """Returns the number of the function that a call calls, or None. `target` is the variable
        that a constructor without a name constructs.
        """
        called = call[1]
        owner: str | None = None
        if called[0] == FIELD:
            name = last(called[2])
            owner = self._class_of(called[1], function)
            if owner == "":
                return None
        elif called[0] == NAME:
            text = called[1] or (self._constructed(target, function) if target is not None else "")
            name, scope = last(text), text.partition("<")[0].rpartition("::")[0]
            if _CONSTRUCTING.search(name):
                argument = _ARGUMENT.search(text)
                name = last(argument[1]) if argument is not None else ""
            elif scope:
                owner = self._class(scope)
        else:
            return None
        if called[0] == NAME and not owner:
            numbers = self._methods(
                self.functions[function].class_name, name
            ) or self._by_class.get(("", name), [])
            constructed = self._class(name) if not numbers else None
            numbers = (
                numbers if constructed is None else self._by_class.get((constructed, name), [])
            )
        else:
            numbers = self._methods(owner, name) if owner else self._by_name.get(name, [])
        if len(numbers) > MAX_OVERLOADS:
            return None
        numbers = [n for n in numbers if _takes(self.functions[n], len(call[2]))]
        return numbers[0] if len(numbers) == 1 else None

    def _methods(self, owner: str, name: str) -> list[int]:
        """Returns the methods of a name that a class has or inherits."""
        return next(
            (
                self._by_class[item, name]
                for item in self._inherited(owner)
                if (item, name) in self._by_class
            ),
            [],
        )

    def _constructed(self, target: Term, function: int) -> str:
        """Returns the class of which a member initializer or declaration constructs an object."""
        if (
            target[0] == FIELD
            and target[1][:2] == (NAME, "this")
            and last(target[2]) in self._classes
        ):
            return str(target[2])
        if (
            target[0] == NAME
            and target[1] not in self.locals[function]
            and last(target[1]) in self._classes
        ):
            return str(target[1])
        return self._class_of(target, function) or ""

    def _class_of(self, term: Term, function: int) -> str | None:
        """Returns the class of an object, an empty string for a type that is not a class of the
        program, and None if it is unknown.
        """
        for _ in range(MAX_DEPTH):
            if term[0] not in (TARGET, ADDRESS, INDEX):
                break
            term = term[1]
        kind, value = "", None
        if term[0] == NAME and term[1] == "this":
            return self.functions[function].class_name
        if term[0] == NAME and term[1] in self.locals[function]:
            _, kind, value = self.locals[function][term[1]]
        elif term[0] in (NAME, FIELD):
            found = (
                self.variable(term, function)
                if term[0] == NAME or term[1][0] in (NAME, TARGET)
                else None
            )
            declared = (
                self._members[str(found[1])][str(found[2])]
                if found is not None and found[0] == MEMBER
                else None
            )
            declared = (
                self.globals[str(found[1])]
                if found is not None and found[0] == GLOBAL
                else declared
            )
            kind = declared[1] if declared is not None else ""
        elif term[0] == CALL and term[1][0] == NAME and last(term[1][1]) in self._classes:
            kind = term[1][1]
        if kind in ("", "auto"):
            return (
                self._class_of(value, function)
                if value is not None and value[0] == CALL and value[1][0] == NAME
                else None
            )
        return self._class(kind) or ""

    def _class(self, kind: str) -> str | None:
        """Returns the class that a type names, also as the argument of a template; None if there is
        none or several.
        """
        for _ in range(MAX_DEPTH):
            name = kind.strip("*& ")
            every = self._classes.get(last(name), [])
            if len(every) > MAX_OVERLOADS:
                return None
            named = [full for full in every if full == name or full.endswith(f"::{name}")] or every
            if named:
                return named[0] if len(named) == 1 else None
            argument = _ARGUMENT.search(kind)
            if argument is None:
                return None
            kind = argument[1]
        return None

    def _inherited(self, name: str) -> list[str]:
        """Returns a class and those that it derives from."""
        if name in self._ancestors:
            return self._ancestors[name]
        names = self._ancestors[name] = [name] if name else []
        for item in names:
            for base in self.bases.get(item, ()):
                full = self._class(base)
                if full is not None and full not in names and len(names) < MAX_DEPTH:
                    names.append(full)
        return names

    def _member(self, owner: str | None, name: str) -> Identity | None:
        return next(
            (
                (MEMBER, item, name)
                for item in self._inherited(owner or "")
                if name in self._members.get(item, ())
            ),
            None,
        )


def _takes(function: Function, count: int) -> bool:
    """Returns whether a function can be called with a number of arguments."""
    return (
        sum(item.default is None for item in function.parameters)
        <= count
        <= len(function.parameters)
    )


def _locals(number: int, function: Function) -> dict[str, tuple[Identity, str, Term | None]]:
    """Returns the parameters and local variables of a function with their types and initial
    values.
    """
    known: dict[str, tuple[Identity, str, Term | None]] = {}
    for term in parts(function.body):
        if term[0] == DECLARE:
            # Of two variables of the same name in a function, neither is known.
            kind = term[1] if term[2] not in known else ""
            known[term[2]] = (LOCAL, number, term[2]), kind, term[3]
        elif term[0] == LAMBDA:
            for item in term[1]:
                known.setdefault(item.name, ((LOCAL, number, item.name), item.type, None))
    for item in function.parameters:
        if item.name:
            known[item.name] = (PARAMETER, number, item.name), item.type, None
    return known
