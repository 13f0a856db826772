"""The frame as Vulkan sees it: its passes with their attachments, resolves and images joined."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import cached_property
from typing import TypeVar

from msaa_lint.frame.description.document import Document, StencilApart
from msaa_lint.frame.description.models import (
    AttachmentDescription,
    AttachmentReference,
    BeginRendering,
    BeginRenderPass,
    Command,
    Framebuffer,
    Pipeline,
    ReadImage,
    ResolveImage,
    Subpass,
)
from msaa_lint.frame.description.record import Record
from msaa_lint.frame.vulkan.formats import format_of

from .parts import (
    RENDER_PASS,
    RENDERING,
    RESUMED,
    SUSPENDED,
    Aspect,
    Attachment,
    Pass,
    PassSubpass,
    Resolve,
    Target,
    states_mode,
)

RecordType = TypeVar("RecordType", bound=Record)


class Frame:
    """All of a description, joined."""

    def __init__(self, document: Document) -> None:
        self.document = document
        self.description = document.description
        self.targets: dict[str, Target] = {
            name: Target(image, image, image.format, image.samples)
            for name, image in self.description.images.items()
        }
        self.commands: tuple[Command, ...] = tuple(
            c for c in self.description.commands or () if c is not None
        )
        self.passes: list[Pass] = []
        self._named: dict[str, Pass] = {}
        self._columns: dict[str, list[dict[str, None]]] = {}
        """By render pass: for each attachment the images that framebuffers bind to it."""
        self.pipelines: list[tuple[Pipeline, Pass | None]] = []
        self.resolve_commands: list[tuple[int, Resolve]] = []
        self._begins_unnamed = False
        """Whether a command begins a render pass that is not stated."""
        self.framebuffers = self._used_framebuffers()
        self._complete_targets()
        self._render_passes()
        self._renderings()
        self._commands()
        for pipeline in self.description.pipelines.values():
            self.pipelines.append((pipeline, self.render_pass(pipeline.renderPass)))

    @property
    def all_targets(self) -> list[Target]:
        """The images, then those that stand for attachments without one."""
        return [*self.targets.values(), *_implied(self.passes)]

    @property
    def run_targets(self) -> list[Target]:
        """Those of `all_targets` that are images, or stand for attachments of passes that the frame
        may run.
        """
        run = [
            render_pass for render_pass in self.passes if self.whether_begun(render_pass) != "NO"
        ]
        return [*self.targets.values(), *_implied(run)]

    @property
    def has_commands(self) -> bool:
        """Whether what is recorded is known, and in which order."""
        return self.description.commands is not None and self.document.ordered

    def whether_begun(self, render_pass: Pass) -> str:
        """Whether the frame begins a pass: YES, NO, or NOT_STATED.

        Programs create render passes only to create pipelines, which a compatible pass then uses
        (Vulkan specification, "Render Pass Compatibility"). A description without `commands` is of
        what a frame runs. A part of a frame, or one with an empty list of commands, such as a
        database of pipelines, does not state what runs.
        """
        if render_pass.begun or not self.document.ordered:
            return "YES"
        if self.commands:
            return "NOT_STATED" if self._begins_unnamed else "NO"
        return "NOT_STATED" if self.has_commands or not self.document.whole else "YES"

    def recorded(self, kind: type[RecordType]) -> Iterator[tuple[int, RecordType]]:
        """The positions and the parameters of the commands that have parameters of a type."""
        return (
            (position, command.body)
            for position, command in enumerate(self.commands)
            if isinstance(command.body, kind)
        )

    def framebuffers_of(self, begin: object) -> list[Framebuffer]:
        """The framebuffers that the parameters of a vkCmdBeginRenderPass name: several where they
        alternate from frame to frame.
        """
        names = begin.framebuffer if isinstance(begin, BeginRenderPass) else None
        stated = self.description.framebuffers
        return [
            stated[name]
            for name in ((names,) if isinstance(names, str) else names or ())
            if name in stated
        ]

    @cached_property
    def structures(self) -> int:
        """How many structures state its passes, framebuffers and commands."""
        bound = sum(
            1 + len(framebuffer.attachments)
            for framebuffer in self.description.framebuffers.values()
        )
        return (
            sum(render_pass.structures for render_pass in self.passes) + bound + len(self.commands)
        )

    def pipelines_of(self, render_pass: Pass, index: int) -> list[Pipeline | None]:
        """The pipelines made for a subpass of a render pass; a last None for those that do not
        state which of several subpasses.
        """
        stated = self._pipelines_by_subpass.get((id(render_pass), index), [])
        return [*stated, *self._pipelines_by_subpass.get((id(render_pass), None), [])]

    @cached_property
    def pipelines_by_pass(self) -> dict[int, list[Pipeline]]:
        """The pipelines by the render pass, by identity, that they are made for."""
        found: dict[int, list[Pipeline]] = {}
        for pipeline, render_pass in self.pipelines:
            found.setdefault(id(render_pass), []).append(pipeline)
        return found

    @cached_property
    def _pipelines_by_subpass(self) -> dict[tuple[int, int | None], list[Pipeline | None]]:
        found: dict[tuple[int, int | None], list[Pipeline | None]] = {}
        for pipeline, render_pass in self.pipelines:
            if render_pass is None:
                continue
            only = 0 if len(render_pass.subpasses) == 1 else None
            index = only if pipeline.subpass is None else pipeline.subpass
            if index is None:
                found[id(render_pass), None] = [None]
            else:
                found.setdefault((id(render_pass), index), []).append(pipeline)
        return found

    def render_pass(self, name: str | None) -> Pass | None:
        return self._named.get(name) if name is not None else None

    def target(self, name: str | None) -> Target | None:
        return self.targets.get(name) if name is not None else None

    def may_be_read(self, name: str) -> bool:
        """Whether something that is not described may read an image."""
        target = self.targets.get(name)
        return target is not None and target.image is not None and bool(target.image.mayBeRead)

    def _complete_targets(self) -> None:
        """Gives images the format and count that they leave out and an attachment they are bound to
        states.

        The two must agree (VUID-VkFramebufferCreateInfo-pAttachments-00880, 00881).
        """
        for name, record in self.description.renderPasses.items():
            for index, description in enumerate(record.attachments):
                bound = self._bound(name, index) or [description.image or ""]
                for target in (self.targets[image] for image in bound if image in self.targets):
                    if target.samples is None:
                        target.samples = description.samples
                    if target.format is None and description.format is not None:
                        target.format = format_of(description.format)

    def _render_passes(self) -> None:
        for name, record in self.description.renderPasses.items():
            made = Pass(RENDER_PASS, name, record)
            for index, description in enumerate(record.attachments):
                made.attachments.append(self._described(name, description, index))
            named = {a.name: a for a in made.attachments}
            made.subpasses = [
                self._subpass(made, subpass, n, named) for n, subpass in enumerate(record.subpasses)
            ]
            density_map = _referred(made, record.fragmentDensityMapAttachment, named)
            if density_map is not None:
                density_map.rate.update(range(max(len(made.subpasses), 1)))
            # A slot of Metal's says which aspects it is attached for.
            slots = self.document.metal.attachments if self.document.metal is not None else {}
            for attachment in made.attachments:
                # Of the formats that a program selects from, only S8_UINT has no depth.
                selected = (
                    ("depth",) if attachment.depth_stencil and not self.document.whole else ()
                )
                attachment.aspects = _aspects(
                    attachment, tuple(slots.get(id(attachment.record), selected))
                )
            self.passes.append(made)
            self._named[name] = made

    def _described(
        self, render_pass: str, description: AttachmentDescription, index: int
    ) -> Attachment:
        targets = [
            self.targets[name] for name in self._bound(render_pass, index) if name in self.targets
        ]
        if not targets:
            targets = [
                self.target(description.image)
                or Target(description, None, description.format, description.samples)
            ]
        made = Attachment(description, description.key, index, targets)
        formats, counts = {t.format for t in targets}, {t.samples for t in targets}
        made.format = (
            format_of(description.format)
            if description.format is not None
            else formats.pop()
            if len(formats) == 1
            else None
        )
        made.samples = (
            description.samples
            if description.samples is not None
            else counts.pop()
            if len(counts) == 1
            else None
        )
        return made

    def _bound(self, render_pass: str, index: int) -> list[str]:
        """The images that framebuffers bind to an attachment: those the commands begin it with,
        else the only one for it.
        """
        if render_pass not in self._columns:
            columns: list[dict[str, None]] = []
            for framebuffer in self.framebuffers.get(render_pass, ()):
                columns.extend({} for _ in range(len(columns), len(framebuffer.attachments)))
                for column, name in zip(columns, framebuffer.attachments, strict=False):
                    if name is not None:
                        column[name] = None
            self._columns[render_pass] = columns
        return (
            list(self._columns[render_pass][index])
            if index < len(self._columns[render_pass])
            else []
        )

    def _used_framebuffers(self) -> dict[str, list[Framebuffer]]:
        """By render pass: the framebuffers that the commands begin it with; where they name none,
        the only one for it.
        """
        used: dict[str, list[Framebuffer]] = {}
        for framebuffer in self.description.framebuffers.values():
            used.setdefault(framebuffer.renderPass or "", []).append(framebuffer)
        used = {name: own for name, own in used.items() if len(own) == 1}
        begun: dict[str, dict[str, Framebuffer]] = {}
        for _, body in self.recorded(BeginRenderPass):
            if body.renderPass is not None and body.framebuffer is not None:
                begun.setdefault(body.renderPass, {}).update(
                    (each.key, each) for each in self.framebuffers_of(body)
                )
        return {
            **used,
            **{name: list(framebuffers.values()) for name, framebuffers in begun.items()},
        }

    def _subpass(
        self, render_pass: Pass, record: Subpass, index: int, named: dict[str, Attachment]
    ) -> PassSubpass:
        made = PassSubpass(render_pass, record, index)

        def find(reference: AttachmentReference | None) -> Attachment | None:
            return _referred(render_pass, reference, named)

        for reference in record.colorAttachments:
            attachment = find(reference)
            made.color.append(attachment)
            if attachment is not None:
                attachment.color.add(index)
        for attachment in filter(None, map(find, record.inputAttachments)):
            attachment.input.add(index)
        rate = find(record.fragmentShadingRateAttachment)
        if rate is not None:
            rate.rate.add(index)
        for attachment in filter(None, map(find, record.preserveAttachments)):
            attachment.preserve.add(index)
        depth_stencil = find(record.depthStencilAttachment)
        if depth_stencil is not None:
            made.depth_stencil.append(depth_stencil)
            depth_stencil.depth_stencil.add(index)
        for n, reference in enumerate(record.resolveAttachments):
            target = find(reference)
            if target is None:
                continue
            slots = "resolveAttachments" if self.document.metal is None else "colorAttachments"
            resolve = Resolve("subpass", "color", record, f"{record.path}.{slots}[{n}]")
            resolve.source = made.color[n] if n < len(made.color) else None
            resolve.target = target
            resolve.mode = "AVERAGE"
            if (
                resolve.source is not None
                and resolve.source.format is not None
                and resolve.source.format.numeric in ("UINT", "SINT")
            ):
                resolve.mode = "SAMPLE_ZERO"
            resolve.target_at = resolve.mode_at = (
                reference.node.span if reference.node.kind == "scalar" else reference.head
            )
            resolve.source_at = (
                record.colorAttachments[n].place("attachment")
                if n < len(record.colorAttachments)
                else resolve.target_at
            )
            target.resolve.setdefault(index, set())
            if resolve.source is not None:
                target.resolve[index].add("color")
            self._joined(made, resolve, index)
        chained = record.depthStencilResolve
        if chained is not None and (target := find(chained.attachment)) is not None:
            self._depth_stencil_resolve(made, depth_stencil, target, index)
        if self.document.metal is not None and id(record) in self.document.metal.stencils:
            self._stencil_apart(made, self.document.metal.stencils[id(record)], named, index)
        return made

    def _stencil_apart(
        self, made: PassSubpass, apart: StencilApart, named: dict[str, Attachment], index: int
    ) -> None:
        """Adds the stencil attachment of a Metal pass whose texture is not its depth attachment's,
        and its resolve.
        """
        stencil = named[apart.attachment]
        made.depth_stencil.append(stencil)
        stencil.depth_stencil.add(index)
        if apart.target is None:
            return
        resolve = Resolve("subpass", "stencil", apart.record, apart.record.path)
        resolve.source, resolve.target = stencil, named[apart.target]
        resolve.mode = (
            "SAMPLE_ZERO" if apart.record.stencilResolveFilter != "depthResolvedSample" else None
        )
        resolve.mode_at = apart.record.place("stencilResolveFilter", "resolveTexture")
        resolve.source_at, resolve.target_at = (
            apart.record.place("texture"),
            apart.record.place("resolveTexture"),
        )
        resolve.target.resolve.setdefault(index, set()).add(
            "stencil" if resolve.mode is not None else "?"
        )
        self._joined(made, resolve, index)

    def _depth_stencil_resolve(
        self, made: PassSubpass, source: Attachment | None, target: Attachment, index: int
    ) -> None:
        record = made.record
        assert isinstance(record, Subpass) and record.depthStencilResolve is not None
        chained = record.depthStencilResolve
        pair: Resolve | None = None
        target.resolve.setdefault(index, set())
        # A target may leave an aspect of the source out, not add one (VUID-...-03181, 03182).
        known = target.format or (source.format if source is not None else None)
        certain = target.format is not None or (known is not None and len(known.aspects) == 1)
        for aspect, stated, other, member in (
            ("depth", chained.depthResolveMode, chained.stencilResolveMode, "depthResolveMode"),
            ("stencil", chained.stencilResolveMode, chained.depthResolveMode, "stencilResolveMode"),
        ):
            # A mode for an aspect that the target's format lacks is ignored
            # (VUID-VkSubpassDescriptionDepthStencilResolve-...-03178).
            if known is not None and aspect not in known.aspects:
                continue
            # A target that lacked the aspect would have none that is resolved if the other mode is
            # NONE.
            mode = stated if certain or "NONE" in (stated, other) else None
            resolve = Resolve("subpass", aspect, chained, chained.path)
            resolve.source, resolve.target, resolve.mode = source, target, mode
            resolve.mode_at = chained.place(member)
            resolve.target_at = chained.place("attachment")
            resolve.source_at = record.place("depthStencilAttachment")
            if mode != "NONE" and source is not None:
                target.resolve[index].add(aspect if mode is not None else "?")
            if pair is not None:
                resolve.pair, pair.pair = pair, resolve
            pair = resolve
            self._joined(made, resolve, index)

    @staticmethod
    def _joined(made: PassSubpass, resolve: Resolve, index: int) -> None:
        resolve.render_pass = made.render_pass
        resolve.subpass = index
        resolve.source_image = resolve.source.target if resolve.source is not None else None
        resolve.target_image = resolve.target.target if resolve.target is not None else None
        if resolve.source is not None:
            resolve.source.add_resolve(resolve)
        made.resolves.append(resolve)

    def _renderings(self) -> None:
        for number, (position, body) in enumerate(self.recorded(BeginRendering)):
            made = Pass(
                RENDERING, body.label if isinstance(body.label, str) else f"rendering{number}", body
            )
            made.begun.append(position)
            self._rendering(made, body)
            self.passes.append(made)

    def _rendering(self, made: Pass, record: BeginRendering) -> None:
        subpass = PassSubpass(made, record, 0)
        made.subpasses = [subpass]
        rates = (record.fragmentDensityMapAttachment, record.fragmentShadingRateAttachment)
        made.rates = [
            target
            for target in (self.target(rate.image) for rate in rates if rate is not None)
            if target is not None
        ]
        stated = [("color", a) for a in record.colorAttachments]
        stated += [("depth", record.depthAttachment), ("stencil", record.stencilAttachment)]
        pair: Resolve | None = None
        for aspect, info in stated:
            if info is None or info.image is None:
                if aspect == "color":
                    subpass.color.append(None)
                continue
            target = self.target(info.image)
            attachment = Attachment(
                info, info.image, len(made.attachments), [target] if target is not None else []
            )
            if target is not None:
                attachment.format, attachment.samples = target.format, target.samples
            # "Load operations are only performed at the beginning of a render pass instance that
            # does not specify the VK_RENDERING_RESUMING_BIT_KHR flag", stores at the end of one
            # without SUSPENDING (VkRenderingAttachmentInfo).
            load = RESUMED if made.resumes else info.loadOp
            store = SUSPENDED if made.suspends else info.storeOp
            attachment.aspects = [Aspect(aspect, load, store, "loadOp", "storeOp")]
            made.attachments.append(attachment)
            (attachment.color if aspect == "color" else attachment.depth_stencil).add(0)
            if info.imageLayout == "RENDERING_LOCAL_READ":
                attachment.input.add(0)
            if aspect == "color":
                subpass.color.append(attachment)
            else:
                subpass.depth_stencil.append(attachment)
            unresolved = info.resolveImage is None and info.resolveMode in (None, "NONE")
            if unresolved and (aspect == "color" or info.resolveMode is None):
                continue
            resolve = Resolve(RENDERING, aspect, info, info.path)
            resolve.source, resolve.mode = attachment, info.resolveMode
            resolve.mode_at = info.place("resolveMode", "resolveImage")
            resolve.source_at = info.place("image")
            resolve.target_at = info.place("resolveImage", "resolveMode")
            if unresolved:
                subpass.unresolved.append(resolve)
            else:
                self._joined(subpass, resolve, 0)
            resolve.target_image = self.target(info.resolveImage)
            if aspect != "color":
                if pair is not None:
                    resolve.pair, pair.pair = pair, resolve
                pair = resolve

    def _commands(self) -> None:
        rendering: dict[str, list[Attachment]] = {}
        begins = {
            position: render_pass
            for render_pass in self.passes
            if render_pass.kind == RENDERING
            for position in render_pass.begun
        }
        for position, command in enumerate(self.commands):
            body = command.body
            if command.kind in ("beginRendering", "endRendering"):
                rendering = {}
                for attachment in begins[position].attachments if position in begins else ():
                    rendering.setdefault(attachment.name, []).append(attachment)
            elif isinstance(body, ReadImage):
                # Inside a rendering that draws to it: a local read
                # (VK_KHR_dynamic_rendering_local_read).
                for attachment in rendering.get(body.image or "", ()):
                    attachment.input.add(0)
            if command.kind == "beginRenderPass":
                self._begins_unnamed = (
                    self._begins_unnamed or getattr(body, "renderPass", None) is None
                )
            if isinstance(body, BeginRenderPass):
                begun = self.render_pass(body.renderPass)
                if begun is not None:
                    begun.begun.append(position)
                    partial = self.partial(body, begun)
                    begun.partial_area = (
                        partial if partial or begun.partial_area is False else begun.partial_area
                    )
            elif command.kind == "resolveImage" and body is not None:
                self.resolve_commands.append((position, self._resolve_command(command)))
        for render_pass in self.passes:
            if render_pass.kind == RENDERING:
                render_pass.partial_area = self.partial(render_pass.record, render_pass)

    def _resolve_command(self, command: Command) -> Resolve:
        body = command.body
        assert isinstance(body, ResolveImage)
        source, target = self.target(body.srcImage), self.target(body.dstImage)
        # Of depth and stencil together, depth.
        aspect = (
            source.format.aspects[0]
            if source is not None and source.format is not None
            else "color"
        )
        member = "stencilResolveMode" if aspect == "stencil" else "resolveMode"
        resolve = Resolve("command", aspect, body, command.path)
        resolve.mode = getattr(body, member)
        resolve.mode_at = body.place(member) if body.states(member) else command.head
        resolve.source_image, resolve.target_image = source, target
        resolve.source_at, resolve.target_at = body.place("srcImage"), body.place("dstImage")
        averages = (
            source is not None
            and source.format is not None
            and source.format.numeric not in ("UINT", "SINT")
        )
        if aspect == "color" and averages and not states_mode(body):
            resolve.mode = "AVERAGE"
        return resolve

    def partial(self, record: Record, begun: Pass) -> bool | None:
        """Whether a stated render area is smaller than what it renders to; None where that is not
        known.
        """
        area = getattr(record, "renderArea", None)
        if area is None:
            return False
        pairs = list(zip((area.width, area.height), self._size(record, begun), strict=True))
        if (
            area.x
            or area.y
            or any(own is not None and whole is not None and own < whole for own, whole in pairs)
        ):
            return True
        return None if any(own is not None and whole is None for own, whole in pairs) else False

    def _size(self, record: Record, begun: Pass) -> tuple[int | None, int | None]:
        for framebuffer in self.framebuffers_of(record):
            if framebuffer.width is not None:
                return framebuffer.width, framebuffer.height
        for target in (
            target
            for attachment in begun.attachments
            if not attachment.only_rate
            for target in attachment.targets
        ):
            if target.size is not None:
                return target.size
        size = self.description.frame
        return (size.width, size.height) if size is not None else (None, None)


def _referred(
    render_pass: Pass, reference: AttachmentReference | None, named: dict[str, Attachment]
) -> Attachment | None:
    """The attachment of a pass, `named` by its name, that a reference means; None for
    VK_ATTACHMENT_UNUSED.
    """
    if reference is None or reference.attachment is None:
        return None
    if isinstance(reference.attachment, int):
        return (
            render_pass.attachments[reference.attachment]
            if reference.attachment < len(render_pass.attachments)
            else None
        )
    return named.get(reference.attachment)


def _implied(passes: Iterable[Pass]) -> list[Target]:
    """What stands for the images of the attachments that name none."""
    return [
        t
        for render_pass in passes
        for attachment in render_pass.attachments
        for t in attachment.targets
        if t.image is None
    ]


def _aspects(attachment: Attachment, stated: tuple[str, ...] = ()) -> list[Aspect]:
    """The aspects of a described attachment; where its format is unknown those that are `stated`,
    or what its use tells of them.
    """
    record = attachment.record
    assert isinstance(record, AttachmentDescription)
    if attachment.format is not None:
        names: tuple[str | None, ...] = attachment.format.aspects
    elif stated:
        names = stated
    else:
        names = (
            ("color",)
            if attachment.color
            or any("color" in aspects for aspects in attachment.resolve.values())
            else (None,)
        )
    return [
        Aspect(name, record.stencilLoadOp, record.stencilStoreOp, "stencilLoadOp", "stencilStoreOp")
        if name == "stencil"
        else Aspect(name, record.loadOp, record.storeOp, "loadOp", "storeOp")
        for name in names
    ]
