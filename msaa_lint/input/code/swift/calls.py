"""Calls in Swift: Metal's functions, and the functions that the file defines."""

from __future__ import annotations

from typing import NamedTuple

from msaa_lint.core.text.span import Span

from .interpreter import OBJECTS, SHARED, Interpreter
from .members import as_texture, drawable
from .metal import DESCRIPTOR_METHODS, change_options, copy_descriptor, create_descriptor, encode_pass, make_pipeline, make_texture, record
from .terms import MAX_ITEMS, MEMBER, NAME, Function, Term
from .values import (
    NIL,
    UNKNOWN,
    Aggregate,
    CallFrame,
    Code,
    Constant,
    Instance,
    MetalObject,
    Pass,
    Pipeline,
    Symbol,
    Texture,
    Value,
    aggregate,
)

MAX_OVERLOADS = 20
"""Functions of one name that are compared with a call."""

_NUMBERS = frozenset({"Int", "UInt", "NSUInteger", "Int32", "UInt32", "Int64", "NSInteger"})
_READS = {"setFragmentTexture": "fragment", "setVertexTexture": "vertex", "setTileTexture": "tile"}
_OPTIONS = frozenset({"insert", "formUnion", "remove"})
_HARMLESS = frozenset({"print", "assert", "precondition", "NSLog", "debugPrint", "withExtendedLifetime"})
_ENCODERS = frozenset({"makeRenderCommandEncoder", "makeParallelRenderCommandEncoder"})
_PLAIN_OBJECTS = {
    "makeBlitCommandEncoder": "blit",
    "makeComputeCommandEncoder": "compute",
    "makeCommandBuffer": "commands",
    "makeCommandBufferWithUnretainedReferences": "commands",
}
"""Methods that create an object without a descriptor, and its kind."""


class Call(NamedTuple):
    """A call: its arguments by label, evaluated and as terms, the closure that follows them, and its location."""

    arguments: list[tuple[str, Value]]
    terms: tuple[tuple[str, Term], ...]
    closure: Term | None
    at: Span

    @property
    def labels(self) -> list[str]:
        return [label for label, _ in self.arguments]

    @property
    def values(self) -> tuple[Value, ...]:
        return tuple(value for _, value in self.arguments)

    def matches(self, function: Function) -> bool:
        """Whether the labels are those of a function's parameters, in order; only those with a default or of closures may be missing."""
        labels, index = self.labels, 0
        for parameter in function.parameters:
            if index < len(labels) and labels[index] == parameter.label:
                index += 1
            elif parameter.default is None and "->" not in parameter.type:
                return False
        return index == len(labels)

    def bind(self, function: Function) -> dict[str, Value]:
        """The values of a function's parameters by name."""
        parameters: dict[str, Value] = {}
        index = 0
        for parameter in function.parameters:
            if index < len(self.arguments) and self.arguments[index][0] == parameter.label:
                parameters[parameter.name] = self.arguments[index][1]
                index += 1
            elif self.closure is not None and "->" in parameter.type:
                parameters[parameter.name] = Code(self.closure)
        return parameters


def evaluate_call(interpreter: Interpreter, term: Term, frame: CallFrame) -> Value:
    """The value of a call, after its effects."""
    function, terms, closure, at = term[1:]
    call = Call([(label, interpreter.evaluate(interpreter, value, frame)) for label, value in terms], terms, closure, at)
    value: Value | None = None
    if function[0] == NAME:
        value = _by_name(interpreter, function[1], call, frame)
    elif function[0] == MEMBER:
        value = _by_member(interpreter, function, call, frame)
    else:
        target = interpreter.evaluate(interpreter, function, frame)
        if isinstance(target, Code):
            return interpreter.call_closure(interpreter, target, call.values, frame, at)
    if value is not None:
        return value
    _escape(interpreter, call)
    if closure is not None:
        interpreter.call_closure(interpreter, Code(closure), (), frame, at)
    return Symbol("".join(interpreter.text[function[-1].start : function[-1].end].split())[:60], frame.function_name)


def _escape(interpreter: Interpreter, call: Call) -> None:
    """Marks arguments of an unknown function, which may change descriptors and read textures."""
    for value in call.values:
        if isinstance(value, MetalObject):
            interpreter.invalidate(value)
            if value.kind == "commands":
                interpreter.incomplete.add(interpreter.root)
        elif isinstance(value, Texture):
            interpreter.escaped.add(id(value))
        elif isinstance(value, Aggregate):
            interpreter.escaped.update(id(item) for item in value.items.values() if isinstance(item, Texture))


def _by_name(interpreter: Interpreter, name: str, call: Call, frame: CallFrame) -> Value | None:
    """The value of `name(...)`; None where nothing is known of the function."""
    variable = frame.find(name)
    if variable is not None and isinstance(variable[1], Code):
        function = variable[1].function
        return interpreter.call_closure(interpreter, variable[1], call.values if function is None else call.bind(function), frame, call.at)
    if (name in _NUMBERS and len(call.arguments) == 1) or (name == "MTLTextureUsage" and call.arguments):
        return call.values[0]
    if name in ("max", "min") and call.arguments:
        numbers = [value.value for value in call.values if isinstance(value, Constant) and isinstance(value.value, (int, float))]
        return Constant(max(numbers) if name == "max" else min(numbers)) if len(numbers) == len(call.arguments) else UNKNOWN
    if name in OBJECTS:
        return _construct(interpreter, name, call, frame)
    if name in _HARMLESS:
        return UNKNOWN
    if name and name in interpreter.unit.types:
        return _instance(interpreter, name, call)
    for type_name in dict.fromkeys((frame.type_name, "")):
        method = _function(interpreter, type_name, name, call)
        if method is not None:
            return interpreter.call(interpreter, method, call.bind(method), frame, call.at, frame.self_value if type_name else None)
    if name[:1].isupper() and 0 < len(call.arguments) <= MAX_ITEMS and all(call.labels):
        return aggregate(dict(call.arguments))
    return None


def _construct(interpreter: Interpreter, name: str, call: Call, frame: CallFrame) -> Value:
    """An object of one of Metal's types, by its initializer or one that an extension in the file adds."""
    kind = OBJECTS[name]
    created = interpreter.object_at(kind, "", call.at, frame.path, not call.arguments)
    if kind == "view":
        interpreter.views.add(call.at.start)
    if kind not in SHARED:
        interpreter.reset(created)
    initializer = _function(interpreter, name, "init", call) if call.arguments else None
    if initializer is not None:
        created.complete = True
        interpreter.call(interpreter, initializer, call.bind(initializer), frame, call.at, created)
    return created


def _instance(interpreter: Interpreter, name: str, call: Call) -> Value:
    """An object of a type of the file: its members, where the type defines no initializer."""
    initializer = _function(interpreter, name, "init", call)
    if initializer is not None:
        arguments = call._replace(closure=None).bind(initializer)
        interpreter.new_call_arguments.setdefault(initializer.at.start, []).append(arguments)
        return Instance(name)
    members = interpreter.unit.types[name].members
    if 0 < len(call.arguments) <= MAX_ITEMS and all(label in members for label in call.labels):
        for label, value in call.arguments:
            interpreter.hold_property(name, label, value, call.at)
        return aggregate(dict(call.arguments))
    return Instance(name)


def _function(interpreter: Interpreter, type_name: str, name: str, call: Call) -> Function | None:
    """The one function of a type that a call matches; None where there is none, or several."""
    overloads = interpreter.type_of(type_name).functions.get(name, ())[:MAX_OVERLOADS]
    matches = [function for function in overloads if call.matches(function)]
    return matches[0] if len(matches) == 1 else None


def _by_member(interpreter: Interpreter, function: Term, call: Call, frame: CallFrame) -> Value | None:
    """The value of `target.name(...)`; None where nothing is known of the method."""
    target, name = function[1], function[2]
    descriptor = dict(call.arguments).get("descriptor")
    if name in DESCRIPTOR_METHODS:
        return create_descriptor(interpreter, call.arguments, call.terms, call.at, frame, name)
    if name == "makeTexture" and isinstance(descriptor, MetalObject):
        return make_texture(interpreter, descriptor, call.at, frame)
    if name in _ENCODERS and descriptor is not None:
        buffer = interpreter.evaluate(interpreter, target, frame) if target is not None else UNKNOWN
        return encode_pass(interpreter, buffer, descriptor, call.at, frame)
    if name.startswith("makeRenderPipelineState") and isinstance(descriptor, MetalObject):
        return make_pipeline(interpreter, descriptor, call.at, frame)
    if name in _PLAIN_OBJECTS:
        return interpreter.object_at(_PLAIN_OBJECTS[name], "", call.at, frame.path, True)
    if name == "nextDrawable":
        return interpreter.object_at("drawable", "drawable", call.at, 0, False)
    if name == "init" and target is not None and target[0] == NAME and target[1] in OBJECTS:
        return _construct(interpreter, target[1], call, frame)
    if name in _OPTIONS and target is not None and target[0] == MEMBER and target[1] is not None:
        change_options(interpreter, interpreter.evaluate(interpreter, target[1], frame), target, name, call.arguments, call.at)
        return NIL
    if target is None:
        return _implicit(interpreter, name, call, frame)
    owner = interpreter.evaluate(interpreter, target, frame)
    value = _metal_method(interpreter, owner, name, call, frame)
    return value if value is not None else _file_method(interpreter, owner, target, name, call, frame)


def _implicit(interpreter: Interpreter, name: str, call: Call, frame: CallFrame) -> Value | None:
    """The value of `.name()`: of the only extension of a Metal type in the file that has such a function."""
    if name == "init":
        created = interpreter.object_at("attachment", "", call.at, frame.path, not call.arguments)
        interpreter.reset(created)
        return created
    functions = [function for kind in OBJECTS if (function := _function(interpreter, kind, name, call)) is not None]
    return interpreter.call(interpreter, functions[0], call.bind(functions[0]), frame, call.at, None) if len(functions) == 1 else None


def _file_method(interpreter: Interpreter, owner: Value, target: Term, name: str, call: Call, frame: CallFrame) -> Value | None:
    """The value of a method that the file defines."""
    type_name = (
        owner.type if isinstance(owner, Instance) else target[1] if target[0] == NAME and target[1] in interpreter.unit.types else ""
    )
    if isinstance(owner, MetalObject):
        type_name = next((name for name, kind in OBJECTS.items() if kind == owner.kind and name in interpreter.unit.types), "")
    function = _function(interpreter, type_name, name, call) if type_name else None
    if function is not None:
        self_value = owner if isinstance(owner, MetalObject) else frame.self_value
        return interpreter.call(interpreter, function, call.bind(function), frame, call.at, self_value)
    if isinstance(owner, MetalObject):
        if call.closure is not None:
            interpreter.call_closure(interpreter, Code(call.closure), (owner,), frame, call.at)
            return owner
        if owner.kind in ("texture", "pass", "pipeline", "attachment"):
            interpreter.invalidate(owner)
        return None
    others = interpreter.functions.get(name, ()) if isinstance(owner, Symbol) else ()
    if len(others) == 1 and call.matches(others[0]):
        interpreter.new_call_arguments.setdefault(others[0].at.start, []).append(call.bind(others[0]))
    return None


def _metal_method(interpreter: Interpreter, owner: Value, name: str, call: Call, frame: CallFrame) -> Value | None:
    """The value of a method of one of Metal's objects; None where it is another."""
    first = call.values[0] if call.arguments else UNKNOWN
    kind = owner.kind if isinstance(owner, MetalObject) else ""
    if name == "present":
        drawable_object = owner if kind == "drawable" else first
        if isinstance(drawable_object, MetalObject) and drawable_object.kind == "drawable":
            record(interpreter, "present", (drawable(interpreter, call.at),), call.at)
            return NIL
        interpreter.incomplete.add(interpreter.root)
        return None
    if isinstance(owner, MetalObject) and name == "reset" and kind == "pipeline":
        interpreter.reset(owner)
        return NIL
    if isinstance(owner, MetalObject) and name == "copy" and not call.arguments:
        return copy_descriptor(interpreter, owner, call.at, frame)
    if name == "copy" and len(call.arguments) > 1 and call.labels[0] == "from":
        ends = [as_texture(interpreter, value, call.at) for value in (first, dict(call.arguments).get("to", UNKNOWN))]
        if not all(isinstance(end, Texture) for end in ends):
            return None
        record(interpreter, "copy", tuple(ends), call.at)
        return NIL
    if name in _READS and call.terms:
        at = call.terms[0][1][-1]
        texture = as_texture(interpreter, first, at)
        if isinstance(texture, Texture):
            record(interpreter, "read", (texture, _READS[name], owner.of if isinstance(owner, MetalObject) else None), at)
            return NIL
    if name == "setRenderPipelineState" and isinstance(owner, MetalObject) and isinstance(owner.of, Pass):
        pipeline = first.of if isinstance(first, MetalObject) else None
        if isinstance(pipeline, Pipeline) and owner.of not in pipeline.passes[:4]:
            pipeline.passes.append(owner.of)
        return NIL
    return NIL if kind in ("encoder", "commands") and name in ("setFragmentBuffer", "setVertexBuffer", "commit") else None
