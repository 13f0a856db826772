"""What a pass or a command moves between the GPU and external memory, by plain arithmetic: exact
bytes of one frame.

The model is a tile-based GPU: it reads an attachment where the pass loads it, writes it where the
pass stores it, and resolves on the tile, so that a resolve writes one sample. Input attachments and
vkCmdClearAttachments stay on the tile. An attachment that no subpass uses moves nothing, whatever
its operations (VkAttachmentDescription). `immediate_mode.py` has the passes of immediate-mode GPUs.
"""

from typing import NamedTuple

from msaa_lint.core.text.span import Span
from msaa_lint.frame.description.models import Command, Image, ReadImage
from msaa_lint.frame.devices import DeviceProfile
from msaa_lint.frame.devices.vendors import packs_depth_stencil
from msaa_lint.frame.facts.commands import (
    CLEAR,
    COMMAND_READS,
    COMMANDS,
    COPY_READ,
    COPY_WRITE,
    READ,
    RESOLVE_READ,
    RESOLVE_WRITE,
    WRITE,
)
from msaa_lint.frame.facts.compression import compresses
from msaa_lint.frame.facts.frame import Frame
from msaa_lint.frame.facts.parts import RENDERING, Attachment, Pass, Resolve, Target
from msaa_lint.frame.vulkan.formats import Format

from .amounts import Line
from .sizes import Area, Sizes, views_of

_ACTIONS = {
    READ: "read", WRITE: "write", CLEAR: "clear", COPY_READ: "copy", COPY_WRITE: "copy",
    RESOLVE_READ: "resolve command",
    RESOLVE_WRITE: "resolve command",
}  # fmt: skip
MOVING = frozenset(COMMANDS) - {"present"}
"""The commands outside of begin and end that move texels. A present moves none: scanning out is the
display's.
"""


NOT_STATED = {
    "format": "its format is not stated: write `format`",
    "samples": "its sample count is not stated: write `samples`",
    "extent": "its size is not stated: write `extent`",
}
_NO_IMAGE = {
    **dict.fromkeys(("copyImage", "blitImage", "resolveImage"), "an image: it is not stated"),
    **dict.fromkeys(("copyImageToBuffer", "copyBufferToImage"), "the image: it is not stated"),
}


def aspect_bytes(format: Format, aspect: str) -> int | None:
    """What an aspect takes of a texel block: of D32_SFLOAT_S8_UINT 4 and 1, of D24_UNORM_S8_UINT 3
    and 1, of X8_D24 4.
    """
    if aspect not in format.aspects:
        return None
    if aspect == "stencil":
        return format.stencil_bytes
    return format.bytes - format.stencil_bytes if aspect == "depth" else format.bytes


def in_one_plane(format: Format | None, device: DeviceProfile | None) -> bool:
    """Whether a device is known to move depth and stencil of a format together: 4 bytes of
    D24_UNORM_S8_UINT, for either or both.
    """
    packed = format is not None and format.name == "D24_UNORM_S8_UINT"
    return packed and device is not None and packs_depth_stencil(device.vendor)


class Stored(NamedTuple):
    """How an image is kept in memory: its format, how many samples a texel has, and what is stated
    of it.
    """

    format: Format | None
    samples: int
    image: Image | None


def _ratios(device: DeviceProfile, writes: bool, stored: Stored) -> tuple[float, float] | None:
    """The least and the most that moving an image takes of plain arithmetic; None where the
    device's compression is not known.

    A ratio is an average over pictures: 1 means that nothing is compressed, above 1 that more moves
    than the texels. Where the device does not compress the image, it is not below 1.
    """
    measured = device.compression.get(stored.samples) if device.compression is not None else None
    if measured is None:
        return None
    least = measured[writes]
    most = least if device.compression_most is None else max(least, device.compression_most[writes])
    compressible = compresses(device, stored.format, stored.samples, stored.image)
    return (
        max(least, 1.0) if compressible is False else least,
        most if compressible else max(most, 1.0),
    )


class Lines:
    """The lines of one pass or command, and what could not be counted."""

    __slots__ = ("_planes", "assumed", "device", "found", "unknown")

    def __init__(self, device: DeviceProfile | None) -> None:
        self.device = device
        self.found: list[Line] = []
        self._planes: dict[tuple[str, ...], list[int]] = {}
        """By what moves: the lines of aspects that are in one plane."""
        self.unknown: dict[str, None] = {}
        self.assumed: dict[str, None] = {}

    def add(
        self,
        attachment: str,
        image: str,
        aspect: str,
        samples: int,
        action: str,
        direction: str,
        size: int,
        place: Span | None,
        stored: Stored,
    ) -> None:
        """A line; `stored` is how the image is kept in memory, which decides how it is
        compressed.
        """
        ratios = (
            _ratios(self.device, direction == "write", stored) if self.device is not None else None
        )
        least, most = (size * ratios[0], size * ratios[1]) if ratios is not None else (None, None)
        self.found.append(
            Line(attachment, image, aspect, samples, action, direction, size, least, place, most)
        )
        if in_one_plane(stored.format, self.device):
            # A resolve in a pass stores, too.
            what = "store" if (action, direction) == ("resolve", "write") else action
            self._planes.setdefault((image or attachment, what, direction), []).append(
                len(self.found) - 1
            )

    def move_planes(self) -> None:
        """Lets what moves one aspect of a plane move all of it. Where both aspects move, each line
        has its part.
        """
        for numbers in self._planes.values():
            if len({self.found[number].aspect for number in numbers}) > 1:
                continue
            for number in numbers:
                line = self.found[number]
                part = 1 if line.aspect == "stencil" else 3
                least, most = (
                    None if size is None else size * 4 / part
                    for size in (line.corrected, line.corrected_most)
                )
                self.found[number] = line._replace(
                    bytes=line.bytes * 4 // part, corrected=least, corrected_most=most
                )

    def missing(self, text: str) -> None:
        """Says of something that it is not counted, and why."""
        self.unknown[text] = None


def pass_lines(render_pass: Pass, area: Area, device: DeviceProfile | None) -> Lines:
    """What a pass loads, stores and resolves, all the times that a frame begins it."""
    lines = Lines(device)
    if not area.sized:
        lines.missing("its size is not stated: write `frame: {width: ..., height: ...}`")
    if area.times == 0 or area.width is None:
        return lines
    for attachment in render_pass.attachments:
        if attachment.used:
            _attachment(lines, render_pass, attachment, area)
    if render_pass.kind == RENDERING and not render_pass.suspends:
        _rendering_resolves(lines, render_pass, area)
    return lines


def _attachment(lines: Lines, render_pass: Pass, attachment: Attachment, area: Area) -> None:
    target = attachment.targets[0] if attachment.targets else None
    image = target.name if target is not None and target.image is not None else ""
    pixels: int | None = pass_pixels(render_pass, attachment, area)
    if attachment.only_rate:
        # A texel of it is for a block of pixels: the extent alone says how many it has.
        extent = target.image.extent if target is not None and target.image is not None else None
        sides = (extent.width, extent.height) if extent is not None else (None, None)
        layers = (
            target.image.arrayLayers if target is not None and target.image is not None else None
        )
        pixels = (
            sides[0] * sides[1] * (layers or 1) * area.times
            if sides[0] is not None and sides[1] is not None
            else None
        )
    over: set[str] = set().union(*attachment.resolve.values()) if attachment.resolve else set()
    record, samples = attachment.record, attachment.samples
    for aspect in attachment.aspects:
        name = aspect.name or "color"
        causes = []
        if aspect.load == "LOAD":
            causes.append(("load", "read", record.place(aspect.load_member)))
        elif aspect.load is None:
            lines.missing(
                f"whether `{attachment.title}` is loaded: {aspect.load_member} is not stated"
            )
        if aspect.store == "STORE":
            causes.append(
                ("resolve" if name in over else "store", "write", record.place(aspect.store_member))
            )
        elif aspect.store is None:
            lines.missing(
                f"whether `{attachment.title}` is stored: {aspect.store_member} is not stated"
            )
        if attachment.input and (lines.device is None or lines.device.tiler is None):
            lines.assumed["input attachments are read on the tile"] = None
        if not causes:
            continue
        texel = aspect_bytes(attachment.format, name) if attachment.format is not None else None
        if pixels is None:
            lines.missing(f"`{attachment.title}`: its size is not stated: write `extent`")
            continue
        if texel is None or samples is None:
            lines.missing(
                f"`{attachment.title}`: {NOT_STATED['format' if texel is None else 'samples']}"
            )
            continue
        stored = Stored(attachment.format, samples, target.image if target is not None else None)
        for action, direction, place in causes:
            lines.add(
                attachment.name,
                image,
                name,
                samples,
                action,
                direction,
                pixels * texel * samples,
                place,
                stored,
            )


def _rendering_resolves(lines: Lines, render_pass: Pass, area: Area) -> None:
    """The resolves at the end of a dynamic rendering: each writes one sample."""
    for resolve in render_pass.subpasses[0].resolves:
        target, source = resolve.target_image, resolve.source
        if resolve.mode == "NONE" or target is None or source is None:
            continue
        if resolve.mode is None:
            lines.missing(f"whether `{source.title}` is resolved: resolveMode is not stated")
            continue
        resolve_write(lines, render_pass, resolve, source, target, area)


def resolve_write(
    lines: Lines,
    render_pass: Pass,
    resolve: Resolve,
    source: Attachment,
    target: Target,
    area: Area,
) -> None:
    """Adds what a resolve writes to an image that is not an attachment: one sample of each
    pixel.
    """
    format = target.format or source.format
    texel = aspect_bytes(format, resolve.aspect) if format is not None else None
    if texel is None:
        lines.missing(f"`{target.title}`: {NOT_STATED['format']}")
        return
    size = pass_pixels(render_pass, source, area) * texel
    stored = Stored(format, 1, target.image)
    lines.add(
        target.name,
        target.name,
        resolve.aspect,
        1,
        "resolve",
        "write",
        size,
        resolve.target_at,
        stored,
    )


def pass_pixels(render_pass: Pass, attachment: Attachment, area: Area) -> int:
    """The pixels of an attachment in every view or layer that a pass renders."""
    views = views_of(render_pass, attachment)
    return area.pixels * views if views else area.layered


def command_lines(lines: Lines, command: Command, frame: Frame, sizes: Sizes) -> None:
    """What a command outside of load and store operations moves: whole images, their first mip
    level, every layer.
    """
    body, accesses = command.body, COMMANDS[command.kind]
    images = [
        image
        for access in accesses
        if (image := frame.target(getattr(body, access.member, None))) is not None
    ]
    if len(images) < len(accesses):
        lines.missing(
            _NO_IMAGE.get(command.kind, f"what {command.kind} names: the image is not stated")
        )
        return
    if lines.device is not None and lines.device.tiler is False and accesses[0].effect == CLEAR:
        # An immediate-mode GPU may clear by its compression's metadata alone: unknown, as for load
        # operations.
        return
    if isinstance(body, ReadImage):
        _read(lines, command, body, images[0], sizes)
        return
    # A copy and a resolve take as many texels from one image as they put into the other; a blit
    # scales.
    blocks = (
        [texels(image, sizes) for image in images]
        if command.kind in ("copyImage", "resolveImage")
        else []
    )
    common = (
        min((count for count in blocks if count is not None), default=None)
        if None not in blocks
        else None
    )
    start = len(lines.found)
    for image, access in zip(images, accesses, strict=True):
        direction = "read" if access.effect in COMMAND_READS else "write"
        samples = 1 if access.effect == RESOLVE_WRITE else None
        _move(lines, command, image, _ACTIONS[access.effect], direction, sizes, common, samples)
    if command.kind in ("copyImageToBuffer", "copyBufferToImage"):
        for line in lines.found[start:]:
            opposite = "write" if line.direction == "read" else "read"
            plain = _plain(line)
            buffer = line._replace(
                attachment="buffer",
                image="",
                direction=opposite,
                corrected=plain,
                corrected_most=plain,
            )
            lines.found.append(buffer)


def _plain(line: Line) -> float | None:
    """A buffer is not compressed; a device of which nothing is known stays unknown."""
    return None if line.corrected is None else float(line.bytes)


def _read(lines: Lines, command: Command, body: ReadImage, image: Target, sizes: Sizes) -> None:
    """A shader reads every texel once: of depth and stencil together depth, of several samples what
    `samples` states, else all.
    """
    if image.samples is not None and image.samples > 1 and body.samples is None:
        lines.assumed[f"the reader of `{image.name}` fetches all {image.samples} samples"] = None
    _move(lines, command, image, "read", "read", sizes, None, 1 if body.samples == 1 else None)


def texels(image: Target, sizes: Sizes) -> int | None:
    """Texel blocks of the first mip level of an image, every layer and slice; None where its size
    or format is unknown.
    """
    size, format = sizes.image(image), image.format
    if size is None or format is None:
        return None
    width, height, depth = (
        -(-side // block) for side, block in zip(size, format.block, strict=True)
    )
    layers = image.image.arrayLayers if image.image is not None else None
    return width * height * depth * (layers or 1)


def _move(
    lines: Lines,
    command: Command,
    image: Target,
    action: str,
    direction: str,
    sizes: Sizes,
    blocks: int | None = None,
    samples: int | None = None,
) -> None:
    """Adds what moving an image takes; `blocks` and `samples` where that is less than all of it."""
    format, kept = image.format, image.samples
    blocks = texels(image, sizes) if blocks is None else blocks
    if format is None or kept is None or blocks is None:
        lacking = "format" if format is None else "samples" if kept is None else "extent"
        lines.missing(f"`{image.title}`: {NOT_STATED[lacking]}")
        return
    aspects = format.aspects[:1] if action == "read" else format.aspects
    moved = kept if samples is None else samples
    for aspect in aspects:
        size = blocks * (aspect_bytes(format, aspect) or 0) * moved
        stored = Stored(format, kept, image.image)
        lines.add(
            image.name, image.name, aspect, moved, action, direction, size, command.head, stored
        )
