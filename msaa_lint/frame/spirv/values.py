"""The known values of a shader, and arithmetic on them.

A value is a number or a boolean; a tuple, of a vector, matrix, array or structure; a Sum of samples
that were fetched, or the Extreme of some; a Pointer; or an Opaque, of which only is known whether
it is the same as another.
"""

from __future__ import annotations

import math
import operator
import struct
from collections.abc import Callable
from typing import Any, NamedTuple

from . import numbers as op

Value = Any

MAX_PARTS = 256
"""Numbers and tuples in one value; a larger value is opaque."""

MAX_TERMS = 256
"""Samples in one sum: more than any image has, for four components and several images."""


class Opaque:
    """An unknown value. `held` has the values that it may be, for when it is used; unknown values
    with the same `origin` are equal.
    """

    __slots__ = ("held", "origin")

    def __init__(self, held: tuple[Any, ...] = ()) -> None:
        self.held = held
        self.origin: tuple[Any, ...] = ()


class Pointer(NamedTuple):
    """The place of a value: the variable, then the indices of members."""

    root: int
    path: tuple[Value, ...]


Term = tuple[int, int, int]
"""A fetched value: the texel (image and place), the component, the sample."""


class Sum:
    """A scalar: a sum of samples times factors."""

    __slots__ = ("terms",)

    def __init__(self, terms: dict[Term, float]) -> None:
        self.terms = terms

    def average(self) -> tuple[int, int] | None:
        """The texel and the number of samples that this is the average of: samples 0 and up of one
        component.
        """
        count = len(self.terms)
        if count < 2:
            return None
        fetched, component, _ = next(iter(self.terms))
        for (other, part, sample), factor in self.terms.items():
            if (
                other != fetched
                or part != component
                or sample >= count
                or abs(factor * count - 1) > 1e-5
            ):
                return None
        return fetched, count


class Extreme:
    """A scalar: the minimum or maximum of samples, and possibly a constant bound."""

    __slots__ = ("kind", "terms")

    def __init__(self, kind: str, terms: frozenset[Term]) -> None:
        self.kind = kind
        self.terms = terms


def plain(value: Value) -> bool:
    """Whether a value is a number or a boolean."""
    return type(value) in (int, float, bool)


def telling(value: Value) -> bool:
    """Whether a value, or a component of it, contains samples."""
    if type(value) is tuple:
        return any(type(part) is Sum or type(part) is Extreme for part in value)
    return type(value) is Sum or type(value) is Extreme


def small(value: Value) -> bool:
    """Whether a value has at most MAX_PARTS numbers and tuples, which also bounds its nesting."""
    return type(value) is not tuple or _parts(value, MAX_PARTS) <= MAX_PARTS


def weight(value: Value) -> int:
    """What it takes to copy a value: its numbers, tuples and terms; at most some thousands, as
    values and sums are limited.
    """
    if type(value) is tuple:
        return 1 + sum(map(weight, value))
    return len(value.terms) if type(value) is Sum or type(value) is Extreme else 1


def _parts(value: tuple[Value, ...], most: int) -> int:
    """The number of numbers and tuples in a value; counting stops above `most`."""
    count = 1
    for part in value:
        count += _parts(part, most - count) if type(part) is tuple else 1
        if count > most:
            break
    return count


def combined(one: Value, other: Value, sign: float) -> Sum | None:
    """The sum of two scalars with samples; None if it is not a Sum."""
    if plain(other) and other == 0 and type(one) is Sum:
        return one
    if plain(one) and one == 0 and type(other) is Sum:
        return Sum({term: sign * factor for term, factor in other.terms.items()})
    if (
        type(one) is not Sum
        or type(other) is not Sum
        or len(one.terms) + len(other.terms) > MAX_TERMS
    ):
        return None
    terms = dict(one.terms)
    for term, factor in other.terms.items():
        terms[term] = terms.get(term, 0.0) + sign * factor
    return Sum(terms)


def scaled(one: Value, factor: float) -> Sum | None:
    """A sum times a number; None if it is not a Sum."""
    if type(one) is not Sum or not math.isfinite(factor):
        return None
    return Sum({term: own * factor for term, own in one.terms.items()})


def extreme(kind: str, one: Value, other: Value) -> Extreme | None:
    """The minimum or maximum of two scalars with samples; None if it cannot be represented."""
    terms: frozenset[Term] = frozenset()
    for each in (one, other):
        if type(each) is Extreme and each.kind == kind:
            terms |= each.terms
        elif type(each) is Sum and len(each.terms) == 1 and next(iter(each.terms.values())) == 1.0:
            terms |= each.terms.keys()
        elif not plain(each):
            return None
    return Extreme(kind, terms) if 0 < len(terms) <= MAX_TERMS else None


# Numbers


def wrapped(value: int, width: int, signed: bool) -> int:
    """An integer wrapped to a type of that width."""
    value &= (1 << width) - 1
    return value - (1 << width) if signed and value >> (width - 1) else value


def as_float(value: float, width: int) -> float:
    """A float rounded to a type of that width."""
    if width == 64 or not math.isfinite(value):
        return value
    try:
        form = "<f" if width == 32 else "<e"
        result: float = struct.unpack(form, struct.pack(form, value))[0]
        return result
    except (OverflowError, struct.error):
        return math.copysign(math.inf, value)


def literal(kind: tuple[int, ...], words: tuple[int, ...]) -> Value:
    """The value of an OpConstant's literal by its type; None if it has none."""
    if (
        len(kind) < 2
        or not words
        or kind[1] not in (8, 16, 32, 64)
        or (kind[1] == 64 and len(words) < 2)
    ):
        return None
    bits = words[0] | words[1] << 32 if kind[1] == 64 else words[0]
    if kind[0] == op.TYPE_INT:
        return wrapped(bits, kind[1], len(kind) > 2 and kind[2] == 1)
    if kind[0] != op.TYPE_FLOAT or kind[1] == 8:
        return None
    return struct.unpack_from({16: "<e", 32: "<f", 64: "<d"}[kind[1]], bits.to_bytes(8, "little"))[
        0
    ]


def given(kind: tuple[int, ...], value: float | bool) -> Value:
    """The value of a specialization constant by its type; None if the type cannot have it."""
    if not kind or not math.isfinite(value):
        return None
    if kind[0] == op.TYPE_BOOL:
        return bool(value)
    if (
        kind[0] == op.TYPE_INT
        and len(kind) > 2
        and kind[1] in (8, 16, 32, 64)
        and float(value).is_integer()
    ):
        return wrapped(int(value), kind[1], kind[2] == 1)
    return as_float(float(value), kind[1]) if kind[0] == op.TYPE_FLOAT and len(kind) > 1 else None


def _quotient(one: int, other: int) -> int:
    """The quotient rounded toward zero."""
    whole = abs(one) // abs(other)
    return whole if (one < 0) == (other < 0) else -whole


_INTEGERS: dict[int, Callable[[int, int], int]] = {
    128: operator.add,
    130: operator.sub,
    132: operator.mul,
    134: operator.floordiv,
    135: _quotient,
    137: operator.mod,
    138: lambda one, other: one - _quotient(one, other) * other,
    139: operator.mod,
    194: lambda one, other: one >> other if 0 <= other < 64 else 0,
    195: lambda one, other: one >> other if 0 <= other < 64 else (-1 if one < 0 else 0),
    196: lambda one, other: one << other if 0 <= other < 64 else 0,
    197: operator.or_,
    198: operator.xor,
    199: operator.and_,
}
_UNSIGNED = frozenset({134, 137, 170, 171, 172, 174, 176, 178, 194})

_COMPARISONS: dict[int, Callable[[Any, Any], bool]] = {
    **dict.fromkeys((164, 170, 180), operator.eq),
    **dict.fromkeys((165, 171, 182), operator.ne),
    166: lambda one, other: bool(one or other),
    167: lambda one, other: bool(one and other),
    **dict.fromkeys((172, 173, 186), operator.gt),
    **dict.fromkeys((174, 175, 190), operator.ge),
    **dict.fromkeys((176, 177, 184), operator.lt),
    **dict.fromkeys((178, 179, 188), operator.le),
}

_FLOATS: dict[int, Callable[[float, float], float]] = {
    129: operator.add,
    131: operator.sub,
    133: operator.mul,
    136: operator.truediv,
}


def computed(
    number: int, kind: tuple[int, ...], operands: tuple[Value, ...], widths: int = 32
) -> Value:
    """The number that an instruction computes from numbers; None if it is unknown. `kind` is the
    type of the result.
    """
    if not all(map(plain, operands)) or not kind:
        return None
    try:
        return _computed(number, kind, operands, widths)
    except (ArithmeticError, ValueError, TypeError, IndexError):
        return None


def _computed(number: int, kind: tuple[int, ...], operands: tuple[Value, ...], width: int) -> Value:
    if number == 169:
        return operands[1] if operands[0] else operands[2]
    if number == 168:
        return not operands[0]
    if number in _UNSIGNED:
        operands = tuple(int(each) & ((1 << width) - 1) for each in operands)
    if number in _COMPARISONS:
        return _COMPARISONS[number](operands[0], operands[1])
    if kind[0] == op.TYPE_INT and len(kind) > 2 and kind[1] in (8, 16, 32, 64):
        signed = kind[2] == 1
        if number in _INTEGERS:
            return wrapped(_INTEGERS[number](operands[0], operands[1]), kind[1], signed)
        if number == 126:
            return wrapped(-operands[0], kind[1], signed)
        if number == 200:
            return wrapped(~operands[0], kind[1], signed)
        if number == 113:
            return wrapped(int(operands[0]) & ((1 << width) - 1), kind[1], signed)
        if number in (109, 110, 114) or (number == 124 and type(operands[0]) is int):
            return wrapped(int(operands[0]), kind[1], signed)
    if kind[0] == op.TYPE_FLOAT and len(kind) > 1:
        if number in _FLOATS:
            return as_float(_FLOATS[number](operands[0], operands[1]), kind[1])
        if number == 127:
            return -operands[0]
        if number == 112:
            return as_float(float(int(operands[0]) & ((1 << width) - 1)), kind[1])
        if number in (111, 115):
            return as_float(float(operands[0]), kind[1])
    return None
