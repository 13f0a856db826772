"""What happens to every image in the order of the frame, the frame being a loop: who begins with what, writes, reads, and leaves what.

`timeline` asks who reads; here every moment is kept, so that what comes before and after one can be told.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from msaa_lint.frame.description.models import BeginRendering, BeginRenderPass, Command, ImageBarrier

from .frame import RENDERING, Aspect, Attachment, Frame, Pass, Target
from .moment import (
    BEGUN,
    CLEARED,
    COPIED,
    DISCARDED,
    ELSEWHERE,
    LOADED,
    MAX_FRAMES,
    READ,
    RESOLVED,
    STORED,
    UNKNOWN,
    WRITTEN,
    Line,
    Moment,
    Turns,
)
from .pass_begin import MAX_USES, covers, one_surface, targets_at, uses_at_most

_READ_FROM = {
    "readImage": "image", "present": "image", "resolveImage": "srcImage", "copyImage": "srcImage", "blitImage": "srcImage",
    "copyImageToBuffer": "srcImage",
}  # fmt: skip
_WRITES = {
    "clearColorImage": ("image", CLEARED), "clearDepthStencilImage": ("image", CLEARED), "resolveImage": ("dstImage", COPIED),
    "copyImage": ("dstImage", COPIED), "blitImage": ("dstImage", COPIED), "copyBufferToImage": ("dstImage", COPIED),
    "writeImage": ("image", WRITTEN),
}  # fmt: skip
_WHOLE = ("clearColorImage", "clearDepthStencilImage", "resolveImage")
ENDS = ("endRenderPass", "endRendering")


class Bound(NamedTuple):
    """An image of an attachment, its turns, whether those are known, and whether the pass writes to all of it."""

    target: Target
    turns: Turns | None
    sure: bool
    whole: bool


class Moments:
    """The moments of a frame's images."""

    __slots__ = ("_covered", "_idle", "_lines", "_order", "_unwritten", "followed", "frame", "presents", "writes")

    def __init__(self, frame: Frame) -> None:
        self.frame = frame
        self._order: dict[str, list[Moment]] = {}
        self._lines: dict[tuple[str, str], Line] = {}
        self._idle: set[str] = set()
        self._covered: dict[str, bool] = {}
        self._unwritten: set[object] | None = None
        kinds = {command.kind for command in frame.commands}
        self.presents = "present" in kinds
        """Whether the commands go on to where a picture is shown."""
        self.writes = not kinds.isdisjoint(_WRITES)
        """Whether commands outside of passes write to images."""
        self.followed = uses_at_most(frame) <= MAX_USES and frame.document.ordered
        """False where there are more uses than are followed, or their order is not known."""
        if not self.followed:
            return
        for name, moment in self._recorded() if frame.has_commands else self._once_each():
            self._order.setdefault(name, []).append(moment)

    def line(self, image: str, aspect: str) -> Line:
        """What happens to one aspect of an image."""
        key = (image, aspect)
        if key not in self._lines:
            self._lines[key] = Line([m for m in self._order.get(image, ()) if m.aspect is None or m.aspect == aspect])
        return self._lines[key]

    def read_when_idle(self, image: str) -> bool:
        """Whether a pass that the commands never begin would read it."""
        return image in self._idle

    def has_twin(self, target: Target) -> bool:
        """Whether the frame reads an image of the same format, samples and size that it never writes."""
        if self._unwritten is None:
            order = self._order.items()
            read = [name for name, moments in order if all(moment.kind in (READ, LOADED) for moment in moments)]
            self._unwritten = {_kind(self.frame.targets[name]) for name in read if name in self.frame.targets}
        return _kind(target) in self._unwritten

    def _once_each(self) -> Iterator[tuple[str, Moment]]:
        for each in self.frame.passes:
            yield from self._begins(each, None)
            yield from self._ends(each, None)

    def _recorded(self) -> Iterator[tuple[str, Moment]]:
        begins = {position: each for each in self.frame.passes for position in each.begun}
        for each in self.frame.passes:
            if not each.begun:
                loading = [a for a in each.attachments if a.input or any(aspect.load in ("LOAD", None) for aspect in a.aspects)]
                self._idle.update(target.name for attachment in loading for target in attachment.targets)
        current: tuple[Pass, int] | None = None
        suspended: Pass | None = None
        for position, command in enumerate(self.frame.commands):
            if current is not None and (position in begins or command.kind in ENDS):
                yield from self._ends(*current)
                suspended = current[0] if "SUSPENDING" in flags_of(current[0]) else None
                current = None
            if position in begins:
                current = (begins[position], position)
                resumes = "RESUMING" in flags_of(current[0])
                if resumes != (suspended is not None):
                    yield from _elsewhere(suspended or current[0])
                suspended = None
                yield from self._begins(*current)
            else:
                yield from self._command(command)
        if current is not None:
            yield from self._ends(*current)
            suspended = current[0] if "SUSPENDING" in flags_of(current[0]) else None
        if suspended is not None:
            yield from _elsewhere(suspended)

    def _begins(self, each: Pass, begin: int | None) -> Iterator[tuple[str, Moment]]:
        self._covered = {}
        if "RESUMING" in flags_of(each):
            return
        for attachment, aspect, bound in self._used(each, begin):
            kind = _begins_with(aspect) if bound.sure else UNKNOWN
            if kind is not None:
                yield bound.target.name, Moment(kind, aspect.name, bound.whole, attachment, each, aspect.load_member, bound.turns)

    def _ends(self, each: Pass, begin: int | None) -> Iterator[tuple[str, Moment]]:
        if "SUSPENDING" in flags_of(each):
            return
        for attachment, aspect, bound in self._used(each, begin):
            kind = _ends_with(attachment, aspect) if bound.sure else UNKNOWN
            if kind is not None:
                yield bound.target.name, Moment(kind, aspect.name, bound.whole, attachment, each, aspect.store_member, bound.turns)
        for resolve in each.subpasses[0].resolves if each.kind == RENDERING else ():
            resolved = resolve.target_image
            if resolved is not None and resolve.mode != "NONE":
                kind = RESOLVED if resolve.mode is not None else UNKNOWN
                whole = self._covers(each, begin, resolved)
                yield resolved.name, Moment(kind, resolve.aspect, whole, resolve, each)

    def _used(self, each: Pass, begin: int | None) -> Iterator[tuple[Attachment, Aspect, Bound]]:
        """The aspects of the attachments that a pass uses, with each of their images."""
        for attachment in each.attachments:
            if not attachment.used:
                continue
            for target, turns, sure in self._bound(attachment, begin):
                bound = Bound(target, turns, sure, sure and self._covers(each, begin, target))
                for aspect in attachment.aspects:
                    yield attachment, aspect, bound

    def _covers(self, each: Pass, begin: int | None, target: Target) -> bool:
        """Whether the pass that was begun last writes to all of an image."""
        if target.name not in self._covered:
            self._covered[target.name] = covers(self.frame, each, begin, target)
        return self._covered[target.name]

    def _bound(self, attachment: Attachment, begin: int | None) -> Iterator[tuple[Target, Turns | None, bool]]:
        """The images of an attachment, each with its turns, and whether those are known."""
        targets = [target for target in targets_at(self.frame, attachment, begin) if target.image is not None]
        if len(targets) <= 1:
            yield from ((target, None, True) for target in targets)
            return
        body = self.frame.commands[begin].body if begin is not None else None
        names = body.framebuffer if isinstance(body, BeginRenderPass) else None
        turns: dict[str, set[int]] = {}
        if isinstance(names, tuple) and len(names) <= MAX_FRAMES:
            for frame, name in enumerate(names):
                buffer = self.frame.description.framebuffers.get(name)
                images = buffer.attachments if buffer is not None else ()
                image = images[attachment.index] if attachment.index < len(images) else None
                if image is not None:
                    turns.setdefault(image, set()).add(frame)
        for target in targets:
            own = turns.get(target.name)
            yield target, (len(names), frozenset(own)) if own and names is not None else None, own is not None

    def _command(self, command: Command) -> Iterator[tuple[str, Moment]]:
        read = getattr(command.body, _READ_FROM.get(command.kind, "-"), None)
        if isinstance(read, str):
            yield read, Moment(READ, None, False, command)
        if command.kind in _WRITES:
            member, kind = _WRITES[command.kind]
            written = getattr(command.body, member, None)
            if isinstance(written, str):
                whole = command.kind in _WHOLE and self.plain(written) and not self._smaller(read, written)
                yield written, Moment(kind, None, whole, command)
        elif command.kind == "pipelineBarrier":
            for image in getattr(command.body, "images", ()):
                if isinstance(image, ImageBarrier) and image.oldLayout == "UNDEFINED" and image.image is not None:
                    whole = self.plain(image.image)
                    yield image.image, Moment(DISCARDED if whole else UNKNOWN, None, whole, image)

    def _smaller(self, source: object, written: str) -> bool:
        """Whether an image is known to differ in size from the one that is written from it."""
        images = [self.frame.targets[name].image for name in (source, written) if isinstance(name, str) and name in self.frame.targets]
        extents = [image.extent for image in images if image is not None and image.extent is not None]
        return len(extents) == 2 and (extents[0].width, extents[0].height) != (extents[1].width, extents[1].height)

    def plain(self, name: str) -> bool:
        """Whether a command that names an image and no part of it means all of it: one level, layer and aspect."""
        target = self.frame.target(name)
        if target is None or not one_surface(target.image):
            return False
        return target.format is not None and len(target.format.aspects) == 1


def _kind(target: Target) -> object:
    """What two images have alike that take turns."""
    extent = target.image.extent if target.image is not None else None
    return target.format, target.samples, (extent.width, extent.height) if extent is not None else None


def _elsewhere(each: Pass) -> Iterator[tuple[str, Moment]]:
    """What happens to a rendering's images in a part of it that is not described."""
    for attachment in each.attachments:
        for target in attachment.targets:
            for aspect in attachment.aspects:
                yield target.name, Moment(ELSEWHERE, aspect.name, False, attachment, each, aspect.load_member)


def flags_of(each: Pass) -> tuple[str, ...]:
    """The flags of a rendering."""
    return each.record.flags if isinstance(each.record, BeginRendering) else ()


def _begins_with(aspect: Aspect) -> str | None:
    if aspect.load == "LOAD":
        return LOADED
    if aspect.load in ("CLEAR", "DONT_CARE"):
        return BEGUN
    if aspect.load is None:
        return UNKNOWN
    return None


def _ends_with(attachment: Attachment, aspect: Aspect) -> str | None:
    if aspect.store == "STORE":
        return STORED
    if aspect.store == "DONT_CARE":
        return DISCARDED
    if aspect.store is None:
        return UNKNOWN
    # NONE keeps what was in memory: of what the pass overwrote as it began, nothing is left.
    if aspect.load in ("CLEAR", "DONT_CARE"):
        return DISCARDED
    return UNKNOWN if attachment.drawn or attachment.resolve else None
