"""A pass where a command begins it: which images it has there, and whether it writes to all of them."""

from __future__ import annotations

from msaa_lint.frame.description.models import BeginRenderPass, Image
from msaa_lint.frame.description.record import Record

from .frame import Frame
from .parts import RENDER_PASS, RENDERING, Attachment, Pass, Target

MAX_USES = 500_000
"""How many uses of images by passes are followed. Some thousand passes have some ten thousand; hostile ones attachments times begins."""


def uses_at_most(frame: Frame) -> int:
    """A bound on how often passes use images: every attachment, each time its pass is begun, with every framebuffer."""
    begins: dict[str | None, int] = {}
    for _, body in frame.recorded(BeginRenderPass):
        count = len(body.framebuffer) if isinstance(body.framebuffer, tuple) else 1
        begins[body.renderPass] = begins.get(body.renderPass, 0) + max(count, 1)
    return sum(
        len(render_pass.attachments) * (1 if render_pass.kind == RENDERING else begins.get(render_pass.name, 1))
        for render_pass in frame.passes
    )


def targets_at(frame: Frame, attachment: Attachment, position: int | None) -> list[Target]:
    """The images of an attachment: several where framebuffers alternate from frame to frame, or where the one is not stated."""
    body = _body(frame, position)
    if not isinstance(body, BeginRenderPass) or body.framebuffer is None:
        return attachment.targets
    names = [f.attachments[attachment.index] if attachment.index < len(f.attachments) else None for f in frame.framebuffers_of(body)]
    targets = [frame.targets[name] for name in dict.fromkeys(names) if name in frame.targets]
    return targets if targets and None not in names else attachment.targets


def one_surface(image: Image | None) -> bool:
    """Whether an image is stated, and has one mip level and one layer: a command that names no part of it means all of it."""
    return image is not None and (image.mipLevels or 1) == 1 and (image.arrayLayers or 1) == 1


def covers(frame: Frame, render_pass: Pass, position: int | None, target: Target) -> bool:
    """Whether it writes to all of an image, unless attachments are left out: no size, layer or mip level that is stated denies it."""
    image = target.image
    if image is None or (image.mipLevels or 1) > 1 or (image.extent is not None and (image.extent.depth or 1) > 1):
        return False
    record = _body(frame, position) or render_pass.record
    framebuffers = frame.framebuffers_of(record) or (
        frame.framebuffers.get(render_pass.name, []) if render_pass.kind == RENDER_PASS else []
    )
    if image.arrayLayers is not None and image.arrayLayers > 1:
        views = [subpass.record.viewMask.bit_count() for subpass in render_pass.subpasses if subpass.record.viewMask]
        layers: list[int | None] = [*views] or [b.layers for b in framebuffers] or [getattr(record, "layerCount", None)]
        if any(count is None or count < image.arrayLayers for count in layers):
            return False
    area = getattr(record, "renderArea", None)
    if image.extent is None:
        return frame.partial(record, render_pass) is False
    for side in ("width", "height"):
        whole: int | None = getattr(image.extent, side)
        drawn: list[int | None] = [getattr(part, side) for part in (*framebuffers, area) if part is not None]
        if whole is not None and any(part is not None and part < whole for part in drawn):
            return False
    return area is None or not (area.x or area.y)


def _body(frame: Frame, position: int | None) -> Record | None:
    body = frame.commands[position].body if position is not None else None
    return body if isinstance(body, Record) else None
