"""Studies of one scene under costs of shading between the measured ones, by the model of its
times.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from .answer import conclude
from .outcome import Study
from .points import Point
from .shading import Shading
from .time_model import TimeModel

STEPS = 32
"""Predicted costs above 0."""

LEAST = 1 / 400
"""The least of them, as a share of the greatest measured cost; each next one is by the same factor
greater.
"""


class Prediction(NamedTuple):
    """A study of one scene under one cost of shading. `is_measured` says whether its times were
    measured, else the model predicts them.
    """

    shading: Shading
    study: Study
    is_measured: bool


def predictions(study: Study, scene: str) -> list[Prediction]:
    """The studies of a scene from no shading to the greatest measured cost, in ascending order;
    none where no model of its times was fitted.
    """
    model = next((model for model in study.models if model.scene == scene), None)
    names = study.shading_names(scene)
    measured = [
        shading
        for shading in study.shadings
        if shading.name in names and shading.nanoseconds is not None
    ]
    greatest = max((shading.nanoseconds or 0.0 for shading in measured), default=0.0)
    if model is None or study.software or not greatest:
        return []
    scale = study.size[0] * study.size[1] * 1e-12
    known = {shading.nanoseconds for shading in measured}
    costs = {0.0, *(greatest * LEAST ** (step / STEPS) for step in range(STEPS + 1))} - known
    shadings = [
        *measured,
        *(Shading("", nanoseconds=cost, full_screen_ms=cost * scale) for cost in costs),
    ]
    ordered = sorted(shadings, key=lambda shading: shading.nanoseconds or 0.0)
    return [_prediction(study, scene, model, shading) for shading in ordered]


def _prediction(study: Study, scene: str, model: TimeModel, shading: Shading) -> Prediction:
    points = (
        study.of(scene, shading.name)
        if shading.name
        else _predicted_points(study, scene, model, shading)
    )
    summaries = [summary for summary in study.scenes if summary.name == scene]
    alone = study._replace(
        scenes=summaries, points=points, shadings=[shading], models=(), failed=(), untimed=()
    )
    return Prediction(shading, conclude(alone), bool(shading.name))


def _predicted_points(
    study: Study, scene: str, model: TimeModel, shading: Shading
) -> Sequence[Point]:
    """The points with predicted times and the bounds within which the residuals leave them; those
    without a prediction are left out.
    """
    points = []
    for point in study.of(scene, study.shading_names(scene)[0]):
        time = model.predict(point.technique, shading.nanoseconds or 0.0)
        if time is not None:
            apart = point._replace(
                shading="", rounds=(), ratio=None, fill_ms=None, shading_ms=None, resolve_ms=None
            )
            points.append(
                apart._replace(time_ms=time.time_ms, low_ms=time.low_ms, high_ms=time.high_ms)
            )
    return points
