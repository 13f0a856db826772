"""Writes a capture as the text of a description: one document for each kind of frame, the most frequent first.

`msaa-lint check` checks this text and `msaa-lint convert` prints it, so the two cannot disagree.
"""

from __future__ import annotations

from collections.abc import Hashable
from typing import Any

from msaa_lint.core.text.source import Origin

from .command_buffers import RenderPassBegin
from .command_writer import CommandWriter, commands_of
from .frame_kinds import FrameKind
from .names import Names
from .objects import CapturedObject, Image, Pipeline, RenderPass, freeze, images_in
from .tracker import Tracker
from .yaml_text import Lines, scalar

MAX_UNUSED = 500
"""Maximum number of objects of a kind that are written although no frame uses them."""


def describe_capture(tracker: Tracker) -> tuple[str, list[Origin | None], dict[str, bytes]]:
    """The description of a capture: its text, the call behind each line, and the shader code by the names in the text."""
    lines = Lines()
    writer = _Writer(tracker, lines)
    kinds = sorted(tracker.frames.kinds.values(), key=lambda kind: (-kind.count, kind.number))
    for number, kind in enumerate(kinds):
        if number:
            lines.document()
        writer.frame(kind, first=number == 0)
    if not kinds:
        writer.structures()
    return "\n".join(lines.text) + "\n", lines.origins, writer.modules


class _Writer:
    """Writes the documents of one capture."""

    def __init__(self, tracker: Tracker, lines: Lines) -> None:
        self.tracker = tracker
        self.lines = lines
        self.names = Names(tracker.frames.kinds.values(), tracker.frames.labels)
        self.modules: dict[str, bytes] = {}
        self.described_images: set[Image] = set()
        """The images of the current document."""
        self.total = tracker.frames.total
        self.used_images = {image for kind in tracker.frames.kinds.values() for image in _images(kind)}
        used_keys = {image_key(image) for image in self.used_images}
        unused = [each for each in tracker.multisampled.values() if image_key(each) not in used_keys]
        self.unused_images = unused[:MAX_UNUSED]
        distinct = list(tracker.distinct.values())
        self.unused_passes = [each for each in distinct if isinstance(each, RenderPass) and not each.frames][:MAX_UNUSED]
        self.unused_pipelines = [each for each in distinct if isinstance(each, Pipeline) and not each.frames][:MAX_UNUSED]

    def structures(self) -> None:
        """Writes a capture without frames: only the objects that it creates."""
        self._head(None)
        self._images(self.unused_images)
        self._passes(list(dict.fromkeys([*self.unused_passes, *_render_passes_of(self.unused_pipelines)])))
        self._pipelines(self.unused_pipelines)
        # It is unknown which passes a frame begins.
        self.lines.line("commands: []")

    def frame(self, kind: FrameKind, first: bool) -> None:
        """Writes one kind of frame. The first document also contains the objects that no frame uses."""
        begins = [item.key for item in kind.passes if isinstance(item.key, RenderPassBegin)]
        passes = list(dict.fromkeys(begin.render_pass for begin in begins))
        draw_counts = [item.key[0] for item, _ in commands_of(kind) if item.kind == "draw" and isinstance(item.key, tuple)]
        pipelines = [item for item in dict.fromkeys(draw_counts) if isinstance(item, Pipeline)]
        images = _images(kind)
        if first:
            images = list(dict.fromkeys([*images, *self.unused_images]))
            passes += self.unused_passes
            pipelines = list(dict.fromkeys([*pipelines, *self.unused_pipelines]))
        passes = list(dict.fromkeys([*passes, *_render_passes_of(pipelines)]))
        self._head(kind)
        self._images(images)
        self._passes(passes)
        framebuffers = self._framebuffers(kind)
        self._pipelines(pipelines)
        CommandWriter(self.lines, self.names, kind, self.described_images, framebuffers, self.total, self.tracker.frames.labels).write()

    def _head(self, kind: FrameKind | None) -> None:
        lines = self.lines
        if kind is not None and kind.count < self.total:
            share = float(f"{kind.count / self.total:.6g}")
            lines.line(f"frame: {{share: {share!r}}}  # {kind.count} of {self.total} frames")
        for line in self.tracker.device().splitlines():
            lines.line(line)
        enabled = self.tracker.enabled()
        if enabled:
            lines.member(0, "enabled", enabled, None)

    def origin(self, created: CapturedObject) -> Origin:
        """The call that created an object."""
        return Origin(*created.at, created.by, created.frames or None, self.total)

    def _images(self, images: list[Image]) -> None:
        self.described_images = set(images)
        if images:
            self.lines.line("images:")
        for image in images:
            self.lines.member(2, self.names.image(image), image.description, self.origin(image), origin_comment(image))

    def _passes(self, passes: list[RenderPass]) -> None:
        if passes:
            self.lines.line("renderPasses:")
        for render_pass in passes:
            tree, origin = render_pass.tree, self.origin(render_pass)
            value = "" if tree else " {}"
            self.lines.line(f"  {scalar(self.names.render_pass(render_pass))}:{value}  # {origin_comment(render_pass)}", origin)
            if "flags" in tree:
                self.lines.member(4, "flags", tree["flags"], origin)
            for member in ("attachments", "subpasses", "dependencies"):
                if member in tree:
                    self.lines.line(f"    {member}:", origin)
                for item in tree.get(member, ()):
                    self.lines.item(6, item, origin)

    def _framebuffers(self, kind: FrameKind) -> dict[Hashable, str]:
        """Writes the framebuffers of the kind's passes, one for each set of images, and returns their names."""
        names: dict[Hashable, str] = {}
        for alternates in kind.alternates:
            for begin in alternates.values():
                key = (begin.framebuffer, begin.images, begin.render_pass)
                if begin.framebuffer is None or key in names:
                    continue
                if not names:
                    self.lines.line("framebuffers:")
                names[key] = self.names.framebuffer(begin.framebuffer, begin.images, begin.render_pass)
                tree: dict[str, Any] = {"renderPass": self.names.render_pass(begin.render_pass)}
                # With another count, the capture lacks some views: it is unknown which image belongs to which attachment.
                if len(begin.images) == len(begin.render_pass.tree.get("attachments", [])):
                    tree["attachments"] = [self.names.image(image) if image is not None else None for image in begin.images]
                tree.update(begin.framebuffer.tree)
                self.lines.member(2, names[key], tree, self.origin(begin.framebuffer), origin_comment(begin.framebuffer))
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
            self.lines.member(2, self.names.pipeline(pipeline), tree, self.origin(pipeline), origin_comment(pipeline))


def origin_comment(created: CapturedObject) -> str:
    """A comment that names the call that created an object."""
    return created.by if created.at.call is None else f"{created.by}, call {created.at.call}"


def image_key(image: Image) -> Hashable:
    """The creation parameters of an image, without its memory."""
    return freeze({key: value for key, value in image.tree.items() if key != "memory"})


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
