"""Triangles that share edges: every sample is hit once, by exactly one of them. No cracks, no
double hits.
"""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from msaa_lint.experiments.study.coverage import Rows, rows
from msaa_lint.experiments.study.locations import SUBPIXELS, standard
from tests.experiments.study.rational import naive
from tests.experiments.study.spans import hits
from tests.experiments.study.test_coverage_hard import SIDE, near_ties

ACROSS, DOWN = 200, 170
SHARED = ACROSS * (DOWN - 1) + DOWN * (ACROSS - 1) + ACROSS * DOWN
"""Edges of a mesh of as many cells, cut in two each, that two triangles share."""


def mesh(unit: int, origin: tuple[int, int], seed: int, cell: int, reach: int) -> NDArray[np.int64]:
    """A triangulated rectangle (T, 3, 2): cells of `cell` units, cut along either diagonal, their
    corners moved by up to `reach` units.

    A unit is `unit` sub-pixel positions; corners that are on the rectangle's border stay on it.
    Every third triangle is turned round.
    """
    random = np.random.default_rng(seed)
    corners = np.stack(np.meshgrid(np.arange(ACROSS + 1), np.arange(DOWN + 1)), axis=-1) * cell
    moved = random.integers(-reach, reach + 1, corners.shape)
    moved[:, [0, -1], 0] = 0
    moved[[0, -1], :, 1] = 0
    corners = (corners + moved) * unit + origin
    a, b, c, d = (
        corners[y : y + DOWN, x : x + ACROSS].reshape(-1, 2)
        for y, x in ((0, 0), (0, 1), (1, 0), (1, 1))
    )
    other = random.integers(0, 2, len(a), dtype=bool)[:, None]
    found = (
        np.where(other, [[a, b, c], [b, d, c]], [[a, b, d], [a, d, c]])
        .swapaxes(1, 2)
        .reshape(-1, 3, 2)
    )
    found[::3] = found[::3, ::-1]
    return found


def twice_area(triangles: NDArray[np.int64]) -> NDArray[np.int64]:
    (x0, y0), (x1, y1), (x2, y2) = np.moveaxis(triangles, 0, -1)
    return np.abs((x1 - x0) * (y2 - y0) - (y1 - y0) * (x2 - x0))


def inside(
    first: tuple[int, int], last: tuple[int, int], place: NDArray[np.int64], width: int, height: int
) -> NDArray[np.bool_]:
    """Whether each pixel's sample lies in a rectangle, which has its top and its left side."""
    x, y = SUBPIXELS * np.arange(width) + place[0], SUBPIXELS * np.arange(height) + place[1]
    down = (y >= first[1]) & (y < last[1])
    return down[:, None] & ((x >= first[0]) & (x < last[0]))


def of_sample(found: Rows, sample: int) -> Rows:
    return found._replace(
        left=found.left[:, sample : sample + 1], right=found.right[:, sample : sample + 1]
    )


KINDS = {
    # name: (unit, cell, reach, origin)
    "anywhere": (1, 4 * SUBPIXELS, SUBPIXELS - 1, (0, 0)),
    "anywhere, begun anywhere": (1, 4 * SUBPIXELS, SUBPIXELS - 1, (357, 1001)),
    "on sixteenths": (16, 64, 15, (96, 32)),
    "on the corners of pixels": (SUBPIXELS, 5, 1, (SUBPIXELS, SUBPIXELS)),
    "less than a pixel": (1, 100, 24, (50, 77)),
}


@pytest.mark.parametrize("samples", [1, 4, 16])
@pytest.mark.parametrize("kind", KINDS)
def test_every_sample_of_a_mesh_is_hit_once(kind: str, samples: int) -> None:
    unit, cell, reach, origin = KINDS[kind]
    triangles = mesh(unit, origin, samples, cell, reach)
    assert SHARED > 100_000
    end = (origin[0] + ACROSS * cell * unit, origin[1] + DOWN * cell * unit)
    assert twice_area(triangles).sum() == 2 * (end[0] - origin[0]) * (end[1] - origin[1])
    width, height = end[0] // SUBPIXELS + 2, end[1] // SUBPIXELS + 2
    found = rows(triangles, width, height, standard(samples))
    for n, place in enumerate(standard(samples)):
        assert np.array_equal(
            hits(of_sample(found, n), width, height), inside(origin, end, place, width, height)
        )


@pytest.mark.parametrize("samples", [1, 2, 4, 8, 16])
def test_edges_that_begin_and_end_on_samples_and_pass_through_them(samples: int) -> None:
    """All corners of the mesh are where the same sample of every second pixel is: that sample is at
    both ends of each of the 100,000 shared edges and in the middle of each.
    """
    own = samples - 1
    origin = tuple((standard(samples)[own] + 2 * SUBPIXELS).tolist())
    triangles = mesh(2 * SUBPIXELS, origin, samples, 5, 1)
    middles = (triangles + np.roll(triangles, 1, axis=1)) // 2
    assert ((triangles - standard(samples)[own]) % SUBPIXELS == 0).all()
    assert ((middles - standard(samples)[own]) % SUBPIXELS == 0).all()
    end = (origin[0] + ACROSS * 10 * SUBPIXELS, origin[1] + DOWN * 10 * SUBPIXELS)
    width, height = end[0] // SUBPIXELS + 2, end[1] // SUBPIXELS + 2
    found = rows(triangles, width, height, standard(samples))
    for n in {0, own}:
        assert np.array_equal(
            hits(of_sample(found, n), width, height),
            inside(origin, end, standard(samples)[n], width, height),
        )


def fan(hub: NDArray[np.int64], far: int, spokes: int, seed: int) -> NDArray[np.int64]:
    """Triangles round a hub, out to corners on the sides of a square `far` sub-pixel positions away
    in which it lies.
    """
    random = np.random.default_rng(seed)
    along = np.sort(random.integers(-far, far, (4, spokes // 4)), axis=1)
    along[:, 0] = -far
    side = np.full_like(along[0], far)
    ring = np.concatenate(
        [
            np.stack(pair, axis=1)
            for pair in ((along[0], -side), (side, along[1]), (-along[2], side), (-side, -along[3]))
        ]
    )
    return np.stack((np.broadcast_to(hub, ring.shape), ring, np.roll(ring, -1, axis=0)), axis=1)


@pytest.mark.parametrize("pixels", [2**10, 2**15, 2**20, 2**22, 2**23])
def test_a_fan_of_far_corners_has_neither_cracks_nor_double_hits(pixels: int) -> None:
    """Hubs on a sample, on a pixel's corner and between; the square is the picture's whole plane,
    so that every sample is in the fan.
    """
    for n, hub in enumerate([(4 * SUBPIXELS + 128, 3 * SUBPIXELS + 128), (1024, 1024), (931, 702)]):
        triangles = fan(np.array(hub), pixels * SUBPIXELS, 64, n)
        found = rows(triangles, SIDE, SIDE, standard(16))
        for sample in range(16):
            assert (hits(of_sample(found, sample), SIDE, SIDE) == 1).all()


@pytest.mark.parametrize("pixels", [64, 256, 2**20])
def test_a_shared_edge_that_just_misses_a_sample(pixels: int) -> None:
    """The sample belongs to one of the two triangles. By edge functions in single precision it
    often belongs to both or to none, and so it does in double precision where the products are
    rounded.
    """
    triangles, missed, which = near_ties(pixels, 400, pixels + 1)
    found = rows(triangles, SIDE, SIDE, standard(16))
    taken = np.zeros(len(triangles), dtype=int)
    column, row, sample = missed[:, 0] // SUBPIXELS, missed[:, 1] // SUBPIXELS, np.array(which)
    pair, span = found.triangle // 2, np.arange(len(found.row))
    own = (
        (found.row == row[pair])
        & (found.left[span, sample[pair]] <= column[pair])
        & (column[pair] < found.right[span, sample[pair]])
    )
    np.add.at(taken, found.triangle[own], 1)
    assert (taken.reshape(-1, 2).sum(axis=1) == 1).all()

    at = np.repeat(missed, 2, axis=0)
    assert (naive(triangles, at, np.float32).reshape(-1, 2).sum(axis=1) != 1).sum() > 20
    assert ((naive(triangles, at, np.float64).reshape(-1, 2).sum(axis=1) != 1).sum() > 20) == (
        pixels == 2**20
    )
