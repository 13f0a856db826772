"""The images in descriptor sets that the draws and dispatches of a frame may read."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from .call import Call
from .command_buffers import (
    PASS_BEGINS,
    CommandCache,
    DescriptorReads,
    RecordedCommand,
    RenderPassBegin,
)
from .layouts import CHANGING, ImageLayouts, command_layouts
from .objects import DescriptorSet, Image, ImageKind, ReadableBindings, images_in

BOUNDARIES = (*PASS_BEGINS, "nextSubpass", "endRenderPass", "endRendering")
"""Commands that begin or end a pass or subpass."""

MAX_READERS = 8
"""Maximum number of subpasses that are described as readers of an image through sets, from one
write to the next, by stage.
"""

_WRITERS = frozenset(
    ("clearColorImage", "clearDepthStencilImage", "copyBufferToImage", "writeImage", *PASS_BEGINS)
)
_TRANSFERS = frozenset(("resolveImage", "copyImage", "blitImage"))


EVERY_KIND = tuple(
    (written, multisampled) for written in (False, True) for multisampled in (False, True)
)


UnknownKinds = tuple[tuple[ImageKind, ...], str | None]
"""Kinds of image that unknown descriptors may hold in a layout, None for any."""


class _SetState:
    """What a frame has read of a set in a stage: the section of its last read, and how much of the
    set's and the frame's logs it covers.
    """

    __slots__ = ("epoch", "logged", "pending", "section", "written")

    def __init__(self, epoch: int) -> None:
        self.epoch = epoch
        self.logged = 0
        self.written = 0
        self.section = -1
        self.pending: dict[tuple[Image, bool], None] = {}
        """The images that have fewer than MAX_READERS readers."""


class SetReads:
    """The reads of one frame. `spend` is told how many images are looked at, and says whether that
    is enough.

    A set of many images may be bound in many passes, so a set is not looked through again for each
    of them: of one that was read before, only what was written since, and what has few readers yet.
    """

    def __init__(self, spend: Callable[[int], bool]) -> None:
        self._spend = spend
        self._states: dict[tuple[DescriptorSet, ReadableBindings | None, str], _SetState] = {}
        self._written: list[Image] = []
        self._readers: dict[Image, dict[tuple[str, str], tuple[int, int]]] = {}
        """By image, then by command and stage: the number of reads since the last write, and the
        section of the last one.
        """
        self._section = 0
        self._unknown: dict[
            tuple[DescriptorSet, ReadableBindings | None], tuple[int, list[UnknownKinds]]
        ] = {}
        """By set and what a pipeline can read of it: the number of updates of the set, and what its
        unknown descriptors may hold.
        """
        self._attachments: frozenset[Image] = frozenset()
        """The attachments of the current pass that shaders cannot read during it."""

    def resolve(
        self, commands: list[RecordedCommand], cache: CommandCache, layouts: ImageLayouts
    ) -> list[RecordedCommand] | None:
        """The commands of a submission, with descriptor sets replaced by reads of the images that
        they hold now.

        None if that takes too long. `layouts` follows the commands, and marks the images that
        unknown descriptors may hold.
        """
        resolved: list[RecordedCommand] = []
        self._section += 1
        for command in commands:
            key: Any = command.key
            if isinstance(key, DescriptorReads):
                at = Call(command.by, {}, command.at)
                for descriptors, bindings in key.sets:
                    if descriptors.opaque or descriptors.unknown:
                        for kinds, layout in self._unknown_kinds(descriptors, bindings):
                            layouts.mark(kinds, layout)
                    reads = self._reads(descriptors, bindings, key.stage)
                    if reads is None:
                        return None
                    for kind, image in reads:
                        resolved.append(cache.command(kind, (image, key.stage), at))
                continue
            if command.kind in BOUNDARIES:
                self._section += 1
                if command.kind != "nextSubpass":
                    self._attachments = (
                        command_layouts(command).unreadable
                        if command.kind in PASS_BEGINS
                        else frozenset()
                    )
            if command.kind in CHANGING:
                layouts.apply(layouts.changes(command))
            if command.kind in _WRITERS or command.kind in _TRANSFERS:
                self._write(command)
            resolved.append(command)
        return resolved

    def _unknown_kinds(
        self, descriptors: DescriptorSet, bindings: ReadableBindings | None
    ) -> list[UnknownKinds]:
        """What the descriptors of a set whose contents are unknown may hold, as far as a pipeline
        can read them.
        """
        if descriptors.opaque:
            return [(bindings.of_all if bindings is not None else EVERY_KIND, None)]
        updates, found = self._unknown.get((descriptors, bindings), (-1, []))
        if updates != descriptors.updates:
            self._spend(len(descriptors.unknown))
            by_layout: dict[str | None, dict[ImageKind, None]] = {}
            for binding, unknown in descriptors.unknown.items():
                kinds = EVERY_KIND if bindings is None else bindings.kinds.get(binding, ())
                for layout in (None,) if unknown.layouts is None else unknown.layouts:
                    by_layout.setdefault(layout, {}).update(
                        (kind, None) for kind in kinds if kind[0] in unknown.storage
                    )
            found = [(tuple(kinds), layout) for layout, kinds in by_layout.items() if kinds]
            self._unknown[descriptors, bindings] = descriptors.updates, found
        return found

    def _write(self, command: RecordedCommand) -> None:
        if command.written is None:
            key: Any = command.key
            images = (
                key.images
                if isinstance(key, RenderPassBegin)
                else (key[1],)
                if command.kind in _TRANSFERS
                else images_in(key)
            )
            command.written = tuple(images)
        for image in command.written:
            if image is not None and self._readers.pop(image, None) is not None:
                self._written.append(image)

    def _reads(
        self, descriptors: DescriptorSet, bindings: ReadableBindings | None, stage: str
    ) -> list[tuple[str, Image]] | None:
        """The reads and writes of a set's images that the frame does not have yet; None if too many
        images have been looked at.
        """
        key = (descriptors, bindings, stage)
        state = self._states.get(key)
        if state is None or state.epoch != descriptors.epoch:
            state = self._states[key] = _SetState(descriptors.epoch)
        new = dict.fromkeys(descriptors.log[state.logged :])
        for image in self._written[state.written :]:
            new.update(
                (use, None) for use in ((image, False), (image, True)) if use in descriptors.uses
            )
        work = len(descriptors.log) - state.logged + len(self._written) - state.written
        state.logged, state.written = len(descriptors.log), len(self._written)
        if state.section != self._section:
            new = {**state.pending, **new}
            work += len(new)
            state.pending = {}
            state.section = self._section
        if not self._spend(work):
            return None
        reads: list[tuple[str, Image]] = []
        for use in new:
            slots = descriptors.uses.get(use)
            if slots is None:
                continue
            image, storage = use
            if bindings is not None:
                self._spend(min(len(slots), len(bindings.kinds)))
                if not bindings.accept(slots, (storage, image.samples > 1)):
                    continue
            if image in self._attachments:
                state.pending[use] = None
                continue
            readers = self._readers.setdefault(image, {})
            for kind in ("readImage", "writeImage") if storage else ("readImage",):
                count, section = readers.get((kind, stage), (0, -1))
                if section != self._section and count < MAX_READERS:
                    readers[kind, stage] = count + 1, self._section
                    reads.append((kind, image))
            if readers["readImage", stage][0] < MAX_READERS:
                state.pending[use] = None
        return reads
