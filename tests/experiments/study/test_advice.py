"""Sentences: what the numbers say, with the numbers."""

from __future__ import annotations

import math

from msaa_lint.experiments.study.advice import Ruling, advice, error_advice, ruling
from msaa_lint.experiments.study.measures import ERROR, FLICKER, FLIP, Measure
from msaa_lint.experiments.study.pareto import mark_best
from msaa_lint.experiments.study.points import (
    MSAA,
    SAMPLE_SHADING,
    SSAA,
    Point,
    Technique,
    techniques,
)
from msaa_lint.experiments.study.shading import Shading, missed
from msaa_lint.experiments.study.steps import MAX_REMAINING
from tests.experiments.study.fakes import point, timed

WORTH = "(whether that is worth its time depends on the cost of shading)"


def says(points: list[Point], measure: Measure = ERROR) -> list[str]:
    return [
        f"{each.text} ({each.reason})"
        for each in (*advice(points, measure), *error_advice(points, measure))
    ]


def test_what_errors_say_whatever_the_time() -> None:
    found = says([timed(technique) for technique in techniques((MSAA,))])
    assert found == [
        "16x is no better than 8x here (the mean of its sample locations is off the pixel center, "
        "a bias of +0.0312)",
        f"each step up to 8x removes at least 25 % of the error {WORTH}",
    ]
    assert found == says([point(technique) for technique in techniques((MSAA,))])


def test_steps_are_told_by_the_error_that_counts() -> None:
    four, eight = point(Technique(MSAA, 4), flicker=0.1), point(Technique(MSAA, 8), flicker=0.09)
    assert says([four, eight]) == [f"each step up to 8x removes at least 25 % of the error {WORTH}"]
    assert says([four, eight], FLICKER) == []
    assert says([four, eight._replace(flicker=0.07)], FLICKER) == [
        f"each step up to 8x removes at least 25 % of the flicker {WORTH}"
    ]


def test_where_no_count_helps_that_is_one_sentence_with_what_ran_as_its_reason() -> None:
    counts = techniques((MSAA,))
    says_so = "no sample count helps here: the best, 2x, leaves 100 % of 1x's error "

    def reason(*effects: str, shaded: float = 0.3) -> str:
        own = [timed(technique, rmse=0.3, effects=effects) for technique in counts]
        found = says([*own, timed(Technique(SAMPLE_SHADING, 4, 1.0), rmse=shaded, effects=effects)])
        assert found[0].startswith(says_so)
        assert not any(line.startswith(("4x", "8x", "16x")) for line in found)
        return found[0].removeprefix(says_so)

    assert (
        reason(shaded=0.1)
        == "(the error lies inside triangles, which multisampling shades once per pixel)"
    )
    assert (
        reason("tone-mapping")
        == "(bright samples outweigh all others when light is averaged before tone mapping)"
    )
    assert reason("depth-test") == "(more samples do not make depth more precise)"
    assert reason() == "(no measured technique helps)"


def test_alpha_to_coverage_of_a_single_sample_is_all_or_nothing() -> None:
    effects = ("alpha-to-coverage",)
    found = says(
        [
            point(Technique(MSAA, 4), effects=effects),
            point(Technique(SSAA, 4, grid=2), effects=effects),
        ]
    )
    assert found == [
        "SSAA has more error than MSAA with as many samples: SSAA 2x2 2 times 4x's "
        "(RMSE 0.1443 against 0.0722; with one sample alpha is all or nothing)"
    ]


def test_an_exact_picture_has_nothing_to_gain() -> None:
    exact = [point(technique, rmse=0.0) for technique in techniques((MSAA,))]
    assert says(exact) == ["1x is exact here (no detail of this picture lies between samples)"]


def test_sample_shading_is_told_from_what_it_gains() -> None:
    plain, shaded = Technique(MSAA, 4), Technique(SAMPLE_SHADING, 4, 1.0)
    assert says([timed(plain), timed(shaded)]) == [
        "sample shading gains nothing here (edges are the same with more shader invocations per "
        "pixel)"
    ]
    inside = "the error lies inside triangles, which multisampling shades once per pixel"
    assert says([timed(plain), timed(shaded, rmse=0.0361)]) == [
        f"shading 4 samples at 4x leaves 50 % of its error (RMSE 0.0361 against 0.0722: {inside})"
    ]
    assert says([timed(shaded)]) == []
    more = Technique(SAMPLE_SHADING, 8, 1.0)
    both = [
        timed(plain),
        timed(Technique(MSAA, 8)),
        timed(shaded, rmse=0.01),
        timed(more, rmse=0.02),
    ]
    (line,) = [line for line in says(both) if line.startswith("shading ")]
    assert (
        line == "shading 4 samples at 4x leaves 14 % of its error (RMSE 0.0100 against 0.0722: "
        f"{inside}; 8x without it leaves 50 %)"
    )


def test_grids_are_held_against_as_many_samples() -> None:
    plain = [timed(technique) for technique in techniques((MSAA,))]
    grids = [timed(Technique(SSAA, grid * grid, grid=grid)) for grid in (2, 3, 4)]
    assert (
        "SSAA has more error than MSAA with as many samples: SSAA 2x2 2 times 4x's, SSAA 4x4 2 "
        "times 16x's "
        "(RMSE 0.1443 against 0.0722, RMSE 0.0722 against 0.0363; "
        "the samples of a grid share rows and columns, so it distinguishes fewer edge positions)"
    ) in says([*plain, *grids])
    assert not any("SSAA" in line for line in says([plain[2], grids[1], grids[2]])), (
        "4x is not as many as 9 or 16"
    )
    assert not any("SSAA" in line for line in says([plain[3], grids[1]])), "8x is not as many as 9"
    better = [each._replace(rmse=0.03) for each in grids]
    assert (
        "SSAA has less error than MSAA with as many samples: SSAA 2x2 0.42 times 4x's, "
        "SSAA 4x4 0.83 times 16x's (RMSE 0.0300 against 0.0722, RMSE 0.0300 against 0.0363)"
    ) in says([*plain, *better])


def test_sentences_are_of_the_error_that_counts() -> None:
    """HDR: more samples have more error in light, and less on the display."""
    counts = [
        point(each, rmse=0.2 + each.samples / 20, flip=0.4 / each.samples)
        for each in techniques((MSAA,), (1, 2, 4))
    ]
    grid = point(Technique(SSAA, 4, grid=2), flip=0.05)
    assert says([*counts, grid])[0].startswith("no sample count helps here")
    assert says([*counts, grid], FLIP) == [
        "SSAA has less FLIP than MSAA with as many samples: SSAA 2x2 0.5 times 4x's (FLIP 0.0500 "
        "against 0.1000)",
        f"each step up to 4x removes at least 25 % of the FLIP {WORTH}",
    ]


def test_what_is_no_number_is_no_ones_advice() -> None:
    assert says([point(technique, rmse=math.nan) for technique in techniques()]) == []
    assert says([]) == []


def rule(samples: int, points: list[Point]) -> Ruling:
    return ruling(mark_best(points), samples)


def test_above_four_is_justified_by_its_error_and_by_the_front() -> None:
    plain = [timed(technique) for technique in techniques((MSAA,))]
    assert rule(8, plain) == Ruling(True)
    assert rule(16, plain) == Ruling(False, "8x has no more error and costs no more")
    assert rule(8, plain[:3]) == Ruling(False, "it was not measured")
    assert rule(8, plain[3:]) == Ruling(
        False, "no count up to four was measured to compare it with"
    )
    assert rule(8, [plain[1], plain[3]]) == Ruling(True)


def test_three_quarters_of_the_error_is_the_most_that_may_be_left() -> None:
    four = timed(Technique(MSAA, 4), rmse=0.08)
    assert rule(8, [four, timed(Technique(MSAA, 8), rmse=0.08 * MAX_REMAINING)]) == Ruling(True)
    assert rule(8, [four, timed(Technique(MSAA, 8), rmse=0.0601)]) == Ruling(
        False, "it leaves more than three quarters of the error of 4x"
    )
    assert rule(8, [four._replace(rmse=0.0), timed(Technique(MSAA, 8), rmse=0.0)]) == Ruling(
        False, "4x is exact"
    )


def test_without_a_time_no_count_is_justified() -> None:
    """More samples always have less error: what they cost decides."""
    points = [point(Technique(MSAA, 4), rmse=0.08), point(Technique(MSAA, 8), rmse=0.04)]
    assert rule(8, points) == Ruling(
        False, "its time was not measured; `--device NAME` measures it"
    )


def test_a_count_that_a_grid_beats_or_no_device_draws_is_not_justified() -> None:
    four, eight = timed(Technique(MSAA, 4)), timed(Technique(MSAA, 8))
    grid = timed(Technique(SSAA, 9, grid=3), rmse=0.03, time_ms=3.0)
    assert rule(8, [four, eight, grid]) == Ruling(
        False, "SSAA 3x3 has no more error and costs no more"
    )
    assert rule(8, [four, eight._replace(time_ms=None)]) == Ruling(
        False, "the timed device does not support it"
    )


def test_a_software_driver_s_time_justifies_nothing() -> None:
    points = mark_best([timed(technique) for technique in techniques((MSAA,))], timed=False)
    assert ruling(points, 8, software=True) == Ruling(
        False, "its time is a software driver's, which says nothing about a GPU"
    )


def test_the_error_that_counts_rules() -> None:
    four, eight = timed(Technique(MSAA, 4), flicker=0.1), timed(Technique(MSAA, 8), flicker=0.09)
    assert ruling(mark_best([four, eight]), 8) == Ruling(True)
    assert ruling([four, eight], 8, FLICKER) == Ruling(
        False, "it leaves more than three quarters of the flicker of 4x"
    )


def test_a_count_that_is_as_fast_and_has_less_error_beats_another() -> None:
    four = timed(Technique(MSAA, 4), rmse=0.08)
    eight = timed(Technique(MSAA, 8), rmse=0.05, time_ms=3.0, low_ms=2.9, high_ms=3.1)
    grid = timed(Technique(SSAA, 9, grid=3), rmse=0.04, time_ms=3.15, low_ms=3.05, high_ms=3.2)
    assert rule(8, [four, eight, grid]) == Ruling(
        False, "SSAA 3x3 has no more error and costs no more"
    )
    assert rule(8, [four, eight, grid._replace(low_ms=3.11)]) == Ruling(True)


def test_a_level_that_missed_its_share_says_what_it_reached() -> None:
    assert (
        missed(Shading("medium", 100, 4, full_screen_ms=1000 / 60 / 4))
        == missed(Shading("none", full_screen_ms=0.0))
        == ""
    )
    assert missed(Shading("200ops", 200, full_screen_ms=9.0)) == missed(Shading("heavy")) == ""
    assert missed(Shading("medium", 16, 1, full_screen_ms=8.53)).startswith(
        "51.2% of a frame at 60 Hz, not 25.0%"
    )
