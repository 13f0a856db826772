"""Steps up from one technique to the next: what each adds in time, and takes from the error."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import NamedTuple

from msaa_lint.experiments.confirm.timing import timing

from .measures import DISPLAY, ERROR, FLICKER, FLIP, MEASURES, Measure
from .pareto import has_time, interval, tie
from .points import MSAA, SAMPLE_SHADING, Point, Technique
from .scenes.about import ALPHA, TEXTURE

MAX_REMAINING = 0.75
"""The largest share of the error that a step up may leave to be worth its time. Theory gives 0.59
for twice the samples at edges of all slopes (the error falls as N^-0.75, Mitchell 1996); this
requires somewhat more than half of that gain.
"""

MAX_ADDED = 0.10
"""The largest share of the time that a step up may add to be worth it where no budget is stated: a
convention, not a measurement. Of all the time of a 60 Hz frame it is 1.7 ms; whether more is worth
it depends on what else the frame needs, which a budget states.
"""


class AddedTime(NamedTuple):
    """The difference of two times in milliseconds, its bounds with 95 % confidence, and it as a
    share of the time that it is added to.

    Techniques are timed in turn, so it is the median of the differences in each round. Without
    rounds, it is that of the times; as their errors are then independent, their half-widths add up
    as squares (MOVER, Zou and Donner 2008).
    """

    ms: float
    low_ms: float
    high_ms: float
    share: float
    low_share: float


class Step(NamedTuple):
    """A step up from one technique to another on one scene under one cost of shading, whose name is
    empty where times do not count.

    `added` is what it adds in time, None where a time is not known; with `same_time` that is within
    the noise. `changes` are the relative changes of the errors, by the keys of their measures: -0.5
    where the error halves. `worth` says whether it removes enough of the error for its time; None
    where that is not known.
    """

    scene: str
    shading: str
    before: Technique
    after: Technique
    added: AddedTime | None
    same_time: bool
    changes: dict[str, float]
    worth: bool | None

    @property
    def text(self) -> str:
        """`2x to 4x: +0.31 ms (+9 %), error -42 %, flicker -55 %`."""
        parts = [added_text(self.added, self.same_time)] if self.added is not None else []
        parts += [
            change_text(measure, self.changes[measure.key])
            for measure in MEASURES
            if measure.key in self.changes
        ]
        return f"{self.before.name} to {self.after.name}: {', '.join(parts) or 'no error before'}"


def steps(
    points: Sequence[Point], about: Sequence[str], measure: Measure, *, timed: bool
) -> Iterator[Step]:
    """The steps of one scene under one cost of shading: from each sample count to the next, and
    where the error may lie inside triangles, from each count to shading every sample of it.
    """
    known = [point for point in points if has_time(point)] if timed else []
    # Where a device lacks a count, the step is to the next that it has.
    counts = sorted(
        (point for point in known or points if point.technique.kind == MSAA),
        key=lambda point: point.technique,
    )
    pairs = list(pairwise(counts))
    if not {ALPHA, TEXTURE}.isdisjoint(about):
        shaded = {
            point.technique.samples: point
            for point in points
            if point.technique == _all_shaded(point.technique)
        }
        pairs += [
            (count, shaded[count.technique.samples])
            for count in counts
            if count.technique.samples in shaded
        ]
    for before, after in pairs:
        yield _step(before, after, measure, timed)


def _all_shaded(technique: Technique) -> Technique:
    return Technique(SAMPLE_SHADING, technique.samples, 1.0)


def _step(before: Point, after: Point, measure: Measure, timed: bool) -> Step:
    shown = (ERROR, FLIP, FLICKER) if measure != DISPLAY else (ERROR, DISPLAY, FLICKER)
    changes = {
        each.key: change for each in shown if (change := _change(each, before, after)) is not None
    }
    difference = added_time(after, before) if timed else None
    worth = (
        None
        if difference is None
        else is_enough(measure, before, after) and difference.low_share <= MAX_ADDED
    )
    return Step(
        before.scene,
        before.shading if timed else "",
        before.technique,
        after.technique,
        difference,
        tie(before, after),
        changes,
        worth,
    )


def _change(measure: Measure, before: Point, after: Point) -> float | None:
    one, other = measure.of(before), measure.of(after)
    if not one or other is None or not (math.isfinite(one) and math.isfinite(other)):
        return None
    return other / one - 1


def is_enough(measure: Measure, before: Point, after: Point) -> bool:
    """Whether a step removes enough of the error."""
    change = _change(measure, before, after)
    return change is not None and 1 + change <= MAX_REMAINING * (1 + 1e-12)


def added_time(one: Point, other: Point) -> AddedTime | None:
    """What a technique adds to the time of another; None where a time is not known."""
    if one.time_ms is None or other.time_ms is None or not (has_time(one) and has_time(other)):
        return None
    if one.rounds and len(one.rounds) == len(other.rounds):
        found = timing([time - base for time, base in zip(one.rounds, other.rounds, strict=True)])
        return AddedTime(
            found.median,
            found.low,
            found.high,
            found.median / other.time_ms,
            found.low / other.time_ms,
        )
    (one_low, one_high), (other_low, other_high) = interval(one), interval(other)
    added = one.time_ms - other.time_ms
    low = added - math.hypot(one.time_ms - one_low, other_high - other.time_ms)
    high = added + math.hypot(one_high - one.time_ms, other.time_ms - other_low)
    return AddedTime(added, low, high, added / other.time_ms, low / other.time_ms)


def added_text(added: AddedTime, same_time: bool) -> str:
    """`+0.31 ms (+9 %)`, or that it is the same time."""
    return (
        "same time, within noise" if same_time else f"{added.ms:+.3g} ms ({percent(added.share)})"
    )


def change_text(measure: Measure, change: float) -> str:
    """`error -42 %`, or that it is unchanged."""
    return (
        f"{measure.name} {percent(change)}"
        if percent(change).strip("+-") != "0 %"
        else f"{measure.name} unchanged"
    )


def percent(share: float) -> str:
    """`+9 %`, `-42 %`; -99.7 % is not rounded to -100 %."""
    figure = 100 * share
    return f"{figure:+.1f} %" if 99.5 <= abs(figure) < 100 else f"{figure:+.0f} %"
