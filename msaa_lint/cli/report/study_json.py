"""The versioned JSON of `msaa-lint study`; `study_v1.schema.json` beside this file is its schema.

Figures have nine significant digits; what is infinite or no number is null. How long the simulation took is not in it: it is nobody's GPU.
"""

from __future__ import annotations

import math
from typing import Any

from msaa_lint.experiments.study.outcome import Study
from msaa_lint.experiments.study.points import Point

from . import Write
from .data import dump, write_list
from .escape import clip, whole

SCHEMA = "msaa-lint/study-v1"

Json = dict[str, Any]


def render(study: Study, out: Write, version: str = "") -> None:
    """Prints one JSON object."""
    out("{\n")
    head: Json = {"schema": SCHEMA, **({"version": version} if version else {})}
    head |= {"device": _text(study.device) or None, "model": _text(study.model) or None, "size": list(study.size), "bits": study.bits}
    for key, value in head.items():
        out(f"  {dump(key)}: {dump(value)},\n")
    effects = [[{"name": name, "why": _text(why)} for name, why in scene.effects] for scene in study.scenes]
    lists: dict[str, list[Json]] = {
        "scenes": [
            {
                "name": _text(scene.name),
                "says": _text(scene.description),
                "error_of": "coverage" if scene.coverage else "color",
                "edge_pixels": max((point.edge_pixels for point in study.of(scene.name)), default=0),
                "effects": own,
            }
            for scene, own in zip(study.scenes, effects, strict=True)
        ],
        "points": [_point(point) for point in study.points],
        "advice": [{"scene": _text(each.scene), "says": _text(each.text), "because": _text(each.reason)} for each in study.advice],
        "untimed": [{"name": each.name, "reason": _text(each.reason)} for each in study.untimed],
        "failed": [{"scene": _text(each.scene), "name": each.technique.name, "reason": _text(each.reason)} for each in study.failed],
        "errors": [{"file": _text(each.file), "code": each.code, "message": _text(each.message)} for each in study.wrong],
    }
    for number, (key, items) in enumerate(lists.items()):
        out((",\n" if number else "") + f"  {dump(key)}: ")
        write_list(items, out, "  ")
    out("\n}\n")


def _point(point: Point) -> Json:
    technique = point.technique
    return {
        "scene": _text(point.scene),
        "technique": technique.kind,
        "samples": technique.samples,
        "shaded": technique.shaded,
        "name": technique.name,
        "rmse": _number(point.rmse),
        "rmse_all": _number(point.rmse_all),
        "max_error": _number(point.max_error),
        "bias": _number(point.bias),
        "psnr_db": _number(point.psnr_db),
        "psnr_display_db": _number(point.psnr_display_db),
        "ssim": _number(point.ssim),
        "time_ms": _number(point.time_ms),
        "time_from": _text(point.time_from),
        "ratio": _number(point.ratio),
        "bytes_per_frame": _number(point.bytes_per_frame),
        "milliwatts": _number(point.milliwatts),
        "memory_mib": _number(point.memory_mib),
        "effects": list(point.effects),
        "best": point.best,
    }


def _number(value: float | None) -> float | None:
    """What JSON can hold; `-0.0` is 0."""
    return None if value is None or not math.isfinite(value) else float(f"{value:.9g}") + 0.0


def _text(text: str) -> str:
    return whole(clip(text))
