"""Who reads what a pass stored: the uses of every image in the order of the frame, the frame being a loop.

Where the description records commands, they are the order, and only they read. Where it does not, every pass runs once, in order, and what
a stated usage allows is taken as done. A pass that the commands never begin is judged by itself.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from ..document.records import BeginRendering
from .frame import RENDERING, Aspect, Attachment, Frame, Pass, Target

READ = "read"
OVERWRITTEN = "overwritten"
UNKNOWN = "unknown"

READING_USAGES = frozenset({"SAMPLED", "STORAGE", "INPUT_ATTACHMENT", "TRANSFER_SRC"})
_READ_FROM = {
    "readImage": "image", "present": "image", "resolveImage": "srcImage", "copyImage": "srcImage", "blitImage": "srcImage",
    "copyImageToBuffer": "srcImage",
}  # fmt: skip
_OVERWRITES = {"clearColorImage": "image", "clearDepthStencilImage": "image", "resolveImage": "dstImage"}


class Use(NamedTuple):
    """One use of an image: at which position of the frame, of which aspect (None: of all), and what it does to what was there."""

    position: int
    aspect: str | None
    kind: str


class Timeline:
    """The uses of a frame's images."""

    def __init__(self, frame: Frame) -> None:
        self.frame = frame
        self.uses: dict[str, list[Use]] = {}
        self.positions: dict[str, list[int]] = {}
        """Where each pass, by its path, begins."""
        order = self._recorded() if frame.has_commands else self._once_each()
        for name, use in order:
            self.uses.setdefault(name, []).append(use)

    def _once_each(self) -> Iterator[tuple[str, Use]]:
        for position, each in enumerate(self.frame.passes):
            self.positions[each.path] = [position]
            yield from _begun(each, position)

    def _recorded(self) -> Iterator[tuple[str, Use]]:
        begins = {position: each for each in self.frame.passes for position in each.begun}
        for each in self.frame.passes:
            self.positions[each.path] = each.begun
        for position, command in enumerate(self.frame.commands):
            if position in begins:
                yield from _begun(begins[position], position)
            read = getattr(command.body, _READ_FROM.get(command.kind, "-"), None)
            if isinstance(read, str):
                yield read, Use(position, None, READ)
            overwritten = getattr(command.body, _OVERWRITES.get(command.kind, "-"), None)
            if isinstance(overwritten, str):
                yield overwritten, Use(position, None, OVERWRITTEN)

    def after(self, target: str, aspect: str | None, position: int) -> str | None:
        """What first happens to an image after a position, round the loop; None where nothing does."""
        uses = self.uses.get(target, [])
        later = [use for use in uses if use.position > position]
        earlier = [use for use in uses if use.position <= position]
        for use in [*later, *earlier]:
            if use.aspect is None or aspect is None or use.aspect == aspect:
                return use.kind
        return None

    def read_later(self, each: Pass, attachment: Attachment, aspect: Aspect) -> bool | None:
        """Whether anything reads what the pass stored of an aspect; None where the description does not say."""
        if attachment.input:
            return True
        answers: list[bool | None] = []
        for target in attachment.targets:
            answers.extend(self._answers(each, aspect, target))
        if not answers or any(answers):
            return True if answers else None
        return None if None in answers else False

    def _answers(self, each: Pass, aspect: Aspect, target: Target) -> Iterator[bool | None]:
        recorded = self.frame.has_commands and bool(each.begun)
        if target.image is None:
            # Nothing else of the description can name it: only its own load in the next frame shows.
            yield True if aspect.load == "LOAD" else None
            return
        if self.frame.has_commands and not recorded:
            yield True if aspect.load == "LOAD" else _usage_reads(target)
            return
        for position in self.positions.get(each.path, []):
            follows = self.after(target.name, aspect.name, position)
            if follows == READ:
                yield True
            elif follows == UNKNOWN:
                yield None
            elif recorded:
                yield False
            else:
                yield True if target.image.presentable else _usage_reads(target)


def _usage_reads(target: Target) -> bool | None:
    """What the usage alone says of readers."""
    if target.image is None or target.image.usage is None:
        return None
    return not READING_USAGES.isdisjoint(target.image.usage)


def _begun(each: Pass, position: int) -> Iterator[tuple[str, Use]]:
    """The uses that beginning a pass makes of its attachments' images."""
    resumes = each.kind == RENDERING and isinstance(each.record, BeginRendering) and "RESUMING" in each.record.flags
    for attachment in each.attachments:
        if not attachment.used:
            continue
        overwritten = {aspect for aspects in attachment.resolve.values() for aspect in aspects}
        for aspect in attachment.aspects:
            if aspect.load == "LOAD" or resumes:
                kind = READ
            elif aspect.load is None and aspect.name not in overwritten:
                kind = UNKNOWN
            elif aspect.load in ("CLEAR", "DONT_CARE") or aspect.name in overwritten:
                # A smaller render area leaves the rest of the image as it was.
                if each.partial_area:
                    continue
                kind = OVERWRITTEN
            else:
                continue
            for target in attachment.targets:
                if target.image is not None:
                    yield target.name, Use(position, aspect.name, kind)
    for subpass in each.subpasses:
        for resolve in subpass.resolves:
            if each.kind == RENDERING and resolve.target_image is not None and resolve.mode not in (None, "NONE") and not each.partial_area:
                yield resolve.target_image.name, Use(position, resolve.aspect, OVERWRITTEN)
