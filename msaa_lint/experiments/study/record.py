"""The record of a study, next to its description: rule MSAA101 accepts a sample count above four
that it justifies. `study_record` reads it.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import Any, NamedTuple

from msaa_lint.core.atomic_write import write_file
from msaa_lint.frame.facts.frame import Frame
from msaa_lint.input.content import is_own_output
from msaa_lint.linter.study_record import DEFAULT_SHADING, MAX_TEXT, SCHEMA, digests, path_of

from .advice import MAX_EFFICIENT, Ruling, ruling
from .measures import ERROR, Measure
from .points import MSAA, Point
from .shading import Shading


class DocumentStudy(NamedTuple):
    """The study of one document of a description: its frame, the source of the times (empty without
    any) and whether that is a software driver, and the points of its scene under the cost of
    shading that decides, with the error that decides.
    """

    frame: Frame
    device: str
    size: tuple[int, int]
    points: Sequence[Point]
    shading: Shading = Shading(DEFAULT_SHADING)
    measure: Measure = ERROR
    software: bool = False


def text(studies: Sequence[DocumentStudy], description: str) -> str:
    """The text of the record of a description at a path, with sorted keys so that diffs are
    minimal. ValueError where no sample count was measured.
    """
    record = {"schema": SCHEMA, "studies": [_study(study, description) for study in studies]}
    return json.dumps(record, indent=2, sort_keys=True, allow_nan=False) + "\n"


def _study(study: DocumentStudy, description: str) -> dict[str, Any]:
    points = [
        point
        for point in study.points
        if point.technique.kind == MSAA and study.measure.is_finite(point)
    ]
    if not points:
        raise ValueError("no sample count was measured")
    timed = any(point.time_ms is not None for point in points)
    shading = {
        "name": _clip(study.shading.name),
        "full_screen_ms": _figure(study.shading.full_screen_ms),
    }
    return {
        "inputs": digests(study.frame, description),
        "device": _clip(study.device) if timed else "",
        "shading": shading if timed else None,
        "error_of": study.measure.name,
        "size": list(study.size),
        "counts": {str(point.technique.samples): _count(point, study) for point in points},
    }


def _count(point: Point, study: DocumentStudy) -> dict[str, Any]:
    """A count's error and time, and whether it is justified; counts up to four need no
    justification.
    """
    samples = point.technique.samples
    verdict = (
        ruling(study.points, samples, study.measure, software=study.software)
        if samples > MAX_EFFICIENT
        else Ruling(True)
    )
    error, time = _figure(study.measure.of(point)), _figure(point.time_ms)
    return {
        "error": error,
        "time_ms": time,
        "justified": verdict.justified,
        "reason": verdict.reason,
    }


def _clip(text: str) -> str:
    return text.encode("utf-8", "replace").decode()[:MAX_TEXT]


def _figure(value: float | None) -> float | None:
    """A number to six significant digits."""
    return None if value is None else float(f"{value:.6g}")


def write(description: str, studies: Sequence[DocumentStudy], force: bool = False) -> str:
    """Writes the record next to a description and returns its path. OSError where it cannot be
    written; what is there is then unchanged.

    A file there that msaa-lint did not write is replaced only if `force` is true.
    """
    path = path_of(description)
    write_file(path, text(studies, description).encode(), None if force else is_own_output)
    return path
