"""An upper bound of what evaluating a condition takes, from its checked expression and the sizes of
the facts.

CEL's runtime limits the iterations of an evaluation, but neither the sizes of its values nor what a
regular expression takes: a list that `map` builds is copied in every iteration, sums of strings are
kept until the end, and a pattern is compiled at every call. A step takes about 50 ns and 100 bytes
at most.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import NamedTuple

CHARACTERS = 16
"""Characters of a string that are copied or compared in one step."""

MAX_ITERATIONS = 10_000
"""CEL ends an evaluation with an error after so many."""

MAX_REPETITIONS = 1000
"""RE2 refuses a pattern whose counted repetitions, nested ones multiplied, are more."""

_UNICODE_CLASS = 200
"""Instructions of a class such as \\pL, for each character that writes it."""

_COMPILE = 8
"""Steps for each instruction of a pattern that is compiled."""

_REPETITION = re.compile(r"\{(\d{1,9})(?:,(\d{0,9}))?\}")

_PLAIN = frozenset({
    "_==_", "_!=_", "_<_", "_<=_", "_>_", "_>=_", "_&&_", "_||_", "!_", "-_", "_-_", "_*_", "_/_",
    "_%_", "_?_:_", "@in", "size",
    "contains", "startsWith", "endsWith", "double", "int", "uint",
})  # fmt: skip
"""Functions that use each operand at most once, and whose results are no larger than one of
them.
"""


class Size(NamedTuple):
    """The size of a value: what it takes to copy, in steps; its characters or elements; the size of
    its largest element.
    """

    steps: int = 1
    length: int = 1
    element: Size | None = None


SCALAR = Size()

_Measure = Callable[["_Estimate"], Size]
"""Adds the steps of an expression to an estimate; returns the size of its value."""


def size_of(value: object) -> Size:
    """The size of a fact's value."""
    if isinstance(value, str):
        return Size(1 + len(value) // CHARACTERS, len(value))
    if isinstance(value, list):
        words = [each for each in value if isinstance(each, str)]
        longest = size_of(max(words, key=len, default=0))
        return Size(1 + 2 * len(value) + sum(map(len, words)) // CHARACTERS, len(value), longest)
    return SCALAR


def _largest(sizes: Sequence[Size]) -> Size:
    """A size that none of the sizes exceeds."""
    elements = [each.element for each in sizes if each.element is not None]
    largest = _largest(elements) if elements else None
    return Size(
        max((each.steps for each in sizes), default=1),
        max((each.length for each in sizes), default=1),
        largest,
    )


def pattern_instructions(pattern: str) -> int:
    """At most how many instructions RE2 compiles a pattern to."""
    repetitions = 1
    for least, most in _REPETITION.findall(pattern):
        repetitions = min(repetitions * max(int(least), int(most or 0), 1), MAX_REPETITIONS)
    return (
        (len(pattern) + 1) * repetitions * (_UNICODE_CLASS if re.search(r"\\[pP]", pattern) else 1)
    )


class ConditionCost:
    """The cost of one condition, from the serialized expression that `cel.Expression.serialize`
    returns.
    """

    def __init__(self, checked: bytes) -> None:
        self.functions: set[str] = set()
        self.literal_patterns = True
        """Whether each call of `matches` has its pattern as a literal."""
        self._nodes = 0
        self._mentions: Counter[str] = Counter()
        self._references: dict[int, str] = {}
        expression = b""
        for number, part in _fields(_last(checked, 2)):
            if number == 2:
                self._references[_number(part, 1)] = _text(_last(part, 2), 1)
            elif number == 4:
                expression = _bytes(part)
        self._measure = self._expression(expression)
        self._is_plain = self.functions <= _PLAIN

    def steps(self, facts: Mapping[str, object]) -> int:
        """At most how many steps an evaluation with these facts takes."""
        if self._is_plain:
            return 2 * self._nodes + sum(
                2 * count * size_of(facts.get(name)).steps for name, count in self._mentions.items()
            )
        estimate = _Estimate({name: size_of(facts.get(name)) for name in self._mentions})
        self._measure(estimate)
        return estimate.steps

    # The parts of the message `cel.expr.Expr`: const 3, ident 4, select 5, call 6, list 7, struct
    # 8, comprehension 9.

    def _expression(self, data: bytes) -> _Measure:
        self._nodes += 1
        name = self._references.get(_number(data, 2), "")
        for number, part in _fields(data):
            if name and number in (4, 5):
                return self._identifier(name)
            if number in _READERS:
                return _READERS[number](self, _bytes(part))
        return _scalar

    def _identifier(self, name: str) -> _Measure:
        self._mentions[name] += 1

        def measure(estimate: _Estimate) -> Size:
            return estimate.taken(estimate.sizes.get(name, SCALAR))

        return measure

    def _constant(self, data: bytes) -> _Measure:
        size = Size(1 + len(data) // CHARACTERS, len(data))
        self._nodes += size.steps
        return lambda estimate: estimate.taken(size)

    def _select(self, data: bytes) -> _Measure:
        operand = self._expression(_last(data, 1))
        self.functions.add("select")
        return lambda estimate: _element(operand(estimate))

    def _call(self, data: bytes) -> _Measure:
        function = _text(data, 2)
        self.functions.add(function)
        parts = [_bytes(part) for number, part in _fields(data) if number in (1, 3)]
        operands = [self._expression(part) for part in parts]
        if function == "matches":
            # A constant (3) that is a string (6 of it).
            constants = [_last(part, 3) for part in parts]
            pattern = _text(constants[-1], 6) if constants else ""
            self.literal_patterns = self.literal_patterns and bool(constants and constants[-1])
            instructions = pattern_instructions(pattern)
            return lambda estimate: estimate.matched(
                [operand(estimate) for operand in operands], instructions
            )
        return lambda estimate: estimate.called(
            function, [operand(estimate) for operand in operands]
        )

    def _list(self, data: bytes) -> _Measure:
        return self._collection([_bytes(part) for number, part in _fields(data) if number == 1])

    def _struct(self, data: bytes) -> _Measure:
        self.functions.add("struct")
        entries = [_bytes(part) for number, part in _fields(data) if number == 2]
        return self._collection(
            [_last(entry, number) for entry in entries for number in (3, 4) if _last(entry, number)]
        )

    def _collection(self, parts: list[bytes]) -> _Measure:
        elements = [self._expression(part) for part in parts]

        def measure(estimate: _Estimate) -> Size:
            sizes = [element(estimate) for element in elements]
            return estimate.taken(
                Size(1 + sum(each.steps + 1 for each in sizes), len(sizes), _largest(sizes))
            )

        return measure

    def _comprehension(self, data: bytes) -> _Measure:
        """A macro: variable 1 takes the elements of range 2; result 3 begins as 4, and becomes 6 in
        each iteration while 5 holds.
        """
        self.functions.add("comprehension")
        variable, result = _text(data, 1), _text(data, 3)
        source, initial, condition, step, last = (
            self._expression(_last(data, number)) for number in (2, 4, 5, 6, 7)
        )

        def measure(estimate: _Estimate) -> Size:
            elements, begin = source(estimate), initial(estimate)
            count = min(elements.length, MAX_ITERATIONS)
            before = estimate.sizes
            estimate.sizes = {**before, variable: _element(elements), result: begin}
            begun = estimate.steps
            condition(estimate)
            added = step(estimate)
            estimate.steps = begun + (estimate.steps - begun + 1) * count
            if added.element is not None:
                # The list so far is copied.
                estimate.steps += count * count
            grown = Size(
                begin.steps + added.steps * count,
                begin.length + added.length * count,
                added.element,
            )
            estimate.sizes = {**before, result: grown}
            size = last(estimate)
            estimate.sizes = before
            return size

        return measure


class _Estimate:
    """The steps so far, and the sizes of facts and variables."""

    def __init__(self, sizes: Mapping[str, Size]) -> None:
        self.steps = 0
        self.sizes = sizes

    def taken(self, size: Size) -> Size:
        self.steps += size.steps
        return size

    def called(self, function: str, operands: list[Size]) -> Size:
        """The result of a function, for which each operand is read once."""
        self.steps += 1 + sum(each.steps for each in operands)
        if function == "_?_:_":
            return _largest(operands[1:])
        if function == "_[_]":
            return _element(operands[0])
        if function == "_+_":
            return Size(
                sum(each.steps for each in operands),
                sum(each.length for each in operands),
                _largest(operands).element,
            )
        # A number has at most 24 characters.
        return (
            SCALAR
            if function in _PLAIN
            else operands[0]._replace(steps=operands[0].steps + 6)
            if operands
            else SCALAR
        )

    def matched(self, operands: list[Size], instructions: int) -> Size:
        """A pattern is compiled, and may be in all states at every character."""
        self.steps += instructions * (_COMPILE + operands[0].length // 4)
        return SCALAR


def _element(size: Size) -> Size:
    return size.element or SCALAR


def _scalar(estimate: _Estimate) -> Size:
    return estimate.taken(SCALAR)


_READERS: dict[int, Callable[[ConditionCost, bytes], _Measure]] = {
    3: ConditionCost._constant,
    5: ConditionCost._select,
    6: ConditionCost._call,
    7: ConditionCost._list,
    8: ConditionCost._struct,
    9: ConditionCost._comprehension,
}


# Protocol buffers: fields of a number and a value, which is an integer, or bytes that may be a
# message.


def _fields(data: int | bytes) -> Iterator[tuple[int, int | bytes]]:
    data = _bytes(data)
    at = 0
    while at < len(data):
        key, at = _varint(data, at)
        if key & 7 == 0:
            value, at = _varint(data, at)
            yield key >> 3, value
            continue
        length, at = _varint(data, at) if key & 7 == 2 else (8 if key & 7 == 1 else 4, at)
        yield key >> 3, data[at : at + length]
        at += length


def _varint(data: bytes, at: int) -> tuple[int, int]:
    value = shift = 0
    while True:
        byte = data[at]
        value |= (byte & 127) << shift
        shift, at = shift + 7, at + 1
        if byte < 128:
            return value, at


def _bytes(value: int | bytes) -> bytes:
    return value if isinstance(value, bytes) else b""


def _last(data: int | bytes, number: int) -> bytes:
    """The last value of a field; empty if there is none."""
    return next(
        (_bytes(value) for each, value in reversed([*_fields(data)]) if each == number), b""
    )


def _number(data: int | bytes, number: int) -> int:
    return next(
        (value for each, value in _fields(data) if each == number and isinstance(value, int)), 0
    )


def _text(data: int | bytes, number: int) -> str:
    return _last(data, number).decode("utf-8", "replace")
