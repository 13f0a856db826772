"""Values and lvalues of GLSL in SPIR-V: loads and stores, conversions, constructors, arithmetic."""

import zlib
from collections.abc import Sequence
from typing import NamedTuple

from msaa_lint.frame.spirv import numbers as op
from msaa_lint.input.code.parsing import SyntaxNode, SyntaxReader

from .assembly import Assembly
from .text import ShaderLimitExceeded, UnsupportedShader
from .types import BOOL, DOUBLE, FLOAT, INT, UINT, Type, named, scalar_of, size_of, vector

MAX_DEPTH = 80
"""The maximum nesting of expressions."""

SIGNS: dict[str, tuple[int, int, int]] = {
    "+": (128, 128, 129), "-": (130, 130, 131), "*": (132, 132, 133), "/": (135, 134, 136),
    "%": (139, 137, 141),
    "<": (177, 176, 184), ">": (173, 172, 186), "<=": (179, 178, 188), ">=": (175, 174, 190),
    "==": (170, 170, 180), "!=": (171, 171, 182),
    "<<": (196, 196, 196), ">>": (195, 194, 194), "&": (199, 199, 199), "|": (197, 197, 197),
    "^": (198, 198, 198),
}  # fmt: skip
"""The instructions of an operator for int, uint, and float."""

_COMPARES = ("<", ">", "<=", ">=", "==", "!=")
_LETTERS = {letter: n % 4 for n, letter in enumerate("xyzwrgbastpq")}
LOGICAL_OR, LOGICAL_AND, LOGICAL_NOT, LOGICAL_EQUAL, LOGICAL_NOT_EQUAL, SELECT = (
    166,
    167,
    168,
    164,
    165,
    169,
)


class Value(NamedTuple):
    """A value and its type."""

    id: int
    type: Type


class Place(NamedTuple):
    """The target of a pointer, or some of its components."""

    pointer: int
    type: Type
    storage: int
    parts: tuple[int, ...] = ()


class Function(NamedTuple):
    """A function of the shader: its node, its return type, its id, and for each parameter the type,
    whether it is an output, and the name.
    """

    node: SyntaxNode
    returns: Type
    parameters: tuple[tuple[Type, bool, str], ...]
    id: int


Named = Place | Value | tuple[Place, int]
"""What a name stands for: a variable, a constant, a member of a block."""


class Values(SyntaxReader):
    """The values of one shader. `scopes` are the declared names, innermost last."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.out = Assembly()
        self.scopes: list[dict[str, Named]] = [{}]
        self.structs: dict[str, Type] = {}
        self.functions: dict[str, list[Function]] = {}
        self.by_types: dict[tuple[str, tuple[Type, ...]], Function] = {}
        """The first function of each name and types of parameters."""
        self.by_sizes: dict[tuple[str, tuple[int, ...]], list[Function]] = {}
        """The functions by name and numbers of components of parameters."""
        self.called_functions: list[Function] = []
        """Functions in the order of their first calls."""
        self._called: set[int] = set()
        self.fetches: list[tuple[str, int, int]] = []
        """Sample fetches: the name of the image, and the range of the call."""

    def unsupported(self, node: SyntaxNode, why: str) -> UnsupportedShader:
        return UnsupportedShader(f"`{' '.join(self.text_of(node)[:40].split())}` {why}")

    def parts(self, node: SyntaxNode, *fields: str) -> "list[SyntaxNode]":
        """Returns the children of a node in some fields. Raises UnsupportedShader if one is
        missing.
        """
        children = [
            child for field in fields if (child := node.child_by_field_name(field)) is not None
        ]
        if len(children) < len(fields):
            raise self.unsupported(node, "is not supported")
        return children

    def result(self, number: int, kind: Type, *operands: int) -> Value:
        """Adds an instruction and returns its result."""
        return Value(self.out.instruction(number, kind, *operands), kind)

    def constant_value(self, kind: Type, number: float | bool) -> Value:
        return Value(self.out.number(kind, number), kind)

    def variable(self, storage: int, kind: Type) -> Place:
        return Place(self.out.variable(storage, kind), kind, storage)

    def temporary(self, kind: Type) -> Place:
        """Returns a new variable of the current function."""
        return self.variable(op.FUNCTION_LOCAL, kind)

    def kind(self, name: str) -> Type | None:
        return self.structs.get(name) or named(name)

    def lookup(self, name: str) -> Named | None:
        for scope in reversed(self.scopes):
            if name in scope:
                return scope[name]
        return self.built_in(name)

    def built_in(self, name: str) -> Place | None:
        """Declares a built-in variable on its first use."""
        raise NotImplementedError

    def value(self, node: SyntaxNode, depth: int = 0) -> Value:
        """Returns the value of an expression."""
        raise NotImplementedError

    def add_function(self, name: str, function: Function) -> None:
        """Adds a function of the shader."""
        kinds = tuple(kind for kind, _, _ in function.parameters)
        self.functions.setdefault(name, []).append(function)
        self.by_types.setdefault((name, kinds), function)
        self.by_sizes.setdefault((name, tuple(map(size_of, kinds))), []).append(function)

    def overload(self, name: str, types: Sequence[Type]) -> Function | None:
        """Returns the function whose parameters have the argument types, or the types that they can
        be converted to.
        """
        same = self.by_types.get((name, tuple(types)))
        near = self.by_sizes.get((name, tuple(map(size_of, types))), ())
        return same or (near[0] if len(near) == 1 else None)

    def add_called(self, function: Function) -> None:
        """Adds a function that is called."""
        if function.id not in self._called:
            self._called.add(function.id)
            self.called_functions.append(function)

    # Lvalues

    def place(self, node: SyntaxNode, depth: int = 0) -> Place | None:
        """Returns the lvalue that an expression denotes, or None for an rvalue."""
        if depth > MAX_DEPTH:
            raise ShaderLimitExceeded(
                f"an expression of the shader nests more than {MAX_DEPTH} levels deep"
            )
        if node.type == "parenthesized_expression" and node.named_child_count == 1:
            return self.place(node.named_children[0], depth + 1)
        if node.type == "identifier":
            target = self.lookup(self.text_of(node))
            if target is None:
                raise self.unsupported(node, "is not declared")
            if isinstance(target, (Place, Value)):
                return target if isinstance(target, Place) else None
            return self.member(*target)
        if node.type not in ("field_expression", "subscript_expression"):
            return None
        argument = node.child_by_field_name("argument")
        base = self.place(argument, depth + 1) if argument is not None else None
        if base is None:
            return None
        if node.type == "subscript_expression":
            index_node = node.child_by_field_name("index")
            if index_node is None or base.parts:
                return None
            return self.access_chain(
                base, self.element(base.type, node), self.value(index_node, depth + 1).id
            )
        field = node.child_by_field_name("field")
        name = self.text_of(field)
        if base.type[0] == "struct":
            return self.member(base, self.index(base.type, name, node))
        parts = self.swizzle_parts(name, base.type, node)
        return base._replace(
            parts=tuple(base.parts[part] for part in parts) if base.parts else parts
        )

    def member(self, base: Place, index: int) -> Place:
        return self.access_chain(base, base.type[2][index][1], self.out.number(INT, index))

    def access_chain(self, base: Place, kind: Type, index: int) -> Place:
        pointer = self.out.id()
        self.out.emit(
            op.ACCESS_CHAIN, self.out.pointer(base.storage, kind), pointer, base.pointer, index
        )
        return Place(pointer, kind, base.storage)

    def element(self, kind: Type, node: SyntaxNode) -> Type:
        """Returns the element type of an indexed type."""
        if kind[0] not in ("array", "vec", "mat"):
            raise self.unsupported(node, "is not supported")
        element: Type = ("vec", FLOAT, kind[2]) if kind[0] == "mat" else kind[1]
        return element

    def index(self, kind: Type, name: str, node: SyntaxNode) -> int:
        """Returns the index of a structure member."""
        names = [member for member, _ in kind[2]]
        if name not in names:
            raise self.unsupported(node, "is not a member")
        return names.index(name)

    def swizzle_parts(self, name: str, kind: Type, node: SyntaxNode) -> tuple[int, ...]:
        """Returns the components of a swizzle."""
        size = size_of(kind)
        parts = tuple(_LETTERS.get(letter, 9) for letter in name)
        if not 0 < len(parts) <= 4 or any(part >= size for part in parts):
            raise self.unsupported(node, "is not supported")
        return parts

    def load(self, place: Place) -> Value:
        value = self.result(op.LOAD, place.type, place.pointer)
        return self.swizzle(value, place.parts) if place.parts else value

    def swizzle(self, value: Value, parts: tuple[int, ...]) -> Value:
        if size_of(value.type) == 1:
            return (
                self.construct(vector(value.type, len(parts)), [value]) if len(parts) > 1 else value
            )
        kind = vector(scalar_of(value.type), len(parts))
        if len(parts) == 1:
            return self.result(op.COMPOSITE_EXTRACT, kind, value.id, parts[0])
        return self.result(op.VECTOR_SHUFFLE, kind, value.id, value.id, *parts)

    def store(self, place: Place, value: Value) -> None:
        out = self.out
        if not place.parts:
            out.emit(op.STORE, place.pointer, self.as_type(value, place.type).id)
            return
        scalar = scalar_of(place.type)
        value = self.as_type(value, vector(scalar, len(place.parts)))
        size = size_of(place.type)
        if size == 1 or len(place.parts) == 1:
            target = (
                place
                if size == 1
                else self.access_chain(place, scalar, out.number(INT, place.parts[0]))
            )
            out.emit(op.STORE, target.pointer, value.id)
            return
        before = self.load(place._replace(parts=()))
        order = [size + place.parts.index(n) if n in place.parts else n for n in range(size)]
        out.emit(
            op.STORE,
            place.pointer,
            out.instruction(op.VECTOR_SHUFFLE, place.type, before.id, value.id, *order),
        )

    # Values

    def as_type(self, value: Value, kind: Type) -> Value:
        """Converts a value by GLSL's conversions or constructors between scalars and vectors of the
        same size.
        """
        if value.type == kind:
            return value
        one, other = scalar_of(value.type), scalar_of(kind)
        size = size_of(kind)
        if not size or size_of(value.type) != size:
            raise UnsupportedShader(
                f"conversion from {type_text(value.type)} to {type_text(kind)} is not supported"
            )
        if one == BOOL:
            yes, no = (
                self.splat(self.constant_value(other, literal_of(other, n)), size).id
                for n in (1, 0)
            )
            return self.result(SELECT, kind, value.id, yes, no)
        if other == BOOL:
            zero = self.splat(self.constant_value(one, literal_of(one, 0)), size)
            return self.result(SIGNS["!="][column(one)], kind, value.id, zero.id)
        real, made_real = one in (FLOAT, DOUBLE), other in (FLOAT, DOUBLE)
        number = (
            115
            if real and made_real
            else 111
            if one == INT and made_real
            else 112
            if made_real
            else 110
            if other == INT
            else 109
        )
        if not real and not made_real:
            number = 124
        return self.result(number, kind, value.id)

    def splat(self, value: Value, size: int) -> Value:
        if size == 1:
            return value
        kind = vector(value.type, size)
        return self.result(op.COMPOSITE_CONSTRUCT, kind, *[value.id] * size)

    def construct(self, kind: Type, values: Sequence[Value]) -> Value:
        """Returns a scalar or vector built by a constructor."""
        size, scalar = size_of(kind), scalar_of(kind)
        if not values or any(not size_of(item.type) for item in values):
            return self.opaque("construct", kind, values)
        if len(values) == 1 and size_of(values[0].type) == 1:
            return self.splat(self.as_type(values[0], scalar), size)
        if len(values) == 1 and size_of(values[0].type) >= size:
            whole = (
                values[0]
                if size_of(values[0].type) == size
                else self.swizzle(values[0], tuple(range(size)))
            )
            return self.as_type(whole, kind)
        parts = [self.as_type(item, vector(scalar, size_of(item.type))) for item in values]
        if sum(size_of(part.type) for part in parts) != size:
            single = [self.swizzle(part, (n,)) for part in parts for n in range(size_of(part.type))]
            parts = single[:size]
            if len(parts) < size:
                raise UnsupportedShader(f"a {type_text(kind)} constructor has too few arguments")
        return self.result(op.COMPOSITE_CONSTRUCT, kind, *(part.id for part in parts))

    def opaque(self, name: str, kind: Type, values: Sequence[Value]) -> Value:
        """Returns the result of an operation that is not modeled; equal operands give equal
        results.
        """
        # Avoid the numbers that the analysis knows.
        number = 1000 + zlib.crc32(name.encode()) % 1_000_000
        if len(values) > 64:
            raise UnsupportedShader("a function has too many arguments")
        return self.result(
            op.EXT_INST, kind, self.out.extended, number, *(item.id for item in values)
        )

    def arithmetic(self, sign: str, one: Value, other: Value) -> Value:
        if "mat" in (one.type[0], other.type[0]):
            return self.opaque(sign, _of_matrix(sign, one.type, other.type), (one, other))
        if not size_of(one.type) or not size_of(other.type):
            if sign in ("==", "!="):
                return self.opaque(sign, BOOL, (one, other))
            raise UnsupportedShader(f"`{sign}` of a {type_text(one.type)} is not supported")
        kinds = [scalar_of(item.type) for item in (one, other)]
        size = max(size_of(one.type), size_of(other.type))
        if BOOL in kinds and sign not in ("==", "!="):
            raise UnsupportedShader(f"`{sign}` of a bool is not supported")
        scalar = kinds[0] if sign in ("<<", ">>") else _promoted(kinds)
        one, other = (
            self.as_type(item, vector(scalar, size_of(item.type))) for item in (one, other)
        )
        if sign == "*" and scalar == FLOAT and size_of(one.type) != size_of(other.type):
            wide, narrow = (one, other) if size_of(one.type) > 1 else (other, one)
            return self.result(142, wide.type, wide.id, narrow.id)
        one, other = (
            self.splat(item, size) if size_of(item.type) == 1 else item for item in (one, other)
        )
        if size_of(one.type) != size_of(other.type):
            raise UnsupportedShader(f"`{sign}` of vectors with different sizes is not supported")
        if sign in _COMPARES:
            number = (
                SIGNS[sign][column(scalar)]
                if scalar != BOOL
                else LOGICAL_EQUAL
                if sign == "=="
                else LOGICAL_NOT_EQUAL
            )
            value = self.result(number, vector(BOOL, size), one.id, other.id)
            return value if size == 1 else self.result(155 if sign == "==" else 154, BOOL, value.id)
        kind = vector(scalar, size)
        return self.result(SIGNS[sign][column(scalar)], kind, one.id, other.id)

    def common_type(self, one: Value, other: Value) -> tuple[Value, Value]:
        """Converts two values to a common type."""
        if one.type == other.type or not size_of(one.type):
            return one, other
        scalar = _promoted([scalar_of(one.type), scalar_of(other.type)])
        first, second = (
            self.as_type(item, vector(scalar, size_of(item.type))) for item in (one, other)
        )
        return first, second


def _promoted(scalars: list[Type]) -> Type:
    """Returns the type to which operands are converted implicitly."""
    return next((kind for kind in (DOUBLE, FLOAT, UINT, INT) if kind in scalars), BOOL)


def column(scalar: Type) -> int:
    return 2 if scalar in (FLOAT, DOUBLE) else 1 if scalar == UINT else 0


def literal_of(scalar: Type, number: int) -> float | bool:
    return (
        bool(number) if scalar == BOOL else float(number) if scalar in (FLOAT, DOUBLE) else number
    )


def _of_matrix(sign: str, one: Type, other: Type) -> Type:
    """Returns the result type of an operator with a matrix operand."""
    if sign in ("==", "!="):
        return BOOL
    if sign == "*" and one[0] == "mat" and other[0] == "vec":
        return ("vec", FLOAT, one[2])
    if sign == "*" and one[0] == "vec" and other[0] == "mat":
        return ("vec", FLOAT, other[1])
    if sign == "*" and one[0] == other[0] == "mat":
        return ("mat", other[1], one[2])
    return one if one[0] == "mat" else other


def type_text(kind: Type) -> str:
    return (
        f"{kind[1][0] if isinstance(kind[1], tuple) else kind[1]} {kind[0]}"
        if len(kind) > 1
        else str(kind[0])
    )
