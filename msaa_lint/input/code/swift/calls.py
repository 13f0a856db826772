"""Calls in Swift: Metal's functions, and the functions that the file defines."""

from __future__ import annotations

from typing import NamedTuple

from msaa_lint.core.text.span import Span

from .frame_state import Frame, Pass, Pipeline
from .machine import OBJECTS, SHARED, Machine
from .members import as_texture, drawable
from .metal import change_options, copied, described, encode, make_pipeline, make_texture, note
from .terms import MEMBER, NAME, Function, Term
from .values import MOST_ITEMS, NIL, UNKNOWN, Aggregate, Code, Instance, Known, Object, Symbol, Texture, Value

MAX_OVERLOADS = 20
"""Functions of one name that are compared with a call."""

_NUMBERS = frozenset({"Int", "UInt", "NSUInteger", "Int32", "UInt32", "Int64", "NSInteger"})
_READS = {"setFragmentTexture": "fragment", "setVertexTexture": "vertex", "setTileTexture": "tile"}
_DESCRIPTORS = frozenset({"texture2DDescriptor", "textureCubeDescriptor", "textureBufferDescriptor"})
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


def called(machine: Machine, term: Term, frame: Frame) -> Value:
    """The value of a call, after its effects."""
    function, terms, closure, at = term[1:]
    call = Call([(label, machine.evaluate(machine, value, frame)) for label, value in terms], terms, closure, at)
    value: Value | None = None
    if function[0] == NAME:
        value = _by_name(machine, function[1], call, frame)
    elif function[0] == MEMBER:
        value = _by_member(machine, function, call, frame)
    else:
        target = machine.evaluate(machine, function, frame)
        if isinstance(target, Code):
            return machine.call_closure(machine, target, call.values, frame, at)
    if value is not None:
        return value
    _escape(machine, call)
    if closure is not None:
        machine.call_closure(machine, Code(closure), (), frame, at)
    return Symbol("".join(machine.text[function[-1].start : function[-1].end].split())[:60], frame.whose)


def _escape(machine: Machine, call: Call) -> None:
    """Marks arguments of an unknown function, which may change descriptors and read textures."""
    for value in call.values:
        if isinstance(value, Object):
            machine.loosen(value)
            if value.kind == "commands":
                machine.incomplete.add(machine.root)
        elif isinstance(value, Texture):
            machine.escaped.add(id(value))
        elif isinstance(value, Aggregate):
            machine.escaped.update(id(item) for item in value.items.values() if isinstance(item, Texture))


def _by_name(machine: Machine, name: str, call: Call, frame: Frame) -> Value | None:
    """The value of `name(...)`; None where nothing is known of the function."""
    variable = frame.find(name)
    if variable is not None and isinstance(variable[1], Code):
        function = variable[1].function
        return machine.call_closure(machine, variable[1], call.values if function is None else call.bind(function), frame, call.at)
    if (name in _NUMBERS and len(call.arguments) == 1) or (name == "MTLTextureUsage" and call.arguments):
        return call.values[0]
    if name in ("max", "min") and call.arguments:
        numbers = [value.value for value in call.values if isinstance(value, Known) and isinstance(value.value, (int, float))]
        return Known(max(numbers) if name == "max" else min(numbers)) if len(numbers) == len(call.arguments) else UNKNOWN
    if name in OBJECTS:
        return _construct(machine, name, call, frame)
    if name in _HARMLESS:
        return UNKNOWN
    if name and machine.type_of(name) is not None:
        return _instance(machine, name, call)
    for within in dict.fromkeys((frame.within, "")):
        method = _function(machine, within, name, call)
        if method is not None:
            return machine.call(machine, method, call.bind(method), frame, call.at, frame.me if within else None)
    if name[:1].isupper() and 0 < len(call.arguments) <= MOST_ITEMS and all(call.labels):
        return Aggregate(dict(call.arguments))
    return None


def _construct(machine: Machine, name: str, call: Call, frame: Frame) -> Value:
    """An object of one of Metal's types, by its initializer or one that an extension in the file adds."""
    kind = OBJECTS[name]
    created = machine.made(kind, "", call.at, frame.way, not call.arguments)
    if kind == "view":
        machine.views.add(call.at.start)
    if kind not in SHARED:
        machine.renew(created)
    initializer = _function(machine, name, "init", call) if call.arguments else None
    if initializer is not None:
        created.complete = True
        machine.call(machine, initializer, call.bind(initializer), frame, call.at, created)
    return created


def _instance(machine: Machine, name: str, call: Call) -> Value:
    """An object of a type of the file: its members, where the type defines no initializer."""
    initializer = _function(machine, name, "init", call)
    if initializer is not None:
        arguments = call._replace(closure=None).bind(initializer)
        machine.arguments.setdefault(initializer.at.start, []).append(arguments)
        return Instance(name)
    members = machine.unit.types[name].members
    if 0 < len(call.arguments) <= MOST_ITEMS and all(label in members for label in call.labels):
        for label, value in call.arguments:
            machine.hold_property(name, label, value, call.at)
        return Aggregate(dict(call.arguments))
    return Instance(name)


def _function(machine: Machine, within: str, name: str, call: Call) -> Function | None:
    """The one function of a type that a call matches; None where there is none, or several."""
    declaring = machine.type_of(within)
    overloads = declaring.named(name)[:MAX_OVERLOADS] if declaring is not None else ()
    matches = [function for function in overloads if call.matches(function)]
    return matches[0] if len(matches) == 1 else None


def _by_member(machine: Machine, function: Term, call: Call, frame: Frame) -> Value | None:
    """The value of `target.name(...)`; None where nothing is known of the method."""
    target, name = function[1], function[2]
    descriptor = dict(call.arguments).get("descriptor")
    if name in _DESCRIPTORS:
        return described(machine, call.arguments, call.terms, call.at, frame, name)
    if name == "makeTexture" and isinstance(descriptor, Object):
        return make_texture(machine, descriptor, call.at, frame)
    if name in _ENCODERS and descriptor is not None:
        buffer = machine.evaluate(machine, target, frame) if target is not None else UNKNOWN
        return encode(machine, buffer, descriptor, call.at, frame)
    if name.startswith("makeRenderPipelineState") and isinstance(descriptor, Object):
        return make_pipeline(machine, descriptor, call.at, frame)
    if name in _PLAIN_OBJECTS:
        return machine.made(_PLAIN_OBJECTS[name], "", call.at, frame.way, True)
    if name == "nextDrawable":
        return machine.made("drawable", "drawable", call.at, 0, False)
    if name == "init" and target is not None and target[0] == NAME and target[1] in OBJECTS:
        return _construct(machine, target[1], call, frame)
    if name in _OPTIONS and target is not None and target[0] == MEMBER and target[1] is not None:
        change_options(machine, machine.evaluate(machine, target[1], frame), target, name, call.arguments, call.at, frame)
        return NIL
    if target is None:
        return _implicit(machine, name, call, frame)
    owner = machine.evaluate(machine, target, frame)
    value = _metal_method(machine, owner, name, call, frame)
    return value if value is not None else _file_method(machine, owner, target, name, call, frame)


def _implicit(machine: Machine, name: str, call: Call, frame: Frame) -> Value | None:
    """The value of `.name()`: of the only extension of a Metal type in the file that has such a function."""
    if name == "init":
        created = machine.made("attachment", "", call.at, frame.way, not call.arguments)
        machine.renew(created)
        return created
    functions = [function for kind in OBJECTS if (function := _function(machine, kind, name, call)) is not None]
    return machine.call(machine, functions[0], call.bind(functions[0]), frame, call.at, None) if len(functions) == 1 else None


def _file_method(machine: Machine, owner: Value, target: Term, name: str, call: Call, frame: Frame) -> Value | None:
    """The value of a method that the file defines."""
    within = owner.type if isinstance(owner, Instance) else target[1] if target[0] == NAME and target[1] in machine.unit.types else ""
    if isinstance(owner, Object):
        within = next((name for name, kind in OBJECTS.items() if kind == owner.kind and machine.type_of(name) is not None), "")
    function = _function(machine, within, name, call) if within else None
    if function is not None:
        me = owner if isinstance(owner, Object) else frame.me
        return machine.call(machine, function, call.bind(function), frame, call.at, me)
    if isinstance(owner, Object):
        if call.closure is not None:
            machine.call_closure(machine, Code(call.closure), (owner,), frame, call.at)
            return owner
        if owner.kind in ("texture", "pass", "pipeline", "attachment"):
            machine.loosen(owner)
        return None
    others = machine.functions.get(name, ()) if isinstance(owner, Symbol) else ()
    if len(others) == 1 and call.matches(others[0]):
        machine.arguments.setdefault(others[0].at.start, []).append(call.bind(others[0]))
    return None


def _metal_method(machine: Machine, owner: Value, name: str, call: Call, frame: Frame) -> Value | None:
    """The value of a method of one of Metal's objects; None where it is another."""
    first = call.values[0] if call.arguments else UNKNOWN
    kind = owner.kind if isinstance(owner, Object) else ""
    if name == "present":
        drawable_object = owner if kind == "drawable" else first
        if isinstance(drawable_object, Object) and drawable_object.kind == "drawable":
            note(machine, "present", (drawable(machine, call.at),), call.at)
            return NIL
        machine.incomplete.add(machine.root)
        return None
    if isinstance(owner, Object) and name == "reset" and kind == "pipeline":
        machine.renew(owner)
        return NIL
    if isinstance(owner, Object) and name == "copy" and not call.arguments:
        return copied(machine, owner, call.at, frame)
    if name == "copy" and len(call.arguments) > 1 and call.labels[0] == "from":
        ends = [as_texture(machine, value, call.at) for value in (first, dict(call.arguments).get("to", UNKNOWN))]
        if not all(isinstance(end, Texture) for end in ends):
            return None
        note(machine, "copy", tuple(ends), call.at)
        return NIL
    if name in _READS and call.terms:
        at = call.terms[0][1][-1]
        texture = as_texture(machine, first, at)
        if isinstance(texture, Texture):
            note(machine, "read", (texture, _READS[name], owner.of if isinstance(owner, Object) else None), at)
            return NIL
    if name == "setRenderPipelineState" and isinstance(owner, Object) and isinstance(owner.of, Pass):
        pipeline = first.of if isinstance(first, Object) else None
        if isinstance(pipeline, Pipeline) and owner.of not in pipeline.passes[:4]:
            pipeline.passes.append(owner.of)
        return NIL
    return NIL if kind in ("encoder", "commands") and name in ("setFragmentBuffer", "setVertexBuffer", "commit") else None
