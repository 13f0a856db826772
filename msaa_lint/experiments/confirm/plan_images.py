"""The images of a plan. Properties that are not described are derived from their use, and noted in
words.
"""

from __future__ import annotations

from collections.abc import Iterable

from msaa_lint.frame.facts.frame import Frame
from msaa_lint.frame.facts.parts import Attachment, Pass, Resolve, Target
from msaa_lint.frame.vulkan.formats import Format, format_of

from .parts import (
    COLOR,
    COLOR_ATTACHMENT,
    DEPTH,
    DEPTH_ATTACHMENT,
    INPUT_ATTACHMENT,
    SAMPLED,
    STENCIL,
    STORAGE,
    TRANSFER_SOURCE,
    TRANSFER_TARGET,
    Image,
)
from .plan_integers import mask, number
from .plan_notes import Notes

DEFAULT_SIZE = (256, 256)
COLOR_FORMAT, DEPTH_FORMAT = "R8G8B8A8_UNORM", "D32_SFLOAT"
ASPECTS = {"color": COLOR, "depth": DEPTH, "stencil": STENCIL}

_BY_COMMAND = {
    "readImage": SAMPLED, "writeImage": STORAGE, "copyImageToBuffer": TRANSFER_SOURCE,
    "copyBufferToImage": TRANSFER_TARGET,
    "clearColorImage": TRANSFER_TARGET, "clearDepthStencilImage": TRANSFER_TARGET,
}  # fmt: skip


_BY_LAYOUT = {
    "SHADER_READ_ONLY_OPTIMAL": SAMPLED,
    "DEPTH_STENCIL_READ_ONLY_OPTIMAL": DEPTH_ATTACHMENT,
    "TRANSFER_SRC_OPTIMAL": TRANSFER_SOURCE,
    "TRANSFER_DST_OPTIMAL": TRANSFER_TARGET,
}

RENDER_TO_SINGLE_SAMPLED = 0x40000
"""VK_IMAGE_CREATE_MULTISAMPLED_RENDER_TO_SINGLE_SAMPLED_BIT_EXT."""


USAGES = 0xFF
"""The bits of VkImageUsageFlagBits of Vulkan 1.0; the others need extensions that confirm does not
enable.
"""

FLAGS = 0x5F8 | RENDER_TO_SINGLE_SAMPLED
"""The bits of VkImageCreateFlagBits that confirm sets: not those of sparse, disjoint, and protected
images, and of other extensions.
"""


class _Used:
    """How a frame uses an image."""

    def __init__(self, target: Target, name: str) -> None:
        self.target = target
        self.name = name
        self.usage = 0
        self.format: Format | None = target.format
        self.samples: int | None = target.samples
        self.source = False
        self.resolved_to = False
        self.beside: list[_Used] = []
        self.partners: list[_Used] = []
        self.area = (0, 0)
        self.layers = 0
        self.viewed = 0
        self.single_sampled = False


class Images:
    """The images of a frame, by number. `base` is the size in pixels of images that do not state
    one.
    """

    def __init__(self, frame: Frame) -> None:
        self.frame = frame
        self.notes = Notes()
        self._used: dict[int, _Used] = {}
        self._numbers: dict[int, int] = {}
        self.base, self._sized = _base(frame)
        for name, target in frame.targets.items():
            self._add(target, name)
        for frame_pass in frame.passes:
            self._pass(frame_pass)
        self._commands()
        self.uncounted: set[str] = set()
        """The images whose sample counts are assumed."""
        self._settle()
        self.images = tuple(self._image(used) for used in self._used.values())

    @property
    def sized(self) -> bool:
        """Whether the size of every image is stated somewhere."""
        return self._sized or all(used.area != (0, 0) for used in self._used.values())

    def of(self, target: Target) -> int:
        """The number of a target's image."""
        return self._numbers[id(target.record)]

    def named(self, name: str | None) -> int:
        """The number of the image with a name; -1 for none."""
        target = self.frame.target(name)
        return self.of(target) if target is not None else -1

    def _add(self, target: Target, name: str) -> _Used:
        key = id(target.record)
        if key not in self._used:
            self._numbers[key] = len(self._used)
            self._used[key] = _Used(target, name)
        return self._used[key]

    def _targets(self, described: Pass, attachment: Attachment) -> list[_Used]:
        return [
            self._add(target, image_name(described, attachment, target))
            for target in attachment.targets
        ]

    def _pass(self, described: Pass) -> None:
        by_attachment = {id(a): self._targets(described, a) for a in described.attachments}
        for attachment in described.attachments:
            for used in by_attachment[id(attachment)]:
                used.format = used.format or attachment.format
                used.samples = used.samples or attachment.samples
                resolved = {aspect for aspects in attachment.resolve.values() for aspect in aspects}
                color = bool(attachment.color) or "color" in resolved
                depth = bool(attachment.depth_stencil) or bool({"depth", "stencil", "?"} & resolved)
                used.usage |= (COLOR_ATTACHMENT if color else 0) | (
                    DEPTH_ATTACHMENT if depth else 0
                )
                used.usage |= INPUT_ATTACHMENT if attachment.input else 0
                layouts = {
                    getattr(attachment.record, member, None)
                    for member in ("initialLayout", "finalLayout")
                }
                used.usage |= sum(bit for name, bit in _BY_LAYOUT.items() if name in layouts)
        for subpass in described.subpasses:
            attached = [
                u
                for a in (*subpass.color, *subpass.depth_stencil)
                if a is not None
                for u in by_attachment[id(a)]
            ]
            for used in attached:
                used.beside += [other for other in attached if other is not used][:16]
            for resolve in subpass.resolves:
                self._resolve(resolve, by_attachment)
            views = (subpass.record.viewMask or 0).bit_length()
            for used in attached:
                used.viewed = max(used.viewed, views)
                used.single_sampled = used.single_sampled or subpass.single_sampled is True
        self._sizes(described, by_attachment)

    def _resolve(self, resolve: Resolve, by_attachment: dict[int, list[_Used]]) -> None:
        sources = by_attachment.get(id(resolve.source), []) if resolve.source is not None else []
        targets = by_attachment.get(id(resolve.target), []) if resolve.target is not None else []
        if resolve.target_image is not None:
            targets = targets or [self._add(resolve.target_image, resolve.target_image.name)]
        for used in sources:
            used.source = True
            used.partners += targets[:16]
        for used in targets:
            used.resolved_to = True
            used.partners += sources[:16]
            used.usage |= COLOR_ATTACHMENT if resolve.aspect == "color" else DEPTH_ATTACHMENT

    def _sizes(self, described: Pass, by_attachment: dict[int, list[_Used]]) -> None:
        sizes, layers = [], [1]
        for framebuffer in self.frame.framebuffers.get(described.name, ()):
            sizes.append((framebuffer.width or 0, framebuffer.height or 0))
            layers.append(framebuffer.layers or 1)
        records = [described.record, *(self.frame.commands[at].body for at in described.begun)]
        for record in records:
            area = getattr(record, "renderArea", None)
            if area is not None:
                sizes.append(
                    ((area.x or 0) + (area.width or 0), (area.y or 0) + (area.height or 0))
                )
            layers.append(getattr(record, "layerCount", None) or 1)
        for used in (u for group in by_attachment.values() for u in group):
            used.area = (
                (
                    max(used.area[0], *(s[0] for s in sizes), 0),
                    max(used.area[1], *(s[1] for s in sizes), 0),
                )
                if sizes
                else used.area
            )
            used.layers = max(used.layers, *layers)

    def _commands(self) -> None:
        for command in self.frame.commands:
            body = command.body
            if command.kind in ("resolveImage", "copyImage", "blitImage"):
                source, target = (
                    self._command(getattr(body, member, None))
                    for member in ("srcImage", "dstImage")
                )
                if source is not None:
                    source.usage |= TRANSFER_SOURCE
                if target is not None:
                    target.usage |= TRANSFER_TARGET
                if source is not None and target is not None:
                    source.partners.append(target)
                    target.partners.append(source)
                    source.source, target.resolved_to = (
                        source.source or command.kind == "resolveImage",
                        target.resolved_to,
                    )
            elif command.kind in _BY_COMMAND:
                used = self._command(
                    getattr(body, "image", None)
                    or getattr(body, "srcImage", None)
                    or getattr(body, "dstImage", None)
                )
                if used is not None:
                    used.usage |= _BY_COMMAND[command.kind]

    def _command(self, name: str | None) -> _Used | None:
        target = self.frame.target(name)
        return self._add(target, target.name) if target is not None else None

    def _settle(self) -> None:
        """Determines unstated formats and sample counts from the images that an image is resolved
        or drawn with, or by default.
        """
        for used in self._used.values():
            if used.format is None:
                known = next((p.format for p in used.partners if p.format is not None), None)
                depth = used.usage & DEPTH_ATTACHMENT and not used.usage & COLOR_ATTACHMENT
                used.format = known or format_of(DEPTH_FORMAT if depth else COLOR_FORMAT)
                assert used.format is not None
                self.notes.append(
                    f"no format is stated for {{}}: {used.format.name} is assumed", used.name
                )
        for used in self._used.values():
            if used.samples is None:
                beside = [other.samples for other in used.beside if other.samples is not None]
                used.samples = (
                    1
                    if used.resolved_to and not used.source
                    else max(beside)
                    if beside
                    else 4
                    if used.source
                    else 1
                )
                self.notes.append(
                    f"no sample count is stated for {{}}: {used.samples} is assumed", used.name
                )
                self.uncounted.add(used.name)

    def _image(self, used: _Used) -> Image:
        record = used.target.image
        format = used.format
        assert format is not None and used.samples is not None
        usage, flags, lazy = used.usage, 0, False
        type_name, tiling, levels, layers, depth = "2D", 0, 1, max(used.layers, used.viewed, 1), 1
        width, height = (
            used.area
            if used.area[0] > self.base[0] or used.area[1] > self.base[1] or not self._sized
            else self.base
        )
        width, height = width or self.base[0], height or self.base[1]
        if record is None and used.single_sampled and used.samples == 1:
            flags = RENDER_TO_SINGLE_SAMPLED
        if record is not None:
            flags = mask("VkImageCreateFlagBits", record.flags) & FLAGS
            type_name = record.imageType or "2D"
            tiling = number("VkImageTiling", record.tiling) if record.tiling is not None else 0
            levels = record.mipLevels or 1
            cube = flags & 0x10
            layers = record.arrayLayers or (6 if cube else layers)
            lazy = "LAZILY_ALLOCATED" in (record.memory or ())
            if record.usage is not None:
                # Metal has no usage for copies.
                copied = (
                    used.usage & (TRANSFER_SOURCE | TRANSFER_TARGET)
                    if self.frame.document.metal is not None
                    else 0
                )
                usage = mask("VkImageUsageFlagBits", record.usage) & USAGES | copied
                self._left_out("usage", record.usage, "VkImageUsageFlagBits", USAGES, used.name)
            self._left_out("flag", record.flags or (), "VkImageCreateFlagBits", FLAGS, used.name)
            if cube:
                height = width
            if record.extent is not None:
                width, height, depth = (
                    record.extent.width or width,
                    record.extent.height or height,
                    record.extent.depth or 1,
                )
        if not usage:
            usage = DEPTH_ATTACHMENT if "color" not in format.aspects else COLOR_ATTACHMENT
        aspects = sum(ASPECTS[each] for each in format.aspects) or COLOR
        kind = number("VkImageType", type_name)
        return Image(
            used.name, number("VkFormat", format.name), used.samples, usage, width,
            1 if kind == 0 else height, depth, layers, levels,
            kind, tiling, flags, lazy, aspects, format.numeric, format.bytes,
        )  # fmt: skip

    def _left_out(self, kind: str, names: Iterable[str], enum: str, kept: int, image: str) -> None:
        ignored = [name for name in names if not mask(enum, [name]) & kept]
        if ignored:
            words = (
                f"{kind}s {', '.join(ignored)} of {{}} are"
                if len(ignored) > 1
                else f"{kind} {ignored[0]} of {{}} is"
            )
            self.notes.append(f"the {words} ignored", image)


def image_name(described: Pass, attachment: Attachment, target: Target) -> str:
    """The name of an attachment's image in a plan, which is the attachment's if it names no
    image.
    """
    return target.name if target.image is not None else f"{described.name}.{attachment.name}"


def _base(frame: Frame) -> tuple[tuple[int, int], bool]:
    """The size of images that do not state one, and whether the description states it."""
    size = frame.description.frame
    if size is not None and size.width is not None and size.height is not None:
        return (size.width, size.height), True
    stated: Iterable[tuple[int | None, int | None]] = (
        *((f.width, f.height) for f in frame.description.framebuffers.values()),
        *(
            (i.extent.width, i.extent.height)
            for i in frame.description.images.values()
            if i.extent is not None
        ),
    )
    sizes = [
        (width, height) for width, height in stated if width is not None and height is not None
    ]
    return (max(sizes), True) if sizes else (DEFAULT_SIZE, False)
