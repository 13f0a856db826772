"""Fixes of Metal descriptions: the members that state the facts that a fix may change, and the
fixes that rule pages name by `do`.
"""

from __future__ import annotations

from functools import partial

from msaa_lint.frame.description.models import MetalCopy, MetalTexture
from msaa_lint.frame.description.record import Record
from msaa_lint.frame.facts.facts import Subject
from msaa_lint.frame.facts.metal import stated_for
from msaa_lint.frame.facts.parts import Aspect, Attachment
from msaa_lint.frame.metal.names import KEEPING, MULTISAMPLE_RESOLVES

from .actions import Action
from .changes import Change, NoFix
from .context import FixContext
from .fact_sources import FindSources, Source
from .handovers import keep_on_tile
from .merges import merge_passes
from .subject_parts import (
    aspect_of,
    copied_images,
    described_image,
    images_of,
    pipeline_of,
    present,
)
from .transient import check_unread, drop_stores, is_needed

_VULKAN_USAGES = {"shaderRead": "SAMPLED", "shaderWrite": "STORAGE", "shaderAtomic": "STORAGE"}


def _texture_member(member: str, subject: Subject, context: FixContext) -> list[Source]:
    textures = context.metal.textures
    names = [target.name for target in images_of(subject) if target.image is not None]
    sources: list[Source] = [(textures[name], member) for name in names if name in textures]
    if not sources:
        raise NoFix("the description does not declare the texture")
    return sources


def _attachment_member(
    members: tuple[str, ...], subject: Subject, context: FixContext
) -> list[Source]:
    """The first of the members that exists for the attachment."""
    record = _attachment_record(subject, context)
    sources: list[Source] = [(record, member) for member in members if member in record.SHAPE]
    if not sources:
        raise NoFix(f"the attachment has no `{members[0]}`")
    return sources[:1]


def _attachment_record(subject: Subject, context: FixContext) -> Record:
    """The record of an aspect, or of the source of a resolve."""
    if subject.resolve is not None:
        source, aspect_name = subject.resolve.source, subject.resolve.aspect
        record = stated_for(source, aspect_name, context.lowered) if source is not None else None
    else:
        attachment, aspect = aspect_of(subject)
        record = stated_for(attachment, aspect.name, context.lowered)
    return present(record, "the description does not state the attachment")


def _pipeline_member(names: tuple[str, ...], subject: Subject, context: FixContext) -> list[Source]:
    """A property of a pipeline, by the name that the description uses, or by the first name if the
    property is not stated.
    """
    record = present(
        context.metal.renderPipelines.get(pipeline_of(subject).key),
        "the description does not declare the pipeline",
    )
    return [(record, next((name for name in names if record.states(name)), names[0]))]


METAL_FACT_SOURCES: dict[str, FindSources] = {
    "image.storage_mode": partial(_texture_member, "storageMode"),
    "image.texture_type": partial(_texture_member, "textureType"),
    "image.usage_words": partial(_texture_member, "usage"),
    "image.samples": partial(_texture_member, "sampleCount"),
    "image.mip_levels": partial(_texture_member, "mipmapLevelCount"),
    "aspect.load_action": partial(_attachment_member, ("loadAction",)),
    "aspect.store_action": partial(_attachment_member, ("storeAction",)),
    "aspect.resolve_filter": partial(
        _attachment_member, ("depthResolveFilter", "stencilResolveFilter")
    ),
    "resolve.filter": partial(_attachment_member, ("depthResolveFilter", "stencilResolveFilter")),
    "pipeline.rasterization_samples": partial(
        _pipeline_member, ("rasterSampleCount", "sampleCount")
    ),
    "pipeline.alpha_to_coverage": partial(
        _pipeline_member, ("isAlphaToCoverageEnabled", "alphaToCoverageEnabled")
    ),
}
"""By fact."""


def make_memoryless(subject: Subject, context: FixContext) -> list[Change]:
    """Makes storage memoryless and drops the usages that nothing needs and the stores that nothing
    reads.
    """
    image = described_image(subject)
    texture = present(
        context.metal.textures.get(image.key), "the description does not declare the texture"
    )
    check_unread(subject)
    if texture.drawable:
        raise NoFix("the texture is a drawable")
    if subject.facts.values.get("image.memoryless_offered") is False:
        raise NoFix("the GPU does not support memoryless textures")
    return [
        *_render_target_usage(texture, context),
        Change(texture, "storageMode", "set", "memoryless"),
        *drop_stores(image, context, partial(_dont_store, context)),
    ]


def _render_target_usage(texture: MetalTexture, context: FixContext) -> list[Change]:
    """Reduces the usage of a texture to renderTarget. Raises NoFix if a command may need another
    usage.
    """
    changes: list[Change] = []
    for usage in texture.usage or ():
        if usage == "renderTarget":
            continue
        if usage != "unknown" and is_needed(_VULKAN_USAGES.get(usage), texture.key, context):
            raise NoFix(f"`{texture.key}` may need its usage {usage}")
        changes.append(Change(texture, "usage", "remove", usage))
    if texture.usage is not None and "renderTarget" not in texture.usage:
        changes.append(Change(texture, "usage", "add", "renderTarget"))
    return changes


def _dont_store(context: FixContext, attachment: Attachment, aspect: Aspect) -> Change | None:
    if attachment.resolve:
        raise NoFix("a pass resolves to the texture")
    record = stated_for(attachment, aspect.name, context.lowered)
    action = getattr(record, "storeAction", None)
    if record is None or action not in KEEPING:
        return None
    return Change(
        record,
        "storeAction",
        "set",
        "multisampleResolve" if action in MULTISAMPLE_RESOLVES else "dontCare",
    )


def drop_resolve_texture(subject: Subject, context: FixContext) -> list[Change]:
    """Removes a resolve texture that no store action resolves to."""
    record = _attachment_record(subject, context)
    action = getattr(record, "storeAction", None)
    if not record.states("resolveTexture"):
        raise NoFix("the attachment has no resolve texture")
    if action in MULTISAMPLE_RESOLVES or action in (None, "unknown"):
        raise NoFix("the pass resolves to the texture, or may do so")
    return [Change(record, "resolveTexture", "unset")]


def resolve_to_copy(subject: Subject, context: FixContext) -> list[Change]:
    """Resolves to the texture that the result is copied to, and removes the copy and, if nothing
    else uses it, the texture in between.
    """
    metal, record = context.metal, _attachment_record(subject, context)
    between, target = copied_images(subject)
    if between not in metal.textures or target not in metal.textures:
        raise NoFix("the description does not declare both textures of the copy")
    copies = [
        copy
        for copy in context.references.records(between)
        if isinstance(copy, MetalCopy) and (copy.source, copy.destination) == (between, target)
    ]
    if len(copies) != 1:
        raise NoFix("the texture is copied more than once")
    position = next(
        n
        for n, command in enumerate(metal.commands or ())
        if command is not None and command.body is copies[0]
    )
    texture = metal.textures[target]
    changes = [
        Change(record, "resolveTexture", "set", target),
        Change(metal, "commands", "drop", position),
    ]
    if (
        texture.usage is not None
        and "renderTarget" not in texture.usage
        and "unknown" not in texture.usage
    ):
        changes.append(Change(texture, "usage", "add", "renderTarget"))
    if not context.references.has_others(between, [record, copies[0]]):
        changes.append(Change(metal, "textures", "drop", list(metal.textures).index(between)))
    return changes


METAL_ACTIONS: dict[str, Action] = {
    "make-memoryless": make_memoryless,
    "drop-resolve-texture": drop_resolve_texture,
    "resolve-to-copy": resolve_to_copy,
    "keep-on-tile": keep_on_tile,
    "merge-passes": merge_passes,
}
"""The fixes that rule pages name by `do`."""
