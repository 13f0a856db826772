"""The passes of a plan: render passes and dynamic renderings as they are described."""

from __future__ import annotations

from collections.abc import Sequence

from msaa_lint.frame.description.models import (
    AttachmentDescription,
    AttachmentReference,
    BeginRendering,
    DepthStencilResolve,
    RenderingAttachment,
    RenderPass,
    SubpassDependency,
)
from msaa_lint.frame.description.models import Subpass as DescribedSubpass
from msaa_lint.frame.facts.frame import Frame
from msaa_lint.frame.facts.parts import RENDERING, Attachment, PassSubpass
from msaa_lint.frame.facts.parts import Pass as Joined
from msaa_lint.frame.facts.pass_begin import targets_at

from . import parts
from .parts import LOAD, LOAD_DONT_CARE, NONE, STORE, STORE_DONT_CARE, TRANSIENT, UNDEFINED, Dependency, Framebuffer, Reference, Subpass
from .plan_images import Images
from .plan_integers import layout, mask, number

MOST = 256
"""Attachments, subpasses and dependencies of one pass, at most: more no device takes."""

CUSTOM = ("CUSTOM_RESOLVE", "SHADER_RESOLVE")
DEPTH_ALONE = {"DEPTH_ATTACHMENT_OPTIMAL", "DEPTH_READ_ONLY_OPTIMAL"}
"""The layouts that say nothing of stencil."""


class PassRefused(Exception):
    """Why no device can run a pass, in words."""


class Passes:
    """The passes of a frame, in `facts.Frame`'s order."""

    def __init__(self, frame: Frame, images: Images, api: int | None) -> None:
        self.frame = frame
        self.images = images
        self.text = images.text
        self.api = api
        self.read = {command.body.image for command in frame.commands if command.kind == "readImage" and command.body is not None}  # type: ignore[attr-defined]

    def made(self, each: Joined) -> parts.Pass:
        """A pass; with its reason where no device can run it."""
        kind = parts.RENDERING if each.kind == RENDERING else parts.RENDER_PASS
        empty = parts.Pass(each.name, each.path, kind, 0 if kind == parts.RENDERING else self._api(each))
        try:
            if each.custom_resolve:
                raise PassRefused("it resolves by a shader of its own, which is not driven here")
            return self._rendering(each, empty) if each.kind == RENDERING else self._render_pass(each, empty)
        except PassRefused as reason:
            return empty._replace(refused=str(reason))

    def _api(self, each: Joined) -> int:
        """The version of the structure that it is created by: the second, but for applications that have only the first."""
        if self.api is not None:
            return self.api
        enabled = self.frame.description.enabled
        version = enabled.apiVersion if enabled is not None else None
        if enabled is None or version is None or _version(version) >= (1, 2) or "VK_KHR_create_renderpass2" in (enabled.extensions or ()):
            return 2
        records = [s.record for s in each.subpasses if isinstance(s.record, DescribedSubpass)]
        second = any(s.single_sampled for s in each.subpasses) or any(r.depthStencilResolve or r.viewMask for r in records)
        return 2 if second else 1

    def _render_pass(self, each: Joined, made: parts.Pass) -> parts.Pass:
        record = each.record
        assert isinstance(record, RenderPass)
        if not record.subpasses:
            raise PassRefused("no subpass of it is described")
        if max(len(record.attachments), len(record.subpasses), len(record.dependencies)) > MOST:
            raise PassRefused(f"it has more than {MOST} attachments, subpasses or dependencies")
        attachments = tuple(self._attachment(a) for a in each.attachments)
        indices = {a.name: a.index for a in each.attachments}
        subpasses = tuple(self._subpass(each, n, s, indices) for n, s in enumerate(record.subpasses))
        dependencies = tuple(self._dependency(d, len(record.subpasses)) for d in record.dependencies)
        return made._replace(
            flags=mask("VkRenderPassCreateFlagBits", record.flags),
            attachments=attachments,
            subpasses=subpasses,
            dependencies=dependencies,
            framebuffers=self._framebuffers(each),
        )

    def _attachment(self, each: Attachment) -> parts.Attachment:
        record = each.record
        assert isinstance(record, AttachmentDescription)
        image = self.images.made[self.images.of(each.targets[0])]
        presentable = any(t.image is not None and t.image.presentable for t in each.targets)
        color = bool(image.aspects & parts.COLOR)
        own = parts.COLOR_LAYOUT if color else parts.DEPTH_LAYOUT
        load, store, stencil_load, stencil_store = self._operations(each, record, image)
        loads = load == LOAD or (stencil_load == LOAD and image.aspects & parts.STENCIL)
        read = any(t.image is not None and t.name in self.read for t in each.targets) or (bool(each.input) and not each.drawn)
        reading = parts.READ_LAYOUT if color else parts.DEPTH_READ_LAYOUT
        used = each.drawn or each.input or each.resolve
        kept = layout(record.initialLayout, UNDEFINED) or own
        final = parts.PRESENT_LAYOUT if presentable else reading if read else own if used else kept
        return parts.Attachment(
            number("VkFormat", record.format) if record.format is not None else image.format,
            record.samples or image.samples,
            mask("VkAttachmentDescriptionFlagBits", record.flags),
            load,
            store,
            stencil_load,
            stencil_store,
            layout(record.initialLayout, (reading if read and not each.drawn else own) if loads else UNDEFINED),
            layout(record.finalLayout, final),
            *self._stencil_layouts(record, image, stencil_load),
        )

    @staticmethod
    def _stencil_layouts(record: AttachmentDescription, image: parts.Image, load: int) -> tuple[int, int]:
        """The layouts of stencil alone: none, unless one is stated or that of the whole is of depth alone."""
        initial, final = layout(record.stencilInitialLayout, NONE), layout(record.stencilFinalLayout, NONE)
        alone = initial != NONE or final != NONE or {record.initialLayout, record.finalLayout} & DEPTH_ALONE
        if not image.aspects & parts.STENCIL or not alone:
            return NONE, NONE
        usual = parts.STENCIL_LAYOUT if load == LOAD else UNDEFINED
        return usual if initial == NONE else initial, parts.STENCIL_LAYOUT if final == NONE else final

    def _operations(self, each: Attachment, record: AttachmentDescription, image: parts.Image) -> tuple[int, int, int, int]:
        stated = (record.loadOp, record.storeOp, record.stencilLoadOp, record.stencilStoreOp)
        members = ("loadOp", "storeOp", "stencilLoadOp", "stencilStoreOp")
        kept = STORE_DONT_CARE if image.usage & TRANSIENT else STORE
        first = image.aspects & (parts.COLOR | parts.DEPTH)
        second = image.aspects & parts.STENCIL
        usual = (LOAD_DONT_CARE, kept, LOAD_DONT_CARE, kept if second else STORE_DONT_CARE)
        found = []
        for member, value, default, there in zip(members, stated, usual, (first, first, second, second), strict=True):
            load = member.endswith("oadOp")
            if value is None and there:
                self.text.append(f"{member} of {self._title(each)} is not stated: {'DONT_CARE' if load or default else 'STORE'} is taken")
            enum = "VkAttachmentLoadOp" if load else "VkAttachmentStoreOp"
            found.append(number(enum, value) if value is not None else default)
        return found[0], found[1], found[2], found[3]

    @staticmethod
    def _title(each: Attachment) -> str:
        return each.record.path

    def _reference(self, stated: AttachmentReference | None, indices: dict[str, int], usual: int) -> Reference:
        if stated is None or stated.attachment is None:
            return Reference(NONE, UNDEFINED)
        index = indices.get(stated.attachment, NONE) if isinstance(stated.attachment, str) else stated.attachment
        if not 0 <= index < len(indices):
            raise PassRefused(f"it refers to an attachment that there is not: {stated.attachment}")
        return Reference(index, layout(stated.layout, usual))

    def _subpass(self, each: Joined, at: int, record: DescribedSubpass, indices: dict[str, int]) -> Subpass:
        if record.pipelineBindPoint not in (None, "GRAPHICS"):
            raise PassRefused("a subpass of it is not for graphics")
        colors = [self._reference(r, indices, parts.COLOR_LAYOUT) for r in record.colorAttachments]
        resolves = [self._reference(r, indices, parts.COLOR_LAYOUT) for r in record.resolveAttachments]
        if resolves:
            # One resolve attachment for each colour attachment.
            width = max(len(colors), len(resolves))
            colors += [Reference(NONE)] * (width - len(colors))
            resolves += [Reference(NONE)] * (width - len(resolves))
        inputs = [self._input(each, at, self._reference(r, indices, parts.READ_LAYOUT), r.layout) for r in record.inputAttachments]
        drawn = {r.attachment for r in colors} & {r.attachment for r in inputs} - {NONE}
        colors = [r._replace(layout=parts.GENERAL) if r.attachment in drawn and r.layout == parts.COLOR_LAYOUT else r for r in colors]
        depth = self._reference(record.depthStencilAttachment, indices, parts.DEPTH_LAYOUT) if record.depthStencilAttachment else None
        if depth is not None and depth.attachment in {r.attachment for r in inputs} and depth.attachment != NONE:
            depth = depth._replace(layout=parts.DEPTH_READ_LAYOUT)
        chained = record.depthStencilResolve
        source = each.attachments[depth.attachment] if depth is not None and depth.attachment != NONE else None
        stencil = source is None or bool(self.images.made[self.images.of(source.targets[0])].aspects & parts.STENCIL)
        target = self._reference(chained.attachment, indices, parts.DEPTH_LAYOUT) if chained is not None else None
        preserves = tuple(self._reference(r, indices, UNDEFINED).attachment for r in record.preserveAttachments)
        own = each.subpasses[at]
        single = self._single_sampled(own, record.path)
        return Subpass(
            mask("VkSubpassDescriptionFlagBits", record.flags),
            tuple(inputs),
            tuple(colors),
            tuple(resolves),
            (depth,) if depth is not None and depth.attachment != NONE else (),
            (target,) if target is not None and target.attachment != NONE else (),
            self._mode(chained, "depthResolveMode") if chained is not None else 0,
            self._mode(chained, "stencilResolveMode", stencil) if chained is not None else 0,
            tuple(p for p in preserves if p != NONE),
            record.viewMask or 0,
            single,
        )

    def _input(self, each: Joined, at: int, made: Reference, stated: str | None) -> Reference:
        if made.attachment == NONE:
            return made
        attachment = each.attachments[made.attachment]
        image = self.images.made[self.images.of(attachment.targets[0])]
        both = at in attachment.color
        usual = parts.GENERAL if both else parts.DEPTH_READ_LAYOUT if not image.aspects & parts.COLOR else parts.READ_LAYOUT
        return made._replace(layout=made.layout if stated is not None else usual, aspects=image.aspects)

    def _single_sampled(self, own: PassSubpass, path: str) -> int:
        """The count that single-sampled attachments are rendered with; 0 where they are not."""
        if not own.single_sampled:
            return 0
        if own.single_sampled_count is not None:
            return own.single_sampled_count
        several = max([image.samples for image in self.images.made] or [1])
        taken = several if several > 1 else 4
        self.text.append(f"rasterizationSamples of {path}.multisampledRenderToSingleSampled is not stated: {taken} is taken")
        return taken

    def _mode(self, resolve: DepthStencilResolve, member: str, there: bool = True) -> int:
        """A resolve mode; sample zero, which every device has, where none is stated. Of an aspect that is not there nothing is said."""
        name = getattr(resolve, member)
        if name is None and there:
            self.text.append(f"{member} of {resolve.path} is not stated: SAMPLE_ZERO is taken")
        return number("VkResolveModeFlagBits", name) if name is not None else 1

    @staticmethod
    def _dependency(record: SubpassDependency, subpasses: int) -> Dependency:
        def end(stated: int | str | None) -> int:
            if stated is None or stated == "EXTERNAL":
                return NONE
            if not isinstance(stated, int) or not 0 <= stated < subpasses:
                raise PassRefused("a dependency of it names a subpass that there is not")
            return stated

        source, target = end(record.srcSubpass), end(record.dstSubpass)
        if source == target == NONE:
            raise PassRefused("a dependency of it is from outside to outside")
        return Dependency(
            source,
            target,
            mask("VkPipelineStageFlagBits2", record.srcStageMask),
            mask("VkPipelineStageFlagBits2", record.dstStageMask),
            mask("VkAccessFlagBits2", record.srcAccessMask),
            mask("VkAccessFlagBits2", record.dstAccessMask),
            mask("VkDependencyFlagBits", record.dependencyFlags),
            record.viewOffset or 0,
        )

    def _framebuffers(self, each: Joined) -> tuple[Framebuffer, ...]:
        """One for each set of images that it is begun with; where framebuffers alternate from frame to frame, the first."""
        positions: Sequence[int | None] = each.begun or (None,)
        stated = {f.key: f for f in self.frame.framebuffers.get(each.name, ())}
        found = []
        for position in positions:
            numbers = []
            for attachment in each.attachments:
                targets = targets_at(self.frame, attachment, position)
                if len(targets) > 1:
                    self.text.append(f"{each.name} alternates between framebuffers: the first is taken")
                numbers.append(self.images.of(targets[0]))
            body = self.frame.commands[position].body if position is not None else None
            name = getattr(body, "framebuffer", None)
            record = stated.get(name if isinstance(name, str) else (name or ("",))[0])
            if record is None and name is None and len(stated) == 1:
                record = next(iter(stated.values()))
            width, height = self.size(numbers)
            stated_size = (record.width or width, record.height or height) if record is not None else (width, height)
            if stated_size[0] > width or stated_size[1] > height:
                self.text.append(f"the framebuffer of {each.name} is larger than its images: {width}x{height} is taken")
            width, height = min(width, stated_size[0]), min(height, stated_size[1])
            layers = (record.layers or 1) if record is not None else 1
            found.append(Framebuffer(tuple(numbers), width, height, layers))
        return tuple(found)

    def size(self, numbers: Sequence[int]) -> tuple[int, int]:
        """What the images have in common."""
        own = [self.images.made[n] for n in numbers if n != NONE]
        return (min(i.width for i in own), min(i.height for i in own)) if own else self.images.base

    def _rendering(self, each: Joined, made: parts.Pass) -> parts.Pass:
        record = each.record
        assert isinstance(record, BeginRendering)
        rendered = [self._rendered("color", info) for info in record.colorAttachments]
        rendered += [self._rendered("depth", info) for info in (record.depthAttachment,) if info is not None]
        rendered += [self._rendered("stencil", info) for info in (record.stencilAttachment,) if info is not None]
        depths = {each.image for each in rendered if each.role != "color" and each.image != NONE}
        if len(depths) > 1:
            raise PassRefused("its depth and its stencil attachment are two images")
        numbers = [n for each in rendered for n in (each.image, each.resolve_image) if n != NONE]
        width, height = self.size(numbers)
        own = each.subpasses[0]
        single = self._single_sampled(own, record.path)
        flags = mask("VkRenderingFlagBits", record.flags) & (parts.SUSPENDING | parts.RESUMING)
        return made._replace(
            flags=flags,
            rendered=tuple(rendered),
            framebuffers=(Framebuffer(tuple(numbers), width, height, record.layerCount or 1),),
            layers=record.layerCount or 1,
            view_mask=record.viewMask or 0,
            single_sampled=single,
        )

    def _rendered(self, role: str, info: RenderingAttachment | None) -> parts.RenderTarget:
        image = self.images.named(info.image) if info is not None else NONE
        if info is None or image == NONE:
            return parts.RenderTarget(role)
        own = parts.COLOR_LAYOUT if role == "color" else parts.DEPTH_LAYOUT
        transient = self.images.made[image].usage & TRANSIENT
        usual = (LOAD_DONT_CARE, STORE_DONT_CARE if transient else STORE)
        if info.loadOp is None:
            self.text.append(f"loadOp of {info.path} is not stated: DONT_CARE is taken")
        if info.storeOp is None:
            self.text.append(f"storeOp of {info.path} is not stated: {'DONT_CARE' if transient else 'STORE'} is taken")
        target = self.images.named(info.resolveImage)
        mode = self._resolve_mode(info, image, target)
        return parts.RenderTarget(
            role,
            image,
            layout(info.imageLayout, own),
            mode,
            target,
            layout(info.resolveImageLayout, own) if target != NONE or mode else UNDEFINED,
            number("VkAttachmentLoadOp", info.loadOp) if info.loadOp is not None else usual[0],
            number("VkAttachmentStoreOp", info.storeOp) if info.storeOp is not None else usual[1],
        )

    def _resolve_mode(self, info: RenderingAttachment, image: int, target: int) -> int:
        if info.resolveMode is not None:
            return number("VkResolveModeFlagBits", info.resolveMode)
        if target == NONE:
            return 0
        plain = self.images.made[image].aspects & parts.COLOR and self.images.made[image].numeric not in ("UINT", "SINT")
        self.text.append(f"resolveMode of {info.path} is not stated: {'AVERAGE' if plain else 'SAMPLE_ZERO'} is taken")
        return 2 if plain else 1


def _version(text: str) -> tuple[int, int]:
    """Major and minor of a version; (9, 9) where it is none."""
    numbers = text.split(".")
    if len(numbers) < 2 or not all(each.isascii() and each.isdigit() and len(each) < 6 for each in numbers[:2]):
        return 9, 9
    return int(numbers[0]), int(numbers[1])
