"""The answer of a study: the fronts, the steps up, and what to take of each scene under each cost
of shading.
"""

from __future__ import annotations

from collections.abc import Iterator

from .advice import Advice, advice, error_advice, worth_advice
from .measures import measure_of
from .outcome import SceneSummary, Study
from .pareto import mark_best
from .points import Point
from .recommendation import recommendation, worth
from .steps import steps


def conclude(study: Study) -> Study:
    """The study with its answer, which follows from its points, its models, and its budget. Of a
    software driver's times nothing follows.
    """
    timed = not study.software
    scenes = [
        scene._replace(measure=measure_of(scene.about, study.of(scene.name)))
        for scene in study.scenes
    ]
    marked = study._replace(
        scenes=scenes,
        points=mark_best(
            study.points, {scene.name: scene.measure for scene in scenes}, timed=timed
        ),
    )
    groups = [
        (scene, marked.of(scene.name, name))
        for scene in scenes
        for name in marked.shading_names(scene.name)
    ]
    choices = (
        [recommendation(points, scene.measure, study.budget_ms) for scene, points in groups]
        if timed
        else []
    )
    # Errors are the same under every cost of shading.
    compared = groups if timed else [(scene, _first(marked, scene)) for scene in scenes]
    return marked._replace(
        steps=[
            step
            for scene, points in compared
            for step in steps(points, scene.about, scene.measure, timed=timed)
        ],
        recommendations=[choice for choice in choices if choice is not None],
        advice=[sentence for scene in scenes for sentence in _advice(marked, scene)],
    )


def _first(study: Study, scene: SceneSummary) -> list[Point]:
    """The points of a scene under the first cost of shading."""
    return study.of(scene.name, (study.shading_names(scene.name) or [""])[0])


def _advice(study: Study, scene: SceneSummary) -> Iterator[Advice]:
    points, measure = _first(study, scene), scene.measure
    yield from advice(points, measure)
    models = (
        [] if study.software else [model for model in study.models if model.scene == scene.name]
    )
    found = [step for model in models for step in worth(points, measure, model, study.shadings)]
    if found:
        yield worth_advice(scene.name, found, measure, study.shadings)
    else:
        yield from error_advice(points, measure)
