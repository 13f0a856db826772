"""The page of `msaa-lint confirm`."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from msaa_lint.core.finding import Finding
from msaa_lint.experiments.confirm.outcome import (
    CONFIRMED,
    FAILED,
    STATUSES,
    WRONG,
    DeviceRun,
    ShownImage,
    Verdict,
)
from msaa_lint.experiments.confirm.pixels import ImageComparison
from msaa_lint.linter.rules.reference_links import rule_address

from .. import Options, Write
from ..confirm_text import (
    CREATED,
    PIXELS,
    agreement_of,
    heading,
    reasons,
    summary,
    time_text,
    times_of,
)
from ..cost_rows import LINE, Row, Table
from .page import asset, write_page
from .vega import data_url

KINDS = {CONFIRMED: "good", **dict.fromkeys((*WRONG, FAILED), "error")}
"""The color of a status; those of others are warnings."""

SIDE = 320
"""Pictures are enlarged by whole factors until they are about as wide, in CSS pixels."""


def render(
    runs: Sequence[DeviceRun], errors: Sequence[Finding], out: Write, options: Options
) -> None:
    """Writes the verdicts of each device, then each pass with its messages and its pictures."""
    devices = [_device(run, number, options) for number, run in enumerate(runs, 1)]
    context = {
        "title": f"Confirmation on {runs[0].title}"
        if len(runs) == 1
        else f"Confirmation on {len(runs)} devices",
        "errors": [f"{error.file}: {error.message}" for error in errors],
        "comparison": _comparison([run for run in runs if not run.unusable]),
        "devices": devices,
    }
    write_page(
        "confirm.html", context, out, styles=[asset("confirm.css")], scripts=[asset("confirm.js")]
    )


def _comparison(runs: Sequence[DeviceRun]) -> Table | None:
    """The status and time of each pass by device; None for a single device."""
    if len(runs) < 2:
        return None
    rows: dict[tuple[str, str], dict[int, str]] = {}
    names: dict[tuple[str, str], tuple[str, str]] = {}
    for number, run in enumerate(runs):
        for verdict in run.verdicts:
            time = verdict.times.as_written if verdict.times is not None else None
            names[verdict.file, verdict.path] = verdict.file, verdict.name
            text = verdict.status + (f", {time_text(time)} ms" if time is not None else "")
            rows.setdefault((verdict.file, verdict.path), {})[number] = text
    cells = [
        Row(LINE, (*names[key], *(texts.get(n, "-") for n in range(len(runs)))), ())
        for key, texts in rows.items()
    ]
    return Table(("file", "pass", *(run.title for run in runs)), (), cells)


def _device(run: DeviceRun, number: int, options: Options) -> dict[str, Any]:
    if run.unusable:
        return {"id": f"device-{number}", "name": run.title, "unusable": run.unusable}
    counts = {
        status: sum(verdict.status == status for verdict in run.verdicts) for status in STATUSES
    }
    is_timed = any(verdict.times is not None for verdict in run.verdicts)
    return {
        "id": f"device-{number}",
        "name": run.title,
        "unusable": "",
        "heading": heading(run),
        "notes": run.notes,
        "tiles": [
            (count, "", status, KINDS.get(status, "warning"))
            for status, count in counts.items()
            if count
        ],
        "heads": ["pass", "status", "created", "mistakes reported by", "pixels after fixes"],
        # Of these, whether a cell is a figure.
        "times": [
            ("as written, ms", True),
            ("fixed, ms", True),
            ("difference here", False),
            ("cost model, MB/s", True),
        ]
        if is_timed
        else [],
        "passes": [
            _pass(verdict, f"pass-{number}-{n}", is_timed, options)
            for n, verdict in enumerate(run.verdicts, 1)
        ],
        "cannot_show": run.cannot_show if is_timed else "",
        "summary": [] if options.quiet else list(summary(run)),
    }


def _pass(verdict: Verdict, name: str, is_timed: bool, options: Options) -> dict[str, Any]:
    comparisons = {image.image: image for image in verdict.images}
    return {
        "id": name,
        "name": f"{verdict.file}: {verdict.name}" if verdict.name else verdict.file,
        "status": verdict.status,
        "kind": KINDS.get(verdict.status, "warning"),
        "cells": [CREATED[verdict.created], agreement_of(verdict), PIXELS[verdict.pixels_equal]],
        "times": times_of(verdict) if is_timed else [],
        "rules": [
            (f"{code} {rule}", rule_address(options.docs_url, code, rule))
            for code, rule in verdict.rules
        ],
        "reasons": reasons(verdict, options.verbose),
        "images": [
            _image(image, comparisons.get(image.image), f"{name}-{n}")
            for n, image in enumerate(verdict.shown, 1)
        ],
    }


def _image(image: ShownImage, comparison: ImageComparison | None, name: str) -> dict[str, Any]:
    scale = max(1, round(SIDE / image.width))
    return {
        "id": name,
        "name": image.image,
        "width": image.width * scale,
        "height": image.height * scale,
        "size": f"{image.width}x{image.height}"
        + (f", enlarged {scale} times" if scale > 1 else ""),
        "as_written": data_url(image.as_written, "image/png"),
        "fixed": data_url(image.fixed, "image/png") if image.fixed else "",
        "difference": data_url(image.difference, "image/png") if image.difference else "",
        "text": comparison.text
        if comparison is not None
        else "there is no fixed version to compare it with",
        "scale": _scale(comparison),
    }


def _scale(comparison: ImageComparison | None) -> str:
    """How a picture of the difference is to be read."""
    if comparison is None or not comparison.differing:
        return "Difference: black, because no texel differs"
    steps = (
        f"{comparison.greatest:.0f} step{'' if comparison.greatest == 1 else 's'} of the format"
        if comparison.greatest < 1e300
        else "not a number"
    )
    return (
        "Difference, amplified: texels that are equal are black, and the greatest difference "
        f"({steps}) is white; the least is a dark gray"
    )
