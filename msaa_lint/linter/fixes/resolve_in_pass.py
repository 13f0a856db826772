"""`do: resolve-in-pass` and `do: resolve-before-read`: the pass that draws the samples resolves
them.

The first replaces a vkCmdResolveImage. The second replaces a shader that averages the samples it
reads: the shader reads an image with one sample instead and has to be rewritten for it, so that
this fix is only shown and priced. Both refuse a frame in which other uses come in between, or
framebuffers, sizes or formats are ambiguous.
"""

from __future__ import annotations

from typing import NamedTuple

from msaa_lint.frame.description.models import Command, Image, ReadImage, RenderPass, Subpass
from msaa_lint.frame.facts.facts import Subject
from msaa_lint.frame.facts.parts import RENDERING, Attachment, Pass, Target
from msaa_lint.frame.facts.pass_begin import targets_at

from .changes import Change, NoFix
from .context import FixContext
from .resolve_barriers import moved_barriers
from .resolve_targets import (
    new_attachment,
    new_image,
    next_use,
    rendering_resolve,
    target_usage,
    unused_name,
)
from .subject_parts import present, read_of, resolve_of
from .transient import lazy_memory, transient_usage

MAX_ATTACHMENTS = 64
"""The most attachments of a pass. No device supports more."""

_MULTISAMPLED_SUFFIXES = ("_multisampled", "_msaa", "_ms", "MSAA", "Ms", "MS")
_FINAL_LAYOUTS = {"present": "PRESENT_SRC_KHR", "readImage": "SHADER_READ_ONLY_OPTIMAL"}


class DrawnSamples(NamedTuple):
    """A command that reads the samples of an image, and the pass before it that drew them."""

    command: Command
    position: int
    render_pass: Pass
    attachment: Attachment
    image: Image
    begin: int


def resolve_in_pass(subject: Subject, context: FixContext) -> list[Change]:
    """Moves the resolve of a vkCmdResolveImage into the pass."""
    resolve, uses = resolve_of(subject), context.uses
    if resolve.aspect != "color":
        raise NoFix("the mode of a depth resolve has to be chosen")
    position = present(
        uses.positions.get(id(resolve.record)), "the frame has more commands than are analyzed"
    )
    images = (resolve.source_image, resolve.target_image)
    source, target = (
        context.frame.target(image.name) if image is not None else None for image in images
    )
    if source is None or source.image is None or target is None or target.image is None:
        raise NoFix("the description does not declare both images of the resolve")
    if (
        (source.samples or 0) < 2
        or target.samples != 1
        or source.format is None
        or source.format != target.format
    ):
        raise NoFix("the sample counts and formats do not show that a pass can resolve the image")
    drawing = _find_drawing(source, position, context)
    if uses.used_between(target.name, drawing.begin, position):
        raise NoFix("other commands use the images between the pass and the resolve")
    barriers, takes_over = moved_barriers(
        source.name, target.name, drawing.begin, position, drawing.render_pass, context
    )
    mode = "SAMPLE_ZERO" if source.format.numeric in ("UINT", "SINT") else "AVERAGE"
    next_layout = _FINAL_LAYOUTS.get(next_use(target.image, position, context, barriers=False))
    final_layout = "COLOR_ATTACHMENT_OPTIMAL" if takes_over else next_layout
    changes = _color_resolve(drawing, target.name, mode, final_layout, context)
    if _has_other_readers(drawing, context):
        if source.image.usage is not None and "TRANSFER_SRC" not in uses.needed_usages(
            source.name, drawing.command
        ):
            changes.append(Change(source.image, "usage", "remove", "TRANSFER_SRC"))
    else:
        changes += _without_reader(drawing, "TRANSFER_SRC_OPTIMAL", subject, context)
    return [
        *changes,
        *barriers,
        *target_usage(target.image, drawing.command, context),
        context.drop_command(position),
    ]


def resolve_before_read(subject: Subject, context: FixContext) -> list[Change]:
    """Resolves in the pass to a new image, which the shader then reads."""
    position, name = read_of(subject)
    source = context.frame.target(name)
    if source is None or source.image is None:
        raise NoFix("the description does not declare the image")
    if (source.samples or 0) < 2 or source.format is None or "color" not in source.format.aspects:
        raise NoFix("the sample count and format do not show how a pass can resolve the image")
    drawing = _find_drawing(source, position, context)
    images = context.document.description.images
    short = next(
        (
            source.name.removesuffix(suffix)
            for suffix in _MULTISAMPLED_SUFFIXES
            if source.name.endswith(suffix)
        ),
        "",
    )
    name = (
        short if short and short not in images else unused_name(f"{source.name}_resolved", images)
    )
    usage = ["COLOR_ATTACHMENT", "SAMPLED"] if source.image.usage is not None else None
    changes = [new_image(name, source.image, source.format.name, usage, context)]
    changes += _color_resolve(drawing, name, "AVERAGE", "SHADER_READ_ONLY_OPTIMAL", context)
    if not _has_other_readers(drawing, context):
        changes += _without_reader(drawing, "SHADER_READ_ONLY_OPTIMAL", subject, context)
    body = drawing.command.body
    assert isinstance(body, ReadImage)
    changes.append(Change(body, "image", "set", name))
    if body.states("samples"):
        changes.append(Change(body, "samples", "set", 1))
    if body.states("resolves"):
        changes.append(Change(body, "resolves", "unset"))
    return changes


def _find_drawing(source: Target, position: int, context: FixContext) -> DrawnSamples:
    """The last pass before a position that draws to an image. Raises NoFix if the image is not a
    plain color attachment of it.
    """
    frame = context.frame
    begin, render_pass = context.analysis.timeline.last_writer(source, position) or (0, None)
    if (
        render_pass is None
        or begin >= position
        or len(render_pass.begun) != 1
        or render_pass.custom_resolve
        or _suspends(render_pass)
    ):
        raise NoFix(
            "the pass that draws the image does not run exactly once, right before the command"
        )
    if len(render_pass.attachments) > MAX_ATTACHMENTS:
        raise NoFix(f"the pass has more than {MAX_ATTACHMENTS} attachments")
    attachments = [
        attachment
        for attachment in render_pass.attachments
        if any(target.record is source.record for target in targets_at(frame, attachment, begin))
    ]
    if (
        len(attachments) != 1
        or attachments[0].target is None
        or not attachments[0].color
        or attachments[0].input
    ):
        raise NoFix(
            "the image is not bound to exactly one color attachment of the pass, or is also an "
            "input attachment"
        )
    assert source.image is not None
    return DrawnSamples(
        frame.commands[position], position, render_pass, attachments[0], source.image, begin
    )


def _suspends(render_pass: Pass) -> bool:
    return render_pass.kind == RENDERING and not {"SUSPENDING", "RESUMING"}.isdisjoint(
        getattr(render_pass.record, "flags", ())
    )


def _color_resolve(
    drawing: DrawnSamples, name: str, mode: str, final_layout: str | None, context: FixContext
) -> list[Change]:
    """Resolves a color attachment to the image `name` at the end of its pass.

    A render pass gets a new attachment, which its last subpass refers to at the index of the color
    attachment.
    """
    attachment, record = drawing.attachment, drawing.render_pass.record
    if drawing.render_pass.kind == RENDERING:
        return rendering_resolve(attachment.record, mode, name, "COLOR_ATTACHMENT_OPTIMAL")
    subpass = drawing.render_pass.subpasses[max(attachment.color)]
    if (
        not isinstance(record, RenderPass)
        or not isinstance(subpass.record, Subpass)
        or subpass.color.count(attachment) != 1
    ):
        raise NoFix("the subpass uses the attachment for more than one color output")
    changes, reference = new_attachment(record, name, attachment, final_layout, context)
    index, resolves = subpass.color.index(attachment), subpass.record.resolveAttachments
    if index < len(resolves):
        if resolves[index].attachment is not None or resolves[index].node.kind != "scalar":
            raise NoFix("the pass already resolves the attachment to another image")
        return [
            *changes,
            Change(subpass.record, "resolveAttachments", "replace", (index, reference)),
        ]
    references = [*(None for _ in range(len(resolves), index)), reference]
    return [
        *changes,
        *(Change(subpass.record, "resolveAttachments", "append", item) for item in references),
    ]


def _has_other_readers(drawing: DrawnSamples, context: FixContext) -> bool:
    """Whether anything other than the command may read the samples."""
    readers = context.analysis.readers
    if not readers.timeline.followed or readers.frame.may_be_read(drawing.image.key):
        return True
    return any(event.position != drawing.position for event in readers.reads(drawing.image.key))


def _without_reader(
    drawing: DrawnSamples, read_layout: str, subject: Subject, context: FixContext
) -> list[Change]:
    """Without the command that reads them, the samples are not stored and take no memory."""
    record = drawing.attachment.record
    changes = [Change(record, "storeOp", "set", "DONT_CARE")] if record.storeOp == "STORE" else []
    if getattr(record, "finalLayout", None) == read_layout:
        changes.append(Change(record, "finalLayout", "set", "COLOR_ATTACHMENT_OPTIMAL"))
    if drawing.image.usage is None:
        return changes
    return [
        *changes,
        *transient_usage(drawing.image, context, drawing.command),
        *lazy_memory(drawing.image, subject),
    ]
