"""Assembles SPIR-V: ids, types, constants, sections.

The modules contain what `msaa_lint.frame.spirv` reads. They are not meant for drivers.
"""

from __future__ import annotations

import array
import struct
from collections.abc import Sequence

from msaa_lint.frame.spirv import numbers as op

from .types import BOOL, DOUBLE, FLOAT, INT, UINT, VOID, Type

_MAGIC, _VERSION = 0x07230203, 0x00010000


class Assembly:
    """A module. `code` is the current function, and `variables` are the declarations at the start
    of its first block.
    """

    def __init__(self) -> None:
        self.bound = 1
        self.capabilities: set[int] = set()
        self.modes: list[int] = []
        self.decorations: list[int] = []
        self.declared: list[int] = []
        self.functions: list[int] = []
        self.code: list[int] = []
        self.variables: list[int] = []
        self.interface: list[int] = []
        self._types: dict[object, int] = {}
        self._constants: dict[object, int] = {}
        self.extended = self.id()

    def id(self) -> int:
        self.bound += 1
        return self.bound - 1

    def declare(self, number: int, *operands: int) -> None:
        """Adds an instruction outside of functions."""
        self.declared += (len(operands) + 1 << 16 | number, *operands)

    def emit(self, number: int, *operands: int) -> None:
        """Adds an instruction to the current function."""
        self.code += (len(operands) + 1 << 16 | number, *operands)

    def instruction(self, number: int, kind: Type, *operands: int) -> int:
        """Adds an instruction and returns the id of its result."""
        result = self.id()
        self.emit(number, self.type(kind), result, *operands)
        return result

    def decorate(self, target: int, number: int, *operands: int) -> None:
        self.decorations += (len(operands) + 3 << 16 | op.DECORATE, target, number, *operands)

    def decorate_member(self, target: int, member: int, number: int, *operands: int) -> None:
        self.decorations += (
            len(operands) + 4 << 16 | op.MEMBER_DECORATE,
            target,
            member,
            number,
            *operands,
        )

    def type(self, kind: Type) -> int:
        """Returns the id of a type."""
        type_id = self._types.get(kind)
        if type_id is not None:
            return type_id
        operands: Sequence[int]
        if kind[0] == "vec":
            number, operands = op.TYPE_VECTOR, (self.type(kind[1]), kind[2])
        elif kind[0] == "mat":
            number, operands = op.TYPE_MATRIX, (self.type(("vec", FLOAT, kind[2])), kind[1])
        elif kind[0] == "array":
            number, operands = op.TYPE_ARRAY, (self.type(kind[1]), self.number(UINT, kind[2]))
            if not kind[2]:
                number, operands = 29, operands[:1]
        elif kind[0] == "struct":
            number, operands = op.TYPE_STRUCT, [self.type(item) for _, item in kind[2]]
        elif kind[0] == "opaque":
            number, operands = (
                op.TYPE_IMAGE,
                (self.type(FLOAT), 1, 0, 0, int("MS" in str(kind[1])), 1, 0),
            )
        else:
            number, operands = _SCALARS[kind]
        type_id = self._types[kind] = self.id()
        self.declare(number, type_id, *operands)
        return type_id

    def pointer(self, storage: int, kind: Type) -> int:
        """Returns the id of a pointer type."""
        key = ("pointer", storage, kind)
        if key not in self._types:
            holds = self.type(kind)
            self._types[key] = self.id()
            self.declare(op.TYPE_POINTER, self._types[key], storage, holds)
        return self._types[key]

    def number(self, kind: Type, value: float | bool, specialization: int | None = None) -> int:
        """Returns the id of a constant. Each specialization constant is new."""
        key = (kind, type(value), value)
        if specialization is None and key in self._constants:
            return self._constants[key]
        type_id, constant_id = self.type(kind), self.id()
        special = 0 if specialization is None else op.SPEC_CONSTANT_TRUE - op.CONSTANT_TRUE
        if kind == BOOL:
            self.declare(
                (op.CONSTANT_TRUE if value else op.CONSTANT_FALSE) + special, type_id, constant_id
            )
        elif kind == DOUBLE:
            low, high = struct.unpack("<II", struct.pack("<d", value))
            self.declare(op.CONSTANT + special, type_id, constant_id, low, high)
        elif kind == FLOAT:
            self.declare(
                op.CONSTANT + special,
                type_id,
                constant_id,
                struct.unpack("<I", struct.pack("<f", value))[0],
            )
        else:
            self.declare(op.CONSTANT + special, type_id, constant_id, int(value) & 0xFFFFFFFF)
        if specialization is None:
            self._constants[key] = constant_id
        else:
            self.decorate(constant_id, op.SPEC_ID, specialization)
        return constant_id

    def variable(self, storage: int, kind: Type) -> int:
        """Adds a variable, global or of the current function, and returns its id."""
        pointer, variable_id = self.pointer(storage, kind), self.id()
        words = (4 << 16 | op.VARIABLE, pointer, variable_id, storage)
        if storage == op.FUNCTION_LOCAL:
            self.variables += words
        else:
            self.declared += words
            if storage in (op.INPUT, op.OUTPUT):
                self.interface.append(variable_id)
        return variable_id

    def begin(self) -> None:
        self.code, self.variables = [], []

    def end(self, identity: int, returns: Type, parameters: Sequence[tuple[int, int]]) -> None:
        """Ends a function. `parameters` are pairs of a type and an id."""
        result = self.type(returns)
        self.functions += (5 << 16 | op.FUNCTION, result, identity, 0, result)
        for kind, parameter in parameters:
            self.functions += (3 << 16 | op.FUNCTION_PARAMETER, kind, parameter)
        self.functions += (
            2 << 16 | op.LABEL,
            self.id(),
            *self.variables,
            *self.code,
            1 << 16 | op.FUNCTION_END,
        )

    def module(self, model: int, main: int) -> bytes:
        """Returns the module, which has one entry point."""
        named = struct.unpack("<2I", b"main\0\0\0\0")
        words = [_MAGIC, _VERSION, 0, self.bound, 0]
        for capability in sorted(self.capabilities):
            words += (2 << 16 | op.CAPABILITY, capability)
        library = struct.unpack("<4I", b"GLSL.std.450\0\0\0\0")
        words += (6 << 16 | op.EXT_INST_IMPORT, self.extended, *library)
        words += (
            3 + len(named) + len(self.interface) << 16 | op.ENTRY_POINT,
            model,
            main,
            *named,
            *self.interface,
        )
        for mode in self.modes:
            words += (3 << 16 | op.EXECUTION_MODE, main, mode)
        binary = array.array(
            "I",
            [
                word & 0xFFFFFFFF
                for part in (words, self.decorations, self.declared, self.functions)
                for word in part
            ],
        )
        return binary.tobytes()


_SCALARS: dict[Type, tuple[int, tuple[int, ...]]] = {
    VOID: (op.TYPE_VOID, ()),
    BOOL: (op.TYPE_BOOL, ()),
    INT: (op.TYPE_INT, (32, 1)),
    UINT: (op.TYPE_INT, (32, 0)),
    FLOAT: (op.TYPE_FLOAT, (32,)),
    DOUBLE: (op.TYPE_FLOAT, (64,)),
}
