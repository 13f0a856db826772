"""Submits command buffers, waits for them, and measures the time."""

from __future__ import annotations

import time
from typing import Any

from .opening import OpenDevice

BOTTOM, TOP = 0x2000, 0x1
"""VkPipelineStageFlagBits."""

FOREVER = 0xFFFFFFFFFFFFFFFF


class Submitter:
    """One command buffer, which is submitted once or several times. Submitting waits for it."""

    def __init__(self, opened: OpenDevice, timed: bool = False) -> None:
        self.opened = opened
        self.vk = vk = opened.vk
        # A pool of its own, which is reset whenever the buffer is recorded.
        self.pool = vk.vkCreateCommandPool(
            opened.handle, vk.VkCommandPoolCreateInfo(queueFamilyIndex=opened.device.family), None
        )
        allocate = vk.VkCommandBufferAllocateInfo(
            commandPool=self.pool, level=0, commandBufferCount=1
        )
        self.buffer = vk.vkAllocateCommandBuffers(opened.handle, allocate)[0]
        self.fence = vk.vkCreateFence(opened.handle, vk.VkFenceCreateInfo(), None)
        self.queries: Any = None
        if timed and opened.device.timestamp_bits:
            self.queries = vk.vkCreateQueryPool(
                opened.handle, vk.VkQueryPoolCreateInfo(queryType=2, queryCount=2), None
            )
        self.source = "timestamp" if self.queries is not None else "wall"
        self.mask = (1 << opened.device.timestamp_bits) - 1
        self.period: float = opened.session.device["properties"]["limits"]["timestampPeriod"]

    def begin(self, once: bool = True) -> Any:
        """The command buffer, empty, to record into; `once` says that it is submitted only once."""
        self.vk.vkResetCommandPool(self.opened.handle, self.pool, 0)
        self.vk.vkBeginCommandBuffer(self.buffer, self.vk.VkCommandBufferBeginInfo(flags=int(once)))
        if self.queries is not None:
            self.vk.vkCmdResetQueryPool(self.buffer, self.queries, 0, 2)
        return self.buffer

    def start(self) -> None:
        """Records the start timestamp."""
        if self.queries is not None:
            self.vk.vkCmdWriteTimestamp(self.buffer, BOTTOM, self.queries, 0)

    def stop(self) -> None:
        """Records the end timestamp."""
        if self.queries is not None:
            self.vk.vkCmdWriteTimestamp(self.buffer, BOTTOM, self.queries, 1)

    def end(self, timed: bool = False) -> float:
        """Ends recording, and submits."""
        self.finish()
        return self.submit(timed)

    def finish(self) -> None:
        """Ends recording."""
        self.vk.vkEndCommandBuffer(self.buffer)

    def submit(self, timed: bool = False) -> float:
        """Submits what was recorded, and waits. Returns the milliseconds between `start` and
        `stop`, or those of submitting and waiting if the device has no timestamps.
        """
        vk, opened = self.vk, self.opened
        before = time.perf_counter()
        vk.vkQueueSubmit(
            opened.queue, 1, [vk.VkSubmitInfo(pCommandBuffers=[self.buffer])], self.fence
        )
        vk.vkWaitForFences(opened.handle, 1, [self.fence], 1, FOREVER)
        passed = (time.perf_counter() - before) * 1000
        vk.vkResetFences(opened.handle, 1, [self.fence])
        if not timed or self.queries is None:
            return passed
        read = vk.ffi.new("uint64_t[2]")
        # VK_QUERY_RESULT_64_BIT and VK_QUERY_RESULT_WAIT_BIT.
        vk.vkGetQueryPoolResults(opened.handle, self.queries, 0, 2, 16, read, 8, 3)
        passed = float((read[1] - read[0]) & self.mask)
        return passed * self.period / 1e6

    def close(self) -> None:
        """Destroys its objects."""
        vk, handle = self.vk, self.opened.handle
        vk.vkDestroyFence(handle, self.fence, None)
        if self.queries is not None:
            vk.vkDestroyQueryPool(handle, self.queries, None)
        # Frees the command buffer too.
        vk.vkDestroyCommandPool(handle, self.pool, None)
