"""Exact fragment shader invocations of small right triangles: where the table `EDGES` of
`frame.cost.shading` comes from.

For large triangles the union of the copies approaches A(T) + 2 V(T, P) + A(P), with P the convex
hull of the samples turned about the pixel's center and V the mixed area, and never exceeds it.
"""

from __future__ import annotations

from itertools import pairwise

from msaa_lint.frame.vulkan.sample_locations import STANDARD

LEGS = (1, 2, 4, 8, 16, 32)
"""Right triangles of these legs, in pixels, stand in tables for small ones."""


def invocations_per_area(leg: int, samples: int) -> float:
    """Fragment shader invocations for each pixel of area of a right triangle whose legs, along the
    pixel grid, are `leg` pixels.

    The mean over all positions, exact: the area of the union of the triangle moved by each sample,
    by its own area. KeyError for a count without standard locations (32, 64).
    """
    # In thirty-seconds of a pixel, where the middle between two heights is whole. At height y a
    # copy that was moved by (x, z) covers from x to x + side - (y - z): between the heights below,
    # every gap is linear in y, and what is covered in the middle is the mean.
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
    """2 V(T, P) and A(P), in pixels, of the right triangle of `invocations_per_area`: what edges
    add to its area at most; exact.

    The mixed area is the sum over the triangle's sides of their length times how far P reaches
    along the side's outward normal.
    """
    corners = hull(STANDARD[samples])
    turned = [(-x, -y) for x, y in corners]
    area = sum(_turn((0, 0), a, b) for a, b in zip(corners, corners[1:] + corners[:1], strict=True))
    # Normals scaled by their sides' lengths: (-1, 0) and (0, -1) of the legs, (1, 1) of the third
    # side.
    reach = max(-x for x, _ in turned) + max(-y for _, y in turned) + max(x + y for x, y in turned)
    return reach * leg / 16, area / 512


def invocations_at_most(leg: int, samples: int) -> float:
    """As `invocations_per_area`, by the hull: A + 2 V + A(P). What it approaches for large
    triangles, and never exceeds.
    """
    added, own = edge_term(leg, samples)
    area = leg * leg / 2
    return (area + added + own) / area
