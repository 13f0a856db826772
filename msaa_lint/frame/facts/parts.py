"""The parts of a frame: images, attachments, resolves, subpasses and passes of both kinds in one
form.

A pass is a VkRenderPass or one vkCmdBeginRendering. What the description does not say is None here
too.

The frame owns its passes, a pass its subpasses and attachments, and a subpass its resolves. Other
references are weak, so that a frame is freed when its last user drops it. They raise a
ReferenceError once their object is gone: keep the pass with its parts.
"""

from __future__ import annotations

from functools import cached_property
from typing import NamedTuple, TypeVar
from weakref import ref

from msaa_lint.core.text.span import Span
from msaa_lint.frame.description.models import (
    AttachmentDescription,
    BeginRendering,
    Image,
    RenderingAttachment,
    RenderPass,
    Subpass,
)
from msaa_lint.frame.description.record import Record
from msaa_lint.frame.vulkan.formats import Format, format_of

RENDER_PASS = "renderPass"
RENDERING = "rendering"

RESUMED, SUSPENDED = "RESUMED", "SUSPENDED"
"""In place of operations that are stated but not performed: a resumed rendering does not load, a
suspended one does not store.
"""

PartType = TypeVar("PartType")


class Target:
    """An image that is rendered to. An attachment that names no image has one of its own, of which
    only that much is known.
    """

    __slots__ = ("format", "image", "path", "record", "samples")

    def __init__(
        self, record: Record, image: Image | None, format: str | None, samples: int | None
    ) -> None:
        self.record = record
        self.image = image
        self.path = record.path
        self.format: Format | None = format_of(format) if format is not None else None
        self.samples = samples

    @property
    def name(self) -> str:
        return self.record.key

    @property
    def size(self) -> tuple[int | None, int | None] | None:
        """The stated width and height; None where no extent is."""
        extent = self.image.extent if self.image is not None else None
        return (extent.width, extent.height) if extent is not None else None

    @property
    def title(self) -> str:
        """What messages call it: its name, or the attachment that it stands for."""
        return (
            f"attachment {self.name}" if self.image is None and self.name.isdecimal() else self.name
        )


class Aspect(NamedTuple):
    """One aspect of an attachment, with the load and store operation that the pass performs, and
    the members that state them.

    `name` is None where the format, and with it what `loadOp` means, is unknown.
    """

    name: str | None
    load: str | None
    store: str | None
    load_member: str
    store_member: str


class Attachment:
    """One attachment of a pass. The role sets hold the subpasses (0 in dynamic rendering) that use
    it so.
    """

    def __init__(
        self,
        record: AttachmentDescription | RenderingAttachment,
        name: str,
        index: int,
        targets: list[Target],
    ) -> None:
        self.record = record
        self.name = name
        self.index = index
        self.targets = targets
        self.format: Format | None = None
        self.samples: int | None = None
        self.aspects: list[Aspect] = []
        self.color: set[int] = set()
        self.depth_stencil: set[int] = set()
        self.resolve: dict[int, set[str]] = {}
        """By subpass: the aspects that a resolve with a source and a mode overwrites here; `?` for
        one whose mode is unknown.
        """
        self._resolved: list[ref[Resolve]] = []
        self.input: set[int] = set()
        self.rate: set[int] = set()
        """The subpasses that it is the fragment density map or the shading rate attachment of,
        which read it.
        """
        self.preserve: set[int] = set()

    @property
    def title(self) -> str:
        """What messages call it: its name; where attachments are a list its image's with its index,
        or `attachment 2` without one.
        """
        if not self.name.isdecimal():
            return self.name
        target = self.target
        named = target is not None and target.image is not None
        return (
            f"{target.name} (attachment {self.name})"
            if named and target is not None
            else f"attachment {self.name}"
        )

    @property
    def resolved(self) -> list[Resolve]:
        """The resolves within the pass that read it."""
        return [_alive(resolve) for resolve in self._resolved]

    def add_resolve(self, resolve: Resolve) -> None:
        """Adds a resolve within the pass that reads it."""
        self._resolved.append(ref(resolve))

    @property
    def used(self) -> bool:
        """Whether a subpass refers to it at all."""
        return bool(self.color or self.depth_stencil or self.resolve or self.input or self.rate)

    @property
    def only_rate(self) -> bool:
        """Whether it is nothing but a fragment density map or shading rate attachment, which is not
        as large as the others.
        """
        return bool(self.rate) and not (
            self.color or self.depth_stencil or self.resolve or self.input
        )

    @property
    def drawn(self) -> bool:
        """Whether a subpass draws to it."""
        return bool(self.color or self.depth_stencil)

    @property
    def target(self) -> Target | None:
        """Its image, where it is one and the same whenever the pass is begun."""
        record = self.targets[0].record if self.targets else None
        return (
            self.targets[0]
            if record is not None and all(target.record is record for target in self.targets)
            else None
        )


class Resolve:
    """One resolve of one aspect: in a subpass, at the end of a dynamic rendering, or by
    vkCmdResolveImage.

    `record` states it; `mode` is None where unknown; `mode_at`, `source_at` and `target_at` are
    where these are stated.
    """

    def __init__(self, kind: str, aspect: str, record: Record, path: str) -> None:
        self.kind = kind
        self.aspect = aspect
        self.record = record
        self.path = path
        self._render_pass: ref[Pass] | None = None
        self.subpass = 0
        self.mode: str | None = None
        self.mode_at: Span = record.head
        self.source: Attachment | None = None
        self.source_image: Target | None = None
        self.source_at: Span = record.head
        self.target: Attachment | None = None
        self.target_image: Target | None = None
        self.target_at: Span = record.head
        self._pair: ref[Resolve] | None = None

    @property
    def render_pass(self) -> Pass | None:
        """The pass that it is part of; None for a command."""
        return _alive(self._render_pass) if self._render_pass is not None else None

    @render_pass.setter
    def render_pass(self, render_pass: Pass) -> None:
        self._render_pass = ref(render_pass)

    @property
    def pair(self) -> Resolve | None:
        """The resolve of the other aspect by the same structure, or of the same rendering; without
        a pass where it states NONE alone.
        """
        return _alive(self._pair) if self._pair is not None else None

    @pair.setter
    def pair(self, pair: Resolve) -> None:
        self._pair = ref(pair)

    @property
    def read_part(self) -> Attachment | Target | None:
        """What it reads: an attachment, an image where there is none."""
        return self.source or self.source_image

    @property
    def written_part(self) -> Attachment | Target | None:
        """What it writes: an attachment, an image where there is none."""
        return self.target or self.target_image

    @property
    def is_certain(self) -> bool:
        """Whether it is known to resolve something."""
        return self.mode not in (None, "NONE")


def states_mode(record: Record) -> bool:
    """Whether a vkCmdResolveImage2 has a VkResolveImageModeInfoKHR."""
    return record.states("resolveMode") or record.states("stencilResolveMode")


def sizes_differ(one: Target | None, other: Target | None) -> bool:
    """Whether two images are known to differ in width or height."""
    return (
        one is not None
        and other is not None
        and None not in (one.size, other.size)
        and one.size != other.size
    )


class PassSubpass:
    """A subpass; a dynamic rendering has one."""

    __slots__ = (
        "_render_pass", "color", "depth_stencil", "index", "path", "record", "resolves",
        "single_sampled", "single_sampled_count", "unresolved",
    )  # fmt: skip

    def __init__(self, render_pass: Pass, record: Subpass | BeginRendering, index: int) -> None:
        self._render_pass = ref(render_pass)
        self.record = record
        self.index = index
        self.path = record.path
        self.color: list[Attachment | None] = []
        self.depth_stencil: list[Attachment] = []
        self.resolves: list[Resolve] = []
        self.unresolved: list[Resolve] = []
        """What states NONE, and no image, for the depth or stencil aspect of a rendering: the
        `pair` of the other aspect's resolve.
        """
        chained = record.multisampledRenderToSingleSampled
        self.single_sampled = (
            chained is not None and chained.multisampledRenderToSingleSampledEnable is not False
        )
        self.single_sampled_count = (
            chained.rasterizationSamples if chained is not None and self.single_sampled else None
        )

    @property
    def render_pass(self) -> Pass:
        """The pass that it is part of."""
        return _alive(self._render_pass)


class Pass:
    """A render pass or a dynamic rendering. `begun` are the positions in the frame's commands where
    it begins.
    """

    def __init__(self, kind: str, name: str, record: RenderPass | BeginRendering) -> None:
        self.kind = kind
        self.name = name
        self.record = record
        self.path = record.path
        self.attachments: list[Attachment] = []
        self.subpasses: list[PassSubpass] = []
        self.begun: list[int] = []
        self.rates: list[Target] = []
        """The fragment density map and the shading rate attachment of a rendering, which reads them
        and has no operations for them.
        """
        self.partial_area: bool | None = False
        """Whether some render area that it is begun with is smaller than what it renders to; None
        where a size is not stated.
        """

    @property
    def suspends(self) -> bool:
        """Whether it is a rendering that goes on in another one, which stores and resolves."""
        return isinstance(self.record, BeginRendering) and "SUSPENDING" in self.record.flags

    @property
    def resumes(self) -> bool:
        """Whether it is a rendering that goes on from another one, which loaded."""
        return isinstance(self.record, BeginRendering) and "RESUMING" in self.record.flags

    @property
    def resolves(self) -> list[Resolve]:
        """The resolves of its subpasses."""
        return [resolve for subpass in self.subpasses for resolve in subpass.resolves]

    @cached_property
    def structures(self) -> int:
        """How many attachments, references to them, and dependencies it has."""
        references = (
            1
            + len(each.color)
            + len(each.depth_stencil)
            + len(each.resolves)
            + len(getattr(each.record, "inputAttachments", ()))
            for each in self.subpasses
        )
        return (
            len(self.attachments) + sum(references) + len(getattr(self.record, "dependencies", ()))
        )

    @cached_property
    def unread(self) -> bool:
        """Whether a pNext chain of it has a structure that was not read, which may use its
        attachments in any way.
        """
        records = (
            self.record,
            *(each.record for each in self.subpasses),
            *(each.record for each in self.attachments),
        )
        return any(record.pNext for record in records)

    @cached_property
    def custom_resolve(self) -> bool:
        """Whether a subpass (or the rendering) resolves by its own shader."""
        flags = (flag for subpass in self.subpasses for flag in subpass.record.flags)
        return any(flag.startswith(("CUSTOM_RESOLVE", "SHADER_RESOLVE")) for flag in flags)


def _alive(reference: ref[PartType]) -> PartType:
    part = reference()
    if part is None:
        raise ReferenceError("a part of a frame was kept without its pass")
    return part
