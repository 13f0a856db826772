"""What a whole run of `msaa-lint study` gives, for reporters."""

# No `from __future__ import annotations`: a NamedTuple then compiles the text of every annotation, which takes four times as long.
from collections.abc import Sequence
from typing import NamedTuple

from msaa_lint.core.finding import Finding

from .advice import Advice
from .points import Point
from .tasks import Failed


class Pictured(NamedTuple):
    """A scene that was studied: what it shows, in a sentence; the effects that it calls for, each with the reason; whether its error is of
    coverage, in [0, 1], or of linear colour."""

    name: str
    says: str
    effects: tuple[tuple[str, str], ...]
    coverage: bool = True


class Untimed(NamedTuple):
    """A technique that the device did not draw, and why."""

    name: str
    reason: str


class Study(NamedTuple):
    """All of it.

    `device` is where times are from, empty where there are none; `model` the device whose traffic the cost model reckons, empty where it
    is none in particular. `points` are in the order of the scenes and techniques, the front marked. `wrong` are findings that say why an
    input could not be used, `records` and `pictures` the files that were written.
    """

    device: str
    model: str
    size: tuple[int, int]
    bits: int
    scenes: Sequence[Pictured]
    points: Sequence[Point]
    failed: Sequence[Failed]
    untimed: Sequence[Untimed]
    advice: Sequence[Advice]
    wrong: Sequence[Finding] = ()
    records: Sequence[str] = ()
    pictures: Sequence[str] = ()

    def of(self, scene: str) -> list[Point]:
        """The points of one scene."""
        return [point for point in self.points if point.scene == scene]
