"""Writes a capture as the text of a description: one document for each kind of frame, the most
frequent first.

`msaa-lint check` checks this text and `msaa-lint convert` prints it, so the two cannot disagree.
"""

from collections.abc import Collection, Hashable, Mapping, Sequence
from typing import Any, NamedTuple

from msaa_lint.core.text.source import Origin

from .command_buffers import RenderPassBegin
from .command_writer import CommandWriter, commands_of
from .frame_kinds import FrameKind
from .multisampled_part import MultisampledPart, is_multisampled
from .names import Names
from .objects import CapturedObject, Image, Pipeline, RenderPass, freeze, images_in
from .tracker import Tracker
from .yaml_text import Lines, scalar

TOO_MUCH = (
    "the description would be too large to be read again; commands and kinds of frame "
    "beyond that are not checked"
)
"""The limit of a description, as a finding states it."""

MAX_UNUSED = 500
"""Maximum number of objects of a kind that are written although no frame uses them."""


class CaptureDescription(NamedTuple):
    """The description of a capture: its text, the call behind each line, and the shader code by the
    names in the text.

    `left_out` says what has nothing to do with multisampling and is therefore not described; empty
    if that is nothing.
    """

    text: str
    origins: list[Origin | None]
    modules: dict[str, bytes]
    left_out: str


def describe_capture(tracker: Tracker) -> CaptureDescription:
    """The description of a capture."""
    lines = Lines()
    writer = _Writer(tracker, lines)
    writer.write()
    return CaptureDescription(
        "\n".join(lines.text) + "\n", lines.origins, writer.modules, writer.left_out
    )


class _Writer:
    """Writes the documents of one capture. `left_out` is that of the description."""

    def __init__(self, tracker: Tracker, lines: Lines) -> None:
        self.tracker = tracker
        self.lines = lines
        self.names = Names(tracker.frames.kinds.values(), tracker.frames.labels)
        self.modules: dict[str, bytes] = {}
        self.left_out = ""
        self.described_images: set[Image] = set()
        """The images of the current document."""
        self._frames: dict[CapturedObject, int] = {}
        """The number of frames that use one of the images that take turns, by image."""
        self.total = tracker.frames.total
        kinds = sorted(tracker.frames.kinds.values(), key=lambda kind: (-kind.count, kind.number))
        self.images = {kind: _images(kind) for kind in kinds}
        used_keys = {image_key(image) for images in self.images.values() for image in images}
        # What frames that are not described use is unknown.
        idle = (
            alike
            for alike in tracker.multisampled.values()
            if not alike.first.frames and not any(each.frames for each in alike.together)
        )
        unused = [alike.first for alike in idle if image_key(alike.first) not in used_keys]
        self.unused_images = unused[:MAX_UNUSED]
        distinct = [
            each for each in tracker.distinct.values() if not each.frames and is_multisampled(each)
        ]
        self.unused_passes = [each for each in distinct if isinstance(each, RenderPass)][
            :MAX_UNUSED
        ]
        self.unused_pipelines = [each for each in distinct if isinstance(each, Pipeline)][
            :MAX_UNUSED
        ]
        self.part = MultisampledPart(kinds)
        if kinds and not self.part.images and (self.unused_passes or self.unused_pipelines):
            # A frame has to show that it does not begin them.
            self.part.add_pass(kinds[0], 0)

    def write(self) -> None:
        """Writes all documents."""
        kinds = [
            kind
            for kind, images in self.images.items()
            if self.part.passes(kind) or not self.part.images.isdisjoint(images)
        ]
        for number, kind in enumerate(kinds):
            start = len(self.lines.text)
            if number:
                self.lines.document()
            self.frame(kind, first=number == 0)
            if self.lines.is_full:
                if number:
                    # Part of a frame would be taken for all of it.
                    self.lines.cut(start)
                self.tracker.frames.limits.setdefault(TOO_MUCH, kind.passes[0].at)
                break
        if not kinds:
            self.structures()
        every = {image for images in self.images.values() for image in images}
        passes = sum(len(kind.passes) - len(self.part.passes(kind)) for kind in self.images)
        self.left_out = _left_out(len(every - self.part.images), passes)

    def structures(self) -> None:
        """Writes a capture whose frames, if it has any, show nothing multisampled: only the objects
        that it creates.
        """
        self._head(None)
        self._images(self.unused_images)
        self._passes(
            list(dict.fromkeys([*self.unused_passes, *_render_passes_of(self.unused_pipelines)]))
        )
        self._pipelines(self.unused_pipelines)
        for kind, images in self.images.items():
            self._left_out(kind, images)
        # It is unknown which passes a frame begins.
        self.lines.line("commands: []")

    def frame(self, kind: FrameKind, first: bool) -> None:
        """Writes one kind of frame. The first document also contains the objects that no frame
        uses.
        """
        numbers = self.part.passes(kind)
        begins = [kind.passes[number].key for number in sorted(numbers)]
        passes = list(
            dict.fromkeys(
                begin.render_pass for begin in begins if isinstance(begin, RenderPassBegin)
            )
        )
        commands = (
            command for number in sorted(numbers) for command in kind.pass_commands[number].values()
        )
        drawn = (
            command.key[0]
            for command in commands
            if command.kind == "draw" and isinstance(command.key, tuple)
        )
        pipelines = [each for each in dict.fromkeys(drawn) if isinstance(each, Pipeline)]
        images = self._with_turns(
            kind, [image for image in self.images[kind] if image in self.part.images]
        )
        if first:
            images = list(dict.fromkeys([*images, *self.unused_images]))
            passes += self.unused_passes
            pipelines = list(dict.fromkeys([*pipelines, *self.unused_pipelines]))
        passes = list(dict.fromkeys([*passes, *_render_passes_of(pipelines)]))
        self._head(kind)
        self._left_out(kind, self.images[kind])
        self._images(images)
        self._passes(passes)
        framebuffers = self._framebuffers(kind, numbers)
        self._pipelines(pipelines)
        labels = self.tracker.frames.labels
        CommandWriter(
            self.lines,
            self.names,
            kind,
            self.described_images,
            numbers,
            framebuffers,
            self.total,
            labels,
        ).write()

    def _with_turns(self, kind: FrameKind, images: list[Image]) -> list[Image]:
        """The images of a kind of frame, with those that take their place in other frames if there
        is one for each swapchain image.
        """
        swapchains = {image.swapchain: None for image in images if image.swapchain is not None}
        swapchain = next(iter(swapchains), None)
        if swapchain is None or len(swapchains) > 1 or len(swapchain.images) < 2:
            return images
        result: dict[Image, None] = {}
        roles = {image: role for role, image in enumerate(kind.images)}
        for image in images:
            turns = (
                self._turns(image, kind.rotations.get(roles.get(image, -1)))
                if image.samples > 1
                else ()
            )
            if len(turns) == len(swapchain.images):
                frames = min(sum(each.frames for each in turns), self.total)
                self._frames.update(dict.fromkeys(turns, frames))
                result.update(dict.fromkeys((*turns, *swapchain.images)))
            result[image] = None
        return list(result)

    def _turns(self, image: Image, rotation: Mapping[Image, None] | None) -> Sequence[Image]:
        """The images that exist together and have the same role in other frames, as `rotation`, or
        that no frame uses.
        """
        together = image.alike.together if image.alike is not None else ()
        rotation = rotation or {image: None}
        if len(rotation) == 1 and image in together:
            return [each for each in together if each is image or not each.frames]
        return (
            [each for each in together if each in rotation]
            if rotation.keys() <= set(together)
            else ()
        )

    def _left_out(self, kind: FrameKind, images: list[Image]) -> None:
        """Writes what of a kind of frame is not described."""
        count = sum(image not in self.part.images for image in images)
        text = _left_out(count, len(kind.passes) - len(self.part.passes(kind)))
        if text:
            self.lines.line(f"# left out: {text}")

    def _head(self, kind: FrameKind | None) -> None:
        lines = self.lines
        # What frames that were not kept do is unknown: those that were stand for them, too.
        known = self.total - self.tracker.frames.dropped
        if kind is not None and kind.count < known:
            share = float(f"{kind.count / known:.6g}")
            lines.line(f"frame: {{share: {share!r}}}  # {kind.count} of {self.total} frames")
        for line in self.tracker.device().splitlines():
            lines.line(line)
        enabled = self.tracker.enabled()
        if enabled:
            lines.member(0, "enabled", enabled, None)

    def origin(self, created: CapturedObject) -> Origin:
        """The call that created an object."""
        return Origin(
            *created.at, created.by, self._frames.get(created, created.frames) or None, self.total
        )

    def _images(self, images: list[Image]) -> None:
        self.described_images = set(images)
        if images:
            self.lines.line("images:")
        for image in images:
            self.lines.member(
                2,
                self.names.image(image),
                image.description,
                self.origin(image),
                origin_comment(image),
            )

    def _passes(self, passes: list[RenderPass]) -> None:
        if passes:
            self.lines.line("renderPasses:")
        for render_pass in passes:
            tree, origin = render_pass.tree, self.origin(render_pass)
            value = "" if tree else " {}"
            self.lines.line(
                f"  {scalar(self.names.render_pass(render_pass))}:{value}  # "
                f"{origin_comment(render_pass)}",
                origin,
            )
            for member in ("flags", "fragmentDensityMapAttachment", "pNext"):
                if member in tree:
                    self.lines.member(4, member, tree[member], origin)
            for member in ("attachments", "subpasses", "dependencies"):
                if member in tree:
                    self.lines.line(f"    {member}:", origin)
                for item in tree.get(member, ()):
                    self.lines.item(6, item, origin)

    def _framebuffers(self, kind: FrameKind, numbers: Collection[int]) -> dict[Hashable, str]:
        """Writes the framebuffers of some passes of the kind, one for each set of images, and
        returns their names.
        """
        names: dict[Hashable, str] = {}
        for number in sorted(numbers):
            for begin in kind.alternates[number].values():
                key = (begin.framebuffer, begin.images, begin.render_pass)
                if begin.framebuffer is None or key in names:
                    continue
                if not names:
                    self.lines.line("framebuffers:")
                names[key] = self.names.framebuffer(
                    begin.framebuffer, begin.images, begin.render_pass
                )
                tree: dict[str, Any] = {"renderPass": self.names.render_pass(begin.render_pass)}
                # With another count, the capture lacks some views: it is unknown which image
                # belongs to which attachment.
                if len(begin.images) == len(begin.render_pass.tree.get("attachments", [])):
                    tree["attachments"] = [
                        self.names.image(image) if image is not None else None
                        for image in begin.images
                    ]
                tree.update(begin.framebuffer.tree)
                self.lines.member(
                    2,
                    names[key],
                    tree,
                    self.origin(begin.framebuffer),
                    origin_comment(begin.framebuffer),
                )
        return names

    def _pipelines(self, pipelines: list[Pipeline]) -> None:
        if pipelines:
            self.lines.line("pipelines:")
        for pipeline in pipelines:
            tree: dict[str, Any] = {}
            if pipeline.render_pass is not None:
                tree["renderPass"] = self.names.render_pass(pipeline.render_pass)
            tree.update(pipeline.tree)
            self.modules.update(pipeline.modules)
            self.lines.member(
                2,
                self.names.pipeline(pipeline),
                tree,
                self.origin(pipeline),
                origin_comment(pipeline),
            )


def origin_comment(created: CapturedObject) -> str:
    """A comment that names the call that created an object."""
    return created.by if created.at.call is None else f"{created.by}, call {created.at.call}"


def image_key(image: Image) -> Hashable:
    """The creation parameters of an image, without its memory."""
    return freeze({key: value for key, value in image.tree.items() if key != "memory"})


def _left_out(images: int, passes: int) -> str:
    """What is left out, in words; empty if it is nothing."""
    counted = [
        f"{count:,} {noun if count == 1 else plural}"
        for count, noun, plural in ((images, "image", "images"), (passes, "pass", "passes"))
        if count
    ]
    return (
        f"{' and '.join(counted)} that multisampled images neither depend on nor lead to"
        if counted
        else ""
    )


def _render_passes_of(pipelines: list[Pipeline]) -> list[RenderPass]:
    """The render passes of pipelines."""
    return [pipeline.render_pass for pipeline in pipelines if pipeline.render_pass is not None]


def _images(kind: FrameKind) -> list[Image]:
    """The images of a kind of frame, including those of alternating framebuffers."""
    images = dict.fromkeys(kind.images)
    for alternates in kind.alternates:
        for begin in alternates.values():
            images.update(dict.fromkeys(image for image in begin.images if image is not None))
    for command, _ in commands_of(kind):
        if command.kind not in ("beginRenderPass", "pipelineBarrier"):
            images.update(dict.fromkeys(images_in(command.key)))
    return list(images)
