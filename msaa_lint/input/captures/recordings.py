"""Command buffers that are recorded again with the same calls: frames usually resemble earlier
ones.

What such a command buffer contains is only determined once, as long as no object is created or
destroyed. Readers share the arguments of identical calls, so calls are compared by the identity of
these.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

from . import values
from .call import Call, Mark
from .command_buffers import CommandBuffer

MAX_TEXT = 8 << 20
"""Maximum length of the text of all calls that are kept, in bytes."""

CALL_WEIGHT = 256
"""A call, or a command that it records, counts as so many bytes at least."""

MAX_ALTERNATIVES = 16
"""Maximum number of recordings that begin with the same call: those for each swapchain image, for
example.
"""

UPDATES = (
    "vkUpdateDescriptorSets",
    "vkUpdateDescriptorSetWithTemplate",
    "vkUpdateDescriptorSetWithTemplateKHR",
)
"""Calls that command buffers do not depend on until they are submitted."""

UNCHANGING = (
    "vkCmd", "vkQueue", "vkWait", "vkUpdateDescriptorSet", "vkBeginCommandBuffer",
    "vkEndCommandBuffer", "vkDeviceWaitIdle", "xrEndFrame",
)  # fmt: skip
"""The beginnings of the names of calls after which commands still refer to the same objects."""

END = object()
NOTHING: tuple[Any, ...] = (END,)
"""Stand for the arguments of vkEndCommandBuffer; no call has them."""

State = tuple[int, int]
"""Grows when objects are created or destroyed."""


class Recording(NamedTuple):
    """The calls from vkBeginCommandBuffer to the one before vkEndCommandBuffer, their arguments and
    then END, and a copy of what they recorded.
    """

    calls: list[Call]
    args: list[Any]
    buffer: CommandBuffer
    state: State
    size: int


class Recordings:
    """The recordings of a capture, and the one that the current calls repeat, or are.

    While the arguments of each call are those that are `expected` at a `position`, it need not be
    processed: the caller only increments the position. Any other call is passed to `follow`, if a
    recording `is_active` or the call begins one.
    """

    def __init__(
        self, process: Callable[[Call | Mark], None], buffers: dict[int, CommandBuffer | None]
    ) -> None:
        self._process = process
        self._buffers = buffers
        self._by_begin: dict[int, list[Recording]] = {}
        """By the identity of the arguments of vkBeginCommandBuffer, the most recent first."""
        self._latest: dict[int, CommandBuffer] = {}
        """By the identity of a recording's calls: the last copy of its command buffer. What is
        known of its submission holds for all.
        """
        self._size = 0
        self.is_active = False
        self.expected: Sequence[Any] = NOTHING
        self.position = 0
        self._followed: Recording | None = None
        """The recording that the current calls repeat so far."""
        self._calls: list[Call] = []
        self._calls_size = 0
        """The calls of the current recording if it repeats none, and their size."""

    def follow(self, call: Call | Mark, state: State) -> None:
        """Processes a call, unless it belongs to a recording that is repeated."""
        if isinstance(call, Mark) or call.name in UPDATES:
            self._process(call)
            return
        is_end = call.name == "vkEndCommandBuffer" and not call.failed
        if self._followed is not None:
            if is_end and not self._is_same_buffer(call, self._followed.calls[0]):
                is_end = False
            if self._find(END if is_end else call.args):
                if is_end:
                    self._restore()
                else:
                    self.position += 1
                return
            self._stop_following()
        if call.name == "vkBeginCommandBuffer" and not call.failed:
            if self._begin(call, state):
                return
        elif self.is_active:
            if is_end and self._is_same_buffer(call, self._calls[0]):
                self._keep(state)
            else:
                self._add(call)
        self._process(call)

    def _begin(self, call: Call, state: State) -> bool:
        """Starts a recording; whether it may repeat an earlier one."""
        self.is_active = call.recurring > 0
        recordings = self._by_begin.get(id(call.args), []) if self.is_active else []
        if recordings and recordings[0].state != state:
            self._forget(id(call.args))
        elif recordings:
            self._followed = recordings[0]
            self.expected, self.position = recordings[0].args, 1
            return True
        self._calls, self._calls_size = [call], _size_of(call)
        return False

    def _add(self, call: Call) -> None:
        """Adds a call to the current recording, which is given up if it cannot recur as a whole."""
        self._calls_size += _size_of(call)
        # What a secondary command buffer records may change in between.
        is_command = call.name.startswith("vkCmd") and not call.name.startswith("vkCmdExecute")
        if (
            call.recurring
            and is_command
            and self._calls_size <= MAX_TEXT // 4
            and self._is_same_buffer(call, self._calls[0])
        ):
            self._calls.append(call)
        else:
            self.is_active, self._calls = False, []

    def _keep(self, state: State) -> None:
        """Keeps the current recording, which ends."""
        calls = self._calls
        self.is_active, self._calls = False, []
        buffer = self._buffers.get(values.handle(calls[0].args.get("commandBuffer")))
        if buffer is None:
            return
        size = self._calls_size + CALL_WEIGHT * len(buffer.commands)
        begin = id(calls[0].args)
        recordings = self._by_begin.get(begin, [])
        if len(recordings) >= MAX_ALTERNATIVES or (recordings and recordings[0].state != state):
            self._forget(begin)
        if self._size + size > MAX_TEXT:
            self._by_begin.clear()
            self._latest.clear()
            self._size = 0
        if size <= MAX_TEXT:
            self._size += size
            recording = Recording(
                calls, [*(call.args for call in calls), END], buffer.copy(), state, size
            )
            self._by_begin.setdefault(begin, []).insert(0, recording)
            self._latest[id(calls)] = buffer

    def _find(self, args: object) -> bool:
        """Follows another recording that has the same calls so far and then a call with some
        arguments; False if there is none.
        """
        assert self._followed is not None
        followed, position = self._followed.args, self.position
        before = list(map(id, followed[:position]))
        for recording in self._by_begin[id(followed[0])]:
            others = recording.args
            if (
                position < len(others)
                and others[position] is args
                and list(map(id, others[:position])) == before
            ):
                self._followed, self.expected = recording, others
                return True
        return False

    def _stop_following(self) -> None:
        """Processes the calls that were skipped."""
        assert self._followed is not None
        self._calls = self._followed.calls[: self.position]
        self._calls_size = sum(map(_size_of, self._calls))
        self._followed, self.expected, self.position = None, NOTHING, 0
        for call in self._calls:
            self._process(call)

    def _restore(self) -> None:
        """Sets the command buffer to what the recording that was repeated contains."""
        assert self._followed is not None
        calls, _, buffer, _, _ = self._followed
        self._followed, self.expected, self.position, self.is_active = None, NOTHING, 0, False
        latest = self._latest[id(calls)]
        if latest.submission is not None and latest.submitted_length == len(buffer.commands):
            buffer.submission, buffer.submitted_length = latest.submission, latest.submitted_length
        restored = self._latest[id(calls)] = buffer.copy()
        self._buffers[values.handle(calls[0].args.get("commandBuffer"))] = restored

    def _forget(self, begin: int) -> None:
        """Forgets the recordings that begin with a call."""
        for recording in self._by_begin.pop(begin):
            self._size -= recording.size
            del self._latest[id(recording.calls)]

    @staticmethod
    def _is_same_buffer(call: Call, other: Call) -> bool:
        buffer: object = call.args.get("commandBuffer")
        return buffer == other.args.get("commandBuffer")


def _size_of(call: Call) -> int:
    return max(call.recurring, CALL_WEIGHT)
