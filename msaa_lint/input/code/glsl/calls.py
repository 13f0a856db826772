"""Calls of GLSL as SPIR-V: constructors, fetches of samples, built-in functions, the shader's own."""

from __future__ import annotations

from msaa_lint.frame.spirv import numbers as op
from msaa_lint.input.code.parsing import SyntaxNode

from .expressions import FETCHES, Expressions
from .text import NotRead
from .types import EXTREMES, FLOAT, FUSED, INT, VOID, Type, is_image, multisampled, result, scalar_of, size_of, texel, vector
from .values import Function, Place, Value

_QUERIES = ("textureSamples", "imageSamples")
_WRITES = ("atomic", "imageAtomic", "imageStore")
_OUT = {"modf": 1, "frexp": 1}
"""Functions that write to an argument: its index."""


def called(to: Expressions, node: SyntaxNode, depth: int) -> Value:
    """What a call gives."""
    function, list_node = to.parts(node, "function", "arguments")
    arguments = [child for child in list_node.named_children if child.type != "comment"]
    if function.type == "subscript_expression":
        return _array(to, function, arguments, depth)
    if function.type == "field_expression":
        return _length(to, function, depth)
    name = to.of(function)
    kind = to.kind(name)
    if kind is not None and (kind[0] != "opaque" or name.startswith(("sampler", "isampler", "usampler"))):
        return _constructed(to, kind, arguments, depth)
    if name in to.functions:
        return _own(to, node, name, arguments, depth)
    if name in FETCHES or name in _QUERIES:
        image = _image(to, arguments, depth)
        if image is not None and multisampled(image.type):
            return _of_samples(to, node, name, arguments, image, depth)
    return _built_in(to, node, name, arguments, depth)


def _constructed(to: Expressions, kind: Type, arguments: list[SyntaxNode], depth: int) -> Value:
    if kind[0] == "opaque":
        # A texture and a sampler of Vulkan's put together: the texture is the image.
        return to.value(arguments[0], depth) if arguments else to.opaque("sampler", kind, ())
    values = [to.value(item, depth) for item in arguments]
    if size_of(kind):
        return to.constructed(kind, values)
    if kind[0] == "struct":
        members = kind[2]
        assert isinstance(members, tuple)
        if len(members) != len(values):
            raise NotRead("a structure is made of too little")
        components = [to.as_type(v, t) if size_of(t) else v for v, (_, t) in zip(values, members, strict=True)]
        return to.result(op.COMPOSITE_CONSTRUCT, kind, *(item.id for item in components))
    return to.opaque("construct", kind, values)


def _array(to: Expressions, function: SyntaxNode, arguments: list[SyntaxNode], depth: int) -> Value:
    """`float[4](...)`."""
    named = function.child_by_field_name("argument")
    inner = to.kind(to.of(named)) if named is not None else None
    if inner is None or not arguments:
        raise to.no(function, "is not followed")
    values = [to.value(item, depth) for item in arguments]
    kind: Type = ("array", inner, len(values))
    elements = [to.as_type(value, inner) if size_of(inner) else value for value in values]
    return to.result(op.COMPOSITE_CONSTRUCT, kind, *(item.id for item in elements))


def _length(to: Expressions, function: SyntaxNode, depth: int) -> Value:
    """`array.length()`."""
    argument, field = function.child_by_field_name("argument"), function.child_by_field_name("field")
    if argument is None or field is None or to.of(field) != "length":
        raise to.no(function, "is not followed")
    place = to.place(argument, depth)
    kind = place.type if place is not None else to.value(argument, depth).type
    size = size_of(kind) or (kind[2] if kind[0] == "array" else 0)
    if not isinstance(size, int) or not size:
        return to.opaque("length", INT, ())
    return to.constant_value(INT, size)


def _image(to: Expressions, arguments: list[SyntaxNode], depth: int) -> Place | Value | None:
    """The image that a function takes first."""
    if not arguments:
        return None
    place = to.place(arguments[0], depth)
    return place if place is not None else to.value(arguments[0], depth)


def _of_samples(to: Expressions, node: SyntaxNode, name: str, arguments: list[SyntaxNode], image: Place | Value, depth: int) -> Value:
    """A fetch of a sample, or a query for how many there are."""
    loaded = to.loaded(image) if isinstance(image, Place) else image
    if name in _QUERIES:
        return to.result(op.IMAGE_QUERY_SAMPLES, INT, loaded.id)
    if name == "subpassLoad":
        sample = to.value(arguments[1], depth) if len(arguments) == 2 else None
        at = to.splat(to.constant_value(INT, 0), 2)
    else:
        at = to.value(arguments[1], depth) if len(arguments) == 3 else to.opaque("", INT, ())
        sample = to.value(arguments[2], depth) if len(arguments) == 3 else None
    if sample is None:
        raise to.no(node, "is not followed")
    to.fetches.append((to.of(arguments[0]), node.start_byte, node.end_byte))
    kind = texel(image.type)
    number = op.IMAGE_FETCH if name.startswith("texel") else op.IMAGE_READ
    return to.result(number, kind, loaded.id, at.id, op.SAMPLE_OPERAND, to.as_type(sample, INT).id)


def _built_in(to: Expressions, node: SyntaxNode, name: str, arguments: list[SyntaxNode], depth: int) -> Value:
    values = [to.value(item, depth) for item in arguments]
    kind = result(name, [value.type for value in values])
    if name in EXTREMES and len(values) == 2:
        one, other = to.alike(*values)
        size = max(size_of(one.type), size_of(other.type))
        one, other = (to.splat(item, size) if size_of(item.type) == 1 else item for item in (one, other))
        number = EXTREMES[name].get(str(scalar_of(one.type)[0]))
        if number is not None and size:
            return to.result(op.EXT_INST, one.type, to.out.extended, number, one.id, other.id)
    if name == "fma" and len(values) == 3:
        ids = [to.as_type(value, values[0].type).id for value in values]
        return to.result(op.EXT_INST, values[0].type, to.out.extended, FUSED, *ids)
    if name in _OUT:
        target = to.place(arguments[1], depth)
        if target is None:
            raise to.no(node, "is not followed")
        to.stored(target, to.opaque(name, target.type, values[:1]))
        return to.opaque(f"{name} whole", vector(FLOAT, size_of(values[0].type)), values[:1])
    if kind is None:
        raise to.no(node, "is not defined in it")
    if kind == VOID or name.startswith(_WRITES):
        # What is stored to an image is used, and the result is nothing that is the same again.
        for operand in values:
            to.opaque("used", operand.type if size_of(operand.type) else INT, (operand,))
        return to.loaded(to.temporary(INT if kind == VOID else kind))
    return to.opaque(name, kind, values)


def _own(to: Expressions, node: SyntaxNode, name: str, arguments: list[SyntaxNode], depth: int) -> Value:
    """A call of a function of the shader's own."""
    kinds: list[tuple[Place | None, Value | None]] = []
    for argument in arguments:
        place = to.place(argument, depth)
        kinds.append((place, None if place is not None else to.value(argument, depth)))
    types = [_type(place, value) for place, value in kinds]
    function = _fitting(to.functions[name], types)
    if function is None:
        raise to.no(node, "fits no function of it")
    if function not in to.called:
        to.called.append(function)
    passed: list[int] = []
    back: list[tuple[Place, Place]] = []
    for (place, value), (kind, written, _) in zip(kinds, function.parameters, strict=True):
        if is_image(kind):
            if place is None:
                raise to.no(node, "is not followed")
            passed.append(place.pointer)
            continue
        if value is None:
            assert place is not None
            value = to.loaded(place)
        if not written:
            passed.append((to.as_type(value, kind) if size_of(kind) else value).id)
            continue
        if place is None:
            raise to.no(node, "is not followed")
        copy = to.temporary(kind)
        to.stored(copy, to.as_type(value, kind) if size_of(kind) else value)
        passed.append(copy.pointer)
        back.append((place, copy))
    call_result = to.out.made(op.FUNCTION_CALL, function.returns, function.id, *passed)
    for place, copy in back:
        whole = to.loaded(copy)
        to.stored(place, whole)
    return Value(call_result, function.returns)


def _type(place: Place | None, value: Value | None) -> Type:
    if place is not None:
        return vector(scalar_of(place.type), len(place.parts)) if place.parts else place.type
    assert value is not None
    return value.type


def _fitting(functions: list[Function], types: list[Type]) -> Function | None:
    """The function for arguments of some types: the one that has them, or that they can be made into."""
    same = [function for function in functions if [kind for kind, _, _ in function.parameters] == types]
    if same:
        return same[0]
    sizes = [size_of(kind) for kind in types]
    near = [function for function in functions if [size_of(kind) for kind, _, _ in function.parameters] == sizes]
    return near[0] if len(near) == 1 else None
