"""What a reader of captures gives: calls in the order of the file, and where each stands."""

# No `from __future__ import annotations`: a NamedTuple then compiles the text of every annotation, which takes four times as long.
from typing import Any, NamedTuple


class Place(NamedTuple):
    """Where a call stands: line and column of its first character (1-based; None in binary inputs), and its index.

    The index is the one that the tool itself gave the call, as gfxreconstruct does; else its number in the file, from 0.
    """

    line: int | None = None
    column: int | None = None
    call: int | None = None


class Call(NamedTuple):
    """One call of the API. `args` are by C's parameter names; `result` is the VkResult where the capture states it.

    Structures are mappings with C's member names, arrays lists, null pointers None, handles integers (0 is null); a pNext chain is nested
    mappings with `sType`. Enumerants, flags and numbers are as the capture spells them: `values` reads them.
    """

    name: str
    args: dict[str, Any]
    at: Place
    result: str | None = None


class Mark(NamedTuple):
    """What a capture says that is no call: `frame`, where the tool itself marks a frame's end; `trimmed`, that calls before it are not
    in the file; `frameless`, that the file is one frame by itself."""

    kind: str
    at: Place


class Broken(Exception):
    """The input ends in the middle, or makes no sense from a place on: what is wrong in words, and where."""

    def __init__(self, message: str, place: Place) -> None:
        super().__init__(message)
        self.message = message
        self.place = place
