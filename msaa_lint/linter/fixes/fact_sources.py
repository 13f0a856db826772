"""Where the facts that a fix may change are stated: one table."""

from __future__ import annotations

from collections.abc import Callable

from msaa_lint.frame.description.models import BeginRenderPass, Pipeline, SubpassDependency
from msaa_lint.frame.description.record import Record
from msaa_lint.frame.facts.facts import Subject
from msaa_lint.frame.facts.frame import RENDERING, Aspect, Attachment, Pass, Resolve, Target

from .changes import FixContext, Refused

Place = tuple[Record, str, str]
"""A record, its member, and the action there where it is not the page's own."""

Places = list[Place] | Refused


def places(fact: str, subject: Subject, mending: FixContext) -> Places:
    """The members that state a fact of a subject; why none can be changed, where none can."""
    if mending.document.metal is not None:
        from . import metal

        return metal.places(fact, subject, mending)
    find = CHANGEABLE.get(fact)
    return find(subject, mending) if find is not None else Refused("the fix is in Metal's words, and the frame in Vulkan's")


def targets_of(subject: Subject) -> list[Target]:
    """The images of a subject: several where they alternate from frame to frame."""
    of = subject.of
    if isinstance(of, Target):
        return [of]
    attachment = attachment_of(subject)
    return list({id(target.record): target for target in attachment.targets}.values()) if attachment is not None else []


def attachment_of(subject: Subject) -> Attachment | None:
    """The attachment that a subject is, or is an aspect of."""
    of = subject.of[0] if isinstance(subject.of, tuple) and subject.of else subject.of
    return of if isinstance(of, Attachment) else None


def _image(member: str) -> Callable[[Subject, FixContext], Places]:
    def find(subject: Subject, _: FixContext) -> Places:
        targets = targets_of(subject)
        if not targets or any(target.image is None for target in targets):
            return Refused("the image is not described")
        return [(target.record, member, "") for target in targets]

    return find


def _samples(subject: Subject, mending: FixContext) -> Places:
    """An image's count, and that of the attachments that it is bound to."""
    found: list[Place] = []
    for target in targets_of(subject):
        records = [target.record, *(attachment.record for attachment in mending.bindings.attachments.get(id(target.record), ()))]
        found += [(record, "samples", "") for record in records if record.states("samples")]
    return list(dict.fromkeys(found)) or Refused("no sample count is stated")


def _aspect(load: bool) -> Callable[[Subject, FixContext], Places]:
    def find(subject: Subject, _: FixContext) -> Places:
        attachment = attachment_of(subject)
        aspect = subject.of[1] if isinstance(subject.of, tuple) else None
        if attachment is None or not isinstance(aspect, Aspect):
            return Refused("it is not about one aspect of an attachment")
        return [(attachment.record, aspect.load_member if load else aspect.store_member, "")]

    return find


def _attachment(member: str) -> Callable[[Subject, FixContext], Places]:
    def find(subject: Subject, _: FixContext) -> Places:
        attachment = attachment_of(subject)
        if attachment is None or member not in attachment.record.SHAPE:
            return Refused("it is not about the attachment of a render pass")
        return [(attachment.record, member, "")]

    return find


def mode_place(resolve: Resolve) -> Place | None:
    """Where a resolve's mode is stated; None where Vulkan fixes it."""
    if resolve.kind == RENDERING:
        return (resolve.record, "resolveMode", "")
    member = {"depth": "depthResolveMode", "stencil": "stencilResolveMode"}.get(resolve.aspect, "")
    return (resolve.record, member, "") if member in resolve.record.SHAPE else None


def _mode(subject: Subject, _: FixContext) -> Places:
    place = mode_place(subject.of) if isinstance(subject.of, Resolve) else None
    return [place] if place is not None else Refused("Vulkan fixes the mode of this resolve")


def _multisample_state(member: str, dynamic: str, action: str = "") -> Callable[[Subject, FixContext], Places]:
    def find(subject: Subject, _: FixContext) -> Places:
        pipeline = subject.of[0] if isinstance(subject.of, tuple) else None
        state = pipeline.multisampleState if isinstance(pipeline, Pipeline) else None
        if state is None or dynamic in getattr(pipeline, "dynamicState", ()):
            return Refused("the pipeline does not state it")
        return [(state, member, action)]

    return find


def _first_blend(subject: Subject, _: FixContext) -> Places:
    pipeline = subject.of[0] if isinstance(subject.of, tuple) else None
    blend = pipeline.colorBlendState if isinstance(pipeline, Pipeline) else None
    if blend is None or not blend.attachments:
        return Refused("the pipeline does not state its blending")
    return [(blend.attachments[0], "blendEnable", "")]


def _dependency(member: str) -> Callable[[Subject, FixContext], Places]:
    def find(subject: Subject, _: FixContext) -> Places:
        if not isinstance(subject.of, SubpassDependency):
            return Refused("there is no dependency to change")
        return [(subject.of, member, "")]

    return find


def _clear_values(subject: Subject, mending: FixContext) -> Places:
    """The begins of a render pass that state how many clear values they give."""
    own = mending.frame.render_pass(subject.of.name) if isinstance(subject.of, Pass) else None
    bodies = [mending.frame.commands[position].body for position in own.begun] if own is not None else []
    found: list[Place] = [(b, "clearValueCount", "") for b in bodies if isinstance(b, BeginRenderPass) and b.clearValueCount is not None]
    return found or Refused("no begin states its clear values")


CHANGEABLE: dict[str, Callable[[Subject, FixContext], Places]] = {
    "image.samples": _samples,
    "image.usage": _image("usage"),
    "image.memory": _image("memory"),
    "image.flags": _image("flags"),
    "image.tiling": _image("tiling"),
    "image.type": _image("imageType"),
    "image.sharing_mode": _image("sharingMode"),
    "image.mip_levels": _image("mipLevels"),
    "pass.clear_values": _clear_values,
    "aspect.load": _aspect(True),
    "aspect.store": _aspect(False),
    "attachment.initial_layout": _attachment("initialLayout"),
    "attachment.final_layout": _attachment("finalLayout"),
    "resolve.mode": _mode,
    "pipeline.rasterization_samples": _multisample_state("rasterizationSamples", "RASTERIZATION_SAMPLES_EXT"),
    "pipeline.sample_shading": _multisample_state("sampleShadingEnable", ""),
    "pipeline.min_sample_shading": _multisample_state("minSampleShading", ""),
    "pipeline.alpha_to_coverage": _multisample_state("alphaToCoverageEnable", "ALPHA_TO_COVERAGE_ENABLE_EXT"),
    "pipeline.dropped_samples": _multisample_state("sampleMask", "SAMPLE_MASK_EXT", "unset"),
    "pipeline.blends_first": _first_blend,
    "dependency.stages": _dependency("srcStageMask"),
    "dependency.accesses": _dependency("srcAccessMask"),
}
"""By fact. `pipeline.dropped_samples` is set to 0 alone, which takes the mask away."""

ONLY: dict[str, tuple[object, ...]] = {"pipeline.dropped_samples": (0,), "pipeline.blends_first": (False,)}
"""The values that these facts can be given."""
