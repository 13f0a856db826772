"""One thing that happens to an image, and all that happens to one aspect of it, round the loop of the frame.

Where framebuffers alternate, as many frames are laid out as it takes for all of them to come round.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import lcm
from typing import NamedTuple

from msaa_lint.core.text.span import Span
from msaa_lint.frame.description.models import Command, ImageBarrier

from .frame import Attachment, Pass, Resolve
from .pass_begin import MAX_USES

LOADED = "loaded"
BEGUN = "begun"
"""Overwritten as a pass begins: cleared, or of no matter."""
READ = "read"
CLEARED = "cleared"
"""By a command."""
COPIED = "copied"
"""Written by a copy, a blit or a resolve command."""
WRITTEN = "written"
STORED = "stored"
RESOLVED = "resolved"
"""Written by a resolve at the end of a rendering."""
DISCARDED = "discarded"
UNKNOWN = "unknown"
ELSEWHERE = "elsewhere"
"""A rendering goes on in, or comes from, commands that are not described."""

MAX_FRAMES = 12
"""How many frames are laid out for framebuffers that alternate: what two, three or four together take."""

Turns = tuple[int, frozenset[int]]
"""Of how many frames, and in which of them."""


class Moment(NamedTuple):
    """One thing that happens to an image.

    `aspect` is None where it may be all; `whole` where it is certain to be of all texels and layers; `of` what does it: an attachment of
    the pass `by`, with the `member` that states it; a command, or a barrier in it; a resolve; `turns` the frames in which it happens
    (None: in every one).
    """

    kind: str
    aspect: str | None
    whole: bool
    of: Attachment | Resolve | Command | ImageBarrier
    by: Pass | None = None
    member: str = ""
    turns: Turns | None = None

    @property
    def at(self) -> Span:
        """Where it is stated."""
        if isinstance(self.of, Resolve):
            return self.of.target_at
        if isinstance(self.of, Attachment):
            return self.of.record.place(self.member)
        return self.of.place("oldLayout") if isinstance(self.of, ImageBarrier) else self.of.head

    @property
    def name(self) -> str:
        """The pass, or the command."""
        if self.by is not None:
            return self.by.name
        return self.of.kind if isinstance(self.of, Command) else "pipelineBarrier"


class Line:
    """The moments of one aspect of an image in their order, and to which of the frames laid out each belongs."""

    __slots__ = ("_decisive", "_of", "_written", "frames", "kinds", "moments")

    def __init__(self, moments: list[Moment]) -> None:
        periods = [moment.turns[0] for moment in moments if moment.turns is not None]
        self.moments = moments
        self.frames = [0] * len(moments)
        if periods:
            self._lay_out(lcm(*periods))
        self.kinds = {moment.kind for moment in self.moments}
        self._of: dict[tuple[int, str], list[int]] = {}
        for index, moment in enumerate(self.moments):
            self._of.setdefault((id(moment.of), moment.kind), []).append(index)
        self._decisive: list[int | None] | None = None
        self._written: list[int | None] | None = None

    def _lay_out(self, count: int) -> None:
        stated, self.moments, self.frames = self.moments, [], []
        for frame in range(count if count <= MAX_FRAMES and count * len(stated) <= MAX_USES else 0):
            for moment in stated:
                if moment.turns is None or frame % moment.turns[0] in moment.turns[1]:
                    self.moments.append(moment)
                    self.frames.append(frame)

    def of(self, attachment: Attachment, kind: str) -> Sequence[int]:
        """The moments of a kind that an attachment has."""
        return self._of.get((id(attachment), kind), ())

    def before(self, index: int) -> int:
        """The moment before one, round the loop."""
        return (index - 1) % len(self.moments)

    def within_frame(self, first: int, second: int) -> bool:
        """Whether the second of two moments follows the first before the frame ends."""
        return first < second and self.frames[first] == self.frames[second]

    def decisive(self, index: int) -> int | None:
        """The next moment, round the loop, that ends the life of what was there, reads it, or may do either."""
        if self._decisive is None:
            self._decisive = self._nearest([*reversed(range(len(self.moments)))], _decides)
        return self._decisive[index]

    def written(self, index: int) -> int | None:
        """The last moment before, round the loop, that is no read."""
        if self._written is None:
            self._written = self._nearest([*range(len(self.moments))], lambda moment: moment.kind not in (READ, LOADED))
        return self._written[index]

    def _nearest(self, order: list[int], wanted: Callable[[Moment], bool]) -> list[int | None]:
        """For each moment the wanted one that comes nearest before it in an order that goes round; itself, where there is no other."""
        found: list[int | None] = [None] * len(order)
        nearest: int | None = None
        for index in order * 2:
            found[index] = nearest
            if wanted(self.moments[index]):
                nearest = index
        return found


def _decides(moment: Moment) -> bool:
    if moment.kind in (LOADED, READ, UNKNOWN, ELSEWHERE):
        return True
    # After a barrier from UNDEFINED the next use tells: a load that finds nothing was to find what was stored.
    return moment.whole and moment.kind not in (STORED, WRITTEN) and (moment.kind != DISCARDED or moment.by is not None)
