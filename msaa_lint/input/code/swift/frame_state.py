"""A run of a function, and what is seen of a frame: passes that are encoded, pipelines that are made, in their order."""

from __future__ import annotations

from typing import NamedTuple

from msaa_lint.core.text.span import Span

from .values import Field, MetalObject, Value


class CallFrame:
    """A run of a function: its variables, those of what it is written in, whose `self` it has, how deep in calls, by which way."""

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
        """The function that it runs, as names in it are told from others."""
        return f"{self.type_name}.{self.function}".lstrip(".")

    def find(self, name: str) -> tuple[CallFrame, Value] | None:
        """The variable of that name, and the run that has it."""
        frame: CallFrame | None = self
        while frame is not None:
            value = frame.locals.get(name)
            if value is not None:
                return frame, value
            frame = frame.enclosing
        return None


class Encoded(NamedTuple):
    """What was seen of a frame: a pass, a copy, a read or a drawable shown, by which function; `sure` where no condition decides it."""

    kind: str
    what: tuple[object, ...]
    at: Span
    by: int
    sure: bool


class Pass:
    """A render pass as it is encoded: its descriptor, and what its attachments were given."""

    __slots__ = ("at", "attachments", "complete", "descriptor")

    def __init__(self, descriptor: MetalObject, at: Span, attachments: dict[str, dict[str, Field]], complete: bool) -> None:
        self.descriptor = descriptor
        self.at = at
        self.attachments = attachments
        self.complete = complete


class Pipeline:
    """A pipeline as it is made: its descriptor, its name, what it was given."""

    __slots__ = ("at", "colors", "descriptor", "fields", "name", "passes", "type_name")

    def __init__(self, descriptor: MetalObject, at: Span, fields: dict[str, Field], colors: dict[str, dict[str, Field]]) -> None:
        self.descriptor = descriptor
        self.at = at
        self.fields = fields
        self.colors = colors
        self.name = descriptor.name
        self.type_name = ""
        self.passes: list[Pass] = []
