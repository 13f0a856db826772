"""Studies under costs of shading between the measured ones."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import pytest

from msaa_lint.experiments.study.points import MSAA, Technique
from msaa_lint.experiments.study.predictions import STEPS, predictions
from tests.experiments.study.gpu import SHADINGS, gpu_study


def test_costs_go_from_no_shading_to_the_greatest_measured_one() -> None:
    found = predictions(gpu_study(), "edges")
    costs = [each.shading.full_screen_ms or 0.0 for each in found]
    assert (
        costs[0] == 0 and costs[-1] == 12.46 and all(one < other for one, other in pairwise(costs))
    )
    assert [each.shading.name for each in found if each.is_measured] == ["none", "medium", "heavy"]
    # The greatest predicted cost is a measured one.
    assert len(found) == STEPS + len(SHADINGS)


def test_measured_costs_have_the_answer_of_the_study() -> None:
    study = gpu_study()
    for each in predictions(study, "edges"):
        if each.is_measured:
            name = each.shading.name
            assert list(each.study.points) == study.of("edges", name)
            assert list(each.study.recommendations) == [
                choice for choice in study.recommendations if choice.shading == name
            ]


def test_predicted_times_are_those_of_the_model_with_its_bounds() -> None:
    study = gpu_study()
    (model,) = study.models
    for each in predictions(study, "edges"):
        if not each.is_measured:
            for point in each.study.points:
                assert (point.time_ms, point.low_ms, point.high_ms) == model.predict(
                    point.technique, each.shading.nanoseconds or 0.0
                )
                assert point.fill_ms is point.shading_ms is point.resolve_ms is point.ratio is None
            assert (
                any(point.best for point in each.study.points)
                and len(each.study.recommendations) == 1
            )


def test_a_technique_without_times_has_no_prediction() -> None:
    study = gpu_study()
    eight = Technique(MSAA, 8)
    (model,) = study.models
    without = {
        technique: ratios for technique, ratios in model.ratios.items() if technique != eight
    }
    found = predictions(study._replace(models=[model._replace(ratios=without)]), "edges")
    assert {
        any(point.technique == eight for point in each.study.points)
        for each in found
        if not each.is_measured
    } == {False}


@pytest.mark.parametrize("other", [{"models": []}, {"software": True}, {"shadings": ()}])
def test_without_a_model_of_a_gpu_nothing_is_predicted(other: dict[str, Any]) -> None:
    assert predictions(gpu_study()._replace(**other), "edges") == []
    assert predictions(gpu_study(), "another") == []
