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


def member_of(machine: Machine, held: Value, name: str, at: Span, frame: Frame) -> Value | None:
    """What a member of a value holds; None where it is no value that is followed."""
    if isinstance(held, Object):
        return _of_object(machine, held, name, at, frame)
    if isinstance(held, Texture):
        fields = held.made[-1] if held.made else {}
        return fields[name].value if name in fields else None
    if isinstance(held, Aggregate):
        return held.items.get(name, UNKNOWN)
    if name in _PASSES:
        return view_pass(machine, at, frame)
    if name == "currentDrawable":
        return machine.made("drawable", "drawable", at, 0, False)
    return None


def _of_object(machine: Machine, held: Object, name: str, at: Span, frame: Frame) -> Value | None:
    kind = held.kind
    if kind in ("pass", "pipeline"):
        if name == "colorAttachments":
            return slots_of(machine, held, at)
        if name in _ATTACHMENTS:
            return slot(machine, held, name, at)
    elif kind == "view":
        if name in _PASSES:
            return view_pass(machine, at, frame)
        if name == "currentDrawable":
            return machine.made("drawable", "drawable", at, 0, False)
        if name == "multisampleColorTexture":
            return view_texture(machine, held, name, at)
        if name == "depthStencilTexture":
            return view_texture(machine, held, name, at)
        if name == "layer":
            return machine.made("layer", "layer", at, 0, False)
    elif kind == "drawable" and name == "texture":
        return drawable(machine, at)
    field = machine.has(held, name)
    if field is None:
        return None
    return field.value if field.value is not UNKNOWN else Symbol(name, f"{held.kind} {held.name}")


def slots_of(machine: Machine, held: Object, at: Span) -> Object:
    """A descriptor's array of colour attachments."""
    key = ("slots", id(held))
    found = machine.objects.get(key)
    if found is None:
        found = machine.objects[key] = Object("slots", "", at, True)
        found.of = held
    return found


def slot(machine: Machine, held: Object, name: str, at: Span) -> Value:
    """An attachment of a descriptor, there from its beginning."""
    field = machine.has(held, name)
    if field is not None:
        return field.value
    key = ("attachment", id(held), name)
    found = machine.objects.get(key)
    if found is None:
        found = machine.objects[key] = Object("attachment", name, at, True)
        found.of = held
    elif found.fields:
        machine.renew(found)
    held.fields[name] = Field(found, at, at, machine.root)
    return found


def index_of(machine: Machine, held: Value, index: Value, at: Span) -> Value | None:
    """What an index into a value gives; None where it is no value that is followed."""
    if isinstance(held, Object) and held.kind == "slots":
        return slot(machine, held.of, color_slot(index), at)
    if isinstance(held, Aggregate) and isinstance(index, Known):
        return held.items.get(str(index.value), UNKNOWN)
    return None


def color_slot(index: Value) -> str:
    if isinstance(index, Known) and type(index.value) is int and 0 <= index.value < MOST_COLORS:
        return f"color{index.value}"
    return ANY


def set_index(machine: Machine, owner: Value, index: Value, held: Value, key: Span, at: Span) -> bool:
    """Sets an attachment as a whole; whether the value was one that is followed."""
    if not isinstance(owner, Object) or owner.kind != "slots":
        return False
    machine.give(owner.of, color_slot(index), held if isinstance(held, Object) else UNKNOWN, key, at)
    return True


def set_member(machine: Machine, owner: Value, name: str, held: Value, key: Span, at: Span) -> bool:
    """Sets a member; whether its owner is followed."""
    if isinstance(owner, Aggregate):
        machine.journal.write(owner.items, name, held)
        return True
    if not isinstance(owner, Object):
        return False
    if owner.kind == "attachment":
        if name in ("texture", "resolveTexture"):
            held = as_texture(machine, held, at)
            if isinstance(held, Texture) and not held.name:
                machine.name(held, name, owner.of.name if isinstance(owner.of, Object) else "", 1 << 29)
        elif name in _OF_PIPELINES and isinstance(owner.of, Object) and not owner.of.complete:
            owner.of.kind = "pipeline"
    elif name == "resourceOptions":
        words = held.value if isinstance(held, Known) else ()
        modes = [_STORAGE[word] for word in (words if isinstance(words, tuple) else (str(words),)) if word in _STORAGE]
        name, held = "storageMode", Known(modes[0]) if modes else UNKNOWN
    elif name in _ATTACHMENTS and owner.kind == "pass" and not isinstance(held, Object):
        held = UNKNOWN
    if name in _KEPT:
        machine.give(owner, name, held, key, at)
    return True


def as_texture(machine: Machine, held: Value, at: Span) -> Value:
    """The texture that a value is, one of which only the name is known at least."""
    if isinstance(held, Texture) or held == NIL:
        return held
    if isinstance(held, Symbol):
        return machine.opaque(held.text, held.whose, at)
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
    found = machine.made(kind, last_name(term), term[-1], symbol, False)
    machine.name(found, last_name(term), frame.whose, frame.rank)
    _hold(machine, term, found, frame)
    return found


def _hold(machine: Machine, term: Term, found: Object, frame: Frame) -> None:
    name = last_name(term)
    if term[0] == NAME and frame.find(name) is not None:
        machine.journal.write(frame.locals, name, found)
    else:
        machine.set_property(frame.within, name, found, term[-1])


# What MTKView makes


def drawable(machine: Machine, at: Span) -> Texture:
    """The texture of the drawable of the file."""
    found = machine.textures.get(("drawable",))
    if found is None:
        found = machine.textures["drawable",] = Texture("drawable", "", at)
        found.drawable = True
    return found


def view_texture(machine: Machine, view: Object, name: str, at: Span) -> Texture:
    """A texture that the view makes and keeps."""
    found = machine.textures.get((name, "view"))
    if found is None:
        found = machine.textures[name, "view"] = Texture(name, "", at)
        found.owner = view
    return found


def view_pass(machine: Machine, at: Span, frame: Frame) -> Object:
    """The descriptor that MTKView makes for its drawable: with multisampling it clears the multisampled texture and resolves it into the
    drawable's; depth and stencil are cleared and not stored (Apple's documentation of currentRenderPassDescriptor)."""
    found = machine.made("pass", "", at, frame.way, True)
    view = machine.made("view", "view", at, 0, False)
    found.of = view
    count = machine.every.get((id(view), "sampleCount"), machine.given.get((id(view), "sampleCount")))
    several = isinstance(count, Known) and type(count.value) is int and count.value > 1
    if not several or len(machine.views) > 1:
        found.complete = False
        return found
    color = slot(machine, found, "color0", at)
    if isinstance(color, Object):
        machine.give(color, "texture", view_texture(machine, view, "multisampleColorTexture", at), at, at)
        machine.give(color, "resolveTexture", drawable(machine, at), at, at)
        machine.give(color, "loadAction", Known("clear"), at, at)
        machine.give(color, "storeAction", Known("multisampleResolve"), at, at)
    kind = machine.every.get((id(view), "depthStencilPixelFormat"), machine.given.get((id(view), "depthStencilPixelFormat")))
    written = kind.value if isinstance(kind, Known) and isinstance(kind.value, str) else ""
    for name, words in (("depthAttachment", ("depth",)), ("stencilAttachment", ("stencil",))):
        each = slot(machine, found, name, at) if any(word in written for word in words) else None
        if isinstance(each, Object):
            machine.give(each, "texture", view_texture(machine, view, "depthStencilTexture", at), at, at)
            machine.give(each, "loadAction", Known("clear"), at, at)
            machine.give(each, "storeAction", Known("dontCare"), at, at)
    return found
