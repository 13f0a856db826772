"""Image layouts as submitted commands leave them: which images a shader may read through descriptors whose contents a capture omits.

Only images that such a shader has not been able to read yet are followed: the answer for the others does not change.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from .command_buffers import RecordedCommand, RenderPassBegin
from .objects import Image, ImageKind, RenderPass

UNKNOWN = "?"
"""Stands for a layout that the capture does not state: any layout."""

SHADER_READ_ONLY = "SHADER_READ_ONLY_OPTIMAL"

UNREADABLE = frozenset((
    "UNDEFINED", "PREINITIALIZED", "ZERO_INITIALIZED_EXT", "COLOR_ATTACHMENT_OPTIMAL", "DEPTH_STENCIL_ATTACHMENT_OPTIMAL",
    "DEPTH_ATTACHMENT_OPTIMAL", "STENCIL_ATTACHMENT_OPTIMAL", "ATTACHMENT_OPTIMAL", "TRANSFER_SRC_OPTIMAL", "TRANSFER_DST_OPTIMAL",
    "PRESENT_SRC_KHR", "FRAGMENT_DENSITY_MAP_OPTIMAL_EXT", "FRAGMENT_SHADING_RATE_ATTACHMENT_OPTIMAL_KHR",
))  # fmt: skip
"""The layouts in which no shader can read an image through a descriptor."""

Layouts = frozenset[str]
NONE: Layouts = frozenset()

Change = tuple[Image, Layouts, bool]
"""The layouts that parts of an image change to, and whether that is all of the image."""


def readable(layout: str | None) -> Layouts:
    """A layout as those are told apart that descriptors state; empty if shaders cannot read in it, and UNKNOWN for None."""
    if layout is None:
        return _ANY
    if layout in UNREADABLE:
        return NONE
    # A descriptor of one aspect may state the layout of this aspect alone.
    return frozenset((layout if layout == SHADER_READ_ONLY or "READ_ONLY" not in layout else "READ_ONLY",))


_ANY: Layouts = frozenset((UNKNOWN,))


class ImageLayouts:
    """The images that unknown descriptors have not been able to hold yet, by the layouts in which they are now."""

    def __init__(self) -> None:
        self.initial = NONE
        """The layouts of new images: unknown if the capture omits what happened to them."""
        self._images: dict[ImageKind, dict[str, dict[Image, None]]] = {}
        self._begin: RenderPassBegin | None = None

    def add(self, image: Image) -> None:
        """Follows a new image."""
        image.layouts = NONE
        self.apply(((image, self.initial, True),))

    def forget(self, image: Image) -> None:
        """Follows an image no longer."""
        self.apply(((image, NONE, True),))
        image.kinds = ()

    def followed(self) -> Iterator[Mapping[Image, None]]:
        """The images that are followed, by kind and layout."""
        for by_layout in self._images.values():
            yield from by_layout.values()

    def apply(self, changes: Iterable[Change]) -> None:
        """Changes layouts."""
        for image, layouts, is_whole in changes:
            after = layouts if is_whole else image.layouts | layouts
            if after == image.layouts:
                continue
            for kind in image.kinds:
                images = self._images.setdefault(kind, {})
                for layout in image.layouts - after:
                    del images[layout][image]
                for layout in after - image.layouts:
                    images.setdefault(layout, {})[image] = None
            if image.kinds:
                image.layouts = after

    def mark(self, kinds: Iterable[ImageKind], layout: str | None) -> None:
        """Marks the images that a descriptor of some kinds may hold now. `layout` is what `readable` makes of its layout."""
        for kind in kinds:
            images = self._images.get(kind, {})
            for each in list(images) if layout in (None, UNKNOWN) else (layout, UNKNOWN):
                for image in list(images.get(each, ())):
                    image.may_be_read = True
                    self.forget(image)

    # What commands do.

    def changes(self, command: RecordedCommand) -> list[Change]:
        """The changes of layouts that a command makes. The commands of a submission come in order."""
        key: Any = command.key
        if command.kind == "pipelineBarrier":
            _, image, (_, layout), is_whole = key
            return [(image, readable(layout), is_whole)] if image is not None and layout != "UNDEFINED" else []
        if command.kind in ("beginRenderPass", "beginRendering"):
            self._begin = key if isinstance(key, RenderPassBegin) else None
            return [(image, layouts, image.is_single_level) for image, layouts in attached(command).items()]
        if command.kind == "endRenderPass" and self._begin is not None:
            begin, self._begin = self._begin, None
            finals = _pass_layouts(begin.render_pass)
            pairs = zip(begin.images, finals, strict=False)
            return [(image, final, image.is_single_level) for image, (_, final) in pairs if image is not None]
        return []

    def net_changes(self, commands: list[RecordedCommand]) -> list[Change]:
        """The changes of layouts that commands make together."""
        net: dict[Image, tuple[Layouts, bool]] = {}
        for command in commands:
            if command.kind in CHANGING:
                for image, layouts, is_whole in self.changes(command):
                    before, was_whole = net.get(image, (NONE, False))
                    net[image] = (layouts, True) if is_whole else (before | layouts, was_whole)
        return [(image, *change) for image, change in net.items() if image.kinds]


CHANGING = frozenset(("pipelineBarrier", "beginRenderPass", "beginRendering", "endRenderPass"))
"""The commands that change layouts."""


def attached(command: RecordedCommand) -> dict[Image, Layouts]:
    """The attachments of a pass, each with the layouts in which shaders can read it during the pass: feedback loops, read-only depth."""
    key: Any = command.key
    found: dict[Image, Layouts] = {}
    uses = _pass_uses(key) if isinstance(key, RenderPassBegin) else _rendering_uses(dict(key))
    for image, layouts in uses:
        if image is not None:
            found[image] = found.get(image, NONE) | (layouts - {SHADER_READ_ONLY})
    return found


def _pass_uses(begin: RenderPassBegin) -> Iterator[tuple[Image | None, Layouts]]:
    for image, (layouts, _) in zip(begin.images, _pass_layouts(begin.render_pass), strict=False):
        yield image, layouts


def _rendering_uses(tree: dict[str, Any]) -> Iterator[tuple[Image | None, Layouts]]:
    for info in (*tree.get("colorAttachments", ()), tree.get("depthAttachment"), tree.get("stencilAttachment")):
        attachment = dict(info or ())
        for image, layout in (("image", "imageLayout"), ("resolveImage", "resolveImageLayout")):
            yield attachment.get(image), readable(attachment.get(layout))


def _pass_layouts(render_pass: RenderPass) -> list[tuple[Layouts, Layouts]]:
    """By attachment of a render pass: the layouts in its subpasses, and those after it."""
    if render_pass.layouts is None:
        tree = render_pass.tree
        within: dict[int, Layouts] = {}
        for subpass in tree.get("subpasses", ()):
            references = [subpass.get("depthStencilAttachment"), subpass.get("depthStencilResolve")]
            for member in ("colorAttachments", "resolveAttachments", "inputAttachments"):
                references += subpass.get(member, ())
            for reference in references:
                index, layout = _reference(reference)
                if index is not None:
                    within[index] = within.get(index, NONE) | readable(layout)
        render_pass.layouts = []
        for index, attachment in enumerate(tree.get("attachments", ())):
            final = readable(attachment.get("finalLayout"))
            if "stencilFinalLayout" in attachment:
                final |= readable(attachment["stencilFinalLayout"])
            render_pass.layouts.append((within.get(index, final), final))
    found: list[tuple[Layouts, Layouts]] = render_pass.layouts
    return found


def _reference(value: Any) -> tuple[int | None, str | None]:
    """The index and the layout of an attachment reference."""
    if not isinstance(value, dict):
        return value, None
    index, layout = _reference(value.get("attachment"))
    return index, value.get("layout", layout)
