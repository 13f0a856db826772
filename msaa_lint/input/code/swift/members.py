"""Reads and sets the members of Metal objects."""

from __future__ import annotations

from msaa_lint.core.text.span import Span

from .conditions import last_name
from .interpreter import Interpreter
from .terms import MEMBER, NAME, Term
from .values import NIL, UNKNOWN, Aggregate, CallFrame, Constant, Field, MetalObject, Symbol, Texture, Value, options

ANY = "color?"
"""The color attachment with an unknown index."""

MAX_COLORS = 8

_ATTACHMENTS = ("depthAttachment", "stencilAttachment")
_OF_PIPELINES = frozenset({"pixelFormat", "isBlendingEnabled", "blendingEnabled", "writeMask", "blendingState"})
_KEPT = frozenset(
    {
        *("pixelFormat", "width", "height", "mipmapLevelCount", "arrayLength", "textureType", "sampleCount", "usage", "storageMode"),
        *("texture", "resolveTexture", "loadAction", "storeAction", "depthResolveFilter", "stencilResolveFilter"),
        *("rasterSampleCount", "depthAttachmentPixelFormat", "stencilAttachmentPixelFormat", "isRasterizationEnabled"),
        *("isAlphaToCoverageEnabled", "alphaToCoverageEnabled", "isAlphaToOneEnabled", "alphaToOneEnabled", "isBlendingEnabled"),
        *("colorPixelFormat", "depthStencilPixelFormat", *_ATTACHMENTS),
    }
)
"""Members that are tracked."""

_PASSES = ("currentRenderPassDescriptor", "currentMTL4RenderPassDescriptor")
_STORAGE = {f"storageMode{mode.capitalize()}": mode for mode in ("shared", "managed", "private", "memoryless")}


def member_of(interpreter: Interpreter, value: Value, name: str, at: Span, frame: CallFrame) -> Value | None:
    """Returns a member of a value, or None if the value is not tracked."""
    if isinstance(value, Texture):
        fields = value.made[-1] if value.made else {}
        return fields[name].value if name in fields else None
    if isinstance(value, Aggregate):
        return value.items.get(name, UNKNOWN)
    if not isinstance(value, MetalObject) or value.kind == "view":
        if name in _PASSES:
            return view_pass(interpreter, at, frame)
        if name == "currentDrawable":
            return interpreter.object_at("drawable", "drawable", at, 0, False)
    return _of_object(interpreter, value, name, at) if isinstance(value, MetalObject) else None


def _of_object(interpreter: Interpreter, metal_object: MetalObject, name: str, at: Span) -> Value | None:
    kind = metal_object.kind
    if kind in ("pass", "pipeline"):
        if name == "colorAttachments":
            return attachment_slots(interpreter, metal_object, at)
        if name in _ATTACHMENTS:
            return attachment_slot(interpreter, metal_object, name, at)
    elif kind == "view":
        if name in ("multisampleColorTexture", "depthStencilTexture"):
            return view_texture(interpreter, metal_object, name, at)
        if name == "layer":
            return interpreter.object_at("layer", "layer", at, 0, False)
    elif kind == "drawable" and name == "texture":
        return drawable(interpreter, at)
    field = interpreter.field(metal_object, name)
    if field is None:
        return None
    return field.value if field.value is not UNKNOWN else Symbol(name, f"{metal_object.kind} {metal_object.name}")


def attachment_slots(interpreter: Interpreter, metal_object: MetalObject, at: Span) -> MetalObject:
    """Returns the color attachment array of a descriptor."""
    slots = interpreter.object_of(("slots", id(metal_object)), "slots", "", at, True)
    slots.of = metal_object
    return slots


def attachment_slot(interpreter: Interpreter, metal_object: MetalObject, name: str, at: Span) -> Value:
    """Returns an attachment of a descriptor, which always exists."""
    field = interpreter.field(metal_object, name)
    if field is not None:
        return field.value
    attachment = interpreter.object_of(("attachment", id(metal_object), name), "attachment", name, at, True)
    attachment.of = metal_object
    interpreter.reset(attachment)
    metal_object.fields[name] = Field(attachment, at, at, interpreter.root)
    return attachment


def index_of(interpreter: Interpreter, value: Value, index: Value, at: Span) -> Value | None:
    """Returns an element of a value, or None if the value is not tracked."""
    if isinstance(value, MetalObject) and value.kind == "slots":
        return attachment_slot(interpreter, value.of, color_slot(index), at)
    if isinstance(value, Aggregate) and isinstance(index, Constant):
        return value.items.get(str(index.value), UNKNOWN)
    return None


def color_slot(index: Value) -> str:
    if isinstance(index, Constant) and type(index.value) is int and 0 <= index.value < MAX_COLORS:
        return f"color{index.value}"
    return ANY


def set_index(interpreter: Interpreter, owner: Value, index: Value, value: Value, key: Span, at: Span) -> bool:
    """Sets a whole attachment. Returns whether the owner is tracked."""
    if not isinstance(owner, MetalObject) or owner.kind != "slots":
        return False
    interpreter.set_field(owner.of, color_slot(index), value if isinstance(value, MetalObject) else UNKNOWN, key, at)
    return True


def set_member(interpreter: Interpreter, owner: Value, name: str, value: Value, key: Span, at: Span) -> bool:
    """Sets a member. Returns whether its owner is tracked."""
    if isinstance(owner, Aggregate):
        interpreter.undo_log.write(owner.items, name, value)
        return True
    if not isinstance(owner, MetalObject):
        return False
    if owner.kind == "attachment":
        if name in ("texture", "resolveTexture"):
            value = as_texture(interpreter, value, at)
            if isinstance(value, Texture) and not value.name:
                interpreter.name_value(value, name, owner.of.name if isinstance(owner.of, MetalObject) else "", 1 << 29)
        elif name in _OF_PIPELINES and isinstance(owner.of, MetalObject) and not owner.of.complete:
            owner.of.kind = "pipeline"
    elif name == "resourceOptions":
        words = value.value if isinstance(value, Constant) else None
        modes = [_STORAGE[word] for word in (options(words) if isinstance(words, (str, tuple)) else ()) if word in _STORAGE]
        name, value = "storageMode", Constant(modes[0]) if modes else UNKNOWN
    elif name in _ATTACHMENTS and owner.kind == "pass" and not isinstance(value, MetalObject):
        value = UNKNOWN
    if name in _KEPT:
        interpreter.set_field(owner, name, value, key, at)
    return True


def as_texture(interpreter: Interpreter, value: Value, at: Span) -> Value:
    """Returns a value as a texture; of an unknown value, at least the name is known."""
    if isinstance(value, Texture) or value == NIL:
        return value
    if isinstance(value, Symbol):
        return interpreter.named_texture(value.text, value.function_name, at)
    return UNKNOWN


_TEXTURE_MEMBERS = frozenset({"textureType", "usage", "storageMode", "sampleCount"})


def adopt_descriptor(interpreter: Interpreter, symbol: Symbol, term: Term, member: str, frame: CallFrame) -> Value:
    """Returns the descriptor that a symbol stands for, identified by its name and the member that is set."""
    if term[0] != NAME and not (term[0] == MEMBER and term[1] is not None and term[1][:2] == (NAME, "self")):
        return symbol
    name = last_name(term)
    low = name.lower()
    kind = "texture" if member in _TEXTURE_MEMBERS and "desc" in low else ""
    if member in ("sampleCount", "depthStencilPixelFormat", "colorPixelFormat") and "view" in low:
        kind = "view"
    if member in ("rasterSampleCount", "sampleCount", "isAlphaToCoverageEnabled", "depthAttachmentPixelFormat") and "pipeline" in low:
        kind = "pipeline"
    if member in ("colorAttachments", *_ATTACHMENTS):
        kind = "pipeline" if "pipeline" in low or "pso" in low else "pass"
    if not kind:
        return symbol
    metal_object = interpreter.object_at(kind, name, term[-1], symbol, False)
    interpreter.name_value(metal_object, name, frame.function_name, frame.rank)
    if term[0] == NAME and frame.find(name) is not None:
        interpreter.undo_log.write(frame.locals, name, metal_object)
    else:
        interpreter.set_property(frame.type_name, name, metal_object, term[-1])
    return metal_object


def drawable(interpreter: Interpreter, at: Span) -> Texture:
    """Returns the texture of the file's drawable."""
    texture = interpreter.texture_of(("drawable",), "drawable", "", at)
    texture.drawable = True
    return texture


def view_texture(interpreter: Interpreter, view: MetalObject, name: str, at: Span) -> Texture:
    """Returns a texture that the view creates and keeps."""
    texture = interpreter.texture_of((name, "view"), name, "", at)
    texture.owner = view
    return texture


def view_pass(interpreter: Interpreter, at: Span, frame: CallFrame) -> MetalObject:
    """Returns the descriptor that MTKView creates for its drawable.

    With multisampling, it clears the multisampled texture and resolves it to the drawable's texture. Depth and stencil are cleared and not
    stored (Apple's documentation of currentRenderPassDescriptor).
    """
    descriptor = interpreter.object_at("pass", "", at, frame.path, True)
    view = interpreter.object_at("view", "view", at, 0, False)
    descriptor.of = view
    count = _view_setting(interpreter, view, "sampleCount")
    several = isinstance(count, Constant) and type(count.value) is int and count.value > 1
    if not several or len(interpreter.views) > 1:
        descriptor.complete = False
        return descriptor
    _clear(interpreter, descriptor, "color0", view_texture(interpreter, view, "multisampleColorTexture", at), "multisampleResolve", at)
    pixels = _view_setting(interpreter, view, "depthStencilPixelFormat")
    for word in ("depth", "stencil"):
        if isinstance(pixels, Constant) and isinstance(pixels.value, str) and word in pixels.value:
            _clear(interpreter, descriptor, f"{word}Attachment", view_texture(interpreter, view, "depthStencilTexture", at), "dontCare", at)
    return descriptor


def _view_setting(interpreter: Interpreter, view: MetalObject, name: str) -> Value | None:
    place = (id(view), name)
    return interpreter.new_member_values.get(place, interpreter.member_values.get(place))


def _clear(interpreter: Interpreter, descriptor: MetalObject, slot: str, texture: Texture, store: str, at: Span) -> None:
    """Sets an attachment that is cleared."""
    attachment = attachment_slot(interpreter, descriptor, slot, at)
    if isinstance(attachment, MetalObject):
        interpreter.set_field(attachment, "texture", texture, at, at)
        if store == "multisampleResolve":
            interpreter.set_field(attachment, "resolveTexture", drawable(interpreter, at), at, at)
        interpreter.set_field(attachment, "loadAction", Constant("clear"), at, at)
        interpreter.set_field(attachment, "storeAction", Constant(store), at, at)
