"""The description format, version 1, in YAML or JSON."""

from __future__ import annotations

from msaa_lint.core.suggestions import nearest
from msaa_lint.core.text.source import Source
from msaa_lint.core.text.span import Span
from msaa_lint.core.text.tree import Node
from msaa_lint.frame.description.bind import Binder, Mention, shortened
from msaa_lint.frame.description.document import Document
from msaa_lint.frame.description.models import AttachmentReference, Description, Device, Framebuffer, RenderPass, Subpass

SECTIONS = frozenset(Description.SHAPE)


def claims(root: Node) -> bool:
    """Whether a document looks like a description: a mapping with a section of the format."""
    return root.kind == "mapping" and not SECTIONS.isdisjoint(root.value)


def read(source: Source, root: Node) -> Document:
    """Reads a description as a document; its errors are the document's `problems`."""
    binder = Binder()
    if root.kind == "mapping":
        description: Description = binder.record(Description, root, "", "", Span(root.start, root.start))
    else:
        description = binder.record(Description, root, "", "", root.span)
    if description.states("renderTargets"):
        return _of_render_targets(source, description, binder)
    check_names(binder, description)
    if description.metal is not None:
        return _of_metal(source, description, binder)
    return Document(source, description, tuple(binder.problems))


def _of_metal(source: Source, description: Description, binder: Binder) -> Document:
    """A Metal frame, with the equivalent Vulkan records if it is valid."""
    from . import metal

    metal.check(binder, description)
    if binder.problems:
        return Document(source, description, tuple(binder.problems))
    return Document(source, description, (), metal=metal.lower(description))


def _of_render_targets(source: Source, description: Description, binder: Binder) -> Document:
    """The expansion of a description's render targets; the description itself if it is invalid."""
    from msaa_lint.input.impeller import expansion

    expansion.check(binder, description)
    _device(binder, description)
    if binder.problems:
        return Document(source, description, tuple(binder.problems))
    tree = expansion.expand(description)
    return read(source, tree)._replace(tree=tree)


def check_names(binder: Binder, description: Description) -> None:
    """Reports dangling references: to entries of sections, attachments and subpasses."""
    for mention in binder.mentions:
        entries = _section(description, mention.section)
        if mention.name not in entries:
            _dangling(binder, mention, entries)
    _device(binder, description)
    for name, render_pass in description.renderPasses.items():
        _attachments(binder, name, render_pass)
    for framebuffer in description.framebuffers.values():
        _framebuffer(binder, framebuffer, description)
    for pipeline in description.pipelines.values():
        within = description.renderPasses.get(pipeline.renderPass) if pipeline.renderPass is not None else None
        if within is not None and pipeline.subpass is not None and pipeline.subpass >= max(len(within.subpasses), 1):
            message = f"`{pipeline.renderPass}` has {_subpasses(within)}, no subpass {pipeline.subpass}"
            binder.report("MSAA904", message, pipeline.place("subpass"), f"{pipeline.path}.subpass")


def _section(description: Description, name: str) -> dict[str, object]:
    """The entries of a section, which may be nested, such as `metal.textures`."""
    found: object = description
    for part in name.split("."):
        found = getattr(found, part)
    assert isinstance(found, dict)
    return found


def _dangling(binder: Binder, mention: Mention, entries: dict[str, object]) -> None:
    close = nearest(mention.name, entries)
    help = f"did you mean `{close}`?" if close else _has(mention.section, entries)
    binder.report("MSAA904", f"no `{mention.name}` in `{mention.section}`", mention.node.span, mention.path, help)


def _has(section: str, entries: dict[str, object]) -> str:
    names = list(entries)
    if not names:
        return f"the description has no `{section}`"
    return f"`{section}` has {', '.join(names[:8])}{', …' if len(names) > 8 else ''}"


def _device(binder: Binder, description: Description) -> None:
    """Checks `device`: a name must be a built-in profile unless it is a path, and a mapping's `tile` and `compression` must be valid."""
    if isinstance(description.device, Device):
        _cost_model(binder, description.device)
    if not isinstance(description.device, str):
        return
    from msaa_lint.frame.devices import builtin, names
    from msaa_lint.frame.devices.paths import is_path

    name = description.device
    if builtin(name) is not None or is_path(name):
        return
    close = nearest(name, names())
    help = f"did you mean `{close}`?" if close else f"built-in devices: {', '.join(names())}"
    binder.report("MSAA904", f"no device `{name}`", description.place("device"), "device", help)


def _cost_model(binder: Binder, device: Device) -> None:
    if (device.tile is None and device.compression is None) or binder.problems:
        return
    from msaa_lint.frame.devices.tile_models import Misstated, stated_compression, stated_tile

    tile = stated_tile(device.tile) if device.tile is not None else None
    compression = stated_compression(device.compression) if device.compression is not None else None
    for member, found in (("tile", tile), ("compression", compression)):
        if isinstance(found, Misstated):
            stated = device.spelled[member][1]
            at = stated.value[found.key].span if found.key in stated.value else device.place(member)
            path = f"{device.path}.{member}" + (f".{shortened(found.key)}" if found.key is not None else "")
            binder.report("MSAA903", found.message, at, path, found.help)


def _attachments(binder: Binder, name: str, render_pass: RenderPass) -> None:
    by_name = {attachment.key for attachment in render_pass.attachments if attachment is not None}
    count = len(render_pass.attachments)
    for subpass in render_pass.subpasses:
        for reference in _references(subpass):
            stated = reference.attachment
            if stated is None or (isinstance(stated, int) and stated < count) or stated in by_name:
                continue
            if isinstance(stated, int):
                help = f"it has {count}, counted from 0"
            else:
                close = nearest(stated, by_name)
                help = f"did you mean `{close}`?" if close else _has(f"renderPasses.{name}.attachments", dict.fromkeys(by_name))
            at = reference.place("attachment")
            binder.report("MSAA904", f"no attachment `{stated}` in render pass `{name}`", at, reference.path, help)
    for dependency in render_pass.dependencies:
        for member in ("srcSubpass", "dstSubpass"):
            index = getattr(dependency, member)
            if isinstance(index, int) and index >= len(render_pass.subpasses):
                message = f"`{name}` has {_subpasses(render_pass)}, no subpass {index}"
                binder.report("MSAA904", message, dependency.place(member), f"{dependency.path}.{member}")


def _subpasses(render_pass: RenderPass) -> str:
    count = len(render_pass.subpasses)
    return f"{count} subpass{'es' if count != 1 else ''}"


def _references(subpass: Subpass) -> list[AttachmentReference]:
    found = [*subpass.inputAttachments, *subpass.colorAttachments, *subpass.resolveAttachments, *subpass.preserveAttachments]
    if subpass.depthStencilAttachment is not None:
        found.append(subpass.depthStencilAttachment)
    if subpass.depthStencilResolve is not None and subpass.depthStencilResolve.attachment is not None:
        found.append(subpass.depthStencilResolve.attachment)
    return found


def _framebuffer(binder: Binder, framebuffer: Framebuffer, description: Description) -> None:
    within = description.renderPasses.get(framebuffer.renderPass) if framebuffer.renderPass is not None else None
    if within is None or "IMAGELESS" in framebuffer.flags or not framebuffer.states("attachments"):
        return
    wanted, given = len(within.attachments), len(framebuffer.attachments)
    if wanted != given:
        message = f"`{framebuffer.renderPass}` has {wanted} attachments, this framebuffer {given}"
        binder.report("MSAA903", message, framebuffer.place("attachments"), f"{framebuffer.path}.attachments")
