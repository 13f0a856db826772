"""Tracks passes and draws in command buffers, and their submission."""

from __future__ import annotations

from collections.abc import Hashable

from msaa_lint.frame.description.models import (
    BeginRendering,
    FragmentDensityMapAttachment,
    FragmentShadingRateAttachment,
    RenderingAttachment,
)
from msaa_lint.frame.description.record import Record

from . import values
from .bound_sets import GRAPHICS, BoundSets, bind_point
from .call import Call
from .command_buffers import (
    MAX_FULLSCREEN_VERTICES,
    BindPoint,
    CommandBuffer,
    DescriptorReads,
    DrawCounts,
    Execution,
    Parts,
    RenderPassBegin,
    kind_of,
)
from .labels import Path, inner_path, printable
from .objects import Framebuffer, Image, Pipeline, RenderPass, SetBindings, freeze
from .structures import Tree, to_tree

MAX_QUEUES = 256
"""Maximum number of queues whose labels are followed."""

MAX_QUEUE_LABELS = 256
"""Maximum number of labels of a queue that are open at a time."""

COUNTED = {"vkCmdDraw": "vertexCount", "vkCmdDrawIndexed": "indexCount"}
"""The parameter with the number of vertices or indices of a draw; most other draws have it in a
buffer.
"""

MULTIPLE = {
    "vkCmdDrawMultiEXT": ("vertexCount", "pVertexInfo"),
    "vkCmdDrawMultiIndexedEXT": ("indexCount", "pIndexInfo"),
}
"""Of commands that draw several times: the member with the number of vertices or indices, and the
array of structures that has it.
"""


RATES: dict[str, tuple[str, type[Record]]] = {
    "RENDERING_FRAGMENT_DENSITY_MAP_ATTACHMENT_INFO": (
        "fragmentDensityMapAttachment",
        FragmentDensityMapAttachment,
    ),
    "RENDERING_FRAGMENT_SHADING_RATE_ATTACHMENT_INFO": (
        "fragmentShadingRateAttachment",
        FragmentShadingRateAttachment,
    ),
}
"""Structures chained to a VkRenderingInfo that name an image, with the member of a description for
each.
"""


class CommandTracker(BoundSets):
    """Tracks the commands of a capture."""

    def __init__(self) -> None:
        super().__init__()
        self.render_passes: dict[int, RenderPass] = {}
        self.framebuffers: dict[int, Framebuffer] = {}
        self.pipelines: dict[int, Pipeline] = {}
        self.pipeline_bindings: dict[int, SetBindings | None] = {}
        """What each pipeline can read of descriptor sets; None if that is unknown."""
        self.queue_labels: dict[int, list[str]] = {}
        """The open labels of each queue."""

    # Passes.

    def on_CmdBeginRenderPass(self, call: Call) -> None:
        info = values.record(call.args.get("pRenderPassBegin"))
        render_pass = self.render_passes.get(values.handle(info.get("renderPass")))
        buffer = self.buffer(call)
        buffer.start_section()
        if render_pass is None:
            return
        framebuffer = self.framebuffers.get(values.handle(info.get("framebuffer")))
        images: tuple[Image | None, ...] = (
            framebuffer.images or () if framebuffer is not None else ()
        )
        parts = framebuffer.parts if framebuffer is not None else ()
        imageless = values.chained(info, "RENDER_PASS_ATTACHMENT_BEGIN_INFO")
        if imageless is not None:
            views = values.items(imageless.get("pAttachments"))[:64]
            images, parts = tuple(map(self.view, views)), self.parts_of(views)
        begin = RenderPassBegin(
            render_pass,
            framebuffer,
            images,
            area_of(info.get("renderArea")),
            values.count(info.get("clearValueCount")),
        )
        buffer.record_boundary(self.commands.command("beginRenderPass", begin, call, parts=parts))

    on_CmdBeginRenderPass2 = on_CmdBeginRenderPass

    def on_CmdNextSubpass(self, call: Call) -> None:
        self._record_boundary(call, kind_of(call), None)

    on_CmdNextSubpass2 = on_CmdEndRenderPass = on_CmdEndRenderPass2 = on_CmdEndRendering = (
        on_CmdEndRendering2
    ) = on_CmdNextSubpass

    def _record_boundary(self, call: Call, kind: str, key: Hashable, parts: Parts = ()) -> None:
        """Records a command that begins or ends a pass or subpass."""
        self.buffer(call).record_boundary(self.commands.command(kind, key, call, parts=parts))

    def on_CmdBeginRendering(self, call: Call) -> None:
        info = values.record(call.args.get("pRenderingInfo"))
        tree = to_tree(
            BeginRendering,
            {
                key: item
                for key, item in info.items()
                if not key.endswith(("Attachment", "Attachments"))
            },
        )
        area = area_of(info.get("renderArea"))
        if area is not None:
            tree["renderArea"] = dict(zip(("x", "y", "width", "height"), area, strict=True))
        colors = values.items(info.get("pColorAttachments"))[:64]
        tree["colorAttachments"] = [self._attachment(each) for each in colors]
        for name, member in (
            ("pDepthAttachment", "depthAttachment"),
            ("pStencilAttachment", "stencilAttachment"),
        ):
            attachment = self._attachment(info.get(name))
            if attachment is not None:
                tree[member] = attachment
        rates = [values.chained(info, structure) for structure in RATES]
        for rate, (member, kind) in zip(rates, RATES.values(), strict=True):
            tree.pop(member, None)
            attachment = self._attachment(rate, kind)
            if attachment is not None:
                tree[member] = attachment
        # The commands of a secondary command buffer are inlined where it is executed.
        tree["flags"] = [flag for flag in tree.get("flags", []) if not flag.startswith("CONTENTS")]
        parts = self.parts_of(
            values.record(each).get(member)
            for each in (
                info.get("pDepthAttachment"),
                info.get("pStencilAttachment"),
                *colors,
                *rates,
            )
            for member in ("imageView", "resolveImageView")
        )
        self._record_boundary(call, "beginRendering", freeze(tree), parts)

    def _attachment(self, value: object, kind: type[Record] = RenderingAttachment) -> Tree | None:
        """A VkRenderingAttachmentInfo, or another `kind`, with images in place of views; None if it
        has no view.
        """
        info = values.record(value)
        image = self.view(info.get("imageView"))
        if image is None:
            return None
        tree = to_tree(kind, info if kind is RenderingAttachment else {**info, "pNext": None})
        attachment: Tree = {"image": image, **tree}
        resolve = self.view(info.get("resolveImageView"))
        if resolve is not None:
            attachment["resolveImage"] = resolve
        elif attachment.get("resolveMode") == "NONE":
            for member in ("resolveMode", "resolveImageLayout"):
                attachment.pop(member, None)
        return attachment

    def on_CmdExecuteCommands(self, call: Call) -> None:
        buffer = self.buffer(call)
        for item in values.items(call.args.get("pCommandBuffers")):
            secondary = self.buffers.get(values.handle(item))
            if secondary is not None and secondary is not buffer:
                buffer.reads = buffer.reads or secondary.reads
                buffer.omitted = buffer.omitted or secondary.omitted
                if secondary.commands:
                    buffer.executes = True
                    buffer.labels.execute(
                        secondary.labels, pass_is_empty=not buffer.subpass_commands
                    )
                    buffer.record(Execution(secondary.commands, len(secondary.commands)))
        # vkCmdExecuteCommands makes all bound state undefined.
        buffer.pipeline = None
        buffer.graphics.sets.clear()
        buffer.fresh = True

    # State, draws and dispatches.

    def on_CmdBindPipeline(self, call: Call) -> None:
        buffer = self.buffer(call)
        handle = values.handle(call.args.get("pipeline"))
        kind = call.args.get("pipelineBindPoint")
        bindings = self.pipeline_bindings.get(handle)
        point = bind_point(buffer, kind)
        if kind in GRAPHICS:
            buffer.pipeline = self.pipelines.get(handle)
            buffer.fresh = buffer.fresh or bindings != point.bindings
        point.bindings = bindings

    def on_CmdBindShaders(self, call: Call) -> None:
        buffer = self.buffer(call)
        buffer.pipeline = None
        buffer.graphics.bindings = buffer.compute.bindings = None
        buffer.fresh = True

    def on_CmdSetRasterizationSamples(self, call: Call) -> None:
        count = values.samples(call.args.get("rasterizationSamples"))
        if count is not None:
            buffer = self.buffer(call)
            buffer.samples = count
            # Later draws differ from earlier ones in their sample count.
            buffer.many.clear()

    def on_CmdDraw(self, call: Call) -> None:
        counted = COUNTED.get(call.name, "")
        args = call.args
        handle = args.get("commandBuffer")
        buffer = (self.buffers.get(handle) if type(handle) is int else None) or self.buffer(call)
        if not buffer.fresh and buffer.pipeline in buffer.many:
            # The fast path for most draws: an equal draw was recorded before.
            count = args.get(counted)
            if type(count) is int and count > MAX_FULLSCREEN_VERTICES:
                known = buffer.many[buffer.pipeline]
                if known is not None:
                    known.add(count, args.get("instanceCount"))
                return
        counted, counts = _counts(call, counted)
        # The rules ask only for the count of a full-screen triangle or quad.
        few = (
            counts.count is not None
            and counts.count <= MAX_FULLSCREEN_VERTICES
            and counts.instances == 1
        )
        key = (buffer.pipeline, counted, counts.count if few else None, buffer.dynamic_samples)
        if buffer.fresh:
            self._reads(buffer, buffer.graphics, "FRAGMENT", call)
            buffer.fresh = False
        command = self.commands.command("draw", key, call, counts)
        if command.detail is counts:
            buffer.draws.add(command)
        elif command in buffer.draws and command.detail is not None:
            command.detail.add(counts.vertices, 1, counts.draws)
        buffer.record_once(command)
        if counted and not few:
            buffer.many[buffer.pipeline] = command.detail if command in buffer.draws else None

    on_CmdDrawIndexed = on_CmdDrawIndirect = on_CmdDrawIndexedIndirect = (
        on_CmdDrawIndirectByteCount
    ) = on_CmdDraw
    on_CmdDrawIndirectCount = on_CmdDrawIndexedIndirectCount = on_CmdDrawMulti = (
        on_CmdDrawMultiIndexed
    ) = on_CmdDraw
    on_CmdDrawMeshTasks = on_CmdDrawMeshTasksIndirect = on_CmdDrawMeshTasksIndirectCount = (
        on_CmdDraw
    )

    def on_CmdDispatch(self, call: Call) -> None:
        buffer = self.buffer(call)
        self._reads(buffer, buffer.compute, "COMPUTE", call)

    on_CmdDispatchIndirect = on_CmdDispatchBase = on_CmdDispatch

    def on_CmdTraceRays(self, call: Call) -> None:
        buffer = self.buffer(call)
        self._reads(buffer, buffer.ray_tracing, "COMPUTE", call)

    on_CmdTraceRaysIndirect = on_CmdTraceRaysIndirect2 = on_CmdTraceRays

    def _reads(self, buffer: CommandBuffer, point: BindPoint, stage: str, call: Call) -> None:
        # Contents are looked up at submission: a set with UPDATE_AFTER_BIND may be written after it
        # is bound.
        sets = point.reads() if point.sets else ()
        if sets:
            buffer.reads = True
            reads = self.commands.command("reads", DescriptorReads(sets, stage), call)
            # An image may be written again between dispatches, but not within a pass.
            (buffer.record_once if stage == "FRAGMENT" else buffer.record)(reads)

    # Debug labels.

    def on_CmdBeginDebugUtilsLabel(self, call: Call) -> None:
        buffer = self.buffer(call)
        buffer.labels.begin(self.label(call), pass_is_empty=not buffer.subpass_commands)
        self.follow_label(call, "begin")

    def on_CmdEndDebugUtilsLabel(self, call: Call) -> None:
        self.buffer(call).labels.end()
        self.follow_label(call, "end")

    def on_CmdInsertDebugUtilsLabel(self, call: Call) -> None:
        self.buffer(call).labels.insert(self.label(call))
        self.follow_label(call, "insert")

    on_CmdDebugMarkerBegin, on_CmdDebugMarkerEnd = (
        on_CmdBeginDebugUtilsLabel,
        on_CmdEndDebugUtilsLabel,
    )
    on_CmdDebugMarkerInsert = on_CmdInsertDebugUtilsLabel

    def on_QueueBeginDebugUtilsLabel(self, call: Call) -> None:
        text = self.label(call)
        queue = values.handle(call.args.get("queue"))
        if queue in self.queue_labels or len(self.queue_labels) < MAX_QUEUES:
            labels = self.queue_labels.setdefault(queue, [])
            if len(labels) < MAX_QUEUE_LABELS:
                labels.append(text)
        self.follow_label(call, "begin")

    def on_QueueEndDebugUtilsLabel(self, call: Call) -> None:
        labels = self.queue_labels.get(values.handle(call.args.get("queue")))
        if labels:
            labels.pop()
        self.follow_label(call, "end")

    def on_QueueInsertDebugUtilsLabel(self, call: Call) -> None:
        self.follow_label(call, "insert")

    def follow_label(self, call: Call, event: str) -> None:
        """Processes a label that begins, ends, or is inserted as a mark of frames, which FrameMarks
        tracks.
        """

    def label(self, call: Call) -> str:
        """The text of the label that a call begins or inserts."""
        info = values.record(call.args.get("pLabelInfo") or call.args.get("pMarkerInfo"))
        return printable(values.text(info.get("pLabelName") or info.get("pMarkerName")) or "")

    # Submission.

    def on_QueueSubmit(self, call: Call) -> None:
        batches = (
            values.items(values.record(item).get("pCommandBuffers"))
            for item in values.items(call.args.get("pSubmits"))
        )
        self._submit([handle for batch in batches for handle in batch], call)

    def on_QueueSubmit2(self, call: Call) -> None:
        batches = (
            values.items(values.record(item).get("pCommandBufferInfos"))
            for item in values.items(call.args.get("pSubmits"))
        )
        self._submit(
            [values.record(info).get("commandBuffer") for batch in batches for info in batch], call
        )

    def _submit(self, handles: list[object], call: Call) -> None:
        buffers = [
            buffer
            for buffer in (self.buffers.get(values.handle(handle)) for handle in handles)
            if buffer is not None
        ]
        self.frames.start_submission(buffers)
        # A label may end in a later command buffer than it begins.
        outer: Path = tuple(self.queue_labels.get(values.handle(call.args.get("queue")), ()))
        for buffer in buffers:
            self.frames.submit(buffer, call.at, self.commands, self.layouts, outer)
            outer = inner_path(outer, buffer.labels.ended, buffer.labels.open)

    def on_WaitForFences(self, call: Call) -> None:
        if values.integer(call.args.get("timeout")) != 0:
            self.frames.repetitions.waits += 1

    on_WaitSemaphores = on_QueueWaitIdle = on_DeviceWaitIdle = on_WaitForFences


def area_of(value: object) -> tuple[int, int, int, int] | None:
    """A VkRect2D as x, y, width, height, in pixels."""
    rect = values.record(value)
    offset, extent = values.record(rect.get("offset")), values.record(rect.get("extent"))
    components = (
        values.integer(offset.get("x", 0)), values.integer(offset.get("y", 0)),
        values.integer(extent.get("width")), values.integer(extent.get("height")),
    )  # fmt: skip
    x, y, width, height = components
    if x is None or y is None or width is None or height is None or width < 1 or height < 1:
        return None
    return (x, y, width, height) if max(width, height, abs(x), abs(y)) < 1 << 31 else None


def _counts(call: Call, counted: str) -> tuple[str, DrawCounts]:
    """The member with the number of vertices or indices of a draw, empty if it is in a buffer; and
    the counts.
    """
    instances = values.count(call.args.get("instanceCount"))
    if counted:
        return counted, DrawCounts(values.count(call.args.get(counted)), instances)
    member, array = MULTIPLE.get(call.name, ("", ""))
    found = (
        [
            values.count(values.record(draw).get(member))
            for draw in values.items(call.args.get(array))
        ]
        if array
        else []
    )
    numbers = [number for number in found if number is not None]
    if not numbers or len(numbers) < len(found) or instances is None:
        return "", DrawCounts(None, None, max(len(found), 1))
    counts = DrawCounts(numbers[0], instances, len(numbers))
    counts.vertices = sum(numbers) * instances
    if len(numbers) > 1:
        counts.count = max(numbers)
    return member, counts
