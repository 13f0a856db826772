"""A capture as the text of a description: its kinds of frames, each a document, the commonest first.

What is checked is this text, and it is what `msaa-lint convert` prints: the two cannot disagree.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Iterator, Mapping
from typing import Any, NamedTuple

from ..source.text import Origin
from .ends import ends_of
from .frames import Kind, Role, role_of
from .names import Names
from .objects import Created, Framebuffer, Image, Pipeline, RenderPass
from .recording import Begin, Recorded
from .tracker import Tracker
from .yaml_text import Alias, Lines, scalar

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
        drawn = [each.key[0] for each, _ in _commands_of(kind) if each.kind == "draw" and isinstance(each.key, tuple)]
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
        self._commands(kind, framebuffers)

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

    # Commands.

    def _commands(self, kind: Kind, framebuffers: Mapping[Hashable, str]) -> None:
        self.lines.line("commands:")
        before = len(self.lines.text)
        order = list(_commands_of(kind))
        for text in _handed_on(kind, order, self.here, self.names):
            self.lines.line(text)
        renderings: dict[Hashable, str] = {}
        samples: int | None = None
        for each, number in order:
            origin = Origin(*each.at, each.by, kind.count, self.total)
            if each.kind == "draw":
                key: Any = each.key
                if key[3] is not None and key[3] != samples:
                    samples = key[3]
                    self.lines.item(2, {"setRasterizationSamples": samples}, origin)
            body = self._command(each, kind, number, framebuffers, renderings)
            if body is not None:
                comment = f"call {each.at.call}" if each.at.call is not None and each.kind in ("beginRenderPass", "beginRendering") else ""
                self.lines.item(2, body, origin, comment)
        for text in _read_later(kind, order, self.here, self.names):
            self.lines.line(text)
        if len(self.lines.text) == before:
            self.lines.text[-1] += " []"

    def _command(
        self, each: Recorded, kind: Kind, number: int, framebuffers: Mapping[Hashable, str], renderings: dict[Hashable, str]
    ) -> Any:
        """A command as a description writes it; None where it is about nothing that is described."""
        key: Any = each.key
        if each.kind in ("nextSubpass", "endRenderPass", "endRendering"):
            return each.kind
        if each.kind == "beginRenderPass":
            return {"beginRenderPass": self._begin(key, list(kind.alternates[number].values()), framebuffers)}
        if each.kind == "beginRendering":
            name = renderings.setdefault(key, f"rendering_{len(renderings)}")
            return {"beginRendering": Alias(name, self._rendering(key))}
        if each.kind == "draw":
            return {"draw": _draw(each, self.names)}
        if each.kind == "clearAttachments":
            return {each.kind: thawed(key)}
        if each.kind == "pipelineBarrier":
            return self._barrier(key, kind)
        images = [self._name(part, kind) for part in (key if isinstance(key, tuple) else (key,)) if not isinstance(part, str)]
        if None in images and len(images) == 2:
            # An image that no pass draws to is at the other end.
            member = "readImage" if images[0] is not None else "writeImage"
            known = images[0] or images[1]
            return {member: {"image": known}} if known is not None else None
        if None in images:
            return None
        if each.kind in ("resolveImage", "copyImage", "blitImage"):
            return {each.kind: dict(zip(("srcImage", "dstImage"), images, strict=True))}
        if each.kind in ("copyImageToBuffer", "copyBufferToImage"):
            return {each.kind: {"srcImage" if each.kind == "copyImageToBuffer" else "dstImage": images[0]}}
        made: dict[str, Any] = {"image": images[0]}
        if each.kind in ("readImage", "writeImage"):
            stage = key[1]
            made["stage"] = stage
            if stage == "RESOLVE":
                made["access"] = "TRANSFER_READ" if each.kind == "readImage" else "TRANSFER_WRITE"
            else:
                made["access"] = "SHADER_READ" if each.kind == "readImage" else "SHADER_WRITE"
        return {each.kind: made}

    def _name(self, part: Any, kind: Kind) -> str | None:
        image = kind.images[part.number] if isinstance(part, Role) else part
        return self.names.image(image) if isinstance(image, Image) and image in self.here else None

    def _begin(self, begin: Begin, alternates: list[Begin], framebuffers: Mapping[Hashable, str]) -> dict[str, Any]:
        tree: dict[str, Any] = {"renderPass": self.names.of("render_pass", begin.render_pass)}
        names = [framebuffers.get((each.framebuffer, each.images, each.render_pass)) for each in alternates]
        stated = list(dict.fromkeys(name for name in names if name is not None))
        if stated:
            tree["framebuffer"] = stated[0] if len(stated) == 1 else stated
        if begin.area is not None:
            tree["renderArea"] = dict(zip(("x", "y", "width", "height"), begin.area, strict=True))
        if begin.clear_values is not None:
            tree["clearValueCount"] = begin.clear_values
        return tree

    def _rendering(self, key: Hashable) -> dict[str, Any]:
        tree: dict[str, Any] = thawed(key)
        made = {member: value for member, value in tree.items() if value not in ([], None)}
        if "colorAttachments" in made:
            made["colorAttachments"] = [self._attachment(each) for each in made["colorAttachments"]]
        for member in ("depthAttachment", "stencilAttachment"):
            if member in made:
                made[member] = self._attachment(made[member])
        return made

    def _attachment(self, tree: dict[str, Any] | None) -> dict[str, Any] | None:
        if tree is None:
            return None
        return {key: self.names.image(value) if isinstance(value, Image) else value for key, value in tree.items()}

    def _barrier(self, key: Any, kind: Kind) -> Any:
        masks, part, layouts = key
        made: dict[str, Any] = thawed(masks)
        if part is not None:
            name = self._name(part, kind)
            if name is None:
                return None
            barrier: dict[str, Any] = {"image": name}
            barrier.update({member: value for member, value in zip(("oldLayout", "newLayout"), layouts, strict=True) if value is not None})
            made["images"] = [barrier]
        return {"pipelineBarrier": made}


def remark(made: Created) -> str:
    """What a comment says of where an object is from."""
    return made.by if made.at.call is None else f"{made.by}, call {made.at.call}"


def image_key(image: Image) -> Hashable:
    """What two images that were created alike share."""
    from .objects import frozen

    return frozen({key: value for key, value in image.tree.items() if key != "memory"})


def thawed(value: Any) -> Any:
    """What was frozen, as plain data again: pairs are members, other tuples arrays."""
    if isinstance(value, tuple):
        pairs = value and all(isinstance(each, tuple) and len(each) == 2 and isinstance(each[0], str) for each in value)
        return {key: thawed(item) for key, item in value} if pairs else [thawed(each) for each in value]
    return value


def _behind(pipelines: list[Pipeline]) -> list[RenderPass]:
    """The render passes of pipelines."""
    return [each.render_pass for each in pipelines if each.render_pass is not None]


def _images(kind: Kind) -> list[Image]:
    """The images that a kind of frame draws to, those of alternating framebuffers among them."""
    found = dict.fromkeys(kind.images)
    for alternates in kind.alternates:
        for begin in alternates.values():
            found.update(dict.fromkeys(image for image in begin.images if image is not None))
    for each, _ in _commands_of(kind):
        if each.kind not in ("beginRenderPass", "pipelineBarrier"):
            found.update(dict.fromkeys(_images_in(each.key)))
    return list(found)


def _images_in(key: Any) -> Iterator[Image]:
    if isinstance(key, Image):
        yield key
    elif isinstance(key, tuple):
        for each in key:
            yield from _images_in(each)


def _commands_of(kind: Kind) -> Iterator[tuple[Recorded, int]]:
    """The commands of a kind of frame in order, each with the number of the pass that it is in or before."""
    for number in range(len(kind.passes) + 1):
        ways = kind.between[number]
        for each in max(ways, key=lambda way: way.count).items if ways else ():
            yield each, number
        if number == len(kind.passes):
            return
        begin = kind.passes[number]
        yield begin, number
        within = sorted(kind.within[number].items(), key=lambda item: item[0][0])  # type: ignore[index]
        for _, each in within:
            yield each, number
        end = "endRenderPass" if begin.kind == "beginRenderPass" else "endRendering"
        yield Recorded(end, None, begin.at, begin.by), number


def _plain(kind: Kind, order: Iterable[tuple[Recorded, int]]) -> list[Recorded]:
    """Commands with images in place of their places."""

    def of(part: Any) -> Any:
        return kind.images[part.number] if isinstance(part, Role) else part

    made = []
    for each, _ in order:
        key: Any = each.key
        if isinstance(key, tuple) and not isinstance(key, Begin):
            key = tuple(map(of, key))
        made.append(Recorded(each.kind, of(key), each.at, each.by))
    return made


def _handed_on(kind: Kind, order: list[tuple[Recorded, int]], here: set[Image], names: Names) -> Iterator[str]:
    """What an earlier frame of another kind wrote, where this one, coming again, would read what it discarded itself."""
    for image, own in ends_of(_plain(kind, order)).items():
        role = next((role_of(number) for number, each in enumerate(kind.images) if each is image), image)
        for aspect, end in own.items():
            lost = end.first == "read" and end.last == "discarded"
            if lost and image in here and (role, aspect) in kind.defined and (role, aspect) not in kind.undefined:
                yield f"  - writeImage: {{image: {scalar(names.image(image))}}}  # by an earlier frame"
                break


def _read_later(kind: Kind, order: list[tuple[Recorded, int]], here: set[Image], names: Names) -> Iterator[str]:
    """What a later frame of another kind reads, where this one, coming again, would not."""
    for image, own in ends_of(_plain(kind, order)).items():
        role = next((role_of(number) for number, each in enumerate(kind.images) if each is image), image)
        for aspect, end in own.items():
            if end.last == "unread" and end.first != "read" and image in here and (role, aspect) in kind.later:
                yield f"  - readImage: {{image: {scalar(names.image(image))}}}  # by a later frame"
                break


def _draw(each: Recorded, names: Names) -> dict[str, Any]:
    key: Any = each.key
    pipeline, counted, _, _ = key
    count, instances = each.detail or (None, None)
    made: dict[str, Any] = {}
    if pipeline is not None:
        made["pipeline"] = names.of("pipeline", pipeline)
    made.update({name: value for name, value in ((counted, count), ("instanceCount", instances)) if value is not None and value >= 0})
    return made
