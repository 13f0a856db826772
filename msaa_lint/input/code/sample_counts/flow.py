"""Where the values of a program flow: assignments, arguments, and results; and which counts and
formats describe the same images.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterator, Sequence
from typing import NamedTuple

from msaa_lint.input.code.core.terms import (
    ADDRESS,
    ASSIGN,
    BRACES,
    CALL,
    CHOICE,
    DECLARE,
    FIELD,
    LAMBDA,
    LOOP,
    NAME,
    RETURN,
    TARGET,
    Term,
    Unit,
    labeled,
)

from .names import FUNCTION, PARAMETER, Identity, Names, last, parts

MAX_ARGUMENTS = 32
"""The maximum number of arguments of a call that is searched for counts and formats."""

_SAMPLES = frozenset({"samples", "samplecount", "numsamples"})
_LESSER = frozenset({"min", "MIN", "Min", "clamp", "Clamp", "CLAMP", "max", "MAX", "Max"})


class Use(NamedTuple):
    """A use of a count for an image: the function that it is in, whether the count depends on a
    condition, and the expressions of which some may be the format.
    """

    function: int
    conditional: bool
    beside: Sequence[Term]


class Flow:
    """The flow of values in a program.

    `targets` has the variables and functions that receive the value of another, and whether under a
    condition; `sources` the expressions that a variable receives or a function returns, with the
    functions that they are in; `uses` the uses of a value as the count of an image.
    """

    def __init__(self, unit: Unit) -> None:
        self.names = Names(unit)
        self.targets: dict[Identity, list[tuple[Identity, bool]]] = {}
        self.sources: dict[Identity, list[tuple[int, Term]]] = {}
        self.uses: dict[Identity, list[Use]] = {}
        for number, function in enumerate(unit.functions):
            self._read(number, function.body)

    def _read(self, number: int, body: tuple[Term, ...]) -> None:
        chains: set[int] = set()
        images: dict[Hashable, tuple[list[Term], list[Term]]] = {}
        lambdas = {
            id(inner)
            for term in parts(body)
            if term[0] == LAMBDA
            for inner in parts(term[2])
            if inner[0] == RETURN
        }
        for term in parts(body):
            kind = term[0]
            if kind == DECLARE and term[3] is not None:
                self._assigned((NAME, term[2], term[-1]), term[3], number)
            elif kind == ASSIGN and term[1] == "=":
                self._assigned(term[2], term[3], number)
                if term[2][0] == FIELD:
                    _describe(images, _object(term[2][1]), term[2][2], term[3])
            elif kind == RETURN and term[1] is not None and id(term) not in lambdas:
                self._flows((FUNCTION, number), term[1], number)
            elif (
                kind == LOOP
                and term[2] is not None
                and len(term[1]) == 1
                and term[1][0][0] == DECLARE
            ):
                self._assigned((NAME, term[1][0][2], term[-1]), term[2], number)
            elif kind == CALL and id(term) not in chains:
                self._called(term, number, chains, images)
            elif kind == BRACES:
                self._braces(term, number)
        for samples, formats in images.values():
            # A structure with several counts describes several images; which format goes with which
            # count is unknown.
            if len(samples) == 1 and formats:
                self._used(samples[0], formats, number)

    def _assigned(self, target: Term, value: Term, number: int) -> None:
        if value[0] == CALL and value[1][0] == NAME and not value[1][1]:
            self._arguments(value, self.names.callee(value, number, target), number)
        variable = self.names.variable(target, number)
        if variable is not None:
            self._flows(variable, value, number)

    def _flows(self, target: Identity, value: Term, number: int) -> None:
        self.sources.setdefault(target, []).append((number, value))
        for source, conditional in self.counts(value, number):
            self.targets.setdefault(source, []).append((target, conditional))

    def counts(self, value: Term, number: int) -> Iterator[tuple[Identity, bool]]:
        """Yields the variables and functions that have the value of an expression, and whether a
        condition chooses among them.
        """
        stack = [(value, False)]
        while stack:
            term, conditional = stack.pop()
            kind = term[0]
            if kind in (ADDRESS, TARGET):
                stack.append((term[1], conditional))
            elif kind == CHOICE:
                stack += ((term[2], True), (term[3], True))
            elif kind == BRACES and len(term[2]) == 1 and term[2][0][0] is None:
                stack.append((term[2][0][1], conditional))
            elif kind in (NAME, FIELD):
                variable = self.names.variable(term, number)
                if variable is not None:
                    yield variable, conditional
            elif kind == CALL:
                if (
                    len(term[2]) == 1
                    and term[1][0] == NAME
                    and "SampleCount" in last(term[1][1])
                    and self.names.callee(term, number) is None
                ):
                    stack.append((term[2][0], conditional))
                    continue
                callee = self.names.callee(term, number)
                if callee is not None:
                    yield (FUNCTION, callee), conditional

    def _called(
        self,
        call: Term,
        number: int,
        chains: set[int],
        images: dict[Hashable, tuple[list[Term], list[Term]]],
    ) -> None:
        """Reads a call: its arguments, or those of a chain of calls that set the members of a
        structure.
        """
        link = call
        setters: list[tuple[str, Term]] = []
        while link[0] == CALL and link[1][0] == FIELD:
            if link is not call:
                chains.add(id(link))
            self._arguments(link, self.names.callee(link, number), number)
            if len(link[2]) == 1:
                setters.append((link[1][2], labeled(link[2][0])[1]))
            link = link[1][1]
        for name, value in setters:
            _describe(images, _object(link), name, value)
        if link is call and (call[1][0] != NAME or call[1][1]):
            self._arguments(call, self.names.callee(call, number), number)

    def _arguments(self, call: Term, callee: int | None, number: int) -> None:
        arguments = [labeled(item)[1] for item in call[2]]
        if callee is not None:
            for parameter, argument in zip(
                self.names.functions[callee].parameters, arguments, strict=False
            ):
                self._flows((PARAMETER, callee, parameter.name), argument, number)
        name = last(call[1][1]) if call[1][0] == NAME else call[1][2] if call[1][0] == FIELD else ""
        if name not in _LESSER:
            self._beside(arguments, number)

    def _beside(self, values: Sequence[Term], number: int) -> None:
        if 1 < len(values) <= MAX_ARGUMENTS:
            for value in values:
                self._used(value, [other for other in values if other is not value], number)

    def _braces(self, term: Term, number: int) -> None:
        named = {path[-1]: value for path, value in term[2] if path}
        if "samples" in named and "format" in named:
            self._used(named["samples"], [named["format"]], number)
        elif not named and term[1]:
            self._beside([value for _, value in term[2]], number)

    def _used(self, count: Term, beside: Sequence[Term], number: int) -> None:
        for source, conditional in self.counts(count, number):
            self.uses.setdefault(source, []).append(Use(number, conditional, beside))


def _object(term: Term) -> Hashable:
    """Returns what two mentions of the same object have in common. Each call returns another
    object.
    """
    path: list[Hashable] = []
    while term[0] == FIELD:
        path.append(term[2])
        term = term[1]
    return (*path, term[1]) if term[0] == NAME else id(term)


def _describe(
    images: dict[Hashable, tuple[list[Term], list[Term]]],
    structure: Hashable,
    member: str,
    value: Term,
) -> None:
    """Adds the count or format that a structure receives."""
    name = member.removeprefix("set").removeprefix("Set").lower()
    if name in _SAMPLES:
        images.setdefault(structure, ([], []))[0].append(value)
    elif name == "format":
        images.setdefault(structure, ([], []))[1].append(value)
