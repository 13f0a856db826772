"""Members of Metal's objects: what reading one gives, and what setting one changes."""

from __future__ import annotations

from msaa_lint.core.text.span import Span

from .configurations import last_name
from .frame_state import Frame
from .machine import Machine
from .terms import MEMBER, NAME, Term
from .values import NIL, UNKNOWN, Aggregate, Field, Known, Object, Symbol, Texture, Value

ANY = "color?"
"""The colour attachment whose index is not known."""

MOST_COLORS = 8

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
"""Members that are followed."""

_PASSES = ("currentRenderPassDescriptor", "currentMTL4RenderPassDescriptor")
_STORAGE = {f"storageMode{mode.capitalize()}": mode for mode in ("shared", "managed", "private", "memoryless")}


def member_of(machine: Machine, value: Value, name: str, at: Span, frame: Frame) -> Value | None:
    """What a member of a value holds; None where it is no value that is followed."""
    if isinstance(value, Object):
        return _of_object(machine, value, name, at, frame)
    if isinstance(value, Texture):
        fields = value.made[-1] if value.made else {}
        return fields[name].value if name in fields else None
    if isinstance(value, Aggregate):
        return value.items.get(name, UNKNOWN)
    if name in _PASSES:
        return view_pass(machine, at, frame)
    if name == "currentDrawable":
        return machine.made("drawable", "drawable", at, 0, False)
    return None


def _of_object(machine: Machine, metal_object: Object, name: str, at: Span, frame: Frame) -> Value | None:
    kind = metal_object.kind
    if kind in ("pass", "pipeline"):
        if name == "colorAttachments":
            return slots_of(machine, metal_object, at)
        if name in _ATTACHMENTS:
            return slot(machine, metal_object, name, at)
    elif kind == "view":
        if name in _PASSES:
            return view_pass(machine, at, frame)
        if name == "currentDrawable":
            return machine.made("drawable", "drawable", at, 0, False)
        if name == "multisampleColorTexture":
            return view_texture(machine, metal_object, name, at)
        if name == "depthStencilTexture":
            return view_texture(machine, metal_object, name, at)
        if name == "layer":
            return machine.made("layer", "layer", at, 0, False)
    elif kind == "drawable" and name == "texture":
        return drawable(machine, at)
    field = machine.has(metal_object, name)
    if field is None:
        return None
    return field.value if field.value is not UNKNOWN else Symbol(name, f"{metal_object.kind} {metal_object.name}")


def slots_of(machine: Machine, metal_object: Object, at: Span) -> Object:
    """A descriptor's array of colour attachments."""
    key = ("slots", id(metal_object))
    slots = machine.objects.get(key)
    if slots is None:
        slots = machine.objects[key] = Object("slots", "", at, True)
        slots.of = metal_object
    return slots


def slot(machine: Machine, metal_object: Object, name: str, at: Span) -> Value:
    """An attachment of a descriptor, there from its beginning."""
    field = machine.has(metal_object, name)
    if field is not None:
        return field.value
    key = ("attachment", id(metal_object), name)
    attachment = machine.objects.get(key)
    if attachment is None:
        attachment = machine.objects[key] = Object("attachment", name, at, True)
        attachment.of = metal_object
    elif attachment.fields:
        machine.renew(attachment)
    metal_object.fields[name] = Field(attachment, at, at, machine.root)
    return attachment


def index_of(machine: Machine, value: Value, index: Value, at: Span) -> Value | None:
    """What an index into a value gives; None where it is no value that is followed."""
    if isinstance(value, Object) and value.kind == "slots":
        return slot(machine, value.of, color_slot(index), at)
    if isinstance(value, Aggregate) and isinstance(index, Known):
        return value.items.get(str(index.value), UNKNOWN)
    return None


def color_slot(index: Value) -> str:
    if isinstance(index, Known) and type(index.value) is int and 0 <= index.value < MOST_COLORS:
        return f"color{index.value}"
    return ANY


def set_index(machine: Machine, owner: Value, index: Value, value: Value, key: Span, at: Span) -> bool:
    """Sets an attachment as a whole; whether the value was one that is followed."""
    if not isinstance(owner, Object) or owner.kind != "slots":
        return False
    machine.give(owner.of, color_slot(index), value if isinstance(value, Object) else UNKNOWN, key, at)
    return True


def set_member(machine: Machine, owner: Value, name: str, value: Value, key: Span, at: Span) -> bool:
    """Sets a member; whether its owner is followed."""
    if isinstance(owner, Aggregate):
        machine.journal.write(owner.items, name, value)
        return True
    if not isinstance(owner, Object):
        return False
    if owner.kind == "attachment":
        if name in ("texture", "resolveTexture"):
            value = as_texture(machine, value, at)
            if isinstance(value, Texture) and not value.name:
                machine.name(value, name, owner.of.name if isinstance(owner.of, Object) else "", 1 << 29)
        elif name in _OF_PIPELINES and isinstance(owner.of, Object) and not owner.of.complete:
            owner.of.kind = "pipeline"
    elif name == "resourceOptions":
        words = value.value if isinstance(value, Known) else ()
        modes = [_STORAGE[word] for word in (words if isinstance(words, tuple) else (str(words),)) if word in _STORAGE]
        name, value = "storageMode", Known(modes[0]) if modes else UNKNOWN
    elif name in _ATTACHMENTS and owner.kind == "pass" and not isinstance(value, Object):
        value = UNKNOWN
    if name in _KEPT:
        machine.give(owner, name, value, key, at)
    return True


def as_texture(machine: Machine, value: Value, at: Span) -> Value:
    """The texture that a value is, one of which only the name is known at least."""
    if isinstance(value, Texture) or value == NIL:
        return value
    if isinstance(value, Symbol):
        return machine.opaque(value.text, value.whose, at)
    return UNKNOWN


_TEXTURE_MEMBERS = frozenset({"textureType", "usage", "storageMode", "sampleCount"})


def adopted(machine: Machine, symbol: Symbol, term: Term, member: str, frame: Frame) -> Value:
    """The object that code builds up which is begun elsewhere, told by its name and the member that is set."""
    if term[0] != NAME and not (term[0] == MEMBER and term[1] is not None and term[1][:2] == (NAME, "self")):
        return symbol
    low = last_name(term).lower()
    kind = "texture" if member in _TEXTURE_MEMBERS and "desc" in low else ""
    if member in ("sampleCount", "depthStencilPixelFormat", "colorPixelFormat") and "view" in low:
        kind = "view"
    if member in ("rasterSampleCount", "sampleCount", "isAlphaToCoverageEnabled", "depthAttachmentPixelFormat") and "pipeline" in low:
        kind = "pipeline"
    if member in ("colorAttachments", *_ATTACHMENTS):
        kind = "pipeline" if "pipeline" in low or "pso" in low else "pass"
    if not kind:
        return symbol
    metal_object = machine.made(kind, last_name(term), term[-1], symbol, False)
    machine.name(metal_object, last_name(term), frame.whose, frame.rank)
    _hold(machine, term, metal_object, frame)
    return metal_object


def _hold(machine: Machine, term: Term, metal_object: Object, frame: Frame) -> None:
    name = last_name(term)
    if term[0] == NAME and frame.find(name) is not None:
        machine.journal.write(frame.locals, name, metal_object)
    else:
        machine.set_property(frame.within, name, metal_object, term[-1])


# What MTKView makes


def drawable(machine: Machine, at: Span) -> Texture:
    """The texture of the drawable of the file."""
    texture = machine.textures.get(("drawable",))
    if texture is None:
        texture = machine.textures["drawable",] = Texture("drawable", "", at)
        texture.drawable = True
    return texture


def view_texture(machine: Machine, view: Object, name: str, at: Span) -> Texture:
    """A texture that the view makes and keeps."""
    texture = machine.textures.get((name, "view"))
    if texture is None:
        texture = machine.textures[name, "view"] = Texture(name, "", at)
        texture.owner = view
    return texture


def view_pass(machine: Machine, at: Span, frame: Frame) -> Object:
    """The descriptor that MTKView makes for its drawable: with multisampling it clears the multisampled texture and resolves it into the
    drawable's; depth and stencil are cleared and not stored (Apple's documentation of currentRenderPassDescriptor)."""
    descriptor = machine.made("pass", "", at, frame.way, True)
    view = machine.made("view", "view", at, 0, False)
    descriptor.of = view
    count = machine.every.get((id(view), "sampleCount"), machine.given.get((id(view), "sampleCount")))
    several = isinstance(count, Known) and type(count.value) is int and count.value > 1
    if not several or len(machine.views) > 1:
        descriptor.complete = False
        return descriptor
    color = slot(machine, descriptor, "color0", at)
    if isinstance(color, Object):
        machine.give(color, "texture", view_texture(machine, view, "multisampleColorTexture", at), at, at)
        machine.give(color, "resolveTexture", drawable(machine, at), at, at)
        machine.give(color, "loadAction", Known("clear"), at, at)
        machine.give(color, "storeAction", Known("multisampleResolve"), at, at)
    kind = machine.every.get((id(view), "depthStencilPixelFormat"), machine.given.get((id(view), "depthStencilPixelFormat")))
    written = kind.value if isinstance(kind, Known) and isinstance(kind.value, str) else ""
    for name, words in (("depthAttachment", ("depth",)), ("stencilAttachment", ("stencil",))):
        attachment = slot(machine, descriptor, name, at) if any(word in written for word in words) else None
        if isinstance(attachment, Object):
            machine.give(attachment, "texture", view_texture(machine, view, "depthStencilTexture", at), at, at)
            machine.give(attachment, "loadAction", Known("clear"), at, at)
            machine.give(attachment, "storeAction", Known("dontCare"), at, at)
    return descriptor
