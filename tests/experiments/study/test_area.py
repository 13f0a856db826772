"""The reference is the exact area, and the standard patterns come as near to it as is known of
them.
"""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from msaa_lint.experiments.study.coverage import rows
from msaa_lint.experiments.study.exact_area import ACCURACY, areas, areas_of
from msaa_lint.experiments.study.locations import SUBPIXELS, standard
from tests.experiments.study.rational import exact_area, shoelace
from tests.experiments.study.spans import grid, hits
from tests.strength import examples

SIDE = 6
Floats = NDArray[np.float64]

ANYWHERE = st.floats(-3, SIDE + 3)
SNAPPED = st.integers(-3 * SUBPIXELS, (SIDE + 3) * SUBPIXELS).map(lambda n: n / SUBPIXELS)
ON_BORDERS = st.integers(-1, SIDE + 1).map(float)
PLACES = st.one_of(ANYWHERE, SNAPPED, ON_BORDERS)


def exact(polygon: Floats, width: int = SIDE, height: int = SIDE) -> list[list[Fraction]]:
    return [[exact_area(polygon, column, row) for column in range(width)] for row in range(height)]


def worst(found: Floats, expected: list[list[Fraction]]) -> float:
    """The largest error. Pixels that are empty or whole must be exactly so: by that the pixels that
    an edge crosses are known.
    """
    pairs = [
        (float(a), b)
        for own, other in zip(found, expected, strict=True)
        for a, b in zip(own, other, strict=True)
    ]
    assert [a for a, b in pairs if b in (0, 1)] == [float(b) for _, b in pairs if b in (0, 1)]
    return max(abs(float(Fraction(a) - b)) for a, b in pairs)


def star(
    seed: int,
    corners: int,
    low: float = 0.5,
    high: float = 4.5,
    middle: tuple[float, float] = (3, 3),
) -> Floats:
    """A simple polygon, seldom convex, round a point that lies in it."""
    random = np.random.default_rng(seed)
    angles = (np.arange(corners) + random.uniform(0, 0.4, corners)) * 2 * np.pi / corners
    return np.array(middle) + np.stack((np.cos(angles), np.sin(angles)), axis=1) * random.uniform(
        low, high, (corners, 1)
    )


@examples(1.5)
@given(st.lists(st.tuples(PLACES, PLACES), min_size=3, max_size=3))
def test_triangles_are_as_fractions_have_them(corners: list[tuple[float, float]]) -> None:
    triangle = np.array(corners)
    found = areas(triangle, SIDE, SIDE)
    assert worst(found, exact(triangle)) <= ACCURACY
    assert np.array_equal(areas(triangle[::-1], SIDE, SIDE), found)
    assert np.array_equal(areas_of(triangle[None], SIDE, SIDE), found)


@pytest.mark.parametrize("seed", range(40))
def test_polygons_are_as_fractions_have_them(seed: int) -> None:
    polygon = star(seed, 3 + seed % 13)
    found = areas(polygon, SIDE, SIDE)
    assert worst(found, exact(polygon)) <= ACCURACY
    # In the picture as a whole it is the shoelace formula's.
    whole = areas(polygon + 5, 20, 20)
    shifted = polygon + 5
    assert (
        abs(
            float(
                Fraction(float(whole.sum()))
                - abs(shoelace([(Fraction(x), Fraction(y)) for x, y in shifted.tolist()]))
            )
        )
        <= ACCURACY
    )


@pytest.mark.parametrize("bits", range(4, 32, 3))
def test_edges_from_far_away_are_as_accurate_as_near_ones(bits: int) -> None:
    """Edges through the picture, their ends up to 2^23 pixels away on the grid of 1/256 pixel."""
    random = np.random.default_rng(bits)
    for _ in range(12):
        through, angle = random.integers(0, SIDE * SUBPIXELS, 2), random.uniform(0, 2 * np.pi)
        run, rise = (round(2**bits * float(part)) for part in (np.cos(angle), np.sin(angle)))
        triangle = (through + np.array([(-run, -rise), (run, rise), (-rise, run)])) / SUBPIXELS
        found = areas(triangle, SIDE, SIDE)
        assert worst(found, exact(triangle)) <= ACCURACY
        assert bits < 12 or 0 < found.sum() < SIDE * SIDE


def test_an_edge_from_far_away_in_plain_double_precision_would_miss_the_accuracy() -> None:
    """x + (y - y0) * run / rise without what the products leave out: the test above can fail."""
    corners = np.array(
        [(-(2.0**23) + 1 / 256, -(2.0**23) + 3 / 256), (2.0**23 - 5 / 256, 2.0**22 + 7 / 256)]
    )
    (x0, y0), (x1, y1) = corners
    (a0, b0), (a1, b1) = ((Fraction(float(x)), Fraction(float(y))) for x, y in corners)
    y = -2796202.0
    assert (
        abs(
            float(
                Fraction(x0 + (y - y0) * (x1 - x0) / (y1 - y0))
                - (a0 + (Fraction(y) - b0) * (a1 - a0) / (b1 - b0))
            )
        )
        > 10 * ACCURACY
    )


@examples(0.6)
@given(st.integers(0, 2**32), st.integers(3, 12))
def test_the_parts_of_a_polygon_add_up_to_it(seed: int, corners: int) -> None:
    """A star round (3, 3), cut into triangles there: disjoint, and together the star."""
    polygon = star(seed, corners)
    triangles = np.stack(
        (np.broadcast_to([3.0, 3.0], polygon.shape), polygon, np.roll(polygon, -1, axis=0)), axis=1
    )
    together = areas_of(triangles, SIDE, SIDE)
    assert np.abs(together - sum(areas(each, SIDE, SIDE) for each in triangles)).max() <= ACCURACY
    assert np.abs(together - areas(polygon, SIDE, SIDE)).max() <= ACCURACY


def test_shared_edges_leave_no_trace() -> None:
    """The picture cut at random into triangles that share edges: every pixel is 1, exactly."""
    random = np.random.default_rng(5)
    corners = np.stack(np.meshgrid(np.arange(9.0), np.arange(9.0)), axis=-1)
    corners[1:-1, 1:-1] += random.uniform(-0.24, 0.24, (7, 7, 2))
    a, b, c, d = (
        corners[y : y + 8, x : x + 8].reshape(-1, 2) for y, x in ((0, 0), (0, 1), (1, 0), (1, 1))
    )
    triangles = np.concatenate((np.stack((a, b, c), axis=1), np.stack((d, b, c), axis=1)))
    assert (areas_of(triangles, 8, 8) == 1).all()
    # Inside of the union's border, too.
    half = areas_of(triangles * 0.5 + 1.25, 8, 8)
    assert (half[2:5, 2:5] == 1).all()
    assert np.array_equal(
        half, areas(np.array([(1.25, 1.25), (5.25, 1.25), (5.25, 5.25), (1.25, 5.25)]), 8, 8)
    )


@pytest.mark.parametrize("seed", range(20))
def test_neither_do_edges_that_end_on_others(seed: int) -> None:
    """A quadrilateral cut in two, one of the parts again from the middle of the cut: inside of it
    every pixel is 1, exactly.
    """
    along = np.random.default_rng(seed).integers(-3 * SUBPIXELS, 3 * SUBPIXELS, 2) / SUBPIXELS
    middle, across = np.array((3.0, 3.0)), np.array((-along[1], along[0]))
    a, b, left, right = middle - along, middle + along, middle + across, middle - across
    together = areas_of(
        np.array([(a, b, left), (a, middle, right), (middle, b, right)]), SIDE, SIDE
    )
    assert worst(together, exact(np.array([a, left, b, right]))) <= ACCURACY


@pytest.mark.parametrize(
    ("polygon", "total"),
    [
        ([(1, 1), (4, 1), (4, 3), (1, 3)], 6),
        ([(-5, -5), (20, -5), (20, 20), (-5, 20)], 36),
        ([(-9, 0), (-1, 0), (-1, 6)], 0),
        ([(7, 0), (9, 0), (9, 6)], 0),
        ([(0, -9), (6, -9), (6, -1)], 0),
        ([(0, 7), (6, 7), (6, 9)], 0),
        ([(0, 0), (6, 6), (3, 3)], 0),
        ([(2, 2), (2, 2), (2, 2)], 0),
        ([(0, 0), (6, 0)], 0),
        ([], 0),
        ([(-6, 0), (6, 0), (6, 6), (-6, 6)], 36),
        ([(0, 0), (0, 6), (12, 6), (12, 0)], 36),
        ([(0, 0), (6, 0), (0, 6)], 18),
        ([(2.5, 2.5), (3.5, 2.5), (3.5, 3.5), (2.5, 3.5)], 1),
        ([(1, 1), (5, 1), (5, 5), (3, 2), (1, 5)], 10),
    ],
)
def test_areas_that_are_known(polygon: list[tuple[float, float]], total: float) -> None:
    corners = np.array(polygon, dtype=np.float64).reshape(-1, 2)
    found = areas(corners, SIDE, SIDE)
    assert found.shape == (SIDE, SIDE)
    assert found.sum() == pytest.approx(total, abs=ACCURACY)
    assert worst(found, exact(corners)) <= ACCURACY


@pytest.mark.parametrize(
    ("call", "says"),
    [
        (lambda: areas(np.zeros((3, 3)), 4, 4), r"\(V, 2\)"),
        (lambda: areas_of(np.zeros((3, 2)), 4, 4), r"\(T, 3, 2\)"),
        (lambda: areas(np.array([(0, 0), (1, np.nan), (1, 1)]), 4, 4), "finite"),
        (lambda: areas_of(np.full((1, 3, 2), np.inf), 4, 4), "finite"),
    ],
)
def test_what_is_no_polygon_is_refused(call: Any, says: str) -> None:
    with pytest.raises(ValueError, match=says):
        call()


def test_coverage_comes_as_near_to_the_area_as_samples_are_close() -> None:
    """With n x n samples a straight edge misjudges at most the cells it crosses, 2n - 1 of n^2; a
    corner of a triangle in a pixel adds another edge's. And the error goes on falling.
    """
    triangle = np.array([[300, 150], [7003, 1805], [2117, 7508]])
    reference = areas(triangle / SUBPIXELS, 30, 30)
    errors = []
    for side in (1, 2, 4, 8, 16, 32, 64):
        found = (
            hits(rows(triangle[None] * side, 30, 30, grid(side), SUBPIXELS * side), 30, 30)
            / side**2
        )
        assert np.abs(found - reference).max() <= 2 * (2 * side - 1) / side**2
        errors.append(float(np.sqrt(np.mean((found - reference) ** 2))))
    assert all(finer < 0.7 * coarse for coarse, finer in pairwise(errors))
    assert errors[-1] < errors[0] / 100


FINER = 16
EDGES = SUBPIXELS * FINER


def edges(upright: bool, locations: NDArray[np.int64], scale: int) -> Floats:
    """What samples say, less what is so, of rectangles that end at each of 4096 places evenly over
    a pixel, an edge for each.
    """
    end = np.arange(EDGES) * scale
    step = EDGES * scale
    top = np.arange(EDGES) * step
    zero = np.zeros_like(end)
    corners = [
        np.stack(pair, axis=1)
        for pair in ((zero, top), (end, top), (zero, top + step), (end, top + step))
    ]
    a, b, c, d = corners if upright else (corner[:, ::-1] for corner in corners)
    triangles = np.concatenate((np.stack((a, b, c), axis=1), np.stack((b, d, c), axis=1)))
    size = (1, EDGES) if upright else (EDGES, 1)
    counted = hits(rows(triangles, *size, locations * FINER, step), *size) / len(locations)
    error: Floats = (counted - areas_of(triangles / step, *size)).ravel()
    return error


@pytest.mark.parametrize("upright", [True, False], ids=["upright", "lying"])
@pytest.mark.parametrize("samples", [1, 2, 4, 8, 16])
def test_the_error_of_an_edge_along_the_axes_is_that_of_as_many_steps(
    samples: int, upright: bool
) -> None:
    """1 / (n * sqrt(12)) for n distinct projections, here all n. The pattern of 16 adds its bias of
    1/32.
    """
    error = edges(upright, standard(samples), 1)
    bias = 1 / 32 if samples == 16 else 0
    # The places of edges begin at 0: half a step from their middle.
    assert error.mean() == pytest.approx(bias, abs=1 / EDGES)
    assert error.std() == pytest.approx(1 / (samples * np.sqrt(12)), rel=0.01)
    assert np.sqrt(np.mean(error**2)) == pytest.approx(
        np.hypot(1 / (samples * np.sqrt(12)), bias), rel=0.01
    )


@pytest.mark.parametrize("side", [1, 2, 3, 4])
def test_a_grid_of_n_by_n_is_no_better_there_than_n_samples(side: int) -> None:
    error = edges(True, grid(side), side)
    assert np.sqrt(np.mean(error**2)) == pytest.approx(1 / (side * np.sqrt(12)), rel=0.01)
