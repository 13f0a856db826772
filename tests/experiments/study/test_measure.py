"""Errors against closed forms: edges along the axes, the bias of 16 samples, perfect agreement,
sums in double precision.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from msaa_lint.experiments.study import displayed, measure, shade, simulate, sums
from msaa_lint.experiments.study.points import COUNTS, MSAA, SAMPLE_SHADING, SSAA, Technique
from msaa_lint.experiments.study.scenes import area, scene, shapes
from msaa_lint.experiments.study.scenes.scene import WHITE, Scene
from msaa_lint.experiments.study.scenes.view import Truth, View

LENGTH = 2048
"""Pixels in which an edge moves by one pixel: it is everywhere within a pixel, evenly."""


def drawn(
    polygons: Sequence[Sequence[shapes.Point]], width: int, height: int, **changed: object
) -> Scene:
    """White polygons that do not overlap, on black."""
    made = shapes.triangles(polygons)
    colors = shapes.uniform_colors(len(made), WHITE)
    exact = area.disjoint(colors)
    return Scene(width, height, made, colors, exact, name="polygons")._replace(**changed)  # type: ignore[arg-type]


def edge(upright: bool, turned: bool = False) -> Scene:
    """One edge as good as along an axis; what is left of it, or above, is white, or `turned` what
    is not.
    """
    left: list[shapes.Point] = [(0, 0), (1, 0), (2, LENGTH), (0, LENGTH)]
    right: list[shapes.Point] = [(1, 0), (3, 0), (3, LENGTH), (2, LENGTH)]
    shape = right if turned else left
    return drawn([shape], 3, LENGTH) if upright else drawn([[(y, x) for x, y in shape]], LENGTH, 3)


@pytest.mark.parametrize("upright", [True, False])
@pytest.mark.parametrize("count", COUNTS)
def test_the_error_of_axis_aligned_edges_has_a_closed_form(count: int, upright: bool) -> None:
    """1 / (n sqrt(12)) for n places of samples along the axis, evenly spread; 16 samples are 1/32
    pixel off besides.
    """
    found = measure.point(edge(upright), Technique(MSAA, count))
    shift = 1 / 32 if count == 16 else 0.0
    assert found.rmse == pytest.approx(math.hypot(1 / (count * math.sqrt(12)), shift), rel=0.01)
    assert found.edge_pixels == LENGTH


@pytest.mark.parametrize("grid", [2, 3, 4])
def test_supersampling_has_as_many_places_along_an_axis_as_its_grid(grid: int) -> None:
    assert measure.point(edge(True), Technique(SSAA, grid * grid, grid=grid)).rmse == pytest.approx(
        1 / (grid * math.sqrt(12)), rel=0.01
    )


@pytest.mark.parametrize("upright", [True, False])
@pytest.mark.parametrize("count", COUNTS)
def test_the_bias_of_edges_is_that_of_the_pattern(count: int, upright: bool) -> None:
    """The 16 samples' mean is 1/32 pixel left of and above the middle: so much more of what lies
    there is covered, and less of the rest.
    """
    shift = 1 / 32 if count == 16 else 0.0
    assert measure.point(edge(upright), Technique(MSAA, count)).bias == pytest.approx(
        shift, abs=2e-4
    )
    assert measure.point(edge(upright, turned=True), Technique(MSAA, count)).bias == pytest.approx(
        -shift, abs=2e-4
    )


@pytest.mark.parametrize(
    "technique",
    [Technique(MSAA, 16), Technique(SAMPLE_SHADING, 8, 1.0), Technique(SSAA, 9, grid=3)],
)
def test_what_agrees_perfectly_has_no_error_and_infinite_psnr(technique: Technique) -> None:
    found = measure.point(drawn([shapes.rectangle(4, 8, 20, 24)], 32, 32), technique, ssim=True)
    assert (found.rmse, found.rmse_all, found.max_error, found.bias, found.edge_pixels) == (
        0,
        0,
        0,
        0,
        0,
    )
    assert found.psnr_db == found.psnr_display_db == math.inf
    assert found.ssim == 1.0


def test_a_known_picture_has_known_errors() -> None:
    """A bar that covers a quarter of each of 32 pixels, and the single samples of them none of
    it.
    """
    found = measure.point(drawn([shapes.rectangle(0, 0, 32, 0.25)], 32, 32), Technique(MSAA, 1))
    assert found.edge_pixels == 32
    assert (found.rmse, found.max_error, found.bias) == (0.25, 0.25, -0.25)
    assert found.rmse_all == pytest.approx(0.25 / math.sqrt(32))
    assert found.psnr_db == pytest.approx(-10 * math.log10(0.25**2 / 32))
    code = 1.055 * 0.25 ** (1 / 2.4) - 0.055
    assert found.psnr_display_db == pytest.approx(-10 * math.log10(code**2 / 32), rel=1e-6)


def test_ssim_is_lower_the_worse_it_looks() -> None:
    made = scene("siemens-star", 96, 96)
    one, four, sixteen = (
        measure.point(made, Technique(MSAA, count), ssim=True).ssim for count in (1, 4, 16)
    )
    assert one is not None and four is not None and sixteen is not None
    assert one < four < sixteen < 1
    assert measure.point(made, Technique(MSAA, 1)).ssim is None


@pytest.mark.parametrize("bits", [4, 8])
def test_errors_are_of_the_snapped_corners(bits: int) -> None:
    """A bar whose edge lies between the steps that the device has: the samples find the snapped
    one's area exactly.
    """
    made = drawn([shapes.rectangle(0, 0, 32, 8 + 0.5 + 0.3 / 256)], 32, 32)
    assert measure.point(made, Technique(MSAA, 2), bits).rmse == 0
    assert (measure.truth(made, bits=bits).image[8] == 0.5).all()


@given(st.lists(st.integers(-(2**20), 2**20), max_size=200))
def test_sums_of_whole_numbers_are_exact(numbers: list[int]) -> None:
    assert sums.total(np.array(numbers, np.float32)) == sum(numbers)


def test_sums_do_not_stop_where_single_precision_does() -> None:
    ones = np.ones((3, (2**24 + 5) // 3 + 1), np.float32)
    assert float(np.cumsum(ones.ravel(), dtype=np.float32)[-1]) == 2**24
    assert sums.total(ones) == ones.size


@pytest.mark.parametrize("shape", [(1_000_000, 3), (3, 1_000_000), (3_000_000,)])
def test_sums_do_not_depend_on_the_shape(shape: tuple[int, ...]) -> None:
    values = np.resize(np.array([0.1, 1e6, 3e-7, 2.5]), 3_000_000)
    assert sums.total(values.reshape(shape)) == sums.total(values)
    assert sums.total(values) == pytest.approx(math.fsum(values), rel=1e-12)


def test_infinity_and_nan_are_neither_hidden_nor_made() -> None:
    measured, exact = np.array([math.inf, 1.0, -math.inf]), np.array([math.inf, 0.5, -math.inf])
    assert sums.difference(measured, exact).tolist() == [0.0, 0.5, 0.0]
    for value, rmse, psnr in ((math.inf, math.inf, -math.inf), (math.nan, math.nan, math.nan)):
        errors, squares = sums.ErrorSum(), sums.Sum()
        differences = sums.difference(np.array([value]), np.array([1.0]))
        errors.add(differences)
        squares.add(differences * differences)
        assert (errors.errors().rmse, squares.psnr()) == pytest.approx((rmse, psnr), nan_ok=True)
    assert math.isnan(sums.total(np.array([math.inf, -math.inf])))


def test_differences_are_made_in_double_precision() -> None:
    third = np.array([1 / 3], np.float32)
    assert sums.difference(third, np.array([1 / 3]))[0] == float(third[0]) - 1 / 3


@pytest.mark.parametrize(("samples", "invocations"), [(4, 1), (4, 2), (8, 3), (16, 16), (2, 2)])
def test_every_sample_is_shaded_by_one_invocation(samples: int, invocations: int) -> None:
    groups = shade.groups(samples, invocations)
    assert len(groups) == invocations
    assert sum(groups) == (1 << samples) - 1 and all(groups)
    sizes = [bits.bit_count() for bits in groups]
    assert max(sizes) - min(sizes) <= 1


def test_the_simulation_does_not_depend_on_bands(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("mesh", "intersecting", "glass", "foliage"):
        made = scene(name, 80, 48)
        for technique in (Technique(MSAA, 4), Technique(SSAA, 9, grid=3)):
            whole = simulate.simulate(made, technique)
            with monkeypatch.context() as patched:
                patched.setattr(simulate, "BAND_SAMPLES", 1000)
                parts = simulate.simulate(made, technique)
            assert np.array_equal(whole.image, parts.image)


def test_light_that_a_scene_does_not_map_is_shown_mapped() -> None:
    """A quarter of a pixel of light 3 times display white, which Reinhard's curve maps to 3/7, and
    one sample that sees none of it.
    """
    bar = drawn([shapes.rectangle(0, 0, 32, 0.25)], 32, 32)
    exact = bar.exact

    def bright(view: View) -> Truth:
        image, edges = exact(view)
        return Truth(image * (3, 3, 3, 1), edges)

    made = bar._replace(colors=bar.colors * (3, 3, 3, 1), exact=bright, coverage_matter=False)
    code = {light: 1.055 * light ** (1 / 2.4) - 0.055 for light in (0.75, 0.75 / 1.75)}
    for effects, light in (((), 0.75), (("hdr",), 0.75 / 1.75)):
        found = measure.point(made._replace(effects=effects), Technique(MSAA, 1))
        assert found.psnr_display_db == pytest.approx(
            -10 * math.log10(code[light] ** 2 / 32), rel=1e-6
        )


def test_flip_is_0_where_nothing_differs_and_falls_with_more_samples() -> None:
    made = scene("siemens-star", 96, 96)
    one, sixteen = (
        measure.point(made, Technique(MSAA, count), flip=True).flip for count in (1, 16)
    )
    assert one is not None and sixteen is not None and 0 < sixteen < one < 1
    black, white = np.zeros((8, 8, 3), np.float32), np.ones((8, 8, 3), np.float32)
    assert displayed.flip(black, black) == 0 and displayed.flip(white, black) > 0.9
    assert displayed.flip(np.full_like(black, np.nan), black) == 0
