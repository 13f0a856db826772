"""Corners are where a device puts them: the viewport's roundings, and the nearest sub-pixel
position.
"""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from msaa_lint.experiments.study.snap import snapped
from tests.experiments.study.device import viewport
from tests.strength import examples


def single(exact: Fraction) -> float:
    """The single-precision number nearest to an exact one of ordinary size, ties to even."""
    if not exact:
        return 0.0
    step = Fraction(2) ** -149
    while abs(exact) / step >= 2**24:
        step *= 2
    return float(round(exact / step) * step)


@pytest.mark.parametrize(
    ("pixels", "bits", "expected"),
    [
        (0.5 / 256, 8, 0),
        (1.5 / 256, 8, 2),
        (2.5 / 256, 8, 2),
        (-0.5 / 256, 8, 0),
        (-1.5 / 256, 8, -2),
        (0.51 / 256, 8, 1),
        (0.5 / 16, 4, 0),
        (1.5 / 16, 4, 32),
        (2.5 / 16, 4, 32),
        (3.5 / 64, 6, 16),
        (2.0**-8, 8, 1),
        (2.0**-9, 8, 0),
        (2.0**23, 8, 2**31),
        (-(2.0**23) - 2.0**-8, 8, -(2**31) - 1),
    ],
)
def test_ties_go_to_the_even_position(pixels: float, bits: int, expected: int) -> None:
    assert snapped(np.array([[pixels, 0.0]]), bits).tolist() == [[expected, 0]]


@examples(2)
@given(st.floats(-(2.0**23), 2.0**23), st.integers(4, 8))
def test_snapping_is_the_rounding_of_fractions(pixels: float, bits: int) -> None:
    found = snapped(np.array([pixels, -pixels]), bits)
    assert found.dtype == np.int64
    assert found[0] == round(Fraction(pixels) * 2**bits) * 2 ** (8 - bits)
    assert found[1] == -found[0]


@pytest.mark.parametrize("bits", [3, 9, 0, -1])
def test_bits_that_no_device_has_or_the_grid_cannot_hold_are_refused(bits: int) -> None:
    with pytest.raises(ValueError, match="4 to 8"):
        snapped(np.zeros((1, 2)), bits)


@pytest.mark.parametrize("pixels", [np.nan, np.inf, -np.inf, 1e300])
def test_what_is_no_position_is_refused(pixels: float) -> None:
    with pytest.raises(ValueError, match="is not finite"):
        snapped(np.array([[1.0, pixels]]))


@examples(4)
@given(st.floats(-2, 2, width=32), st.integers(1, 16384), st.integers(1, 16384))
def test_the_viewport_rounds_once_where_it_is_fused_and_twice_where_not(
    ndc: float, width: int, height: int
) -> None:
    point = np.array([[ndc, -ndc]], dtype=np.float32)
    halves = (Fraction(width, 2), Fraction(height, 2))
    once = [
        single(Fraction(sign * ndc) * half + half)
        for sign, half in zip((1, -1), halves, strict=True)
    ]
    twice = [
        single(Fraction(single(Fraction(sign * ndc) * half)) + half)
        for sign, half in zip((1, -1), halves, strict=True)
    ]
    assert viewport(point, width, height).tolist() == [once]
    assert viewport(point, width, height, fused=False).tolist() == [twice]


def test_one_rounding_is_not_two() -> None:
    """At 1920 pixels the two differ somewhere, at 2048 nowhere within the picture's half: a power
    of two only moves the point.
    """
    points = np.random.default_rng(3).uniform(-1, 1, (20_000, 2)).astype(np.float32)
    assert (viewport(points, 1920, 1080) != viewport(points, 1920, 1080, fused=False)).sum() > 100
    assert (viewport(points, 2048, 1024) != viewport(points, 2048, 1024, fused=False)).sum() == 0


@pytest.mark.parametrize("sign", [1, -1])
def test_one_rounding_is_not_that_of_a_double_in_between(sign: int) -> None:
    """2^32 + 1 is 641 times 6700417: the product lies just beyond half of a single's last place of
    641, by less than a double holds. The double is that half, a tie, and would be rounded back to
    641.
    """
    ndc = np.array([[sign * 6700417 * 2.0**-47, 0]], dtype=np.float32)
    assert np.float32(np.float64(ndc[0, 0]) * 641.0 + 641.0) == 641
    assert (
        viewport(ndc, 1282, 2)[0, 0]
        == single(Fraction(float(ndc[0, 0])) * 641 + 641)
        == 641 + sign * 2.0**-14
    )


def test_edges_of_the_picture_are_exact() -> None:
    assert viewport(
        np.array([[-1, -1], [1, 1], [0, 0]], dtype=np.float32), 1921, 1081
    ).tolist() == [[0, 0], [1921, 1081], [960.5, 540.5]]
