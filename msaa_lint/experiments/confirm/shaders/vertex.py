"""SPIR-V of a vertex shader that draws the scene and writes the inputs of a given fragment shader.

Positions are those of scene.vert; the instance's index stands for the number of the draw. With u
and v from 0 to 1 across and down the picture and w from 0.5 to 1 by depth, a float is u or v, a
vec2 (u, v) or (v, u), a vec3 a rotation of (u, v, w), a vec4 the same with 1, by location, so that
vectors differ; integers are 0 and 1 for every other triangle.
"""

from __future__ import annotations

import array
import struct

from msaa_lint.frame.spirv import numbers as op
from msaa_lint.frame.spirv.constants import MAX_DEPTH
from msaa_lint.frame.spirv.interface import MAX_LOCATIONS, Interface, Varying
from msaa_lint.frame.spirv.layouts import Layouts
from msaa_lint.frame.spirv.words import MAGIC, SpirvError

MAX_CONSTITUENTS = 4 * MAX_LOCATIONS

DISTANCES = {3: 32, 4: 33}
"""BuiltIn ClipDistance and CullDistance, and the capability for each."""

MAX_DISTANCES = 8

POSITION, VERTEX_INDEX, INSTANCE_INDEX = 0, 42, 43
"""BuiltIn."""

MEMORY_MODEL, FUNCTION_TYPE = 14, 33
NEGATE, SDIV, FADD, FMUL, BITCAST, AND, EQUAL, GREATER, LOGICAL_AND = (
    127,
    135,
    129,
    133,
    124,
    199,
    170,
    173,
    167,
)


class _Words:
    """Sections of a module under construction; types and constants are created once."""

    def __init__(self) -> None:
        self.bound = 1
        self.decorations = array.array("I")
        self.declarations = array.array("I")
        self.body = array.array("I")
        self._known: dict[tuple[int, ...], int] = {}

    def id(self) -> int:
        self.bound += 1
        return self.bound - 1

    def decorate(self, *operands: int, member: bool = False) -> None:
        _add(self.decorations, op.MEMBER_DECORATE if member else op.DECORATE, *operands)

    def type(self, number: int, *operands: int) -> int:
        """The id of a type."""
        key = (number, *operands)
        if key not in self._known:
            self._known[key] = self.id()
            _add(self.declarations, number, self._known[key], *operands)
        return self._known[key]

    def constant(self, type_id: int, word: int) -> int:
        key = (op.CONSTANT, type_id, word)
        if key not in self._known:
            self._known[key] = self.id()
            _add(self.declarations, op.CONSTANT, type_id, self._known[key], word)
        return self._known[key]

    def variable(self, type_id: int, storage: int) -> int:
        pointer, variable = self.type(op.TYPE_POINTER, storage, type_id), self.id()
        _add(self.declarations, op.VARIABLE, pointer, variable, storage)
        return variable

    def value(self, number: int, type_id: int, *operands: int) -> int:
        """The result of an instruction of the function."""
        result = self.id()
        _add(self.body, number, type_id, result, *operands)
        return result


def _add(words: array.array[int], number: int, *operands: int) -> None:
    words.extend((len(operands) + 1 << 16 | number, *operands))


def vertex_shader(interface: Interface, layouts: Layouts) -> bytes:
    """The SPIR-V, version 1.0. Raises SpirvError, with the input by location, for one that cannot
    be written.
    """
    shader = _Vertex(layouts)
    for built_in, capability in DISTANCES.items():
        if built_in in interface.built_ins:
            shader.distances(built_in, capability, interface.built_ins[built_in])
    for varying in interface.inputs:
        if varying.location is None:
            raise SpirvError("an input has no location")
        try:
            shader.write(varying)
        except SpirvError as error:
            raise SpirvError(
                f"the input at location {varying.location}, of type {varying.type}, cannot be "
                f"written: {error}"
            ) from None
    return shader.code()


class _Vertex:
    def __init__(self, layouts: Layouts) -> None:
        self.layouts = layouts
        self.module = layouts.module
        self.words = words = _Words()
        self.main = words.id()
        self.void = words.type(op.TYPE_VOID)
        self.bool = words.type(op.TYPE_BOOL)
        self.int, self.uint = words.type(op.TYPE_INT, 32, 1), words.type(op.TYPE_INT, 32, 0)
        self.float = words.type(op.TYPE_FLOAT, 32)
        self.signature = words.type(FUNCTION_TYPE, self.void)
        self.interface: list[int] = []
        self.capabilities = [1]
        self._types: dict[int, int] = {}
        self._constituents = 0
        self._scene()

    def _vector(self, count: int, component: int | None = None) -> int:
        return self.words.type(op.TYPE_VECTOR, component or self.float, count)

    def _number(self, value: float) -> int:
        return self.words.constant(self.float, struct.unpack("=I", struct.pack("=f", value))[0])

    def _integer(self, value: int) -> int:
        return self.words.constant(self.int, value)

    def _built_in(self, type_id: int, storage: int, number: int) -> int:
        variable = self.words.variable(type_id, storage)
        self.words.decorate(variable, op.BUILT_IN, number)
        self.interface.append(variable)
        return variable

    def _scene(self) -> None:
        """The position as scene.vert has it, and the values that vary over the picture."""
        words = self.words
        triple = self._vector(3)
        position = words.variable(triple, op.INPUT)
        words.decorate(position, op.LOCATION, 0)
        self.interface.append(position)
        index, draw = (
            self._built_in(self.int, op.INPUT, number) for number in (VERTEX_INDEX, INSTANCE_INDEX)
        )
        clip = self._built_in(self._vector(4), op.OUTPUT, POSITION)
        stated = words.value(op.LOAD, triple, position)
        x, y, z = (
            words.value(op.COMPOSITE_EXTRACT, self.float, stated, number) for number in range(3)
        )
        triangle = words.value(
            SDIV, self.int, words.value(op.LOAD, self.int, index), self._integer(3)
        )
        odd = words.value(AND, self.int, words.value(op.LOAD, self.int, draw), self._integer(1))
        later = words.value(GREATER, self.bool, triangle, self._integer(0))
        turns = words.value(
            LOGICAL_AND, self.bool, later, words.value(EQUAL, self.bool, odd, self._integer(1))
        )
        x, y = (
            words.value(op.SELECT, self.float, turns, words.value(NEGATE, self.float, y), x),
            words.value(op.SELECT, self.float, turns, x, y),
        )
        _add(
            words.body,
            op.STORE,
            clip,
            words.value(op.COMPOSITE_CONSTRUCT, self._vector(4), x, y, z, self._number(1.0)),
        )
        half = self._number(0.5)
        self.values = [
            words.value(FADD, self.float, words.value(FMUL, self.float, each, half), half)
            for each in (x, y, z)
        ]
        self.parity = words.value(AND, self.int, triangle, self._integer(1))
        self.unsigned_parity = words.value(BITCAST, self.uint, self.parity)

    def distances(self, built_in: int, capability: int, length: int) -> None:
        """Adds distances to planes that cut nothing off."""
        if length > MAX_DISTANCES:
            raise SpirvError(
                f"it reads {length} distances to planes, of which there are at most {MAX_DISTANCES}"
            )
        words, one = self.words, self._number(1.0)
        self.capabilities.append(capability)
        kind = words.type(op.TYPE_ARRAY, self.float, words.constant(self.uint, length))
        variable = self._built_in(kind, op.OUTPUT, built_in)
        _add(
            words.body,
            op.STORE,
            variable,
            words.value(op.COMPOSITE_CONSTRUCT, kind, *[one] * length),
        )

    def write(self, varying: Varying) -> None:
        """Adds an output that matches an input."""
        assert varying.location is not None
        if varying.location + self._locations(varying.type_id) > MAX_LOCATIONS:
            raise SpirvError(f"it is beyond location {MAX_LOCATIONS - 1}")
        words = self.words
        variable = words.variable(self._type(varying.type_id), op.OUTPUT)
        # The members of a block have the locations.
        if self.module.decoration(varying.variable, op.LOCATION) is not None:
            words.decorate(variable, op.LOCATION, varying.location)
        if varying.component:
            words.decorate(variable, op.COMPONENT, varying.component)
        self.interface.append(variable)
        _add(words.body, op.STORE, variable, self._value(varying.type_id, varying.location))

    def _kind(self, type_id: int, depth: int) -> tuple[int, ...]:
        kind = self.layouts.kind(type_id)
        lengths = {
            op.TYPE_INT: 3,
            op.TYPE_FLOAT: 2,
            op.TYPE_VECTOR: 3,
            op.TYPE_MATRIX: 3,
            op.TYPE_ARRAY: 3,
            op.TYPE_STRUCT: 2,
        }
        if depth > MAX_DEPTH or len(kind) < lengths.get(kind[0], 1 << 16):
            raise SpirvError("its type is not one of an input")
        if kind[0] in (op.TYPE_INT, op.TYPE_FLOAT) and kind[1] != 32:
            raise SpirvError(f"only components of 32 bits are supported, not {kind[1]}")
        if kind[0] in (op.TYPE_VECTOR, op.TYPE_MATRIX) and not 2 <= kind[2] <= 4:
            raise SpirvError(
                f"a {'vector' if kind[0] == op.TYPE_VECTOR else 'matrix'} does not have {kind[2]} "
                "parts"
            )
        return kind

    def _elements(self, kind: tuple[int, ...]) -> list[int]:
        """The types of the elements of a composite that is not a vector."""
        if kind[0] == op.TYPE_STRUCT:
            return list(kind[1:])
        count = kind[2] if kind[0] == op.TYPE_MATRIX else self.layouts.count(kind)
        if count > MAX_LOCATIONS:
            raise SpirvError(f"it has more than {MAX_LOCATIONS} elements")
        return [kind[1]] * count

    def _locations(self, type_id: int, depth: int = 0) -> int:
        """The number of locations that a type takes."""
        kind = self._kind(type_id, depth)
        if kind[0] in (op.TYPE_INT, op.TYPE_FLOAT, op.TYPE_VECTOR):
            return 1
        elements = self._elements(kind)
        if len(elements) > MAX_LOCATIONS:
            raise SpirvError(f"it takes more than {MAX_LOCATIONS} locations")
        if kind[0] != op.TYPE_STRUCT:
            return len(elements) * self._locations(elements[0], depth + 1)
        total = 0
        for element in elements:
            total += self._locations(element, depth + 1)
            if total > MAX_LOCATIONS:
                raise SpirvError(f"it takes more than {MAX_LOCATIONS} locations")
        return total

    def _type(self, type_id: int, depth: int = 0) -> int:
        """A type of the fragment shader's module in this one."""
        if type_id not in self._types:
            self._types[type_id] = self._copied(type_id, depth)
        return self._types[type_id]

    def _copied(self, type_id: int, depth: int) -> int:
        kind, words = self._kind(type_id, depth), self.words
        if kind[0] in (op.TYPE_INT, op.TYPE_FLOAT):
            return words.type(*kind)
        if kind[0] in (op.TYPE_VECTOR, op.TYPE_MATRIX):
            return words.type(kind[0], self._type(kind[1], depth + 1), kind[2])
        if kind[0] == op.TYPE_ARRAY:
            length = words.constant(self.uint, self.layouts.count(kind))
            return words.type(op.TYPE_ARRAY, self._type(kind[1], depth + 1), length)
        members = [self._type(member, depth + 1) for member in kind[1:]]
        made = words.id()
        _add(words.declarations, op.TYPE_STRUCT, made, *members)
        if op.BLOCK in self.module.decorations.get(type_id, {}):
            words.decorate(made, op.BLOCK)
        for member, decorations in self.module.members.get(type_id, {}).items():
            for number in (op.LOCATION, op.COMPONENT):
                if decorations.get(number) and member < len(members):
                    words.decorate(made, member, number, decorations[number][0], member=True)
        return made

    def _value(self, type_id: int, location: int) -> int:
        self._constituents += 1
        if self._constituents > MAX_CONSTITUENTS:
            raise SpirvError("the inputs are too many")
        kind = self.layouts.kind(type_id)
        if kind[0] in (op.TYPE_INT, op.TYPE_FLOAT):
            return self._scalar(kind, location)
        if kind[0] == op.TYPE_VECTOR:
            return self.words.value(
                op.COMPOSITE_CONSTRUCT, self._type(type_id), *self._components(kind, location)
            )
        members = self.module.members.get(type_id, {}) if kind[0] == op.TYPE_STRUCT else {}
        parts = []
        for number, element in enumerate(self._elements(kind)):
            location = (members.get(number, {}).get(op.LOCATION) or (location,))[0]
            parts.append(self._value(element, location))
            location += self._locations(element)
        return self.words.value(op.COMPOSITE_CONSTRUCT, self._type(type_id), *parts)

    def _scalar(self, kind: tuple[int, ...], location: int) -> int:
        if kind[0] == op.TYPE_FLOAT:
            return self.values[location % 2]
        return self.parity if kind[2] else self.unsigned_parity

    def _components(self, kind: tuple[int, ...], location: int) -> list[int]:
        component = self.layouts.kind(kind[1])
        if component[0] == op.TYPE_INT:
            return [self._scalar(component, location)] * kind[2]
        if kind[2] == 2:
            return [self.values[location % 2], self.values[1 - location % 2]]
        rotated = [self.values[(number + location) % 3] for number in range(3)]
        return [*rotated, self._number(1.0)][: kind[2]]

    def code(self) -> bytes:
        """The module."""
        words = self.words
        function = array.array("I")
        _add(function, op.FUNCTION, self.void, self.main, 0, self.signature)
        _add(function, op.LABEL, words.id())
        function += words.body
        _add(function, op.RETURN)
        _add(function, op.FUNCTION_END)
        head = array.array("I", [MAGIC, 0x10000, 0, words.bound, 0])
        for capability in self.capabilities:
            _add(head, op.CAPABILITY, capability)
        _add(head, MEMORY_MODEL, 0, 1)
        _add(
            head,
            op.ENTRY_POINT,
            0,
            self.main,
            *struct.unpack("=2I", b"main\0\0\0\0"),
            *self.interface,
        )
        return (head + words.decorations + words.declarations + function).tobytes()
