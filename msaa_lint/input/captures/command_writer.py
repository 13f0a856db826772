"""Writes the commands of a kind of frame as the `commands` of a description."""

from __future__ import annotations

from collections.abc import Collection, Hashable, Iterable, Iterator, Mapping
from typing import Any

from msaa_lint.core.text.source import Origin
from msaa_lint.frame.description.members import MAX_UINT32

from .command_buffers import (
    MAX_FULLSCREEN_VERTICES,
    PASS_BEGINS,
    PASS_ENDS,
    RecordedCommand,
    RenderPassBegin,
)
from .frame_boundary import AspectUse, aspect_uses
from .frame_kinds import FrameKind, Role
from .labels import FrameLabels
from .names import Names
from .objects import Image
from .yaml_text import Alias, Lines

SOMETIMES = "SOMETIMES"
"""Stands for the stage of a read that occurs only in some frames."""

TRANSFERS = ("RESOLVE", "TRANSFER")
"""The stages of reads and writes by commands outside of passes."""


MAX_LABELS = 16
"""Maximum number of labels that are written of equal renderings."""


class CommandWriter:
    """Writes the commands of one kind of frame.

    `described_images` are the images in its document, `passes` the numbers of its passes there,
    `framebuffers` the framebuffer names by pass begin, and `total` is the number of frames in the
    capture.
    """

    def __init__(
        self,
        lines: Lines,
        names: Names,
        kind: FrameKind,
        described_images: set[Image],
        passes: Collection[int],
        framebuffers: Mapping[Hashable, str],
        total: int,
        labels: FrameLabels,
    ) -> None:
        self.lines = lines
        self.names = names
        self.kind = kind
        self.described_images = described_images
        self.passes = passes
        self.framebuffers = framebuffers
        self.total = total
        self.renderings: dict[Hashable, str] = {}
        known = len(kind.labels) == len(kind.passes)
        self.labels = (
            [labels.name(path) for path in kind.labels] if known else [""] * len(kind.passes)
        )
        """The debug labels of the passes."""
        self.rendering_labels: dict[Hashable, dict[str, None]] = {}
        """The debug labels of equal renderings."""
        for begin, label in zip(kind.passes, self.labels, strict=True):
            if label and begin.kind == "beginRendering":
                self.rendering_labels.setdefault(begin.key, {})[label] = None
        self.roles = {image: Role(number) for number, image in enumerate(kind.images)}

    def write(self) -> None:
        """Writes the `commands` section."""
        self.lines.line("commands:")
        start = len(self.lines.text)
        order = [
            (command, number)
            for command, number, is_in_pass in self._order()
            if not is_in_pass or self._is_described(command, number)
        ]
        uses_by_image = aspect_uses(_with_images(self.kind, order))
        for image in self._from_earlier_frames(uses_by_image):
            self._note("writeImage", image, "by an earlier frame")
        samples: int | None = None
        for command, number in order:
            if self.lines.is_full:
                # The pass that is open stays so.
                break
            origin = Origin(*command.at, command.by, self.kind.count, self.total)
            if command.kind == "draw":
                key: Any = command.key
                if key[3] is not None and key[3] != samples:
                    samples = key[3]
                    self.lines.item(2, {"setRasterizationSamples": samples}, origin)
            body = self._command(command, number)
            if body is not None:
                comment = (
                    f"call {command.at.call}"
                    if command.at.call is not None and command.kind in PASS_BEGINS
                    else ""
                )
                self.lines.item(2, body, origin, comment)
        for image, is_fetched in self._for_later_frames(uses_by_image):
            self._note(
                "readImage", image, "by a later frame", None if is_fetched else "MEMORY_READ"
            )
        if len(self.lines.text) == start:
            self.lines.text[-1] += " []"

    def _order(self) -> Iterator[tuple[RecordedCommand, int, bool]]:
        """The commands as in `commands_of`, and whether each belongs to a pass."""
        is_in_pass = False
        for command, number in commands_of(self.kind):
            is_in_pass = is_in_pass or command.kind in PASS_BEGINS
            yield command, number, is_in_pass
            is_in_pass = is_in_pass and command.kind not in PASS_ENDS

    def _is_described(self, command: RecordedCommand, number: int) -> bool:
        """Whether a command of a pass is described: of a pass that is left out, only what it reads
        and writes besides its attachments.
        """
        return number in self.passes or command.kind in ("readImage", "writeImage")

    def _note(self, kind: str, image: Image, why: str, access: str | None = None) -> None:
        """Writes a use of an image by something outside this frame."""
        body: dict[str, Any] = {"image": self.names.image(image)}
        if access is not None:
            body["access"] = access
        self.lines.item(2, {kind: body}, None, why)

    def _command(self, command: RecordedCommand, number: int) -> Any:
        """A command in the form of a description; None if it affects no described image."""
        key: Any = command.key
        if command.kind in ("nextSubpass", "endRenderPass", "endRendering"):
            return command.kind
        if command.kind == "beginRenderPass":
            return {
                "beginRenderPass": self._begin(
                    key, list(self.kind.alternates[number].values()), self.labels[number]
                )
            }
        if command.kind == "beginRendering":
            name = self.renderings.setdefault(key, f"rendering_{len(self.renderings)}")
            labels = list(self.rendering_labels.get(key, ()))
            tree = {"label": labels[0] if len(labels) == 1 else labels[:MAX_LABELS], **thaw(key)}
            tree = {member: value for member, value in tree.items() if value not in ([], None)}
            return {"beginRendering": Alias(name, self._with_names(tree))}
        if command.kind == "draw":
            return {"draw": _draw(command, self.names)}
        if command.kind == "clearAttachments":
            return {command.kind: thaw(key)}
        if command.kind == "pipelineBarrier":
            return self._barrier(key)
        parts, modes = (
            (key[:2], key[2:])
            if command.kind == "resolveImage"
            else (key if isinstance(key, tuple) else (key,), ())
        )
        images = [self._name(part) for part in parts if not isinstance(part, str)]
        if None in images and len(images) == 2:
            # The other image is not an attachment of any pass.
            member = "readImage" if images[0] is not None else "writeImage"
            described = images[0] or images[1]
            return {member: {"image": described}} if described is not None else None
        if None in images:
            return None
        if command.kind in ("resolveImage", "copyImage", "blitImage"):
            return {
                command.kind: dict(zip(("srcImage", "dstImage"), images, strict=True)) | dict(modes)
            }
        if command.kind in ("copyImageToBuffer", "copyBufferToImage"):
            return {
                command.kind: {
                    "srcImage" if command.kind == "copyImageToBuffer" else "dstImage": images[0]
                }
            }
        body: dict[str, Any] = {"image": images[0]}
        if command.kind in ("readImage", "writeImage") and key[1] != SOMETIMES:
            stage = key[1]
            body["stage"] = stage
            # A shader may or may not read a descriptor set. Only a transfer is certain, so only it
            # states an access.
            if stage in TRANSFERS:
                body["access"] = (
                    "TRANSFER_READ" if command.kind == "readImage" else "TRANSFER_WRITE"
                )
        return {command.kind: body}

    def _name(self, part: Any) -> str | None:
        image = self.kind.images[part] if isinstance(part, Role) else part
        return (
            self.names.image(image)
            if isinstance(image, Image) and image in self.described_images
            else None
        )

    def _begin(
        self, begin: RenderPassBegin, alternates: list[RenderPassBegin], label: str
    ) -> dict[str, Any]:
        tree: dict[str, Any] = {"label": label} if label else {}
        tree |= {"renderPass": self.names.render_pass(begin.render_pass)}
        names = [
            self.framebuffers.get((alternate.framebuffer, alternate.images, alternate.render_pass))
            for alternate in alternates
        ]
        framebuffers = list(dict.fromkeys(name for name in names if name is not None))
        if framebuffers:
            tree["framebuffer"] = framebuffers[0] if len(framebuffers) == 1 else framebuffers
        if begin.area is not None:
            tree["renderArea"] = dict(zip(("x", "y", "width", "height"), begin.area, strict=True))
        if begin.clear_values is not None:
            tree["clearValueCount"] = begin.clear_values
        return tree

    def _with_names(self, value: Any) -> Any:
        """Plain data with the names of images in place of images."""
        if isinstance(value, dict):
            return {key: self._with_names(item) for key, item in value.items()}
        if isinstance(value, list):
            return [self._with_names(item) for item in value]
        return self.names.image(value) if isinstance(value, Image) else value

    def _barrier(self, key: Any) -> Any:
        masks, part, layouts, _ = key
        body: dict[str, Any] = thaw(masks) or {}
        if part is not None:
            name = self._name(part)
            if name is None:
                return None
            barrier: dict[str, Any] = {"image": name}
            barrier.update(
                {
                    member: value
                    for member, value in zip(("oldLayout", "newLayout"), layouts, strict=True)
                    if value is not None
                }
            )
            body["images"] = [barrier]
        return {"pipelineBarrier": body}

    def _from_earlier_frames(
        self, uses_by_image: dict[Image, dict[str, AspectUse]]
    ) -> Iterator[Image]:
        """Images written by an earlier frame of another kind, which a repetition of this frame
        would read after discarding them.
        """
        defined = self.kind.defined - self.kind.undefined
        for image, uses in uses_by_image.items():
            discarded = [
                aspect
                for aspect, use in uses.items()
                if use.first == "read" and use.last == "discarded"
            ]
            roles = {(self._role(image), aspect) for aspect in discarded}
            if image in self.described_images and roles & defined:
                yield image

    def _for_later_frames(
        self, uses_by_image: dict[Image, dict[str, AspectUse]]
    ) -> Iterator[tuple[Image, bool]]:
        """Images read by a later frame of another kind, but not by a repetition of this frame, and
        whether by its shaders.
        """
        for image, uses in uses_by_image.items():
            unread = [
                aspect
                for aspect, use in uses.items()
                if use.last == "unread" and use.first != "read"
            ]
            reads = {self.kind.later.get((self._role(image), aspect)) for aspect in unread} - {None}
            if image in self.described_images and reads:
                yield image, True in reads

    def _role(self, image: Image) -> Hashable:
        """The role of an image in the frame; the image itself if it has none."""
        return self.roles.get(image, image)


def thaw(value: Any) -> Any:
    """The inverse of `freeze`: tuples of pairs become mappings, other tuples lists."""
    if isinstance(value, tuple):
        pairs = value and all(
            isinstance(item, tuple) and len(item) == 2 and isinstance(item[0], str)
            for item in value
        )
        return {key: thaw(item) for key, item in value} if pairs else [thaw(item) for item in value]
    return value


def commands_of(kind: FrameKind) -> Iterator[tuple[RecordedCommand, int]]:
    """The commands of a kind of frame in order, each with the number of the pass that contains or
    follows it.
    """
    for number in range(len(kind.passes) + 1):
        variants = sorted(kind.gaps[number].values(), key=lambda variant: -variant.count)
        for command in variants[0].items if variants else ():
            yield command, number
        # Images that only some of the frames read here are read nevertheless.
        read = {
            source
            for command in (variants[0].items if variants else ())
            if (source := _source_image(command)) is not None
        }
        for command in (command for variant in variants[1:] for command in variant.items):
            source = _source_image(command)
            if source is not None and source not in read:
                read.add(source)
                stage = SOMETIMES if command.kind == "readImage" else "TRANSFER"
                yield RecordedCommand("readImage", (source, stage), command.at, command.by), number
        if number == len(kind.passes):
            return
        begin = kind.passes[number]
        yield begin, number
        pass_commands = sorted(kind.pass_commands[number].items(), key=lambda item: item[0][0])  # type: ignore[index]
        for _, command in pass_commands:
            yield command, number
        end = "endRenderPass" if begin.kind == "beginRenderPass" else "endRendering"
        yield RecordedCommand(end, None, begin.at, begin.by), number


def _source_image(command: RecordedCommand) -> Hashable | None:
    """The image that a command between passes reads, if any."""
    key: Any = command.key
    if command.kind in ("readImage", "resolveImage", "copyImage", "blitImage", "copyImageToBuffer"):
        source: Hashable = key[0]
        return source
    return None


def _with_images(
    kind: FrameKind, order: Iterable[tuple[RecordedCommand, int]]
) -> list[RecordedCommand]:
    """The commands with roles replaced by images."""

    def image_of(part: Any) -> Any:
        return kind.images[part] if isinstance(part, Role) else part

    commands = []
    for command, _ in order:
        key: Any = command.key
        if isinstance(key, tuple) and not isinstance(key, RenderPassBegin):
            key = tuple(map(image_of, key))
        commands.append(RecordedCommand(command.kind, image_of(key), command.at, command.by))
    return commands


def _draw(command: RecordedCommand, names: Names) -> dict[str, Any]:
    key: Any = command.key
    pipeline, counted, _, _ = key
    body: dict[str, Any] = {}
    if pipeline is not None:
        body["pipeline"] = names.pipeline(pipeline)
    counts = command.detail
    if counts is None:
        return body
    count, instances = counts.count, counts.instances
    if counts.draws > 1 and (
        counts.vertices is None or count is None or count * counts.draws != counts.vertices
    ):
        # The mean, and one instance unless it would look like a full-screen triangle that was drawn
        # once.
        count = (
            min(-(-counts.vertices // counts.draws), MAX_UINT32)
            if counts.vertices is not None
            else None
        )
        instances = 1 if count is not None and count > MAX_FULLSCREEN_VERTICES else None
    written = (
        (counted, count),
        ("instanceCount", instances),
        ("drawCount", counts.draws if counts.draws > 1 else None),
    )
    return body | {name: value for name, value in written if name and value is not None}
