"""The record of a study, next to its description: rule MSAA101 accepts a sample count above four that it justifies. `study_record` reads
it."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from typing import Any, NamedTuple

from msaa_lint.core.atomic_write import write_file
from msaa_lint.frame.facts.frame import Frame
from msaa_lint.input.content import is_own_output
from msaa_lint.linter.study_record import MAX_TEXT, SCHEMA, digests, path_of

from .advice import MAX_EFFICIENT, Ruling, ruling
from .points import MSAA, Point


class DocumentStudy(NamedTuple):
    """The study of one document of a description: its frame, the source of the times (empty without any), and the points of its scene."""

    frame: Frame
    device: str
    size: tuple[int, int]
    points: Sequence[Point]


def text(studies: Sequence[DocumentStudy]) -> str:
    """The text of a record, with sorted keys so that diffs are minimal. ValueError where no sample count was measured."""
    record = {"schema": SCHEMA, "studies": [_study(study) for study in studies]}
    return json.dumps(record, indent=2, sort_keys=True, allow_nan=False) + "\n"


def _study(study: DocumentStudy) -> dict[str, Any]:
    points = [point for point in study.points if point.technique.kind == MSAA and math.isfinite(point.rmse)]
    if not points:
        raise ValueError("no sample count was measured")
    timed = any(point.time_ms is not None for point in points)
    return {
        "inputs": digests(study.frame),
        "device": study.device.encode("utf-8", "replace").decode()[:MAX_TEXT] if timed else "",
        "size": list(study.size),
        "counts": {str(point.technique.samples): _count(point, study.points) for point in points},
    }


def _count(point: Point, points: Sequence[Point]) -> dict[str, Any]:
    """A count's error and time, to six significant digits, and whether it is justified; counts up to four need no justification."""
    samples = point.technique.samples
    verdict = ruling(points, samples) if samples > MAX_EFFICIENT else Ruling(True)
    time = None if point.time_ms is None else float(f"{point.time_ms:.6g}")
    return {"rmse": float(f"{point.rmse:.6g}"), "time_ms": time, "justified": verdict.justified, "reason": verdict.reason}


def write(description: str, studies: Sequence[DocumentStudy], force: bool = False) -> str:
    """Writes the record next to a description and returns its path. OSError where it cannot be written; what is there is then unchanged.

    A file there that msaa-lint did not write is replaced only if `force` is true.
    """
    path = path_of(description)
    write_file(path, text(studies).encode(), None if force else is_own_output)
    return path
