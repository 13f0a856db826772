"""What the recorded commands do with images, looked up: which usages they need, where they name them."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections import Counter
from collections.abc import Iterator

from msaa_lint.frame.description.models import Command, ImageBarrier
from msaa_lint.frame.description.record import Record
from msaa_lint.frame.facts.frame import Frame
from msaa_lint.frame.facts.pass_begin import MAX_USES, targets_at, uses_at_most

_NEEDS = {
    "resolveImage": {"srcImage": "TRANSFER_SRC", "dstImage": "TRANSFER_DST"},
    "copyImage": {"srcImage": "TRANSFER_SRC", "dstImage": "TRANSFER_DST"},
    "blitImage": {"srcImage": "TRANSFER_SRC", "dstImage": "TRANSFER_DST"},
    "copyImageToBuffer": {"srcImage": "TRANSFER_SRC"},
    "copyBufferToImage": {"dstImage": "TRANSFER_DST"},
    "clearColorImage": {"image": "TRANSFER_DST"},
    "clearDepthStencilImage": {"image": "TRANSFER_DST"},
    "readImage": {"image": "SAMPLED"},
    "writeImage": {"image": "STORAGE"},
}

TOLD_BY_COMMANDS = frozenset({"TRANSFER_SRC", "TRANSFER_DST", "SAMPLED", "STORAGE"})
"""Usages of which the commands show whether something needs them."""


class Usages:
    """What the commands of a frame do with its images."""

    def __init__(self, frame: Frame) -> None:
        self._needs: dict[str, Counter[str]] = {}
        self._named: dict[str, list[int]] = {}
        self.barred: set[str] = set()
        """The images that a barrier names."""
        self.followed = uses_at_most(frame) <= MAX_USES
        """False where there are more uses than are followed."""
        self.positions: dict[int, int] = {}
        """Where a command stands, by the identity of its parameters."""
        begins = {position: each for each in frame.passes for position in each.begun}
        for position, command in enumerate(frame.commands if self.followed else ()):
            self.positions[id(command.body)] = position
            names = set(_named(command))
            if command.kind == "pipelineBarrier":
                self.barred |= names
            if position in begins:
                rendered = begins[position].attachments
                names.update(target.name for attachment in rendered for target in targets_at(frame, attachment, position))
            for name in names:
                self._named.setdefault(name, []).append(position)
            for name, usage in _needs(command):
                self._needs.setdefault(name, Counter())[usage] += 1

    def needed(self, name: str, without: Command | None = None) -> set[str]:
        """The usages that the commands, one left out, need of an image. A read may be of a sampled or of a storage image."""
        counts = Counter(self._needs.get(name, {}))
        counts.subtract(usage for image, usage in (_needs(without) if without is not None else ()) if image == name)
        return {usage for usage, count in counts.items() if count > 0}

    def next_named(self, name: str, position: int) -> int | None:
        """The first command after a position that has to do with an image."""
        at = self._named.get(name, [])
        first = bisect_right(at, position)
        return at[first] if first < len(at) else None

    def named_between(self, name: str, start: int, end: int) -> bool:
        """Whether a command from one position up to another has to do with an image."""
        at = self._named.get(name, [])
        first = bisect_left(at, start)
        return first < len(at) and at[first] < end


def _needs(command: Command) -> Iterator[tuple[str, str]]:
    for member, usage in _NEEDS.get(command.kind, {}).items():
        name = getattr(command.body, member, None)
        if isinstance(name, str):
            yield name, usage
            if command.kind == "readImage":
                yield name, "STORAGE"


def _named(command: Command) -> Iterator[str]:
    body = command.body
    infos = [*getattr(body, "colorAttachments", ()), getattr(body, "depthAttachment", None), getattr(body, "stencilAttachment", None)]
    for record in (body, *infos):
        for member in ("image", "srcImage", "dstImage", "resolveImage"):
            name = getattr(record, member, None) if isinstance(record, Record) else None
            if isinstance(name, str):
                yield name
    for image in getattr(body, "images", ()):
        name = image.image if isinstance(image, ImageBarrier) else image
        if isinstance(name, str):
            yield name
