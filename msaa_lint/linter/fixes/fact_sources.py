"""The members that state the facts that a fix may change, in Vulkan descriptions."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from msaa_lint.frame.description.models import BeginRenderPass
from msaa_lint.frame.description.record import Record
from msaa_lint.frame.facts.facts import Subject
from msaa_lint.frame.facts.missing_keys import resolve_mode

from .changes import NoFix
from .context import FixContext
from .subject_parts import aspect_of, attachment_of, images_of, pipeline_of, present, resolve_of

Source = tuple[Record, str]
"""A record and the member of it that states a fact."""

FindSources = Callable[[Subject, FixContext], list[Source]]
"""Finds the sources of a fact. Raises NoFix if nothing states it in a way that can be changed."""


def _image_member(member: str, subject: Subject, _: FixContext) -> list[Source]:
    images = images_of(subject)
    if not images or any(target.image is None for target in images):
        raise NoFix("the description does not declare the image")
    return [(target.record, member) for target in images]


def _samples(subject: Subject, context: FixContext) -> list[Source]:
    """The stated sample counts of an image and of the attachments that it is bound to."""
    sources: list[Source] = []
    for target in images_of(subject):
        bound = context.analysis.bindings.attachments.get(id(target.record), ())
        records = [target.record, *(attachment.record for attachment in bound)]
        sources += [(record, "samples") for record in records if record.states("samples")]
    if not sources:
        raise NoFix("the description does not state a sample count")
    return list(dict.fromkeys(sources))


def _operation(member: str, subject: Subject, _: FixContext) -> list[Source]:
    attachment, aspect = aspect_of(subject)
    return [(attachment.record, getattr(aspect, member))]


def _layout(member: str, subject: Subject, _: FixContext) -> list[Source]:
    record = attachment_of(subject).record
    if member not in record.SHAPE:
        raise NoFix(f"`{member}` exists only for attachments of render passes")
    return [(record, member)]


def _resolve_mode(subject: Subject, _: FixContext) -> list[Source]:
    return [
        present(resolve_mode(resolve_of(subject)), "Vulkan prescribes the mode of this resolve")
    ]


def _multisample_state(
    member: str, dynamic_state: str, subject: Subject, _: FixContext
) -> list[Source]:
    pipeline = pipeline_of(subject)
    if pipeline.multisampleState is None or dynamic_state in pipeline.dynamicState:
        raise NoFix(f"the pipeline does not state `{member}`")
    return [(pipeline.multisampleState, member)]


def _first_blend(subject: Subject, _: FixContext) -> list[Source]:
    blend = pipeline_of(subject).colorBlendState
    if blend is None or not blend.attachments:
        raise NoFix("the pipeline does not state its blending")
    return [(blend.attachments[0], "blendEnable")]


def _dependency_member(member: str, subject: Subject, _: FixContext) -> list[Source]:
    return [(present(subject.dependency, "the description does not state the dependency"), member)]


def _clear_values(subject: Subject, context: FixContext) -> list[Source]:
    """The clear value counts of the commands that begin a render pass."""
    begun = (
        context.frame.render_pass(subject.render_pass.name)
        if subject.render_pass is not None
        else None
    )
    bodies = (
        [context.frame.commands[position].body for position in begun.begun]
        if begun is not None
        else []
    )
    sources: list[Source] = [
        (body, "clearValueCount")
        for body in bodies
        if isinstance(body, BeginRenderPass) and body.clearValueCount is not None
    ]
    if not sources:
        raise NoFix("no command that begins the pass states `clearValueCount`")
    return sources


FACT_SOURCES: dict[str, FindSources] = {
    "image.samples": _samples,
    "image.usage": partial(_image_member, "usage"),
    "image.memory": partial(_image_member, "memory"),
    "image.flags": partial(_image_member, "flags"),
    "image.tiling": partial(_image_member, "tiling"),
    "image.type": partial(_image_member, "imageType"),
    "image.sharing_mode": partial(_image_member, "sharingMode"),
    "image.mip_levels": partial(_image_member, "mipLevels"),
    "pass.clear_values": _clear_values,
    "aspect.load": partial(_operation, "load_member"),
    "aspect.store": partial(_operation, "store_member"),
    "attachment.initial_layout": partial(_layout, "initialLayout"),
    "attachment.final_layout": partial(_layout, "finalLayout"),
    "resolve.mode": _resolve_mode,
    "pipeline.rasterization_samples": partial(
        _multisample_state, "rasterizationSamples", "RASTERIZATION_SAMPLES_EXT"
    ),
    "pipeline.sample_shading": partial(_multisample_state, "sampleShadingEnable", ""),
    "pipeline.min_sample_shading": partial(_multisample_state, "minSampleShading", ""),
    "pipeline.alpha_to_one": partial(
        _multisample_state, "alphaToOneEnable", "ALPHA_TO_ONE_ENABLE_EXT"
    ),
    "pipeline.alpha_to_coverage": partial(
        _multisample_state, "alphaToCoverageEnable", "ALPHA_TO_COVERAGE_ENABLE_EXT"
    ),
    "pipeline.dropped_samples": partial(_multisample_state, "sampleMask", "SAMPLE_MASK_EXT"),
    "pipeline.blends_first": _first_blend,
    "dependency.stages": partial(_dependency_member, "srcStageMask"),
    "dependency.accesses": partial(_dependency_member, "srcAccessMask"),
}
"""By fact."""

ONLY_VALUES: dict[str, tuple[object, ...]] = {
    "pipeline.dropped_samples": (0,),
    "pipeline.blends_first": (False,),
}
"""The values that a fix may set these facts to."""

SET_BY_UNSET = frozenset({"pipeline.dropped_samples"})
"""The facts that are set by removing the member: without a sample mask, no samples are dropped."""
