"""What Metal's own functions make of descriptors: textures, passes, pipelines."""

from __future__ import annotations

from msaa_lint.core.text.span import Span

from .frame_state import Encoded, Frame, Pass, Pipeline
from .machine import Machine
from .members import ANY
from .terms import Term, name_at
from .values import UNKNOWN, Field, Known, Object, Texture, Value


def note(machine: Machine, kind: str, what: tuple[object, ...], at: Span) -> None:
    machine.encoded.append(Encoded(kind, what, at, machine.root, machine.unsure == 0))


def described(
    machine: Machine, arguments: list[tuple[str, Value]], terms: tuple[tuple[str, Term], ...], at: Span, frame: Frame, name: str
) -> Object:
    """A texture's descriptor by one of the class's functions."""
    descriptor = machine.made("texture", "", at, frame.way, True)
    machine.renew(descriptor)
    for (label, value), (_, term) in zip(arguments, terms, strict=True):
        place = Span(max(term[-1].start - len(label) - 2, at.start), term[-1].start) if label else term[-1]
        start = machine.text.rfind(label, at.start, term[-1].start) if label else -1
        key = Span(start, start + len(label)) if start >= 0 else place
        if label == "size":
            machine.give(descriptor, "width", value, key, term[-1])
        elif label != "mipmapped":
            machine.give(descriptor, label, value, key, term[-1])
        elif value == Known(False):
            machine.give(descriptor, "mipmapLevelCount", Known(1), key, term[-1])
        else:
            machine.give(descriptor, "mipmapLevelCount", UNKNOWN, key, term[-1])
    if name != "texture2DDescriptor":
        machine.give(descriptor, "textureType", Known("typeCube" if name == "textureCubeDescriptor" else "typeTextureBuffer"), at, at)
    return descriptor


def change_options(
    machine: Machine, owner: Value, target: Term, name: str, arguments: list[tuple[str, Value]], at: Span, frame: Frame
) -> None:
    """`insert` and the like on an option set."""
    if not isinstance(owner, Object) or not arguments:
        return
    field = machine.has(owner, target[2])
    before = field.value.value if field is not None and isinstance(field.value, Known) else None
    change = arguments[0][1].value if isinstance(arguments[0][1], Known) else None
    value: Value = UNKNOWN
    if isinstance(before, (str, tuple)) and isinstance(change, (str, tuple)):
        one = before if isinstance(before, tuple) else (before,)
        other = change if isinstance(change, tuple) else (change,)
        value = Known(tuple(word for word in one if word not in other) if name == "remove" else one + other)
    machine.give(owner, target[2], value, name_at(target), at)


def copied(machine: Machine, original: Object, at: Span, frame: Frame) -> Object:
    """A copy of a descriptor, and of its attachments."""
    copy = machine.made(original.kind, "", at, frame.way, original.complete)
    machine.renew(copy)
    machine.superseded.add(id(original))
    copy.loose = original.loose
    for name, field in machine.snapshot(original).items():
        value = field.value
        if isinstance(value, Object) and value.kind == "attachment":
            inner = machine.made("attachment", name, at, (frame.way, name), value.complete)
            machine.renew(inner)
            inner.of = copy
            for key, member_field in machine.snapshot(value).items():
                machine.give(inner, key, member_field.value, member_field.key, member_field.at)
            value = inner
        machine.give(copy, name, value, field.key, field.at)
    return copy


def make_texture(machine: Machine, descriptor: Value, at: Span, frame: Frame) -> Value:
    """A texture, of the descriptor as it is now."""
    if not isinstance(descriptor, Object) or descriptor.kind != "texture":
        return UNKNOWN
    key: tuple[object, ...] = ("made", at.start, frame.way)
    key = machine.same.get(key, key)
    texture = machine.textures.get(key)
    if texture is None:
        texture = machine.textures[key] = Texture("", frame.whose, at)
        texture.key = key
    fields = machine.snapshot(descriptor)
    if descriptor.complete and not descriptor.loose:
        fields.setdefault("textureType", Field(Known("type2D"), descriptor.at, descriptor.at, 0, True))
        fields.setdefault("sampleCount", Field(Known(1), descriptor.at, descriptor.at, 0, True))
    texture.made.append(fields)
    return texture


def encode(machine: Machine, buffer: Value, descriptor: Value, at: Span, frame: Frame) -> Value:
    """The encoder of a render pass, of the descriptor as it is now. Into a buffer that is begun elsewhere others may encode too."""
    if not (isinstance(buffer, Object) and buffer.kind == "commands" and buffer.complete):
        machine.incomplete.add(machine.root)
    encoder = machine.made("encoder", "", at, frame.way, True)
    if not isinstance(descriptor, Object) or descriptor.kind != "pass":
        machine.incomplete.add(machine.root)
        return encoder
    render_pass = pass_of(machine, descriptor, at)
    key = (id(descriptor), at.start, frame.way)
    machine.passes.setdefault(key, render_pass)
    render_pass = machine.passes[key]
    encoder.of = render_pass
    note(machine, "pass", (render_pass,), at)
    return encoder


def pass_of(machine: Machine, descriptor: Object, at: Span) -> Pass:
    """A descriptor's attachments as they are now."""
    attachments: dict[str, dict[str, Field]] = {}
    unknown: set[str] = set()
    for name, field in machine.snapshot(descriptor).items():
        if isinstance(field.value, Object) and field.value.kind == "attachment":
            fields = machine.snapshot(field.value)
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


def make_pipeline(machine: Machine, descriptor: Value, at: Span, frame: Frame) -> Value:
    """The state of a pipeline, of the descriptor as it is now."""
    state = machine.made("state", "", at, frame.way, True)
    if not isinstance(descriptor, Object) or descriptor.kind != "pipeline":
        return state
    key = (id(descriptor), at.start, frame.way)
    if key not in machine.pipelines:
        machine.pipelines[key] = pipeline_of(machine, descriptor, at, frame.whose)
    state.of = machine.pipelines[key]
    return state


def pipeline_of(machine: Machine, descriptor: Object, at: Span, within: str) -> Pipeline:
    """A pipeline's descriptor as it is now."""
    colors: dict[str, dict[str, Field]] = {}
    fields: dict[str, Field] = {}
    for name, field in machine.snapshot(descriptor).items():
        if isinstance(field.value, Object):
            if field.value.kind == "attachment" and name != ANY:
                colors[name] = machine.snapshot(field.value)
        else:
            fields[name] = field
    pipeline = Pipeline(descriptor, at, fields, colors)
    pipeline.within = within
    return pipeline
