"""How errors fall with samples: as theory says of jittered and random ones, and of detail only
where it is shaded.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

from msaa_lint.experiments.study import coverage, exact_area, locations, measure, snap
from msaa_lint.experiments.study.points import COUNTS, MSAA, SAMPLE_SHADING, SSAA, Technique
from msaa_lint.experiments.study.scenes import scene
from tests.experiments.study import spans

FINE = 4096
SIDES = (2, 3, 4, 6, 8)


def slope(samples: Callable[[int, int], NDArray[np.int64]], seeds: int) -> float:
    """The slope of the error of coverage over pixels that an edge crosses, by the number of
    samples, both as logarithms.
    """
    made = scene("edge-fan", 96, 96)
    triangles = snap.snapped(made.triangles) * (FINE // locations.SUBPIXELS)
    area = exact_area.areas_of(triangles / FINE, 96, 96)
    crossed = (area > 1e-9) & (area < 1 - 1e-9)
    sizes, found = [], []
    for side in SIDES:
        squares = []
        for seed in range(seeds):
            places = samples(side, seed)
            hits = spans.hits(coverage.rows(triangles, 96, 96, places, FINE), 96, 96)
            squares.append(np.mean((hits / len(places) - area)[crossed] ** 2))
        sizes.append(np.log(side * side))
        found.append(np.log(np.mean(squares)) / 2)
    return float(np.polyfit(sizes, found, 1)[0])


def test_jittered_samples_converge_with_three_quarters() -> None:
    """Mitchell 1996: the variance at edges falls with N^-3/2."""
    assert slope(lambda side, seed: spans.jittered(side, seed, FINE), 12) == pytest.approx(
        -0.75, abs=0.04
    )


def test_random_samples_converge_with_a_half() -> None:
    assert slope(lambda side, seed: spans.random(side * side, seed, FINE), 24) == pytest.approx(
        -0.5, abs=0.04
    )


@pytest.mark.parametrize(
    "name",
    [
        "edge-fan",
        "near-horizontal",
        "wires",
        "siemens-star",
        "intersecting",
        "portal",
        "silhouette",
        "mesh",
    ],
)
def test_more_samples_are_nearer_at_edges(name: str) -> None:
    made = scene(name, 192, 128)
    errors = [measure.point(made, Technique(MSAA, count)).rmse for count in COUNTS]
    assert errors == sorted(errors, reverse=True)
    assert errors[-1] < errors[0] / 4


def test_sixteen_samples_add_nothing_near_the_axes() -> None:
    made = scene("near-horizontal", 256, 256)
    eight, sixteen = (measure.point(made, Technique(MSAA, count)).rmse for count in (8, 16))
    assert sixteen > 0.9 * eight


def test_coverage_cannot_help_detail_and_shading_can() -> None:
    made = scene("zone-plate", 128, 128)
    one = measure.point(made, Technique(MSAA, 1))
    assert one.rmse > 0.05 and one.edge_pixels == 128 * 128
    for count in COUNTS:
        # Sums of equal numbers, divided: what differs is their rounding.
        assert measure.point(made, Technique(MSAA, count)).rmse == pytest.approx(one.rmse, rel=1e-6)
    shaded = [measure.point(made, Technique(SAMPLE_SHADING, count, 1.0)) for count in (2, 4, 8)]
    assert all(each.rmse < one.rmse * 0.75 for each in shaded)
    grids = [
        measure.point(made, Technique(SSAA, grid * grid, grid=grid)).rmse for grid in (2, 3, 4)
    ]
    assert grids == sorted(grids, reverse=True) and grids[0] < one.rmse / 4


def test_half_of_the_samples_shaded_is_between_one_and_all() -> None:
    made = scene("zone-plate", 96, 96)
    none, half, each = (
        measure.point(made, technique).rmse
        for technique in (
            Technique(MSAA, 4),
            Technique(SAMPLE_SHADING, 4, 0.5),
            Technique(SAMPLE_SHADING, 4, 1.0),
        )
    )
    assert each < half < none


def test_a_fraction_that_shades_one_sample_shades_nothing_more() -> None:
    """minSampleShading 0.25 of 4 samples: max(ceil(0.25 * 4), 1) is 1."""
    made = scene("zone-plate", 64, 64)
    assert (
        measure.point(made, Technique(SAMPLE_SHADING, 4, 0.25)).rmse
        == measure.point(made, Technique(MSAA, 4)).rmse
    )
