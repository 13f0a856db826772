"""Multisampled images that take turns: as many alike as the swapchain has images, and in each frame
one of them.
"""

from __future__ import annotations

from msaa_lint.frame.description.models import BeginRenderPass, Framebuffer, Image

from .commands import accesses
from .facts import Facts
from .frame import Frame
from .image import Bindings
from .parts import Pass, Target

MAX_TURNS = 16
"""Of images of a swapchain: more than any has."""

_LOADS = ("LOAD", None)


class Turns:
    """The sets of multisampled images of a frame that take turns with presentable ones. `sure` are
    those that alternate as it states.
    """

    def __init__(self, frame: Frame, bindings: Bindings) -> None:
        self.frame = frame
        self.of: dict[int, list[str]] = {}
        """By the identity of the first image of a set: the names of all."""
        self.sure: set[int] = set()
        self.alternating: set[str] = set()
        """The names of all images of all sets."""
        presentable = [
            name
            for name, target in frame.targets.items()
            if target.image is not None and target.image.presentable
        ]
        many = [
            target
            for target in frame.targets.values()
            if (target.samples or 1) > 1 and target.format is not None
        ]
        if not 1 < len(presentable) <= MAX_TURNS or len(many) < len(presentable):
            return
        self._stated: dict[str, list[Framebuffer]] = {}
        self._columns: dict[str, set[tuple[str, int]]] = {}
        self._buffers: dict[str, set[tuple[int | None, int | None]]] = {}
        for framebuffer in frame.description.framebuffers.values():
            self._stated.setdefault(framebuffer.renderPass or "", []).append(framebuffer)
            for index, name in enumerate(framebuffer.attachments):
                if name is not None:
                    self._columns.setdefault(name, set()).add((framebuffer.renderPass or "", index))
                    self._buffers.setdefault(name, set()).add(
                        (framebuffer.width, framebuffer.height)
                    )
        uses = self._uses(len(presentable))
        if uses is None or not self._one_each(
            [uses.get(name, set()) for name in presentable], len(presentable)
        ):
            return
        alike: dict[tuple[object, ...], list[Target]] = {}
        for target in many:
            alike.setdefault(self._kind(target), []).append(target)
        for group in (group for targets in alike.values() for group in self._by_places(targets)):
            turns = [uses.get(target.name, set()) for target in group]
            if (
                len(group) == len(presentable)
                and self._one_each(turns, len(group))
                and self._begins_anew(group, bindings)
            ):
                self.of[id(group[0].record)] = [target.name for target in group]
                self.alternating.update(self.of[id(group[0].record)])
                if all(turns) and frame.has_commands:
                    self.sure.add(id(group[0].record))

    def put(self, facts: Facts, target: Target) -> None:
        """Adds what is known of the turns of an image. Of a set its first image speaks."""
        names = self.of.get(id(target.record), [])
        facts.put("image.taking_turns", names, target.record.head if names else None)
        facts.put("image.turns_stated", id(target.record) in self.sure)

    def _kind(self, target: Target) -> tuple[object, ...]:
        """What images of one set have in common."""
        image = target.image
        assert isinstance(image, Image)
        usage = frozenset(image.usage) if image.usage is not None else None
        memory = frozenset(image.memory) if image.memory is not None else None
        return (
            target.format,
            target.samples,
            target.size,
            usage,
            memory,
            image.arrayLayers,
            image.mipLevels,
        )

    def _by_places(self, targets: list[Target]) -> list[list[Target]]:
        """Images of one kind by where framebuffers have them. Where they have only some of them,
        the others may take the place of these.
        """
        groups: dict[object, list[Target]] = {}
        for target in targets:
            places = (
                frozenset(self._columns.get(target.name, ())),
                frozenset(self._buffers.get(target.name, ())),
            )
            groups.setdefault(places, []).append(target)
        return (
            [targets]
            if len(groups) == 2 and (frozenset(), frozenset()) in groups
            else list(groups.values())
        )

    def _uses(self, count: int) -> dict[str, set[int]] | None:
        """In which of as many frames as there are presentable images each image is used: by passes
        and by commands; None where frames do not come round in that many.
        """
        uses: dict[str, set[int]] = {}
        every = set(range(count))
        for render_pass in self.frame.passes:
            buffers = self._alternating(render_pass)
            if buffers is None or len(buffers) not in (0, 1, count):
                return None
            for number, framebuffer in enumerate(buffers):
                for name in framebuffer.attachments:
                    if name is not None:
                        uses.setdefault(name, set()).update({number} if len(buffers) > 1 else every)
            if not buffers and (render_pass.begun or not self.frame.has_commands):
                targets = [
                    target
                    for attachment in render_pass.attachments
                    for target in attachment.targets
                ]
                targets += [
                    resolve.target_image
                    for resolve in render_pass.resolves
                    if resolve.target_image is not None
                ]
                for target in targets:
                    uses.setdefault(target.name, set()).update(every)
        # Which of a swapchain's images is presented differs from frame to frame.
        for command in (command for command in self.frame.commands if command.kind != "present"):
            for name, _ in accesses(command):
                uses.setdefault(name, set()).update(every)
        return uses

    def _alternating(self, render_pass: Pass) -> list[Framebuffer] | None:
        """The framebuffers of a pass, in the frames of a turn; None where several in a row are of
        one frame.
        """
        stated = self.frame.description.framebuffers
        if not self.frame.has_commands:
            return self._stated.get(render_pass.name, []) if render_pass.name else []
        bodies = [self.frame.commands[position].body for position in render_pass.begun]
        begins = [
            body
            for body in bodies
            if isinstance(body, BeginRenderPass) and body.framebuffer is not None
        ]
        named = {
            tuple(framebuffer.key for framebuffer in self.frame.framebuffers_of(body))
            for body in begins
        }
        return [stated[name] for names in named for name in names] if len(named) <= 1 else None

    @staticmethod
    def _one_each(turns: list[set[int]], count: int) -> bool:
        """Whether in each frame one is used: each has a frame of its own, or one has them all and
        the others none.
        """
        used = [frames for frames in turns if frames]
        if len(used) == 1:
            return len(used[0]) == count
        return (
            len(used) == count
            and all(len(frames) == 1 for frames in used)
            and len(set().union(*used)) == count
        )

    @staticmethod
    def _begins_anew(group: list[Target], bindings: Bindings) -> bool:
        """Whether nothing of one frame is left for another: no pass loads them, and no command
        reads them.
        """
        for target in group:
            if target.name in bindings.reads:
                return False
            for attachment in bindings.used_by(target.record):
                if attachment.used and any(aspect.load in _LOADS for aspect in attachment.aspects):
                    return False
        return True
