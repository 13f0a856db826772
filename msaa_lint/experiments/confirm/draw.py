"""Records the steps of a plan into command buffers."""

from __future__ import annotations

import struct
from collections.abc import Sequence
from typing import Any

from . import parts
from .binding import push_bytes
from .build import FrameObjects
from .defined_contents import Contents
from .layouts import Layouts
from .mesh_buffers import mesh_buffers
from .parts import (
    CLEAR,
    COLOR,
    DEPTH,
    DEPTH_READ_LAYOUT,
    NONE,
    READ_LAYOUT,
    SOURCE_LAYOUT,
    STENCIL,
    TARGET_LAYOUT,
    Mesh,
    Pass,
    PassCommand,
    Step,
)
from .scene import (
    BACKDROP,
    CLEARED,
    CLEARED_INTEGERS,
    CLEARED_STENCIL,
    POISON,
    POISON_DEPTH,
    POISON_INTEGER,
    POISON_STENCIL,
)
from .timed import Work
from .workload import Workload

PEAK, HDR_PEAK = 1.0, 8.0
"""The peak brightness of the scene."""

READ_ONLY = (DEPTH_READ_LAYOUT, parts.DEPTH_ALONE_READ_LAYOUT, parts.EITHER_READ_LAYOUT)
"""Layouts of attachments that are not written to."""

ALL_LEVELS = 1000.0
"""VK_LOD_CLAMP_NONE."""


class Recorder:
    """Records the steps of a plan in order, and tracks the layouts and contents of the images."""

    def __init__(
        self, built: FrameObjects, work: tuple[Workload, Work] | None = None, poisons: bool = False
    ) -> None:
        """`work` is what the built-in fragment shaders of `shaded` pipelines do. With `poisons`,
        contents that the frame makes undefined are overwritten (scene.py).
        """
        self.built = built
        self.work = work
        self.vk = built.vk
        self.call = built.opened.call
        self.plan = built.plan
        self.layouts = Layouts(built)
        self.contents = Contents(self.plan, assumed=work is not None)
        self.poisons = poisons
        self.pending: set[tuple[int, int]] = set()
        """What is to be overwritten when it is drawn to next, because no command can."""

    def step(self, buffer: Any, step: Step) -> None:
        """Records one step."""
        if step.kind == "begin":
            frame_pass = self.plan.passes[step.number]
            self._poison_before(buffer, frame_pass, step)
            if frame_pass.kind == parts.RENDERING:
                self._rendering(buffer, frame_pass, step)
            else:
                self._render_pass(buffer, frame_pass, step)
            self.contents.begin(frame_pass, step)
            self._poison_lost(buffer)
        elif step.kind == "barrier":
            self._barrier(buffer, step)
            self.contents.transfer(step)
            self._poison_lost(buffer)
        elif step.illegal:
            with self.built.opened.session.refused() as heard:
                if heard:
                    _TRANSFERS[step.kind](self, buffer, step)
        else:
            # Copies from and to buffers, which nothing else uses, and presenting, for which there
            # is no screen, are not recorded.
            if step.kind in _TRANSFERS:
                _TRANSFERS[step.kind](self, buffer, step)
            self.contents.transfer(step)

    def _poison_before(self, buffer: Any, frame_pass: Pass, step: Step) -> None:
        """Overwrites what the beginning of a pass makes undefined, or notes it for
        `_poison_within`.
        """
        if not self.poisons:
            return
        for (number, aspect), whole in self.contents.lost_at_begin(frame_pass, step).items():
            if whole:
                self._poison(buffer, number, aspect)
            else:
                self.pending.add((number, aspect))

    def _poison_lost(self, buffer: Any) -> None:
        """Overwrites what the last step made undefined."""
        if self.poisons:
            for number, aspect in sorted(self.contents.lost):
                self._poison(buffer, number, aspect)

    def _poison(self, buffer: Any, number: int, aspect: int) -> None:
        """Overwrites an aspect of an image with poison; if no command can, when it is drawn to
        next.
        """
        vk, image = self.vk, self.plan.images[number]
        if number not in self.built.images or not self.built.has_usage(
            number, parts.TRANSFER_TARGET
        ):
            self.pending.add((number, aspect))
            return
        self.pending.discard((number, aspect))
        self.layouts.into(buffer, [(number, TARGET_LAYOUT, None)])
        whole = vk.VkImageSubresourceRange(
            aspectMask=aspect, levelCount=image.levels, layerCount=image.layers
        )
        if aspect == COLOR:
            poison = self._poison_value(number)
            vk.vkCmdClearColorImage(
                buffer,
                self.built.image(number),
                TARGET_LAYOUT,
                vk.ffi.addressof(poison.color),
                1,
                [whole],
            )
        else:
            vk.vkCmdClearDepthStencilImage(
                buffer, self.built.image(number), TARGET_LAYOUT, self._poison_depth(), 1, [whole]
            )

    def _poison_within(self, buffer: Any, frame_pass: Pass, step: Step, subpass: int) -> None:
        """Overwrites what is pending of the attachments that a subpass draws to, in the render
        area.
        """
        vk = self.vk
        attached = [
            (number, COLOR, at) for at, number in enumerate(self._drawn(frame_pass, step, subpass))
        ]
        if frame_pass.kind == parts.RENDERING:
            attached += [
                (r.image, DEPTH if r.role == "depth" else STENCIL, 0)
                for r in frame_pass.rendered
                if r.role != "color"
            ]
        else:
            images = frame_pass.framebuffers[step.framebuffer].images
            depths = [
                r
                for r in frame_pass.subpasses[subpass].depth_stencil
                if r.attachment != NONE and r.layout not in READ_ONLY
            ]
            attached += [
                (images[r.attachment], aspect, 0) for r in depths for aspect in (DEPTH, STENCIL)
            ]
        views = frame_pass.view_mask or any(each.view_mask for each in frame_pass.subpasses)
        layers = (
            1 if views else self.built.layers(frame_pass, frame_pass.framebuffers[step.framebuffer])
        )
        rect = vk.VkClearRect(rect=self._rect(step.area), baseArrayLayer=0, layerCount=layers)
        for number, aspect, at in attached:
            if (number, aspect) in self.pending:
                self.pending.discard((number, aspect))
                value = (
                    self._poison_value(number)
                    if aspect == COLOR
                    else vk.VkClearValue(depthStencil=self._poison_depth())
                )
                clear = vk.VkClearAttachment(
                    aspectMask=aspect, colorAttachment=at, clearValue=value
                )
                vk.vkCmdClearAttachments(buffer, 1, [clear], 1, [rect])

    def _poison_value(self, number: int) -> Any:
        return self._color(number, POISON, (POISON_INTEGER,) * 4)

    def _poison_depth(self) -> Any:
        depth = 1.0 - POISON_DEPTH if self.plan.reversed else POISON_DEPTH
        return self.vk.VkClearDepthStencilValue(depth, POISON_STENCIL)

    def _read(self, step: Step) -> list[int]:
        """The images that a pass reads, as far as they are readable."""
        return list(dict.fromkeys(self.contents.reads(step)))

    def _reading(self, image: int) -> tuple[int, int, None]:
        return (
            image,
            READ_LAYOUT if self.plan.images[image].aspects & COLOR else DEPTH_READ_LAYOUT,
            None,
        )

    def _render_pass(self, buffer: Any, frame_pass: Pass, step: Step) -> None:
        vk = self.vk
        framebuffer = frame_pass.framebuffers[step.framebuffer]
        reads = self._read(step)
        requests: list[tuple[int, int, int | None]] = [
            (image, a.initial, a.stencil_initial if a.stencil_initial != NONE else None)
            for a, image in zip(frame_pass.attachments, framebuffer.images, strict=True)
        ]
        self.layouts.into(buffer, [*requests, *map(self._reading, reads)])
        begin = vk.VkRenderPassBeginInfo(
            renderPass=self.built.render_passes[step.number],
            framebuffer=self.built.framebuffers[step.number, step.framebuffer],
            renderArea=self._rect(step.area),
            pClearValues=self._clears(frame_pass, framebuffer.images),
        )
        uses_version_2 = frame_pass.api == 2
        if uses_version_2:
            self.call("vkCmdBeginRenderPass2")(buffer, begin, vk.VkSubpassBeginInfo(contents=0))
        else:
            vk.vkCmdBeginRenderPass(buffer, begin, 0)
        for subpass in range(len(frame_pass.subpasses)):
            if subpass and uses_version_2:
                self.call("vkCmdNextSubpass2")(
                    buffer, vk.VkSubpassBeginInfo(contents=0), vk.VkSubpassEndInfo()
                )
            elif subpass:
                vk.vkCmdNextSubpass(buffer, 0)
            self._inner(buffer, frame_pass, step, subpass, reads)
        if uses_version_2:
            self.call("vkCmdEndRenderPass2")(buffer, vk.VkSubpassEndInfo())
        else:
            vk.vkCmdEndRenderPass(buffer)
        for a, image in zip(frame_pass.attachments, framebuffer.images, strict=True):
            self.layouts.left(image, a.final, a.stencil_final if a.stencil_final != NONE else None)

    def _rendering(self, buffer: Any, frame_pass: Pass, step: Step) -> None:
        vk = self.vk
        resumes = frame_pass.flags & parts.RESUMING
        reads = [] if resumes else self._read(step)
        layers = self.built.layers(frame_pass, frame_pass.framebuffers[0])
        requests: list[tuple[int, int, int | None]] = []
        infos: dict[str, list[Any]] = {"color": [], "depth": [], "stencil": []}
        for r in frame_pass.rendered:
            if r.image == NONE:
                infos[r.role].append(vk.VkRenderingAttachmentInfo())
                continue
            requests.append((r.image, r.layout, None))
            if r.resolve_image != NONE:
                requests.append((r.resolve_image, r.resolve_layout, None))
            infos[r.role].append(
                vk.VkRenderingAttachmentInfo(
                    imageView=self.built.view(r.image, layers), imageLayout=r.layout,
                    resolveMode=r.mode,
                    resolveImageView=self.built.view(r.resolve_image,
                    layers) if r.resolve_image != NONE else None,
                    resolveImageLayout=r.resolve_layout, loadOp=r.load, storeOp=r.store,
                    clearValue=self._clear(r.image),
                )
            )  # fmt: skip
        if not resumes:
            self.layouts.into(buffer, [*requests, *map(self._reading, reads)])
        chained = None
        if frame_pass.single_sampled:
            chained = vk.VkMultisampledRenderToSingleSampledInfoEXT(
                multisampledRenderToSingleSampledEnable=1,
                rasterizationSamples=frame_pass.single_sampled,
            )
        begin = vk.VkRenderingInfo(
            pNext=chained,
            flags=frame_pass.flags,
            renderArea=self._rect(step.area),
            layerCount=frame_pass.layers,
            viewMask=frame_pass.view_mask,
            pColorAttachments=infos["color"],
            pDepthAttachment=infos["depth"][0] if infos["depth"] else None,
            pStencilAttachment=infos["stencil"][0] if infos["stencil"] else None,
        )
        self.call("vkCmdBeginRendering")(buffer, begin)
        self._inner(buffer, frame_pass, step, 0, reads)
        self.call("vkCmdEndRendering")(buffer)

    def _inner(
        self, buffer: Any, frame_pass: Pass, step: Step, subpass: int, reads: list[int]
    ) -> None:
        """Records the commands of a subpass."""
        vk, framebuffer = self.vk, frame_pass.framebuffers[step.framebuffer]
        near, far = (1.0, 0.0) if self.plan.reversed else (0.0, 1.0)
        commands = [inner for inner in step.inner if inner.subpass == subpass]
        viewport = vk.VkViewport(
            width=framebuffer.width, height=framebuffer.height, minDepth=near, maxDepth=far
        )
        vk.vkCmdSetViewport(buffer, 0, 1, [viewport])
        vk.vkCmdSetScissor(buffer, 0, 1, [self._rect(step.area)])
        if self.poisons and not frame_pass.flags & parts.RESUMING:
            self._poison_within(buffer, frame_pass, step, subpass)
        images = [i.image for i in commands if i.kind == "read" and i.image in reads]
        filled = bool(images) and self._fill(buffer, step, subpass, list(dict.fromkeys(images)))
        count, rotation = 0, 0
        vertex_buffer, vertices = self.built.vertices()
        vk.vkCmdBindVertexBuffers(buffer, 0, 1, [vertex_buffer], [0])
        for inner in commands:
            if inner.kind == "samples":
                count = inner.value
            elif inner.kind == "clear":
                self._clear_attachment(buffer, frame_pass, step, inner)
            elif inner.kind == "draw":
                pipeline = frame_pass.pipelines[inner.pipeline]
                vk.vkCmdBindPipeline(buffer, 0, self.built.pipelines[step.number, inner.pipeline])
                self._dynamic(buffer, pipeline, count)
                # The built-in vertex shader turns every other draw of the scene.
                self._bind(buffer, step, inner.pipeline, 0 if inner.mesh else rotation)
                first = 0 if (inner.backdrop and not filled) or self.plan.vertices else BACKDROP
                if inner.mesh:
                    self._mesh(buffer, step, inner.mesh[0], pipeline)
                    vk.vkCmdBindVertexBuffers(buffer, 0, 1, [vertex_buffer], [0])
                else:
                    # The instance tells the generated vertex shader which draw this is; the
                    # built-in one has a push constant for it.
                    vk.vkCmdDraw(
                        buffer, vertices - first, 1, first, rotation if pipeline.stages else 0
                    )
                rotation += 1

    def _mesh(self, buffer: Any, step: Step, mesh: Mesh, pipeline: parts.Pipeline) -> None:
        """Records the draws of a mesh over the render area."""
        vk = self.vk
        x, y, width, height = step.area
        near, far = (1.0, 0.0) if self.plan.reversed else (0.0, 1.0)
        vk.vkCmdSetViewport(
            buffer,
            0,
            1,
            [vk.VkViewport(x=x, y=y, width=width, height=height, minDepth=near, maxDepth=far)],
        )
        if pipeline.has_vertex_shader:
            for _ in range(mesh.draws):
                vk.vkCmdDraw(buffer, mesh.vertices, mesh.instances, 0, 0)
            return
        for draw in range(mesh.draws):
            vertex_buffer, first = mesh_buffers(self.built.opened).of(mesh, draw)
            if draw == 0:
                vk.vkCmdBindVertexBuffers(buffer, 0, 1, [vertex_buffer], [0])
            vk.vkCmdDraw(buffer, 3 * mesh.triangles, 1, first, 0)

    def _bind(self, buffer: Any, step: Step, number: int, rotation: int) -> None:
        """Binds what the shaders of a pipeline read."""
        pipeline = self.plan.passes[step.number].pipelines[number]
        bindings = self.built.bindings.get((step.number, number))
        if bindings is not None:
            bindings.bind(buffer, step.framebuffer)
            return
        pushed = struct.pack("=fi", HDR_PEAK if self.plan.hdr else PEAK, rotation)
        layout = self.built.opened.layout("shaded" if pipeline.shaded else "scene")[0]
        self.vk.vkCmdPushConstants(buffer, layout, 1, 0, len(pushed), push_bytes(pushed))
        if self.work is not None and pipeline.shaded:
            self.work[0].bind(buffer, self.work[1])

    def _dynamic(self, buffer: Any, pipeline: parts.Pipeline, count: int) -> None:
        if parts.SAMPLES_DYNAMIC in pipeline.dynamic:
            self.call("vkCmdSetRasterizationSamplesEXT")(buffer, count or pipeline.samples)
        if parts.MASK_DYNAMIC in pipeline.dynamic:
            text = [*pipeline.mask, 0xFFFFFFFF][:1]
            self.call("vkCmdSetSampleMaskEXT")(
                buffer, count or pipeline.samples, self.vk.ffi.new("uint32_t[]", text)
            )
        if parts.COVERAGE_DYNAMIC in pipeline.dynamic:
            self.call("vkCmdSetAlphaToCoverageEnableEXT")(buffer, int(pipeline.alpha_to_coverage))

    def _fill(self, buffer: Any, step: Step, subpass: int, images: list[int]) -> bool:
        """Writes the images that are read to every pixel, each to its own stripe."""
        vk, opened = self.vk, self.built.opened
        x, y, width, height = step.area
        layout, set_layout = opened.layout("read")
        framebuffer = self.plan.passes[step.number].framebuffers[step.framebuffer]
        filled = False
        for n, number in enumerate(images):
            image = self.plan.images[number]
            pipeline = self.built.reader(step.number, subpass, image.samples > 1)
            if pipeline is None:
                continue
            top, bottom = y + height * n // len(images), y + height * (n + 1) // len(images)
            vk.vkCmdSetScissor(buffer, 0, 1, [self._rect((x, top, width, max(bottom - top, 1)))])
            vk.vkCmdBindPipeline(buffer, 0, pipeline)
            descriptor = self.descriptor(set_layout, number)
            vk.vkCmdBindDescriptorSets(buffer, 0, layout, 0, 1, [descriptor], 0, None)
            scale = struct.pack(
                "=ffi",
                image.width / framebuffer.width,
                image.height / framebuffer.height,
                image.samples,
            )
            vk.vkCmdPushConstants(buffer, layout, 16, 0, len(scale), push_bytes(scale))
            vk.vkCmdDraw(buffer, 3, 1, 0, 0)
            filled = True
        vk.vkCmdSetScissor(buffer, 0, 1, [self._rect(step.area)])
        return filled

    def descriptor(self, set_layout: Any, number: int, storage: Any = None) -> Any:
        """A descriptor set with a sampled image and an optional storage buffer."""
        vk, handle, built = self.vk, self.built.opened.handle, self.built
        sizes = [vk.VkDescriptorPoolSize(type=1, descriptorCount=1)]
        if storage is not None:
            sizes.append(vk.VkDescriptorPoolSize(type=7, descriptorCount=1))
        pool = vk.vkCreateDescriptorPool(
            handle, vk.VkDescriptorPoolCreateInfo(maxSets=1, pPoolSizes=sizes), None
        )
        built.own(vk.vkDestroyDescriptorPool, pool)
        descriptor_set = vk.vkAllocateDescriptorSets(
            handle, vk.VkDescriptorSetAllocateInfo(descriptorPool=pool, pSetLayouts=[set_layout])
        )[0]
        sampler = built.own(
            vk.vkDestroySampler,
            vk.vkCreateSampler(handle, vk.VkSamplerCreateInfo(maxLod=ALL_LEVELS), None),
        )
        aspect = self.plan.images[number].aspects & (COLOR | DEPTH)
        image = vk.VkDescriptorImageInfo(
            sampler=sampler,
            imageView=built.view(number, 1, aspect),
            imageLayout=self._reading(number)[1],
        )
        writes = [
            vk.VkWriteDescriptorSet(
                dstSet=descriptor_set,
                dstBinding=0,
                descriptorCount=1,
                descriptorType=1,
                pImageInfo=[image],
            )
        ]
        if storage is not None:
            whole = vk.VkDescriptorBufferInfo(buffer=storage, offset=0, range=0xFFFFFFFFFFFFFFFF)
            writes.append(
                vk.VkWriteDescriptorSet(
                    dstSet=descriptor_set,
                    dstBinding=1,
                    descriptorCount=1,
                    descriptorType=7,
                    pBufferInfo=[whole],
                )
            )
        vk.vkUpdateDescriptorSets(handle, len(writes), writes, 0, None)
        return descriptor_set

    def _clear_attachment(
        self, buffer: Any, frame_pass: Pass, step: Step, inner: PassCommand
    ) -> None:
        vk = self.vk
        images = self._drawn(frame_pass, step, inner.subpass)
        number = (
            images[inner.value] if inner.aspects & COLOR and inner.value < len(images) else NONE
        )
        clear = (
            self._clear(number)
            if number != NONE
            else vk.VkClearValue(depthStencil=self._clear_depth())
        )
        attachment = vk.VkClearAttachment(
            aspectMask=inner.aspects, colorAttachment=inner.value, clearValue=clear
        )
        areas = [clipped(rect, step.area) for rect in inner.rects] if inner.rects else [step.area]
        rects = [
            vk.VkClearRect(rect=self._rect(area), baseArrayLayer=0, layerCount=1)
            for area in areas
            if min(area[2:]) > 0
        ]
        if rects:
            vk.vkCmdClearAttachments(buffer, 1, [attachment], len(rects), rects)

    def _drawn(self, frame_pass: Pass, step: Step, subpass: int) -> list[int]:
        if frame_pass.kind == parts.RENDERING:
            return [r.image for r in frame_pass.rendered if r.role == "color"]
        images = frame_pass.framebuffers[step.framebuffer].images
        return [
            images[r.attachment] if r.attachment != NONE else NONE
            for r in frame_pass.subpasses[subpass].colors
        ]

    def _clear_depth(self) -> Any:
        return self.vk.VkClearDepthStencilValue(0.0 if self.plan.reversed else 1.0, CLEARED_STENCIL)

    def _clears(self, frame_pass: Pass, images: tuple[int, ...]) -> list[Any]:
        """The clear values of a pass's attachments, up to the last one that is cleared."""
        clearing = [
            index
            for index, (a, image) in enumerate(zip(frame_pass.attachments, images, strict=True))
            if a.load == CLEAR
            or (a.stencil_load == CLEAR and self.plan.images[image].aspects & STENCIL)
        ]
        return [self._clear(image) for image in images[: clearing[-1] + 1]] if clearing else []

    def _clear(self, number: int) -> Any:
        vk, image = self.vk, self.plan.images[number]
        if not image.aspects & COLOR:
            return vk.VkClearValue(depthStencil=self._clear_depth())
        return self._color(number, CLEARED, CLEARED_INTEGERS)

    def _color(self, number: int, color: Sequence[float], integers: Sequence[int]) -> Any:
        vk, image = self.vk, self.plan.images[number]
        if image.numeric in ("UINT", "SINT"):
            member = "uint32" if image.numeric == "UINT" else "int32"
            return vk.VkClearValue(color=vk.VkClearColorValue(**{member: list(integers)}))
        return vk.VkClearValue(color=vk.VkClearColorValue(float32=list(color)))

    def _rect(self, area: tuple[int, ...]) -> Any:
        vk = self.vk
        return vk.VkRect2D(
            offset=vk.VkOffset2D(area[0], area[1]), extent=vk.VkExtent2D(area[2], area[3])
        )

    def _barrier(self, buffer: Any, step: Step) -> None:
        """Records a barrier of the frame with its stated masks; the old layouts are the actual
        ones.
        """
        vk = self.vk
        source, source_access = self.built.opened.masks(step.masks[0], step.masks[2])
        target, target_access = self.built.opened.masks(step.masks[1], step.masks[3])
        if not source or not target:
            source, target = source or 0x10000, target or 0x10000
        names = ("srcStageMask", "srcAccessMask", "dstStageMask", "dstAccessMask")
        masks = dict(zip(names, (source, source_access, target, target_access), strict=True))
        barriers = []
        for number, old, new in step.layouts:
            if number not in self.built.images:
                continue
            current = self.layouts.now(
                number, COLOR if self.plan.images[number].aspects & COLOR else DEPTH
            )
            before = parts.UNDEFINED if old == parts.UNDEFINED else current
            after = current if new in (NONE, parts.UNDEFINED) else new
            whole = vk.VkImageSubresourceRange(
                aspectMask=self.plan.images[number].aspects,
                levelCount=0xFFFFFFFF,
                layerCount=0xFFFFFFFF,
            )
            if after != parts.UNDEFINED:
                barriers.append(
                    vk.VkImageMemoryBarrier2(
                        **masks, oldLayout=before, newLayout=after, srcQueueFamilyIndex=0xFFFFFFFF,
                        dstQueueFamilyIndex=0xFFFFFFFF,
                        image=self.built.image(number), subresourceRange=whole,
                    )
                )  # fmt: skip
                self.layouts.left(number, after)
        memory = [] if barriers else [vk.VkMemoryBarrier2(**masks)]
        self.call("vkCmdPipelineBarrier2")(
            buffer, vk.VkDependencyInfo(pMemoryBarriers=memory, pImageMemoryBarriers=barriers)
        )

    def _layers(self, number: int, aspects: int) -> Any:
        return self.vk.VkImageSubresourceLayers(
            aspectMask=aspects, mipLevel=0, baseArrayLayer=0, layerCount=1
        )

    def _extent(self, step: Step) -> Any:
        source, target = self.plan.images[step.source], self.plan.images[step.target]
        return self.vk.VkExtent3D(
            min(source.width, target.width), min(source.height, target.height), 1
        )

    def _between(self, buffer: Any, step: Step) -> tuple[Any, Any, int]:
        self.layouts.into(
            buffer, [(step.source, SOURCE_LAYOUT, None), (step.target, TARGET_LAYOUT, None)]
        )
        aspects = self.plan.images[step.source].aspects & self.plan.images[step.target].aspects
        return self.built.image(step.source), self.built.image(step.target), aspects

    def _copy(self, buffer: Any, step: Step) -> None:
        """Copies an image, or resolves it."""
        vk = self.vk
        source, target, aspects = self._between(buffer, step)
        structure, command = (
            (vk.VkImageResolve, vk.vkCmdResolveImage)
            if step.kind == "resolve"
            else (vk.VkImageCopy, vk.vkCmdCopyImage)
        )
        region = structure(
            srcSubresource=self._layers(step.source, aspects),
            dstSubresource=self._layers(step.target, aspects),
            extent=self._extent(step),
        )
        with self.built.opened.session.about(self.plan.images[step.source].name):
            command(buffer, source, SOURCE_LAYOUT, target, TARGET_LAYOUT, 1, [region])

    def _blit(self, buffer: Any, step: Step) -> None:
        vk = self.vk
        source, target, aspects = self._between(buffer, step)
        corners = [
            [
                vk.VkOffset3D(),
                vk.VkOffset3D(self.plan.images[n].width, self.plan.images[n].height, 1),
            ]
            for n in (step.source, step.target)
        ]
        region = vk.VkImageBlit(
            srcSubresource=self._layers(step.source, aspects), srcOffsets=corners[0],
            dstSubresource=self._layers(step.target, aspects), dstOffsets=corners[1],
        )  # fmt: skip
        vk.vkCmdBlitImage(
            buffer, source, SOURCE_LAYOUT, target, TARGET_LAYOUT, 1, [region], step.filter
        )

    def _clear_image(self, buffer: Any, step: Step) -> None:
        vk, image = self.vk, self.plan.images[step.target]
        self.layouts.into(buffer, [(step.target, TARGET_LAYOUT, None)])
        whole = vk.VkImageSubresourceRange(
            aspectMask=image.aspects, levelCount=image.levels, layerCount=image.layers
        )
        if image.aspects & COLOR:
            # Keep a reference, because `color` points into it.
            clear = self._clear(step.target)
            color = vk.ffi.addressof(clear.color)
            vk.vkCmdClearColorImage(
                buffer, self.built.image(step.target), TARGET_LAYOUT, color, 1, [whole]
            )
        else:
            clear = self._clear_depth()
            vk.vkCmdClearDepthStencilImage(
                buffer, self.built.image(step.target), TARGET_LAYOUT, clear, 1, [whole]
            )


def clipped(rect: tuple[int, ...], area: tuple[int, ...]) -> tuple[int, ...]:
    """The part of a rectangle (x, y, width, height) that is within another."""
    x, y = max(rect[0], area[0]), max(rect[1], area[1])
    return (
        x,
        y,
        min(rect[0] + rect[2], area[0] + area[2]) - x,
        min(rect[1] + rect[3], area[1] + area[3]) - y,
    )


_TRANSFERS = {
    "resolve": Recorder._copy,
    "copy": Recorder._copy,
    "blit": Recorder._blit,
    "clear": Recorder._clear_image,
}
