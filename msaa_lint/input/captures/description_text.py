"""A capture as the text of a description: its kinds of frames, each a document, the commonest first.

What is checked is this text, and it is what `msaa-lint convert` prints: the two cannot disagree.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterator
from typing import Any, NamedTuple

from msaa_lint.core.text.source import Origin

from .command_buffers import Begin
from .command_writer import Recording, commands_of
from .frames import Kind
from .names import Names
from .objects import Created, Framebuffer, Image, Pipeline, RenderPass, frozen
from .tracker import Tracker
from .yaml_text import Lines

FRAMES_A_SECOND = 60
"""What costs are reckoned by where a description states no rate: a kind of frame that is one of many comes that much more seldom."""

MAX_UNUSED = 500
"""So many objects of a kind that no frame uses are written."""


class Written(NamedTuple):
    """The text, the call that each line is from, and the code of the shaders that it names, by the names they have there."""

    text: str
    origins: list[Origin | None]
    modules: dict[str, bytes]
    frames: int
    unkept: int


def written(tracker: Tracker) -> Written:
    """What a capture holds."""
    lines = Lines()
    writer = _Writer(tracker, lines)
    kinds = sorted(tracker.frames.kinds.values(), key=lambda kind: (-kind.count, kind.number))
    for number, kind in enumerate(kinds):
        if number:
            lines.document()
        writer.frame(kind, first=number == 0)
    if not kinds:
        writer.structures()
    return Written("\n".join(lines.text) + "\n", lines.origins, writer.modules, tracker.frames.total, tracker.frames.unkept)


class _Writer:
    """Writes the documents of one capture."""

    def __init__(self, tracker: Tracker, lines: Lines) -> None:
        self.tracker = tracker
        self.lines = lines
        self.names = Names()
        self.modules: dict[str, bytes] = {}
        self.here: set[Image] = set()
        """The images of the document that is written."""
        self.total = tracker.frames.total
        self.used_images = {image for kind in tracker.frames.kinds.values() for image in _images(kind)}
        alike = {image_key(image) for image in self.used_images}
        unused = [each for each in tracker.multisampled.values() if image_key(each) not in alike]
        self.unused_images = unused[:MAX_UNUSED]
        distinct = list(tracker.distinct.values())
        self.unused_passes = [each for each in distinct if isinstance(each, RenderPass) and not each.frames][:MAX_UNUSED]
        self.unused_pipelines = [each for each in distinct if isinstance(each, Pipeline) and not each.frames][:MAX_UNUSED]

    def structures(self) -> None:
        """A capture without a frame: what was created, by itself."""
        self._head(None)
        self._images(self.unused_images)
        self._passes(list(dict.fromkeys([*self.unused_passes, *_behind(self.unused_pipelines)])))
        self._pipelines(self.unused_pipelines)
        # Which of the passes a frame begins, and with what around them, is not known.
        self.lines.line("commands: []")

    def frame(self, kind: Kind, first: bool) -> None:
        """One kind of frame; the first also has what no frame uses."""
        begins = [each.key for each in kind.passes if isinstance(each.key, Begin)]
        passes = list(dict.fromkeys(begin.render_pass for begin in begins))
        drawn = [each.key[0] for each, _ in commands_of(kind) if each.kind == "draw" and isinstance(each.key, tuple)]
        pipelines = [each for each in dict.fromkeys(drawn) if isinstance(each, Pipeline)]
        images = _images(kind)
        if first:
            images += [each for each in self.unused_images if each not in images]
            passes += [each for each in self.unused_passes if each not in passes]
            pipelines += [each for each in self.unused_pipelines if each not in pipelines]
        passes = list(dict.fromkeys([*passes, *_behind(pipelines)]))
        self._head(kind)
        self._images(images)
        self._passes(passes)
        framebuffers = self._framebuffers(kind)
        self._pipelines(pipelines)
        Recording(self.lines, self.names, kind, self.here, framebuffers, self.total).write()

    def _head(self, kind: Kind | None) -> None:
        lines = self.lines
        if kind is not None and kind.count < self.total:
            rate = float(f"{FRAMES_A_SECOND * kind.count / self.total:.4g}")
            lines.line(f"frame: {{fps: {rate!r}}}  # {kind.count} of {self.total} frames, at {FRAMES_A_SECOND} frames a second")
        device = self.tracker.device()
        if device:
            for line in device.splitlines():
                lines.line(line)
        enabled = self.tracker.enabled()
        if enabled:
            lines.member(0, "enabled", enabled, None)

    def origin(self, made: Created) -> Origin:
        """The call that an object is from."""
        return Origin(*made.at, made.by, made.frames or None, self.total)

    def _images(self, images: list[Image]) -> None:
        self.here = set(images)
        if images:
            self.lines.line("images:")
        for image in images:
            self.lines.member(2, self.names.image(image), image.tree, self.origin(image), remark(image))

    def _passes(self, passes: list[RenderPass]) -> None:
        if passes:
            self.lines.line("renderPasses:")
        for each in passes:
            origin = self.origin(each)
            self.lines.line(f"  {self.names.of('render_pass', each)}:  # {remark(each)}", origin)
            if not each.tree:
                self.lines.text[-1] = self.lines.text[-1].replace(":  #", ": {}  #", 1)
            for member in ("flags", "attachments", "subpasses", "dependencies"):
                if member not in each.tree:
                    continue
                if member == "flags":
                    self.lines.member(4, member, each.tree[member], origin)
                    continue
                self.lines.line(f"    {member}:", origin)
                for item in each.tree[member]:
                    self.lines.item(6, item, origin)

    def _framebuffers(self, kind: Kind) -> dict[Hashable, str]:
        """The framebuffers of the kind's passes, by the begin they are for; one for each set of images."""
        found: dict[Hashable, str] = {}
        for alternates in kind.alternates:
            for begin in alternates.values():
                key = (begin.framebuffer, begin.images, begin.render_pass)
                if begin.framebuffer is None or key in found:
                    continue
                if not found:
                    self.lines.line("framebuffers:")
                found[key] = self.names.framebuffer(begin.framebuffer, begin.images, begin.render_pass)
                self._framebuffer(found[key], begin.framebuffer, begin)
        return found

    def _framebuffer(self, name: str, framebuffer: Framebuffer, begin: Begin) -> None:
        tree: dict[str, Any] = {"renderPass": self.names.of("render_pass", begin.render_pass)}
        tree["attachments"] = [self.names.image(image) if image is not None else None for image in begin.images]
        for member in ("width", "height", "layers"):
            if getattr(framebuffer, member) is not None:
                tree[member] = getattr(framebuffer, member)
        wanted = len(begin.render_pass.tree.get("attachments", []))
        if len(begin.images) != wanted:
            # Views that the capture does not tell: which image is whose is not known.
            del tree["attachments"]
        self.lines.member(2, name, tree, self.origin(framebuffer), remark(framebuffer))

    def _pipelines(self, pipelines: list[Pipeline]) -> None:
        if pipelines:
            self.lines.line("pipelines:")
        for each in pipelines:
            tree: dict[str, Any] = {}
            if each.render_pass is not None:
                tree["renderPass"] = self.names.of("render_pass", each.render_pass)
            tree.update(each.tree)
            self.modules.update(each.modules)
            self.lines.member(2, self.names.of("pipeline", each), tree, self.origin(each), remark(each))


def remark(made: Created) -> str:
    """What a comment says of where an object is from."""
    return made.by if made.at.call is None else f"{made.by}, call {made.at.call}"


def image_key(image: Image) -> Hashable:
    """What two images that were created alike share."""
    return frozen({key: value for key, value in image.tree.items() if key != "memory"})


def _behind(pipelines: list[Pipeline]) -> list[RenderPass]:
    """The render passes of pipelines."""
    return [each.render_pass for each in pipelines if each.render_pass is not None]


def _images(kind: Kind) -> list[Image]:
    """The images that a kind of frame draws to, those of alternating framebuffers among them."""
    found = dict.fromkeys(kind.images)
    for alternates in kind.alternates:
        for begin in alternates.values():
            found.update(dict.fromkeys(image for image in begin.images if image is not None))
    for each, _ in commands_of(kind):
        if each.kind not in ("beginRenderPass", "pipelineBarrier"):
            found.update(dict.fromkeys(_images_in(each.key)))
    return list(found)


def _images_in(key: Any) -> Iterator[Image]:
    if isinstance(key, Image):
        yield key
    elif isinstance(key, tuple):
        for each in key:
            yield from _images_in(each)
