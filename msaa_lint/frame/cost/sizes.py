"""How many pixels a pass renders, and how large an image is, from what the description states of
either.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from msaa_lint.frame.description.models import BeginRendering, BeginRenderPass, Framebuffer
from msaa_lint.frame.facts.frame import Frame
from msaa_lint.frame.facts.parts import RENDERING, Attachment, Pass, Target

from .amounts import Terms


class Area(NamedTuple):
    """What a pass renders in a frame: `pixels` of one layer, `layered` of all its layers, summed
    over the times that it begins.

    `width` and `height` are those of its first begin. `sized` is false where the size of some begin
    is unknown, and so not in the sums.
    """

    times: int
    pixels: int
    layered: int
    width: int | None
    height: int | None
    sized: bool
    assumed: tuple[str, ...]


class Sizes:
    """The sizes of a frame's passes and images.

    A pass is as large as its framebuffer and the smallest of its images say; what neither says is
    the caller's, then the frame's size. An image without an extent is as large as the first pass
    that uses it.
    """

    def __init__(self, frame: Frame, terms: Terms) -> None:
        self.frame = frame
        size = frame.description.frame
        self.width = (
            terms.width if terms.width is not None else size.width if size is not None else None
        )
        self.height = (
            terms.height if terms.height is not None else size.height if size is not None else None
        )
        self._of_framebuffer: dict[str, tuple[int | None, int | None, int | None]] = {}
        self._of_images: dict[str, tuple[int | None, int | None]] | None = None

    def area(self, render_pass: Pass) -> Area:
        """What a pass renders in a frame."""
        bodies: list[BeginRenderPass | BeginRendering | None]
        if isinstance(render_pass.record, BeginRendering):
            bodies = [render_pass.record]
        else:
            begun = (self.frame.commands[position].body for position in render_pass.begun)
            bodies = (
                [body for body in begun if isinstance(body, BeginRenderPass)]
                if self.frame.has_commands
                else [None]
            )
        own = self._own(render_pass)
        layers_of_images = _least_layers(
            [
                a.targets[0]
                for a in render_pass.attachments
                if a.used and not a.only_rate and a.targets
            ]
        )
        pixels = layered = 0
        first: tuple[int, int] | None = None
        sized, assumed = True, False
        for body in bodies:
            width, height, layers = self._begun(render_pass, body, own)
            if width is None or height is None:
                sized = False
                continue
            if layers is None:
                layers = layers_of_images
                assumed = layers > 1
            first = first or (width, height)
            pixels += width * height
            layered += width * height * layers
        views = any(subpass.record.viewMask for subpass in render_pass.subpasses)
        texts = (
            (f"`{render_pass.name}` renders to all {layers_of_images} layers of its images",)
            if assumed and not views
            else ()
        )
        width, height = first if first is not None else (None, None)
        return Area(len(bodies), pixels, layered, width, height, sized, texts)

    def _begun(
        self,
        render_pass: Pass,
        body: BeginRenderPass | BeginRendering | None,
        own: tuple[int | None, int | None],
    ) -> tuple[int | None, int | None, int | None]:
        """Width, height and layers of one begin."""
        width, height, layers = *own, None
        if render_pass.kind == RENDERING:
            layers = body.layerCount if isinstance(body, BeginRendering) else None
        else:
            framebuffer = self._framebuffer(
                render_pass, body if isinstance(body, BeginRenderPass) else None
            )
            if framebuffer is not None:
                wide, high, layers = self._framebuffer_size(framebuffer)
                width, height = wide or width, high or height
        width, height = width or self.width, height or self.height
        area = body.renderArea if body is not None else None
        if area is not None:
            width, height = (
                _clipped(area.x, area.width, width),
                _clipped(area.y, area.height, height),
            )
        return width, height, layers

    def _framebuffer(self, render_pass: Pass, body: BeginRenderPass | None) -> Framebuffer | None:
        """The framebuffer of a begin, the first of several that alternate; the only one of its pass
        where none is named.
        """
        named = body.framebuffer if body is not None else None
        if named is not None:
            name = named if isinstance(named, str) else next(iter(named), "")
            return self.frame.description.framebuffers.get(name)
        return next(iter(self.frame.framebuffers.get(render_pass.name, ())), None)

    def _framebuffer_size(
        self, framebuffer: Framebuffer
    ) -> tuple[int | None, int | None, int | None]:
        found = self._of_framebuffer.get(framebuffer.key)
        if found is None:
            targets = [target for target in self._targets(framebuffer) if target is not None]
            # Of a mip level further up the framebuffer alone knows the size.
            width, height = (
                _least(targets)
                if framebuffer.width is None or framebuffer.height is None
                else (None, None)
            )
            layers = framebuffer.layers
            found = (framebuffer.width or width, framebuffer.height or height, layers)
            self._of_framebuffer[framebuffer.key] = found
        return found

    def _targets(self, framebuffer: Framebuffer) -> Iterator[Target | None]:
        """The images that a framebuffer has the size of: all but density maps and shading rate
        attachments.
        """
        render_pass = self.frame.render_pass(framebuffer.renderPass)
        attachments = render_pass.attachments if render_pass is not None else []
        for index, name in enumerate(framebuffer.attachments):
            if not (index < len(attachments) and attachments[index].only_rate):
                yield self.frame.target(name)

    @staticmethod
    def _own(render_pass: Pass) -> tuple[int | None, int | None]:
        """What a pass's images say of its size."""
        rendered = [
            attachment
            for attachment in render_pass.attachments
            if attachment.used and not attachment.only_rate
        ]
        targets = [target for attachment in rendered for target in attachment.targets[:1]]
        if render_pass.kind == RENDERING:
            targets += [
                resolve.target_image
                for resolve in render_pass.subpasses[0].resolves
                if resolve.target_image is not None
            ]
        return _least(targets)

    def image(self, target: Target) -> tuple[int, int, int] | None:
        """Width, height and depth of an image in texels; None where neither it, a pass that uses
        it, nor the frame says.
        """
        extent = target.image.extent if target.image is not None else None
        width, height, depth = (
            (extent.width, extent.height, extent.depth)
            if extent is not None
            else (None, None, None)
        )
        if width is None or height is None:
            if self._of_images is None:
                self._of_images = self._sizes_of_images()
            bound = self._of_images.get(target.path, (self.width, self.height))
            width, height = width or bound[0], height or bound[1]
        return (width, height, depth or 1) if width is not None and height is not None else None

    def _sizes_of_images(self) -> dict[str, tuple[int | None, int | None]]:
        found: dict[str, tuple[int | None, int | None]] = {}
        for render_pass in self.frame.passes:
            rates = [
                target
                for attachment in render_pass.attachments
                if attachment.only_rate
                for target in attachment.targets
            ]
            found.update((target.path, (None, None)) for target in (*rates, *render_pass.rates))
        for render_pass in self.frame.passes:
            own = self._own(render_pass)
            if render_pass.kind == RENDERING:
                framebuffers: list[Framebuffer | None] = [None]
            else:
                framebuffers = [*self.frame.framebuffers.get(render_pass.name, ())] or [None]
            for framebuffer in framebuffers:
                width, height = own
                rendered = [
                    attachment for attachment in render_pass.attachments if not attachment.only_rate
                ]
                targets = [target for attachment in rendered for target in attachment.targets]
                if framebuffer is not None:
                    wide, high, _ = self._framebuffer_size(framebuffer)
                    width, height = wide or width, high or height
                    targets = [
                        target for target in self._targets(framebuffer) if target is not None
                    ]
                elif render_pass.kind == RENDERING:
                    targets += [
                        r.target_image
                        for r in render_pass.subpasses[0].resolves
                        if r.target_image is not None
                    ]
                width, height = width or self.width, height or self.height
                if width is not None and height is not None:
                    for target in targets:
                        found.setdefault(target.path, (width, height))
        return found


def views_of(render_pass: Pass, attachment: Attachment) -> int:
    """How many views (VkSubpassDescription2::viewMask) render to an attachment; 0 without
    multiview.
    """
    used = (
        attachment.color | attachment.depth_stencil | attachment.input | attachment.resolve.keys()
    )
    mask = 0
    for index in used:
        mask |= render_pass.subpasses[index].record.viewMask or 0
    return mask.bit_count()


def _least(targets: list[Target]) -> tuple[int | None, int | None]:
    """The smallest width and height that images state."""
    extents = [
        target.image.extent
        for target in targets
        if target.image is not None and target.image.extent is not None
    ]
    widths = [extent.width for extent in extents if extent.width is not None]
    heights = [extent.height for extent in extents if extent.height is not None]
    return min(widths, default=None), min(heights, default=None)


def _least_layers(targets: list[Target]) -> int:
    """The fewest layers of images that pass together; 1 where one does not state them."""
    counts = [target.image.arrayLayers if target.image is not None else None for target in targets]
    return min((count or 1 for count in counts), default=1)


def _clipped(offset: int | None, length: int | None, whole: int | None) -> int | None:
    """How much of a side of the render area lies in the whole."""
    start = offset or 0
    if whole is None:
        return length
    end = whole if length is None else min(start + length, whole)
    return max(end - max(start, 0), 0)
