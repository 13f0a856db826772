"""Call frames, and the passes and pipelines that code encodes or creates."""

from __future__ import annotations

from typing import NamedTuple

from msaa_lint.core.text.span import Span

from .values import Field, MetalObject, Value


class CallFrame:
    """A call frame: its variables, the enclosing frame of a closure, `self`, the call depth, and the call path."""

    __slots__ = ("depth", "enclosing", "function", "locals", "path", "rank", "returned", "self_value", "type_name")

    def __init__(
        self, type_name: str, function: str, rank: int, path: int, enclosing: CallFrame | None = None, self_value: Value | None = None
    ) -> None:
        self.type_name = type_name
        self.function = function
        self.rank = rank
        self.path = path
        self.enclosing = enclosing
        self.self_value = self_value
        self.depth = 0
        self.locals: dict[str, Value] = {}
        self.returned: list[Value] = []

    @property
    def function_name(self) -> str:
        """The name of the function, which qualifies the names in it."""
        return f"{self.type_name}.{self.function}".lstrip(".")

    def find(self, name: str) -> tuple[CallFrame, Value] | None:
        """Returns a variable and the frame that holds it, or None."""
        frame: CallFrame | None = self
        while frame is not None:
            value = frame.locals.get(name)
            if value is not None:
                return frame, value
            frame = frame.enclosing
        return None


class Encoded(NamedTuple):
    """A step of a frame: a pass, copy, read, or presented drawable, and the function that encodes it.

    `sure` is set if it is unconditional.
    """

    kind: str
    what: tuple[object, ...]
    at: Span
    by: int
    sure: bool


class Pass:
    """A render pass when it was encoded: its descriptor and attachments."""

    __slots__ = ("at", "attachments", "complete", "descriptor")

    def __init__(self, descriptor: MetalObject, at: Span, attachments: dict[str, dict[str, Field]], complete: bool) -> None:
        self.descriptor = descriptor
        self.at = at
        self.attachments = attachments
        self.complete = complete


class Pipeline:
    """A pipeline when it was created: its descriptor, name, and state."""

    __slots__ = ("at", "colors", "descriptor", "fields", "name", "passes", "type_name")

    def __init__(
        self, descriptor: MetalObject, at: Span, fields: dict[str, Field], colors: dict[str, dict[str, Field]], type_name: str
    ) -> None:
        self.descriptor = descriptor
        self.at = at
        self.fields = fields
        self.colors = colors
        self.name = descriptor.name
        self.type_name = type_name
        self.passes: list[Pass] = []
