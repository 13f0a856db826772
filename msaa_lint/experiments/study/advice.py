"""What the errors of a scene say in sentences, each with its reason, and whether they justify a
sample count above four.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import NamedTuple

from .measures import ERROR, Measure
from .pareto import as_fast
from .points import MSAA, SAMPLE_SHADING, SSAA, Point, Technique
from .recommendation import Worth
from .shading import Shading
from .steps import MAX_ADDED, MAX_REMAINING, is_enough, percent

MAX_SAME = 0.9
"""A technique that leaves more than this share of the error adds nothing."""

MAX_EFFICIENT = 4

MIN_OFF_CENTER = 1 / 64
"""The bias of coverage from which a pattern counts as off-center. The standard pattern of 16
samples is off by 1/32 of a pixel.
"""


class Advice(NamedTuple):
    """One sentence about a scene, and the reason for it."""

    scene: str
    text: str
    reason: str


def advice(points: Sequence[Point], measure: Measure = ERROR) -> Iterator[Advice]:
    """What the errors of one scene say, whatever the time: `points` are those under one cost of
    shading, and `measure` is the error that counts. `steps` reports the steps from count to
    count.
    """
    compared = [
        _Compared(point, measure.of(point) or 0.0)
        for point in points
        if ERROR.is_finite(point) and measure.is_finite(point)
    ]
    counts = sorted(
        (one for one in compared if one.technique.kind == MSAA), key=lambda one: one.technique
    )
    sentences = (
        *_counts(compared, counts, measure),
        *_shading(compared, counts, measure),
        *_supersampling(compared, counts, measure),
    )
    return (Advice(compared[0].point.scene, text, reason) for text, reason in sentences)


class _Compared(NamedTuple):
    """A point and its error."""

    point: Point
    error: float

    @property
    def technique(self) -> Technique:
        return self.point.technique

    @property
    def name(self) -> str:
        return self.point.technique.name


def _why_no_count(points: Sequence[_Compared], best: _Compared) -> str:
    """Why more samples do not help, judging by which techniques help and which effects ran."""
    if any(one.error < MAX_SAME * best.error for one in points if one.technique.shaded > 1):
        return "the error lies inside triangles, which multisampling shades once per pixel"
    if "tone-mapping" in best.point.effects:
        return "bright samples outweigh all others when light is averaged before tone mapping"
    if "depth-test" in best.point.effects:
        return "more samples do not make depth more precise"
    return "no measured technique helps"


def _counts(
    points: Sequence[_Compared], counts: Sequence[_Compared], measure: Measure
) -> Iterator[tuple[str, str]]:
    """What the counts of samples have in common, and where 16 samples are worse than they could
    be.
    """
    if len(counts) > 1 and counts[0].error == counts[-1].error == 0:
        yield f"{counts[0].name} is exact here", "no detail of this picture lies between samples"
        return
    multisampled = [one for one in counts if one.technique.samples > 1]
    if (
        len(counts) > 2
        and counts[0].error > 0
        and min(one.error for one in multisampled) > MAX_SAME * counts[0].error
    ):
        best = min(multisampled, key=lambda one: (measure.rounded(one.point), one.technique))
        share = _percent(best.error, counts[0].error)
        text = (
            f"no sample count helps here: the best, {best.name}, leaves {share} of "
            f"{counts[0].name}'s {measure.name}"
        )
        yield text, _why_no_count(points, best)
        return
    for before, after in pairwise(counts):
        off_center = abs(after.point.bias) > max(MIN_OFF_CENTER, 1.5 * abs(before.point.bias))
        if after.technique.samples == 16 and off_center and after.error > MAX_SAME * before.error:
            reason = (
                "the mean of its sample locations is off the pixel center, a bias of "
                f"{after.point.bias:+.4f}"
            )
            yield f"{after.name} is no better than {before.name} here", reason


def _against(one: _Compared, other: _Compared, measure: Measure) -> str:
    return (
        f"{'RMSE' if measure == ERROR else measure.name} {one.error:.4f} against {other.error:.4f}"
    )


def _shading(
    points: Sequence[_Compared], counts: Sequence[_Compared], measure: Measure
) -> Iterator[tuple[str, str]]:
    """Sample shading against the same count without it: either the best gain, or that there is
    none.
    """
    plain = {one.technique.samples: one for one in counts}
    shaded = [
        one
        for one in points
        if one.technique.kind == SAMPLE_SHADING and one.technique.samples in plain
    ]
    improved = [one for one in shaded if one.error <= MAX_SAME * plain[one.technique.samples].error]
    if improved and min(one.error for one in shaded) < min(one.error for one in plain.values()):
        best = min(improved, key=lambda one: (one.error, one.technique))
        base, more = plain[best.technique.samples], plain.get(2 * best.technique.samples)
        reason = (
            f"{_against(best, base, measure)}: the error lies inside triangles, which "
            "multisampling shades once per pixel"
        )
        if more is not None:
            reason += f"; {more.name} without it leaves {_percent(more.error, base.error)}"
        share = _percent(best.error, base.error)
        yield (
            f"shading {best.technique.shaded} samples at {base.name} leaves {share} of its "
            f"{measure.name}",
            reason,
        )
    elif shaded:
        yield (
            "sample shading gains nothing here",
            "edges are the same with more shader invocations per pixel",
        )


def _supersampling(
    points: Sequence[_Compared], counts: Sequence[_Compared], measure: Measure
) -> Iterator[tuple[str, str]]:
    """SSAA grids against multisampling with the same number of samples; none has the nine of
    3x3.
    """
    worse: list[tuple[_Compared, _Compared]] = []
    better: list[tuple[_Compared, _Compared]] = []
    for one in points:
        references = [
            count for count in counts if count.technique.samples == one.technique.samples > 1
        ]
        if one.technique.kind != SSAA or not references or references[-1].error == 0:
            continue
        remaining = one.error / references[-1].error
        if remaining > 1 / MAX_SAME:
            worse.append((one, references[-1]))
        elif remaining < MAX_SAME:
            better.append((one, references[-1]))
    for pairs in (worse, better):
        if pairs:
            reason = ", ".join(_against(one, other, measure) for one, other in pairs)
            if pairs is worse and "alpha-to-coverage" in pairs[0][0].point.effects:
                reason += "; with one sample alpha is all or nothing"
            elif pairs is worse and measure == ERROR:
                reason += (
                    "; the samples of a grid share rows and columns, so it distinguishes "
                    "fewer edge positions"
                )
            texts = [
                f"{one.name} {one.error / other.error:.2g} times {other.name}'s"
                for one, other in pairs
            ]
            more = "more" if pairs is worse else "less"
            yield (
                f"SSAA has {more} {measure.name} than MSAA with as many samples: "
                f"{', '.join(texts)}",
                reason,
            )


def error_advice(points: Sequence[Point], measure: Measure) -> Iterator[Advice]:
    """Up to which count of samples steps remove enough of the error of one scene, where no model
    says at which costs that is worth it.
    """
    finite = (point for point in points if ERROR.is_finite(point) and measure.is_finite(point))
    counts = sorted(
        (point for point in finite if point.technique.kind == MSAA),
        key=lambda point: point.technique,
    )
    last = None
    for before, after in pairwise(counts):
        if not is_enough(measure, before, after):
            break
        last = after
    if last is not None:
        removed = f"at least {percent(1 - MAX_REMAINING)[1:]} of the {measure.name}"
        reason = "whether that is worth its time depends on the cost of shading"
        yield Advice(last.scene, f"each step up to {last.technique.name} removes {removed}", reason)


def worth_advice(
    scene: str, found: Sequence[Worth], measure: Measure, shadings: Sequence[Shading]
) -> Advice:
    """At which costs of shading steps up are worth their time, beside the costs that were measured.
    `found` has at least one step.
    """
    steps: dict[str, list[str]] = {}
    for step in found:
        steps.setdefault(_worth_costs(step), []).append(step.after.name)
    clauses: list[str] = []
    for costs, names in steps.items():
        verb = (
            "" if clauses else " is worth its time" if len(names) == 1 else " are worth their time"
        )
        clauses.append(f"{_listed(names)}{verb} {costs}")
    removed, added = percent(1 - MAX_REMAINING)[1:], percent(MAX_ADDED)[1:]
    reason = (
        f"at least {removed} less {measure.name} for at most {added} more time than the count "
        "before"
    )
    calibrated = [
        f"{shading.name} is {shading.full_screen_ms:.3g} ms"
        for shading in shadings
        if shading.full_screen_ms
    ]
    return Advice(
        scene,
        "; ".join(clauses),
        "; ".join([reason, *([", ".join(calibrated)] if calibrated else [])]),
    )


def _listed(names: Sequence[str]) -> str:
    """`2x`, `2x and 4x`, `2x, 4x, and 8x`."""
    return " and ".join(names) if len(names) < 3 else f"{', '.join(names[:-1])}, and {names[-1]}"


def _worth_costs(step: Worth) -> str:
    """At which costs of shading a step is worth its time, with the bounds that the model's
    residuals leave.
    """
    if step.full_screen_ms is None:
        return (
            "at every measured cost of shading"
            if step.at_least
            else "at no measured cost of shading"
        )
    where = (
        f"{'from' if step.at_greatest else 'up to'} about {step.full_screen_ms:.2g} ms of "
        "shading a full screen"
    )
    if step.low_ms is None or step.high_ms is None:
        return f"{where} (within the model's residuals perhaps at every measured cost, or at none)"
    return f"{where} ({step.low_ms:.2g} to {step.high_ms:.2g} ms)"


def _percent(one: float, other: float) -> str:
    share = 100 * one / other
    return f"{share:.0f} %" if share >= 1 else f"{share:.2g} %"


class Ruling(NamedTuple):
    """Whether a count above four is worth its samples, and if not, why."""

    justified: bool
    reason: str = ""


def ruling(
    points: Sequence[Point], samples: int, measure: Measure = ERROR, *, software: bool = False
) -> Ruling:
    """Whether the points of one scene under one cost of shading justify a sample count above four.
    `software` says that their times are a software driver's.
    """
    counts = {
        point.technique.samples: point
        for point in points
        if point.technique.kind == MSAA and measure.is_finite(point)
    }
    point = counts.get(samples)
    base = counts.get(max((count for count in counts if count <= MAX_EFFICIENT), default=0))
    if point is None:
        return Ruling(False, "it was not measured")
    if base is None:
        return Ruling(False, "no count up to four was measured to compare it with")
    if measure.of(base) == 0:
        return Ruling(False, f"{base.technique.name} is exact")
    if not is_enough(measure, base, point):
        return Ruling(
            False,
            f"it leaves more than three quarters of the {measure.name} of {base.technique.name}",
        )
    if all(other.time_ms is None for other in points):
        # More samples always have less error: their cost decides.
        return Ruling(False, "its time was not measured; `--device NAME` measures it")
    if software:
        return Ruling(False, "its time is a software driver's, which says nothing about a GPU")
    if point.time_ms is None:
        return Ruling(False, "the timed device does not support it")
    if point.best:
        return Ruling(True)
    for other in points:
        if (
            other.best
            and measure.rounded(other) <= measure.rounded(point)
            and as_fast(other, point)
        ):
            return Ruling(
                False, f"{other.technique.name} has no more {measure.name} and costs no more"
            )
    return Ruling(False, "another choice is better")
