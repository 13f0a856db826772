"""Flicker against rational arithmetic: one edge along an axis, whose errors are known at every
step.
"""

from __future__ import annotations

import math
from fractions import Fraction
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from msaa_lint.experiments.study import flicker, locations, measure
from msaa_lint.experiments.study.points import COUNTS, MSAA, SAMPLE_SHADING, SSAA, Technique
from msaa_lint.experiments.study.scenes import NAMES, scene, shapes
from msaa_lint.experiments.study.scenes.scene import Scene
from tests.experiments.study.test_measure import drawn
from tests.strength import examples

SIDE = 64
ONE = Technique(MSAA, 1)


def edge(position: Fraction, upright: bool) -> Scene:
    """What is left of an upright edge is white, or what is above a level one: it reaches beyond the
    picture at every step.
    """
    shape = shapes.rectangle(-9, -9, float(position), SIDE + 9)
    return drawn([shape if upright else [(y, x) for x, y in shape]], SIDE, SIDE)


def places(technique: Technique, upright: bool) -> list[Fraction]:
    """Where the samples of a pixel lie across the edge."""
    if technique.kind == SSAA:
        return [Fraction(2 * n + 1, 2 * technique.grid) for n in range(technique.grid)]
    return [
        Fraction(int(x if upright else y), 256) for x, y in locations.standard(technique.samples)
    ]


def expected(
    position: Fraction, technique: Technique, upright: bool, sweeps: tuple[int, ...]
) -> float:
    """The flicker by definition, in rational numbers. A sample on the edge is not covered: the edge
    is a right one, or a bottom one.
    """
    samples, squares, count = places(technique, upright), Fraction(0), 0
    for direction in sweeps:
        steps = []
        for step in range(65):
            now = position + Fraction(direction * step, 64)
            errors, edges = {}, set()
            for pixel in range(int(position) - 2, int(position) + 3):
                exact = min(max(now - pixel, Fraction(0)), Fraction(1))
                errors[pixel] = (
                    Fraction(sum(pixel + place < now for place in samples), len(samples)) - exact
                )
                if 0 < exact < 1:
                    edges.add(pixel)
            steps.append((errors, edges))
        for (before, edges_before), (after, edges_after) in pairwise(steps):
            for pixel in edges_before | edges_after:
                squares += (after[pixel] - before[pixel]) ** 2
                count += 1
    return math.sqrt(squares / count)


@pytest.mark.parametrize("upright", [True, False])
@pytest.mark.parametrize("quarters", [0, 1, 128, 129, 255])
@pytest.mark.parametrize(
    "technique",
    [
        *(Technique(MSAA, count) for count in COUNTS),
        Technique(SSAA, 4, grid=2),
        Technique(SSAA, 16, grid=4),
    ],
)
def test_the_flicker_of_an_edge_is_that_of_its_definition(
    technique: Technique, quarters: int, upright: bool
) -> None:
    """From the border of pixels, from a sample's row or column, and from beside them: steps end on
    samples and between them.
    """
    position = 22 + Fraction(quarters, 256)
    found = flicker.flicker(edge(position, upright), technique)
    assert found == pytest.approx(
        expected(position, technique, upright, (1, 1) if upright else (1, -1)), rel=1e-9
    )


@pytest.mark.parametrize("upright", [True, False])
def test_the_error_of_one_sample_is_a_sawtooth(upright: bool) -> None:
    """63 steps change it by 1/64, and one step, onto the sample, by 63/64."""
    found = flicker.flicker(edge(Fraction(22), upright), ONE)
    assert found == pytest.approx(math.sqrt((63 / 64**2 + (63 / 64) ** 2) / 64), rel=1e-12)


@examples(0.2)
@given(st.integers(0, 255), st.sampled_from(COUNTS))
def test_whole_pixels_change_nothing(start: int, count: int) -> None:
    found = [
        flicker.flicker(edge(Fraction(start, 256) + pixel, True), Technique(MSAA, count))
        for pixel in (19, 24, 41)
    ]
    assert found[1:] == [pytest.approx(found[0], rel=1e-12)] * 2


def test_flicker_is_least_where_samples_are_many() -> None:
    found = [
        flicker.flicker(scene("edge-fan", 160, 160), Technique(MSAA, count)) for count in COUNTS
    ]
    assert found == sorted(found, reverse=True) and found[0] > 4 * found[-1] > 0


@pytest.mark.parametrize("name", NAMES)
def test_every_scene_has_flicker_and_sample_shading_that_of_its_picture(name: str) -> None:
    made = scene(name, 64, 64)
    plain, shaded = (
        measure.point(made, technique).flicker
        for technique in (Technique(MSAA, 4), Technique(SAMPLE_SHADING, 4, 1.0))
    )
    assert plain is not None and shaded is not None and 0 < plain < 1
    assert (plain == shaded) == (made.shade is None)


def test_a_picture_that_has_no_edge_has_no_flicker() -> None:
    assert flicker.flicker(drawn([shapes.rectangle(-9, -9, 73, 73)], SIDE, SIDE), ONE) == 0


def test_windows_are_few_within_the_picture_and_where_edges_are() -> None:
    windows = flicker.windows(scene("edge-fan", 640, 360))
    assert (
        len(windows) == len(set(windows))
        and flicker.MIN_WINDOWS <= len(windows) <= flicker.MAX_WINDOWS
    )
    assert all(
        0 <= left <= 624 and 0 <= top <= 344 and left % 16 == top % 16 == 0
        for left, top, *_ in windows
    )
    assert flicker.windows(edge(Fraction(22), True)) == [
        (16, top, 16, 16, 0, 0) for top in range(0, 64, 16)
    ]
