"""A study of a GPU that nobody has: its times are a model's, a percent apart from it, so that a fit
has residuals.
"""

from __future__ import annotations

from typing import Any

from msaa_lint.experiments.study.answer import conclude
from msaa_lint.experiments.study.outcome import SceneSummary, Study
from msaa_lint.experiments.study.points import MSAA, SSAA, Point, Technique, techniques
from msaa_lint.experiments.study.shading import Shading
from msaa_lint.experiments.study.time_model import MeasuredTime, Terms, TimeModel, fit
from tests.experiments.study.fakes import point

SIZE = (1920, 1080)
PIXELS = SIZE[0] * SIZE[1] / 1e6
SHADINGS = tuple(
    Shading(name, operations, fetches, 16 << 20 if fetches else 0, screen * 1e6 / PIXELS, screen)
    for name, operations, fetches, screen in (
        ("none", 0, 0, 0.0),
        ("medium", 1155, 4, 4.15),
        ("heavy", 3452, 8, 12.46),
    )
)
TECHNIQUES = [
    technique for technique in techniques() if technique.samples < 16 or technique.kind == SSAA
]


def gpu_study(*scenes: str, **other: Any) -> Study:
    """A study of scenes with all that a device measures of them."""
    names = scenes or ("edges",)
    points = [
        _point(name, technique, shading)
        for name in names
        for shading in SHADINGS
        for technique in TECHNIQUES
    ]
    summaries = [
        SceneSummary(name, "edges at all angles", (("depth test", "a pipeline tests depth"),))
        for name in names
    ]
    models = [model for name in names if (model := _model(name, points)) is not None]
    return conclude(
        Study(
            "A GPU", "", SIZE, 8, summaries, points, [], [], shadings=SHADINGS, models=models
        )._replace(**other)
    )


def _terms(technique: Technique) -> Terms:
    invocations = 0.35 * (
        technique.shaded if technique.kind != MSAA else 1 + 0.08 * (technique.samples - 1)
    )
    return Terms(
        0.0083 * technique.samples,
        0.0083 * (technique.samples - 1),
        0.35 * technique.samples,
        invocations,
        0.18,
    )


def _point(scene: str, technique: Technique, shading: Shading) -> Point:
    terms, cost = _terms(technique), (shading.nanoseconds or 0.0) * 1e-6
    fill, resolve = 0.03 + 20 * terms.gb_written, 15 * terms.gb_resolved
    added = (terms.fragments + terms.fragment_helpers) * cost
    time = (fill + resolve + added) * (1.01 if technique.samples % 4 else 0.99)
    error = (
        0.2887 / technique.grid**1.1 if technique.kind == SSAA else 0.2887 / technique.samples**0.75
    )
    return point(
        technique, scene, width=SIZE[0], height=SIZE[1], rmse=error, shading=shading.name,
        time_ms=time, low_ms=0.998 * time,
        high_ms=1.002 * time, time_from="A GPU", fill_ms=fill, shading_ms=added,
        resolve_ms=resolve, flicker=error / 3,
        bytes_per_frame=8294400.0, milliwatts=49.8, memory_mib=7.9,
    )  # fmt: skip


def _model(scene: str, points: list[Point]) -> TimeModel | None:
    costs = {shading.name: shading.nanoseconds or 0.0 for shading in SHADINGS}
    measured = [
        MeasuredTime(each.technique, costs[each.shading], each.time_ms or 0.0, 0.002)
        for each in points
        if each.scene == scene
    ]
    return fit(scene, measured, {technique: _terms(technique) for technique in TECHNIQUES})
