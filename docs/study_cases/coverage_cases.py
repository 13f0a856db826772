"""Cases of coverage: edges as close to samples as possible, and exactly on them."""

from __future__ import annotations

import math
import random
from collections.abc import Iterator
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from msaa_lint.experiments.study import coverage, locations
from msaa_lint.experiments.study.points import COUNTS

from .row import Row

CENTER = np.array([[128, 128]])
"""One sample at the center of the pixel, in 1/256 pixel."""

Triangles = NDArray[np.int64]


def near_ties(length: int, count: int, seed: int) -> tuple[Triangles, NDArray[np.bool_]]:
    """Triangles with an edge of about `length` pixels whose edge function is 1 or -1 at the sample,
    the smallest nonzero values, and whether they cover it. Bezout's identity finds them; random
    triangles hardly ever qualify.
    """
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


def naive(
    triangles: Triangles, kind: type[np.floating[Any]], sample: NDArray[Any] = CENTER[0]
) -> NDArray[np.bool_]:
    """Whether triangles cover the sample, by edge functions in pixels in floating point, with the
    top-left rule where they are 0.
    """
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
    for length, words in (
        (64, "64"),
        (1024, "1,024"),
        (16384, "16,384"),
        (2**20, "2^20"),
        (2**23, "2^23"),
    ):
        count = 4000 if length < 2**22 else 400
        triangles, inside = near_ties(length, count, length)
        case = f"edges of {words} pixels, as close to a sample as possible: wrong of {count:,}"
        yield Row("coverage", case, 0, *wrongly(triangles, inside))
    yield Row(
        "coverage",
        "slivers 1/256 pixel wide and 8,192 long: wrong of 4,000",
        0,
        *wrongly(*needles(4000)),
    )
    yield shared(4000)


def needles(count: int) -> tuple[Triangles, NDArray[np.bool_]]:
    """Triangles 1/256 pixel wide and 8,192 pixels long close to the sample, and whether they cover
    it, in integer arithmetic.
    """
    draws = random.Random(1)
    made, inside = [], []
    while len(made) < count:
        far = (draws.randint(2**19, 2**21), draws.randint(2**19, 2**21))
        back = draws.randint(1, 3)
        a = (128 - far[0] // (back + 1), 128 - far[1] // (back + 1))
        b = (a[0] + far[0], a[1] + far[1])
        triangle = (a, b, (a[0] + 1, a[1]))
        sides = [
            (128 - p[0]) * (q[1] - p[1]) - (128 - p[1]) * (q[0] - p[0])
            for p, q in zip(triangle, triangle[1:] + triangle[:1], strict=True)
        ]
        if 0 in sides:
            continue
        made.append(triangle)
        inside.append(len({side > 0 for side in sides}) == 1)
    corners = np.array(made, np.int64)
    turned = np.array(
        [(q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]) > 0 for p, q, r in made]
    )
    # All in the winding in which the edge functions of naive() are above 0 within.
    corners[turned] = corners[turned][:, [0, 2, 1]]
    return corners, np.array(inside)


def shared(count: int) -> Row:
    """Pairs of triangles on either side of an edge through the sample or as close to it as
    possible; wrong if both or neither cover it.
    """
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
    return Row(
        "coverage",
        f"shared edges through a sample or as close as possible: gaps and double hits of {count:,}",
        0,
        *found,
    )


PHASES = 64
"""Steps of a pixel by which an edge moves."""


def phases() -> Iterator[Row]:
    """A horizontal edge at every phase of a pixel, of which some lie exactly on rows of samples:
    the phases at which the rectangle above it or the one below it covers another number of samples
    than rational arithmetic says. A sample on the edge belongs to the one below.
    """
    for samples in COUNTS:
        places = locations.standard(samples)
        heights = [
            [Fraction(int(y), 256) - Fraction(phase, PHASES) for _, y in places]
            for phase in range(PHASES)
        ]
        exact = [
            (sum(height < 0 for height in row), sum(height >= 0 for height in row))
            for row in heights
        ]
        inclusive = [
            (sum(float(height) <= 0 for height in row), sum(float(height) >= 0 for height in row))
            for row in heights
        ]
        found = [
            tuple(_covered(rectangle, places) for rectangle in _sides(phase))
            for phase in range(PHASES)
        ]
        wrong = [
            float(sum(one != due for one, due in zip(each, exact, strict=True)))
            for each in (inclusive, found)
        ]
        on_rows = sum(0 in row for row in heights)
        case = (
            f"horizontal edge at 64 phases, {on_rows} of them on sample rows, {samples}x: wrong "
            "counts; naive: edges belong to both sides"
        )
        yield Row("coverage", case, 0, wrong[0], wrong[0], wrong[1])


def _sides(phase: int) -> tuple[Triangles, Triangles]:
    """The rectangles above and below an edge at `phase` steps from the top of a pixel: two
    triangles each, in 1/256 pixel.
    """
    edge = phase * 256 // PHASES
    return _rectangle(-512, edge), _rectangle(edge, 1024)


def _rectangle(top: int, bottom: int) -> Triangles:
    left, right = -700, 900
    return np.array(
        [
            [[left, top], [right, top], [right, bottom]],
            [[left, top], [right, bottom], [left, bottom]],
        ],
        np.int64,
    )


def _covered(triangles: Triangles, places: NDArray[np.int64]) -> int:
    """The number of samples of the pixel that triangles cover together."""
    spans = coverage.rows(triangles, 1, 1, places)
    return int(np.count_nonzero(spans.left < spans.right))
