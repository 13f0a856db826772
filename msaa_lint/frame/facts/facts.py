"""A subject and what is known of it."""

from __future__ import annotations

from typing import NamedTuple

from msaa_lint.core.text.span import Span

Value = bool | int | float | str | list[str] | list[int]


class Facts:
    """Facts by name, and where each is stated. What is not known is not in here."""

    __slots__ = ("places", "values")

    def __init__(self, *others: Facts) -> None:
        self.values: dict[str, Value] = {}
        self.places: dict[str, Span] = {}
        for other in others:
            self.values.update(other.values)
            self.places.update(other.places)

    def put(self, name: str, value: Value | None, at: Span | None = None) -> None:
        """Adds a fact, unless it is unknown; its place is kept either way, to point at what was to be stated."""
        if value is not None:
            self.values[name] = value
        if at is not None:
            self.places[name] = at


class Subject(NamedTuple):
    """What a rule judges: an image, an attachment, one aspect of it, a pass, a subpass, a resolve, a pipeline, a dependency, a read.

    `of` is what it is made from: a Target, an Attachment, (Attachment, Aspect), a Pass, a PassSubpass, a Resolve, (Pipeline, the
    PassSubpass that it draws in or None), the record of a dependency, (the position of a read's command, the Target) or the Pipeline that
    reads an input attachment.
    """

    kind: str
    path: str
    head: Span
    facts: Facts
    of: object = None


def known(*values: bool | None) -> bool | None:
    """Whether all are true: false as soon as one is, unknown where that hangs on an unknown one."""
    if False in values:
        return False
    return None if None in values else True
