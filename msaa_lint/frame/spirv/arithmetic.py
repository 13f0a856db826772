"""Arithmetic on samples: sums, fractions, minima and maxima. Any other operation counts as a use that is not followed."""

from __future__ import annotations

from collections.abc import Sequence

from . import numbers as op
from .state import State, keyed, met
from .values import Opaque, Pointer, Sum, Value, combined, computed, extreme, plain, scaled, telling

_EXTREMES = {37: "MIN", 38: "MIN", 39: "MIN", 79: "MIN", 40: "MAX", 41: "MAX", 42: "MAX", 80: "MAX"}
"""Instructions of GLSL.std.450."""

_PURE = frozenset({*range(77, 85), *range(109, 125), *range(126, 153), *range(154, 192), *range(194, 206)})
"""Instructions with equal results for equal operands."""


def _has_numbers(value: Value) -> bool:
    return type(value) is tuple and any(map(plain, value))


class Arithmetic(State):
    """The instructions that compute numbers from numbers."""

    def _other(self, number: int, at: int, end: int) -> None:
        """An instruction that is not followed: its operands count as used, its result is unknown."""
        words = self.words
        result = end > at + 2 and words[at + 1] in self.module.types
        operands = [self._value(each) for each in words[at + (3 if result else 1) : end]]
        if not result:
            for value in operands:
                self._escape(value)
            return
        kind = self._kind(words[at + 1])
        if number in _PURE and all(map(plain, operands)) and self._width(words[at + 1]) == 1:
            made = computed(number, kind, tuple(operands), self._bits(words[at + 3])) if operands else None
            if made is not None:
                self._assign(words[at + 2], made)
                return
        for value in operands:
            self._escape(value)
        if number in _PURE:
            self._assign(words[at + 2], self._same_as(number, words[at + 1], *map(keyed, operands)))
        else:
            self._assign(words[at + 2], Opaque())

    def _bits(self, identity: int) -> int:
        """The width of an integer operand: 32 except for constants with another width."""
        return self.constants.width(identity)

    def _arithmetic(self, at: int, end: int) -> None:
        words = self.words
        number, width = words[at] & 0xFFFF, self._width(words[at + 1])
        one, other = self._value(words[at + 3]), self._value(words[at + 4]) if end > at + 4 else Opaque()
        kind = self._kind(words[at + 1])
        if number == 142:
            number, other = 133, (other,) * width
        if width == 1:
            self._assign(words[at + 2], self._scalar(number, kind, one, other))
            return
        if width and (telling(one) or telling(other) or (_has_numbers(one) and _has_numbers(other))):
            ones, others = self._components(one, width), self._components(other, width)
            if ones is not None and others is not None:
                inner = self._kind(kind[1])
                made = tuple(self._scalar(number, inner, a, b) for a, b in zip(ones, others, strict=True))
                self._assign(words[at + 2], made)
                return
        self._escape(one)
        self._escape(other)
        self._assign(words[at + 2], self._same_as(number, words[at + 1], keyed(one), keyed(other)))

    def _scalar(self, number: int, kind: tuple[int, ...], one: Value, other: Value) -> Value:
        """The result of an addition, subtraction, multiplication or division of floats."""
        made: Value = None
        if plain(one) and plain(other):
            made = computed(number, kind, (one, other))
        elif number in (129, 131):
            made = combined(one, other, 1.0 if number == 129 else -1.0)
        elif number == 133:
            made = scaled(one, other) if plain(other) else scaled(other, one) if plain(one) else None
        elif number == 136 and plain(other) and other != 0:
            made = scaled(one, 1.0 / other)
        if type(made) is Sum:
            return self._settled(made)
        if made is None:
            self._escape(one)
            self._escape(other)
            made = self._same_as(number, keyed(one), keyed(other))
        return made

    def _negate(self, at: int, end: int) -> None:
        words = self.words
        value, kind = self._value(words[at + 3]), self._kind(words[at + 1])
        parts = value if type(value) is tuple else (value,)
        inner = self._kind(kind[1]) if kind and kind[0] == op.TYPE_VECTOR else kind
        made = []
        for part in parts:
            number = computed(127, inner, (part,)) if plain(part) else scaled(part, -1.0)
            if number is None:
                self._escape(part)
                number = self._same_as(127, keyed(part))
            made.append(number)
        self._assign(words[at + 2], tuple(made) if type(value) is tuple else made[0])

    def _select(self, at: int, end: int) -> None:
        words = self.words
        condition, one, other = (self._value(each) for each in words[at + 3 : at + 6]) if end >= at + 6 else (Opaque(),) * 3
        if plain(condition):
            self._assign(words[at + 2], one if condition else other)
            return
        self._escape(condition)
        self._assign(words[at + 2], met(one, other))

    def _extended(self, at: int, end: int) -> None:
        words = self.words
        known = self.module.imports.get(words[at + 3], "") == "GLSL.std.450"
        number = words[at + 4]
        operands = [self._value(each) for each in words[at + 5 : end]]
        if known and number in _EXTREMES and len(operands) == 2:
            self._assign(words[at + 2], self._extreme(number, words[at + 1], operands[0], operands[1]))
            return
        if known and number == 50 and len(operands) == 3:
            self._assign(words[at + 2], self._fused(words[at + 1], operands))
            return
        for value in operands:
            self._escape(value)
            if isinstance(value, Pointer):
                self._stored(value, Opaque())
        if known and number not in (35, 51):
            self._assign(words[at + 2], self._same_as("extended", number, words[at + 1], *map(keyed, operands)))
        else:
            self._assign(words[at + 2], Opaque())

    def _extreme(self, number: int, type_id: int, one: Value, other: Value) -> Value:
        width = self._width(type_id)
        kind = _EXTREMES[number]
        pairs = [(one, other)]
        if width > 1:
            ones, others = self._components(one, width), self._components(other, width)
            if ones is None or others is None:
                ones = others = ()
                self._escape((one, other))
                return Opaque()
            pairs = list(zip(ones, others, strict=True))
        made: list[Value] = []
        for first, second in pairs:
            value: Value = None
            if plain(first) and plain(second):
                value = min(first, second) if kind == "MIN" else max(first, second)
            else:
                value = extreme(kind, first, second)
            if value is None:
                self._escape((first, second))
                value = self._same_as("extended", number, keyed(first), keyed(second))
            made.append(value)
        return tuple(made) if width > 1 else made[0]

    def _fused(self, type_id: int, operands: Sequence[Value]) -> Value:
        """a * b + c."""
        width = self._width(type_id)
        kind = self._kind(type_id)
        if width == 1:
            return self._scalar(129, kind, self._scalar(133, kind, operands[0], operands[1]), operands[2])
        parts = [self._components(value, width) for value in operands] if width else [None]
        if None in parts:
            self._escape(tuple(operands))
            return Opaque()
        inner = self._kind(kind[1])
        columns = zip(*(part for part in parts if part is not None), strict=True)
        return tuple(self._scalar(129, inner, self._scalar(133, inner, a, b), c) for a, b, c in columns)
