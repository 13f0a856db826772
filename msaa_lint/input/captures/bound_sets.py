"""Tracks command buffers, and the descriptor sets that are bound and pushed in them."""

from __future__ import annotations

from typing import Any

from . import set_layouts, values
from .call import Call
from .command_buffers import ANY_SET, BindPoint, CommandBuffer
from .descriptors import Descriptors
from .objects import DescriptorSet

GRAPHICS = ("VK_PIPELINE_BIND_POINT_GRAPHICS", 0, "0")
RAY_TRACING = (
    "VK_PIPELINE_BIND_POINT_RAY_TRACING_KHR",
    "VK_PIPELINE_BIND_POINT_RAY_TRACING_NV",
    1000165000,
    "1000165000",
)

MAX_BOUND = 64
"""Maximum number of descriptor sets that are bound at a time; devices allow 32."""

MAX_PUSHED = 256
"""Maximum number of images that are pushed at a time; devices allow a few dozen descriptors."""

INFOS = ("pBindDescriptorSetsInfo", "pPushDescriptorSetInfo", "pPushDescriptorSetWithTemplateInfo")
"""The parameters that hold those of the calls of Vulkan 1.4, which name stages instead of a bind
point.
"""


class BoundSets(Descriptors):
    """Tracks the command buffers of a capture."""

    def __init__(self) -> None:
        super().__init__()
        self.buffers: dict[int, CommandBuffer | None] = {}
        """None until a command buffer is used."""
        self.pools: dict[int, set[int]] = {}

    def buffer(self, call: Call) -> CommandBuffer:
        """The command buffer of a command. It may be new, because a trimmed capture may lack its
        allocation.
        """
        handle = call.args.get("commandBuffer")
        if type(handle) is not int:
            handle = values.handle(handle)
        buffer = self.buffers.get(handle)
        if buffer is None:
            buffer = self.buffers[handle] = CommandBuffer()
        return buffer

    # Command buffers.

    def on_AllocateCommandBuffers(self, call: Call) -> None:
        info = values.record(call.args.get("pAllocateInfo"))
        pool = self.pools.setdefault(values.handle(info.get("commandPool")), set())
        for item in values.items(call.args.get("pCommandBuffers")):
            handle = values.handle(item)
            if self.has_room(self.buffers, call):
                self.buffers[handle] = None
                pool.add(handle)

    def on_DestroyCommandPool(self, call: Call) -> None:
        for handle in self.pools.pop(values.handle(call.args.get("commandPool")), ()):
            self.buffers.pop(handle, None)

    def on_FreeCommandBuffers(self, call: Call) -> None:
        pool = self.pools.get(values.handle(call.args.get("commandPool")), set())
        for handle in map(values.handle, values.items(call.args.get("pCommandBuffers"))):
            self.buffers.pop(handle, None)
            pool.discard(handle)

    def on_BeginCommandBuffer(self, call: Call) -> None:
        self.buffers[values.handle(call.args.get("commandBuffer"))] = CommandBuffer()

    def on_EndCommandBuffer(self, call: Call) -> None:
        """Ends a recording, which the tracker may recognize when it is repeated."""

    def on_CmdBindDescriptorSets(self, call: Call) -> None:
        buffer = self.buffer(call)
        for args, point in _points(buffer, call):
            slot = values.integer(args.get("firstSet")) or 0
            for item in values.items(args.get("pDescriptorSets"))[
                : max(MAX_BOUND - slot, 0) if slot >= 0 else 0
            ]:
                descriptors = self.set(item)
                if descriptors is not point.sets.get(slot):
                    # Rebinding the same set with other offsets does not change its images.
                    buffer.fresh = True
                    if descriptors is not None:
                        point.sets[slot] = descriptors
                    else:
                        del point.sets[slot]
                slot += 1

    on_CmdBindDescriptorSets2 = on_CmdBindDescriptorSets

    def on_CmdPushDescriptorSet(self, call: Call) -> None:
        buffer = self.buffer(call)
        for args, point in _points(buffer, call):
            pushed = self._pushed(point, args)
            if pushed is not None:
                for item in values.items(args.get("pDescriptorWrites")):
                    self.write(pushed, values.record(item))
            self._push(buffer, point, args, pushed)

    on_CmdPushDescriptorSet2 = on_CmdPushDescriptorSet

    def on_CmdPushDescriptorSetWithTemplate(self, call: Call) -> None:
        buffer = self.buffer(call)
        for args, _ in _points(buffer, call):
            template = self.templates.get(values.handle(args.get("descriptorUpdateTemplate")))
            for point in (
                (bind_point(buffer, template.point),)
                if template is not None
                else (buffer.graphics, buffer.compute)
            ):
                pushed = self._pushed(point, args)
                if pushed is not None:
                    self.write_template(pushed, args)
                self._push(buffer, point, args, pushed)

    on_CmdPushDescriptorSetWithTemplate2 = on_CmdPushDescriptorSetWithTemplate

    @staticmethod
    def _pushed(point: BindPoint, args: dict[str, Any]) -> DescriptorSet | None:
        """A copy of the set that descriptors are pushed to; None if its number is invalid."""
        number = values.integer(args.get("set")) or 0
        if not 0 <= number < MAX_BOUND:
            return None
        pushed = DescriptorSet()
        before = point.sets.get(number)
        if before is not None:
            for slot, use in before.images.items():
                pushed.put(slot, *use)
            pushed.opaque = before.opaque
            pushed.unknown.update(before.unknown)
            if len(pushed.unknown) > MAX_PUSHED:
                pushed.opaque = True
        return pushed

    @staticmethod
    def _push(
        buffer: CommandBuffer, point: BindPoint, args: dict[str, Any], pushed: DescriptorSet | None
    ) -> None:
        if pushed is not None:
            for slot in list(pushed.images)[:-MAX_PUSHED]:
                pushed.remove(slot)
            point.sets[values.integer(args.get("set")) or 0] = pushed
            buffer.fresh = True

    def on_CmdBindDescriptorBuffers(self, call: Call) -> None:
        """Binds descriptors whose contents the capture omits: they may hold any image."""
        buffer = self.buffer(call)
        unknown = DescriptorSet()
        unknown.opaque = True
        for point in (buffer.graphics, buffer.compute, buffer.ray_tracing):
            point.sets[ANY_SET] = unknown
        buffer.fresh = True

    on_CmdBindResourceHeap = on_CmdBindDescriptorBuffers


def bind_point(buffer: CommandBuffer, point: object) -> BindPoint:
    """What is bound at a VkPipelineBindPoint."""
    return (
        buffer.graphics
        if point in GRAPHICS
        else buffer.ray_tracing
        if point in RAY_TRACING
        else buffer.compute
    )


def _points(buffer: CommandBuffer, call: Call) -> list[tuple[dict[str, Any], BindPoint]]:
    """The parameters of a call that binds descriptors, and what it binds them for: a bind point, or
    those of some stages.
    """
    args = call.args
    point = args.get("pipelineBindPoint")
    info = (
        next((args[name] for name in INFOS if isinstance(args.get(name), dict)), None)
        if point is None
        else None
    )
    if info is None:
        return [(args, bind_point(buffer, point))]
    stages = values.bits("VkShaderStageFlagBits", info.get("stageFlags"))
    points = (
        (buffer.graphics, set_layouts.GRAPHICS),
        (buffer.compute, set_layouts.COMPUTE),
        (buffer.ray_tracing, set_layouts.RAY_TRACING),
    )
    return [(info, point) for point, mask in points if stages is None or stages & mask]
