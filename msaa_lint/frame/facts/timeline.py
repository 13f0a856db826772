"""Who reads what a pass stored: the uses of every image in the order of the frame, the frame being a loop.

Where the description records commands, they are the order, and only they read. Where it does not, every pass runs once, in order, and what
a stated usage allows is taken as done. A pass that the commands never begin is judged by itself.
"""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Iterator
from typing import NamedTuple

from msaa_lint.core.text.span import Span
from msaa_lint.frame.description.models import BeginRendering

from .frame import RENDERING, Aspect, Attachment, Frame, Pass, Resolve, Target
from .pass_begin import MAX_USES, covers, one_surface, targets_at, uses_at_most

READ = "read"
OVERWRITTEN = "overwritten"
UNKNOWN = "unknown"

READING_USAGES = frozenset({"SAMPLED", "STORAGE", "INPUT_ATTACHMENT", "TRANSFER_SRC"})
_READ_FROM = {
    "readImage": "image", "present": "image", "resolveImage": "srcImage", "copyImage": "srcImage", "blitImage": "srcImage",
    "copyImageToBuffer": "srcImage",
}  # fmt: skip
_OVERWRITES = {"clearColorImage": "image", "clearDepthStencilImage": "image", "resolveImage": "dstImage"}
# What these write need not be all of the image, so that it does not end what was there; but who loads next may load what they wrote.
_WRITES = {**_OVERWRITES, "copyImage": "dstImage", "blitImage": "dstImage", "writeImage": "image"}


class Use(NamedTuple):
    """One use of an image: at which position of the frame, of which aspect (None: of all), and what it does to what was there."""

    position: int
    aspect: str | None
    kind: str


class Store(NamedTuple):
    """What was last done to the contents of an image: at which position, to which aspect, and the pass that stored it, with the place.

    `by` is None where something else wrote it, or a pass drew to it and did not store.
    """

    position: int
    aspect: str | None
    by: Pass | None
    at: Span | None


class Timeline:
    """The uses of a frame's images."""

    def __init__(self, frame: Frame) -> None:
        self.frame = frame
        self.uses: dict[str, list[Use]] = {}
        self.positions: dict[str, list[int]] = {}
        """Where each pass, by its path, begins."""
        self.followed: bool
        """False where there are more uses than are followed: who reads is then unknown."""
        self._stores: dict[str, list[Store]] = {}
        self._read: set[tuple[str, str | None]] = set()
        self._uses_of: dict[tuple[str, str | None], tuple[list[int], list[Use]]] = {}
        self._stores_of: dict[tuple[str, str | None], tuple[list[int], list[Store]]] = {}
        self.followed = uses_at_most(frame) <= MAX_USES
        order = self._recorded() if frame.has_commands else self._once_each()
        for name, use in order if self.followed else ():
            self.uses.setdefault(name, []).append(use)
            if use.kind == READ:
                self._read.add((name, use.aspect))

    def _once_each(self) -> Iterator[tuple[str, Use]]:
        for position, each in enumerate(self.frame.passes):
            self.positions[each.path] = [position]
            self._stored(each, position, None)
            yield from self._uses(each, position, None)

    def _recorded(self) -> Iterator[tuple[str, Use]]:
        begins = {position: each for each in self.frame.passes for position in each.begun}
        for each in self.frame.passes:
            self.positions[each.path] = each.begun
            if not each.begun:
                self._read.update((name, use.aspect) for name, use in self._uses(each, 0, None) if use.kind == READ)
        for position, command in enumerate(self.frame.commands):
            if position in begins:
                self._stored(begins[position], position, position)
                yield from self._uses(begins[position], position, position)
            read = getattr(command.body, _READ_FROM.get(command.kind, "-"), None)
            if isinstance(read, str):
                yield read, Use(position, None, READ)
            written = getattr(command.body, _WRITES.get(command.kind, "-"), None)
            if isinstance(written, str):
                self._note(written, Store(position, None, None, None))
                if command.kind in _OVERWRITES and self._whole(written, command.kind):
                    yield written, Use(position, None, OVERWRITTEN)

    def _whole(self, name: str, command: str) -> bool:
        """Whether a command that names an image and no part of it is taken to write all of it."""
        target = self.frame.target(name)
        if target is None or not one_surface(target.image):
            return False
        # Depth and stencil may be cleared apart.
        return command != "clearDepthStencilImage" or (target.format is not None and len(target.format.aspects) == 1)

    def _note(self, name: str, store: Store) -> None:
        self._stores.setdefault(name, []).append(store)

    def _stored(self, each: Pass, position: int, begin: int | None) -> None:
        """Notes what a pass leaves in its attachments' images."""
        for attachment in each.attachments:
            for aspect in attachment.aspects:
                stored = aspect.store == "STORE" and attachment.used
                if stored or attachment.drawn or attachment.resolve:
                    by, at = (each, attachment.record.place(aspect.store_member)) if stored else (None, None)
                    for target in targets_at(self.frame, attachment, begin):
                        self._note(target.name, Store(position, aspect.name, by, at))
        for resolve in _rendering_resolves(each):
            if resolve.target_image is not None:
                self._note(resolve.target_image.name, Store(position, resolve.aspect, each, resolve.target_at))

    def _uses(self, each: Pass, position: int, begin: int | None) -> Iterator[tuple[str, Use]]:
        """The uses that a pass makes of its attachments' images, where the command at `begin` begins it."""
        resumes = "RESUMING" in _flags(each)
        for attachment in each.attachments:
            if not attachment.used:
                continue
            targets = [target for target in targets_at(self.frame, attachment, begin) if target.image is not None]
            over = {aspect for aspects in attachment.resolve.values() for aspect in aspects}
            for aspect in attachment.aspects:
                kind = READ if resumes else _effect(attachment, aspect, over)
                for target in targets:
                    # Of images that alternate from frame to frame, each is left as it was in every other frame.
                    if kind is not None and (kind != OVERWRITTEN or (len(targets) == 1 and covers(self.frame, each, begin, target))):
                        yield target.name, Use(position, aspect.name, kind)
        for resolve in _rendering_resolves(each):
            if resolve.target_image is not None and covers(self.frame, each, begin, resolve.target_image):
                yield resolve.target_image.name, Use(position, resolve.aspect, OVERWRITTEN)

    def after(self, target: str, aspect: str | None, position: int) -> str | None:
        """What first happens to an image after a position, round the loop; None where nothing does.

        Where the order of the passes is not known, what any of them does that spares the contents most.
        """
        key = (target, aspect)
        if key not in self._uses_of:
            uses = [use for use in self.uses.get(target, []) if _same(use.aspect, aspect)]
            self._uses_of[key] = ([use.position for use in uses], uses)
        positions, uses = self._uses_of[key]
        if uses and not self.frame.document.ordered:
            kinds = {use.kind for use in uses}
            return READ if READ in kinds else UNKNOWN if UNKNOWN in kinds else OVERWRITTEN
        return uses[bisect_right(positions, position) % len(uses)].kind if uses else None

    def stored_before(self, each: Pass, attachment: Attachment, aspect: Aspect) -> Store | None:
        """Which pass stored what an attachment loads, round the loop; None where none did, or where that differs from time to time."""
        positions = self.positions.get(each.path, [])
        if aspect.load != "LOAD" or len(positions) != 1 or attachment.target is None or "RESUMING" in _flags(each):
            return None
        key = (attachment.target.name, aspect.name)
        if key not in self._stores_of:
            stores = [store for store in self._stores.get(key[0], []) if _same(store.aspect, aspect.name)]
            self._stores_of[key] = ([store.position for store in stores], stores)
        before, stores = self._stores_of[key]
        last = stores[bisect_left(before, positions[0]) - 1] if stores else None
        return last if last is not None and last.by is not None else None

    def read_later(self, each: Pass, attachment: Attachment, aspect: Aspect) -> bool | None:
        """Whether anything reads what the pass stored of an aspect; None where the description does not say."""
        if attachment.input or "SUSPENDING" in _flags(each):
            # What a suspended rendering draws is stored by the one that resumes and ends it.
            return True
        if not self.followed:
            return None
        answers = set(self._answers(each, attachment, aspect))
        if not answers or True in answers:
            return True if answers else None
        return None if None in answers else False

    def _answers(self, each: Pass, attachment: Attachment, aspect: Aspect) -> Iterator[bool | None]:
        if self.frame.has_commands and not each.begun:
            for target in attachment.targets:
                yield True if aspect.load == "LOAD" else self._read_as_stated(target, aspect)
            return
        for position in self.positions.get(each.path, []):
            begin = position if self.frame.has_commands else None
            for target in targets_at(self.frame, attachment, begin):
                if target.image is None:
                    # Nothing else of the description can name it: only its own load in the next frame shows.
                    yield True if aspect.load == "LOAD" or self._may_be_loaded(aspect) else None
                    continue
                follows = self.after(target.name, aspect.name, position)
                if follows == READ:
                    yield True
                elif follows == UNKNOWN:
                    yield None
                elif begin is not None:
                    yield False
                else:
                    yield True if target.image.presentable else _usage_reads(target)

    def _may_be_loaded(self, aspect: Aspect) -> bool:
        """Where the order is not known: whether some pass loads the aspect of a multisampled image that is not known either."""
        if self.frame.document.ordered:
            return False
        return any(
            a.samples != 1 and any(each.load == "LOAD" and _same(each.name, aspect.name) for each in a.aspects)
            for within in self.frame.passes
            for a in within.attachments
            if a.target is not None and a.target.image is None and a.used
        )

    def _read_as_stated(self, target: Target, aspect: Aspect) -> bool | None:
        """Whether what a pass that is never begun stores has a reader: its usage allows one, or something that is described reads."""
        if target.image is None:
            return None
        aspects = (None, aspect.name) if aspect.name is not None else (None, "color", "depth", "stencil")
        return True if any((target.name, name) in self._read for name in aspects) else _usage_reads(target)


def _same(one: str | None, other: str | None) -> bool:
    """Whether two aspects are one, or may be: None is all, or an unknown one."""
    return one is None or other is None or one == other


def _flags(each: Pass) -> tuple[str, ...]:
    return each.record.flags if isinstance(each.record, BeginRendering) else ()


def _rendering_resolves(each: Pass) -> list[Resolve]:
    """The resolves at the end of a rendering; one that is suspended has not ended."""
    if each.kind != RENDERING or "SUSPENDING" in _flags(each):
        return []
    return [resolve for resolve in each.subpasses[0].resolves if resolve.mode not in (None, "NONE")]


def _effect(attachment: Attachment, aspect: Aspect, over: set[str]) -> str | None:
    """What a pass does to what was in an aspect of an image; None where nothing, or nothing that is known to matter."""
    if aspect.load == "LOAD":
        return READ
    if aspect.load in ("CLEAR", "DONT_CARE") or aspect.name in over:
        return OVERWRITTEN
    if aspect.load is None:
        return UNKNOWN if attachment.drawn or attachment.resolve else READ
    return None


def _usage_reads(target: Target) -> bool | None:
    """What the usage alone says of readers."""
    if target.image is None or target.image.usage is None:
        return None
    return not READING_USAGES.isdisjoint(target.image.usage)
