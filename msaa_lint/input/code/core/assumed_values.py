"""Values that the user states take the place of those that the interpreter finds."""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Callable
from typing import Any

from msaa_lint.core.text.span import Span
from msaa_lint.input.code.parsing import Assumed, Assumptions

from .guards import Guards
from .interpreter import Interpreter
from .operators import COMPARISONS
from .scope import MEMBER, Scope
from .terms import ADDRESS, ASSIGN, CALL, FIELD, INDEX, LITERAL, NAME, TARGET, Term
from .values import UNKNOWN, Alternative, Symbol, Value, sole_value

SAMPLES = "samples"
"""The name that stands for the sample count on the line of a comment."""

_COUNT = re.compile(r"sample|msaa", re.IGNORECASE)
_SEPARATOR = re.compile(r"::|\.")
_DEFINED = re.compile(r"(!?)\s*defined\s*(?:\(\s*(\w+)\s*\)|(\w+))")
_TESTED = re.compile(r"(!?)\s*(\w+)\s*(?:(==|!=|>=|<=|>|<)\s*(\d{1,9})[uUlL]*)?")


class AssumedValues:
    """The assumptions about a program. They are in force in `program` as soon as this object
    exists.
    """

    def __init__(
        self,
        program: Interpreter,
        assumptions: Assumptions,
        original: Callable[[Span], Span] = lambda at: at,
    ) -> None:
        self.program = program
        self.original = original
        """Returns the place in the files of a place in the program."""
        self.used = assumptions.used
        self.names: dict[str, list[Assumed]] = {}
        """Assumptions about names, by the last part of the name."""
        lines: dict[Span, Assumed] = {}
        for stated in assumptions.entries:
            if stated.name == SAMPLES and stated.at is not None:
                lines[stated.about] = stated
            else:
                self.names.setdefault(_last_part(stated.name), []).append(stated)
        self.lines = [lines[span] for span in sorted(lines)]
        self.members: dict[str, dict[str, Assumed]] = {}
        """Assumptions on the lines of declarations, by the name of the member and its key."""
        for key, term in self._declarations() if lines else ():
            if (entry := self.on_line(term[-1])) is not None:
                self.members.setdefault(key.rpartition("::")[2], {})[key] = entry
        self._value, self._declare, self._condition = (
            program.value,
            program.declare,
            program.preprocessor_condition,
        )
        # Most programs have no assumptions, and nothing is to be looked up for each of their terms.
        program.value = self.value  # type: ignore[method-assign]
        program.declare = self.declare  # type: ignore[method-assign]
        program.preprocessor_condition = self.preprocessor_condition  # type: ignore[method-assign]

    def _declarations(self) -> list[tuple[str, Term]]:
        members = [
            (f"{class_name}::{name}", term)
            for class_name, terms in self.program.members.items()
            for name, term in terms.items()
        ]
        return [*members, *((f"::{name}", term) for name, term in self.program.globals.items())]

    def on_line(self, place: Span) -> Assumed | None:
        """Returns the assumption about the line of a place."""
        start = self.original(place).start
        at = bisect_right(self.lines, start, key=_start) - 1
        return self.lines[at] if at >= 0 and start < self.lines[at].about.end else None

    def value(self, term: Term, scope: Scope, kind: str = "") -> Value:
        """Returns the possible values of an expression: the one that is stated for it, if there is
        one.
        """
        tag = term[0]
        if tag not in (NAME, FIELD, INDEX, CALL, ASSIGN):
            return self._value(term, scope, kind)
        entry = self.named(term, scope) if tag != ASSIGN else None
        if entry is not None:
            return self.result(entry, term[-1])
        value = self._value(term, scope, kind)
        entry = self.on_line(term[-1]) if self.lines else None
        if entry is None or not (tag in (CALL, ASSIGN) or _COUNT.search(_name_of(term))):
            return value
        if tag == ASSIGN and (_is_unknown(value) or _COUNT.search(_name_of(term[2]))):
            stated = self.result(entry, term[-1])
            return self._value(
                (ASSIGN, "=", term[2], (LITERAL, stated[0].value, term[-1]), term[-1]), scope
            )
        return self.result(entry, term[-1]) if tag != ASSIGN and _is_unknown(value) else value

    def result(self, entry: Assumed, place: Span) -> Value:
        """Returns the value of an assumption, which is then of use."""
        self.used.add(entry)
        known: Any = (
            self.program.library.constant(entry.value) if isinstance(entry.value, str) else None
        )
        return (Alternative(entry.value if known is None else known, place),)

    def declare(self, term: Term, scope: Scope) -> None:
        """Executes a declaration. A variable on the line of an assumption has its value, if it is a
        count or has no other.
        """
        self._declare(term, scope)
        entry = self.on_line(term[-1]) if self.lines else None
        cell = scope.scopes[-1].get(term[2]) if entry is not None else None
        if entry is None or cell is None or self.program.library.structure(cell.kind):
            return
        if _COUNT.search(term[2]) or _is_unknown(cell.writes):
            cell.write(self.result(entry, term[-1]), term[-1], scope.guards)

    def preprocessor_condition(self, text: str) -> bool | Guards:
        """Returns the value of a preprocessor condition about a macro that has a stated value."""
        bare = text[1:].strip()
        defined, tested = _DEFINED.fullmatch(bare), _TESTED.fullmatch(bare)
        name = (
            (defined[2] or defined[3])
            if defined is not None
            else tested[2]
            if tested is not None
            else ""
        )
        entry = next((entry for entry in self.names.get(name, ()) if entry.name == name), None)
        if entry is None:
            return self._condition(text)
        self.used.add(entry)
        if defined is not None:
            return (entry.value is not False) is not bool(defined[1])
        assert tested is not None
        if tested[3] is None:
            return bool(entry.value) is not bool(tested[1])
        return isinstance(entry.value, int) and COMPARISONS[tested[3]](entry.value, int(tested[4]))

    def named(self, term: Term, scope: Scope) -> Assumed | None:
        """Returns the assumption about the name of an expression."""
        name = _name_of(term)
        for entry in self.names.get(name, ()):
            if entry.name.endswith(")") is (term[0] == CALL) and self._is_about(entry, term, scope):
                return entry
        declared = self.members.get(name) if term[0] != CALL else None
        if declared is None:
            return None
        cell = self.program.cell_of(term, scope)
        if cell is None:
            return None
        return declared.get(cell.key) or declared.get(f"{self._class_of(term, scope)}::{name}")

    def _is_about(self, entry: Assumed, term: Term, scope: Scope) -> bool:
        path = _path_of(term)
        if path == entry.name or path.endswith((f".{entry.name}", f"::{entry.name}")):
            return True
        owner, separator, _ = entry.name.rpartition("::")
        class_name = self._class_of(term, scope) if separator and "." not in owner else ""
        return class_name != "" and (class_name == owner or class_name.endswith(f"::{owner}"))

    def _class_of(self, term: Term, scope: Scope) -> str:
        """Returns the class whose member an expression names; empty if it is unknown."""
        if term[0] == CALL:
            term = term[1]
        if term[0] == NAME:
            cell = self.program.cell_of(term, scope)
            return scope.class_name if cell is not None and cell.kind == MEMBER else ""
        cell = self.program.cell_of(term[1], scope) if term[0] == FIELD else None
        return (
            self.program.type_of(cell).removeprefix("const ").strip("*& ")
            if cell is not None
            else ""
        )


Assume = Callable[[Interpreter], object]
"""States what the user assumes about a program before it is executed."""


def nothing(_program: Interpreter) -> None:
    """Assumes nothing."""


def assuming(
    assumptions: Assumptions | None, original: Callable[[Span], Span] = lambda at: at
) -> Assume:
    """Returns what states assumptions; `original` returns the place in the files of a place in the
    program.
    """
    return (
        nothing
        if assumptions is None or not assumptions.entries
        else lambda program: AssumedValues(program, assumptions, original)
    )


def _start(entry: Assumed) -> int:
    return entry.about.start


def _last_part(name: str) -> str:
    return _SEPARATOR.split(name)[-1].partition("[")[0].removesuffix("()")


def _is_unknown(value: Value) -> bool:
    known = sole_value(value)
    return known is UNKNOWN or isinstance(known, Symbol)


def _name_of(term: Term) -> str:
    """Returns the last part of the name of an expression."""
    if term[0] == NAME:
        return str(term[1]).rpartition("::")[2]
    if term[0] == FIELD:
        return str(term[2])
    return _name_of(term[1]) if term[0] in (CALL, INDEX, ADDRESS, TARGET) else ""


def _path_of(term: Term) -> str:
    """Returns an expression as an assumption names it: `a.b().c[]`."""
    tag = term[0]
    if tag == NAME:
        return str(term[1]).removeprefix("this->").replace("->", ".")
    if tag == FIELD:
        return f"{_path_of(term[1])}.{term[2]}"
    if tag in (ADDRESS, TARGET):
        return _path_of(term[1])
    return f"{_path_of(term[1])}{'()' if tag == CALL else '[]'}" if tag in (CALL, INDEX) else ""
