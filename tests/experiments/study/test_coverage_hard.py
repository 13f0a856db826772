"""Hard inputs: near ties, far corners, slivers, corners on samples. What floating point makes of
the same inputs is tested beside.
"""

from __future__ import annotations

from math import gcd, isqrt

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from msaa_lint.experiments.study.coverage import rows
from msaa_lint.experiments.study.locations import SUBPIXELS, standard
from msaa_lint.frame.vulkan.sample_locations import STANDARD
from tests.experiments.study.rational import covered, covers, edge, hit, naive
from tests.experiments.study.spans import hits, masks
from tests.strength import examples

SIDE = 8
"""Pixels of the picture's side."""


def near_ties(
    pixels: int, trials: int, seed: int, across: int = SIDE
) -> tuple[NDArray[np.int64], NDArray[np.int64], list[int]]:
    """Pairs of triangles at an edge of about `pixels` pixels that misses a sample by the least
    there is: an edge function of 1 or -1.

    Gives the triangles (2 * trials, 3, 2), those of each pair on either side of their edge and
    clockwise on the screen, the sample (trials, 2) that each edge misses, in a picture `across`
    pixels wide, and which of the pattern's 16 samples it is. By Bezout's identity: for a run and a
    rise without a common divisor there are whole numbers that make run * v - rise * u = 1.
    """
    random = np.random.default_rng(seed)
    triangles, missed, which = [], [], []
    while len(missed) < trials:
        run, rise = (int(n) for n in random.integers(-pixels * SUBPIXELS, pixels * SUBPIXELS, 2))
        if gcd(run, rise) != 1 or isqrt(run * run + rise * rise) < pixels * SUBPIXELS // 2:
            continue
        side = int(random.choice((-1, 1)))
        v = pow(run, -1, abs(rise)) if abs(rise) > 1 else 1
        u = (run * v - 1) // rise
        assert run * v - rise * u == 1
        u, v = u * side, v * side
        # The point of the line's neighbour nearest to the middle of the edge.
        steps = (u * run + v * rise) // (run * run + rise * rise)
        u, v = u - steps * run, v - steps * rise
        if not 0 <= u * run + v * rise <= run * run + rise * rise:
            continue
        own = int(random.integers(16))
        sample = standard(16)[own] + SUBPIXELS * random.integers(0, (across, SIDE), 2)
        x, y = int(sample[0]) - u, int(sample[1]) - v
        start, end = (x, y), (x + run, y + rise)
        assert edge(start, end, (int(sample[0]), int(sample[1]))) == side
        # Third corners far on either side, so that no other edge comes near the sample.
        inner, outer = (
            (x + (run - 3 * rise) // 2, y + (rise + 3 * run) // 2),
            (x + (run + 3 * rise) // 2, y + (rise - 3 * run) // 2),
        )
        triangles += [(start, end, inner), (end, start, outer)]
        missed.append((int(sample[0]), int(sample[1])))
        which.append(own)
    return np.array(triangles, dtype=np.int64), np.array(missed, dtype=np.int64), which


def says(
    triangles: NDArray[np.int64], missed: NDArray[np.int64], which: list[int], across: int = SIDE
) -> list[bool]:
    """What rows() says of every triangle and the sample near its edge."""
    found = rows(triangles, across, SIDE, standard(16))
    return [
        hit(
            found,
            n,
            int(missed[n // 2][1]) // SUBPIXELS,
            int(missed[n // 2][0]) // SUBPIXELS,
            which[n // 2],
        )
        for n in range(len(triangles))
    ]


def true(triangles: NDArray[np.int64], missed: NDArray[np.int64]) -> list[bool]:
    return [
        covers([(int(x), int(y)) for x, y in each], tuple(missed[n // 2].tolist()))
        for n, each in enumerate(triangles)
    ]


@pytest.mark.parametrize(
    ("pixels", "trials"),
    [(64, 500), (1024, 500), (16384, 500), (2**20, 500), (2**22, 60), (2**23, 60)],
)
def test_near_ties_are_told(pixels: int, trials: int) -> None:
    triangles, missed, which = near_ties(pixels, trials, pixels)
    exact = true(triangles, missed)
    # The sample is on one side of the edge, so that one triangle of each pair has it.
    assert [exact[n] + exact[n + 1] for n in range(0, 2 * trials, 2)] == [1] * trials
    assert says(triangles, missed, which) == exact


@pytest.mark.parametrize(
    ("pixels", "across"), [(1024, 2**14), (2**20, 2**14), (2**20, 2**20), (2**22, 2**20)]
)
def test_near_ties_are_told_in_columns_far_to_the_right(pixels: int, across: int) -> None:
    """There a quotient in double precision is too coarse, and its remainder must tell."""
    triangles, missed, which = near_ties(pixels, 400, pixels, across)
    assert says(triangles, missed, which, across) == true(triangles, missed)


def test_edges_through_samples_where_a_quotient_in_double_precision_is_rounded_past_them() -> None:
    """In columns millions of pixels away, still in int64: a top left corner on a centre has it."""
    random = np.random.default_rng(11)
    column, rise = (
        random.integers(15 * 2**19, 2**23 - 2, 400),
        random.integers(2**30, 5 * 2**28, 400),
    )
    x = column * SUBPIXELS + 128
    run = -random.integers(0, 2**8, 400)
    level = np.full_like(x, 128)
    triangles = np.moveaxis(
        np.array([(x, level), (x + 512, level), (x + run, level + rise)]), -1, 0
    )
    found = rows(triangles, 2**23, 1, standard(1))
    assert np.array_equal(found.left[:, 0], column)
    assert np.array_equal(found.right[:, 0], column + 2)
    quotients = (column * SUBPIXELS * rise) / (SUBPIXELS * rise)
    assert (quotients > column).sum() > 10


@pytest.mark.parametrize(
    ("pixels", "number", "least"),
    [
        (64, np.float32, 0.2),
        (1024, np.float32, 0.4),
        (16384, np.float32, 0.4),
        (2**20, np.float32, 0.4),
        (2**20, np.float64, 0.08),
    ],
)
def test_floating_point_does_not_tell_them(pixels: int, number: type, least: float) -> None:
    """On the inputs of the test above; so that test can fail."""
    triangles, missed, _ = near_ties(pixels, 500, pixels)
    wrong = naive(triangles, np.repeat(missed, 2, axis=0), number) != np.array(
        true(triangles, missed)
    )
    assert wrong.mean() > least


def test_double_precision_tells_them_while_its_products_are_exact() -> None:
    """The naive method itself is right: what it lacks above are digits."""
    for pixels in (64, 1024, 16384):
        triangles, missed, _ = near_ties(pixels, 500, pixels)
        assert np.array_equal(
            naive(triangles, np.repeat(missed, 2, axis=0), np.float64), true(triangles, missed)
        )


def test_int64_alone_would_wrap_where_python_s_integers_take_over() -> None:
    """At 2^23 pixels the sums leave int64; what they wrap to puts the edge elsewhere."""
    corners = np.array([[(-(2**31), -(2**31) + 77), (2**31, 2**31 - 1300), (-(2**31), 2**31)]])
    run, rise, x, y = 2**32, 2**32 - 1377, -(2**31), -(2**31) + 77
    assert abs(x * rise - y * run) + abs(run * 2048) < 2**63 < rise * (2**31 + 4096) + run * 2**31
    for samples in STANDARD:
        found = masks(rows(corners, SIDE, SIDE, standard(samples)), SIDE, SIDE, samples)
        assert np.array_equal(found, covered(corners[0], SIDE, SIDE, standard(samples)))
        assert 0.1 < found.mean() < 0.9


@examples(1.5)
@given(
    st.tuples(st.integers(0, 2048), st.integers(0, 2048)),
    st.integers(0, 31),
    st.integers(0, 359),
    st.integers(0, 2**16),
    st.sampled_from(sorted(STANDARD)),
)
def test_corners_at_any_distance_up_to_2_23_pixels(
    through: tuple[int, int], bits: int, degrees: int, spread: int, samples: int
) -> None:
    """An edge through a given point of the picture, with its ends 2^-8 to 2^23 pixels away."""
    far = 2**bits
    run, rise = round(far * np.cos(np.radians(degrees))), round(far * np.sin(np.radians(degrees)))
    x, y = through
    corners = np.array(
        [(x - run, y - rise), (x + run, y + rise), (x - rise + spread, y + run - spread)],
        dtype=np.int64,
    )
    found = masks(rows(corners[None], SIDE, SIDE, standard(samples)), SIDE, SIDE, samples)
    assert np.array_equal(found, covered(corners, SIDE, SIDE, standard(samples)))


@examples(1.5)
@given(
    st.tuples(st.integers(0, 2048), st.integers(0, 2048)),
    st.tuples(st.integers(-2048, 2048), st.integers(-2048, 2048)),
    st.tuples(st.integers(-1, 1), st.integers(-1, 1)),
    st.sampled_from(sorted(STANDARD)),
)
def test_slivers_of_a_256th_pixel(
    start: tuple[int, int], along: tuple[int, int], off: tuple[int, int], samples: int
) -> None:
    corners = np.array(
        [start, np.add(start, along), np.add(np.add(start, along), off)], dtype=np.int64
    )
    found = masks(rows(corners[None], SIDE, SIDE, standard(samples)), SIDE, SIDE, samples)
    assert np.array_equal(found, covered(corners, SIDE, SIDE, standard(samples)))


@pytest.mark.parametrize("upright", [True, False], ids=["upright", "lying"])
@pytest.mark.parametrize(("place", "count"), [(127, 0), (128, SIDE), (129, 0)])
def test_a_wire_of_a_256th_pixel_hits_the_centres_that_it_begins_on_and_no_others(
    place: int, count: int, upright: bool
) -> None:
    """Two triangles, a rectangle from `place` to the next sub-pixel position and the picture's
    length: area 8/256, and 8 samples or 0.
    """
    length = SIDE * SUBPIXELS
    a, b, c, d = (place, 0), (place + 1, 0), (place, length), (place + 1, length)
    wire = np.array([(a, b, c), (b, d, c)])
    found = hits(rows(wire if upright else wire[..., ::-1], SIDE, SIDE, standard(1)), SIDE, SIDE)
    assert found.sum() == count
    assert np.count_nonzero(found[:, 0] if upright else found[0]) == count


@examples(1.5)
@given(st.data(), st.sampled_from(sorted(STANDARD)))
def test_corners_on_samples_and_on_the_corners_of_pixels(data: st.DataObject, samples: int) -> None:
    places = [(int(x), int(y)) for x, y in standard(samples)] + [(0, 0)]
    corner = st.tuples(st.integers(0, SIDE), st.integers(0, SIDE), st.sampled_from(places))
    corners = np.array(
        [
            (SUBPIXELS * column + x, SUBPIXELS * row + y)
            for column, row, (x, y) in (data.draw(corner) for _ in range(3))
        ],
        dtype=np.int64,
    )
    found = masks(rows(corners[None], SIDE, SIDE, standard(samples)), SIDE, SIDE, samples)
    assert np.array_equal(found, covered(corners, SIDE, SIDE, standard(samples)))


def test_an_edge_of_ten_thousand_pixels_exactly_through_a_sample_of_every_pixel() -> None:
    """A diagonal through all centres: samples on it are in the triangle that has it as its left
    edge, and not in the other.
    """
    far = 10_000 * SUBPIXELS
    below = np.array([[(128, 128), (128 + far, 128 + far), (128, 128 + far)]])
    above = np.array([[(128, 128), (128 + far, 128), (128 + far, 128 + far)]])
    column, row = np.meshgrid(np.arange(SIDE), np.arange(SIDE))
    assert np.array_equal(
        masks(rows(below, SIDE, SIDE, standard(1)), SIDE, SIDE, 1)[..., 0], row > column
    )
    assert np.array_equal(
        masks(rows(above, SIDE, SIDE, standard(1)), SIDE, SIDE, 1)[..., 0], row <= column
    )
