"""The values of a module's constants, with specialization."""

from __future__ import annotations

from collections.abc import Mapping

from . import numbers as op
from .module import Module
from .values import MAX_PARTS, Opaque, Value, computed, given, literal, small, weight

MAX_DEPTH = 16
"""Levels of nested types."""

_BOOLEANS = {
    op.CONSTANT_TRUE: True,
    op.SPEC_CONSTANT_TRUE: True,
    op.CONSTANT_FALSE: False,
    op.SPEC_CONSTANT_FALSE: False,
}
_ZEROS = {op.TYPE_BOOL: False, op.TYPE_INT: 0, op.TYPE_FLOAT: 0.0}


class Constants:
    """Values by id; unknown values are opaque."""

    def __init__(self, module: Module, specialization: Mapping[int, float | bool]) -> None:
        self.module = module
        self.values: dict[int, Value] = {}
        self._parts: dict[int, int] = {}
        """The numbers and tuples in composite constants."""
        self._nulls: dict[int, Value] = {}
        for identity, made in module.constants.items():
            value = self._value(identity, made, specialization)
            self.values[identity] = Opaque() if value is None else value

    def _value(
        self, identity: int, made: tuple[int, ...], specialization: Mapping[int, float | bool]
    ) -> Value:
        number, type_id, *operands = made
        kind = self.module.types.get(type_id, ())
        if number in (op.SPEC_CONSTANT_TRUE, op.SPEC_CONSTANT_FALSE, op.SPEC_CONSTANT):
            spec = self.module.decoration(identity, op.SPEC_ID)
            if spec is not None and spec in specialization:
                return given(kind, specialization[spec])
        if number in _BOOLEANS:
            return _BOOLEANS[number]
        if number in (op.CONSTANT, op.SPEC_CONSTANT):
            return literal(kind, tuple(operands))
        if number in (op.CONSTANT_COMPOSITE, op.SPEC_CONSTANT_COMPOSITE):
            parts = tuple(self.values.get(part) for part in operands[: MAX_PARTS + 1])
            # A part may have parts of its own, which many constants may share.
            count = self._parts[identity] = 1 + sum(
                self._parts.get(part, 1) for part in operands[: MAX_PARTS + 1]
            )
            return None if None in parts or count > MAX_PARTS else parts
        if number == op.CONSTANT_NULL:
            if type_id not in self._nulls:
                self._nulls[type_id] = self.null(type_id)
            null = self._nulls[type_id]
            self._parts[identity] = weight(null)
            return null
        if number == op.SPEC_CONSTANT_OP and operands:
            value = self._made(operands[0], kind, tuple(operands[1:]))
            self._parts[identity] = weight(value)
            return value
        return None

    def _made(self, number: int, kind: tuple[int, ...], operands: tuple[int, ...]) -> Value:
        """The result of an OpSpecConstantOp."""
        if number == op.COMPOSITE_EXTRACT and len(operands) > 1:
            value = self.values.get(operands[0])
            for index in operands[1:]:
                value = value[index] if type(value) is tuple and index < len(value) else None
            return value
        values = tuple(self.values.get(each) for each in operands[:3])
        width = self.width(operands[-1]) if operands else 32
        if not kind or kind[0] != op.TYPE_VECTOR:
            return computed(number, kind, values, width)
        inner, count = self.module.types.get(kind[1], ()), kind[2]
        if not all(type(each) is tuple and len(each) == count for each in values):
            return None
        parts = tuple(computed(number, inner, own, width) for own in zip(*values, strict=True))
        return None if None in parts else parts

    def width(self, identity: int) -> int:
        """The width of an integer constant or of its components in bits; 32 if it is unknown."""
        _, type_id, *_ = self.module.constants.get(identity, (0, 0))
        kind = self.module.types.get(type_id, ())
        if kind and kind[0] == op.TYPE_VECTOR and len(kind) > 1:
            kind = self.module.types.get(kind[1], ())
        return (
            kind[1]
            if len(kind) > 1
            and kind[0] in (op.TYPE_INT, op.TYPE_FLOAT)
            and kind[1] in (8, 16, 32, 64)
            else 32
        )

    def null(self, type_id: int, depth: int = 0) -> Value:
        """The zero of a type; None if it has none or is too large."""
        kind = self.module.types.get(type_id, ())
        if not kind or depth > MAX_DEPTH:
            return None
        if kind[0] in _ZEROS:
            return _ZEROS[kind[0]]
        parts = self.parts(kind)
        if parts is None:
            return None
        made: tuple[Value, ...] = ()
        for part in parts:
            value = self.null(part, depth + 1)
            made = (*made, value)
            if value is None or not small(made):
                return None
        return made

    def parts(self, kind: tuple[int, ...]) -> list[int] | None:
        """The member types of a composite type; None if it is not composite or is too large."""
        count: Value = None
        if len(kind) > 2 and kind[0] in (op.TYPE_VECTOR, op.TYPE_MATRIX):
            count = kind[2]
        elif len(kind) > 2 and kind[0] == op.TYPE_ARRAY:
            count = self.values.get(kind[2])
        elif kind and kind[0] == op.TYPE_STRUCT and len(kind) - 1 <= MAX_PARTS:
            return list(kind[1:])
        return [kind[1]] * count if type(count) is int and 0 < count <= MAX_PARTS else None
