"""How the types of a module lie in memory: sizes and offsets in bytes, by the decorations of the
module.
"""

from collections.abc import Iterator
from typing import NamedTuple

from . import numbers as op
from .constants import MAX_DEPTH, Constants
from .module import Module
from .words import SpirvError

MAX_BLOCK = 16 << 20
"""Bytes of a block; larger ones are an error."""


class Matrix(NamedTuple):
    """The layout of the matrices in a member of a structure: the stride of columns in bytes, or of
    rows.
    """

    stride: int = 0
    rows: bool = False


class Member(NamedTuple):
    """A member of a structure: its type, its offset in bytes, the layout of its matrices."""

    type_id: int
    offset: int
    matrix: Matrix


class Layouts:
    """The sizes of types. Methods raise SpirvError for types that cannot be in a block, and for
    blocks above MAX_BLOCK.
    """

    def __init__(self, module: Module, constants: Constants) -> None:
        self.module = module
        self.constants = constants
        self._sizes: dict[tuple[int, Matrix], int] = {}

    def kind(self, type_id: int) -> tuple[int, ...]:
        """The words of a type."""
        return self.module.types.get(type_id, (0,))

    def count(self, kind: tuple[int, ...]) -> int:
        """The number of elements of an array type; 0 for a runtime array."""
        if kind[0] == op.TYPE_RUNTIME_ARRAY:
            return 0
        count = self.constants.values.get(kind[2]) if len(kind) > 2 else None
        if type(count) is not int or count < 1:
            raise SpirvError("the size of an array is unknown")
        return count

    def stride(self, type_id: int) -> int:
        """The stride of an array in bytes."""
        stride = self.module.decoration(type_id, op.ARRAY_STRIDE)
        if not stride:
            raise SpirvError("an array in a block has no ArrayStride")
        return stride

    def members(self, type_id: int) -> Iterator[Member]:
        """The members of a structure."""
        decorations = self.module.members.get(type_id, {})
        for number, member in enumerate(self.kind(type_id)[1:]):
            stated = decorations.get(number, {})
            if not stated.get(op.OFFSET):
                raise SpirvError("a member of a block has no Offset")
            stride = stated.get(op.MATRIX_STRIDE) or (0,)
            yield Member(member, stated[op.OFFSET][0], Matrix(stride[0], op.ROW_MAJOR in stated))

    def size(self, type_id: int, matrix: Matrix | None = None, depth: int = 0) -> int:
        """The size of a type, in which runtime arrays have no elements."""
        key = (type_id, matrix or Matrix())
        if key not in self._sizes:
            if depth > MAX_DEPTH:
                raise SpirvError("the types of a block are nested too deeply")
            size = self._size(type_id, key[1], depth + 1)
            if size > MAX_BLOCK:
                raise SpirvError(f"a block is larger than {MAX_BLOCK >> 20} MiB")
            self._sizes[key] = size
        return self._sizes[key]

    def _size(self, type_id: int, matrix: Matrix, depth: int) -> int:
        kind = self.kind(type_id)
        number = kind[0]
        if number in (op.TYPE_INT, op.TYPE_FLOAT) and len(kind) > 1 and kind[1] in (8, 16, 32, 64):
            return kind[1] // 8
        if number == op.TYPE_VECTOR and len(kind) > 2 and 2 <= kind[2] <= 4:
            return self.size(kind[1], None, depth) * kind[2]
        column = self.kind(kind[1]) if number == op.TYPE_MATRIX and len(kind) > 2 else ()
        if column and column[0] == op.TYPE_VECTOR and 2 <= kind[2] <= 4:
            if self.size(kind[1], None, depth) > matrix.stride * 4:
                raise SpirvError("a matrix in a block has no MatrixStride")
            return matrix.stride * (column[2] if matrix.rows else kind[2])
        if number in (op.TYPE_ARRAY, op.TYPE_RUNTIME_ARRAY) and len(kind) > 1:
            self.size(kind[1], matrix, depth)
            return self.count(kind) * self.stride(type_id)
        if number == op.TYPE_STRUCT:
            return self._struct_size(type_id, depth)
        raise SpirvError(
            "a block has pointers to buffers"
            if number == op.TYPE_POINTER
            else "a block has a member of an unknown type"
        )

    def _struct_size(self, type_id: int, depth: int) -> int:
        end = total = 0
        for member in self.members(type_id):
            size = self.size(member.type_id, member.matrix, depth)
            end, total = max(end, member.offset + size), total + size
            if total > MAX_BLOCK:
                raise SpirvError(f"a block is larger than {MAX_BLOCK >> 20} MiB")
        return end

    def runtime_array(self, type_id: int) -> Member | None:
        """The runtime array at the end of a structure, which may be that of its last member."""
        last: Member | None = None
        offset = 0
        for _ in range(MAX_DEPTH):
            if self.kind(type_id)[0] != op.TYPE_STRUCT:
                break
            *_, last = [None, *self.members(type_id)]
            if last is None:
                return None
            type_id, offset = last.type_id, offset + last.offset
        return (
            last._replace(offset=offset)
            if last is not None and self.kind(last.type_id)[0] == op.TYPE_RUNTIME_ARRAY
            else None
        )
