"""The images in descriptor sets that the draws and dispatches of a frame may read."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from .call import Call
from .command_buffers import PASS_BEGINS, CommandCache, DescriptorReads, RecordedCommand, RenderPassBegin
from .objects import DescriptorSet, Image, images_in

BOUNDARIES = (*PASS_BEGINS, "nextSubpass", "endRenderPass", "endRendering")
"""Commands that begin or end a pass or subpass."""

MAX_READERS = 8
"""Maximum number of subpasses that are described as readers of an image through sets, from one write to the next, by stage."""

_WRITERS = frozenset(("clearColorImage", "clearDepthStencilImage", "copyBufferToImage", "writeImage", *PASS_BEGINS))
_TRANSFERS = frozenset(("resolveImage", "copyImage", "blitImage"))


class _SetState:
    """What a frame has read of a set in a stage: the section of its last read, and how much of the set's and the frame's logs it covers."""

    __slots__ = ("epoch", "logged", "pending", "section", "written")

    def __init__(self, epoch: int) -> None:
        self.epoch = epoch
        self.logged = 0
        self.written = 0
        self.section = -1
        self.pending: dict[tuple[Image, bool], None] = {}
        """The images that have fewer than MAX_READERS readers."""


class SetReads:
    """The reads of one frame. `spend` is told how many images are looked at, and says whether that is enough.

    A set of many images may be bound in many passes, so a set is not looked through again for each of them: of one that was read before,
    only what was written since, and what has few readers yet.
    """

    def __init__(self, spend: Callable[[int], bool]) -> None:
        self._spend = spend
        self._states: dict[tuple[DescriptorSet, str], _SetState] = {}
        self._written: list[Image] = []
        self._readers: dict[Image, dict[tuple[str, str], tuple[int, int]]] = {}
        """By image, then by command and stage: the number of reads since the last write, and the section of the last one."""
        self._section = 0

    def resolve(self, commands: list[RecordedCommand], cache: CommandCache, unknown: DescriptorSet) -> list[RecordedCommand] | None:
        """The commands of a submission, with descriptor sets replaced by reads of the images that they hold now.

        None if that takes too long. `unknown` has the images that may be in a set whose contents are unknown.
        """
        resolved: list[RecordedCommand] = []
        self._section += 1
        for command in commands:
            key: Any = command.key
            if isinstance(key, DescriptorReads):
                at = Call(command.by, {}, command.at)
                for descriptors in key.sets:
                    for source in (descriptors, unknown) if descriptors.opaque else (descriptors,):
                        reads = self._reads(source, key.stage)
                        if reads is None:
                            return None
                        for kind, image in reads:
                            resolved.append(cache.command(kind, (image, key.stage), at))
                continue
            if command.kind in BOUNDARIES:
                self._section += 1
            if command.kind in _WRITERS or command.kind in _TRANSFERS:
                self._write(command)
            resolved.append(command)
        return resolved

    def _write(self, command: RecordedCommand) -> None:
        if command.written is None:
            key: Any = command.key
            images = key.images if isinstance(key, RenderPassBegin) else (key[1],) if command.kind in _TRANSFERS else images_in(key)
            command.written = tuple(images)
        for image in command.written:
            if image is not None and self._readers.pop(image, None) is not None:
                self._written.append(image)

    def _reads(self, descriptors: DescriptorSet, stage: str) -> list[tuple[str, Image]] | None:
        """The reads and writes of a set's images that the frame does not have yet; None if too many images have been looked at."""
        state = self._states.get((descriptors, stage))
        if state is None or state.epoch != descriptors.epoch:
            state = self._states[descriptors, stage] = _SetState(descriptors.epoch)
        new = dict.fromkeys(descriptors.log[state.logged :])
        for image in self._written[state.written :]:
            new.update((use, None) for use in ((image, False), (image, True)) if use in descriptors.uses)
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
            if use not in descriptors.uses:
                continue
            image, storage = use
            readers = self._readers.setdefault(image, {})
            for kind in ("readImage", "writeImage") if storage else ("readImage",):
                count, section = readers.get((kind, stage), (0, -1))
                if section != self._section and count < MAX_READERS:
                    readers[kind, stage] = count + 1, self._section
                    reads.append((kind, image))
            if readers["readImage", stage][0] < MAX_READERS:
                state.pending[use] = None
        return reads
