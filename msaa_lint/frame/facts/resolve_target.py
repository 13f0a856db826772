"""Facts of the image that a resolve in a pass writes: whether it is large enough, and what else of
its subpass uses it.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from msaa_lint.core.text.span import Span
from msaa_lint.frame.description.models import BeginRendering, BeginRenderPass, Framebuffer
from msaa_lint.frame.description.models.commands import Rect

from .facts import Facts
from .frame import Frame
from .parts import RENDER_PASS, Attachment, Pass, Resolve, Target
from .pass_begin import one_surface

Extent = tuple[int | None, int | None]

Use = tuple[str, Span]
"""What an image is used for, and where that is stated."""


class ResolveTargets:
    """What a frame says of the images that resolves in passes write."""

    def __init__(self, frame: Frame, followed: bool) -> None:
        self._frame = frame
        self._followed = followed
        """Whether the passes use images as seldom as is looked at."""
        self._framebuffers: dict[str | None, list[Framebuffer]] = {}
        for framebuffer in frame.description.framebuffers.values():
            self._framebuffers.setdefault(framebuffer.renderPass, []).append(framebuffer)
        self._of_attachments: dict[int, Facts] = {}

    def put(self, facts: Facts, resolve: Resolve, uses: dict[int, Use]) -> None:
        """Adds the facts of what a resolve writes. `uses` are those of `other_uses` of its pass."""
        use = uses.get(id(resolve))
        facts.put(
            "resolve.target_also",
            use[0] if use is not None else "NOTHING",
            use[1] if use is not None else resolve.target_at,
        )
        render_pass, attachment = resolve.render_pass, resolve.target
        if render_pass is None or not self._followed:
            return
        extents = Facts()
        if isinstance(render_pass.record, BeginRendering):
            area = render_pass.record.renderArea
            if resolve.target_image is not None and area is not None:
                _put_extents(extents, [(resolve.target_image, _end(area), area.head)])
        elif attachment is not None:
            if id(attachment) not in self._of_attachments:
                _put_extents(extents, self._required_extents(render_pass, attachment))
                self._of_attachments[id(attachment)] = extents
            extents = self._of_attachments[id(attachment)]
        for name, value in extents.values.items():
            facts.put(name, value, extents.places.get(name, resolve.target_at))

    def _required_extents(
        self, render_pass: Pass, attachment: Attachment
    ) -> Iterator[tuple[Target, Extent, Span]]:
        """The images of an attachment of a render pass, each with the extent that it must have, and
        where that is stated.

        It is that of each framebuffer (VUID-VkFramebufferCreateInfo-flags-04533, 04534), and of the
        render area, which lies in it.
        """
        for framebuffer in self._framebuffers.get(render_pass.name, ()):
            names = framebuffer.attachments
            target = (
                self._frame.target(names[attachment.index])
                if attachment.index < len(names)
                else None
            )
            if target is not None:
                yield (
                    target,
                    (framebuffer.width, framebuffer.height),
                    framebuffer.place("width", "height"),
                )
        for position in render_pass.begun:
            body = self._frame.commands[position].body
            area = body.renderArea if isinstance(body, BeginRenderPass) else None
            if area is not None and attachment.target is not None:
                yield attachment.target, _end(area), area.head


def _put_extents(facts: Facts, required: Iterable[tuple[Target, Extent, Span]]) -> None:
    """Adds the first image that is smaller than required; false where all that is stated fits."""
    for target, extent, at in required:
        own_extent = target.size or (None, None)
        pairs = [
            (needed, own)
            for needed, own in zip(extent, own_extent, strict=True)
            if needed is not None and own is not None
        ]
        if any(own < needed for needed, own in pairs):
            facts.put("resolve.target_extent", _spelled(own_extent), target.record.place("extent"))
            facts.put("resolve.rendered_extent", _spelled(extent), at)
            facts.put("resolve.target_too_small", True)
            return
        if pairs:
            facts.put("resolve.target_too_small", False)


def _spelled(extent: Extent) -> str:
    return "x".join("?" if side is None else str(side) for side in extent)


def _end(area: Rect) -> Extent:
    """The right and the lower end of a render area."""
    width, height = area.width, area.height
    return (
        None if width is None else width + (area.x or 0),
        None if height is None else height + (area.y or 0),
    )


def other_uses(render_pass: Pass) -> dict[int, Use]:
    """What else subpasses (or a rendering) use the images for that their resolves write, by the
    identity of the resolve.

    Of two resolves, the second has the first as its other use. Where a resolve writes its own
    source, that is not looked at.
    """
    if not render_pass.resolves:
        return {}
    drawn: dict[tuple[int, int], tuple[Attachment, Use]] = {}
    for attachment in render_pass.attachments:
        # A local read of a rendering is not an input attachment of a render pass.
        inputs = attachment.input if render_pass.kind == RENDER_PASS else frozenset[int]()
        roles = (
            ("COLOR_ATTACHMENT", attachment.color),
            ("DEPTH_STENCIL_ATTACHMENT", attachment.depth_stencil),
            ("INPUT_ATTACHMENT", inputs),
            ("PRESERVED_ATTACHMENT", attachment.preserve),
        )
        for role, indices in roles:
            for key in _memory(attachment, attachment.target) if indices else ():
                for index in indices:
                    drawn.setdefault((index, key), (attachment, (role, attachment.record.head)))
    found: dict[int, Use] = {}
    resolved: dict[tuple[int, int], Resolve] = {}
    for resolve in render_pass.resolves:
        for memory in _memory(resolve.target, resolve.target_image):
            place = (resolve.subpass, memory)
            other = resolved.get(place)
            if other is not None and other is not resolve.pair:
                found.setdefault(id(resolve), ("RESOLVE_TARGET", other.target_at))
            if place in drawn and drawn[place][0] is not resolve.source:
                found.setdefault(id(resolve), drawn[place][1])
            if resolve.is_certain:
                resolved.setdefault(place, resolve)
    return found


def _memory(attachment: Attachment | None, target: Target | None) -> list[int]:
    """By what it is known that two uses are of the same memory: the attachment, and an image
    without layers, levels or slices.
    """
    found = [id(attachment)] if attachment is not None else []
    image = target.image if target is not None else None
    if (
        image is not None
        and one_surface(image)
        and image.imageType != "3D"
        and (image.extent is None or (image.extent.depth or 1) == 1)
    ):
        found.append(id(image))
    return found
