"""The passes of a plan: render passes and dynamic renderings as described."""

from __future__ import annotations

from collections.abc import Sequence

from msaa_lint.frame.description.models import (
    AttachmentDescription,
    AttachmentReference,
    BeginRendering,
    DepthStencilResolve,
    ReadImage,
    RenderingAttachment,
    RenderPass,
    SubpassDependency,
)
from msaa_lint.frame.description.models import Subpass as DescribedSubpass
from msaa_lint.frame.facts.frame import Frame
from msaa_lint.frame.facts.parts import RENDERING, Attachment, PassSubpass
from msaa_lint.frame.facts.parts import Pass as DescribedPass
from msaa_lint.frame.facts.pass_begin import targets_at

from . import parts
from .parts import (
    LOAD,
    LOAD_DONT_CARE,
    NONE,
    STORE,
    STORE_DONT_CARE,
    TRANSIENT,
    UNDEFINED,
    Dependency,
    Framebuffer,
    Reference,
    Subpass,
)
from .plan_images import Images
from .plan_integers import layout, mask, number

MAX_PARTS = 256
"""Maximum number of attachments, subpasses and dependencies of a pass: no device supports more."""

DEPTH_ALONE = {"DEPTH_ATTACHMENT_OPTIMAL", "DEPTH_READ_ONLY_OPTIMAL"}
"""The layouts that leave the layout of stencil open."""


class PassRefused(Exception):
    """No device can run a pass; the message says why."""


class Passes:
    """The passes of a frame, in `facts.Frame`'s order."""

    def __init__(self, frame: Frame, images: Images, api: int | None) -> None:
        self.frame = frame
        self.images = images
        self.notes = images.notes
        self.api = api
        self.read = {body.image for _, body in frame.recorded(ReadImage)}

    def plan_pass(self, described: DescribedPass) -> parts.Pass:
        """A pass, with the reason if no device can run it."""
        kind = parts.RENDERING if described.kind == RENDERING else parts.RENDER_PASS
        empty = parts.Pass(
            described.name,
            described.path,
            kind,
            0 if kind == parts.RENDERING else self._api(described),
        )
        try:
            if described.custom_resolve:
                raise PassRefused(
                    "it resolves with a shader of its own, which confirm does not support"
                )
            return (
                self._rendering(described, empty)
                if described.kind == RENDERING
                else self._render_pass(described, empty)
            )
        except PassRefused as reason:
            return empty._replace(refused=str(reason))

    def _api(self, described: DescribedPass) -> int:
        """The version of the structures that create a pass: 2, except for applications that are
        limited to 1.
        """
        if self.api is not None:
            return self.api
        enabled = self.frame.description.enabled
        version = enabled.apiVersion if enabled is not None else None
        if (
            enabled is None
            or version is None
            or _version(version) >= (1, 2)
            or "VK_KHR_create_renderpass2" in (enabled.extensions or ())
        ):
            return 2
        records = [s.record for s in described.subpasses if isinstance(s.record, DescribedSubpass)]
        second = any(s.single_sampled for s in described.subpasses) or any(
            r.depthStencilResolve or r.viewMask for r in records
        )
        return 2 if second else 1

    def _render_pass(self, described: DescribedPass, frame_pass: parts.Pass) -> parts.Pass:
        record = described.record
        assert isinstance(record, RenderPass)
        if not record.subpasses:
            raise PassRefused("none of its subpasses is described")
        if (
            max(len(record.attachments), len(record.subpasses), len(record.dependencies))
            > MAX_PARTS
        ):
            raise PassRefused(
                f"it has more than {MAX_PARTS} attachments, subpasses or dependencies"
            )
        attachments = tuple(self._attachment(a) for a in described.attachments)
        indices = {a.name: a.index for a in described.attachments}
        subpasses = tuple(
            self._subpass(described, n, s, indices) for n, s in enumerate(record.subpasses)
        )
        dependencies = tuple(
            self._dependency(d, len(record.subpasses)) for d in record.dependencies
        )
        return frame_pass._replace(
            flags=mask("VkRenderPassCreateFlagBits", record.flags),
            attachments=attachments,
            subpasses=subpasses,
            dependencies=dependencies,
            framebuffers=self._framebuffers(described),
        )

    def _attachment(self, described: Attachment) -> parts.Attachment:
        record = described.record
        assert isinstance(record, AttachmentDescription)
        image = self.images.images[self.images.of(described.targets[0])]
        presentable = any(t.image is not None and t.image.presentable for t in described.targets)
        color = bool(image.aspects & parts.COLOR)
        default_layout = parts.COLOR_LAYOUT if color else parts.DEPTH_LAYOUT
        load, store, stencil_load, stencil_store = self._operations(described, record, image)
        loads = load == LOAD or (stencil_load == LOAD and image.aspects & parts.STENCIL)
        is_read = any(t.image is not None and t.name in self.read for t in described.targets) or (
            bool(described.input) and not described.drawn
        )
        read_layout = parts.READ_LAYOUT if color else parts.DEPTH_READ_LAYOUT
        is_used = described.drawn or described.input or described.resolve
        initial_default = layout(record.initialLayout, UNDEFINED) or default_layout
        final = (
            parts.PRESENT_LAYOUT
            if presentable
            else read_layout
            if is_read
            else default_layout
            if is_used
            else initial_default
        )
        return parts.Attachment(
            number("VkFormat", record.format) if record.format is not None else image.format,
            record.samples or image.samples,
            mask("VkAttachmentDescriptionFlagBits", record.flags),
            load,
            store,
            stencil_load,
            stencil_store,
            layout(
                record.initialLayout,
                (read_layout if is_read and not described.drawn else default_layout)
                if loads
                else UNDEFINED,
            ),
            layout(record.finalLayout, final),
            *self._stencil_layouts(record, image, stencil_load),
        )

    @staticmethod
    def _stencil_layouts(
        record: AttachmentDescription, image: parts.Image, load: int
    ) -> tuple[int, int]:
        """The separate layouts of stencil: none, unless one is stated or the attachment's layout is
        for depth only.
        """
        initial, final = (
            layout(record.stencilInitialLayout, NONE),
            layout(record.stencilFinalLayout, NONE),
        )
        alone = (
            initial != NONE
            or final != NONE
            or {record.initialLayout, record.finalLayout} & DEPTH_ALONE
        )
        if not image.aspects & parts.STENCIL or not alone:
            return NONE, NONE
        usual = parts.STENCIL_LAYOUT if load == LOAD else UNDEFINED
        return (
            usual if initial == NONE else initial,
            parts.STENCIL_LAYOUT if final == NONE else final,
        )

    def _operations(
        self, described: Attachment, record: AttachmentDescription, image: parts.Image
    ) -> tuple[int, int, int, int]:
        stated = (record.loadOp, record.storeOp, record.stencilLoadOp, record.stencilStoreOp)
        members = ("loadOp", "storeOp", "stencilLoadOp", "stencilStoreOp")
        default_store = STORE_DONT_CARE if image.usage & TRANSIENT else STORE
        first = image.aspects & (parts.COLOR | parts.DEPTH)
        second = image.aspects & parts.STENCIL
        defaults = (
            LOAD_DONT_CARE,
            default_store,
            LOAD_DONT_CARE,
            default_store if second else STORE_DONT_CARE,
        )
        operations = []
        for member, value, default, aspect_present in zip(
            members, stated, defaults, (first, first, second, second), strict=True
        ):
            load = member.endswith("oadOp")
            if value is None and aspect_present:
                self.notes.append(
                    f"{member} of {described.record.path} is not stated: "
                    f"{'DONT_CARE' if load or default else 'STORE'} is assumed"
                )
            enum = "VkAttachmentLoadOp" if load else "VkAttachmentStoreOp"
            operations.append(number(enum, value) if value is not None else default)
        return operations[0], operations[1], operations[2], operations[3]

    def _reference(
        self, stated: AttachmentReference | None, indices: dict[str, int], usual: int
    ) -> Reference:
        if stated is None or stated.attachment is None:
            return Reference(NONE, UNDEFINED)
        index = (
            indices.get(stated.attachment, NONE)
            if isinstance(stated.attachment, str)
            else stated.attachment
        )
        if not 0 <= index < len(indices):
            raise PassRefused(
                f"it refers to an attachment that does not exist: {stated.attachment}"
            )
        return Reference(index, layout(stated.layout, usual))

    def _subpass(
        self, described: DescribedPass, at: int, record: DescribedSubpass, indices: dict[str, int]
    ) -> Subpass:
        if record.pipelineBindPoint not in (None, "GRAPHICS"):
            raise PassRefused("one of its subpasses is not a graphics subpass")
        colors = [self._reference(r, indices, parts.COLOR_LAYOUT) for r in record.colorAttachments]
        resolves = [
            self._reference(r, indices, parts.COLOR_LAYOUT) for r in record.resolveAttachments
        ]
        if resolves:
            # One resolve attachment for each color attachment.
            width = max(len(colors), len(resolves))
            colors += [Reference(NONE)] * (width - len(colors))
            resolves += [Reference(NONE)] * (width - len(resolves))
        inputs = [
            self._input(described, at, self._reference(r, indices, parts.READ_LAYOUT), r.layout)
            for r in record.inputAttachments
        ]
        drawn = {r.attachment for r in colors} & {r.attachment for r in inputs} - {NONE}
        colors = [
            r._replace(layout=parts.GENERAL)
            if r.attachment in drawn and r.layout == parts.COLOR_LAYOUT
            else r
            for r in colors
        ]
        depth = (
            self._reference(record.depthStencilAttachment, indices, parts.DEPTH_LAYOUT)
            if record.depthStencilAttachment
            else None
        )
        if (
            depth is not None
            and depth.attachment in {r.attachment for r in inputs}
            and depth.attachment != NONE
        ):
            depth = depth._replace(layout=parts.DEPTH_READ_LAYOUT)
        resolve = record.depthStencilResolve
        source = (
            described.attachments[depth.attachment]
            if depth is not None and depth.attachment != NONE
            else None
        )
        stencil = source is None or bool(
            self.images.images[self.images.of(source.targets[0])].aspects & parts.STENCIL
        )
        target = (
            self._reference(resolve.attachment, indices, parts.DEPTH_LAYOUT)
            if resolve is not None
            else None
        )
        preserves = tuple(
            self._reference(r, indices, UNDEFINED).attachment for r in record.preserveAttachments
        )
        described_subpass = described.subpasses[at]
        single = self._single_sampled(described_subpass, record.path)
        return Subpass(
            mask("VkSubpassDescriptionFlagBits", record.flags),
            tuple(inputs),
            tuple(colors),
            tuple(resolves),
            (depth,) if depth is not None and depth.attachment != NONE else (),
            (target,) if target is not None and target.attachment != NONE else (),
            self._mode(resolve, "depthResolveMode") if resolve is not None else 0,
            self._mode(resolve, "stencilResolveMode", stencil) if resolve is not None else 0,
            tuple(p for p in preserves if p != NONE),
            record.viewMask or 0,
            single,
        )

    def _input(
        self, described: DescribedPass, at: int, reference: Reference, stated: str | None
    ) -> Reference:
        if reference.attachment == NONE:
            return reference
        attachment = described.attachments[reference.attachment]
        image = self.images.images[self.images.of(attachment.targets[0])]
        is_color_too = at in attachment.color
        default = (
            parts.GENERAL
            if is_color_too
            else parts.DEPTH_READ_LAYOUT
            if not image.aspects & parts.COLOR
            else parts.READ_LAYOUT
        )
        return reference._replace(
            layout=reference.layout if stated is not None else default, aspects=image.aspects
        )

    def _single_sampled(self, described_subpass: PassSubpass, path: str) -> int:
        """The sample count with which single-sampled attachments are rendered; 0 without
        multisampled rendering.
        """
        if not described_subpass.single_sampled:
            return 0
        if described_subpass.single_sampled_count is not None:
            return described_subpass.single_sampled_count
        max_samples = max([image.samples for image in self.images.images] or [1])
        assumed = max_samples if max_samples > 1 else 4
        self.notes.append(
            f"rasterizationSamples of {path}.multisampledRenderToSingleSampled is not stated: "
            f"{assumed} is assumed"
        )
        return assumed

    def _mode(self, resolve: DepthStencilResolve, member: str, there: bool = True) -> int:
        """A resolve mode; if unstated, SAMPLE_ZERO, which every device supports. An absent aspect
        is not noted.
        """
        name = getattr(resolve, member)
        if name is None and there:
            self.notes.append(f"{member} of {resolve.path} is not stated: SAMPLE_ZERO is assumed")
        return number("VkResolveModeFlagBits", name) if name is not None else 1

    @staticmethod
    def _dependency(record: SubpassDependency, subpasses: int) -> Dependency:
        def end(stated: int | str | None) -> int:
            if stated is None or stated == "EXTERNAL":
                return NONE
            if not isinstance(stated, int) or not 0 <= stated < subpasses:
                raise PassRefused("one of its dependencies refers to a subpass that does not exist")
            return stated

        source, target = end(record.srcSubpass), end(record.dstSubpass)
        if source == target == NONE:
            raise PassRefused("one of its dependencies has no subpass on either end")
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

    def _framebuffers(self, described: DescribedPass) -> tuple[Framebuffer, ...]:
        """A framebuffer for each set of images that the pass begins with; the first one where
        framebuffers alternate between frames.
        """
        positions: Sequence[int | None] = described.begun or (None,)
        stated = {f.key: f for f in self.frame.framebuffers.get(described.name, ())}
        framebuffers = []
        for position in positions:
            numbers = []
            for attachment in described.attachments:
                targets = targets_at(self.frame, attachment, position)
                if len(targets) > 1:
                    self.notes.append(
                        f"{described.name} alternates between framebuffers: the first one is used"
                    )
                numbers.append(self.images.of(targets[0]))
            body = self.frame.commands[position].body if position is not None else None
            name = getattr(body, "framebuffer", None)
            record = stated.get(name if isinstance(name, str) else (name or ("",))[0])
            if record is None and name is None and len(stated) == 1:
                record = next(iter(stated.values()))
            width, height = self.size(numbers)
            stated_size = (
                (record.width or width, record.height or height)
                if record is not None
                else (width, height)
            )
            if stated_size[0] > width or stated_size[1] > height:
                self.notes.append(
                    f"the framebuffer of {described.name} is larger than its images: "
                    f"{width}x{height} is assumed"
                )
            width, height = min(width, stated_size[0]), min(height, stated_size[1])
            layers = (record.layers or 1) if record is not None else 1
            framebuffers.append(Framebuffer(tuple(numbers), width, height, layers))
        return tuple(framebuffers)

    def size(self, numbers: Sequence[int]) -> tuple[int, int]:
        """The largest size that all the images have."""
        sized = [self.images.images[n] for n in numbers if n != NONE]
        return (
            (min(i.width for i in sized), min(i.height for i in sized))
            if sized
            else self.images.base
        )

    def _rendering(self, described: DescribedPass, frame_pass: parts.Pass) -> parts.Pass:
        record = described.record
        assert isinstance(record, BeginRendering)
        rendered = [self._rendered("color", info) for info in record.colorAttachments]
        rendered += [
            self._rendered("depth", info) for info in (record.depthAttachment,) if info is not None
        ]
        rendered += [
            self._rendered("stencil", info)
            for info in (record.stencilAttachment,)
            if info is not None
        ]
        depths = {
            described.image
            for described in rendered
            if described.role != "color" and described.image != NONE
        }
        if len(depths) > 1:
            raise PassRefused("its depth and stencil attachments are different images")
        numbers = [
            n
            for described in rendered
            for n in (described.image, described.resolve_image)
            if n != NONE
        ]
        width, height = self.size(numbers)
        described_subpass = described.subpasses[0]
        single = self._single_sampled(described_subpass, record.path)
        flags = mask("VkRenderingFlagBits", record.flags) & (parts.SUSPENDING | parts.RESUMING)
        return frame_pass._replace(
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
        default_layout = parts.COLOR_LAYOUT if role == "color" else parts.DEPTH_LAYOUT
        transient = self.images.images[image].usage & TRANSIENT
        defaults = (LOAD_DONT_CARE, STORE_DONT_CARE if transient else STORE)
        if info.loadOp is None:
            self.notes.append(f"loadOp of {info.path} is not stated: DONT_CARE is assumed")
        if info.storeOp is None:
            self.notes.append(
                f"storeOp of {info.path} is not stated: {'DONT_CARE' if transient else 'STORE'} is "
                "assumed"
            )
        target = self.images.named(info.resolveImage)
        mode = self._resolve_mode(info, image, target)
        return parts.RenderTarget(
            role,
            image,
            layout(info.imageLayout, default_layout),
            mode,
            target,
            layout(info.resolveImageLayout, default_layout)
            if target != NONE or mode
            else UNDEFINED,
            number("VkAttachmentLoadOp", info.loadOp) if info.loadOp is not None else defaults[0],
            number("VkAttachmentStoreOp", info.storeOp)
            if info.storeOp is not None
            else defaults[1],
        )

    def _resolve_mode(self, info: RenderingAttachment, image: int, target: int) -> int:
        if info.resolveMode is not None:
            return number("VkResolveModeFlagBits", info.resolveMode)
        if target == NONE:
            return 0
        averages = self.images.images[image].aspects & parts.COLOR and self.images.images[
            image
        ].numeric not in ("UINT", "SINT")
        self.notes.append(
            f"resolveMode of {info.path} is not stated: {'AVERAGE' if averages else 'SAMPLE_ZERO'} "
            "is assumed"
        )
        return 2 if averages else 1


def _version(text: str) -> tuple[int, int]:
    """The major and minor version; (9, 9) if malformed."""
    numbers = text.split(".")
    if len(numbers) < 2 or not all(
        described.isascii() and described.isdigit() and len(described) < 6
        for described in numbers[:2]
    ):
        return 9, 9
    return int(numbers[0]), int(numbers[1])
