"""A pass where a command begins it: which images it has there, and whether it writes to all of
them.
"""

from typing import NamedTuple

from msaa_lint.frame.description.models import BeginRenderPass, Image
from msaa_lint.frame.description.record import Record

from .frame import Frame
from .parts import RENDER_PASS, RENDERING, Attachment, Pass, Target

MIN_USES = 50_000
USES_PER_STRUCTURE = 32
"""How many uses of images by passes are followed: so many, and more by the structures of a
frame. Some thousand passes have some ten thousand uses; hostile ones as many as attachments
times begins.
"""


def max_uses(frame: Frame) -> int:
    """How many uses of images by the passes of a frame are followed."""
    return MIN_USES + USES_PER_STRUCTURE * frame.structures


def uses_at_most(frame: Frame) -> int:
    """A bound on how often passes use images: every attachment and reference to one, with every
    framebuffer that its pass is begun with.
    """
    begins: dict[str | None, int] = {}
    for _, body in frame.recorded(BeginRenderPass):
        count = len(body.framebuffer) if isinstance(body.framebuffer, tuple) else 1
        begins[body.renderPass] = begins.get(body.renderPass, 0) + max(count, 1)
    return sum(
        render_pass.structures
        * (
            max(len(render_pass.begun), 1)
            if render_pass.kind == RENDERING
            else begins.get(render_pass.name, 1)
        )
        for render_pass in frame.passes
    )


def is_followed(frame: Frame) -> bool:
    """Whether the passes of a frame use images so seldom that it is followed who uses them when."""
    return uses_at_most(frame) <= max_uses(frame)


def targets_at(frame: Frame, attachment: Attachment, position: int | None) -> list[Target]:
    """The images of an attachment: several where framebuffers alternate from frame to frame, or
    where the one is not stated.
    """
    body = _body(frame, position)
    if not isinstance(body, BeginRenderPass) or body.framebuffer is None:
        return attachment.targets
    names = [
        f.attachments[attachment.index] if attachment.index < len(f.attachments) else None
        for f in frame.framebuffers_of(body)
    ]
    targets = [frame.targets[name] for name in dict.fromkeys(names) if name in frame.targets]
    return targets if targets and None not in names else attachment.targets


def one_surface(image: Image | None) -> bool:
    """Whether an image is stated, and has one mip level and one layer: a command that names no part
    of it means all of it.
    """
    return image is not None and (image.mipLevels or 1) == 1 and (image.arrayLayers or 1) == 1


class BegunArea(NamedTuple):
    """What a pass writes to where a command begins it: the fewest layers (None: not stated) and the
    smallest stated sides.

    `from_origin` is False where the render area begins elsewhere; `partial` says whether it is
    smaller than what the pass renders to.
    """

    layers: int | None
    width: int | None
    height: int | None
    from_origin: bool
    partial: bool | None

    def covers(self, target: Target) -> bool:
        """Whether it writes to all of an image, unless attachments are left out: no size, layer or
        mip level that is stated denies it.
        """
        image = target.image
        if (
            image is None
            or (image.mipLevels or 1) > 1
            or (image.extent is not None and (image.extent.depth or 1) > 1)
        ):
            return False
        if (
            image.arrayLayers is not None
            and image.arrayLayers > 1
            and (self.layers is None or self.layers < image.arrayLayers)
        ):
            return False
        if image.extent is None:
            return self.partial is False
        sides = ((self.width, image.extent.width), (self.height, image.extent.height))
        return self.from_origin and not any(
            own is not None and whole is not None and own < whole for own, whole in sides
        )


def begun_area(frame: Frame, render_pass: Pass, position: int | None) -> BegunArea:
    """The area of a pass where the command at a position begins it."""
    record = _body(frame, position) or render_pass.record
    framebuffers = frame.framebuffers_of(record) or (
        frame.framebuffers.get(render_pass.name, []) if render_pass.kind == RENDER_PASS else []
    )
    views = [
        subpass.record.viewMask.bit_count()
        for subpass in render_pass.subpasses
        if subpass.record.viewMask
    ]
    layers: list[int | None] = (
        [*views]
        or [buffer.layers for buffer in framebuffers]
        or [getattr(record, "layerCount", None)]
    )
    area = getattr(record, "renderArea", None)
    width, height = (
        min(
            (
                size
                for part in (*framebuffers, area)
                if part is not None and (size := getattr(part, side)) is not None
            ),
            default=None,
        )
        for side in ("width", "height")
    )
    return BegunArea(
        None if None in layers else min(count for count in layers if count is not None),
        width,
        height,
        area is None or not (area.x or area.y),
        frame.partial(record, render_pass),
    )


def _body(frame: Frame, position: int | None) -> Record | None:
    body = frame.commands[position].body if position is not None else None
    return body if isinstance(body, Record) else None
