"""The commands of a kind of frame, as a description records them."""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Iterator, Mapping
from typing import Any

from msaa_lint.core.text.source import Origin

from .command_buffers import Begin, Recorded
from .frame_boundary import Ends, ends_of
from .frames import BEGINS, Kind, Role, role_of
from .names import Names
from .objects import Image
from .yaml_text import Alias, Lines

SOMETIMES = "SOMETIMES"
"""In place of the stage of what reads an image in some of the frames."""


class Recording:
    """Writes the commands of one kind of frame. `here` are the images that its document describes, `framebuffers` the names of framebuffers
    by what they are begun with, `total` the frames of the capture."""

    def __init__(self, lines: Lines, names: Names, kind: Kind, here: set[Image], framebuffers: Mapping[Hashable, str], total: int) -> None:
        self.lines = lines
        self.names = names
        self.kind = kind
        self.here = here
        self.framebuffers = framebuffers
        self.total = total
        self.renderings: dict[Hashable, str] = {}

    def write(self) -> None:
        """Adds them."""
        self.lines.line("commands:")
        before = len(self.lines.text)
        order = list(commands_of(self.kind))
        ends = ends_of(_plain(self.kind, order))
        for image in self._handed_on(ends):
            self._note("writeImage", image, "by an earlier frame")
        samples: int | None = None
        for each, number in order:
            origin = Origin(*each.at, each.by, self.kind.count, self.total)
            if each.kind == "draw":
                key: Any = each.key
                if key[3] is not None and key[3] != samples:
                    samples = key[3]
                    self.lines.item(2, {"setRasterizationSamples": samples}, origin)
            body = self._command(each, number)
            if body is not None:
                comment = f"call {each.at.call}" if each.at.call is not None and each.kind in BEGINS else ""
                self.lines.item(2, body, origin, comment)
        for image in self._read_later(ends):
            self._note("readImage", image, "by a later frame")
        for image, own in ends.items():
            if image.shared and image in self.here and any(end.last == "unread" for end in own.values()):
                self._note("readImage", image, "its memory is shared with others")
        if len(self.lines.text) == before:
            self.lines.text[-1] += " []"

    def _note(self, kind: str, image: Image, why: str) -> None:
        """A use of an image that no command of this frame is."""
        self.lines.item(2, {kind: {"image": self.names.image(image)}}, None, why)

    def _command(self, each: Recorded, number: int) -> Any:
        """A command as a description writes it; None where it is about nothing that is described."""
        key: Any = each.key
        if each.kind in ("nextSubpass", "endRenderPass", "endRendering"):
            return each.kind
        if each.kind == "beginRenderPass":
            return {"beginRenderPass": self._begin(key, list(self.kind.alternates[number].values()))}
        if each.kind == "beginRendering":
            name = self.renderings.setdefault(key, f"rendering_{len(self.renderings)}")
            return {"beginRendering": Alias(name, self._rendering(key))}
        if each.kind == "draw":
            return {"draw": _draw(each, self.names)}
        if each.kind == "clearAttachments":
            return {each.kind: thawed(key)}
        if each.kind == "pipelineBarrier":
            return self._barrier(key)
        images = [self._name(part) for part in (key if isinstance(key, tuple) else (key,)) if not isinstance(part, str)]
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
        if each.kind in ("readImage", "writeImage") and key[1] != SOMETIMES:
            stage = key[1]
            made["stage"] = stage
            # What a descriptor set holds a shader may read, or not: only a transfer is certain, and has an access.
            if stage == "RESOLVE":
                made["access"] = "TRANSFER_READ" if each.kind == "readImage" else "TRANSFER_WRITE"
        return {each.kind: made}

    def _name(self, part: Any) -> str | None:
        image = self.kind.images[part.number] if isinstance(part, Role) else part
        return self.names.image(image) if isinstance(image, Image) and image in self.here else None

    def _begin(self, begin: Begin, alternates: list[Begin]) -> dict[str, Any]:
        tree: dict[str, Any] = {"renderPass": self.names.of("render_pass", begin.render_pass)}
        names = [self.framebuffers.get((each.framebuffer, each.images, each.render_pass)) for each in alternates]
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

    def _barrier(self, key: Any) -> Any:
        masks, part, layouts = key
        made: dict[str, Any] = thawed(masks)
        if part is not None:
            name = self._name(part)
            if name is None:
                return None
            barrier: dict[str, Any] = {"image": name}
            barrier.update({member: value for member, value in zip(("oldLayout", "newLayout"), layouts, strict=True) if value is not None})
            made["images"] = [barrier]
        return {"pipelineBarrier": made}

    def _handed_on(self, ends: dict[Image, dict[str, Ends]]) -> Iterator[Image]:
        """What an earlier frame of another kind wrote, where this one, coming again, would read what it discarded itself."""
        for image, own in ends.items():
            lost = [aspect for aspect, end in own.items() if end.first == "read" and end.last == "discarded"]
            known = {(self._role(image), aspect) for aspect in lost}
            if image in self.here and known & self.kind.defined - self.kind.undefined:
                yield image

    def _read_later(self, ends: dict[Image, dict[str, Ends]]) -> Iterator[Image]:
        """What a later frame of another kind reads, where this one, coming again, would not."""
        for image, own in ends.items():
            left = [aspect for aspect, end in own.items() if end.last == "unread" and end.first != "read"]
            if image in self.here and any((self._role(image), aspect) in self.kind.later for aspect in left):
                yield image

    def _role(self, image: Image) -> Hashable:
        """An image by its place in the frame's passes, where it has one."""
        return next((role_of(number) for number, each in enumerate(self.kind.images) if each is image), image)


def thawed(value: Any) -> Any:
    """What was frozen, as plain data again: pairs are members, other tuples arrays."""
    if isinstance(value, tuple):
        pairs = value and all(isinstance(each, tuple) and len(each) == 2 and isinstance(each[0], str) for each in value)
        return {key: thawed(item) for key, item in value} if pairs else [thawed(each) for each in value]
    return value


def commands_of(kind: Kind) -> Iterator[tuple[Recorded, int]]:
    """The commands of a kind of frame in order, each with the number of the pass that it is in or before."""
    for number in range(len(kind.passes) + 1):
        ways = sorted(kind.between[number], key=lambda way: -way.count)
        for each in ways[0].items if ways else ():
            yield each, number
        # What only some of the frames read here has a reader all the same.
        read = {source for each in (ways[0].items if ways else ()) if (source := _read(each)) is not None}
        for each in (each for way in ways[1:] for each in way.items):
            source = _read(each)
            if source is not None and source not in read:
                read.add(source)
                yield Recorded("readImage", (source, SOMETIMES), each.at, each.by), number
        if number == len(kind.passes):
            return
        begin = kind.passes[number]
        yield begin, number
        within = sorted(kind.within[number].items(), key=lambda item: item[0][0])  # type: ignore[index]
        for _, each in within:
            yield each, number
        end = "endRenderPass" if begin.kind == "beginRenderPass" else "endRendering"
        yield Recorded(end, None, begin.at, begin.by), number


def _read(each: Recorded) -> Hashable | None:
    """The image that a command between passes reads."""
    key: Any = each.key
    if each.kind in ("readImage", "resolveImage", "copyImage", "blitImage", "copyImageToBuffer"):
        source: Hashable = key[0]
        return source
    return None


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


def _draw(each: Recorded, names: Names) -> dict[str, Any]:
    key: Any = each.key
    pipeline, counted, _, _ = key
    count, instances = each.detail or (None, None)
    made: dict[str, Any] = {}
    if pipeline is not None:
        made["pipeline"] = names.of("pipeline", pipeline)
    made.update({name: value for name, value in ((counted, count), ("instanceCount", instances)) if value is not None and value >= 0})
    return made
