"""Lowers GLSL calls to SPIR-V: constructors, sample fetches, built-in functions, functions of the
shader.
"""

from __future__ import annotations

from msaa_lint.frame.spirv import numbers as op
from msaa_lint.input.code.parsing import SyntaxNode, fields, without_comments

from .expressions import FETCHES, Expressions
from .text import UnsupportedShader
from .types import (
    EXTREMES,
    FLOAT,
    FUSED,
    INT,
    VOID,
    Type,
    is_image,
    multisampled,
    result,
    scalar_of,
    size_of,
    texel,
    vector,
)
from .values import Place, Value

_QUERIES = ("textureSamples", "imageSamples")
_WRITES = ("atomic", "imageAtomic", "imageStore")
_OUT = {"modf": 1, "frexp": 1}
"""Functions with an output argument, and its index."""


def evaluate_call(expressions: Expressions, node: SyntaxNode, depth: int) -> Value:
    """Returns the value of a call."""
    function, list_node = expressions.parts(node, "function", "arguments")
    arguments = without_comments(list_node)
    if function.type == "subscript_expression":
        return _array(expressions, function, arguments, depth)
    if function.type == "field_expression":
        return _length(expressions, function, depth)
    name = expressions.text_of(function)
    kind = expressions.kind(name)
    if kind is not None and (
        kind[0] != "opaque" or name.startswith(("sampler", "isampler", "usampler"))
    ):
        return _constructor(expressions, kind, arguments, depth)
    if name in expressions.functions:
        return _call_function(expressions, node, name, arguments, depth)
    if arguments and (name in FETCHES or name in _QUERIES):
        image = _operand(expressions, arguments[0], depth)
        if multisampled(image.type):
            return _sample_access(expressions, node, name, arguments, image, depth)
    return _built_in(expressions, node, name, arguments, depth)


def _constructor(
    expressions: Expressions, kind: Type, arguments: list[SyntaxNode], depth: int
) -> Value:
    if kind[0] == "opaque":
        # In Vulkan, a texture combined with a sampler is the image.
        return (
            expressions.value(arguments[0], depth)
            if arguments
            else expressions.opaque("sampler", kind, ())
        )
    values = [expressions.value(item, depth) for item in arguments]
    if size_of(kind):
        return expressions.construct(kind, values)
    if kind[0] == "struct":
        if len(kind[2]) != len(values):
            raise UnsupportedShader("a structure constructor has too few arguments")
        components = [
            expressions.as_type(v, t) if size_of(t) else v
            for v, (_, t) in zip(values, kind[2], strict=True)
        ]
        return expressions.result(op.COMPOSITE_CONSTRUCT, kind, *(item.id for item in components))
    return expressions.opaque("construct", kind, values)


def _array(
    expressions: Expressions, function: SyntaxNode, arguments: list[SyntaxNode], depth: int
) -> Value:
    """Lowers `float[4](...)`."""
    named = function.child_by_field_name("argument")
    inner = expressions.kind(expressions.text_of(named)) if named is not None else None
    if inner is None or not arguments:
        raise expressions.unsupported(function, "is not supported")
    values = [expressions.value(item, depth) for item in arguments]
    kind: Type = ("array", inner, len(values))
    elements = [expressions.as_type(value, inner) if size_of(inner) else value for value in values]
    return expressions.result(op.COMPOSITE_CONSTRUCT, kind, *(item.id for item in elements))


def _length(expressions: Expressions, function: SyntaxNode, depth: int) -> Value:
    """Lowers `array.length()`."""
    argument, field = fields(function, "argument", "field")
    if argument is None or field is None or expressions.text_of(field) != "length":
        raise expressions.unsupported(function, "is not supported")
    kind = _operand(expressions, argument, depth).type
    size = size_of(kind) or (kind[2] if kind[0] == "array" else 0)
    if not isinstance(size, int) or not size:
        return expressions.opaque("length", INT, ())
    return expressions.constant_value(INT, size)


def _operand(expressions: Expressions, node: SyntaxNode, depth: int) -> Place | Value:
    """Returns the lvalue of an argument, or the value of an rvalue."""
    return expressions.place(node, depth) or expressions.value(node, depth)


def _sample_access(
    expressions: Expressions,
    node: SyntaxNode,
    name: str,
    arguments: list[SyntaxNode],
    image: Place | Value,
    depth: int,
) -> Value:
    """Lowers a sample fetch or a query for the number of samples."""
    image_value = expressions.load(image) if isinstance(image, Place) else image
    if name in _QUERIES:
        return expressions.result(op.IMAGE_QUERY_SAMPLES, INT, image_value.id)
    if name == "subpassLoad":
        sample = expressions.value(arguments[1], depth) if len(arguments) == 2 else None
        at = expressions.splat(expressions.constant_value(INT, 0), 2)
    else:
        at = (
            expressions.value(arguments[1], depth)
            if len(arguments) == 3
            else expressions.opaque("", INT, ())
        )
        sample = expressions.value(arguments[2], depth) if len(arguments) == 3 else None
    if sample is None:
        raise expressions.unsupported(node, "is not supported")
    expressions.fetches.append((expressions.text_of(arguments[0]), node.start_byte, node.end_byte))
    kind = texel(image.type)
    number = op.IMAGE_FETCH if name.startswith("texel") else op.IMAGE_READ
    return expressions.result(
        number, kind, image_value.id, at.id, op.SAMPLE_OPERAND, expressions.as_type(sample, INT).id
    )


def _built_in(
    expressions: Expressions, node: SyntaxNode, name: str, arguments: list[SyntaxNode], depth: int
) -> Value:
    values = [expressions.value(item, depth) for item in arguments]
    kind = result(name, [value.type for value in values])
    if name in EXTREMES and len(values) == 2:
        one, other = expressions.common_type(*values)
        size = max(size_of(one.type), size_of(other.type))
        one, other = (
            expressions.splat(item, size) if size_of(item.type) == 1 else item
            for item in (one, other)
        )
        number = EXTREMES[name].get(str(scalar_of(one.type)[0]))
        if number is not None and size:
            return expressions.result(
                op.EXT_INST, one.type, expressions.out.extended, number, one.id, other.id
            )
    if name == "fma" and len(values) == 3:
        ids = [expressions.as_type(value, values[0].type).id for value in values]
        return expressions.result(
            op.EXT_INST, values[0].type, expressions.out.extended, FUSED, *ids
        )
    if name in _OUT:
        target = (
            expressions.place(arguments[_OUT[name]], depth) if len(arguments) > _OUT[name] else None
        )
        if target is None:
            raise expressions.unsupported(node, "is not supported")
        expressions.store(target, expressions.opaque(name, target.type, values[:1]))
        return expressions.opaque(
            f"{name} whole", vector(FLOAT, size_of(values[0].type)), values[:1]
        )
    if kind is None:
        raise expressions.unsupported(node, "is not defined")
    if kind == VOID or name.startswith(_WRITES):
        # Values stored to an image are used; the result differs at each call.
        for operand in values:
            expressions.opaque("used", operand.type if size_of(operand.type) else INT, (operand,))
        return expressions.load(expressions.temporary(INT if kind == VOID else kind))
    return expressions.opaque(name, kind, values)


def _call_function(
    expressions: Expressions, node: SyntaxNode, name: str, arguments: list[SyntaxNode], depth: int
) -> Value:
    """Lowers a call of a function of the shader."""
    operands = [_operand(expressions, argument, depth) for argument in arguments]
    function = expressions.overload(name, [_type(operand) for operand in operands])
    if function is None:
        raise expressions.unsupported(node, "matches no function of the shader")
    expressions.add_called(function)
    passed: list[int] = []
    back: list[tuple[Place, Place]] = []
    for operand, (kind, written, _) in zip(operands, function.parameters, strict=True):
        if isinstance(operand, Value) and (written or is_image(kind)):
            raise expressions.unsupported(node, "is not supported")
        if isinstance(operand, Place) and is_image(kind):
            passed.append(operand.pointer)
            continue
        value = expressions.load(operand) if isinstance(operand, Place) else operand
        value = expressions.as_type(value, kind) if size_of(kind) else value
        if isinstance(operand, Place) and written:
            copy = expressions.temporary(kind)
            expressions.store(copy, value)
            passed.append(copy.pointer)
            back.append((operand, copy))
        else:
            passed.append(value.id)
    call_result = expressions.out.instruction(
        op.FUNCTION_CALL, function.returns, function.id, *passed
    )
    for place, copy in back:
        expressions.store(place, expressions.load(copy))
    return Value(call_result, function.returns)


def _type(operand: Place | Value) -> Type:
    if isinstance(operand, Place) and operand.parts:
        return vector(scalar_of(operand.type), len(operand.parts))
    return operand.type
