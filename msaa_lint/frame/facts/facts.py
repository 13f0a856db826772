"""A subject and what is known of it."""

from __future__ import annotations

from typing import NamedTuple

from msaa_lint.core.text.span import Span
from msaa_lint.frame.description.models import Pipeline, SubpassDependency

from .parts import Aspect, Attachment, Pass, PassSubpass, Resolve, Target

Value = bool | int | float | str | list[str] | list[int]


class Facts:
    """Facts by name, and where each is stated. What is not known is not in here."""

    __slots__ = ("places", "values")

    def __init__(self, *others: Facts) -> None:
        # A copy is made faster than an empty dict is filled.
        self.values: dict[str, Value] = others[0].values.copy() if others else {}
        self.places: dict[str, Span] = others[0].places.copy() if others else {}
        for other in others[1:]:
            self.values.update(other.values)
            self.places.update(other.places)

    def put(self, name: str, value: Value | None, at: Span | None = None) -> None:
        """Adds a fact, unless it is unknown; its place is kept either way, to point at what was to
        be stated.
        """
        if value is not None:
            self.values[name] = value
        if at is not None:
            self.places[name] = at


class Subject(NamedTuple):
    """What a rule judges: `kind` is a key of `table.SUBJECTS`.

    The other members are the parts of the frame that the subject stands for: an aspect has its
    `attachment` as well, a pipeline the `subpass` that it draws in, the read of an image the
    `position` of the command, the read of an input attachment the `pipeline`. `owner` is the pass
    that `attachment`, `subpass`, or `resolve` is part of, which without it might be freed.
    """

    kind: str
    path: str
    head: Span
    facts: Facts
    image: Target | None = None
    attachment: Attachment | None = None
    aspect: Aspect | None = None
    render_pass: Pass | None = None
    subpass: PassSubpass | None = None
    resolve: Resolve | None = None
    pipeline: Pipeline | None = None
    dependency: SubpassDependency | None = None
    position: int | None = None
    owner: Pass | None = None

    @property
    def images(self) -> frozenset[str]:
        """The names of the images that the subject concerns: its own, or those of its attachment or
        resolve.
        """
        targets = [self.image, *(self.attachment.targets if self.attachment is not None else ())]
        if self.resolve is not None:
            targets += (self.resolve.source_image, self.resolve.target_image)
            targets += (
                target
                for end in (self.resolve.source, self.resolve.target)
                if end is not None
                for target in end.targets
            )
        return frozenset(
            target.name for target in targets if target is not None and target.image is not None
        )


def known(*values: bool | None) -> bool | None:
    """Whether all are true: false as soon as one is, unknown where that hangs on an unknown one."""
    if False in values:
        return False
    return None if None in values else True
