"""Where a frame in Metal's words states the facts that a fix may change, and the changes that take more than a member."""

from __future__ import annotations

from collections.abc import Callable

from msaa_lint.frame.description.models import Metal, MetalTexture
from msaa_lint.frame.description.record import Record
from msaa_lint.frame.facts.facts import Subject
from msaa_lint.frame.facts.frame import Aspect, Resolve, Target
from msaa_lint.frame.facts.metal import stated_for
from msaa_lint.frame.metal.names import KEEPING, MULTISAMPLE_RESOLVES

from .changes import Change, FixContext, Refused
from .fact_sources import Places, attachment_of, targets_of
from .usages import TOLD_BY_COMMANDS

_FLAGS = {"shaderRead": "SAMPLED", "shaderWrite": "STORAGE", "shaderAtomic": "STORAGE"}


def metal_of(mending: FixContext) -> Metal:
    """The section that states the frame."""
    metal = mending.document.description.metal
    assert metal is not None
    return metal


def _texture(member: str) -> Callable[[Subject, FixContext], Places]:
    def find(subject: Subject, mending: FixContext) -> Places:
        textures = metal_of(mending).textures
        found = [textures[target.name] for target in targets_of(subject) if target.image is not None and target.name in textures]
        return [(texture, member, "") for texture in found] or Refused("the texture is not described")

    return find


def _action(*members: str) -> Callable[[Subject, FixContext], Places]:
    """The first of some members that the structure of an aspect, or of what a resolve reads, has."""

    def find(subject: Subject, mending: FixContext) -> Places:
        record = _record(subject, mending)
        member = next((m for m in members if record is not None and m in record.SHAPE), None)
        if record is None or member is None:
            return Refused("it is not about one aspect of an attachment that states it")
        return [(record, member, "")]

    return find


def _record(subject: Subject, mending: FixContext) -> Record | None:
    lowered = mending.document.metal
    assert lowered is not None
    if isinstance(subject.of, Resolve):
        source = subject.of.source
        return stated_for(source, subject.of.aspect, lowered) if source is not None else None
    attachment = attachment_of(subject)
    aspect = subject.of[1] if isinstance(subject.of, tuple) else None
    return stated_for(attachment, aspect.name, lowered) if attachment is not None and isinstance(aspect, Aspect) else None


def _pipeline(*members: str) -> Callable[[Subject, FixContext], Places]:
    """A property of a pipeline by the name that it is stated by; the first of its names where it is not."""

    def find(subject: Subject, mending: FixContext) -> Places:
        pipeline = subject.of[0] if isinstance(subject.of, tuple) else None
        record = metal_of(mending).renderPipelines.get(pipeline.key) if isinstance(pipeline, Record) else None
        if record is None:
            return Refused("the pipeline is not described")
        return [(record, next((m for m in members if record.states(m)), members[0]), "")]

    return find


CHANGEABLE: dict[str, Callable[[Subject, FixContext], Places]] = {
    "image.storage_mode": _texture("storageMode"),
    "image.texture_type": _texture("textureType"),
    "image.usage_words": _texture("usage"),
    "image.samples": _texture("sampleCount"),
    "image.mip_levels": _texture("mipmapLevelCount"),
    "aspect.load_action": _action("loadAction"),
    "aspect.store_action": _action("storeAction"),
    "aspect.resolve_filter": _action("depthResolveFilter", "stencilResolveFilter"),
    "resolve.filter": _action("depthResolveFilter", "stencilResolveFilter"),
    "pipeline.rasterization_samples": _pipeline("rasterSampleCount", "sampleCount"),
    "pipeline.alpha_to_coverage": _pipeline("isAlphaToCoverageEnabled", "alphaToCoverageEnabled"),
}
"""By fact. Of the others it is Vulkan's words alone that state them."""


def places(fact: str, subject: Subject, mending: FixContext) -> Places:
    """The members of Metal's structures that state a fact; why none can be changed, where none can."""
    find = CHANGEABLE.get(fact)
    return find(subject, mending) if find is not None else Refused("the fix is in Vulkan's words, and the frame in Metal's")


def make_memoryless(subject: Subject, mending: FixContext) -> list[Change] | Refused:
    """Memoryless storage; away with usages that nothing needs, and with stores that nothing reads."""
    target = subject.of
    texture = metal_of(mending).textures.get(target.name) if isinstance(target, Target) and target.image is not None else None
    if texture is None or not isinstance(target, Target):
        return Refused("the texture is not described")
    values = subject.facts.values
    if values.get("image.read") is not False or values.get("image.loaded") is not False or texture.drawable:
        return Refused("something reads or loads it, or may")
    if values.get("image.memoryless_offered") is False:
        return Refused("the GPU has no memoryless textures")
    usage = _usage(texture, mending)
    actions = _actions(target, mending)
    if isinstance(usage, Refused):
        return usage
    if isinstance(actions, Refused):
        return actions
    return [*usage, Change(texture, "storageMode", "set", "memoryless"), *actions]


def _usage(texture: MetalTexture, mending: FixContext) -> list[Change] | Refused:
    """Away with all but renderTarget, as far as the commands say that nothing needs it."""
    found: list[Change] = []
    told = mending.frame.has_commands and mending.usages.followed
    needed = mending.usages.needed(texture.key, None)
    for word in texture.usage or ():
        flag = _FLAGS.get(word)
        if word == "renderTarget":
            continue
        if word != "unknown" and (not told or flag is None or flag in needed or flag not in TOLD_BY_COMMANDS):
            return Refused(f"its usage {word} may be needed")
        found.append(Change(texture, "usage", "remove", word))
    if texture.usage is not None and "renderTarget" not in texture.usage:
        found.append(Change(texture, "usage", "add", "renderTarget"))
    return found


def _actions(target: Target, mending: FixContext) -> list[Change] | Refused:
    """No store of what a memoryless texture has no memory for."""
    lowered = mending.document.metal
    assert lowered is not None
    found: list[Change] = []
    for each, attachment in mending.attachments.get(id(target.record), ()):
        if attachment.resolve:
            return Refused(f"a resolve in `{each.name}` writes it")
        for aspect in attachment.aspects:
            record = stated_for(attachment, aspect.name, lowered)
            store = getattr(record, "storeAction", None)
            if record is None or store not in KEEPING:
                continue
            if mending.timeline.read_later(each, attachment, aspect) is not False:
                return Refused(f"whether something reads what {attachment.title} stores is not known")
            found.append(Change(record, "storeAction", "set", "multisampleResolve" if store in MULTISAMPLE_RESOLVES else "dontCare"))
    return found


def drop_resolve_texture(subject: Subject, mending: FixContext) -> list[Change] | Refused:
    """Takes a resolve texture away that no store action resolves to."""
    record = _record(subject, mending)
    store = getattr(record, "storeAction", None)
    if record is None or not record.states("resolveTexture"):
        return Refused("no resolve texture is stated")
    if store in MULTISAMPLE_RESOLVES or store in (None, "unknown"):
        return Refused("the pass resolves to it, or may")
    return [Change(record, "resolveTexture", "unset")]


def resolve_to_copy(subject: Subject, mending: FixContext) -> list[Change] | Refused:
    """Resolves to the texture that the result is copied to, and takes the copy and the texture between away."""
    metal, record = metal_of(mending), _record(subject, mending)
    between, target = (subject.facts.values.get(f"resolve.copied_{end}") for end in ("from", "to"))
    if record is None or between not in metal.textures or target not in metal.textures:
        return Refused("a texture of it is not described")
    mentions = mending.metal_mentions
    copies = mentions.copies.get((str(between), str(target)), [])
    if len(copies) != 1:
        return Refused("it is copied more than once")
    to = metal.textures[str(target)]
    made = [Change(record, "resolveTexture", "set", target), Change(metal, "commands", "drop", copies[0])]
    if to.usage is not None and "renderTarget" not in to.usage and "unknown" not in to.usage:
        made.append(Change(to, "usage", "add", "renderTarget"))
    if mentions.names[str(between)] == 2:
        made.append(Change(metal, "textures", "drop", list(metal.textures).index(str(between))))
    return made


DEEDS: dict[str, Callable[[Subject, FixContext], list[Change] | Refused]] = {
    "make-memoryless": make_memoryless,
    "drop-resolve-texture": drop_resolve_texture,
    "resolve-to-copy": resolve_to_copy,
}
"""What pages name by `do`, of frames in Metal's words."""
