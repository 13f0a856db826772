"""`do: hand-over-depth`: the pass resolves the depth that it draws, and readers use the result
instead of the samples.
"""

from __future__ import annotations

from msaa_lint.frame.description.models import Image, ReadImage, RenderPass, Subpass
from msaa_lint.frame.facts.facts import Subject
from msaa_lint.frame.facts.image import BESIDE_TRANSIENT
from msaa_lint.frame.facts.parts import Aspect, Attachment, Pass

from .changes import Change, NoFix
from .context import FixContext
from .resolve_targets import new_attachment, new_image, rendering_resolve, unused_name
from .subject_parts import aspect_of
from .transient import lazy_memory

_MODE = "SAMPLE_ZERO"
"""The mode that every device supports."""


def resolve_depth(subject: Subject, context: FixContext) -> list[Change]:
    """Resolves depth to an image with one sample, which readers then use, and does not store the
    samples.
    """
    attachment, aspect = aspect_of(subject)
    source = attachment.target.image if attachment.target is not None else None
    uses = context.attachments.get(id(source), [])
    if source is None or attachment.format is None or len(uses) != 1:
        raise NoFix(
            "the description does not declare the image, or more than one attachment uses it"
        )
    render_pass, attachment_in_pass = uses[0]
    if not attachment_in_pass.depth_stencil or not render_pass.subpasses:
        raise NoFix("no subpass draws to the image")
    changes: list[Change] = []
    name = _existing_result(render_pass, attachment_in_pass, aspect)
    if name is None:
        images = context.document.description.images
        name = unused_name(f"{source.key}_resolved", images)
        changes.append(
            new_image(
                name,
                source,
                attachment.format.name,
                ["DEPTH_STENCIL_ATTACHMENT", "SAMPLED"],
                context,
            )
        )
        changes += _depth_resolve(name, render_pass, attachment_in_pass, context)
    changes.append(Change(attachment.record, aspect.store_member, "set", "DONT_CARE"))
    for reader in context.references.records(source.key):
        if isinstance(reader, ReadImage):
            changes.append(Change(reader, "image", "set", name))
            changes += [Change(reader, "samples", "unset")] if reader.states("samples") else []
    return [*changes, *_transient(source, attachment_in_pass, aspect, subject)]


def _existing_result(render_pass: Pass, attachment: Attachment, aspect: Aspect) -> str | None:
    """The image that the pass already resolves the aspect to."""
    for subpass in render_pass.subpasses:
        for resolve in subpass.resolves:
            resolves = (
                resolve.source is attachment
                and resolve.aspect == aspect.name
                and resolve.mode not in (None, "NONE")
            )
            if (
                resolves
                and resolve.target_image is not None
                and resolve.target_image.image is not None
            ):
                return resolve.target_image.name
    return None


def _depth_resolve(
    name: str, render_pass: Pass, attachment: Attachment, context: FixContext
) -> list[Change]:
    """Resolves depth to an image that the pass does not use yet."""
    pass_record, record = render_pass.record, attachment.record
    if not isinstance(pass_record, RenderPass):
        return rendering_resolve(record, _MODE, name)
    subpass = render_pass.subpasses[max(attachment.depth_stencil)].record
    if not isinstance(subpass, Subpass) or subpass.depthStencilResolve is not None:
        raise NoFix("the pass already resolves the attachment to another image")
    changes, reference = new_attachment(
        pass_record, name, attachment, "DEPTH_STENCIL_READ_ONLY_OPTIMAL", context
    )
    resolve = {"attachment": reference, "depthResolveMode": _MODE, "stencilResolveMode": "NONE"}
    return [*changes, Change(subpass, "depthStencilResolve", "set", resolve)]


def _transient(
    source: Image, attachment: Attachment, aspect: Aspect, subject: Subject
) -> list[Change]:
    """Makes the multisampled image transient if only its readers prevented that."""
    others = [other for other in attachment.aspects if other.name != aspect.name]
    if (
        source.usage is None
        or set(source.usage) - BESIDE_TRANSIENT != {"SAMPLED"}
        or aspect.load != "CLEAR"
    ):
        return []
    if any(other.load == "LOAD" or other.store != "DONT_CARE" for other in others):
        return []
    usage = [
        Change(source, "usage", "remove", "SAMPLED"),
        Change(source, "usage", "add", "TRANSIENT_ATTACHMENT"),
    ]
    return [*usage, *lazy_memory(source, subject)]
