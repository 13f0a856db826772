"""How often a fragment shader runs: multisampling, sample shading, supersampling, and what edges of small triangles add.

A pixel shades a triangle once if the triangle covers any of its samples, so that a triangle shades more pixels than its area: those of the
union of its copies moved by each sample. For large triangles that is A(T) + 2 V(T, P) + A(P), with P the convex hull of the samples turned
about the pixel's centre, V the mixed area; it is what the union is at most.
"""

from __future__ import annotations

import math
from itertools import pairwise

from msaa_lint.frame.facts.frame import Frame
from msaa_lint.frame.facts.parts import RENDER_PASS, Pass
from msaa_lint.frame.facts.subpass import samples_of
from msaa_lint.frame.vulkan.sample_locations import STANDARD

from .amounts import Shading
from .sizes import Area

LEGS = (1, 2, 4, 8, 16, 32)
"""Right triangles of these legs, in pixels, stand in tables for small ones."""


def shaded_samples(minimum: float, samples: int) -> int:
    """Invocations a pixel that sample shading demands: max(ceil(minSampleShading * rasterizationSamples), 1)."""
    return max(math.ceil(minimum * samples), 1)


def supersampling(samples: int) -> int:
    """Pixels of the smallest k x k grid that is as many as the samples: 4 for 2 and 4, 9 for 8, 16 for 16."""
    return (math.isqrt(samples - 1) + 1) ** 2


def invocations_per_area(leg: int, samples: int) -> float:
    """Fragment shader invocations for each pixel of area of a right triangle whose legs, along the pixel grid, are `leg` pixels.

    The mean over all positions, exact: the area of the union of the triangle moved by each sample, by its own area. KeyError for a count
    without standard locations (32, 64).
    """
    # In thirty-seconds of a pixel, where the middle between two heights is whole. At height y a copy that was moved by (x, z) covers from
    # x to x + side - (y - z): between the heights below, every gap is linear in y, and what is covered in the middle is the mean.
    moved = [(-2 * x, -2 * y) for x, y in STANDARD[samples]]
    side = 32 * leg
    heights = {y for _, y in moved} | {y + side for _, y in moved}
    heights |= {x + y + side - other for x, y in moved for other, _ in moved}
    lowest, highest = min(y for _, y in moved), max(y for _, y in moved) + side
    steps = sorted(height for height in heights if lowest <= height <= highest)
    area = 0
    for low, high in pairwise(steps):
        middle = (low + high) // 2
        spans = sorted((x, x + side - (middle - y)) for x, y in moved if y <= middle <= y + side)
        area += (high - low) * _covered(spans)
    return area / (side * side / 2)


def _covered(spans: list[tuple[int, int]]) -> int:
    """The length that some intervals, in order, cover together."""
    covered, reached = 0, spans[0][0] if spans else 0
    for start, end in spans:
        if end > reached:
            covered += end - max(start, reached)
            reached = end
    return covered


def hull(points: tuple[tuple[int, int], ...]) -> list[tuple[int, int]]:
    """The corners of the convex hull of some points, counter-clockwise."""
    ordered = sorted(set(points))
    if len(ordered) < 3:
        return ordered
    chains = []
    for chain in (ordered, ordered[::-1]):
        corners: list[tuple[int, int]] = []
        for x, y in chain:
            while len(corners) > 1 and _turn(corners[-2], corners[-1], (x, y)) <= 0:
                corners.pop()
            corners.append((x, y))
        chains.append(corners[:-1])
    return chains[0] + chains[1]


def _turn(a: tuple[int, int], b: tuple[int, int], c: tuple[int, int]) -> int:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def edge_term(leg: int, samples: int) -> tuple[float, float]:
    """2 V(T, P) and A(P), in pixels, of the right triangle of `invocations_per_area`: what edges add to its area at most; exact.

    The mixed area is the sum over the triangle's sides of their length times how far P reaches along the side's outward normal.
    """
    corners = hull(STANDARD[samples])
    turned = [(-x, -y) for x, y in corners]
    area = sum(_turn((0, 0), a, b) for a, b in zip(corners, corners[1:] + corners[:1], strict=True))
    # Normals scaled by their sides' lengths: (-1, 0) and (0, -1) of the legs, (1, 1) of the third side.
    reach = max(-x for x, _ in turned) + max(-y for _, y in turned) + max(x + y for x, y in turned)
    return reach * leg / 16, area / 512


def invocations_at_most(leg: int, samples: int) -> float:
    """As `invocations_per_area`, by the hull: A + 2 V + A(P). What it approaches for large triangles, and never exceeds."""
    added, own = edge_term(leg, samples)
    area = leg * leg / 2
    return (area + added + own) / area


EDGES: dict[int, tuple[tuple[int, float], ...]] = {
    1: ((1, 1.0), (2, 1.0), (4, 1.0), (8, 1.0), (16, 1.0), (32, 1.0)),
    2: ((1, 2.0), (2, 1.75), (4, 1.4375), (8, 1.2344), (16, 1.1211), (32, 1.0615)),
    4: ((1, 3.3125), (2, 2.2031), (4, 1.6133), (8, 1.3096), (16, 1.1555), (32, 1.0779)),
    8: ((1, 4.1094), (2, 2.4648), (4, 1.71), (8, 1.3494), (16, 1.1733), (32, 1.0863)),
    16: ((1, 5.2617), (2, 2.9717), (4, 1.946), (8, 1.4631), (16, 1.229), (32, 1.1139)),
}
"""`invocations_per_area` by samples, for legs of 1 to 32 pixels, to four places."""


def pass_shading(each: Pass, area: Area, frame: Frame) -> Shading | None:
    """The invocations of one layer of triangles over all that a pass renders; None where a size or every sample count is unknown.

    A pass of several subpasses is taken by the one with the most samples.
    """
    if area.width is None or not each.subpasses:
        return None
    counts = [samples_of(subpass) for subpass in each.subpasses]
    samples = max((count for count in counts if count is not None), default=None)
    if samples is None:
        return None
    pixels = area.layered
    least = _demanded(each, frame, samples)
    return Shading(
        pixels,
        samples,
        pixels / 1e6,
        pixels * samples / 1e6,
        pixels * supersampling(samples) / 1e6,
        None if least is None else pixels * least / 1e6,
        EDGES.get(samples, ()),
    )


def _demanded(each: Pass, frame: Frame, samples: int) -> int | None:
    """Invocations a pixel by the pass's pipeline that demands the most; None where none is stated, or one does not say."""
    if each.kind != RENDER_PASS:
        return None
    demands = []
    for pipeline, within in frame.pipelines:
        if within is each:
            state = pipeline.multisampleState
            if state is None or state.sampleShadingEnable is None:
                return None
            if state.sampleShadingEnable and state.minSampleShading is None:
                return None
            demands.append(shaded_samples(min(state.minSampleShading or 0.0, 1.0), samples) if state.sampleShadingEnable else 1)
    return max(demands, default=None)
