"""The answer of a study: what each step adds and removes, what fits a budget, and from which cost
of shading on a step is worth it.
"""

from __future__ import annotations

import math
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from msaa_lint.experiments.study.answer import conclude
from msaa_lint.experiments.study.measures import DISPLAY, ERROR, FLICKER, FLIP, measure_of
from msaa_lint.experiments.study.outcome import SceneSummary, Study
from msaa_lint.experiments.study.points import MSAA, SAMPLE_SHADING, Point, Technique, techniques
from msaa_lint.experiments.study.recommendation import Recommendation, recommendation, worth
from msaa_lint.experiments.study.scenes import NAMES, scene
from msaa_lint.experiments.study.scenes.about import about
from msaa_lint.experiments.study.shading import Shading
from msaa_lint.experiments.study.steps import added_time
from msaa_lint.experiments.study.time_model import TimeModel
from tests.experiments.study import fakes
from tests.experiments.study.fakes import TIMES, point, shaded, timed

COUNTS = techniques((MSAA,))
SHADINGS = (
    Shading("none", nanoseconds=0.0, full_screen_ms=0.0),
    Shading("medium", 312, 4, 65536, 2e6, 4.17),
    Shading("heavy", 936, 12),
)


def study(points: list[Point], **other: Any) -> Study:
    names = dict.fromkeys(point.scene for point in points)
    scenes = [SceneSummary(name, "", ()) for name in names]
    return conclude(Study("a device", "", (64, 48), 8, scenes, points, [], [])._replace(**other))


def test_a_step_says_what_it_adds_and_removes() -> None:
    two = timed(Technique(MSAA, 2), time_ms=3.4, low_ms=3.38, high_ms=3.42, rmse=0.2, flicker=0.02)
    four = timed(
        Technique(MSAA, 4), time_ms=3.71, low_ms=3.70, high_ms=3.72, rmse=0.116, flicker=0.009
    )
    (step,) = study([two, four]).steps
    assert step.text == "2x to 4x: +0.31 ms (+9 %), error -42 %, flicker -55 %"
    assert step.added is not None and step.added.ms == pytest.approx(0.31)
    assert (step.added.low_ms, step.added.high_ms) == pytest.approx(
        (0.31 - math.hypot(0.01, 0.02), 0.31 + math.hypot(0.01, 0.02))
    )
    assert (step.same_time, step.worth) == (False, True)
    assert step.changes == pytest.approx({"rmse": -0.42, "flicker": -0.55})


def test_what_a_step_adds_is_the_median_of_the_differences_in_each_round() -> None:
    """A clock that slows down makes both slower, and the difference stays."""
    drift = [1.0, 1.2, 1.5, 1.1, 1.3, 1.4, 1.6]
    two = timed(Technique(MSAA, 2), time_ms=1.3, low_ms=1.0, high_ms=1.6, rounds=tuple(drift))
    four = timed(
        Technique(MSAA, 4),
        time_ms=1.8,
        low_ms=1.5,
        high_ms=2.1,
        rounds=tuple(time + 0.5 for time in drift),
    )
    added = added_time(four, two)
    assert added == pytest.approx((0.5, 0.5, 0.5, 0.5 / 1.3, 0.5 / 1.3))
    apart = added_time(four._replace(rounds=()), two)
    assert apart is not None and apart.high_ms == pytest.approx(0.5 + math.hypot(0.3, 0.3))


def test_a_step_within_the_noise_takes_the_same_time() -> None:
    two = timed(Technique(MSAA, 2), time_ms=3.4, low_ms=3.3, high_ms=3.5, rmse=0.2)
    four = timed(Technique(MSAA, 4), time_ms=3.5, low_ms=3.4, high_ms=3.6, rmse=0.2)
    (step,) = study([two, four]).steps
    assert (step.text, step.same_time, step.worth) == (
        "2x to 4x: same time, within noise, error unchanged",
        True,
        False,
    )


def test_steps_without_a_time_of_a_gpu_are_of_errors_alone() -> None:
    points = [timed(technique) for technique in COUNTS[:2]]
    (step,) = study(points, software=True).steps
    assert (step.text, step.added, step.worth) == ("1x to 2x: error -50 %", None, None)
    assert study(points, software=True).recommendations == []
    (step,) = study([point(technique) for technique in COUNTS[:2]]).steps
    assert step.text == "1x to 2x: error -50 %"


def test_a_step_goes_to_the_next_count_that_the_device_has() -> None:
    points = [timed(technique) for technique in COUNTS[:3]]
    points[1] = points[1]._replace(time_ms=None)
    assert [step.text for step in study(points).steps] == ["1x to 4x: +1 ms (+100 %), error -75 %"]


def test_where_the_error_lies_inside_triangles_sample_shading_is_a_step_too() -> None:
    points = [timed(technique) for technique in COUNTS[1:4]] + [
        timed(Technique(SAMPLE_SHADING, 4, 1.0), rmse=0.01)
    ]
    scenes = [SceneSummary("edges", "", (), about=("alpha",))]
    found = conclude(study(points)._replace(scenes=scenes))
    assert [step.text.partition(":")[0] for step in found.steps] == [
        "2x to 4x",
        "4x to 8x",
        "4x to 4x, each shaded",
    ]


def take(points: list[Point], budget: float) -> Recommendation:
    found = recommendation(points, ERROR, budget)
    assert found is not None
    return found


def test_under_a_budget_the_least_error_that_fits_is_taken() -> None:
    points = [shaded(technique, "medium", 2e6) for technique in COUNTS[:4]]
    choice = take(points, 1.2)
    assert (choice.text, choice.technique, choice.added.ms) == (
        "take 4x",
        Technique(MSAA, 4),
        pytest.approx(1.0),
    )
    high = math.hypot(0.04, 0.03)
    assert (
        choice.reason
        == f"adds 1 ms ({1 - high:.3g} to {1 + high:.3g}, +33 %) and has the least error of the 3 "
        "that fit"
    )
    assert (
        choice.following
        == f"8x has 50 % less error and needs {2.8 + math.hypot(0.058, 0.03):.3g} ms"
    )
    assert take(points, 1.0).technique == Technique(MSAA, 2), "its upper bound does not fit"
    assert take(points, 0.01).text == "take 1x"
    assert take(points, 0.01).reason == "every other technique adds more than 0.01 ms"
    assert take(points, 100.0).following == "no technique has less error"


def test_less_error_in_the_same_time_is_always_taken() -> None:
    points = [timed(COUNTS[0]), timed(COUNTS[1], time_ms=1.01, rmse=0.28)]
    choice = take(points, 0.05)
    assert (choice.text, choice.following) == ("take 2x", "no technique has less error")
    assert choice.reason.startswith("adds 0.01 ms ") and choice.reason.endswith(
        " and has the least error of the 2 that fit"
    )


def test_nothing_is_recommended_without_one_sample_to_add_to() -> None:
    assert recommendation([timed(technique) for technique in COUNTS[1:]], ERROR, 0.5) is None
    assert recommendation([point(technique) for technique in COUNTS], ERROR, 0.5) is None
    assert recommendation([], ERROR, 0.5) is None


@given(
    st.lists(
        st.tuples(st.floats(0.01, 1), st.floats(0.1, 20), st.floats(0, 0.3)), min_size=2, max_size=5
    ),
    st.floats(0.01, 30),
)
def test_what_is_recommended_fits_and_nothing_that_fits_is_better(
    rows: list[tuple[float, float, float]], budget: float
) -> None:
    points = [
        timed(
            technique,
            rmse=error,
            time_ms=time,
            low_ms=time * (1 - noise),
            high_ms=time * (1 + noise),
        )
        for technique, (error, time, noise) in zip(COUNTS, rows, strict=False)
    ]
    choice = take(points, budget)
    chosen = next(one for one in points if one.technique == choice.technique)
    assert chosen is points[0] or choice.added.high_ms <= budget
    for one in points[1:]:
        added = added_time(one, points[0])
        assert added is not None
        assert added.high_ms > budget or ERROR.rounded(one) >= ERROR.rounded(chosen)


def model(residual: float = 0.0, scene: str = "edges") -> TimeModel:
    base = {technique: TIMES[technique.samples] for technique in COUNTS}
    return fakes.model(scene, base, dict.fromkeys(COUNTS, 1000000.0), residual, 0.0)


def test_a_step_is_worth_it_from_the_cost_where_it_adds_a_tenth() -> None:
    """1.3 + x = 1.1 (1.0 + x), where a million invocations take x ms."""
    points = [timed(technique, width=1000, height=1000) for technique in COUNTS]
    shadings = [Shading("heavy", nanoseconds=12e6)]
    found = {each.after.name: each for each in worth(points, ERROR, model(), shadings)}
    assert found["2x"].full_screen_ms == pytest.approx((1.3 - 1.1 * 1.0) / 0.1)
    assert found["4x"].full_screen_ms == pytest.approx((2.0 - 1.1 * 1.3) / 0.1)
    assert found["8x"][2:] == (False, False, None, None, None)
    assert "16x" not in found, "it has no less error"
    rough = {each.after.name: each for each in worth(points, ERROR, model(0.02), shadings)}["2x"]
    assert (rough.at_least, rough.at_greatest) == (False, True)
    assert rough.low_ms == pytest.approx((0.98 * 1.3 - 1.1) / (1.1 - 0.98))
    assert rough.high_ms == pytest.approx((1.02 * 1.3 - 1.1) / (1.1 - 1.02))


def test_a_step_whose_invocations_grow_is_worth_it_up_to_a_cost() -> None:
    """1.0 + 1.3 x = 1.1 (1.0 + x): edges of small triangles add invocations, and a tile-based GPU
    adds nothing else.
    """
    points = [timed(technique, width=1000, height=1000) for technique in COUNTS[:2]]
    edges = fakes.model(
        "edges", dict.fromkeys(COUNTS[:2], 1.0), {COUNTS[0]: 1e6, COUNTS[1]: 1.3e6}, 0.02, 0.01
    )
    (found,) = worth(points, ERROR, edges, [Shading("heavy", nanoseconds=12e6)])
    assert (found.at_least, found.at_greatest) == (True, False)
    assert found.full_screen_ms == pytest.approx(0.1 / 0.2)
    assert (found.low_ms, found.high_ms) == pytest.approx(
        ((1.1 - 1.02) / (1.02 * 1.3 - 1.1), (1.1 - 0.98) / (0.98 * 1.3 - 1.1))
    )
    assert sentences(points, edges, Shading("heavy", nanoseconds=12e6)) == [
        "2x is worth its time up to about 0.5 ms of shading a full screen (0.35 to 0.69 ms) "
        f"({ENOUGH})"
    ]


ENOUGH = "at least 25 % less error for at most 10 % more time than the count before"


def sentences(points: list[Point], of: TimeModel, *shadings: Shading, **other: Any) -> list[str]:
    found = study(points, models=[of], shadings=shadings, **other)
    return [
        f"{each.text} ({each.reason})"
        for each in found.advice
        if "their time" in each.text or "its time " in each.text
    ]


def test_the_report_says_from_which_cost_on_or_never() -> None:
    points = [timed(technique, width=1000, height=1000) for technique in COUNTS[:4]]
    medium = Shading("medium", 312, 4, 65536, 4.17e6, 4.17)
    heavy = Shading("heavy", 936, 12, 65536, 12e6, 12.0)
    assert sentences(points, model(0.02), medium, heavy) == [
        "2x is worth its time from about 2 ms of shading a full screen (1.4 to 2.8 ms); 4x from "
        "about 5.7 ms of shading a full screen "
        f"(4.4 to 7.6 ms); 8x at no measured cost of shading ({ENOUGH}; medium is 4.17 ms, heavy "
        "is 12 ms)"
    ]
    free = fakes.model(
        "edges", dict.fromkeys(COUNTS, 1.0), dict.fromkeys(COUNTS, 1000000.0), 0.0, 0.0
    )
    assert sentences(points, free, medium) == [
        f"2x, 4x, and 8x are worth their time at every measured cost of shading ({ENOUGH}; medium "
        "is 4.17 ms)"
    ]
    assert (
        " (within the model's residuals perhaps at every measured cost, or at none)"
        in sentences(points, model(0.2), medium)[0]
    )
    assert sentences(points, model(), medium, software=True) == []
    assert sentences(points, model(scene="another"), medium) == []


def test_a_scene_is_compared_by_what_it_is_about() -> None:
    points = [point(technique, flip=0.1, flicker=0.2) for technique in COUNTS]
    assert measure_of(("hdr", "alpha"), points) == FLIP
    assert measure_of(("thin lines",), points) == FLICKER
    assert (
        measure_of(("edges",), points)
        == measure_of(("alpha",), points)
        == measure_of(("texture",), points)
        == ERROR
    )
    some = [*points[:-1], points[-1]._replace(flip=None, flicker=None)]
    assert measure_of(("hdr",), some) == DISPLAY and measure_of(("thin lines",), some) == ERROR
    assert DISPLAY.of(point(COUNTS[0], psnr_display_db=20.0)) == pytest.approx(0.1)
    assert DISPLAY.of(point(COUNTS[0], psnr_display_db=math.inf)) == 0


ABOUT = {
    "wires": ("thin lines",), "zone-plate": ("texture",), "foliage": ("alpha",),
    "foliage-to-coverage": ("alpha",),
    "hdr-emitter": ("hdr",), "hdr-emitter-before": ("hdr",), "hdr-emitter-weighted": ("hdr",),
}  # fmt: skip


@pytest.mark.parametrize("size", [(160, 96), (640, 360)])
@pytest.mark.parametrize("name", NAMES)
def test_what_a_scene_is_about_follows_from_its_content(name: str, size: tuple[int, int]) -> None:
    own = scene(name, *size)
    assert about(own) == ABOUT.get(name, ("edges",))
    assert about(own._replace(name="another")) == about(own)


def test_the_answer_is_by_scene_and_by_cost() -> None:
    points = [
        shaded(technique, name, cost, scene=of)
        for of in ("a", "b")
        for name, cost in (("none", 0.0), ("heavy", 8e6))
        for technique in COUNTS
    ]
    found = study(points, shadings=SHADINGS, budget_ms=1.03)
    assert found.shading_names("a") == ["none", "heavy"]
    assert [(each.scene, each.shading, each.text) for each in found.recommendations] == [
        ("a", "none", "take 4x"), ("a", "heavy", "take 2x"), ("b", "none", "take 4x"), ("b",
        "heavy", "take 2x"),
    ]  # fmt: skip
    assert [(each.scene, each.shading) for each in found.steps] == [
        (of, name) for of in ("a", "b") for name in ("none", "heavy") for _ in range(4)
    ]
    assert [each.scene for each in found.advice] == ["a", "a", "b", "b"], (
        "errors are told once for all costs"
    )
