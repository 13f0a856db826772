"""Metal functions that use descriptors: textures, passes, pipelines."""

from __future__ import annotations

from msaa_lint.core.text.span import Span

from .frame_state import CallFrame, Encoded, Pass, Pipeline
from .interpreter import Interpreter
from .members import ANY
from .terms import Term, name_at
from .values import UNKNOWN, Constant, Field, MetalObject, Texture, Value


def record(interpreter: Interpreter, kind: str, what: tuple[object, ...], at: Span) -> None:
    interpreter.encoded.append(Encoded(kind, what, at, interpreter.root, interpreter.undecided_depth == 0))


def create_texture_descriptor(
    interpreter: Interpreter, arguments: list[tuple[str, Value]], terms: tuple[tuple[str, Term], ...], at: Span, frame: CallFrame, name: str
) -> MetalObject:
    """Returns a texture descriptor created by a class method."""
    descriptor = interpreter.object_at("texture", "", at, frame.path, True)
    interpreter.reset(descriptor)
    for (label, value), (_, term) in zip(arguments, terms, strict=True):
        place = Span(max(term[-1].start - len(label) - 2, at.start), term[-1].start) if label else term[-1]
        start = interpreter.text.rfind(label, at.start, term[-1].start) if label else -1
        key = Span(start, start + len(label)) if start >= 0 else place
        if label == "size":
            interpreter.set_field(descriptor, "width", value, key, term[-1])
        elif label != "mipmapped":
            interpreter.set_field(descriptor, label, value, key, term[-1])
        elif value == Constant(False):
            interpreter.set_field(descriptor, "mipmapLevelCount", Constant(1), key, term[-1])
        else:
            interpreter.set_field(descriptor, "mipmapLevelCount", UNKNOWN, key, term[-1])
    if name != "texture2DDescriptor":
        interpreter.set_field(
            descriptor, "textureType", Constant("typeCube" if name == "textureCubeDescriptor" else "typeTextureBuffer"), at, at
        )
    return descriptor


def change_options(
    interpreter: Interpreter, owner: Value, target: Term, name: str, arguments: list[tuple[str, Value]], at: Span, frame: CallFrame
) -> None:
    """Executes `insert` and similar methods of option sets."""
    if not isinstance(owner, MetalObject) or not arguments:
        return
    field = interpreter.field(owner, target[2])
    before = field.value.value if field is not None and isinstance(field.value, Constant) else None
    change = arguments[0][1].value if isinstance(arguments[0][1], Constant) else None
    value: Value = UNKNOWN
    if isinstance(before, (str, tuple)) and isinstance(change, (str, tuple)):
        one = before if isinstance(before, tuple) else (before,)
        other = change if isinstance(change, tuple) else (change,)
        value = Constant(tuple(word for word in one if word not in other) if name == "remove" else one + other)
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
    texture = interpreter.textures.get(key)
    if texture is None:
        texture = interpreter.textures[key] = Texture("", frame.function_name, at)
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
    render_pass = pass_of(interpreter, descriptor, at)
    key = (id(descriptor), at.start, frame.path)
    interpreter.passes.setdefault(key, render_pass)
    render_pass = interpreter.passes[key]
    encoder.of = render_pass
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
        if name.startswith("color"):
            for member in unknown:
                if member in fields:
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
    colors: dict[str, dict[str, Field]] = {}
    fields: dict[str, Field] = {}
    for name, field in interpreter.snapshot(descriptor).items():
        if isinstance(field.value, MetalObject):
            if field.value.kind == "attachment" and name != ANY:
                colors[name] = interpreter.snapshot(field.value)
        else:
            fields[name] = field
    pipeline = Pipeline(descriptor, at, fields, colors)
    pipeline.type_name = type_name
    return pipeline
