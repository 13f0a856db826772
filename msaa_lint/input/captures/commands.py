"""Follows what command buffers record of passes and draws, and their submission."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from msaa_lint.frame.description.models import BeginRendering, RenderingAttachment

from . import values
from .call import Call
from .command_buffers import FEW, Begin, CommandBuffer, Commands, Reads, Recorded, draw_key, drawn
from .objects import DescriptorSet, Image, frozen
from .structures import Tree, described

GRAPHICS = ("VK_PIPELINE_BIND_POINT_GRAPHICS", 0, "0")

BOUNDARIES = ("beginRenderPass", "beginRendering", "nextSubpass", "endRenderPass", "endRendering")
"""Commands at which a pass or a subpass begins or ends."""

if TYPE_CHECKING:
    from .frames import Frames
    from .objects import Framebuffer, Pipeline, RenderPass


class Recorder:
    """Follows the commands of a capture. `Tracker` has the objects that they name."""

    commands: Commands

    images: dict[int, Image]
    render_passes: dict[int, RenderPass]
    framebuffers: dict[int, Framebuffer]
    pipelines: dict[int, Pipeline]
    sets: dict[int, DescriptorSet]
    buffers: dict[int, CommandBuffer]
    pools: dict[int, set[int]]
    frames: Frames

    def view(self, value: object) -> Image | None:
        """The image that a view shows."""
        raise NotImplementedError

    def write(self, target: DescriptorSet, write: dict[str, Any]) -> None:
        """A VkWriteDescriptorSet into a set."""
        raise NotImplementedError

    def buffer(self, call: Call) -> CommandBuffer:
        """The command buffer that a command is recorded in. A trimmed capture may not have its allocation."""
        handle = values.handle(call.args.get("commandBuffer"))
        found = self.buffers.get(handle)
        if found is None:
            found = self.buffers[handle] = CommandBuffer()
        return found

    # Command buffers.

    def on_AllocateCommandBuffers(self, call: Call) -> None:
        info = values.record(call.args.get("pAllocateInfo"))
        pool = self.pools.setdefault(values.handle(info.get("commandPool")), set())
        for item in values.items(call.args.get("pCommandBuffers")):
            handle = values.handle(item)
            self.buffers[handle] = CommandBuffer()
            pool.add(handle)

    def on_FreeCommandBuffers(self, call: Call) -> None:
        for item in values.items(call.args.get("pCommandBuffers")):
            self.buffers.pop(values.handle(item), None)

    def on_DestroyCommandPool(self, call: Call) -> None:
        for handle in self.pools.pop(values.handle(call.args.get("commandPool")), ()):
            self.buffers.pop(handle, None)

    def on_BeginCommandBuffer(self, call: Call) -> None:
        self.buffers[values.handle(call.args.get("commandBuffer"))] = CommandBuffer()

    # Passes.

    def on_CmdBeginRenderPass(self, call: Call) -> None:
        info = values.record(call.args.get("pRenderPassBegin"))
        render_pass = self.render_passes.get(values.handle(info.get("renderPass")))
        buffer = self.buffer(call)
        buffer.boundary()
        if render_pass is None:
            return
        framebuffer = self.framebuffers.get(values.handle(info.get("framebuffer")))
        images: tuple[Image | None, ...] = framebuffer.images or () if framebuffer is not None else ()
        chained = values.chained(info, "RENDER_PASS_ATTACHMENT_BEGIN_INFO")
        if chained is not None:
            images = tuple(self.view(view) for view in values.items(chained.get("pAttachments"))[:64])
        begin = Begin(render_pass, framebuffer, images, area_of(info.get("renderArea")), values.count(info.get("clearValueCount")))
        buffer.record(self.commands.command("beginRenderPass", begin, call))

    def on_CmdBeginRenderPass2(self, call: Call) -> None:
        self.on_CmdBeginRenderPass(call)

    def on_CmdNextSubpass(self, call: Call) -> None:
        buffer = self.buffer(call)
        buffer.boundary()
        buffer.record(self.commands.command("nextSubpass", None, call))

    def on_CmdNextSubpass2(self, call: Call) -> None:
        self.on_CmdNextSubpass(call)

    def on_CmdEndRenderPass(self, call: Call) -> None:
        buffer = self.buffer(call)
        buffer.boundary()
        buffer.record(self.commands.command("endRenderPass", None, call))

    def on_CmdEndRenderPass2(self, call: Call) -> None:
        self.on_CmdEndRenderPass(call)

    def on_CmdBeginRendering(self, call: Call) -> None:
        info = values.record(call.args.get("pRenderingInfo"))
        tree = described(BeginRendering, {key: item for key, item in info.items() if not key.endswith(("Attachment", "Attachments"))})
        area = area_of(info.get("renderArea"))
        if area is not None:
            tree["renderArea"] = dict(zip(("x", "y", "width", "height"), area, strict=True))
        tree["colorAttachments"] = [self._attachment(each) for each in values.items(info.get("pColorAttachments"))[:64]]
        for name, member in (("pDepthAttachment", "depthAttachment"), ("pStencilAttachment", "stencilAttachment")):
            attachment = self._attachment(info.get(name))
            if attachment is not None:
                tree[member] = attachment
        # What a secondary command buffer draws is recorded in it.
        tree["flags"] = [flag for flag in tree.get("flags", []) if not flag.startswith("CONTENTS")]
        buffer = self.buffer(call)
        buffer.boundary()
        buffer.record(self.commands.command("beginRendering", frozen(tree), call))

    def _attachment(self, value: object) -> Tree | None:
        """A VkRenderingAttachmentInfo with images in place of views; None where it has no view."""
        info = values.record(value)
        image = self.view(info.get("imageView"))
        if image is None:
            return None
        tree = described(RenderingAttachment, info)
        made: Tree = {"image": image, **tree}
        resolve = self.view(info.get("resolveImageView"))
        if resolve is not None:
            made["resolveImage"] = resolve
        elif made.get("resolveMode") == "NONE":
            for member in ("resolveMode", "resolveImageLayout"):
                made.pop(member, None)
        return made

    def on_CmdEndRendering(self, call: Call) -> None:
        buffer = self.buffer(call)
        buffer.boundary()
        buffer.record(self.commands.command("endRendering", None, call))

    def on_CmdEndRendering2(self, call: Call) -> None:
        self.on_CmdEndRendering(call)

    def on_CmdExecuteCommands(self, call: Call) -> None:
        buffer = self.buffer(call)
        for item in values.items(call.args.get("pCommandBuffers")):
            secondary = self.buffers.get(values.handle(item))
            if secondary is not None and secondary is not buffer:
                buffer.reads = buffer.reads or secondary.reads
                for each in secondary.recorded:
                    buffer.record(each)
        # Nothing that was bound before is bound after.
        buffer.pipeline = None
        buffer.bound.clear()
        buffer.fresh = True

    # State, draws and dispatches.

    def on_CmdBindPipeline(self, call: Call) -> None:
        if call.args.get("pipelineBindPoint") in GRAPHICS:
            self.buffer(call).pipeline = self.pipelines.get(values.handle(call.args.get("pipeline")))

    def on_CmdBindShaders(self, call: Call) -> None:
        self.buffer(call).pipeline = None

    def on_CmdSetRasterizationSamples(self, call: Call) -> None:
        count = values.samples(call.args.get("rasterizationSamples"))
        if count is not None:
            buffer = self.buffer(call)
            buffer.samples = count
            # A draw after it is not the one before it.
            buffer.many.clear()

    def on_CmdBindDescriptorSets(self, call: Call) -> None:
        buffer = self.buffer(call)
        point = call.args.get("pipelineBindPoint")
        bound = buffer.bound if point in GRAPHICS else buffer.compute_bound
        slot = values.integer(call.args.get("firstSet")) or 0
        for item in values.items(call.args.get("pDescriptorSets"))[:64]:
            found = self.sets.get(values.handle(item))
            if found is not bound.get(slot):
                # The same set again, with other offsets, shows the same images.
                buffer.fresh = True
                if found is not None:
                    bound[slot] = found
                else:
                    del bound[slot]
            slot += 1

    def on_CmdPushDescriptorSet(self, call: Call) -> None:
        buffer = self.buffer(call)
        point = call.args.get("pipelineBindPoint")
        bound = buffer.bound if point in GRAPHICS else buffer.compute_bound
        pushed = DescriptorSet()
        index = values.integer(call.args.get("set")) or 0
        before = bound.get(index)
        if before is not None:
            pushed.images.update(before.images)
            pushed.opaque = before.opaque
        for item in values.items(call.args.get("pDescriptorWrites")):
            self.write(pushed, values.record(item))
        bound[index] = pushed
        buffer.fresh = True

    def on_CmdPushDescriptorSetWithTemplate(self, call: Call) -> None:
        self._opaque(call, values.integer(call.args.get("set")) or 0)

    def on_CmdBindDescriptorBuffers(self, call: Call) -> None:
        self._opaque(call, -1)

    def _opaque(self, call: Call, index: int) -> None:
        """Descriptors that the capture does not spell out: they may hold any image."""
        buffer = self.buffer(call)
        unknown = DescriptorSet()
        unknown.opaque = True
        buffer.bound[index] = buffer.compute_bound[index] = unknown
        buffer.fresh = True

    def on_CmdDraw(self, call: Call) -> None:
        self._draw(call, "vertexCount")

    def on_CmdDrawIndexed(self, call: Call) -> None:
        self._draw(call, "indexCount")

    def _many(self, call: Call) -> None:
        self._draw(call, "")

    on_CmdDrawIndirect = on_CmdDrawIndexedIndirect = on_CmdDrawIndirectCount = on_CmdDrawIndexedIndirectCount = _many
    on_CmdDrawMeshTasks = on_CmdDrawMeshTasksIndirect = on_CmdDrawMeshTasksIndirectCount = on_CmdDrawMulti = on_CmdDrawMultiIndexed = _many
    on_CmdDrawIndirectByteCount = _many

    def _draw(self, call: Call, counted: str) -> None:
        """A draw of so many vertices or indices, or (without a word for it) of as many as a buffer says."""
        args = call.args
        handle = args.get("commandBuffer")
        buffer = (self.buffers.get(handle) if type(handle) is int else None) or self.buffer(call)
        if not buffer.fresh and buffer.pipeline in buffer.many:
            # One of many like it, as most draws are.
            count = args.get(counted)
            if type(count) is int and count > FEW:
                return
        detail = drawn(counted, call.args)
        key = draw_key(buffer.pipeline, counted, *detail)
        if buffer.fresh:
            self._reads(buffer, buffer.bound, "FRAGMENT", call)
            buffer.fresh = False
        buffer.once(self.commands.command("draw", (*key, buffer.dynamic_samples), call, detail))
        if counted and key[2] is None:
            buffer.many.add(buffer.pipeline)

    def on_CmdDispatch(self, call: Call) -> None:
        buffer = self.buffer(call)
        self._reads(buffer, buffer.compute_bound, "COMPUTE", call)

    on_CmdDispatchIndirect = on_CmdDispatchBase = on_CmdTraceRays = on_CmdTraceRaysIndirect = on_CmdTraceRaysIndirect2 = on_CmdDispatch

    def _reads(self, buffer: CommandBuffer, bound: dict[int, DescriptorSet], stage: str, call: Call) -> None:
        # What a set holds is looked up later: it may be filled after it is bound, where it says so.
        if bound:
            buffer.reads = True
            sets = tuple(each for _, each in sorted(bound.items())) if len(bound) > 1 else tuple(bound.values())
            reads = self.commands.command("reads", Reads(sets, stage), call)
            # Between dispatches an image may be written anew, which within a pass it is not.
            (buffer.once if stage == "FRAGMENT" else buffer.record)(reads)

    # Submission.

    def on_QueueSubmit(self, call: Call) -> None:
        for item in values.items(call.args.get("pSubmits")):
            for handle in values.items(values.record(item).get("pCommandBuffers")):
                self._submit(handle)

    def on_QueueSubmit2(self, call: Call) -> None:
        for item in values.items(call.args.get("pSubmits")):
            for info in values.items(values.record(item).get("pCommandBufferInfos")):
                self._submit(values.record(info).get("commandBuffer"))

    def _submit(self, handle: object) -> None:
        found = self.buffers.get(values.handle(handle))
        if found is not None:
            self.frames.submit(self._resolved(found.recorded) if found.reads else found.recorded)

    def _resolved(self, recorded: list[Recorded]) -> list[Recorded]:
        """The commands with reads of images in place of descriptor sets, as these are when the commands are submitted."""
        made: list[Recorded] = []
        seen: set[Recorded] = set()
        for each in recorded:
            if not isinstance(each.key, Reads):
                if each.kind in BOUNDARIES:
                    seen.clear()
                made.append(each)
                continue
            for held in each.key.sets:
                for image, storage in self._held(held):
                    for kind in ("readImage", "writeImage") if storage else ("readImage",):
                        read = self.commands.command(kind, (image, each.key.stage), Call(each.by, {}, each.at))
                        if read not in seen:
                            seen.add(read)
                            made.append(read)
        return made

    def _held(self, descriptors: DescriptorSet) -> list[tuple[Image, bool]]:
        """The images of a set, and whether it may write them; of one that is not told all that it could hold."""
        if not descriptors.opaque:
            return list(descriptors.images.values())
        readable = [image for image in self.images.values() if "SAMPLED" in image.tree.get("usage", ("SAMPLED",)) and image.attachable]
        return [*descriptors.images.values(), *((image, False) for image in dict.fromkeys(readable))]


def area_of(value: object) -> tuple[int, int, int, int] | None:
    """A VkRect2D as x, y, width, height, in pixels."""
    rect = values.record(value)
    offset, extent = values.record(rect.get("offset")), values.record(rect.get("extent"))
    found = (
        values.integer(offset.get("x", 0)), values.integer(offset.get("y", 0)),
        values.integer(extent.get("width")), values.integer(extent.get("height")),
    )  # fmt: skip
    x, y, width, height = found
    if x is None or y is None or width is None or height is None or width < 1 or height < 1:
        return None
    return (x, y, width, height) if max(width, height, abs(x), abs(y)) < 1 << 31 else None
