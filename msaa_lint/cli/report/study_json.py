"""The versioned JSON of `msaa-lint study`; `study_v1.schema.json` next to this file is its schema.

Numbers have nine significant digits; infinities and NaN are null. The duration of the simulation is left out: no GPU takes that long.
"""

from __future__ import annotations

import math

from msaa_lint.experiments.study.outcome import SceneSummary, Study
from msaa_lint.experiments.study.points import Point

from . import Options, Write
from .data import Json, head, text, write_object

SCHEMA = "msaa-lint/study-v1"
_ERRORS = ("rmse", "rmse_all", "max_error", "bias", "psnr_db", "psnr_display_db", "ssim")
_COSTS = ("ratio", "bytes_per_frame", "milliwatts", "memory_mib")


def render(study: Study, out: Write, options: Options) -> None:
    """Prints one JSON object."""
    members: Json = {
        **head(SCHEMA, options.version),
        "device": text(study.device) or None,
        "model": text(study.model) or None,
        # A tuple stays on one line.
        "size": tuple(study.size),
        "bits": study.bits,
        "scenes": [_scene(scene, study) for scene in study.scenes],
        "points": [_point(point) for point in study.points],
        "advice": [{"scene": text(advice.scene), "says": text(advice.text), "because": text(advice.reason)} for advice in study.advice],
        "untimed": [{"name": untimed.name, "reason": text(untimed.reason)} for untimed in study.untimed],
        "failed": [
            {"scene": text(failure.scene), "name": failure.technique.name, "reason": text(failure.reason)} for failure in study.failed
        ],
        "errors": [{"file": text(error.file), "code": error.code, "message": text(error.message)} for error in study.wrong],
    }
    write_object(members, out)


def _scene(scene: SceneSummary, study: Study) -> Json:
    return {
        "name": text(scene.name),
        "says": text(scene.description),
        "error_of": "coverage" if scene.coverage else "color",
        "edge_pixels": max((point.edge_pixels for point in study.of(scene.name)), default=0),
        "effects": [{"name": name, "why": text(why)} for name, why in scene.effects],
    }


def _point(point: Point) -> Json:
    technique = point.technique
    return {
        "scene": text(point.scene),
        "technique": technique.kind,
        "samples": technique.samples,
        "shaded": technique.shaded,
        "name": technique.name,
        **{name: _number(getattr(point, name)) for name in _ERRORS},
        "time_ms": _number(point.time_ms),
        "time_from": text(point.time_from),
        **{name: _number(getattr(point, name)) for name in _COSTS},
        "effects": list(point.effects),
        "best": point.best,
    }


def _number(value: float | None) -> float | None:
    """A number that JSON can hold; `-0.0` becomes 0."""
    return None if value is None or not math.isfinite(value) else float(f"{value:.9g}") + 0.0
