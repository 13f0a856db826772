"""Metal functions that use descriptors: textures, passes, pipelines."""

from __future__ import annotations

from msaa_lint.core.text.span import Span

from .interpreter import Encoded, Interpreter
from .members import ANY
from .terms import Term, name_at
from .values import UNKNOWN, CallFrame, Constant, Field, MetalObject, Pass, Pipeline, Value, constant_of, option_set, options

DESCRIPTOR_METHODS = {"texture2DDescriptor": "", "textureCubeDescriptor": "typeCube", "textureBufferDescriptor": "typeTextureBuffer"}
"""Class methods that create a texture descriptor, and the texture type that each sets."""

_MEMBERS = {"size": "width", "mipmapped": "mipmapLevelCount"}
"""The members that arguments of these methods set, unless they have the same name."""


def record(interpreter: Interpreter, kind: str, what: tuple[object, ...], at: Span) -> None:
    interpreter.encoded.append(Encoded(kind, what, at, interpreter.root, interpreter.undecided_depth == 0))


def create_descriptor(
    interpreter: Interpreter, arguments: list[tuple[str, Value]], terms: tuple[tuple[str, Term], ...], at: Span, frame: CallFrame, name: str
) -> MetalObject:
    """Returns a texture descriptor created by a class method."""
    descriptor = interpreter.object_at("texture", "", at, frame.path, True)
    interpreter.reset(descriptor)
    for (label, value), (_, term) in zip(arguments, terms, strict=True):
        place = Span(max(term[-1].start - len(label) - 2, at.start), term[-1].start) if label else term[-1]
        start = interpreter.text.rfind(label, at.start, term[-1].start) if label else -1
        key = Span(start, start + len(label)) if start >= 0 else place
        if label == "mipmapped":
            value = Constant(1) if value == Constant(False) else UNKNOWN
        interpreter.set_field(descriptor, _MEMBERS.get(label, label), value, key, term[-1])
    if DESCRIPTOR_METHODS[name]:
        interpreter.set_field(descriptor, "textureType", Constant(DESCRIPTOR_METHODS[name]), at, at)
    return descriptor


def change_options(interpreter: Interpreter, owner: Value, target: Term, name: str, arguments: list[tuple[str, Value]], at: Span) -> None:
    """Executes `insert` and similar methods of option sets."""
    if not isinstance(owner, MetalObject) or not arguments:
        return
    before = constant_of(interpreter.field(owner, target[2]))
    change = arguments[0][1].value if isinstance(arguments[0][1], Constant) else None
    value: Value = UNKNOWN
    if isinstance(before, (str, tuple)) and isinstance(change, (str, tuple)):
        one, other = options(before), options(change)
        value = option_set(tuple(word for word in one if word not in other) if name == "remove" else one + other)
    interpreter.set_field(owner, target[2], value, name_at(target), at)


def copy_descriptor(interpreter: Interpreter, original: MetalObject, at: Span, frame: CallFrame) -> MetalObject:
    """Returns a copy of a descriptor and its attachments."""
    copy = interpreter.object_at(original.kind, "", at, frame.path, original.complete)
    interpreter.reset(copy)
    interpreter.superseded.add(id(original))
    copy.loose = original.loose
    for name, field in interpreter.snapshot(original).items():
        value = field.value
        if isinstance(value, MetalObject) and value.kind == "attachment":
            inner = interpreter.object_at("attachment", name, at, (frame.path, name), value.complete)
            interpreter.reset(inner)
            inner.of = copy
            for key, member_field in interpreter.snapshot(value).items():
                interpreter.set_field(inner, key, member_field.value, member_field.key, member_field.at)
            value = inner
        interpreter.set_field(copy, name, value, field.key, field.at)
    return copy


def make_texture(interpreter: Interpreter, descriptor: Value, at: Span, frame: CallFrame) -> Value:
    """Returns a texture with the current state of its descriptor."""
    if not isinstance(descriptor, MetalObject) or descriptor.kind != "texture":
        return UNKNOWN
    key: tuple[object, ...] = ("made", at.start, frame.path)
    key = interpreter.same.get(key, key)
    texture = interpreter.texture_of(key, "", frame.function_name, at)
    texture.key = key
    fields = interpreter.snapshot(descriptor)
    if descriptor.complete and not descriptor.loose:
        fields.setdefault("textureType", Field(Constant("type2D"), descriptor.at, descriptor.at, 0, True))
        fields.setdefault("sampleCount", Field(Constant(1), descriptor.at, descriptor.at, 0, True))
    texture.made.append(fields)
    return texture


def encode_pass(interpreter: Interpreter, buffer: Value, descriptor: Value, at: Span, frame: CallFrame) -> Value:
    """Returns the encoder of a pass with the current state of its descriptor.

    Other code may also encode to a buffer that was created elsewhere.
    """
    if not (isinstance(buffer, MetalObject) and buffer.kind == "commands" and buffer.complete):
        interpreter.incomplete.add(interpreter.root)
    encoder = interpreter.object_at("encoder", "", at, frame.path, True)
    if not isinstance(descriptor, MetalObject) or descriptor.kind != "pass":
        interpreter.incomplete.add(interpreter.root)
        return encoder
    key = (id(descriptor), at.start, frame.path)
    encoder.of = render_pass = interpreter.passes.setdefault(key, pass_of(interpreter, descriptor, at))
    record(interpreter, "pass", (render_pass,), at)
    return encoder


def pass_of(interpreter: Interpreter, descriptor: MetalObject, at: Span) -> Pass:
    """Returns a pass with the current attachments of a descriptor."""
    attachments: dict[str, dict[str, Field]] = {}
    unknown: set[str] = set()
    for name, field in interpreter.snapshot(descriptor).items():
        if isinstance(field.value, MetalObject) and field.value.kind == "attachment":
            fields = interpreter.snapshot(field.value)
            if name == ANY:
                unknown = set(fields)
            elif fields:
                attachments[name] = fields
    for name, fields in attachments.items():
        for member in unknown & fields.keys() if name.startswith("color") else ():
            fields[member] = fields[member]._replace(value=UNKNOWN)
    return Pass(descriptor, at, attachments, descriptor.complete and not descriptor.loose and not unknown)


def make_pipeline(interpreter: Interpreter, descriptor: Value, at: Span, frame: CallFrame) -> Value:
    """Returns a pipeline state with the current state of its descriptor."""
    state = interpreter.object_at("state", "", at, frame.path, True)
    if not isinstance(descriptor, MetalObject) or descriptor.kind != "pipeline":
        return state
    key = (id(descriptor), at.start, frame.path)
    if key not in interpreter.pipelines:
        interpreter.pipelines[key] = pipeline_of(interpreter, descriptor, at, frame.function_name)
    state.of = interpreter.pipelines[key]
    return state


def pipeline_of(interpreter: Interpreter, descriptor: MetalObject, at: Span, type_name: str) -> Pipeline:
    """Returns a pipeline with the current state of a descriptor."""
    fields = interpreter.snapshot(descriptor)
    objects = {name: value for name, field in fields.items() if isinstance(value := field.value, MetalObject)}
    colors = {name: interpreter.snapshot(item) for name, item in objects.items() if item.kind == "attachment" and name != ANY}
    return Pipeline(descriptor, at, {name: field for name, field in fields.items() if name not in objects}, colors, type_name)
