"""Coverage is what the edge functions in whole numbers say it is, sample by sample."""

from __future__ import annotations

import itertools
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from msaa_lint.experiments.study import coverage
from msaa_lint.experiments.study.coverage import Rows, rows
from msaa_lint.experiments.study.locations import SUBPIXELS, standard
from msaa_lint.frame.vulkan.sample_locations import STANDARD
from tests.experiments.study.rational import covered
from tests.experiments.study.spans import grid, jittered, masks, random
from tests.strength import examples

WIDTH, HEIGHT = 5, 4

FREE = st.integers(-2 * SUBPIXELS, 7 * SUBPIXELS)
ON_SAMPLES = st.integers(-32, 112).map(lambda n: n * 16)
ON_CORNERS = st.integers(-2, 7).map(lambda n: n * SUBPIXELS)
NEAR_CENTRES = st.tuples(st.integers(-2, 7), st.integers(-1, 1)).map(
    lambda pair: pair[0] * SUBPIXELS + 128 + pair[1]
)
FAR = st.integers(-(2**31), 2**31)
PLACES = st.one_of(FREE, ON_SAMPLES, ON_CORNERS, NEAR_CENTRES, FAR)
COUNTS = st.sampled_from(sorted(STANDARD))


def triangles(
    places: st.SearchStrategy[int] = PLACES, most: int = 1
) -> st.SearchStrategy[NDArray[np.int64]]:
    corner = st.tuples(places, places)
    return st.lists(st.tuples(corner, corner, corner), min_size=1, max_size=most).map(
        lambda given: np.array(given, dtype=np.int64)
    )


def drawn(
    corners: NDArray[np.int64], samples: int, width: int = WIDTH, height: int = HEIGHT
) -> NDArray[np.bool_]:
    return masks(rows(corners, width, height, standard(samples)), width, height, samples)


def same(one: Rows, other: Rows) -> bool:
    return all(np.array_equal(a, b) and a.dtype == b.dtype for a, b in zip(one, other, strict=True))


@examples(4)
@given(triangles(), COUNTS)
def test_every_sample_is_what_its_edge_functions_say(
    corners: NDArray[np.int64], samples: int
) -> None:
    assert np.array_equal(
        drawn(corners, samples), covered(corners[0], WIDTH, HEIGHT, standard(samples))
    )


@examples(1)
@given(
    triangles(),
    st.lists(st.tuples(st.integers(0, 255), st.integers(0, 255)), min_size=1, max_size=9),
)
def test_samples_may_lie_anywhere_in_the_pixel(
    corners: NDArray[np.int64], places: list[tuple[int, int]]
) -> None:
    locations = np.array(places, dtype=np.int64)
    found = masks(rows(corners, WIDTH, HEIGHT, locations), WIDTH, HEIGHT, len(places))
    assert np.array_equal(found, covered(corners[0], WIDTH, HEIGHT, locations))


@examples(0.6)
@given(triangles(), COUNTS)
def test_neither_winding_nor_the_first_corner_matters(
    corners: NDArray[np.int64], samples: int
) -> None:
    expected = rows(corners, WIDTH, HEIGHT, standard(samples))
    for order in itertools.permutations(range(3)):
        assert same(rows(corners[:, order], WIDTH, HEIGHT, standard(samples)), expected)


@examples(1)
@given(
    triangles(st.integers(0, 4 * SUBPIXELS)), COUNTS, st.integers(0, 2**22), st.integers(0, 2000)
)
def test_whole_pixels_to_the_side_or_down_change_nothing_else(
    corners: NDArray[np.int64], samples: int, across: int, down: int
) -> None:
    here = rows(corners, WIDTH, HEIGHT, standard(samples))
    there = rows(
        corners + SUBPIXELS * np.array([across, down]),
        WIDTH + across,
        HEIGHT + down,
        standard(samples),
    )
    empty = here.left == here.right
    assert np.array_equal(there.row, here.row + down)
    assert np.array_equal(there.left, np.where(empty, 0, here.left + across))
    assert np.array_equal(there.right, np.where(empty, 0, here.right + across))


@examples(1)
@given(triangles(most=12), COUNTS, st.integers(1, 9))
def test_many_triangles_are_each_as_alone(
    corners: NDArray[np.int64], samples: int, chunk: int
) -> None:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(coverage, "CHUNK", chunk)
        found = rows(corners, WIDTH, HEIGHT, standard(samples))
    alone = [
        rows(corners[n : n + 1], WIDTH, HEIGHT, standard(samples)) for n in range(len(corners))
    ]
    named = [each._replace(triangle=each.triangle + np.int32(n)) for n, each in enumerate(alone)]
    assert same(found, Rows(*(np.concatenate(column) for column in zip(*named, strict=True))))


def test_near_and_far_triangles_come_back_in_their_order() -> None:
    """Those of Python's integers are solved apart from those of int64."""
    near, far = (
        [(0, 0), (700, 0), (0, 700)],
        [(-(2**31), -(2**31)), (2**31, -(2**31)), (500, 2**31)],
    )
    found = rows(np.array([far, near, far, near, near, far]), WIDTH, HEIGHT, standard(4))
    assert sorted(set(found.triangle.tolist())) == [0, 1, 2, 3, 4, 5]
    order = list(zip(found.triangle.tolist(), found.row.tolist(), strict=True))
    assert order == sorted(order)
    for n, corners in enumerate((far, near)):
        alone, own = rows(np.array([corners]), WIDTH, HEIGHT, standard(4)), found.triangle == n
        assert np.array_equal(found.left[own], alone.left)
        assert np.array_equal(found.right[own], alone.right)


@examples(1)
@given(triangles(most=12), COUNTS)
def test_python_s_integers_give_what_int64_gives(corners: NDArray[np.int64], samples: int) -> None:
    expected = rows(corners, WIDTH, HEIGHT, standard(samples))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(coverage, "MAX_SUM", 0.0)
        assert same(rows(corners, WIDTH, HEIGHT, standard(samples)), expected)


@examples(1)
@given(triangles(most=12), COUNTS)
def test_rows_are_in_order_within_the_picture_and_none_is_empty(
    corners: NDArray[np.int64], samples: int
) -> None:
    found = rows(corners, WIDTH, HEIGHT, standard(samples))
    assert [each.dtype for each in found] == [np.dtype(np.int32)] * 4
    assert found.left.shape == found.right.shape == (len(found.triangle), samples)
    order = list(zip(found.triangle.tolist(), found.row.tolist(), strict=True))
    assert order == sorted(set(order))
    assert bool((found.left < found.right).any(axis=1).all())
    empty = found.left == found.right
    assert not found.left[empty].any()
    assert bool(((found.left >= 0) & (found.left <= found.right) & (found.right <= WIDTH)).all())
    assert bool(((found.row >= 0) & (found.row < HEIGHT)).all())


@pytest.mark.parametrize(
    "corners",
    [
        [(300, 300), (300, 300), (300, 300)],
        [(0, 0), (512, 512), (1024, 1024)],
        [(128, 0), (128, 512), (128, 1024)],
        [(0, 128), (512, 128), (1024, 128)],
        [(0, 0), (1000, 300), (1000, 300)],
        [(-(2**31), -(2**31)), (0, 0), (2**31, 2**31)],
    ],
    ids=[
        "a point",
        "a diagonal through centres",
        "a column of centres",
        "a row of centres",
        "two corners in one place",
        "far corners",
    ],
)
def test_triangles_without_area_cover_nothing(corners: list[tuple[int, int]]) -> None:
    for samples in STANDARD:
        found = rows(np.array([corners]), WIDTH, HEIGHT, standard(samples))
        assert len(found.row) == 0
        assert found.left.shape == (0, samples)


def test_of_a_pixel_s_four_sides_the_top_and_the_left_are_its_own() -> None:
    """A square from centre to centre has its top left centre and none of the other three."""
    square = np.array([[(128, 128), (384, 128), (128, 384)], [(384, 128), (384, 384), (128, 384)]])
    assert np.argwhere(drawn(square, 1)).tolist() == [[0, 0, 0]]
    # Both triangles together have it once.
    assert rows(square, WIDTH, HEIGHT, standard(1)).triangle.tolist() == [0]


def test_samples_on_a_pixel_s_border_belong_to_the_pixel_that_begins_there() -> None:
    """Samples 12 and 15 of the pattern of 16 lie on the left and on the upper side of their
    pixel.
    """
    pixel = np.array([[(256, 256), (512, 256), (256, 512)], [(512, 256), (512, 512), (256, 512)]])
    found = drawn(pixel, 16)
    assert bool(found[1, 1].all())
    assert found.sum() == 16


def test_nothing_is_drawn_outside_and_no_triangles_are_no_rows() -> None:
    outside = np.array(
        [
            [(-900, 0), (-1, 0), (-1, 900)],
            [(1280, 0), (1900, 0), (1900, 900)],
            [(0, -900), (900, -900), (0, 0)],
        ]
    )
    assert len(rows(outside, WIDTH, HEIGHT, standard(16)).row) == 0
    none = rows(np.zeros((0, 3, 2), dtype=np.int64), WIDTH, HEIGHT, standard(4))
    assert none.left.shape == none.right.shape == (0, 4)


ONE = np.zeros((1, 3, 2), dtype=np.int64)


@pytest.mark.parametrize(
    ("corners", "locations", "says"),
    [
        (np.zeros((1, 3, 2)), standard(4), "snap them first"),
        (ONE, standard(4) / 256, "snap them first"),
        (ONE[0], standard(4), r"\(T, 3, 2\)"),
        (ONE, standard(4)[0], r"\(N, 2\)"),
        (ONE, np.zeros((0, 2), dtype=np.int64), r"\(N, 2\)"),
        (ONE, np.array([(256, 0)]), "outside its pixel"),
        (ONE, np.array([(0, -1)]), "outside its pixel"),
        (ONE + 2**60 + 1, standard(4), "farther than"),
        (np.full_like(ONE, -(2**63)), standard(4), "farther than"),
    ],
)
def test_what_is_no_triangle_or_no_location_is_refused(
    corners: NDArray[Any], locations: NDArray[Any], says: str
) -> None:
    with pytest.raises(ValueError, match=says):
        rows(corners, WIDTH, HEIGHT, locations)


@examples(0.6)
@given(triangles(FREE), st.integers(1, 4))
def test_a_grid_takes_the_samples_of_a_larger_picture(
    corners: NDArray[np.int64], side: int
) -> None:
    large = drawn(corners * side, 1, WIDTH * side, HEIGHT * side)[..., 0]
    found = masks(
        rows(corners * side, WIDTH, HEIGHT, grid(side), SUBPIXELS * side),
        WIDTH,
        HEIGHT,
        side * side,
    )
    tiles = large.reshape(HEIGHT, side, WIDTH, side).transpose(0, 2, 1, 3)
    assert np.array_equal(found, tiles.reshape(HEIGHT, WIDTH, side * side))


def test_a_grid_of_three_has_its_centres_at_sixths() -> None:
    assert (grid(3)[:, 0] * 6).tolist() == [n * 3 * SUBPIXELS for n in (1, 3, 5)] * 3
    assert (grid(3)[:, 1] * 6).tolist() == [n * 3 * SUBPIXELS for n in (1, 1, 1, 3, 3, 3, 5, 5, 5)]


@pytest.mark.parametrize(("samples", "mean"), [(1, 128), (2, 128), (4, 128), (8, 128), (16, 120)])
def test_the_means_of_the_standard_patterns(samples: int, mean: int) -> None:
    """The middle of the pixel, but 15/32 at 16 samples: that pattern moves every edge by 1/32
    pixel.
    """
    assert (standard(samples).sum(axis=0) == mean * samples).all()
    assert mean * 32 == SUBPIXELS * (15 if samples == 16 else 16)


def test_the_order_of_samples_is_that_of_the_specification_s_table() -> None:
    """In pixels, as it is printed there."""
    eight = (
        "(0.5625,0.3125) (0.4375,0.6875) (0.8125,0.5625) (0.3125,0.1875) (0.1875,0.8125) "
        "(0.0625,0.4375) (0.6875,0.9375) (0.9375,0.0625)"
    )
    sixteen = (
        "(0.5625,0.5625) (0.4375,0.3125) (0.3125,0.625) (0.75,0.4375) (0.1875,0.375) "
        "(0.625,0.8125) (0.8125,0.6875) (0.6875,0.1875) "
        "(0.375,0.875) (0.5,0.0625) (0.25,0.125) (0.125,0.75) (0.0,0.5) (0.9375,0.25) "
        "(0.875,0.9375) (0.0625,0.0)"
    )
    four = "(0.375,0.125) (0.875,0.375) (0.125,0.625) (0.625,0.875)"
    for samples, table in {
        1: "(0.5,0.5)",
        2: "(0.75,0.75) (0.25,0.25)",
        4: four,
        8: eight,
        16: sixteen,
    }.items():
        places = [
            tuple(float(number) for number in place.strip("()").split(","))
            for place in table.split()
        ]
        assert (standard(samples) / SUBPIXELS).tolist() == [list(place) for place in places]


def test_the_standard_patterns_have_every_row_and_column_once() -> None:
    for samples in STANDARD:
        places = standard(samples)
        assert places.shape == (samples, 2)
        assert len(set(places[:, 0].tolist())) == len(set(places[:, 1].tolist())) == samples
        assert (places % 16 == 0).all()


@pytest.mark.parametrize("samples", [0, 3, 6, 32, 64, -1])
def test_other_counts_have_no_standard_pattern(samples: int) -> None:
    with pytest.raises(ValueError, match=f"for {samples} samples, only for 1, 2, 4, 8, 16"):
        standard(samples)


@examples(0.5)
@given(st.integers(1, 20), st.integers(0, 2**32), st.sampled_from([256, 1000, 65536]))
def test_jittered_samples_have_a_cell_each(side: int, seed: int, subpixels: int) -> None:
    places = jittered(side, seed, subpixels)
    # A position is rounded down by less than a step.
    low, high = np.floor(places * side / subpixels), np.floor((places + 1) * side / subpixels)
    cells = np.stack(np.meshgrid(np.arange(side), np.arange(side)), axis=-1).reshape(-1, 2)
    assert bool(((low <= cells) & (cells <= high)).all())
    assert np.array_equal(places, jittered(side, seed, subpixels))


def test_random_samples_are_even_and_a_seed_s_own() -> None:
    places = random(100_000, 7)
    assert places.shape == (100_000, 2)
    assert np.array_equal(places, random(100_000, 7))
    assert not np.array_equal(places, random(100_000, 8))
    assert places.min() == 0
    assert places.max() == SUBPIXELS - 1
    # Eight standard deviations of the mean of as many.
    assert abs(places.mean() - 127.5) < 8 * 256 / np.sqrt(12 * 200_000)
