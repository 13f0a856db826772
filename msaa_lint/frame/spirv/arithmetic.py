"""Arithmetic on samples: sums, fractions, minima and maxima. Any other operation counts as a use
that is not followed.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

from .state import State, keyed, met
from .values import Opaque, Pointer, Sum, Value, combined, computed, extreme, plain, scaled, telling

_EXTREMES = {37: "MIN", 38: "MIN", 39: "MIN", 79: "MIN", 40: "MAX", 41: "MAX", 42: "MAX", 80: "MAX"}
"""Instructions of GLSL.std.450."""

_PURE = frozenset(
    {*range(77, 85), *range(109, 125), *range(126, 153), *range(154, 192), *range(194, 206)}
)
"""Instructions with equal results for equal operands."""


def _has_numbers(value: Value) -> bool:
    return type(value) is tuple and any(map(plain, value))


class Arithmetic(State):
    """The instructions that compute numbers from numbers. Every method for an instruction returns
    the value of its result.
    """

    def _other(self, number: int, at: int, end: int) -> Value:
        """An instruction that is not followed: its operands count as used, its result is unknown.
        None if it has no result.
        """
        words = self.words
        has_result = end > at + 2 and words[at + 1] in self.module.types
        operands = [self._value(each) for each in words[at + (3 if has_result else 1) : end]]
        pure = has_result and number in _PURE
        if pure and operands and self._width(words[at + 1]) == 1:
            value = computed(
                number,
                self._kind(words[at + 1]),
                tuple(operands),
                self.constants.width(words[at + 3]),
            )
            if value is not None:
                return value
        if pure:
            return self._unknown((number, words[at + 1]), *operands)
        self._escape(*operands)
        return Opaque() if has_result else None

    def _by_component(
        self, type_id: int, operation: Callable[..., Value], *operands: Value
    ) -> Value:
        """The results of an operation on scalars for each component of the result's type; unknown
        if an operand has other components.
        """
        kind, width = self._kind(type_id), self._width(type_id)
        if width == 1:
            return operation(kind, *operands)
        parts: list[Any] = [self._components(value, width) for value in operands]
        if not width or None in parts:
            self._escape(*operands)
            return Opaque()
        inner = self._kind(kind[1])
        return tuple([operation(inner, *scalars) for scalars in zip(*parts, strict=True)])

    def _arithmetic(self, at: int, end: int) -> Value:
        words = self.words
        number, type_id, width = words[at] & 0xFFFF, words[at + 1], self._width(words[at + 1])
        one, other = self._value(words[at + 3]), self._value(words[at + 4])
        if number == 142:
            number, other = 133, (other,) * width
        if width == 1:
            return self._scalar(number, self._kind(type_id), one, other)
        if telling(one) or telling(other) or (_has_numbers(one) and _has_numbers(other)):
            return self._by_component(type_id, partial(self._scalar, number), one, other)
        return self._unknown((number, type_id), one, other)

    def _scalar(self, number: int, kind: tuple[int, ...], one: Value, other: Value) -> Value:
        """The result of an addition, subtraction, multiplication or division of floats."""
        value: Value = None
        if plain(one) and plain(other):
            value = computed(number, kind, (one, other))
        elif number in (129, 131):
            value = combined(one, other, 1.0 if number == 129 else -1.0)
        elif number == 133:
            value = (
                scaled(one, other) if plain(other) else scaled(other, one) if plain(one) else None
            )
        elif number == 136 and plain(other) and other != 0:
            value = scaled(one, 1.0 / other)
        if type(value) is Sum:
            return self._settled(value)
        return self._unknown(number, one, other) if value is None else value

    def _unknown(self, operation: object, *operands: Value) -> Opaque:
        """The unknown result of an operation that has equal results for equal operands."""
        self._escape(*operands)
        return self._same_as(operation, *[keyed(self._copy(each)) for each in operands])

    def _negate(self, at: int, end: int) -> Value:
        type_id, value = self.words[at + 1], self._value(self.words[at + 3])
        return (
            self._by_component(type_id, self._negated, value)
            if type(value) is tuple
            else self._negated(self._kind(type_id), value)
        )

    def _negated(self, kind: tuple[int, ...], value: Value) -> Value:
        negated = computed(127, kind, (value,)) if plain(value) else scaled(value, -1.0)
        return self._unknown(127, value) if negated is None else negated

    def _select(self, at: int, end: int) -> Value:
        condition, one, other = (self._value(each) for each in self.words[at + 3 : at + 6])
        if plain(condition):
            return one if condition else other
        self._escape(condition)
        return met(one, other)

    def _extended(self, at: int, end: int) -> Value:
        words = self.words
        known = self.module.imports.get(words[at + 3], "") == "GLSL.std.450"
        type_id, number = words[at + 1], words[at + 4]
        operands = [self._value(each) for each in words[at + 5 : end]]
        if known and number in _EXTREMES and len(operands) == 2:
            return self._by_component(type_id, partial(self._extreme, number), *operands)
        if known and number == 50 and len(operands) == 3:
            return self._by_component(type_id, self._fused, *operands)
        self._escape(*operands)
        for value in operands:
            if isinstance(value, Pointer):
                self._stored(value, Opaque())
        if known and number not in (35, 51):
            return self._unknown(("extended", number, type_id), *operands)
        return Opaque()

    def _extreme(self, number: int, kind: tuple[int, ...], one: Value, other: Value) -> Value:
        name = _EXTREMES[number]
        if plain(one) and plain(other):
            return min(one, other) if name == "MIN" else max(one, other)
        return extreme(name, one, other) or self._unknown(("extended", number), one, other)

    def _fused(self, kind: tuple[int, ...], one: Value, factor: Value, other: Value) -> Value:
        """one * factor + other."""
        return self._scalar(129, kind, self._scalar(133, kind, one, factor), other)
