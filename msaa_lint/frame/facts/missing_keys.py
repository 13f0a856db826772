"""The keys that a description lacks for a fact: where each belongs, and what it may hold.

A part of the frame (`image` in `image.usage`) stands for records of the description, which depend
on the subject that the fact is of.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from functools import cached_property

from msaa_lint.core.allowance import Allowance
from msaa_lint.core.finding import MissingKey
from msaa_lint.frame.description.models import (
    BeginRenderPass,
    Description,
    Device,
    Image,
    Pipeline,
    ReadImage,
    RenderPass,
)
from msaa_lint.frame.description.record import Record

from .attachment import resolves_at
from .facts import Subject
from .key_values import spelled, values
from .parts import RENDERING, Attachment, Pass, Resolve, Target, states_mode
from .pipeline import Draw, draws_of
from .subjects import FrameAnalysis
from .subpass import pipelines_of
from .table_keys import KEYS

Place = tuple[Record, str]
"""A record and the path of a member from it."""

_METAL_IMAGE = {
    "format": "pixelFormat", "samples": "sampleCount", "usage": "usage", "memory": "storageMode",
    "imageType": "textureType",
    "mipLevels": "mipmapLevelCount", "presentable": "drawable", "encoding": "encoding",
    "extent": "width",
    "extent.width": "width", "extent.height": "height",
    "storageMode": "storageMode", "textureType": "textureType",
}  # fmt: skip
_METAL_ATTACHMENT = {
    "image": "texture", "format": "texture", "samples": "texture",
    "loadOp": "loadAction", "stencilLoadOp": "loadAction", "storeOp": "storeAction",
    "stencilStoreOp": "storeAction",
}  # fmt: skip
_METAL_PIPELINE = {
    "multisampleState.rasterizationSamples": "rasterSampleCount",
    "multisampleState.alphaToCoverageEnable": "isAlphaToCoverageEnabled",
    "colorBlendState.attachments.blendEnable": "colorAttachments.isBlendingEnabled",
    "rasterizationState.rasterizerDiscardEnable": "isRasterizationEnabled",
    "renderPass": "renderPass",
}
_COMMANDS = {
    "pipelineBarrier": "a command before the first reader",
    "present": "a command at the end of the frame",
}
"""The commands that a fact may hang on, and what they are."""

_SIBLING = {"format": "samples", "samples": "format"}


MAX_STEPS = 200_000
"""Members that are looked at for the keys of a frame: many subjects may depend on the same many
structures.
"""


class MissingKeys:
    """The keys that one description lacks."""

    def __init__(self, analysis: FrameAnalysis) -> None:
        self.analysis = analysis
        self.frame = analysis.frame
        self.description: Description = analysis.frame.description
        self.lowered = analysis.frame.document.metal
        document = analysis.frame.document
        self._converted = document.tree is not None or document.source.origins is not None
        self._steps = Allowance(MAX_STEPS)

    def of(self, subject: Subject, fact: str) -> list[MissingKey]:
        """The keys to write next so that a fact of a subject is known; empty if no key is
        missing.
        """
        for group in KEYS.get(fact, "").split(";"):
            found: dict[tuple[str, str], MissingKey] = {}
            for key in group.split():
                if key in _COMMANDS:
                    found.update(self._command(key))
                    continue
                if not self.frame.document.whole and not key.startswith("device"):
                    # The dump of one pipeline has no place for the rest of the frame.
                    continue
                for record, path in self._places(subject, key):
                    if not self._steps.take():
                        return []
                    missing = _unstated(record, path)
                    if missing is not None:
                        found.setdefault((missing.structure, missing.name), missing)
            if found:
                return [key._replace(converted=self._converted) for key in found.values()]
        return []

    def _places(self, subject: Subject, key: str) -> Iterator[Place]:
        part, _, member = key.partition(".")
        places = (
            _PARTS[part](self, subject, member) if part in _PARTS else [(self.description, key)]
        )
        for record, path in places:
            yield from (
                [(record, path)] if self.lowered is None else self._in_metal(record, path, subject)
            )

    def _command(self, kind: str) -> dict[tuple[str, str], MissingKey]:
        """A command that the commands of the frame lack."""
        if self.description.commands is None or kind in self._kinds or self.lowered is not None:
            return {}
        span = self.description.place("commands")
        return {("commands", kind): MissingKey("commands", kind, _COMMANDS[kind], span)}

    @cached_property
    def _kinds(self) -> set[str]:
        """The commands that are recorded."""
        return {command.kind for command in self.description.commands or () if command is not None}

    # Images

    def _images(self, subject: Subject) -> list[Target]:
        """The images that a subject is about, each once."""
        targets = (
            [subject.image]
            if subject.image is not None
            else list(subject.attachment.targets)
            if subject.attachment is not None
            else []
        )
        return list({id(target.record): target for target in targets}.values())

    def _of_images(self, targets: Iterable[Target], member: str) -> Iterator[Place]:
        for target in targets:
            bound = self.analysis.bindings.attachments.get(id(target.record), [])
            if member == "loadOp":
                yield from self._operations(bound, "load")
            elif target.image is None:
                yield (
                    target.record,
                    member if self._stands_alone(target.record, member) else "image",
                )
            elif member == "resolves":
                yield from (
                    (read, member) for read in self.analysis.bindings.reads.get(target.name, [])
                )
            elif member in _SIBLING and not target.image.states(_SIBLING[member]):
                # Where the format is stated, the sample count belongs, too.
                stating = (
                    attachment.record
                    for attachment in bound
                    if attachment.record.states(_SIBLING[member])
                )
                yield (next(stating, target.image), member)
            elif member != "image":
                yield (target.image, member)

    def _stands_alone(self, record: Record, member: str) -> bool:
        """Whether an attachment without an image states its own format and sample count."""
        return (
            member in _SIBLING
            and member in record.SHAPE
            and (record.states(_SIBLING[member]) or not self.description.images)
        )

    # Attachments

    def _attachment(self, subject: Subject, member: str) -> Iterator[Place]:
        if subject.attachment is None:
            return
        attachment = subject.attachment
        if member in ("load", "store"):
            aspects = [subject.aspect] if subject.aspect is not None else attachment.aspects
            yield from (
                (attachment.record, aspect.load_member if member == "load" else aspect.store_member)
                for aspect in aspects
            )
        elif member == "initial":
            name = subject.aspect.name if subject.aspect is not None else None
            separate = name == "stencil" and attachment.record.states("stencilInitialLayout")
            yield (attachment.record, "stencilInitialLayout" if separate else "initialLayout")
        elif member == "resolveMode":
            for resolve in self._resolves.get(id(attachment), ()):
                yield from _of_resolve(resolve, "mode")
        elif member in _SIBLING:
            yield from self._of_attachment(attachment, member)
        else:
            yield (attachment.record, member)

    @cached_property
    def _resolves(self) -> dict[int, list[Resolve]]:
        """The resolves by the attachments, by identity, that they read or write."""
        return {
            key: resolves
            for render_pass in self.frame.passes
            for key, resolves in resolves_at(render_pass).items()
        }

    def _of_attachment(self, attachment: Attachment, member: str) -> Iterator[Place]:
        """The format or the sample count of an attachment: its own, or its image's."""
        images = any(target.image is not None for target in attachment.targets)
        if (
            member in attachment.record.SHAPE
            and images
            and attachment.record.states(_SIBLING[member])
        ):
            yield (attachment.record, member)
        else:
            yield from self._of_images(attachment.targets, member)

    def _operations(self, attachments: Iterable[Attachment], operation: str) -> Iterator[Place]:
        for attachment in attachments:
            for aspect in attachment.aspects:
                yield (
                    attachment.record,
                    aspect.load_member if operation == "load" else aspect.store_member,
                )

    def _attachments(self, subject: Subject, member: str) -> Iterator[Place]:
        """All attachments of the subpass or pass that a subject is about."""
        render_pass = self._pass_of(subject)
        draws = (
            self._draws.get(subject.pipeline.key, ())
            if subject.pipeline is not None and subject.subpass is None
            else ()
        )
        subpasses = [draw.subpass for draw in draws] if draws else [subject.subpass]
        drawn_in = [subpass for subpass in subpasses if subpass is not None]
        attachments = [
            each
            for subpass in drawn_in
            for each in (*subpass.color, *subpass.depth_stencil)
            if each is not None
        ]
        if not drawn_in and render_pass is not None:
            attachments = render_pass.attachments
        if member in ("load", "store"):
            yield from self._operations(attachments, member)
        else:
            for attachment in attachments:
                yield from self._of_attachment(attachment, member)

    @cached_property
    def _draws(self) -> dict[str, list[Draw]]:
        return draws_of(self.analysis.walk)

    def _of_end(self, subject: Subject, member: str, end: str) -> Iterator[Place]:
        """The source or the target of a resolve."""
        resolve = subject.resolve
        if resolve is None:
            return
        if (
            member == end
            or (resolve.read_part if end == "source" else resolve.written_part) is None
        ):
            yield from self._end_of(resolve, end)
            return
        attachment, image = (
            (resolve.source, resolve.source_image)
            if end == "source"
            else (resolve.target, resolve.target_image)
        )
        if attachment is not None and member == "store":
            yield from self._operations([attachment], member)
        elif attachment is not None and member in _SIBLING:
            yield from self._of_attachment(attachment, member)
        else:
            yield from self._of_images(
                [image]
                if image is not None
                else attachment.targets
                if attachment is not None
                else [],
                member,
            )

    def _end_of(self, resolve: Resolve, end: str) -> Iterator[Place]:
        """The key that names what a resolve reads or writes."""
        if resolve.kind == "command":
            yield (resolve.record, "srcImage" if end == "source" else "dstImage")
        elif resolve.kind == RENDERING:
            yield (resolve.record, "image" if end == "source" else "resolveImage")
        elif end == "source" and resolve.render_pass is not None:
            subpass = resolve.render_pass.subpasses[resolve.subpass].record
            yield (
                subpass,
                "colorAttachments" if resolve.aspect == "color" else "depthStencilAttachment",
            )
        else:
            yield (resolve.record, "attachment")

    # The rest

    def _pass_of(self, subject: Subject) -> Pass | None:
        if subject.render_pass is not None:
            return subject.render_pass
        if subject.subpass is not None:
            return subject.subpass.render_pass
        if subject.resolve is not None:
            return subject.resolve.render_pass
        return self._pass_at.get(subject.path)

    @cached_property
    def _pass_at(self) -> dict[str, Pass]:
        """The passes by the paths of their attachments, subpasses and dependencies."""
        return {
            record.path: render_pass
            for render_pass in self.frame.passes
            for record in _parts(render_pass)
        }

    def _pass(self, subject: Subject, member: str) -> Iterator[Place]:
        render_pass = self._pass_of(subject)
        if render_pass is not None:
            yield (render_pass.record, member)

    def _subpasses(self, subject: Subject, member: str) -> Iterator[Place]:
        render_pass = self._pass_of(subject)
        yield from (
            (subpass.record, member)
            for subpass in (render_pass.subpasses if render_pass is not None else ())
        )

    def _pipelines(self, subject: Subject, member: str) -> Iterator[Place]:
        if subject.subpass is not None:
            pipelines = pipelines_of(subject.subpass, self.analysis.walk)
            yield from ((pipeline, member) for pipeline in pipelines if pipeline is not None)

    def _pipeline(self, subject: Subject, member: str) -> Iterator[Place]:
        pipeline = subject.pipeline
        if pipeline is not None and not (
            member in ("renderPass", "subpass") and pipeline.states("rendering")
        ):
            yield (pipeline, member)

    def _read(self, subject: Subject, member: str) -> Iterator[Place]:
        body = self.frame.commands[subject.position].body if subject.position is not None else None
        if isinstance(body, ReadImage) and member in body.SHAPE:
            yield (body, member)
        elif member == "pipeline":
            pipelines = self.description.pipelines.values()
            yield from (
                ((pipeline, "stages") for pipeline in pipelines)
                if pipelines
                else [(self.description, "pipelines")]
            )

    def _copy(self, subject: Subject, member: str) -> Iterator[Place]:
        names = [subject.facts.values.get(f"copy.{end}") for end in ("source", "target")]
        targets = [self.frame.target(name) for name in names if isinstance(name, str)]
        yield from self._of_images([target for target in targets if target is not None], member)

    def _choice(self, subject: Subject) -> Record | None:
        return self._choices.get(subject.path)

    @cached_property
    def _choices(self) -> dict[str, Record]:
        return {choice.path: choice for choice in self.description.sampleCountChoices.values()}

    def _begins(self, subject: Subject, member: str) -> Iterator[Place]:
        render_pass = self._pass_of(subject)
        for position in render_pass.begun if render_pass is not None else ():
            body = self.frame.commands[position].body
            if isinstance(body, BeginRenderPass):
                yield (body, member)

    def _device(self, subject: Subject, member: str) -> Iterator[Place]:
        """The device, and of one that the description describes, a member. A device that is only
        named says all that it says.
        """
        device = self.description.device
        if device is None and self.analysis.device is None:
            yield (self.description, "device")
        elif isinstance(device, Device):
            resolve = subject.resolve
            if member == "resolveModes":
                member = (
                    "stencilResolveModes"
                    if resolve is not None and resolve.aspect == "stencil"
                    else "depthResolveModes"
                )
            if member != "sampleCounts":
                yield (device, member)
                return
            formats = {target.format for target in self._images(subject)} - {None}
            for format in formats:
                for aspect in format.aspects if format is not None else ():
                    integer = aspect == "color" and format is not None and format.is_integer
                    yield (device, f"sampleCounts.{'integer' if integer else aspect}")

    def _in_metal(self, record: Record, path: str, subject: Subject) -> Iterator[Place]:
        """A key in Metal's terms, if it has one."""
        metal = self.description.metal
        assert metal is not None and self.lowered is not None
        if isinstance(record, Image):
            texture = metal.textures.get(record.key)
            if texture is not None and path in _METAL_IMAGE:
                yield (texture, _METAL_IMAGE[path])
        elif isinstance(record, Pipeline):
            pipeline = metal.renderPipelines.get(record.key)
            if pipeline is not None and path in _METAL_PIPELINE:
                yield (pipeline, _METAL_PIPELINE[path])
        elif id(record) in self.lowered.attachments:
            stated = self.lowered.attachments[id(record)]
            aspect = subject.aspect.name if subject.aspect is not None else None
            structures = (
                [stated[aspect]]
                if aspect is not None and aspect in stated
                else list(stated.values())
            )
            if path == "resolveFilter":
                names = {
                    each: next(
                        (name for name in each.SHAPE if name.endswith("ResolveFilter")), None
                    )
                    for each in structures
                }
                yield from ((each, name) for each, name in names.items() if name is not None)
            elif path in _METAL_ATTACHMENT:
                yield from ((each, _METAL_ATTACHMENT[path]) for each in structures)
        elif record is self.description:
            yield (metal, path) if path == "commands" else (record, path)


# Not in each object, which would refer to itself: it would keep all that is known of a frame until
# garbage is collected.
_PARTS: dict[str, Callable[[MissingKeys, Subject, str], Iterable[Place]]] = {
    "image": lambda keys, subject, member: keys._of_images(keys._images(subject), member),
    "attachment": MissingKeys._attachment,
    "subpasses": MissingKeys._subpasses,
    "attachments": MissingKeys._attachments,
    "pipelines": MissingKeys._pipelines,
    "pass": MissingKeys._pass,
    "resolve": lambda _, subject, member: _of_resolve(subject.resolve, member),
    "pair": lambda _, subject, member: _of_resolve(
        subject.resolve.pair if subject.resolve is not None else None, member
    ),
    "source": lambda keys, subject, member: keys._of_end(subject, member, "source"),
    "target": lambda keys, subject, member: keys._of_end(subject, member, "target"),
    "dependency": lambda _, subject, member: _one(subject.dependency, member),
    "pipeline": MissingKeys._pipeline,
    "read": MissingKeys._read,
    "copy": MissingKeys._copy,
    "choice": lambda keys, subject, member: _one(keys._choice(subject), member),
    "begins": MissingKeys._begins,
    "device": MissingKeys._device,
}
"""What finds the records for each part of the frame."""


def _parts(render_pass: Pass) -> Iterator[Record]:
    yield from (attachment.record for attachment in render_pass.attachments)
    yield from (subpass.record for subpass in render_pass.subpasses)
    yield from render_pass.record.dependencies if isinstance(render_pass.record, RenderPass) else ()


def _one(record: Record | None, member: str) -> list[Place]:
    return [(record, member)] if record is not None else []


def resolve_mode(resolve: Resolve) -> Place | None:
    """The member that states a resolve's mode, or None if Vulkan prescribes the mode."""
    if resolve.kind == RENDERING:
        return (resolve.record, "resolveMode")
    if resolve.kind == "command":
        member = "stencilResolveMode" if resolve.aspect == "stencil" else "resolveMode"
        return (resolve.record, member) if states_mode(resolve.record) else None
    member = f"{resolve.aspect}ResolveMode"
    return (resolve.record, member) if member in resolve.record.SHAPE else None


def _of_resolve(resolve: Resolve | None, member: str) -> Iterator[Place]:
    if resolve is None:
        return
    if member == "mode":
        place = resolve_mode(resolve)
        if place is not None:
            yield place


def _unstated(record: Record, path: str) -> MissingKey | None:
    """The first member on a path from a record that is not stated; None if all are, or if the
    record has no such member.
    """
    name, _, rest = path.partition(".")
    shape = record.SHAPE.get(name)
    if shape is None:
        return None
    if not record.states(name):
        return MissingKey(record.path, spelled(record, path), values(shape, path), record.head)
    value = getattr(record, name)
    parts = value if isinstance(value, tuple) else (value,)
    if not rest:
        return None
    inner = (_unstated(part, rest) for part in parts if isinstance(part, Record))
    return next((missing for missing in inner if missing is not None), None)
