"""What calls give and do: Metal's own, and those of functions that the file has."""

from __future__ import annotations

from msaa_lint.core.text.span import Span

from .frame_state import Frame, Pass, Pipeline
from .machine import OBJECTS, SHARED, Machine
from .members import as_texture, drawable
from .metal import change_options, copied, described, encode, make_pipeline, make_texture, note
from .terms import MEMBER, NAME, Function, Term
from .values import MOST_ITEMS, NIL, UNKNOWN, Aggregate, Code, Instance, Known, Object, Symbol, Texture, Value

MOST_OVERLOADS = 20
"""Functions of one name that are told apart."""

_NUMBERS = frozenset({"Int", "UInt", "NSUInteger", "Int32", "UInt32", "Int64", "NSInteger"})
_READS = {"setFragmentTexture": "fragment", "setVertexTexture": "vertex", "setTileTexture": "tile"}
_DESCRIBED = frozenset({"texture2DDescriptor", "textureCubeDescriptor", "textureBufferDescriptor"})
_OPTIONS = frozenset({"insert", "formUnion", "remove"})
_HARMLESS = frozenset({"print", "assert", "precondition", "NSLog", "debugPrint", "withExtendedLifetime"})
_ENCODERS = frozenset({"makeRenderCommandEncoder", "makeParallelRenderCommandEncoder"})


def called(machine: Machine, term: Term, frame: Frame) -> Value:
    """The value of a call, and what it does."""
    function, given, closure, at = term[1:]
    arguments = [(label, machine.evaluate(machine, value, frame)) for label, value in given]
    if function[0] == NAME:
        value = _by_name(machine, function[1], arguments, given, closure, at, frame)
        if value is not None:
            return value
    elif function[0] == MEMBER:
        value = _by_member(machine, function, arguments, given, closure, at, frame)
        if value is not None:
            return value
    else:
        held = machine.evaluate(machine, function, frame)
        if isinstance(held, Code):
            return machine.call_closure(machine, held, tuple(value for _, value in arguments), frame, at)
    _escape(machine, arguments)
    if closure is not None:
        machine.call_closure(machine, Code(closure), (), frame, at)
    return Symbol(_text(machine, function), frame.whose)


def _text(machine: Machine, term: Term) -> str:
    return "".join(machine.text[term[-1].start : term[-1].end].split())[:60]


def _escape(machine: Machine, arguments: list[tuple[str, Value]]) -> None:
    """What is handed to code that is not read: it may change descriptors and read textures."""
    for _, value in arguments:
        if isinstance(value, Object):
            machine.loosen(value)
            if value.kind == "commands":
                machine.incomplete.add(machine.root)
        elif isinstance(value, Texture):
            machine.escaped.add(id(value))
        elif isinstance(value, Aggregate):
            machine.escaped.update(id(item) for item in value.items.values() if isinstance(item, Texture))


def _by_name(
    machine: Machine,
    name: str,
    arguments: list[tuple[str, Value]],
    given: tuple[tuple[str, Term], ...],
    closure: Term | None,
    at: Span,
    frame: Frame,
) -> Value | None:
    found = frame.find(name)
    if found is not None and isinstance(found[1], Code):
        function = found[1].function
        values = tuple(value for _, value in arguments) if function is None else _bound(function, arguments, closure)
        return machine.call_closure(machine, found[1], values, frame, at)
    if name in _NUMBERS and len(arguments) == 1:
        return arguments[0][1]
    if name in ("max", "min") and arguments:
        numbers = [value.value for _, value in arguments if isinstance(value, Known) and isinstance(value.value, (int, float))]
        return Known(max(numbers) if name == "max" else min(numbers)) if len(numbers) == len(arguments) else UNKNOWN
    if name in OBJECTS:
        return _constructed(machine, name, arguments, closure, at, frame)
    if name == "MTLTextureUsage" and arguments:
        return arguments[0][1]
    if name in _HARMLESS:
        return UNKNOWN
    own = machine.type_of(name) if name else None
    if own is not None:
        return _instance(machine, name, arguments, at, frame)
    for within in dict.fromkeys((frame.within, "")):
        function = _function(machine, within, name, arguments)
        if function is not None:
            return machine.call(machine, function, _bound(function, arguments, closure), frame, at, frame.me if within else None)
    if name[:1].isupper() and 0 < len(arguments) <= MOST_ITEMS and all(label for label, _ in arguments):
        return Aggregate(dict(arguments))
    return None


def _constructed(machine: Machine, name: str, arguments: list[tuple[str, Value]], closure: Term | None, at: Span, frame: Frame) -> Value:
    kind = OBJECTS[name]
    own = machine.type_of(name)
    made = machine.made(kind, "", at, frame.way, not arguments)
    if kind == "view":
        machine.views.add(at.start)
    if kind not in SHARED:
        machine.renew(made)
    if own is not None and arguments:
        function = _function(machine, name, "init", arguments)
        if function is not None:
            made.complete = True
            machine.call(machine, function, _bound(function, arguments, closure), frame, at, made)
    return made


def _instance(machine: Machine, name: str, arguments: list[tuple[str, Value]], at: Span, frame: Frame) -> Value:
    """An object of a type of the file: its items, where it has no initialiser of its own."""
    own = machine.unit.types[name]
    function = _function(machine, name, "init", arguments)
    if function is not None:
        machine.arguments.setdefault(function.at.start, []).append(_bound(function, arguments, None))
        return Instance(name)
    if 0 < len(arguments) <= MOST_ITEMS and all(label in own.members for label, _ in arguments):
        for label, value in arguments:
            machine.hold_property(name, label, value, at)
        return Aggregate(dict(arguments))
    return Instance(name)


def _function(machine: Machine, within: str, name: str, arguments: list[tuple[str, Value]]) -> Function | None:
    """The function of a type that a call means, by its labels; None where it is none, or one of several."""
    own = machine.type_of(within)
    if own is None:
        return None
    labels = [label for label, _ in arguments]
    found = [each for each in own.named(name)[:MOST_OVERLOADS] if _fits(each, labels)]
    return found[0] if len(found) == 1 else None


def _fits(function: Function, labels: list[str]) -> bool:
    """Whether a call with these labels is one of a function: in order, only those with a default or a closure left out."""
    index = 0
    for parameter in function.parameters:
        if index < len(labels) and labels[index] == parameter.label:
            index += 1
        elif parameter.default is None and "->" not in parameter.type:
            return False
    return index == len(labels)


def _bound(function: Function, arguments: list[tuple[str, Value]], closure: Term | None) -> dict[str, Value]:
    bound: dict[str, Value] = {}
    index = 0
    for parameter in function.parameters:
        if index < len(arguments) and arguments[index][0] == parameter.label:
            bound[parameter.name] = arguments[index][1]
            index += 1
        elif closure is not None and "->" in parameter.type:
            bound[parameter.name] = Code(closure)
    return bound


def _by_member(
    machine: Machine,
    function: Term,
    arguments: list[tuple[str, Value]],
    given: tuple[tuple[str, Term], ...],
    closure: Term | None,
    at: Span,
    frame: Frame,
) -> Value | None:
    target, name = function[1], function[2]
    labelled = dict(arguments)
    if name in _DESCRIBED:
        return described(machine, arguments, given, at, frame, name)
    if name == "makeTexture" and isinstance(labelled.get("descriptor"), Object):
        return make_texture(machine, labelled["descriptor"], at, frame)
    if name in _ENCODERS and "descriptor" in labelled:
        buffer = machine.evaluate(machine, target, frame) if target is not None else UNKNOWN
        return encode(machine, buffer, labelled["descriptor"], at, frame)
    if name.startswith("makeRenderPipelineState") and isinstance(labelled.get("descriptor"), Object):
        return make_pipeline(machine, labelled["descriptor"], at, frame)
    if name in ("makeBlitCommandEncoder", "makeComputeCommandEncoder"):
        return machine.made("blit" if name == "makeBlitCommandEncoder" else "compute", "", at, frame.way, True)
    if name in ("makeCommandBuffer", "makeCommandBufferWithUnretainedReferences"):
        return machine.made("commands", "", at, frame.way, True)
    if name == "nextDrawable":
        return machine.made("drawable", "drawable", at, 0, False)
    if name == "init" and target is not None and target[0] == NAME and target[1] in OBJECTS:
        return _constructed(machine, target[1], arguments, closure, at, frame)
    if name in _OPTIONS and target is not None and target[0] == MEMBER and target[1] is not None:
        change_options(machine, machine.evaluate(machine, target[1], frame), target, name, arguments, at, frame)
        return NIL
    if target is None:
        return _implicit(machine, name, arguments, closure, at, frame)
    held = machine.evaluate(machine, target, frame)
    done = _on(machine, held, name, arguments, given, at, frame)
    if done is not None:
        return done
    return _own(machine, held, target, name, arguments, closure, at, frame)


def _implicit(
    machine: Machine, name: str, arguments: list[tuple[str, Value]], closure: Term | None, at: Span, frame: Frame
) -> Value | None:
    """A call of `.name()`: of one of Metal's types where only one has such a function in the file."""
    if name == "init":
        made = machine.made("attachment", "", at, frame.way, not arguments)
        machine.renew(made)
        return made
    found = [function for each in OBJECTS if (function := _function(machine, each, name, arguments)) is not None]
    return machine.call(machine, found[0], _bound(found[0], arguments, closure), frame, at, None) if len(found) == 1 else None


def _own(
    machine: Machine,
    held: Value,
    target: Term,
    name: str,
    arguments: list[tuple[str, Value]],
    closure: Term | None,
    at: Span,
    frame: Frame,
) -> Value | None:
    """A call of a method that the file has."""
    within = held.type if isinstance(held, Instance) else target[1] if target[0] == NAME and target[1] in machine.unit.types else ""
    if isinstance(held, Object):
        within = next((each for each, kind in OBJECTS.items() if kind == held.kind and machine.type_of(each) is not None), "")
    function = _function(machine, within, name, arguments) if within else None
    if function is not None:
        me = held if isinstance(held, Object) else frame.me
        return machine.call(machine, function, _bound(function, arguments, closure), frame, at, me)
    if isinstance(held, Object):
        if closure is not None:
            machine.call_closure(machine, Code(closure), (held,), frame, at)
            return held
        if held.kind in ("texture", "pass", "pipeline", "attachment"):
            machine.loosen(held)
        return None
    others = machine.functions.get(name, ()) if isinstance(held, Symbol) else ()
    if len(others) == 1 and _fits(others[0], [label for label, _ in arguments]):
        machine.arguments.setdefault(others[0].at.start, []).append(_bound(others[0], arguments, closure))
    return None


def _on(
    machine: Machine,
    held: Value,
    name: str,
    arguments: list[tuple[str, Value]],
    given: tuple[tuple[str, Term], ...],
    at: Span,
    frame: Frame,
) -> Value | None:
    """What a method of one of Metal's objects does."""
    first = arguments[0][1] if arguments else UNKNOWN
    if name == "present":
        shown = held if isinstance(held, Object) and held.kind == "drawable" else first
        if isinstance(shown, Object) and shown.kind == "drawable":
            note(machine, "present", (drawable(machine, at),), at)
            return NIL
        machine.incomplete.add(machine.root)
        return None
    if name == "reset" and isinstance(held, Object) and held.kind == "pipeline":
        machine.renew(held)
        return NIL
    if name == "copy" and isinstance(held, Object) and not arguments:
        return copied(machine, held, at, frame)
    if name == "copy" and len(arguments) > 1 and arguments[0][0] == "from":
        source, destination = first, dict(arguments).get("to", UNKNOWN)
        source, destination = as_texture(machine, source, at), as_texture(machine, destination, at)
        if isinstance(source, Texture) and isinstance(destination, Texture):
            note(machine, "copy", (source, destination), at)
            return NIL
        return None
    if name in _READS and given:
        texture = as_texture(machine, first, given[0][1][-1])
        if isinstance(texture, Texture):
            maker = held.of if isinstance(held, Object) else None
            note(machine, "read", (texture, _READS[name], maker), given[0][1][-1])
            return NIL
    if name == "setRenderPipelineState" and isinstance(held, Object) and isinstance(held.of, Pass):
        made = first.of if isinstance(first, Object) else None
        if isinstance(made, Pipeline) and held.of not in made.passes[:4]:
            made.passes.append(held.of)
        return NIL
    if isinstance(held, Object) and held.kind in ("encoder", "commands") and name in ("setFragmentBuffer", "setVertexBuffer", "commit"):
        return NIL
    return None
