"""What the errors of a scene say in sentences, each with its reason, and whether they justify a sample count above four."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import NamedTuple

from .measures import ERROR, Measure
from .pareto import as_fast
from .points import MSAA, SAMPLE_SHADING, SSAA, Point
from .recommendation import Worth
from .shading import Shading
from .steps import MAX_ADDED, MAX_REMAINING, is_enough, percent

MAX_SAME = 0.9
"""A technique that leaves more than this share of the error adds nothing."""

MAX_EFFICIENT = 4

MIN_OFF_CENTER = 1 / 64
"""The bias of coverage from which a pattern counts as off-center. The standard pattern of 16 samples is off by 1/32 of a pixel."""


class Advice(NamedTuple):
    """One sentence about a scene, and the reason for it."""

    scene: str
    text: str
    reason: str


def advice(points: Sequence[Point], measure: Measure = ERROR) -> Iterator[Advice]:
    """What the errors of one scene say, whatever the time: `points` are those under one cost of shading. `steps` reports the
    steps from count to count."""
    finite = [point for point in points if ERROR.is_finite(point)]
    counts = sorted((point for point in finite if point.technique.kind == MSAA), key=lambda point: point.technique)
    sentences = (*_counts(finite, counts), *_shading(finite, counts), *_supersampling(finite, counts), *_worth(counts, measure))
    return (Advice(finite[0].scene, text, reason) for text, reason in sentences)


def _why_no_count(points: Sequence[Point], best: Point) -> str:
    """Why more samples do not help, judging by which techniques help and which effects ran."""
    if any(point.rmse < MAX_SAME * best.rmse for point in points if point.technique.shaded > 1):
        return "the error lies inside triangles, which multisampling shades once per pixel"
    if "tone-mapping" in best.effects:
        return "bright samples outweigh all others when light is averaged before tone mapping"
    if "depth-test" in best.effects:
        return "more samples do not make depth more precise"
    return "no measured technique helps"


def _counts(points: Sequence[Point], counts: Sequence[Point]) -> Iterator[tuple[str, str]]:
    """What the counts of samples have in common, and where 16 samples are worse than they could be."""
    if len(counts) > 1 and counts[0].rmse == counts[-1].rmse == 0:
        yield f"{counts[0].technique.name} is exact here", "no detail of this picture lies between samples"
        return
    multisampled = [point for point in counts if point.technique.samples > 1]
    if len(counts) > 2 and counts[0].rmse > 0 and min(point.rmse for point in multisampled) > MAX_SAME * counts[0].rmse:
        best = min(multisampled, key=lambda point: (ERROR.rounded(point), point.technique))
        share = _percent(best.rmse, counts[0].rmse)
        text = f"no sample count helps here: the best, {best.technique.name}, leaves {share} of {counts[0].technique.name}'s error"
        yield text, _why_no_count(points, best)
        return
    for before, after in pairwise(counts):
        off_center = abs(after.bias) > max(MIN_OFF_CENTER, 1.5 * abs(before.bias))
        if after.technique.samples == 16 and off_center and after.rmse > MAX_SAME * before.rmse:
            reason = f"the mean of its sample locations is off the pixel center, a bias of {after.bias:+.4f}"
            yield f"{after.technique.name} is no better than {before.technique.name} here", reason


def _shading(points: Sequence[Point], counts: Sequence[Point]) -> Iterator[tuple[str, str]]:
    """Sample shading against the same count without it: either the best gain, or that there is none."""
    plain = {point.technique.samples: point for point in counts}
    shaded = [point for point in points if point.technique.kind == SAMPLE_SHADING and point.technique.samples in plain]
    improved = [point for point in shaded if point.rmse <= MAX_SAME * plain[point.technique.samples].rmse]
    if improved and min(point.rmse for point in shaded) < min(point.rmse for point in plain.values()):
        best = min(improved, key=lambda point: (point.rmse, point.technique))
        name, base = f"{best.technique.samples}x", plain[best.technique.samples]
        reason = f"RMSE {best.rmse:.4f} against {base.rmse:.4f}: the error lies inside triangles, which multisampling shades once per pixel"
        more = plain.get(2 * best.technique.samples)
        if more is not None:
            reason += f"; {more.technique.name} without it leaves {_percent(more.rmse, base.rmse)}"
        yield f"shading {best.technique.shaded} samples at {name} leaves {_percent(best.rmse, base.rmse)} of its error", reason
    elif shaded:
        yield "sample shading gains nothing here", "edges are the same with more shader invocations per pixel"


def _supersampling(points: Sequence[Point], counts: Sequence[Point]) -> Iterator[tuple[str, str]]:
    """SSAA grids against multisampling with the same number of samples; 3x3 is compared with 8."""
    worse: list[tuple[Point, Point]] = []
    better: list[tuple[Point, Point]] = []
    for point in points:
        samples = point.technique.samples
        references = [count for count in counts if max(1, samples / 2) < count.technique.samples <= samples]
        if point.technique.kind != SSAA or not references or references[-1].rmse == 0:
            continue
        remaining = point.rmse / references[-1].rmse
        if remaining > 1 / MAX_SAME:
            worse.append((point, references[-1]))
        elif remaining < MAX_SAME:
            better.append((point, references[-1]))
    for pairs in (worse, better):
        if pairs:
            reason = ", ".join(f"RMSE {one.rmse:.4f} against {other.rmse:.4f}" for one, other in pairs)
            if pairs is worse and "alpha-to-coverage" in pairs[0][0].effects:
                reason += "; with one sample alpha is all or nothing"
            elif pairs is worse:
                reason += "; the samples of a grid share rows and columns, so it distinguishes fewer edge positions"
            texts = [f"{one.technique.name} {one.rmse / other.rmse:.2g} times {other.technique.name}'s" for one, other in pairs]
            yield f"SSAA has {'more' if pairs is worse else 'less'} error than MSAA with as many samples: {', '.join(texts)}", reason


def _worth(counts: Sequence[Point], measure: Measure) -> Iterator[tuple[str, str]]:
    """Up to which count steps remove enough of the error."""
    last = None
    for before, after in pairwise(counts):
        if not is_enough(measure, before, after):
            break
        last = after
    if last is not None:
        removed = f"at least {percent(1 - MAX_REMAINING)[1:]} of the {measure.name}"
        yield f"each step up to {last.technique.name} removes {removed}", "whether that is worth its time depends on the cost of shading"


def worth_advice(scene: str, found: Worth, shadings: Sequence[Shading]) -> Advice:
    """At which costs of shading a step up is worth its time, beside the costs that were measured."""
    name, other, limit = found.after.name, found.before.name, percent(MAX_ADDED)[1:]
    cost = f"{found.full_screen_ms:.2g} ms" if found.full_screen_ms is not None else ""
    reason = f"there it adds at most {limit} to the time of {other}"
    if found.at_least and found.at_greatest:
        text = f"{name} is worth its time at every measured cost of shading"
        reason = f"it adds at most {limit} to the time of {other}"
    elif found.at_greatest:
        text = f"{name} is worth its time where shading a full screen takes about {cost} or more"
    elif found.at_least:
        text = f"{name} is worth its time where shading a full screen takes at most about {cost}"
    else:
        text = f"{name} is not worth its time at any measured cost of shading"
        reason = f"it always adds more than {limit} to the time of {other}"
    if cost and found.low_ms is not None:
        reason += f"; the model's residuals put that cost between {found.low_ms:.2g} and {found.high_ms:.2g} ms"
    elif cost:
        reason += "; within the model's residuals it may be at every measured cost or at none"
    calibrated = [shading for shading in shadings if shading.full_screen_ms]
    costs = ", ".join(f"{shading.name} is {shading.full_screen_ms:.3g} ms" for shading in calibrated)
    return Advice(scene, text, f"{reason}; {costs}" if costs else reason)


def _percent(one: float, other: float) -> str:
    share = 100 * one / other
    return f"{share:.0f} %" if share >= 1 else f"{share:.2g} %"


class Ruling(NamedTuple):
    """Whether a count above four is worth its samples, and if not, why."""

    justified: bool
    reason: str = ""


def ruling(points: Sequence[Point], samples: int, measure: Measure = ERROR, *, software: bool = False) -> Ruling:
    """Whether the points of one scene under one cost of shading justify a sample count above four. `software` says that their times are a
    software driver's."""
    counts = {point.technique.samples: point for point in points if point.technique.kind == MSAA and measure.is_finite(point)}
    point = counts.get(samples)
    base = counts.get(max((count for count in counts if count <= MAX_EFFICIENT), default=0))
    if point is None:
        return Ruling(False, "it was not measured")
    if base is None:
        return Ruling(False, "no count up to four was measured to compare it with")
    if measure.of(base) == 0:
        return Ruling(False, f"{base.technique.name} is exact")
    if not is_enough(measure, base, point):
        return Ruling(False, f"it leaves more than three quarters of the {measure.name} of {base.technique.name}")
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
        if other.best and measure.rounded(other) <= measure.rounded(point) and as_fast(other, point):
            return Ruling(False, f"{other.technique.name} has no more {measure.name} and costs no more")
    return Ruling(False, "another choice is better")
