"""What of a capture concerns multisampling: the multisampled images, what feeds them, what they
feed, and the passes of these.

A program may draw thousands of images that have nothing to do with them, such as a user interface.
Those are counted, not described.
"""

from collections.abc import Collection, Hashable, Iterable, Iterator
from typing import Any, NamedTuple

from .command_buffers import PASS_BEGINS, PASS_ENDS, RecordedCommand, RenderPassBegin
from .command_writer import commands_of
from .frame_kinds import FrameKind, Role
from .objects import Image, Pipeline, RenderPass, images_in

COPIES = ("resolveImage", "copyImage", "blitImage")


class Step(NamedTuple):
    """A pass, or the commands between two passes that belong together: the images that it has as
    attachments, reads, and writes.

    `multisampled` is whether it concerns multisampling by itself.
    """

    attachments: Collection[Image]
    reads: Collection[Image]
    writes: Collection[Image]
    multisampled: bool


class MultisampledPart:
    """The images of the kinds of frame that concern multisampling, and by kind the numbers of its
    passes that use them.
    """

    def __init__(self, kinds: Iterable[FrameKind]) -> None:
        self._passes = {kind: list(_passes(kind)) for kind in kinds}
        between = [step for kind in self._passes for step in _between(kind)]
        self.images = _closure(
            [*(step for steps in self._passes.values() for step in steps), *between]
        )

    def add_pass(self, kind: FrameKind, number: int) -> None:
        """Adds a pass of a kind."""
        step = self._passes[kind][number]
        self._passes[kind][number] = step._replace(multisampled=True)
        self.images.update(step.attachments)

    def passes(self, kind: FrameKind) -> set[int]:
        """The numbers of the passes of a kind that are described."""
        steps = enumerate(self._passes[kind])
        return {
            number
            for number, step in steps
            if step.multisampled or not self.images.isdisjoint(step.attachments)
        }


def _closure(steps: list[Step]) -> set[Image]:
    """The multisampled images, what feeds them and what they feed, and the other attachments of the
    passes of these.
    """
    by_image: dict[Image, list[Step]] = {}
    found: dict[str, set[Image]] = {"feeds": set(), "fed": set(), "beside": set()}
    pending: list[tuple[str, Image]] = []

    def add(how: Iterable[str], images: Iterable[Image]) -> None:
        images = list(images)
        for each in how:
            new = [image for image in images if image not in found[each]]
            found[each].update(new)
            pending.extend((each, image) for image in new)

    for step in steps:
        images = dict.fromkeys([*step.attachments, *step.reads, *step.writes])
        for image in images:
            by_image.setdefault(image, []).append(step)
        add(("feeds", "fed"), (image for image in images if image.samples > 1))
        if step.multisampled:
            add(("feeds", "fed"), [*step.attachments, *step.writes])
            add(("feeds",), step.reads)
    done: set[tuple[str, int]] = set()
    while pending:
        how, image = pending.pop()
        for step in by_image.get(image, ()):
            writes = image in step.attachments or image in step.writes
            if (
                (how == "feeds" and not writes)
                or (how == "beside" and image not in step.attachments)
                or (how, id(step)) in done
            ):
                continue
            done.add((how, id(step)))
            if how == "fed":
                add(("fed",), [*step.attachments, *step.writes])
            elif how == "feeds":
                add(("feeds",), [*step.attachments, *step.reads])
            add(("beside",), step.attachments)
    return found["feeds"] | found["fed"] | found["beside"]


def _passes(kind: FrameKind) -> Iterator[Step]:
    """The passes of a kind of frame."""
    for number, begin in enumerate(kind.passes):
        commands = kind.pass_commands[number].values()
        attachments = dict.fromkeys(images_in(begin.key))
        for alternate in kind.alternates[number].values():
            attachments.update(
                dict.fromkeys(image for image in alternate.images if image is not None)
            )
        reads, writes = _uses(kind, commands)
        multisampled = is_multisampled_pass(begin) or any(
            command.kind == "draw" and _is_multisampled_draw(command) for command in commands
        )
        yield Step(attachments.keys(), reads, writes, multisampled)


def _between(kind: FrameKind) -> Iterator[Step]:
    """The commands between passes: each transfer, and the reads and writes of shaders that follow
    each other.
    """
    shaders: list[RecordedCommand] = []
    is_in_pass = False
    for command, _ in commands_of(kind):
        if command.kind in (*PASS_BEGINS, *PASS_ENDS):
            is_in_pass = command.kind in PASS_BEGINS
        if is_in_pass:
            continue
        if command.kind in ("readImage", "writeImage"):
            shaders.append(command)
            continue
        if shaders:
            yield Step((), *_uses(kind, shaders), False)
            shaders = []
        if command.kind in COPIES:
            key: Any = command.key
            source, target = image_of(kind, key[0]), image_of(kind, key[1])
            reads, writes = ([image] if image is not None else [] for image in (source, target))
            yield Step((), reads, writes, command.kind == "resolveImage")
    if shaders:
        yield Step((), *_uses(kind, shaders), False)


def image_of(kind: FrameKind, part: object) -> Image | None:
    """The image that a part of a command's key stands for."""
    if isinstance(part, Role):
        return kind.images[part]
    return part if isinstance(part, Image) else None


def _uses(
    kind: FrameKind, commands: Iterable[RecordedCommand]
) -> tuple[Collection[Image], Collection[Image]]:
    """The images that commands read and write."""
    uses: dict[str, dict[Image, None]] = {"readImage": {}, "writeImage": {}}
    for command in commands:
        if command.kind in uses:
            key: Any = command.key
            image = image_of(kind, key[0] if isinstance(key, tuple) else key)
            if image is not None:
                uses[command.kind][image] = None
    return uses["readImage"].keys(), uses["writeImage"].keys()


def is_multisampled_pass(begin: RecordedCommand) -> bool:
    """Whether a pass has multisampled attachments, or resolves."""
    if isinstance(begin.key, RenderPassBegin):
        return is_multisampled(begin.key.render_pass) or any(
            image is not None and image.samples > 1 for image in begin.key.images
        )
    return "resolveImage" in _names(begin.key) or any(
        image.samples > 1 for image in images_in(begin.key)
    )


def _names(key: Hashable) -> Iterator[str]:
    """The names of the members in the key of a rendering."""
    if isinstance(key, tuple):
        for item in key:
            yield from _names(item)
    elif isinstance(key, str):
        yield key


def is_multisampled(created: RenderPass | Pipeline) -> bool:
    """Whether a render pass has multisampled attachments or resolves, or a pipeline concerns
    samples.
    """
    tree = created.tree
    if isinstance(created, Pipeline):
        state = tree.get("multisampleState", {})
        concerns = ("sampleShadingEnable", "alphaToCoverageEnable", "alphaToOneEnable")
        return (
            created.dynamic_samples
            or (state.get("rasterizationSamples") or 1) != 1
            or any(state.get(name) for name in concerns)
        )
    if any((attachment.get("samples") or 1) != 1 for attachment in tree.get("attachments", ())):
        return True
    resolving = ("resolveAttachments", "depthStencilResolve", "multisampledRenderToSingleSampled")
    return any(subpass.get(name) for subpass in tree.get("subpasses", ()) for name in resolving)


def _is_multisampled_draw(command: RecordedCommand) -> bool:
    key: Any = command.key
    pipeline, _, _, samples = key
    return (samples or 1) > 1 or (
        pipeline is not None and not pipeline.dynamic_samples and is_multisampled(pipeline)
    )
