"""Image layouts as submitted commands leave them: which images a shader may read through
descriptors whose contents a capture omits.

Only images that such a shader has not been able to read yet are followed: the answer for the others
does not change.
"""

from collections.abc import Iterable, Iterator, Mapping
from typing import Any, NamedTuple

from .command_buffers import RecordedCommand, RenderPassBegin
from .objects import Image, ImageKind, RenderPass

UNKNOWN = "?"
"""Stands for a layout that the capture does not state: any layout."""

UNSEEN = "-"
"""Stands for the layout that an image had before the first command of the capture that tells it."""

SHADER_READ_ONLY = "SHADER_READ_ONLY_OPTIMAL"

UNREADABLE = frozenset((
    "UNDEFINED", "PREINITIALIZED", "ZERO_INITIALIZED_EXT", "COLOR_ATTACHMENT_OPTIMAL",
    "DEPTH_STENCIL_ATTACHMENT_OPTIMAL",
    "DEPTH_ATTACHMENT_OPTIMAL", "STENCIL_ATTACHMENT_OPTIMAL", "ATTACHMENT_OPTIMAL",
    "TRANSFER_SRC_OPTIMAL", "TRANSFER_DST_OPTIMAL",
    "PRESENT_SRC_KHR", "FRAGMENT_DENSITY_MAP_OPTIMAL_EXT",
    "FRAGMENT_SHADING_RATE_ATTACHMENT_OPTIMAL_KHR",
))  # fmt: skip
"""The layouts in which no shader can read an image through a descriptor."""

Layouts = frozenset[str]
NONE: Layouts = frozenset()

Change = tuple[Image, Layouts, bool, Layouts]
"""The layouts that an image changes to, whether that is all of the image, and those that it is
changed from.
"""


def readable(layout: str | None) -> Layouts:
    """A layout as those are told apart that descriptors state; empty if shaders cannot read in it,
    and UNKNOWN for None.
    """
    if layout is None:
        return _ANY
    if layout in UNREADABLE:
        return NONE
    # A descriptor of one aspect may state the layout of this aspect alone.
    return frozenset(
        (layout if layout == SHADER_READ_ONLY or "READ_ONLY" not in layout else "READ_ONLY",)
    )


_ANY: Layouts = frozenset((UNKNOWN,))


class ImageLayouts:
    """The images that unknown descriptors have not been able to hold yet, by the layouts in which
    they are now.
    """

    def __init__(self) -> None:
        self.initial = NONE
        """The layouts of new images: UNSEEN if the capture may omit what happened to them."""
        self._images: dict[ImageKind, dict[str, dict[Image, None]]] = {}
        self._asked: dict[Image, None] = {}
        """The images that such a descriptor may have held before the first command that tells their
        layout.
        """
        self._begin: RecordedCommand | None = None

    def add(self, image: Image) -> None:
        """Follows a new image."""
        self._set(image, self.initial)

    def forget(self, image: Image) -> None:
        """Follows an image no longer."""
        if image in self._asked:
            image.may_be_read = True
            del self._asked[image]
        self._set(image, NONE)
        image.kinds = ()

    def finish(self) -> None:
        """Ends the capture: the layouts of some images are never told."""
        for image in list(self._asked):
            self.forget(image)

    def followed(self) -> Iterator[Mapping[Image, None]]:
        """The images that are followed, by kind and layout."""
        yield self._asked
        for by_layout in self._images.values():
            yield from by_layout.values()

    def apply(self, changes: Iterable[Change]) -> None:
        """Changes layouts."""
        for image, layouts, is_whole, before in changes:
            if image in self._asked:
                if before:
                    self.forget(image)
                elif is_whole:
                    del self._asked[image]
            self._set(image, layouts if is_whole else image.layouts | layouts)

    def _set(self, image: Image, layouts: Layouts) -> None:
        if layouts == image.layouts or not image.kinds:
            return
        for kind in image.kinds:
            images = self._images.setdefault(kind, {})
            for layout in image.layouts - layouts:
                del images[layout][image]
            for layout in layouts - image.layouts:
                images.setdefault(layout, {})[image] = None
        image.layouts = layouts

    def mark(self, kinds: Iterable[ImageKind], layout: str | None) -> None:
        """Marks the images that a descriptor of some kinds may hold now. `layout` is what
        `readable` makes of its layout.
        """
        for kind in kinds:
            images = self._images.get(kind, {})
            for each in list(images) if layout in (None, UNKNOWN) else (layout, UNKNOWN, UNSEEN):
                for image in list(images.get(each, ())):
                    if each == UNSEEN:
                        self._set(image, image.layouts - {UNSEEN})
                        self._asked[image] = None
                    else:
                        image.may_be_read = True
                        self.forget(image)

    # What commands do.

    def changes(self, command: RecordedCommand) -> tuple[Change, ...]:
        """The changes of layouts that a command makes. The commands of a submission come in
        order.
        """
        if command.kind == "endRenderPass":
            begin, self._begin = self._begin, None
            return command_layouts(begin).at_end if begin is not None else ()
        if command.kind != "pipelineBarrier":
            self._begin = command
        return command_layouts(command).changes

    def net_changes(self, commands: list[RecordedCommand]) -> list[Change]:
        """The changes of layouts that commands make together."""
        net: dict[Image, tuple[Layouts, bool, Layouts]] = {}
        for command in commands:
            if command.kind in CHANGING:
                for image, layouts, is_whole, before in self.changes(command):
                    others, was_whole, first = net.get(image, (NONE, False, before))
                    net[image] = (
                        (layouts, True, first) if is_whole else (others | layouts, was_whole, first)
                    )
        return [(image, *change) for image, change in net.items() if image.kinds]


CHANGING = frozenset(("pipelineBarrier", "beginRenderPass", "beginRendering", "endRenderPass"))
"""The commands that change layouts."""


class AttachmentLayouts(NamedTuple):
    """The layouts of an attachment in the subpasses of a pass, before, and after it."""

    within: Layouts
    before: Layouts
    after: Layouts


class CommandLayouts(NamedTuple):
    """The changes of layouts that a command makes, those at the end of the pass that it begins, and
    the attachments of this pass that shaders cannot read during it.
    """

    changes: tuple[Change, ...] = ()
    at_end: tuple[Change, ...] = ()
    unreadable: frozenset[Image] = frozenset()


def command_layouts(command: RecordedCommand) -> CommandLayouts:
    """What a command does to layouts."""
    if command.layouts is None:
        command.layouts = _layouts_of(command)
    found: CommandLayouts = command.layouts
    return found


def _layouts_of(command: RecordedCommand) -> CommandLayouts:
    key: Any = command.key
    if command.kind == "pipelineBarrier":
        _, image, (before, layout), is_whole = key
        if image is None or not image.kinds or layout == "UNDEFINED":
            return CommandLayouts()
        return CommandLayouts(((image, readable(layout), is_whole, readable(before)),))
    attachments = _attached(command)
    unreadable = frozenset(image for image, (layouts, _) in attachments.items() if not layouts)
    changes = tuple(
        (image, layouts, image.is_single_level, before)
        for image, (layouts, before) in attachments.items()
        if image.kinds
    )
    if not changes or not isinstance(key, RenderPassBegin):
        return CommandLayouts(changes, (), unreadable)
    ends = zip(key.images, _pass_layouts(key.render_pass), strict=False)
    at_end = tuple(
        (image, each.after, image.is_single_level, NONE)
        for image, each in ends
        if image is not None and image.kinds
    )
    return CommandLayouts(changes, at_end, unreadable)


def _attached(command: RecordedCommand) -> dict[Image, tuple[Layouts, Layouts]]:
    """The attachments of a pass with the layouts in which shaders can read them during it (feedback
    loops, read-only depth) and before.
    """
    key: Any = command.key
    found: dict[Image, tuple[Layouts, Layouts]] = {}
    uses = _pass_uses(key) if isinstance(key, RenderPassBegin) else _rendering_uses(dict(key))
    for image, layouts, before in uses:
        if image is not None:
            others = found.get(image, (NONE, NONE))
            found[image] = others[0] | (layouts - {SHADER_READ_ONLY}), others[1] | before
    return found


def _pass_uses(begin: RenderPassBegin) -> Iterator[tuple[Image | None, Layouts, Layouts]]:
    for image, layouts in zip(begin.images, _pass_layouts(begin.render_pass), strict=False):
        yield image, layouts.within, layouts.before


def _rendering_uses(tree: dict[str, Any]) -> Iterator[tuple[Image | None, Layouts, Layouts]]:
    rates = (tree.get("fragmentDensityMapAttachment"), tree.get("fragmentShadingRateAttachment"))
    for info in (
        *tree.get("colorAttachments", ()),
        tree.get("depthAttachment"),
        tree.get("stencilAttachment"),
        *rates,
    ):
        attachment = dict(info or ())
        for image, layout in (("image", "imageLayout"), ("resolveImage", "resolveImageLayout")):
            layouts = readable(attachment.get(layout))
            yield attachment.get(image), layouts, layouts


def _pass_layouts(render_pass: RenderPass) -> list[AttachmentLayouts]:
    """The layouts of the attachments of a render pass."""
    if render_pass.layouts is None:
        tree = render_pass.tree
        within: dict[int, Layouts] = {}
        for subpass in tree.get("subpasses", ()):
            references = [subpass.get("depthStencilAttachment"), subpass.get("depthStencilResolve")]
            references += [
                subpass.get("fragmentShadingRateAttachment"),
                tree.get("fragmentDensityMapAttachment"),
            ]
            for member in ("colorAttachments", "resolveAttachments", "inputAttachments"):
                references += subpass.get(member, ())
            for reference in references:
                index, layout = _reference(reference)
                if index is not None:
                    within[index] = within.get(index, NONE) | readable(layout)
        render_pass.layouts = []
        for index, attachment in enumerate(tree.get("attachments", ())):
            ends = []
            for member, stencil in (
                ("initialLayout", "stencilInitialLayout"),
                ("finalLayout", "stencilFinalLayout"),
            ):
                layouts = readable(attachment.get(member))
                ends.append(
                    layouts | readable(attachment[stencil]) if stencil in attachment else layouts
                )
            render_pass.layouts.append(AttachmentLayouts(within.get(index, ends[1]), *ends))
    found: list[AttachmentLayouts] = render_pass.layouts
    return found


def _reference(value: Any) -> tuple[int | None, str | None]:
    """The index and the layout of an attachment reference."""
    if not isinstance(value, dict):
        return value, None
    index, layout = _reference(value.get("attachment"))
    return index, value.get("layout", layout)
