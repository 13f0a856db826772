"""The contents of the buffers and push constants of shaders whose values are unknown.

Floating-point numbers are 0.5, 0.625, 0.75, and 0.875 in turn, by their place in a structure, so
that neither a vector nor a difference of neighbors is zero; integers, among them the bounds of
loops, are 1; matrices are identity matrices.
"""

from __future__ import annotations

import struct

from msaa_lint.frame.spirv import numbers as op
from msaa_lint.frame.spirv.layouts import MAX_BLOCK, Layouts, Matrix
from msaa_lint.frame.spirv.words import SpirvError

TAIL = 1 << 16
"""Bytes of a runtime array, but at least one element."""

MAX_KEPT = 1 << 12
"""Bytes of a type whose contents are kept for its next use."""

_FLOATS = {16: "<e", 32: "<f", 64: "<d"}


class BufferContents:
    """The contents of blocks, by type."""

    def __init__(self, layouts: Layouts) -> None:
        self.layouts = layouts
        self._made: dict[tuple[int, Matrix, int], bytes] = {}

    def of(self, block: int) -> bytes:
        """The bytes of a block, with its runtime array. SpirvError for one that is too large."""
        return self._bytes(block, Matrix(), 0)

    def _bytes(self, type_id: int, matrix: Matrix, phase: int) -> bytes:
        """The bytes of a type; `phase` selects the first of the floating-point numbers."""
        key = (type_id, matrix, phase % 4)
        if key in self._made:
            return self._made[key]
        # Types that have a size are limited in depth and size.
        self.layouts.size(type_id, matrix)
        made = self._new(type_id, matrix, phase)
        if len(made) <= MAX_KEPT:
            self._made[key] = made
        return made

    def _new(self, type_id: int, matrix: Matrix, phase: int) -> bytes:
        kind = self.layouts.kind(type_id)
        number = kind[0]
        if number == op.TYPE_FLOAT:
            return (
                struct.pack(_FLOATS[kind[1]], 0.5 + phase % 4 / 8)
                if kind[1] in _FLOATS
                else b"\0" * (kind[1] // 8)
            )
        if number == op.TYPE_INT:
            return (1).to_bytes(kind[1] // 8, "little")
        if number == op.TYPE_VECTOR:
            return b"".join(self._bytes(kind[1], Matrix(), phase + part) for part in range(kind[2]))
        if number == op.TYPE_MATRIX:
            return self._identity(kind, matrix, self.layouts.size(type_id, matrix))
        if number == op.TYPE_STRUCT:
            made = bytearray(self.layouts.size(type_id, matrix))
            for member in self.layouts.members(type_id):
                data = self._bytes(member.type_id, member.matrix, member.offset // 4)
                made[member.offset : member.offset + len(data)] = data
            return bytes(made)
        stride = self.layouts.stride(type_id)
        count = self.layouts.count(kind) or max(TAIL // stride, 1)
        if count * stride > MAX_BLOCK:
            raise SpirvError(f"a block is larger than {MAX_BLOCK >> 20} MiB")
        return self._bytes(kind[1], matrix, phase).ljust(stride, b"\0")[:stride] * count

    def _identity(self, kind: tuple[int, ...], matrix: Matrix, size: int) -> bytes:
        column = self.layouts.kind(kind[1])
        component = self.layouts.kind(column[1])
        made = bytearray(size)
        for diagonal in range(min(kind[2], column[2])):
            at = diagonal * (matrix.stride + component[1] // 8)
            one = struct.pack(_FLOATS[component[1]], 1.0) if component[1] in _FLOATS else b""
            made[at : at + len(one)] = one
        return bytes(made[:size])
