"""What the points of a study come to, in sentences: each with its reason, and the numbers that it rests on."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import NamedTuple

from .pareto import beats, vectors
from .points import MSAA, SAMPLE_SHADING, SSAA, Point

NOTHING = 0.9
"""Share of an error that has to be left, at most, for a step to be one: what takes less than a tenth off adds nothing."""

ABOVE_FOUR = 0.75
"""Share of the error of the largest count of at most four that a larger one may leave to be worth its samples. Theory gives 0.59 for 8
against 4 at edges of all slopes (the error falls as N^-0.75, Mitchell 1996); somewhat more than half of that gain is asked for."""

EFFICIENT = 4

OFF_CENTRE = 1 / 64
"""Bias, of coverage, from which a pattern is said to be off the pixel's centre. The standard one of 16 samples is by 1/32 of a pixel."""


class Advice(NamedTuple):
    """One sentence on a scene, and the reason for it."""

    scene: str
    says: str
    because: str


def advice(points: Sequence[Point]) -> list[Advice]:
    """What is to be said of the points, scene by scene, in the order in which the scenes first come."""
    found: list[Advice] = []
    for scene in dict.fromkeys(point.scene for point in points):
        own = [point for point in points if point.scene == scene and math.isfinite(point.rmse)]
        found += (Advice(scene, says, because) for says, because in _of_scene(own))
    return found


def _of_scene(points: Sequence[Point]) -> Iterator[tuple[str, str]]:
    counts = sorted((point for point in points if point.technique.kind == MSAA), key=lambda point: point.technique.samples)
    yield from _steps(points, counts)
    yield from _shading(points, counts)
    yield from _supersampling(points, counts)
    yield from _choice(points)


def _why_no_count(points: Sequence[Point], best: Point) -> str:
    """Why samples do not help, as far as what helps, and what ran, tell."""
    if any(point.rmse < NOTHING * best.rmse for point in points if point.technique.shaded > 1):
        return "what is wrong lies inside of triangles, which multisampling shades once a pixel"
    if "tone-mapping" in best.effects:
        return "bright samples outweigh all others where light is averaged before it is mapped to the display"
    if "depth-test" in best.effects:
        return "samples do not make depth more precise"
    return "nothing that was measured helps"


def _steps(points: Sequence[Point], counts: Sequence[Point]) -> Iterator[tuple[str, str]]:
    """From each count of samples to the next."""
    if len(counts) > 1 and counts[0].rmse == counts[-1].rmse == 0:
        yield f"{counts[0].technique.name} is exact here", "nothing in this picture lies between samples"
        return
    multisampled = [point for point in counts if point.technique.samples > 1]
    if len(counts) > 2 and counts[0].rmse > 0 and min(point.rmse for point in multisampled) > NOTHING * counts[0].rmse:
        best = min(multisampled, key=lambda point: (float(f"{point.rmse:.3g}"), point.technique))
        yield (
            f"no count of samples helps here: the best, {best.technique.name}, leaves {_percent(best.rmse, counts[0].rmse)} of "
            f"{counts[0].technique.name}'s error{_times(best, counts[0])}",
            _why_no_count(points, best),
        )
        return
    halved = False
    for before, after in pairwise(counts):
        if before.rmse == 0:
            yield f"{after.technique.name} has nothing to add to {before.technique.name}", f"{before.technique.name} is exact here"
            continue
        left = after.rmse / before.rmse
        reason = f"RMSE {after.rmse:.4f} against {before.rmse:.4f}"
        one, other = after.technique.name, before.technique.name
        if left > 1 / NOTHING:
            says = f"{one} is worse than {other}: {left:.2g} times its error"
        elif left > NOTHING:
            says = f"{one} adds nothing to {other} here"
        elif 0.45 <= left <= 0.55:
            says = f"{one} halves {other}'s error{' again' if halved else ''}"
        else:
            says = f"{one} leaves {_percent(after.rmse, before.rmse)} of {other}'s error"
        halved = 0.45 <= left <= 0.55
        if left > NOTHING and after.technique.samples == 16 and abs(after.bias) > max(OFF_CENTRE, 1.5 * abs(before.bias)):
            reason += f"; its samples' mean lies off the pixel's centre, a bias of {after.bias:+.4f}"
        yield says + _times(after, before), reason


def _shading(points: Sequence[Point], counts: Sequence[Point]) -> Iterator[tuple[str, str]]:
    """Sample shading against the same count without it: where it gains most; or that it gains nothing, said of the largest count (that has
    a time, where any has one) with the most invocations."""
    plain = {point.technique.samples: point for point in counts}
    shaded = [point for point in points if point.technique.kind == SAMPLE_SHADING and point.technique.samples in plain]
    gaining = [point for point in shaded if point.rmse <= NOTHING * plain[point.technique.samples].rmse]
    if gaining and min(point.rmse for point in shaded) < min(point.rmse for point in plain.values()):
        best = min(gaining, key=lambda point: (point.rmse, point.technique))
        than = plain[best.technique.samples]
        reason = f"RMSE {best.rmse:.4f} against {than.rmse:.4f}, by {best.technique.shaded} shader invocations a pixel in place of 1"
        left = _percent(best.rmse, than.rmse)
        yield f"shading {best.technique.shaded} samples at {than.technique.name} leaves {left} of its error{_times(best, than)}", reason
    elif shaded:
        most = max(shaded, key=lambda point: (point.time_ms is not None, point.technique.samples, point.technique.shaded))
        name, than = f"{most.technique.samples}x", plain[most.technique.samples]
        yield (
            f"sample shading gains nothing here: at {name} its error is {name}'s{_times(most, than)}",
            f"an edge is the same for {most.technique.shaded} shader invocations a pixel in place of 1",
        )


def _supersampling(points: Sequence[Point], counts: Sequence[Point]) -> Iterator[tuple[str, str]]:
    """SSAA grids against the multisampling of as many samples; of 3x3, which there is none for, against 8."""
    worse: list[tuple[Point, Point]] = []
    better: list[tuple[Point, Point]] = []
    for point in (each for each in points if each.technique.kind == SSAA):
        most = point.technique.samples
        fewer = [each for each in counts if max(1, most / 2) < each.technique.samples <= most]
        if fewer and fewer[-1].rmse > 0:
            left = point.rmse / fewer[-1].rmse
            (worse if left > 1 / NOTHING else better if left < NOTHING else []).append((point, fewer[-1]))
    for pairs in (worse, better):
        if pairs:
            reason = ", ".join(f"RMSE {one.rmse:.4f} against {other.rmse:.4f}" for one, other in pairs)
            if pairs is worse and "alpha-to-coverage" in pairs[0][0].effects:
                reason += "; the alpha of a single sample is all or nothing"
            elif pairs is worse:
                reason += "; a grid's samples share rows and columns, so that it tells fewer positions of an edge apart"
            texts = [
                f"{one.technique.name} {one.rmse / other.rmse:.2g} times {other.technique.name}'s{_times(one, other)}"
                for one, other in pairs
            ]
            yield f"SSAA has {'more' if pairs is worse else 'less'} error than as many samples: {', '.join(texts)}", reason


def _choice(points: Sequence[Point]) -> Iterator[tuple[str, str]]:
    """Of the front, what gives the most for its time."""
    timed = [point for point in points if point.best and point.time_ms]
    if len(timed) < 2:
        return
    pick = min(timed, key=lambda point: (point.rmse * (point.time_ms or 0.0), point.technique))
    names = "; ".join(point.technique.name for point in sorted(timed, key=lambda point: (point.time_ms or 0.0, point.technique)))
    says = f"for its time {pick.technique.name} gives the most"
    if pick.technique.samples == 1:
        says = "no samples beyond one pay for their time here"
    yield (
        says,
        f"{pick.technique.name}'s error times its time, {pick.rmse:.4f} times {pick.time_ms:.3g} ms, is the least; nothing beats {names}",
    )


def _times(one: Point, other: Point) -> str:
    """How much longer one point takes than another, where both are known."""
    if one.time_ms is None or not other.time_ms:
        return ""
    ratio = one.time_ms / other.time_ms
    return " for the same time" if 0.95 <= ratio <= 1.05 else f" for {ratio:.2g} times the time"


def _percent(one: float, other: float) -> str:
    share = 100 * one / other
    return f"{share:.0f} %" if share >= 1 else f"{share:.2g} %"


class Ruling(NamedTuple):
    """Whether a count above four is worth its samples; `reason` says why not."""

    justified: bool
    reason: str = ""


def ruling(points: Sequence[Point], samples: int) -> Ruling:
    """What the points of one scene say of a sample count above four."""
    counts = {point.technique.samples: point for point in points if point.technique.kind == MSAA and math.isfinite(point.rmse)}
    own = counts.get(samples)
    base = counts.get(max((count for count in counts if count <= EFFICIENT), default=0))
    if own is None:
        return Ruling(False, "it was not measured")
    if base is None:
        return Ruling(False, "no count of at most four was measured beside it")
    if base.rmse == 0:
        return Ruling(False, f"{base.technique.name} is exact")
    if own.rmse > ABOVE_FOUR * base.rmse:
        return Ruling(False, f"more than three quarters of {base.technique.name}'s error is left")
    if all(point.time_ms is None for point in points):
        # More samples always have less error: what they cost decides.
        return Ruling(False, "its time was not measured, which `--device NAME` does")
    if own.best:
        return Ruling(True)
    if own.time_ms is None and any(point.time_ms is not None for point in points):
        return Ruling(False, "the device that was timed does not offer it")
    known = [vector for vector in zip(points, vectors(points), strict=True) if vector[1] is not None and vector[0].best]
    mine = vectors(points)[points.index(own)]
    better = next((point.technique.name for point, vector in known if vector is not None and mine is not None and beats(vector, mine)), "")
    return Ruling(False, f"{better} has no more error and costs no more" if better else "another choice beats it")
