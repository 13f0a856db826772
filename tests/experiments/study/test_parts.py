"""Parts of a picture are those of the whole, exact and simulated, and a scene that has moved is the
same scene elsewhere.
"""

from __future__ import annotations

import numpy as np
import pytest

from msaa_lint.experiments.study.measure import truth
from msaa_lint.experiments.study.points import MSAA, SAMPLE_SHADING, SSAA, Technique
from msaa_lint.experiments.study.scenes import NAMES, scene
from msaa_lint.experiments.study.scenes.description import from_description
from msaa_lint.experiments.study.scenes.part import Part
from msaa_lint.experiments.study.scenes.scene import Scene
from msaa_lint.experiments.study.simulate import Simulation, Simulator, simulate
from tests.experiments.study.test_scenes import FULL, SAMPLED, frame

WIDTH, HEIGHT = 99, 70
FOUR = Technique(MSAA, 4)
TECHNIQUES = (FOUR, Technique(SAMPLE_SHADING, 4, 0.5), Technique(SSAA, 9, grid=3))
WINDOWS = (Part(0, 0, 16, 16), Part(37, 21, 16, 16), Part(83, 54, 16, 16))


def described() -> Scene:
    """Everything that a description calls for, side by side."""
    return from_description(frame(FULL), 288, 48)


def assert_crops(parts: Simulation, whole: Simulation, windows: tuple[Part, ...]) -> None:
    for number, window in enumerate(windows):
        crop = (
            slice(window.top, window.top + window.height),
            slice(window.left, window.left + window.width),
        )
        for part, picture in zip(parts[:2], whole[:2], strict=True):
            assert (part is None) == (picture is None)
            if part is not None and picture is not None:
                assert np.array_equal(part[number], picture[crop])


@pytest.mark.parametrize("technique", TECHNIQUES)
@pytest.mark.parametrize("name", NAMES)
def test_windows_are_drawn_as_in_the_whole(name: str, technique: Technique) -> None:
    """Bit for bit, dithering included, whether drawn together or alone."""
    made = scene(name, WIDTH, HEIGHT)
    whole, simulator = simulate(made, technique), Simulator(made, technique)
    assert_crops(simulator.render(WINDOWS), whole, WINDOWS)
    assert_crops(simulator.render(WINDOWS[1:2]), whole, WINDOWS[1:2])
    alone = simulate(made, technique, part=WINDOWS[1])
    assert np.array_equal(alone.image, whole.image[21:37, 37:53])


@pytest.mark.parametrize("name", [*NAMES, "description"])
def test_the_exact_picture_of_windows_is_that_of_the_whole(name: str) -> None:
    made = described() if name == "description" else scene(name, WIDTH, HEIGHT)
    whole = truth(made)
    windows = [
        Part(0, 0, 16, 16),
        Part(37, 21, 16, 16),
        Part(made.width - 16, made.height - 16, 16, 16),
    ]
    together = made.exact(Simulator(made, FOUR).snapped(windows).view())
    for number, part in enumerate(windows):
        crop = slice(part.top, part.top + 16), slice(part.left, part.left + 16)
        for exact in (
            truth(made, part=part),
            (together.image[number], together.edge_pixels[number]),
        ):
            assert exact[0] == pytest.approx(whole.image[crop], abs=1e-11)
            assert np.array_equal(exact[1], whole.edge_pixels[crop])


@pytest.mark.parametrize("name", [*NAMES, "description"])
@pytest.mark.parametrize(("dx", "dy"), [(1, 1), (1, -1), (-2, 3)])
def test_a_scene_that_moved_by_whole_pixels_is_itself_elsewhere(
    name: str, dx: int, dy: int
) -> None:
    """Coverage, light and the exact picture; not dithering, which belongs to the screen."""
    made = described() if name == "description" else scene(name, WIDTH, HEIGHT)
    still, moved = Part(30, 16, 20, 24), Part(30 + dx, 16 + dy, 20, 24, dx, dy)
    assert truth(made, part=moved).image == pytest.approx(truth(made, part=still).image, abs=1e-11)
    if "alpha-to-coverage" in made.effects:
        return
    one, other = (Simulator(made, FOUR).render([part]) for part in (still, moved))
    # Depths are rounded elsewhere.
    assert np.count_nonzero(np.abs(one.image - other.image) > 1e-5) <= 4 * (
        "depth-test" in made.effects
    )


@pytest.mark.parametrize("name", SAMPLED)
def test_between_pixels_the_exact_picture_is_what_many_samples_give(name: str) -> None:
    """At the border of the picture too, which moves along."""
    made = scene(name, WIDTH, HEIGHT)
    for part in (
        Part(0, 0, 16, 16, 0.25, 0.75),
        Part(40, 30, 16, 16, 11 / 64, -11 / 64),
        Part(83, 54, 16, 16, -0.5, -0.25),
    ):
        simulator = Simulator(made, Technique(SSAA, 256, grid=16))
        triangles = simulator.snapped([part])
        exact, measured = made.exact(triangles.view()), simulator.render([part], triangles)
        assert measured.image[..., :3] == pytest.approx(exact.image[..., :3], abs=0.05)


def test_the_side_by_side_parts_of_a_description_move_into_one_another() -> None:
    made = described()
    simulator = Simulator(made, Technique(SSAA, 256, grid=16))
    border = Part(40, 8, 16, 16, 0.5, 0.25)
    triangles = simulator.snapped([border])
    exact, measured = made.exact(triangles.view()), simulator.render([border], triangles)
    assert measured.image[..., :3] == pytest.approx(exact.image[..., :3], abs=0.06)
