"""The record of a study, beside the description that it is of: what rule MSAA101 takes a count above four by. `studied` reads it."""

from __future__ import annotations

import contextlib
import json
import math
import os
from collections.abc import Sequence
from typing import Any, NamedTuple

from msaa_lint.frame.facts.frame import Frame
from msaa_lint.linter.study_record import MAX_TEXT, SCHEMA, digests, path_of

from .advice import EFFICIENT, Ruling, ruling
from .points import MSAA, Point


class Recorded(NamedTuple):
    """The study of one document of a description: its frame, where times are from (empty: none), and the points of its scene."""

    frame: Frame
    device: str
    size: tuple[int, int]
    points: Sequence[Point]


def text(studies: Sequence[Recorded]) -> str:
    """The text of a record: sorted, so that a change shows as the lines that changed. ValueError where no count was measured."""
    return json.dumps({"schema": SCHEMA, "studies": [_study(each) for each in studies]}, indent=2, sort_keys=True, allow_nan=False) + "\n"


def _study(recorded: Recorded) -> dict[str, Any]:
    points = [point for point in recorded.points if point.technique.kind == MSAA and math.isfinite(point.rmse)]
    if not points:
        raise ValueError("no sample count was measured")
    timed = any(point.time_ms is not None for point in points)
    return {
        "inputs": digests(recorded.frame),
        "device": recorded.device.encode("utf-8", "replace").decode()[:MAX_TEXT] if timed else "",
        "size": list(recorded.size),
        "counts": {str(point.technique.samples): _count(point, recorded.points) for point in points},
    }


def _count(point: Point, points: Sequence[Point]) -> dict[str, Any]:
    """A count's error and time, to six figures, and whether it is justified above four; counts of at most four need no justification."""
    samples = point.technique.samples
    found = ruling(points, samples) if samples > EFFICIENT else Ruling(True)
    time = None if point.time_ms is None else _rounded(point.time_ms)
    return {"rmse": _rounded(point.rmse), "time_ms": time, "justified": found.justified, "reason": found.reason}


def _rounded(value: float) -> float:
    return float(f"{value:.6g}")


def write(description: str, studies: Sequence[Recorded]) -> str:
    """Writes the record beside a description, and gives its path; OSError where that cannot be. A run that is stopped leaves the old one
    whole."""
    path = path_of(description)
    made = text(studies)
    beside = f"{path}.{os.getpid()}.tmp"
    try:
        with open(beside, "x", encoding="utf-8", newline="\n") as file:
            file.write(made)
        os.replace(beside, path)
    except BaseException:
        with contextlib.suppress(OSError):
            os.unlink(beside)
        raise
    return path
