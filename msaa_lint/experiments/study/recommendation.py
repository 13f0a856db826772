"""Which technique to take: the best that fits a budget; and at which costs of shading steps up are
worth their time.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise
from typing import NamedTuple

from .measures import Measure
from .pareto import fastest, has_time
from .points import MSAA, Point, Technique
from .shading import Shading
from .steps import MAX_ADDED, AddedTime, added_time, is_enough, percent
from .time_model import TimeModel

DEFAULT_BUDGET_MS = 1.0
"""What a technique may add to the time of one sample where no budget is stated: 6 % of a frame at
60 Hz.
"""

BISECTIONS = 60


class Recommendation(NamedTuple):
    """The technique to take on one scene under one cost of shading, what it adds to the time of one
    sample, and why; `following` says what the next better one needs.
    """

    scene: str
    shading: str
    technique: Technique
    added: AddedTime
    reason: str
    following: str = ""

    @property
    def text(self) -> str:
        """`take 4x`"""
        return f"take {self.technique.name}"


def recommendation(
    points: Sequence[Point], measure: Measure, budget_ms: float
) -> Recommendation | None:
    """What to take of the points of one scene under one cost of shading: the least error of
    those whose added time fits with its upper bound. None where one sample, or nothing else, was
    timed.
    """
    timed = [point for point in points if has_time(point) and measure.is_finite(point)]
    one = next((point for point in timed if point.technique == Technique(MSAA, 1)), None)
    if one is None or len(timed) < 2:
        return None
    fitting = [point for point in timed if _added(point, one).high_ms <= budget_ms]
    choice = _front(fitting, measure)[-1]
    reason = f"every other technique adds more than {budget_ms:.4g} ms"
    if len(fitting) > 1:
        reason = (
            f"adds {_bounds(_added(choice, one))} and has the least {measure.name} of the "
            f"{len(fitting)} that fit"
        )
    better = [
        point
        for point in _front(timed, measure)
        if measure.rounded(point) < measure.rounded(choice)
    ]
    following = f"no technique has less {measure.name}"
    if better:
        nearest = min(better, key=lambda point: (_added(point, one).high_ms, point.technique))
        following = (
            f"{nearest.technique.name} has {_less(measure, nearest, choice)} and needs "
            f"{_added(nearest, one).high_ms:.3g} ms"
        )
    return Recommendation(
        one.scene, one.shading, choice.technique, _added(choice, one), reason, following
    )


def _front(points: Sequence[Point], measure: Measure) -> list[Point]:
    best = [
        point for point, optimal in zip(points, fastest(points, measure), strict=True) if optimal
    ]
    return sorted(
        best, key=lambda point: (-measure.rounded(point), point.time_ms or 0.0, point.technique)
    )


def _added(point: Point, one: Point) -> AddedTime:
    added = added_time(point, one)
    assert added is not None
    return AddedTime(0.0, 0.0, 0.0, 0.0, 0.0) if point is one else added


def _less(measure: Measure, one: Point, other: Point) -> str:
    share = 1 - measure.rounded(one) / measure.rounded(other) if measure.rounded(other) else 0.0
    return f"{percent(share)[1:]} less {measure.name}"


def _bounds(added: AddedTime) -> str:
    if not added.ms and added.low_ms == added.high_ms:
        return "nothing"
    low, high = f"{added.low_ms:.3g}", f"{added.high_ms:.3g}"
    return (
        f"{added.ms:.3g} ms ({'' if low == high else f'{low} to {high}, '}{percent(added.share)})"
    )


class Worth(NamedTuple):
    """At which costs of shading a step up is worth its time, of those up to the greatest measured.

    `at_least` and `at_greatest` say whether it is without shading and at the greatest. If it is at
    one of them, `full_screen_ms` is the cost between them where that ends, in milliseconds of a
    full screen at one sample, with the bounds that the model's residuals leave it.
    """

    before: Technique
    after: Technique
    at_least: bool
    at_greatest: bool
    full_screen_ms: float | None
    low_ms: float | None
    high_ms: float | None


def worth(
    points: Sequence[Point], measure: Measure, model: TimeModel, shadings: Sequence[Shading]
) -> Iterator[Worth]:
    """For each step up from a sample count to the next that removes enough of the error, the costs
    at which it is worth its time, by the model of times; `points` are those of one scene under one
    cost.
    """
    counts = sorted(
        (point for point in points if point.technique.kind == MSAA),
        key=lambda point: point.technique,
    )
    greatest = max((shading.nanoseconds or 0.0 for shading in shadings), default=0.0)
    for before, after in pairwise(counts):
        timed = model.predict(before.technique, 0.0) and model.predict(after.technique, 0.0)
        if greatest > 0 and timed and is_enough(measure, before, after):
            excess, *bounds = (
                _excess(model, before.technique, after.technique, bound) for bound in (0, -1, 1)
            )
            scale = after.width * after.height * 1e-12
            cost = _crossing(excess, greatest)
            ends = sorted(
                end for bound in bounds if (end := _crossing(bound, greatest)) is not None
            )
            low, high = (ends[0], ends[1]) if len(ends) == 2 else (None, None)
            figures = (None if figure is None else figure * scale for figure in (cost, low, high))
            yield Worth(
                before.technique, after.technique, excess(0.0) <= 0, excess(greatest) <= 0, *figures
            )


def _excess(
    model: TimeModel, before: Technique, after: Technique, bound: int
) -> Callable[[float], float]:
    """How far the time of a step exceeds what is worth it where a million invocations take so many
    nanoseconds: by the prediction, or by its lower (-1) or upper (1) bound.
    """

    def excess(nanoseconds: float) -> float:
        one, other = model.predict(after, nanoseconds), model.predict(before, nanoseconds)
        assert one is not None and other is not None
        time = one.low_ms if bound < 0 else one.high_ms if bound > 0 else one.time_ms
        return time - (1 + MAX_ADDED) * other.time_ms

    return excess


def _crossing(excess: Callable[[float], float], greatest: float) -> float | None:
    """The argument between 0 and `greatest` at which a monotonic function becomes or stops being
    positive; None if there is none.
    """
    begins = excess(0.0) > 0
    if begins == (excess(greatest) > 0):
        return None
    low, high = 0.0, greatest
    for _ in range(BISECTIONS):
        middle = (low + high) / 2
        low, high = (middle, high) if (excess(middle) > 0) == begins else (low, middle)
    return high
