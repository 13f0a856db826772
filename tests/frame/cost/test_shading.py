"""Fragment shader invocations, against the guides' table, the laws of areas and a count of
samples.
"""

from __future__ import annotations

from itertools import product

import pytest

from msaa_lint.frame.cost.shading import EDGES, shaded_samples, supersampling
from msaa_lint.frame.vulkan.sample_locations import STANDARD
from tests.frame.cost.frames import cost, of_pass
from tests.frame.cost.triangles import edge_term, hull, invocations_at_most, invocations_per_area

MEASURED = {
    1: (1.00, 2.00, 3.32, 4.08, 5.28),
    2: (1.00, 1.75, 2.19, 2.48, 2.97),
    4: (1.00, 1.43, 1.61, 1.71, 1.95),
    8: (1.00, 1.24, 1.31, 1.35, 1.46),
    16: (1, 1.12, 1.15, 1.17, 1.23),
    32: (1, 1.06, 1.08, 1.09, 1.11),
}
"""Fragments by area at 1, 2, 4, 8 and 16 samples, of a right triangle by its legs in pixels: a
Monte Carlo count, good to one per cent.
"""

COUNTS = (1, 2, 4, 8, 16)


@pytest.mark.parametrize("leg", MEASURED)
def test_agrees_with_the_count_of_random_triangles(leg: int) -> None:
    for samples, measured in zip(COUNTS, MEASURED[leg], strict=True):
        assert invocations_per_area(leg, samples) == pytest.approx(measured, rel=0.01)


@pytest.mark.parametrize(("leg", "samples"), list(product((1, 2, 3), COUNTS)))
def test_agrees_with_every_position_on_a_fine_grid(leg: int, samples: int) -> None:
    """The mean over 64 x 64 positions of how many pixels have a sample inside, counted sample by
    sample.
    """
    grid = 64
    count = 0
    for u, v in product(range(grid), repeat=2):
        # In sixty-fourths of a pixel, where no sample lies on an edge.
        left, low = u + 0.3, v + 0.45
        side = leg * grid
        for x, y in product(range(-1, leg + 2), repeat=2):
            count += any(
                left < (sx := x * grid + a * 4)
                and low < (sy := y * grid + b * 4)
                and (sx - left) + (sy - low) < side
                for a, b in STANDARD[samples]
            )
    assert invocations_per_area(leg, samples) == pytest.approx(
        count / grid**2 / (leg * leg / 2), rel=0.02
    )


@pytest.mark.parametrize(("leg", "samples"), list(product((1, 2, 4, 8, 16, 32), COUNTS)))
def test_table_is_fresh(leg: int, samples: int) -> None:
    assert dict(EDGES[samples])[leg] == round(invocations_per_area(leg, samples), 4)


@pytest.mark.parametrize(("leg", "samples"), list(product((1, 2, 4, 8, 16, 32, 64), COUNTS)))
def test_the_hull_bounds_it(leg: int, samples: int) -> None:
    exact, bound = invocations_per_area(leg, samples), invocations_at_most(leg, samples)
    assert 1 <= exact <= bound + 1e-12
    assert exact <= samples


def test_the_hull_is_tight_for_large_triangles() -> None:
    for samples in COUNTS:
        assert invocations_per_area(256, samples) == pytest.approx(
            invocations_at_most(256, samples), abs=1e-4
        )


def test_mixed_area_of_four_samples() -> None:
    """The hull is a square of area 0.3125; along the legs it reaches 6/16, along the third side (1,
    1) 8/16: 2 V = 1.25 L.
    """
    assert len(hull(STANDARD[4])) == 4
    assert edge_term(4, 4) == (5.0, 0.3125)
    assert edge_term(4, 1) == (0.0, 0.0)


def test_standard_locations_are_distinct_in_x_and_y() -> None:
    for samples, places in STANDARD.items():
        assert len(places) == samples == len({x for x, _ in places}) == len({y for _, y in places})


@pytest.mark.parametrize(
    ("minimum", "expected"),
    [
        (0.2, (1, 1, 2, 4)),
        (0.25, (1, 1, 2, 4)),
        (0.5, (1, 2, 4, 8)),
        (1.0, (2, 4, 8, 16)),
        (0.0, (1, 1, 1, 1)),
    ],
)
def test_sample_shading(minimum: float, expected: tuple[int, ...]) -> None:
    assert tuple(shaded_samples(minimum, samples) for samples in (2, 4, 8, 16)) == expected


def test_supersampling_takes_the_next_square() -> None:
    assert [supersampling(samples) for samples in (1, 2, 4, 8, 16, 32, 64)] == [
        1,
        4,
        4,
        9,
        16,
        36,
        64,
    ]


PASS = """
frame: {width: 1000, height: 1000, fps: 60}
renderPasses:
  forward:
    attachments: [{format: R8G8B8A8_UNORM, samples: 8}]
    subpasses: [{colorAttachments: [0]}]
"""


def test_a_pass_in_millions() -> None:
    found = of_pass(cost(PASS), "forward").shading
    assert found is not None
    assert (found.pixels, found.samples) == (1_000_000, 8)
    assert (found.msaa, found.sample_shading, found.super_sampling, found.demanded) == (
        1.0,
        8.0,
        9.0,
        None,
    )
    assert found.edges == EDGES[8]


@pytest.mark.parametrize(
    ("state", "demanded"),
    [
        ("{sampleShadingEnable: true, minSampleShading: 0.5}", 4.0),
        ("{sampleShadingEnable: true, minSampleShading: 1.0e+300}", 8.0),
        ("{sampleShadingEnable: true, minSampleShading: -1.0e+300}", 1.0),
        ("{sampleShadingEnable: true}", None),
        ("{sampleShadingEnable: false}", 1.0),
        ("{rasterizationSamples: 8}", None),
    ],
)
def test_what_a_pipeline_demands(state: str, demanded: float | None) -> None:
    text = f"{PASS}pipelines: {{opaque: {{renderPass: forward, multisampleState: {state}}}}}\n"
    found = of_pass(cost(text), "forward").shading
    assert found is not None
    assert found.demanded == demanded
