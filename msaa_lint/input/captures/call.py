"""What capture readers produce: calls in file order, each with its place."""

import re
from typing import Any, NamedTuple

_SUFFIX = re.compile(r"(?:KHR|EXT|NV|AMD|QCOM|ARM|LUNARG)\Z")


class Place(NamedTuple):
    """The place of a call: the line and column of its first character (1-based; None in binary
    inputs) and its index.

    The index is the tool's own if it numbers calls, as gfxreconstruct does; otherwise the call's
    position in the file, from 0.
    """

    line: int | None = None
    column: int | None = None
    call: int | None = None


class Call(NamedTuple):
    """A Vulkan call. `args` is keyed by C parameter name; `result` is the VkResult if the capture
    has it.

    `recurring` is the length of its text if an identical call came before it, with which it shares
    its `args`; otherwise 0.

    Structures are mappings with C's member names, arrays are lists, null pointers are None, and
    handles are integers (0 is null); a pNext chain is nested mappings with `sType`. Enumerants,
    flags and numbers keep the capture's spelling; `values` parses them.
    """

    name: str
    args: dict[str, Any]
    at: Place
    result: str | None = None
    recurring: int = 0

    @property
    def failed(self) -> bool:
        """Whether it returned an error."""
        return self.result is not None and self.result.startswith(("VK_ERROR", "XR_ERROR"))


class Mark(NamedTuple):
    """An event of a capture that is not a call. `frame`: a frame ends; `trimmed`: earlier calls are
    missing; `frameless`: the file is a single frame; `truncated`: the last entry is incomplete.
    """

    kind: str
    at: Place


class CaptureError(Exception):
    """The input is truncated or invalid from a place on. `message` says why."""

    def __init__(self, message: str, place: Place) -> None:
        super().__init__(message)
        self.message = message
        self.place = place


def without_vendor(name: str) -> str:
    """A call's name without its vendor suffix."""
    return _SUFFIX.sub("", name)


def is_wanted(wanted: frozenset[str], name: str) -> bool:
    """Whether `wanted` contains a call, with or without its vendor suffix."""
    return name in wanted or without_vendor(name) in wanted
