"""Where a frame names its images: which records do, which commands do, and which usages those commands need."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections import Counter
from collections.abc import Iterable, Iterator

from msaa_lint.frame.description.models import Command, ImageBarrier, Metal, MetalCopy
from msaa_lint.frame.description.record import Record
from msaa_lint.frame.facts.frame import Frame
from msaa_lint.frame.facts.pass_begin import MAX_USES, targets_at, uses_at_most

_TRANSFER_WRITE = {"dstImage": "TRANSFER_DST"}
_TRANSFER_READ = {"srcImage": "TRANSFER_SRC"}
_NEEDED_USAGES = {
    "resolveImage": _TRANSFER_READ | _TRANSFER_WRITE,
    "copyImage": _TRANSFER_READ | _TRANSFER_WRITE,
    "blitImage": _TRANSFER_READ | _TRANSFER_WRITE,
    "copyImageToBuffer": _TRANSFER_READ,
    "copyBufferToImage": _TRANSFER_WRITE,
    "clearColorImage": {"image": "TRANSFER_DST"},
    "clearDepthStencilImage": {"image": "TRANSFER_DST"},
    "readImage": {"image": "SAMPLED"},
    "writeImage": {"image": "STORAGE"},
}

COMMAND_USAGES = frozenset({"TRANSFER_SRC", "TRANSFER_DST", "SAMPLED", "STORAGE"})
"""The usages whose need can be seen from the commands alone."""

_IMAGE_MEMBERS = ("image", "srcImage", "dstImage", "resolveImage")


def command_images(command: Command) -> Iterator[tuple[Record, str]]:
    """The image names in a command, each with the record that states it: the command's own, an attachment's or a barrier's."""
    body = command.body
    if not isinstance(body, Record):
        return
    attachments = (*getattr(body, "colorAttachments", ()), getattr(body, "depthAttachment", None), getattr(body, "stencilAttachment", None))
    yield from _named_images((body, *attachments))
    for image in getattr(body, "images", ()):
        if isinstance(image, ImageBarrier):
            yield from _named_images((image,))
        elif isinstance(image, str):
            yield body, image


def _named_images(records: Iterable[Record | None]) -> Iterator[tuple[Record, str]]:
    for record in records:
        for member in _IMAGE_MEMBERS:
            name = getattr(record, member, None)
            if record is not None and isinstance(name, str):
                yield record, name


class ImageReferences:
    """The records of a frame that name images."""

    def __init__(self, frame: Frame) -> None:
        self._records: dict[str, list[Record]] = {}
        description = frame.description
        for render_pass in description.renderPasses.values():
            for record, name in _named_images(render_pass.attachments):
                self._add(name, record)
        for command in frame.commands:
            for record, name in command_images(command):
                self._add(name, record)
        for framebuffer in description.framebuffers.values():
            for image in framebuffer.attachments:
                if image is not None:
                    self._add(image, framebuffer)

    def _add(self, name: str, record: Record) -> None:
        self._records.setdefault(name, []).append(record)

    def records(self, name: str) -> list[Record]:
        """The records that name an image, one entry per reference."""
        return self._records.get(name, [])

    def has_others(self, name: str, records: Iterable[Record]) -> bool:
        """Whether any record outside `records` names an image."""
        known = {id(record) for record in records}
        return any(id(record) not in known for record in self.records(name))


class CommandUses:
    """Which commands use which images, by position. Empty, with `complete` False, for a frame with more uses than are tracked."""

    def __init__(self, frame: Frame) -> None:
        self._usages: dict[str, Counter[str]] = {}
        self._positions: dict[str, list[int]] = {}
        self.in_barriers: set[str] = set()
        """The images that barriers name."""
        self.complete = uses_at_most(frame) <= MAX_USES
        self.positions: dict[int, int] = {}
        """The position of each command, by the identity of its parameters."""
        begins = {position: begun for begun in frame.passes for position in begun.begun}
        for position, command in enumerate(frame.commands if self.complete else ()):
            self.positions[id(command.body)] = position
            names = {name for _, name in command_images(command)}
            if command.kind == "pipelineBarrier":
                self.in_barriers |= names
            if position in begins:
                attachments = begins[position].attachments
                names.update(target.name for attachment in attachments for target in targets_at(frame, attachment, position))
            for name in names:
                self._positions.setdefault(name, []).append(position)
            for name, usage in _needed_usages(command):
                self._usages.setdefault(name, Counter())[usage] += 1

    def needed_usages(self, name: str, without: Command | None = None) -> set[str]:
        """The usages that the commands, except `without`, require of an image. A read counts as both SAMPLED and STORAGE."""
        counts = Counter(self._usages.get(name, {}))
        if without is not None:
            counts.subtract(usage for image, usage in _needed_usages(without) if image == name)
        return {usage for usage, count in counts.items() if count > 0}

    def next_use(self, name: str, position: int) -> int | None:
        """The position of the first command after `position` that uses an image."""
        positions = self._positions.get(name, [])
        following = bisect_right(positions, position)
        return positions[following] if following < len(positions) else None

    def used_between(self, name: str, start: int, end: int) -> bool:
        """Whether a command from `start` up to, but not including, `end` uses an image."""
        positions = self._positions.get(name, [])
        first = bisect_left(positions, start)
        return first < len(positions) and positions[first] < end


def _needed_usages(command: Command) -> Iterator[tuple[str, str]]:
    for member, usage in _NEEDED_USAGES.get(command.kind, {}).items():
        name = getattr(command.body, member, None)
        if isinstance(name, str):
            yield name, usage
            if command.kind == "readImage":
                yield name, "STORAGE"


class MetalTextureReferences:
    """How often the passes and commands of a frame in Metal's terms name each texture, and where they copy which."""

    def __init__(self, metal: Metal) -> None:
        self.counts: Counter[str] = Counter()
        self.copies: dict[tuple[str, str], list[int]] = {}
        """The positions of the copies, by source and destination."""
        for render_pass in metal.renderPasses.values():
            colors = render_pass.colorAttachments
            attachments = [
                *(colors.values() if isinstance(colors, dict) else colors),
                render_pass.depthAttachment,
                render_pass.stencilAttachment,
            ]
            for attachment in attachments:
                self._count(attachment, "texture", "resolveTexture")
        for position, command in enumerate(metal.commands or ()):
            if command is None:
                continue
            body = command.body
            if command.kind == "present":
                self.counts[str(body)] += 1
            self._count(body, "texture", "source", "destination")
            if isinstance(body, MetalCopy) and body.source is not None and body.destination is not None:
                self.copies.setdefault((body.source, body.destination), []).append(position)

    def _count(self, record: object, *members: str) -> None:
        for member in members if isinstance(record, Record) else ():
            name = getattr(record, member, None)
            if isinstance(name, str):
                self.counts[name] += 1
