"""Facts of frames in Metal's words, beside those of the Vulkan records that they are judged by."""

from __future__ import annotations

from msaa_lint.frame.description.document import Lowered
from msaa_lint.frame.description.models import Metal, MetalDepthAttachment, MetalStencilAttachment
from msaa_lint.frame.description.record import Record
from msaa_lint.frame.metal.families import counts, offers_count, offers_memoryless
from msaa_lint.frame.metal.names import MULTISAMPLE_RESOLVES, MULTISAMPLE_TYPES

from .facts import Facts
from .parts import Aspect, Attachment, Resolve, Target


def texture_facts(facts: Facts, target: Target, metal: Metal, lazy_memory: object) -> None:
    """Adds what a texture states, and what its usage and the GPU allow; takes away what only
    Vulkan's usage would say.
    """
    texture = metal.textures.get(target.name) if target.image is not None else None
    if texture is None:
        return
    facts.put("image.storage_mode", texture.storageMode, texture.place("storageMode"))
    facts.put("image.texture_type", texture.textureType, texture.place("textureType"))
    words = list(texture.usage) if texture.usage and "unknown" not in texture.usage else None
    facts.put("image.usage_words", words, texture.place("usage"))
    if words is not None:
        conflicts = [word for word in words if word != "renderTarget"]
        facts.put(
            "image.memoryless_conflicts",
            conflicts,
            texture.flag_place("usage", conflicts or ("renderTarget",)),
        )
    if texture.textureType is not None and target.samples is not None:
        fits = (texture.textureType in MULTISAMPLE_TYPES) == (target.samples > 1)
        facts.put("image.type_fits", fits, texture.place("textureType"))
    elif texture.drawable and target.samples == 1:
        facts.put("image.type_fits", True)
    offered = offers_memoryless(metal.family)
    facts.put(
        "image.memoryless_offered",
        offered if offered is not None else lazy_memory if isinstance(lazy_memory, bool) else None,
    )
    if target.samples is not None:
        supported = offers_count(target.samples, metal.family, metal.supportedSampleCounts)
        if supported is not None:
            facts.put("image.supported", supported, texture.place("sampleCount"))
            facts.put(
                "image.supported_samples", list(counts(metal.family, metal.supportedSampleCounts))
            )
    # Vulkan's flag is Metal's storage mode: where that is not stated, no usage says whether memory
    # is behind the texture.
    if texture.storageMode is None:
        facts.values.pop("image.transient", None)
        facts.put("image.transient", False if texture.drawable else None)
    for name in ("image.transient", "image.lazily_allocated", "image.memory"):
        facts.put(name, None, texture.place("storageMode"))
    facts.put("image.usage", None, texture.place("usage"))


def stated_for(attachment: Attachment, aspect: str | None, lowered: Lowered) -> Record | None:
    """The structure that states an aspect of an attachment; None of what is only resolved to, and
    of an aspect that is not attached.
    """
    stated = lowered.attachments.get(id(attachment.record), {})
    record = stated.get(aspect or "") or stated.get("color")
    # A format of the wrong kind, or an unknown one: there is one structure to be meant.
    return (
        record
        if record is not None or aspect in ("depth", "stencil")
        else next(iter(stated.values()), None)
    )


def filter_facts(facts: Facts, resolve: Resolve, lowered: Lowered) -> None:
    """Adds the filter that is stated for a resolve of depth or stencil."""
    record = (
        stated_for(resolve.source, resolve.aspect, lowered) if resolve.source is not None else None
    )
    if record is not None and resolve.aspect != "color":
        member = _filter(record)
        facts.put(
            "resolve.filter", getattr(record, member, None), record.place(member, "resolveTexture")
        )


def _filter(record: Record) -> str:
    return (
        "stencilResolveFilter"
        if isinstance(record, MetalStencilAttachment)
        else "depthResolveFilter"
    )


def action_facts(facts: Facts, attachment: Attachment, aspect: Aspect, lowered: Lowered) -> None:
    """Adds the actions of an attachment for one aspect, and what it is to be resolved to."""
    record = stated_for(attachment, aspect.name, lowered)
    if record is None:
        facts.put("aspect.has_resolve_texture", False)
        facts.put("aspect.resolves_by_action", False)
        return
    load, store, resolved_to = (
        getattr(record, member, None) for member in ("loadAction", "storeAction", "resolveTexture")
    )
    at = record.place("resolveTexture")
    facts.put("aspect.load_action", load, record.place("loadAction"))
    facts.put("aspect.store_action", store, record.place("storeAction"))
    facts.put("aspect.has_resolve_texture", resolved_to is not None, at)
    facts.put("aspect.resolve_texture", resolved_to, at)
    known = store is not None and store != "unknown"
    facts.put(
        "aspect.resolves_by_action",
        store in MULTISAMPLE_RESOLVES if known else None,
        record.place("storeAction"),
    )
    if isinstance(record, (MetalDepthAttachment, MetalStencilAttachment)):
        facts.put(
            "aspect.resolve_filter",
            getattr(record, _filter(record)),
            record.place(_filter(record), "resolveTexture"),
        )
    if resolved_to is not None and not known:
        facts.values.pop("aspect.resolved", None)
