"""Fragments and masks are the covered samples, and nothing else, however many triangles there
are.
"""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from numpy.typing import NDArray

from msaa_lint.experiments.study.coverage import rows
from msaa_lint.experiments.study.fragments import fragments
from msaa_lint.experiments.study.locations import SUBPIXELS, standard
from tests.experiments.study.rational import covered
from tests.experiments.study.spans import grid, hits, jittered, masks
from tests.experiments.study.test_coverage import COUNTS, HEIGHT, WIDTH, triangles
from tests.strength import examples

PIXEL = [(0, 0), (2 * SUBPIXELS, 0), (0, 2 * SUBPIXELS)]
"""A triangle that has the whole first pixel."""


def each(corners: NDArray[np.int64], samples: int) -> NDArray[np.bool_]:
    """What every triangle covers: (T, height, width, samples)."""
    return np.stack([covered(triangle, WIDTH, HEIGHT, standard(samples)) for triangle in corners])


@examples(1)
@given(triangles(most=4), COUNTS)
def test_fragments_are_the_pixels_with_a_covered_sample_in_order(
    corners: NDArray[np.int64], samples: int
) -> None:
    exact = each(corners, samples)
    found = fragments(rows(corners, WIDTH, HEIGHT, standard(samples)), samples)
    triangle, y, x = np.nonzero(exact.any(axis=-1))
    assert np.array_equal(found.triangle, triangle)
    assert np.array_equal(found.y, y)
    assert np.array_equal(found.x, x)
    assert np.array_equal(found.mask, exact[triangle, y, x] @ (1 << np.arange(samples)))
    assert [part.dtype for part in found] == [np.dtype(np.int32)] * 3 + [np.dtype(np.uint16)]


@examples(1)
@given(triangles(most=5), COUNTS)
def test_masks_are_what_any_triangle_covers_and_hits_count_them(
    corners: NDArray[np.int64], samples: int
) -> None:
    exact = each(corners, samples)
    found = rows(corners, WIDTH, HEIGHT, standard(samples))
    assert np.array_equal(masks(found, WIDTH, HEIGHT, samples), exact.any(axis=0))
    assert np.array_equal(hits(found, WIDTH, HEIGHT), exact.sum(axis=(0, 3)))


def test_pixels_between_the_samples_of_a_narrow_triangle_are_no_fragments() -> None:
    """A needle that has one sample of the second pixel and the other of the eleventh, and crosses
    those between.
    """
    locations = np.array([(0, 0), (0, 128)])
    needle = np.array([[(256, 0), (260, 0), (3856, 200)]])
    found = fragments(rows(needle, 12, 1, locations), 2)
    assert found.x.tolist() == [1, 10]
    assert found.mask.tolist() == [1, 2]
    assert found.y.tolist() == found.triangle.tolist() == [0, 0]


@pytest.mark.parametrize("count", [1, 2, 255, 256, 257, 65535, 65536, 65537])
@pytest.mark.parametrize("samples", [1, 4, 16])
def test_however_many_triangles_cover_a_sample_its_neighbours_are_not_touched(
    count: int, samples: int
) -> None:
    found = rows(np.array([PIXEL] * count), 3, 2, standard(samples))
    exact = covered(np.array(PIXEL), 3, 2, standard(samples))
    assert np.array_equal(masks(found, 3, 2, samples), exact)
    assert np.array_equal(hits(found, 3, 2), exact.sum(axis=2) * count)


@pytest.mark.parametrize("side", [3, 5, 20])
def test_masks_and_hits_take_any_count_of_samples(side: int) -> None:
    corners = np.array([PIXEL, [(700, 30), (70, 400), (900, 1000)]])
    for subpixels, locations in ((SUBPIXELS * side, grid(side)), (SUBPIXELS, jittered(side, 1))):
        scale = subpixels // SUBPIXELS
        found = rows(corners * scale, 4, 4, locations, subpixels)
        exact = np.stack(
            [covered(triangle * scale, 4, 4, locations, subpixels) for triangle in corners]
        )
        drawn = masks(found, 4, 4, side * side)
        assert np.array_equal(drawn, exact.any(axis=0))
        assert np.array_equal(hits(found, 4, 4), exact.sum(axis=(0, 3)))


def test_nothing_covered_is_no_fragments_and_an_empty_picture() -> None:
    none = rows(np.zeros((0, 3, 2), dtype=np.int64), 3, 2, standard(4))
    assert [len(part) for part in fragments(none, 4)] == [0, 0, 0, 0]
    assert not masks(none, 3, 2, 4).any()
    assert not hits(none, 3, 2).any()


def test_spans_of_another_count_and_more_samples_than_a_mask_holds_are_refused() -> None:
    spans = rows(np.array([PIXEL]), 3, 2, standard(4))
    with pytest.raises(ValueError, match=r"spans of 8 samples, found 4"):
        fragments(spans, 8)
    many = rows(np.array([PIXEL]), 3, 2, jittered(5, 1))
    with pytest.raises(ValueError, match="a mask holds at most 16 samples, found 25"):
        fragments(many, 25)
