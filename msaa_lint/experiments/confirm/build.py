"""A plan's images, render passes, framebuffers and pipelines, created on a device."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from . import parts, pipelines
from .binding import chain
from .opening import Opened
from .parts import NONE, Framebuffer, Pass, Plan, Reference
from .scene import VERTEX_BYTES

DEVICE_LOCAL, HOST_VISIBLE, COHERENT, CACHED, LAZY = 0x1, 0x2, 0x4, 0x8, 0x10
"""VkMemoryPropertyFlagBits."""

UNUSED = 0xFFFFFFFF
"""VK_ATTACHMENT_UNUSED and VK_SUBPASS_EXTERNAL."""

MOST_BITS = 0xFFFFFFFF


class Built:
    """What of a plan exists on a device. Images are made when something needs them; `close` destroys everything.

    `more_usage` are usages by image beyond those of the plan: what is read back needs them.
    """

    def __init__(self, opened: Opened, plan: Plan, more_usage: dict[int, int] | None = None) -> None:
        self.opened = opened
        self.vk = opened.vk
        self.plan = plan
        self.images: dict[int, Any] = {}
        self.render_passes: dict[int, Any] = {}
        self.framebuffers: dict[tuple[int, int], Any] = {}
        self.pipelines: dict[tuple[int, int], Any] = {}
        self.more_usage = more_usage or {}
        self._views: dict[tuple[int, int, int, int], Any] = {}
        self._readers: dict[tuple[int, int, bool], Any] = {}
        self._vertices: tuple[Any, int] | None = None
        self._made: list[tuple[Callable[..., None], Any]] = []

    def own(self, destroy: Callable[..., None], handle: Any) -> Any:
        """Has a handle destroyed with everything else."""
        self._made.append((destroy, handle))
        return handle

    def close(self) -> None:
        """Destroys everything, the last first."""
        while self._made:
            destroy, handle = self._made.pop()
            destroy(self.opened.handle, handle, None)

    def made(self, number: int) -> None:
        """Creates a pass with what it needs. VulkanError where the driver does not."""
        each = self.plan.passes[number]
        for image in each.images:
            self.image(image)
        if each.kind == parts.RENDER_PASS:
            self.render_passes[number] = self._render_pass(each)
            for index, framebuffer in enumerate(each.framebuffers):
                self.framebuffers[number, index] = self._framebuffer(number, each, framebuffer)
        for index, pipeline in enumerate(each.pipelines):
            self.pipelines[number, index] = pipelines.made(self, each, pipeline, self.render_passes.get(number))

    def vertices(self) -> tuple[Any, int]:
        """The vertices that are drawn, and how many they are: those of the plan's file, else the scene's. ValueError where it has none."""
        if not self.plan.vertices:
            return self.opened.vertices()
        if self._vertices is None:
            with open(self.plan.vertices, "rb") as file:
                data = file.read()
            if not data or len(data) % (3 * VERTEX_BYTES):
                raise ValueError(f"{self.plan.vertices} holds no triangles")
            buffer, memory = self.opened.buffer(data)
            self.own(self.vk.vkFreeMemory, memory)
            self._vertices = self.own(self.vk.vkDestroyBuffer, buffer), len(data) // VERTEX_BYTES
        return self._vertices

    def reader(self, number: int, subpass: int, samples: bool) -> Any:
        """A pipeline that puts an image on every pixel of a subpass; None where the pass has none to take after."""
        key = (number, subpass, samples)
        if key not in self._readers:
            each = self.plan.passes[number]
            like = next((p for p in each.pipelines if p.subpass == subpass and not p.discard), None)
            shader = "read_samples.frag" if samples else "read.frag"
            made = pipelines.reader(self, each, like, self.render_passes.get(number), shader) if like is not None else None
            self._readers[key] = made
        return self._readers[key]

    def image(self, number: int) -> Any:
        """An image with its memory."""
        if number in self.images:
            return self.images[number]
        vk, handle, image = self.vk, self.opened.handle, self.plan.images[number]
        create = vk.VkImageCreateInfo(
            flags=image.flags,
            imageType=image.type,
            format=image.format,
            extent=vk.VkExtent3D(image.width, image.height, image.depth),
            mipLevels=image.levels,
            arrayLayers=image.layers,
            samples=image.samples,
            tiling=image.tiling,
            usage=(image.usage | self.more_usage.get(number, 0)),
        )
        made = self.own(vk.vkDestroyImage, vk.vkCreateImage(handle, create, None))
        needs = vk.vkGetImageMemoryRequirements(handle, made)
        wishes = (LAZY, DEVICE_LOCAL) if image.lazy else (DEVICE_LOCAL,)
        kind = self.opened.memory_type(needs.memoryTypeBits, *wishes)
        allocate = vk.VkMemoryAllocateInfo(allocationSize=needs.size, memoryTypeIndex=kind)
        memory = self.own(vk.vkFreeMemory, vk.vkAllocateMemory(handle, allocate, None))
        # Memory is freed after what is bound to it is destroyed.
        self._made[-2:] = [self._made[-1], self._made[-2]]
        vk.vkBindImageMemory(handle, made, memory, 0)
        self.images[number] = made
        return made

    def view(self, number: int, layers: int = 1, aspects: int = 0, format: int = 0) -> Any:
        """A view of the first layers of an image, of all its aspects or of some."""
        vk, image = self.vk, self.plan.images[number]
        layers = min(max(layers, 1), image.layers)
        aspects, format = aspects or image.aspects, format or image.format
        key = (number, layers, aspects, format)
        if key not in self._views:
            kind = 0 if image.type == 0 else 5 if layers > 1 else 1
            whole = vk.VkImageSubresourceRange(aspectMask=aspects, levelCount=1, layerCount=layers)
            create = vk.VkImageViewCreateInfo(image=self.image(number), viewType=kind, format=format, subresourceRange=whole)
            self._views[key] = self.own(vk.vkDestroyImageView, vk.vkCreateImageView(self.opened.handle, create, None))
        return self._views[key]

    def layers(self, each: Pass, framebuffer: Framebuffer) -> int:
        """How many layers the views of a pass have."""
        masks = [subpass.view_mask for subpass in each.subpasses] or [each.view_mask]
        return max(framebuffer.layers, *(mask.bit_length() for mask in masks), 1)

    def _framebuffer(self, number: int, each: Pass, framebuffer: Framebuffer) -> Any:
        vk = self.vk
        layers = self.layers(each, framebuffer)
        create = vk.VkFramebufferCreateInfo(
            renderPass=self.render_passes[number],
            pAttachments=[self.view(image, layers) for image in framebuffer.images],
            width=framebuffer.width,
            height=framebuffer.height,
            layers=framebuffer.layers,
        )
        return self.own(vk.vkDestroyFramebuffer, vk.vkCreateFramebuffer(self.opened.handle, create, None))

    def _render_pass(self, each: Pass) -> Any:
        made = self._second(each) if each.api == 2 else self._first(each)
        return self.own(self.vk.vkDestroyRenderPass, made)

    def _second(self, each: Pass) -> Any:
        vk = self.vk
        attachments = []
        for a in each.attachments:
            chained = None
            if NONE not in (a.stencil_initial, a.stencil_final):
                layouts = {"stencilInitialLayout": a.stencil_initial, "stencilFinalLayout": a.stencil_final}
                chained = vk.VkAttachmentDescriptionStencilLayout(**layouts)
            attachments.append(
                vk.VkAttachmentDescription2(
                    pNext=chained, flags=a.flags, format=a.format, samples=a.samples, loadOp=a.load, storeOp=a.store,
                    stencilLoadOp=a.stencil_load, stencilStoreOp=a.stencil_store, initialLayout=a.initial, finalLayout=a.final,
                )
            )  # fmt: skip
        subpasses = []
        for s in each.subpasses:
            following = []
            if s.depth_resolve:
                target = self._reference(s.depth_resolve[0])
                following.append(
                    vk.VkSubpassDescriptionDepthStencilResolve(
                        depthResolveMode=s.depth_mode, stencilResolveMode=s.stencil_mode, pDepthStencilResolveAttachment=target
                    )
                )
            if s.single_sampled:
                following.append(
                    vk.VkMultisampledRenderToSingleSampledInfoEXT(
                        multisampledRenderToSingleSampledEnable=1, rasterizationSamples=s.single_sampled
                    )
                )
            head = vk.VkSubpassDescription2(
                flags=s.flags, viewMask=s.view_mask, pInputAttachments=[self._reference(r) for r in s.inputs],
                colorAttachmentCount=len(s.colors), pColorAttachments=[self._reference(r) for r in s.colors],
                pResolveAttachments=[self._reference(r) for r in s.resolves] or None,
                pDepthStencilAttachment=self._reference(s.depth_stencil[0]) if s.depth_stencil else None,
                pPreserveAttachments=list(s.preserves),
            )  # fmt: skip
            subpasses.append(chain(head, *following))
        dependencies = []
        for d in each.dependencies:
            head = vk.VkSubpassDependency2(
                srcSubpass=UNUSED if d.source == NONE else d.source, dstSubpass=UNUSED if d.target == NONE else d.target,
                srcStageMask=d.source_stages & MOST_BITS, dstStageMask=d.target_stages & MOST_BITS,
                srcAccessMask=d.source_accesses & MOST_BITS, dstAccessMask=d.target_accesses & MOST_BITS,
                dependencyFlags=d.flags, viewOffset=d.view_offset,
            )  # fmt: skip
            masks = (d.source_stages, d.target_stages, d.source_accesses, d.target_accesses)
            barrier = []
            if any(mask > MOST_BITS for mask in masks):
                # Bits that the first version of synchronization does not have.
                names = ("srcStageMask", "dstStageMask", "srcAccessMask", "dstAccessMask")
                barrier.append(vk.VkMemoryBarrier2(**dict(zip(names, masks, strict=True))))
            dependencies.append(chain(head, *barrier))
        create = vk.VkRenderPassCreateInfo2(flags=each.flags, pAttachments=attachments, pSubpasses=subpasses, pDependencies=dependencies)
        return self.opened.call("vkCreateRenderPass2")(self.opened.handle, create, None)

    def _reference(self, reference: Reference) -> Any:
        index = UNUSED if reference.attachment == NONE else reference.attachment
        return self.vk.VkAttachmentReference2(attachment=index, layout=reference.layout, aspectMask=reference.aspects)

    def _first(self, each: Pass) -> Any:
        vk = self.vk

        def reference(r: Reference) -> Any:
            return vk.VkAttachmentReference(attachment=UNUSED if r.attachment == NONE else r.attachment, layout=r.layout)

        attachments = [
            vk.VkAttachmentDescription(
                flags=a.flags, format=a.format, samples=a.samples, loadOp=a.load, storeOp=a.store, stencilLoadOp=a.stencil_load,
                stencilStoreOp=a.stencil_store, initialLayout=a.initial, finalLayout=a.final,
            )
            for a in each.attachments
        ]  # fmt: skip
        subpasses = [
            vk.VkSubpassDescription(
                flags=s.flags, pInputAttachments=[reference(r) for r in s.inputs], colorAttachmentCount=len(s.colors),
                pColorAttachments=[reference(r) for r in s.colors], pResolveAttachments=[reference(r) for r in s.resolves] or None,
                pDepthStencilAttachment=reference(s.depth_stencil[0]) if s.depth_stencil else None,
                pPreserveAttachments=list(s.preserves),
            )
            for s in each.subpasses
        ]  # fmt: skip
        dependencies = [
            vk.VkSubpassDependency(
                srcSubpass=UNUSED if d.source == NONE else d.source, dstSubpass=UNUSED if d.target == NONE else d.target,
                srcStageMask=d.source_stages & MOST_BITS, dstStageMask=d.target_stages & MOST_BITS,
                srcAccessMask=d.source_accesses & MOST_BITS, dstAccessMask=d.target_accesses & MOST_BITS, dependencyFlags=d.flags,
            )
            for d in each.dependencies
        ]  # fmt: skip
        create = vk.VkRenderPassCreateInfo(flags=each.flags, pAttachments=attachments, pSubpasses=subpasses, pDependencies=dependencies)
        return vk.vkCreateRenderPass(self.opened.handle, create, None)
