"""The images, render passes, framebuffers and pipelines of a plan, created on a device."""

from __future__ import annotations

from functools import partial
from typing import Any

from . import parts, pipelines
from .binding import chain
from .device_images import create_image
from .mesh_buffers import mesh_buffers
from .opening import DeviceObjects, OpenDevice
from .parts import NONE, Dependency, Framebuffer, Image, Pass, Plan, Reference
from .scene import VERTEX_BYTES
from .shader_bindings import ShaderBindings

UNUSED = 0xFFFFFFFF
"""VK_ATTACHMENT_UNUSED and VK_SUBPASS_EXTERNAL."""

MAX_32_BITS = 0xFFFFFFFF

ALL_GRAPHICS = 0x8000
"""VK_PIPELINE_STAGE_ALL_GRAPHICS_BIT."""


class SharedImages(DeviceObjects):
    """The images of plans that are drawn in turn: those with the same parameters are the same, so
    that memory does not grow with the number of plans. What one plan leaves in them is undefined
    for the next one.
    """

    def __init__(self, opened: OpenDevice) -> None:
        super().__init__(opened)
        self._images: dict[Image, list[Any]] = {}

    def image(self, image: Image, number: int = 0) -> Any:
        """The image of a plan; `number` tells images of one plan with the same parameters apart."""
        images = self._images.setdefault(image._replace(name=""), [])
        while len(images) <= number:
            images.append(create_image(self, image))
        return images[number]


class FrameObjects(DeviceObjects):
    """The objects of a plan on a device. Images are created when something needs them; `close`
    destroys everything.

    `more_usage` are usages by image besides those of the plan, needed for reading images back;
    `shared` are images that several plans use in turn.
    """

    def __init__(
        self,
        opened: OpenDevice,
        plan: Plan,
        more_usage: dict[int, int] | None = None,
        shared: SharedImages | None = None,
    ) -> None:
        super().__init__(opened)
        self.shared = shared
        self.plan = plan
        self.images: dict[int, Any] = {}
        self.render_passes: dict[int, Any] = {}
        self.framebuffers: dict[tuple[int, int], Any] = {}
        self.pipelines: dict[tuple[int, int], Any] = {}
        self.bindings: dict[tuple[int, int], ShaderBindings] = {}
        """What pipelines with shaders from outside need to be bound."""
        self.more_usage = more_usage or {}
        self._views: dict[tuple[int, int, int, int], Any] = {}
        self._readers: dict[tuple[int, int, bool], Any] = {}
        self._vertices: tuple[Any, int] | None = None
        mesh_buffers(opened).prepare(plan)

    def create_pass(self, number: int) -> None:
        """Creates a pass with everything it needs. VulkanError where the driver fails to."""
        frame_pass = self.plan.passes[number]
        for image in frame_pass.images:
            self.image(image)
        if frame_pass.kind == parts.RENDER_PASS:
            self.render_passes[number] = self._render_pass(frame_pass)
            for index, framebuffer in enumerate(frame_pass.framebuffers):
                self.framebuffers[number, index] = self._framebuffer(
                    number, frame_pass, framebuffer
                )
        for index, pipeline in enumerate(frame_pass.pipelines):
            layout = None
            if pipeline.stages:
                bindings = self.bindings[number, index] = ShaderBindings(self, pipeline)
                bindings.create_sets(
                    frame_pass, self.plan.images, partial(self._attachment_view, frame_pass)
                )
                layout = bindings.layout
            self.pipelines[number, index] = pipelines.create_pipeline(
                self, frame_pass, pipeline, self.render_passes.get(number), layout
            )

    def _attachment_view(
        self, frame_pass: Pass, number: int, framebuffer: Framebuffer, aspects: int
    ) -> Any:
        return self.view(number, self.layers(frame_pass, framebuffer), aspects)

    def vertices(self) -> tuple[Any, int]:
        """The vertex buffer to draw and its number of vertices: from the plan's file, otherwise the
        scene's. ValueError for a file without triangles.
        """
        if not self.plan.vertices:
            return self.opened.vertices()
        if self._vertices is None:
            with open(self.plan.vertices, "rb") as file:
                data = file.read()
            if not data or len(data) % (3 * VERTEX_BYTES):
                raise ValueError(f"{self.plan.vertices} contains no triangles")
            buffer, memory = self.opened.buffer(data)
            self.own(self.vk.vkFreeMemory, memory)
            self._vertices = self.own(self.vk.vkDestroyBuffer, buffer), len(data) // VERTEX_BYTES
        return self._vertices

    def reader(self, number: int, subpass: int, samples: bool) -> Any:
        """A pipeline that writes an image to every pixel of a subpass; None where the subpass has
        no pipeline to model it on.
        """
        key = (number, subpass, samples)
        if key not in self._readers:
            frame_pass = self.plan.passes[number]
            like = next(
                (p for p in frame_pass.pipelines if p.subpass == subpass and not p.discard), None
            )
            shader = "read_samples.frag" if samples else "read.frag"
            created = None
            if like is not None:
                like = like._replace(
                    samples=self._attached_samples(frame_pass, subpass) or like.samples
                )
                created = pipelines.create_reader(
                    self, frame_pass, like, self.render_passes.get(number), shader
                )
            self._readers[key] = created
        return self._readers[key]

    def _attached_samples(self, frame_pass: Pass, subpass: int) -> int:
        """The sample count that a subpass is rendered with; 0 without attachments."""
        if frame_pass.kind == parts.RENDERING:
            counts = [
                self.plan.images[rendered.image].samples
                for rendered in frame_pass.rendered
                if rendered.image != NONE
            ]
            return frame_pass.single_sampled or max(counts, default=0)
        attached = (
            *frame_pass.subpasses[subpass].colors,
            *frame_pass.subpasses[subpass].depth_stencil,
        )
        counts = [
            frame_pass.attachments[reference.attachment].samples
            for reference in attached
            if reference.attachment != NONE
        ]
        return frame_pass.subpasses[subpass].single_sampled or max(counts, default=0)

    def image(self, number: int) -> Any:
        """An image with its memory."""
        if number not in self.images:
            with self.opened.session.about(self.plan.images[number].name):
                image, usage = self.plan.images[number], self.more_usage.get(number, 0)
                made = (
                    self.shared.image(image, self._alike(number))
                    if self.shared is not None
                    else create_image(self, image, usage)
                )
                self.images[number] = made
        return self.images[number]

    def has_usage(self, number: int, usage: int) -> bool:
        """Whether an image was created with a usage."""
        return bool((self.plan.images[number].usage | self.more_usage.get(number, 0)) & usage)

    def _alike(self, number: int) -> int:
        """The number of images before this one that have the same parameters."""
        images = [image._replace(name="") for image in self.plan.images[: number + 1]]
        return images.count(images[-1]) - 1

    def view(self, number: int, layers: int = 1, aspects: int = 0, format: int = 0) -> Any:
        """A view of the first layers of an image, with all its aspects or some of them."""
        vk, image = self.vk, self.plan.images[number]
        layers = min(max(layers, 1), image.layers)
        aspects, format = aspects or image.aspects, format or image.format
        key = (number, layers, aspects, format)
        if key not in self._views:
            kind = 0 if image.type == 0 else 5 if layers > 1 else 1
            whole = vk.VkImageSubresourceRange(aspectMask=aspects, levelCount=1, layerCount=layers)
            create = vk.VkImageViewCreateInfo(
                image=self.image(number), viewType=kind, format=format, subresourceRange=whole
            )
            self._views[key] = self.own(
                vk.vkDestroyImageView, vk.vkCreateImageView(self.opened.handle, create, None)
            )
        return self._views[key]

    def layers(self, frame_pass: Pass, framebuffer: Framebuffer) -> int:
        """The number of layers of the image views of a pass."""
        masks = [subpass.view_mask for subpass in frame_pass.subpasses] or [frame_pass.view_mask]
        return max(framebuffer.layers, *(mask.bit_length() for mask in masks), 1)

    def _framebuffer(self, number: int, frame_pass: Pass, framebuffer: Framebuffer) -> Any:
        vk = self.vk
        layers = self.layers(frame_pass, framebuffer)
        create = vk.VkFramebufferCreateInfo(
            renderPass=self.render_passes[number],
            pAttachments=[self.view(image, layers) for image in framebuffer.images],
            width=framebuffer.width,
            height=framebuffer.height,
            layers=framebuffer.layers,
        )
        return self.own(
            vk.vkDestroyFramebuffer, vk.vkCreateFramebuffer(self.opened.handle, create, None)
        )

    def _render_pass(self, frame_pass: Pass) -> Any:
        render_pass = self._second(frame_pass) if frame_pass.api == 2 else self._first(frame_pass)
        return self.own(self.vk.vkDestroyRenderPass, render_pass)

    def _second(self, frame_pass: Pass) -> Any:
        vk = self.vk
        attachments = []
        for a in frame_pass.attachments:
            stencil_layout = None
            if NONE not in (a.stencil_initial, a.stencil_final):
                layouts = {
                    "stencilInitialLayout": a.stencil_initial,
                    "stencilFinalLayout": a.stencil_final,
                }
                stencil_layout = vk.VkAttachmentDescriptionStencilLayout(**layouts)
            attachments.append(
                vk.VkAttachmentDescription2(
                    pNext=stencil_layout, flags=a.flags, format=a.format, samples=a.samples,
                    loadOp=a.load, storeOp=a.store,
                    stencilLoadOp=a.stencil_load, stencilStoreOp=a.stencil_store,
                    initialLayout=a.initial, finalLayout=a.final,
                )
            )  # fmt: skip
        subpasses = []
        for s in frame_pass.subpasses:
            chained_structures = []
            if s.depth_resolve or (s.single_sampled and (s.depth_mode or s.stencil_mode)):
                # Multisampled rendering to a single-sampled attachment has modes of a resolve, and
                # no attachment to resolve to.
                target = self._reference(s.depth_resolve[0]) if s.depth_resolve else None
                chained_structures.append(
                    vk.VkSubpassDescriptionDepthStencilResolve(
                        depthResolveMode=s.depth_mode,
                        stencilResolveMode=s.stencil_mode,
                        pDepthStencilResolveAttachment=target,
                    )
                )
            if s.single_sampled:
                chained_structures.append(
                    vk.VkMultisampledRenderToSingleSampledInfoEXT(
                        multisampledRenderToSingleSampledEnable=1,
                        rasterizationSamples=s.single_sampled,
                    )
                )
            head = vk.VkSubpassDescription2(
                flags=s.flags, viewMask=s.view_mask,
                pInputAttachments=[self._reference(r) for r in s.inputs],
                colorAttachmentCount=len(s.colors),
                pColorAttachments=[self._reference(r) for r in s.colors],
                pResolveAttachments=[self._reference(r) for r in s.resolves] or None,
                pDepthStencilAttachment=self._reference(s.depth_stencil[0]) if s.depth_stencil else None,  # noqa: E501
                pPreserveAttachments=list(s.preserves),
            )  # fmt: skip
            subpasses.append(chain(head, *chained_structures))
        dependencies = []
        for d in map(self._dependency, frame_pass.dependencies):
            head = vk.VkSubpassDependency2(
                srcSubpass=UNUSED if d.source == NONE else d.source,
                dstSubpass=UNUSED if d.target == NONE else d.target,
                srcStageMask=d.source_stages & MAX_32_BITS,
                dstStageMask=d.target_stages & MAX_32_BITS,
                srcAccessMask=d.source_accesses & MAX_32_BITS,
                dstAccessMask=d.target_accesses & MAX_32_BITS,
                dependencyFlags=d.flags, viewOffset=d.view_offset,
            )  # fmt: skip
            masks = (d.source_stages, d.target_stages, d.source_accesses, d.target_accesses)
            barrier = []
            if any(mask > MAX_32_BITS for mask in masks):
                # Some bits exist only in synchronization2.
                names = ("srcStageMask", "dstStageMask", "srcAccessMask", "dstAccessMask")
                barrier.append(vk.VkMemoryBarrier2(**dict(zip(names, masks, strict=True))))
            dependencies.append(chain(head, *barrier))
        create = vk.VkRenderPassCreateInfo2(
            flags=frame_pass.flags,
            pAttachments=attachments,
            pSubpasses=subpasses,
            pDependencies=dependencies,
        )
        return self.opened.call("vkCreateRenderPass2")(self.opened.handle, create, None)

    def _dependency(self, stated: Dependency) -> Dependency:
        """A dependency without the stages and accesses that the device lacks."""
        source, source_accesses = self.opened.masks(stated.source_stages, stated.source_accesses)
        target, target_accesses = self.opened.masks(stated.target_stages, stated.target_accesses)
        return stated._replace(
            source_stages=source or (stated.source_stages and ALL_GRAPHICS),
            target_stages=target or (stated.target_stages and ALL_GRAPHICS),
            source_accesses=source_accesses,
            target_accesses=target_accesses,
        )

    def _reference(self, reference: Reference) -> Any:
        index = UNUSED if reference.attachment == NONE else reference.attachment
        return self.vk.VkAttachmentReference2(
            attachment=index, layout=reference.layout, aspectMask=reference.aspects
        )

    def _first(self, frame_pass: Pass) -> Any:
        vk = self.vk

        def reference(r: Reference) -> Any:
            return vk.VkAttachmentReference(
                attachment=UNUSED if r.attachment == NONE else r.attachment, layout=r.layout
            )

        attachments = [
            vk.VkAttachmentDescription(
                flags=a.flags, format=a.format, samples=a.samples, loadOp=a.load, storeOp=a.store,
                stencilLoadOp=a.stencil_load,
                stencilStoreOp=a.stencil_store, initialLayout=a.initial, finalLayout=a.final,
            )
            for a in frame_pass.attachments
        ]  # fmt: skip
        subpasses = [
            vk.VkSubpassDescription(
                flags=s.flags, pInputAttachments=[reference(r) for r in s.inputs],
                colorAttachmentCount=len(s.colors),
                pColorAttachments=[reference(r) for r in s.colors],
                pResolveAttachments=[reference(r) for r in s.resolves] or None,
                pDepthStencilAttachment=reference(s.depth_stencil[0]) if s.depth_stencil else None,
                pPreserveAttachments=list(s.preserves),
            )
            for s in frame_pass.subpasses
        ]  # fmt: skip
        dependencies = [
            vk.VkSubpassDependency(
                srcSubpass=UNUSED if d.source == NONE else d.source,
                dstSubpass=UNUSED if d.target == NONE else d.target,
                srcStageMask=d.source_stages & MAX_32_BITS,
                dstStageMask=d.target_stages & MAX_32_BITS,
                srcAccessMask=d.source_accesses & MAX_32_BITS,
                dstAccessMask=d.target_accesses & MAX_32_BITS, dependencyFlags=d.flags,
            )
            for d in map(self._dependency, frame_pass.dependencies)
        ]  # fmt: skip
        create = vk.VkRenderPassCreateInfo(
            flags=frame_pass.flags,
            pAttachments=attachments,
            pSubpasses=subpasses,
            pDependencies=dependencies,
        )
        return vk.vkCreateRenderPass(self.opened.handle, create, None)
