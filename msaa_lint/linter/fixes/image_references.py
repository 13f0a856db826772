"""Where a frame names its images: which records do, which commands do, and which usages those commands need."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections import Counter
from collections.abc import Iterable, Iterator

from msaa_lint.frame.description.models import Command, Metal, MetalCopy
from msaa_lint.frame.description.record import Record
from msaa_lint.frame.facts.commands import accesses, naming_records
from msaa_lint.frame.facts.frame import Frame
from msaa_lint.frame.facts.pass_begin import MAX_USES, targets_at, uses_at_most

COMMAND_USAGES = frozenset({"TRANSFER_SRC", "TRANSFER_DST", "SAMPLED", "STORAGE"})
"""The usages whose need can be seen from the commands alone."""


class ImageReferences:
    """The records of a frame that name images."""

    def __init__(self, frame: Frame) -> None:
        self._records: dict[str, list[Record]] = {}
        description = frame.description
        for render_pass in description.renderPasses.values():
            for attachment in render_pass.attachments:
                if attachment.image is not None:
                    self._add(attachment.image, attachment)
        for command in frame.commands:
            for record, name in naming_records(command):
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
            names = {name for _, name in naming_records(command)}
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
    return ((name, usage) for name, access in accesses(command) for usage in access.usages)


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
