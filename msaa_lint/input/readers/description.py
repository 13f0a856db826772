"""The description format, version 1, in YAML or JSON."""

from __future__ import annotations

from collections.abc import Collection
from itertools import islice

from msaa_lint.core.quote import quoted, shortened
from msaa_lint.core.text.source import Source
from msaa_lint.core.text.span import Span
from msaa_lint.core.text.tree import Node
from msaa_lint.frame.description.bind import Binder
from msaa_lint.frame.description.document import Document
from msaa_lint.frame.description.models import (
    AttachmentReference,
    BeginRendering,
    BeginRenderPass,
    Description,
    Device,
    Framebuffer,
    RenderPass,
    Subpass,
)
from msaa_lint.frame.description.problems import Problem, member_of

SECTIONS = frozenset(Description.SHAPE)


def claims(root: Node) -> bool:
    """Whether a document looks like a description: a mapping with a section of the format."""
    return root.kind == "mapping" and not SECTIONS.isdisjoint(root.value)


def read(source: Source, root: Node) -> Document:
    """Reads a description as a document; its errors are the document's `problems`."""
    binder = Binder()
    if root.kind == "mapping":
        description: Description = binder.record(
            Description, root, "", "", Span(root.start, root.start)
        )
    else:
        description = binder.record(Description, root, "", "", root.span)
    if (
        not any(map(description.states, SECTIONS))
        and root.kind == "mapping"
        and _is_device_report(source.text)
    ):
        message = (
            "this is a device report, not a frame; use it with `--profile FILE`, or name it "
            "as the `device` of a description"
        )
        return Document(
            source, description, (Problem("MSAA901", message, Span(root.start, root.start), ""),)
        )
    if description.states("renderTargets"):
        return _of_render_targets(source, description, binder)
    check_names(binder, description)
    _name_begun_passes(description)
    if description.commands and source.origins is None:
        from .command_order import check_order

        check_order(binder, description)
    if description.metal is None:
        return Document(
            source, description, tuple(binder.problems), complete=not forget_unread(description)
        )
    from . import metal

    metal.check(binder, description)
    lowered = None if binder.problems else metal.lower(description)
    return Document(source, description, tuple(binder.problems), metal=lowered)


def _is_device_report(text: str) -> bool:
    from msaa_lint.frame.devices import reports

    if len(text) > reports.MAX_BYTES:
        return False
    try:
        return bool(reports.read(text))
    except reports.NotAReport:
        return False


def _of_render_targets(source: Source, description: Description, binder: Binder) -> Document:
    """The expansion of a description's render targets; the description itself if it is invalid."""
    from msaa_lint.input.impeller import expansion

    expansion.check(binder, description)
    _device(binder, description)
    if binder.problems:
        return Document(source, description, tuple(binder.problems))
    tree = expansion.expand(description)
    return read(source, tree)._replace(tree=tree)


def forget_unread(description: Description) -> bool:
    """Makes unknown what structures of a pNext chain that were not read may add: usages and readers
    of their images.

    Returns whether one may name any image, so that what the commands do is not all known.
    """
    for image in description.images.values():
        if image.pNext:
            image.usage, image.mayBeRead = None, True
            image.spelled.pop("usage", None)
    bodies = (command.body for command in description.commands or () if command is not None)
    return any(isinstance(body, BeginRendering) and body.pNext for body in bodies)


def check_names(binder: Binder, description: Description) -> None:
    """Reports dangling references: to entries of sections, attachments and subpasses."""
    for mention in binder.mentions:
        entries = _section(description, mention.section)
        if mention.name not in entries:
            message = (
                f"{member_of(mention.path)} names {quoted(mention.name)}, which is not in "
                f"`{mention.section}`"
            )
            _report_unknown(
                binder,
                message,
                mention.name,
                entries,
                mention.section,
                mention.node.span,
                mention.path,
            )
    _device(binder, description)
    for name, render_pass in description.renderPasses.items():
        _attachments(binder, name, render_pass)
    for framebuffer in description.framebuffers.values():
        _framebuffer(binder, framebuffer, description)
    for pipeline in description.pipelines.values():
        within = (
            description.renderPasses.get(pipeline.renderPass)
            if pipeline.renderPass is not None
            else None
        )
        if (
            within is not None
            and pipeline.subpass is not None
            and pipeline.subpass >= max(len(within.subpasses), 1)
        ):
            message = _no_subpass("subpass", f"{pipeline.renderPass}", pipeline.subpass, within)
            binder.report("MSAA904", message, pipeline.place("subpass"), f"{pipeline.path}.subpass")


def _name_begun_passes(description: Description) -> None:
    """Gives each beginRenderPass that names only framebuffers the render pass that they are created
    for.
    """
    for command in description.commands or ():
        body = command.body if command is not None else None
        if (
            isinstance(body, BeginRenderPass)
            and body.renderPass is None
            and body.framebuffer is not None
        ):
            names = (body.framebuffer,) if isinstance(body.framebuffer, str) else body.framebuffer
            framebuffers = (description.framebuffers.get(name) for name in names)
            body.renderPass = next(
                (each.renderPass for each in framebuffers if each is not None and each.renderPass),
                None,
            )


def _section(description: Description, name: str) -> dict[str, object]:
    """The entries of a section, which may be nested, such as `metal.textures`."""
    found: object = description
    for part in name.split("."):
        found = getattr(found, part)
    assert isinstance(found, dict)
    return found


def _report_unknown(
    binder: Binder,
    message: str,
    name: str,
    names: Collection[str],
    section: str,
    span: Span,
    path: str,
) -> None:
    """Reports a name that a section does not have, with the nearest one or the first few that it
    has.
    """
    hint = binder.suggestion(name, names)
    if not names:
        hint = f"; the description has no `{section}`"
    elif not hint:
        hint = (
            "; write one of "
            f"{', '.join(map(shortened, islice(names, 8)))}{', …' if len(names) > 8 else ''}"
        )
    binder.report("MSAA904", f"{message}{hint}", span, path)


def _device(binder: Binder, description: Description) -> None:
    """Checks `device`: a name must be a built-in profile unless it is a path, and a mapping's
    `tile` and `compression` must be valid.
    """
    if isinstance(description.device, Device):
        _cost_model(binder, description.device)
    if not isinstance(description.device, str):
        return
    from msaa_lint.frame.devices import builtin, names
    from msaa_lint.frame.devices.paths import is_path

    name = description.device
    if builtin(name) is not None or is_path(name):
        return
    hint = (
        binder.suggestion(name, names())
        or f"; write one of {', '.join(names())}, or the path of a device report"
    )
    binder.report(
        "MSAA904", f"unknown device {quoted(name)}{hint}", description.place("device"), "device"
    )


def _cost_model(binder: Binder, device: Device) -> None:
    if (device.tile is None and device.compression is None) or binder.problems:
        return
    from msaa_lint.frame.devices.tile_models import Misstated, stated_compression, stated_tile

    for member, found in (
        ("tile", stated_tile(device.tile)),
        ("compression", stated_compression(device.compression)),
    ):
        if isinstance(found, Misstated):
            stated = device.spelled[member][1]
            at = stated.value[found.key].span if found.key in stated.value else device.place(member)
            path = f"{device.path}.{member}" + (
                f".{shortened(found.key)}" if found.key is not None else ""
            )
            binder.report(
                "MSAA903",
                f"{found.message}; {found.help}" if found.help else found.message,
                at,
                path,
            )


def _attachments(binder: Binder, name: str, render_pass: RenderPass) -> None:
    """Checks the attachments and subpasses that a render pass refers to."""
    names = dict.fromkeys(
        attachment.key for attachment in render_pass.attachments if attachment is not None
    )
    count = len(render_pass.attachments)
    for subpass in render_pass.subpasses:
        colors = len(subpass.colorAttachments)
        # Unused entries beyond the color attachments resolve nothing.
        resolves = max(
            (
                n
                for n, reference in enumerate(subpass.resolveAttachments, 1)
                if reference.attachment is not None
            ),
            default=0,
        )
        if resolves > colors and subpass.states("colorAttachments") and not binder.dumped:
            message = (
                f"`resolveAttachments` has {_count(resolves, 'item')}, but "
                f"`colorAttachments` {colors}; list at most one for each"
            )
            binder.report(
                "MSAA903",
                message,
                subpass.place("resolveAttachments"),
                f"{subpass.path}.resolveAttachments",
            )
        for reference in _references(subpass, render_pass):
            attachment = reference.attachment
            if (
                attachment is None
                or (isinstance(attachment, int) and attachment < count)
                or attachment in names
            ):
                continue
            at = reference.place("attachment")
            if isinstance(attachment, int):
                has = f"render pass {quoted(name)} has {_indices(count, 'attachment')}"
                message = f"{member_of(reference.path)} is {attachment}, but {has}"
                binder.report("MSAA904", message, at, reference.path)
            else:
                message = (
                    f"{member_of(reference.path)} names {quoted(attachment)}, which is not "
                    f"an attachment of render pass {quoted(name)}"
                )
                _report_unknown(
                    binder,
                    message,
                    attachment,
                    names,
                    f"renderPasses.{name}.attachments",
                    at,
                    reference.path,
                )
    for dependency in render_pass.dependencies:
        for member in ("srcSubpass", "dstSubpass"):
            index = getattr(dependency, member)
            if isinstance(index, int) and index >= len(render_pass.subpasses):
                binder.report(
                    "MSAA904",
                    _no_subpass(member, name, index, render_pass),
                    dependency.place(member),
                    f"{dependency.path}.{member}",
                )


def _no_subpass(member: str, name: str, index: int, render_pass: RenderPass) -> str:
    return (
        f"`{member}` is {index}, but render pass {quoted(name)} has "
        f"{_indices(len(render_pass.subpasses), 'subpass')}"
    )


def _indices(number: int, noun: str) -> str:
    hint = f"; write 0 to {number - 1}" if number > 1 else "; write 0" if number else ""
    return f"{_count(number, noun)}, counted from 0{hint}"


def _count(number: int, noun: str) -> str:
    return f"{number} {noun}{'' if number == 1 else 'es' if noun.endswith('s') else 's'}"


def _references(subpass: Subpass, render_pass: RenderPass) -> list[AttachmentReference]:
    """Every attachment reference of a subpass, and with the first one those of the render pass
    itself.
    """
    found = [
        *subpass.inputAttachments,
        *subpass.colorAttachments,
        *subpass.resolveAttachments,
        *subpass.preserveAttachments,
    ]
    if subpass.depthStencilAttachment is not None:
        found.append(subpass.depthStencilAttachment)
    if subpass.fragmentShadingRateAttachment is not None:
        found.append(subpass.fragmentShadingRateAttachment)
    if render_pass.fragmentDensityMapAttachment is not None and subpass is render_pass.subpasses[0]:
        found.append(render_pass.fragmentDensityMapAttachment)
    if (
        subpass.depthStencilResolve is not None
        and subpass.depthStencilResolve.attachment is not None
    ):
        found.append(subpass.depthStencilResolve.attachment)
    return found


def _framebuffer(binder: Binder, framebuffer: Framebuffer, description: Description) -> None:
    """Checks that a framebuffer has as many attachments as its render pass."""
    within = (
        description.renderPasses.get(framebuffer.renderPass)
        if framebuffer.renderPass is not None
        else None
    )
    if within is None or "IMAGELESS" in framebuffer.flags or not framebuffer.states("attachments"):
        return
    expected, count = len(within.attachments), len(framebuffer.attachments)
    if expected != count:
        names = ", ".join(
            shortened(each.key) for each in within.attachments[:8] if each is not None
        )
        message = (
            f"`attachments` has {_count(count, 'image')}, but render pass "
            f"{quoted(framebuffer.renderPass or '')} has "
            f"{_count(expected, 'attachment')} ({names}{', …' if expected > 8 else ''}); list one "
            "image for each"
        )
        binder.report(
            "MSAA903", message, framebuffer.place("attachments"), f"{framebuffer.path}.attachments"
        )
