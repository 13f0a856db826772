"""Generates the table of docs/study-numbers.md: hard cases, the exact answer, and the results of naive float32, float64 and the study.

`python docs/study_numbers.py` writes it; `--check` only tests whether it is up to date. Exact answers use rational arithmetic (fractions).
"""

from __future__ import annotations

import math
import random
import sys
from collections.abc import Callable, Iterator
from fractions import Fraction
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from msaa_lint.experiments.study import coverage
from msaa_lint.experiments.study.effects import store_half
from msaa_lint.experiments.study.measure import total
from msaa_lint.experiments.study.resolve import DEPTH_MODES, average, resolve_depth, to_srgb, to_unorm, tone_map, weighted

PAGE = Path(__file__).parent / "study-numbers.md"
CENTER = np.array([[128, 128]])
"""One sample at the center of the pixel, in 1/256 pixel."""


class Row(NamedTuple):
    """A case: the results of naive arithmetic (float32 unless the case says otherwise), float64 and the study; `within` is the relative
    tolerance."""

    group: str
    case: str
    exact: float
    naive: float
    double: float
    ours: float
    within: float = 0.0

    def right(self, value: float) -> bool:
        """Whether a value is correct."""
        if not math.isfinite(self.exact):
            return value == self.exact or (math.isnan(self.exact) and math.isnan(value))
        return abs(value - self.exact) <= self.within * abs(self.exact)


Triangles = NDArray[np.int64]


def near_ties(length: int, count: int, seed: int) -> tuple[Triangles, NDArray[np.bool_]]:
    """Triangles with an edge of about `length` pixels whose edge function is 1 or -1 at the sample, the smallest nonzero values, and
    whether they cover it. Bezout's identity finds them; random triangles hardly ever qualify."""
    made, inside = [], []
    draws = random.Random(seed)
    size = length * 256
    while len(made) < count:
        dx, dy = draws.randint(size // 2, size), draws.randint(size // 2, size)
        if math.gcd(dx, dy) != 1:
            continue
        side = draws.choice((-1, 1))
        # u * dy - v * dx = side, with u within the edge.
        u = side * pow(dy, -1, dx) % dx
        v = (u * dy - side) // dx
        a, b = (128 - u, 128 - v), (128 - u + dx, 128 - v + dy)
        # The third corner lies where the edge function is above 0.
        c = (a[0] + dy, a[1] - dx)
        made.append((a, b, c))
        inside.append(side > 0)
    return np.array(made, np.int64), np.array(inside)


def naive(triangles: Triangles, kind: type[np.floating[Any]], sample: NDArray[Any] = CENTER[0]) -> NDArray[np.bool_]:
    """Whether triangles cover the sample, by edge functions in pixels in floating point, with the top-left rule where they are 0."""
    corners, point = (triangles / 256).astype(kind), (sample / 256).astype(kind)
    sides = []
    for first, second in ((0, 1), (1, 2), (2, 0)):
        a, b = corners[:, first], corners[:, second]
        across, down = b[:, 0] - a[:, 0], b[:, 1] - a[:, 1]
        side = (point[0] - a[:, 0]) * down - (point[1] - a[:, 1]) * across
        sides.append((side > 0) | ((side == 0) & ((down > 0) | ((down == 0) & (across < 0)))))
    return np.logical_and.reduce(sides)


def ours(triangles: Triangles) -> NDArray[np.bool_]:
    found = np.zeros(len(triangles), bool)
    found[coverage.rows(triangles, 1, 1, CENTER).triangle] = True
    return found


def wrongly(triangles: Triangles, inside: NDArray[np.bool_]) -> list[float]:
    """The number of triangles that float32, float64 and the study get wrong."""
    found = (naive(triangles, np.float32), naive(triangles, np.float64), ours(triangles))
    return [float(np.count_nonzero(each != inside)) for each in found]


def coverages() -> Iterator[Row]:
    """The number of wrong samples; the exact number is 0."""
    for length, words in ((64, "64"), (1024, "1,024"), (16384, "16,384"), (2**20, "2^20"), (2**23, "2^23")):
        count = 4000 if length < 2**22 else 400
        triangles, inside = near_ties(length, count, length)
        case = f"edges of {words} pixels, as close to a sample as possible: wrong of {count:,}"
        yield Row("coverage", case, 0, *wrongly(triangles, inside))
    yield Row("coverage", "slivers 1/256 pixel wide and 8,192 long: wrong of 4,000", 0, *wrongly(*needles(4000)))
    yield shared(4000)


def needles(count: int) -> tuple[Triangles, NDArray[np.bool_]]:
    """Triangles 1/256 pixel wide and 8,192 pixels long close to the sample, and whether they cover it, in integer arithmetic."""
    draws = random.Random(1)
    made, inside = [], []
    while len(made) < count:
        far = (draws.randint(2**19, 2**21), draws.randint(2**19, 2**21))
        back = draws.randint(1, 3)
        a = (128 - far[0] // (back + 1), 128 - far[1] // (back + 1))
        b = (a[0] + far[0], a[1] + far[1])
        triangle = (a, b, (a[0] + 1, a[1]))
        sides = [
            (128 - p[0]) * (q[1] - p[1]) - (128 - p[1]) * (q[0] - p[0]) for p, q in zip(triangle, triangle[1:] + triangle[:1], strict=True)
        ]
        if 0 in sides:
            continue
        made.append(triangle)
        inside.append(len({side > 0 for side in sides}) == 1)
    corners = np.array(made, np.int64)
    turned = np.array([(q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]) > 0 for p, q, r in made])
    # All in the winding in which the edge functions of naive() are above 0 within.
    corners[turned] = corners[turned][:, [0, 2, 1]]
    return corners, np.array(inside)


def shared(count: int) -> Row:
    """Pairs of triangles on either side of an edge through the sample or as close to it as possible; wrong if both or neither cover it."""
    ties, _ = near_ties(4096, count // 2, 7)
    draws = random.Random(3)
    through = []
    for _ in range(count // 2):
        dx, dy = draws.randint(2**18, 2**20), draws.randint(2**18, 2**20)
        a, b = (128 - dx, 128 - dy), (128 + dx, 128 + dy)
        through.append((a, b, (a[0] + dy, a[1] - dx)))
    one = np.concatenate([ties, np.array(through, np.int64)])
    other = one[:, [1, 0, 2]].copy()
    other[:, 2] = one[:, 0] + one[:, 1] - one[:, 2]
    covers = (lambda each: naive(each, np.float32), lambda each: naive(each, np.float64), ours)
    found = [float(np.count_nonzero(cover(one) == cover(other))) for cover in covers]
    return Row("coverage", f"shared edges through a sample or as close as possible: gaps and double hits of {count:,}", 0, *found)


def sequential(samples: list[float], kind: type[np.floating[Any]]) -> float:
    """The sum in a precision, in order, divided by the count."""
    with np.errstate(over="ignore", invalid="ignore"):
        value = kind(samples[0])
        for each in samples[1:]:
            value = value + kind(each)
        return float(value / kind(len(samples)))


def scaled(samples: list[float], kind: type[np.floating[Any]]) -> float:
    """The sum of samples that are divided by the count first, in a precision."""
    value = kind(0)
    for each in samples:
        value = value + kind(each) / kind(len(samples))
    return float(value)


def mean(samples: list[float]) -> float:
    return float(sum((Fraction(each) for each in samples), Fraction(0)) / len(samples))


def averages() -> Iterator[Row]:
    def made(samples: list[float], kind: type[Any] = np.float32) -> float:
        return float(average(np.array(samples, kind)[:, None])[0])

    for samples, words in (
        ([65504.0] * 4, "4 samples of 65504 in half precision; naive: added in half"),
        ([5000.0] * 16, "16 samples of 5000 in half precision; naive: added in half"),
        ([2048.0, 1.0, 1.0, 1.0], "2048, 1, 1, 1 in half precision; naive: added in half"),
    ):
        yield Row(
            "resolve", words, mean(samples), sequential(samples, np.float16), sequential(samples, np.float64), made(samples, np.float16)
        )
    tiny, least = [2.0**-24] * 4, [2.0**-149] * 4
    case = "4 times the smallest half-precision subnormal; naive: each quartered in half"
    yield Row("resolve", case, mean(tiny), scaled(tiny, np.float16), scaled(tiny, np.float64), made(tiny, np.float16))
    case = "4 times the smallest single-precision subnormal; naive: each quartered"
    yield Row("resolve", case, mean(least), scaled(least, np.float32), scaled(least, np.float64), made(least))
    for samples, due, words in (
        ([math.inf, 1.0, 2.0, 3.0], math.inf, "an infinite sample; naive: clamped to 65504, as some drivers do"),
        ([math.nan, 1.0, 2.0, 3.0], math.nan, "a NaN sample; naive: treated as 0, as fixed point does"),
    ):
        shown = [65504.0 if math.isinf(each) else 0.0 if math.isnan(each) else each for each in samples]
        yield Row("resolve", words, due, sequential(shown, np.float32), sequential(samples, np.float64), made(samples))
    codes = [254, 255, 255, 255]
    exact = round(Fraction(sum(codes), 4))
    light = [code / 255 for code in codes]
    cut = float(int(np.float32(sequential(light, np.float32)) * 255))
    nearest = float(np.rint(to_unorm(average(np.array(light, np.float32)[:, None]))[0] * 255))
    in_double = float(round(sequential(light, np.float64) * 255))
    yield Row("resolve", "UNORM8 codes 254, 255, 255, 255; naive: truncated", exact, cut, in_double, nearest)


def lights() -> Iterator[Row]:
    white, black = np.float32(1), np.float32(0)
    half = Fraction(1, 2)
    code = round(255 * (1.055 * float(half) ** (1 / 2.4) - 0.055))
    found = float(np.rint(to_srgb(average(np.array([white, black])[:, None]))[0] * 255))
    yield Row("light", "sRGB code of white and black, averaged; naive: codes averaged", code, round(255 / 2), code, found)
    firefly = [60000.0, 0.1, 0.1, 0.1]
    shares = [Fraction(float(np.float32(each))) for each in firefly]
    due = float(sum((each / (1 + each) for each in shares), Fraction(0)) / 4)
    samples = np.ones((4, 1, 4), np.float32)
    samples[..., :3] = np.array(firefly, np.float32)[:, None, None]
    after = float(tone_map(average(samples))[0, 0])
    in_double = sum(float(each) / (1 + float(each)) for each in shares) / 4
    before = float(average(tone_map(samples))[0, 0])
    yield Row("light", "60000 and three of 0.1, displayed; naive: tone mapped after the resolve", due, after, in_double, before, 1e-6)
    mixed = float(tone_map(weighted(samples))[0, 0])
    yield Row("light", "the same by the weighted resolve; naive: averaged without weights", due, after, in_double, mixed, 1e-6)
    bright = np.full((1, 4), np.inf, np.float32)
    with np.errstate(invalid="ignore"):
        ratio = float(bright[0, 0] / (1 + bright[0, 0]))
    yield Row("light", "infinite light, displayed; naive: x / (1 + x)", 1.0, ratio, math.nan, float(tone_map(bright)[0, 0]))
    with np.errstate(over="ignore"):
        large = float(np.float16(65519.99))
    yield Row("light", "65519.99 stored in half precision; naive: anything above 65504 is infinite", 65504.0, math.inf, large,
              float(store_half(np.array([65519.99], np.float32))[0]))  # fmt: skip


def depths() -> Iterator[Row]:
    near, far = 0.25, 0.75
    samples = np.array([[far], [near], [near], [far]], np.float32)
    found = {mode: float(resolve_depth(samples, mode)[0]) for mode in DEPTH_MODES}
    average_of = found["AVERAGE"]
    for mode, words, due in (("MIN", "nearest", near), ("MAX", "farthest", far), ("SAMPLE_ZERO", "first sample's", far)):
        words = f"depth of a silhouette, 0.25 in front of 0.75: {mode}, the {words}; naive: AVERAGE"
        yield Row("depth", words, due, average_of, mean([near, near, far, far]), found[mode])
    # One millimeter apart at one kilometer, with the near plane at 0.1 m: depth is 1 - 0.1 / z, reversed 0.1 / z.
    first, second = Fraction(1, 10) / 1000, Fraction(1, 10) / (1000 + Fraction(1, 1000))
    standard = [np.float32(float(1 - each)) for each in (first, second)]
    reverse = [np.float32(float(each)) for each in (first, second)]
    double = float(1 - first) < float(1 - second)
    words = "1 mm apart at 1 km, is the nearer one drawn (1 yes)? naive: standard depth; ours: reversed depth"
    yield Row("depth", words, 1, float(standard[0] < standard[1]), float(double), float(reverse[0] > reverse[1]))


def sums() -> Iterator[Row]:
    count = 2**24 + 4096
    ones = np.ones(count, np.float32)
    yield Row("sums", f"{count:,} squared errors of 1; naive: added one by one", count, float(np.cumsum(ones, dtype=np.float32)[-1]),
              float(count), total(ones))  # fmt: skip
    numbers = np.arange(6_220_800, dtype=np.int64) * 40503 % 65536
    exact = float(Fraction(int(np.sum(numbers * numbers)), 65536**2))
    values = numbers / 65536
    single = values.astype(np.float32)
    one_by_one = float(np.cumsum(single * single, dtype=np.float32)[-1])
    squares = values * values
    words = "squared errors of 1920 x 1080 pixels of 3 channels; naive: added one by one"
    yield Row("sums", words, exact, one_by_one, float(np.sum(squares)), total(squares), 1e-15)


GROUPS: tuple[Callable[[], Iterator[Row]], ...] = (coverages, averages, lights, depths, sums)


def rows() -> list[Row]:
    """All cases."""
    return [row for group in GROUPS for row in group()]


def written(value: float) -> str:
    """A number with few digits, the same on every machine."""
    if math.isnan(value):
        return "NaN"
    if math.isinf(value):
        return "infinite" if value > 0 else "-infinite"
    if value == int(value) and abs(value) < 1e15:
        return f"{value:,.0f}"
    return f"{value:,.1f}" if abs(value) >= 1e5 else f"{value:.5g}"


def table() -> str:
    """The table in Markdown; wrong results are struck through."""
    lines = ["| case | exact | naive | float64 | ours |", "|---|---:|---:|---:|---:|"]
    for row in rows():
        cells = [written(each) if row.right(each) else f"~~{written(each)}~~" for each in (row.naive, row.double, row.ours)]
        lines.append(f"| {row.case} | {written(row.exact)} | {' | '.join(cells)} |")
    return "\n".join(lines)


BEGIN, END = "<!-- numbers: made by docs/study_numbers.py -->", "<!-- end of numbers -->"


def fresh(text: str) -> str:
    """The page with its table regenerated."""
    if text.count(BEGIN) != 1 or END not in text:
        raise SystemExit("docs/study-numbers.md has no single place for the table")
    before, after = text.split(BEGIN)
    return f"{before}{BEGIN}\n\n{table()}\n\n{END}{after.split(END, 1)[1]}"


if __name__ == "__main__":
    page = PAGE.read_text(encoding="utf-8")
    if "--check" in sys.argv:
        sys.exit(page != fresh(page))
    PAGE.write_text(fresh(page), encoding="utf-8")
