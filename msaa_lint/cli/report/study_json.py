"""The versioned JSON of `msaa-lint study`; `study_v1.schema.json` next to this file is its schema.

Numbers have nine significant digits; infinities and NaN are null. The duration of the simulation is
left out: no GPU takes that long.
"""

from __future__ import annotations

import math

from msaa_lint.experiments.study.outcome import SceneSummary, Study
from msaa_lint.experiments.study.points import Point, Technique
from msaa_lint.experiments.study.recommendation import Recommendation
from msaa_lint.experiments.study.shading import Shading
from msaa_lint.experiments.study.steps import AddedTime, Step
from msaa_lint.experiments.study.time_model import TERMS, TimeModel

from . import Options, Write
from .data import Json, head, text, write_object

SCHEMA = "msaa-lint/study-v1"
_ERRORS = (
    "rmse",
    "rmse_all",
    "max_error",
    "bias",
    "psnr_db",
    "psnr_display_db",
    "ssim",
    "flip",
    "flicker",
)
_COSTS = (
    "low_ms",
    "high_ms",
    "ratio",
    "fill_ms",
    "shading_ms",
    "resolve_ms",
    "bytes_per_frame",
    "milliwatts",
    "memory_mib",
)


def render(study: Study, out: Write, options: Options) -> None:
    """Prints one JSON object."""
    members: Json = {
        **head(SCHEMA, options.version),
        "device": text(study.device) or None,
        "software": study.software,
        "model": text(study.model) or None,
        # A tuple stays on one line.
        "size": tuple(study.size),
        "bits": study.bits,
        "budget_ms": _number(study.budget_ms),
        "shadings": [_shading(shading) for shading in study.shadings],
        "models": [_model(model) for model in study.models],
        "scenes": [_scene(scene, study) for scene in study.scenes],
        "points": [_point(point, study.software) for point in study.points],
        "steps": [_step(step) for step in study.steps],
        "recommendations": [_recommendation(choice) for choice in study.recommendations],
        "advice": [
            {"scene": text(advice.scene), "says": text(advice.text), "because": text(advice.reason)}
            for advice in study.advice
        ],
        "untimed": [
            {"name": untimed.name, "reason": text(untimed.reason)} for untimed in study.untimed
        ],
        "failed": [
            {
                "scene": text(failure.scene),
                "name": failure.technique.name,
                "reason": text(failure.reason),
            }
            for failure in study.failed
        ],
        "errors": [
            {"file": text(error.file), "code": error.code, "message": text(error.message)}
            for error in study.wrong
        ],
    }
    write_object(members, out)


def _scene(scene: SceneSummary, study: Study) -> Json:
    return {
        "name": text(scene.name),
        "says": text(scene.description),
        "error_of": "coverage" if scene.coverage else "color",
        "edge_pixels": max((point.edge_pixels for point in study.of(scene.name)), default=0),
        "effects": [{"name": name, "why": text(why)} for name, why in scene.effects],
        "about": list(scene.about),
        "compared_by": scene.measure.key,
        "assumed": [text(note) for note in scene.assumed],
    }


def _shading(shading: Shading) -> Json:
    return {
        "name": text(shading.name),
        "operations": shading.operations,
        "fetches": shading.fetches,
        "footprint": shading.footprint,
        "nanoseconds": _number(shading.nanoseconds),
        "full_screen_ms": _number(shading.full_screen_ms),
    }


def _model(model: TimeModel) -> Json:
    """The coefficients of a scene's times, and what they are multiplied by for each technique."""
    return {
        "scene": text(model.scene),
        "residual": _number(model.residual),
        "rms_residual": _number(model.rms),
        "noise": _number(model.noise),
        "coefficients": {
            name: _number(value) for name, value in zip(TERMS, model.coefficients, strict=True)
        },
        "techniques": [
            {
                **_technique(technique),
                **{name: _number(value) for name, value in terms._asdict().items()},
            }
            for technique, terms in model.terms.items()
        ],
    }


def _technique(technique: Technique) -> Json:
    return {
        "name": technique.name,
        "technique": technique.kind,
        "samples": technique.samples,
        "shaded": technique.shaded,
    }


def _added(added: AddedTime | None) -> Json:
    ms, low, high, share = (
        (added.ms, added.low_ms, added.high_ms, added.share) if added is not None else (None,) * 4
    )
    return {
        "added_ms": _number(ms),
        "added_low_ms": _number(low),
        "added_high_ms": _number(high),
        "added_share": _number(share),
    }


def _step(step: Step) -> Json:
    return {
        "scene": text(step.scene),
        "shading": text(step.shading),
        "from": step.before.name,
        "to": step.after.name,
        **_added(step.added),
        "tie": step.same_time if step.added is not None else None,
        "changes": {key: _number(change) for key, change in step.changes.items()},
        "worth": step.worth,
        "says": step.text,
    }


def _recommendation(choice: Recommendation) -> Json:
    return {
        "scene": text(choice.scene),
        "shading": text(choice.shading),
        **_technique(choice.technique),
        **_added(choice.added),
        "says": choice.text,
        "because": choice.reason,
        "next": choice.following,
    }


def _point(point: Point, software: bool) -> Json:
    return {
        "scene": text(point.scene),
        "shading": text(point.shading),
        **_technique(point.technique),
        **{name: _number(getattr(point, name)) for name in _ERRORS},
        "time_ms": _number(point.time_ms),
        "time_from": text(point.time_from),
        "software": software and point.time_ms is not None,
        **{name: _number(getattr(point, name)) for name in _COSTS},
        "invocations": point.invocations,
        "expected_invocations": point.expected_invocations,
        "effects": list(point.effects),
        "best": point.best,
    }


def _number(value: float | None) -> float | None:
    """A number that JSON can hold; `-0.0` becomes 0."""
    return None if value is None or not math.isfinite(value) else float(f"{value:.9g}") + 0.0
