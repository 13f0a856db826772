"""A run of a function, and what is seen of a frame: passes that are encoded, pipelines that are made, in their order."""

from __future__ import annotations

from typing import NamedTuple

from msaa_lint.core.text.span import Span

from .values import Field, Object, Value


class Frame:
    """A run of a function: its variables, those of what it is written in, whose `self` it has, how deep in calls, by which way."""

    __slots__ = ("around", "depth", "function", "locals", "me", "rank", "returned", "way", "within")

    def __init__(self, within: str, function: str, rank: int, way: int, around: Frame | None = None, me: Value | None = None) -> None:
        self.within = within
        self.function = function
        self.rank = rank
        self.way = way
        self.around = around
        self.me = me
        self.depth = 0
        self.locals: dict[str, Value] = {}
        self.returned: list[Value] = []

    @property
    def whose(self) -> str:
        """The function that it runs, as names in it are told from others."""
        return f"{self.within}.{self.function}".lstrip(".")

    def find(self, name: str) -> tuple[Frame, Value] | None:
        """The variable of that name, and the run that has it."""
        frame: Frame | None = self
        while frame is not None:
            value = frame.locals.get(name)
            if value is not None:
                return frame, value
            frame = frame.around
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

    def __init__(self, descriptor: Object, at: Span, attachments: dict[str, dict[str, Field]], complete: bool) -> None:
        self.descriptor = descriptor
        self.at = at
        self.attachments = attachments
        self.complete = complete


class Pipeline:
    """A pipeline as it is made: its descriptor, its name, what it was given."""

    __slots__ = ("at", "colors", "descriptor", "fields", "name", "passes", "within")

    def __init__(self, descriptor: Object, at: Span, fields: dict[str, Field], colors: dict[str, dict[str, Field]]) -> None:
        self.descriptor = descriptor
        self.at = at
        self.fields = fields
        self.colors = colors
        self.name = descriptor.name
        self.within = ""
        self.passes: list[Pass] = []
