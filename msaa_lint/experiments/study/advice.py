"""Conclusions from the points of a study, in sentences: each with its reason and the numbers that support it."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import NamedTuple

from .pareto import beats, vectors
from .points import MSAA, SAMPLE_SHADING, SSAA, Point

MAX_REMAINING = 0.9
"""A step that leaves more than this share of the error adds nothing."""

MAX_REMAINING_ABOVE_FOUR = 0.75
"""The largest share of the error of the largest count up to four that a larger count may leave to be worth its samples. Theory gives 0.59
for 8 against 4 at edges of all slopes (the error falls as N^-0.75, Mitchell 1996); this requires somewhat more than half of that gain."""

MAX_EFFICIENT = 4

MIN_OFF_CENTER = 1 / 64
"""The bias of coverage from which a pattern counts as off-center. The standard pattern of 16 samples is off by 1/32 of a pixel."""


class Advice(NamedTuple):
    """One sentence about a scene, and the reason for it."""

    scene: str
    text: str
    reason: str


def advice(points: Sequence[Point]) -> list[Advice]:
    """The advice that the points give, scene by scene in the order of their first points."""
    advice_list: list[Advice] = []
    for scene in dict.fromkeys(point.scene for point in points):
        scene_points = [point for point in points if point.scene == scene and math.isfinite(point.rmse)]
        advice_list += (Advice(scene, text, reason) for text, reason in _of_scene(scene_points))
    return advice_list


def _of_scene(points: Sequence[Point]) -> Iterator[tuple[str, str]]:
    counts = sorted((point for point in points if point.technique.kind == MSAA), key=lambda point: point.technique.samples)
    yield from _steps(points, counts)
    yield from _shading(points, counts)
    yield from _supersampling(points, counts)
    yield from _choice(points)


def _why_no_count(points: Sequence[Point], best: Point) -> str:
    """Why more samples do not help, judging by which techniques help and which effects ran."""
    if any(point.rmse < MAX_REMAINING * best.rmse for point in points if point.technique.shaded > 1):
        return "the error lies inside triangles, which multisampling shades once per pixel"
    if "tone-mapping" in best.effects:
        return "bright samples outweigh all others when light is averaged before tone mapping"
    if "depth-test" in best.effects:
        return "more samples do not make depth more precise"
    return "no measured technique helps"


def _steps(points: Sequence[Point], counts: Sequence[Point]) -> Iterator[tuple[str, str]]:
    """From each count of samples to the next."""
    if len(counts) > 1 and counts[0].rmse == counts[-1].rmse == 0:
        yield f"{counts[0].technique.name} is exact here", "no detail of this picture lies between samples"
        return
    multisampled = [point for point in counts if point.technique.samples > 1]
    if len(counts) > 2 and counts[0].rmse > 0 and min(point.rmse for point in multisampled) > MAX_REMAINING * counts[0].rmse:
        best = min(multisampled, key=lambda point: (float(f"{point.rmse:.3g}"), point.technique))
        yield (
            f"no sample count helps here: the best, {best.technique.name}, leaves {_percent(best.rmse, counts[0].rmse)} of "
            f"{counts[0].technique.name}'s error{_times(best, counts[0])}",
            _why_no_count(points, best),
        )
        return
    halved = False
    for before, after in pairwise(counts):
        if before.rmse == 0:
            yield f"{after.technique.name} cannot improve on {before.technique.name}", f"{before.technique.name} is exact here"
            continue
        remaining = after.rmse / before.rmse
        reason = f"RMSE {after.rmse:.4f} against {before.rmse:.4f}"
        one, other = after.technique.name, before.technique.name
        if remaining > 1 / MAX_REMAINING:
            text = f"{one} is worse than {other}: {remaining:.2g} times its error"
        elif remaining > MAX_REMAINING:
            text = f"{one} is no better than {other} here"
        elif 0.45 <= remaining <= 0.55:
            text = f"{one} halves {other}'s error{' again' if halved else ''}"
        else:
            text = f"{one} leaves {_percent(after.rmse, before.rmse)} of {other}'s error"
        halved = 0.45 <= remaining <= 0.55
        if remaining > MAX_REMAINING and after.technique.samples == 16 and abs(after.bias) > max(MIN_OFF_CENTER, 1.5 * abs(before.bias)):
            reason += f"; the mean of its sample locations is off the pixel center, a bias of {after.bias:+.4f}"
        yield text + _times(after, before), reason


def _shading(points: Sequence[Point], counts: Sequence[Point]) -> Iterator[tuple[str, str]]:
    """Sample shading against the same count without it: either the best gain, or that there is none, stated for the largest count (with a
    time, if any has one) with the most invocations."""
    plain = {point.technique.samples: point for point in counts}
    shaded = [point for point in points if point.technique.kind == SAMPLE_SHADING and point.technique.samples in plain]
    improved = [point for point in shaded if point.rmse <= MAX_REMAINING * plain[point.technique.samples].rmse]
    if improved and min(point.rmse for point in shaded) < min(point.rmse for point in plain.values()):
        best = min(improved, key=lambda point: (point.rmse, point.technique))
        reference = plain[best.technique.samples]
        reason = (
            f"RMSE {best.rmse:.4f} against {reference.rmse:.4f}, with {best.technique.shaded} shader invocations per pixel instead of 1"
        )
        share = _percent(best.rmse, reference.rmse)
        yield (
            f"shading {best.technique.shaded} samples at {reference.technique.name} leaves {share} of its error{_times(best, reference)}",
            reason,
        )
    elif shaded:
        largest = max(shaded, key=lambda point: (point.time_ms is not None, point.technique.samples, point.technique.shaded))
        name, reference = f"{largest.technique.samples}x", plain[largest.technique.samples]
        yield (
            f"sample shading gains nothing here: at {name} its error is that of {name}{_times(largest, reference)}",
            f"an edge is the same with {largest.technique.shaded} shader invocations per pixel instead of 1",
        )


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
        if remaining > 1 / MAX_REMAINING:
            worse.append((point, references[-1]))
        elif remaining < MAX_REMAINING:
            better.append((point, references[-1]))
    for pairs in (worse, better):
        if pairs:
            reason = ", ".join(f"RMSE {one.rmse:.4f} against {other.rmse:.4f}" for one, other in pairs)
            if pairs is worse and "alpha-to-coverage" in pairs[0][0].effects:
                reason += "; with one sample alpha is all or nothing"
            elif pairs is worse:
                reason += "; the samples of a grid share rows and columns, so it distinguishes fewer edge positions"
            texts = [
                f"{one.technique.name} {one.rmse / other.rmse:.2g} times {other.technique.name}'s{_times(one, other)}"
                for one, other in pairs
            ]
            yield f"SSAA has {'more' if pairs is worse else 'less'} error than MSAA with as many samples: {', '.join(texts)}", reason


def _choice(points: Sequence[Point]) -> Iterator[tuple[str, str]]:
    """The Pareto-optimal point with the best ratio of accuracy to time."""
    timed = [point for point in points if point.best and point.time_ms]
    if len(timed) < 2:
        return
    choice = min(timed, key=lambda point: (point.rmse * (point.time_ms or 0.0), point.technique))
    names = "; ".join(point.technique.name for point in sorted(timed, key=lambda point: (point.time_ms or 0.0, point.technique)))
    text = f"{choice.technique.name} gives the most accuracy for its time"
    if choice.technique.samples == 1:
        text = "more than one sample is not worth its time here"
    yield (
        text,
        f"the product of its error and its time, {choice.rmse:.4f} times {choice.time_ms:.3g} ms, is the smallest; Pareto-optimal: {names}",
    )


def _times(one: Point, other: Point) -> str:
    """How much longer one point takes than another, if both times are known."""
    if one.time_ms is None or not other.time_ms:
        return ""
    ratio = one.time_ms / other.time_ms
    return " for the same time" if 0.95 <= ratio <= 1.05 else f" for {ratio:.2g} times the time"


def _percent(one: float, other: float) -> str:
    share = 100 * one / other
    return f"{share:.0f} %" if share >= 1 else f"{share:.2g} %"


class Ruling(NamedTuple):
    """Whether a count above four is worth its samples, and if not, why."""

    justified: bool
    reason: str = ""


def ruling(points: Sequence[Point], samples: int) -> Ruling:
    """Whether the points of one scene justify a sample count above four."""
    counts = {point.technique.samples: point for point in points if point.technique.kind == MSAA and math.isfinite(point.rmse)}
    point = counts.get(samples)
    base = counts.get(max((count for count in counts if count <= MAX_EFFICIENT), default=0))
    if point is None:
        return Ruling(False, "it was not measured")
    if base is None:
        return Ruling(False, "no count up to four was measured to compare it with")
    if base.rmse == 0:
        return Ruling(False, f"{base.technique.name} is exact")
    if point.rmse > MAX_REMAINING_ABOVE_FOUR * base.rmse:
        return Ruling(False, f"it leaves more than three quarters of the error of {base.technique.name}")
    if all(other.time_ms is None for other in points):
        # More samples always have less error: their cost decides.
        return Ruling(False, "its time was not measured; `--device NAME` measures it")
    if point.best:
        return Ruling(True)
    if point.time_ms is None:
        return Ruling(False, "the timed device does not support it")
    others = vectors(points)
    vector = others[points.index(point)]
    for other, other_vector in zip(points, others, strict=True):
        if other.best and other_vector is not None and vector is not None and beats(other_vector, vector):
            return Ruling(False, f"{other.technique.name} has no more error and costs no more")
    return Ruling(False, "another choice is better")
