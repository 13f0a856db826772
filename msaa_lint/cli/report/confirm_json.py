"""The versioned JSON of `msaa-lint confirm`; `confirm_v1.schema.json` next to this file is its
schema.

With one device its members are at the top; with several they are in `devices`.
"""

from __future__ import annotations

from collections.abc import Sequence

from msaa_lint.core.finding import Finding
from msaa_lint.experiments.confirm.outcome import AgreementRow, DeviceRun, Times, Verdict

from . import Options, Write
from .data import Json, head, text, write_object

SCHEMA = "msaa-lint/confirm-v1"


def render(
    runs: Sequence[DeviceRun], errors: Sequence[Finding], out: Write, options: Options
) -> None:
    """Prints one JSON object; `errors` are findings about inputs that cannot be used."""
    devices = [_device(run) for run in runs]
    members: Json = {
        **head(SCHEMA, options.version),
        **(devices[0] if len(devices) == 1 else {"devices": devices}),
        "errors": [
            {"file": text(error.file), "code": error.code, "message": text(error.message)}
            for error in errors
        ],
    }
    write_object(members, out)


def _device(run: DeviceRun) -> Json:
    device = run.device
    return {
        "device": None
        if device is None
        else {
            "name": text(device.name),
            "type": device.type,
            "api_version": text(device.api_version),
            "driver": text(device.driver),
            "software": device.software,
        },
        "layer": None
        if run.layer is None
        else {str(key): _value(value) for key, value in run.layer.items()},
        "unusable": text(run.unusable) or None,
        "passes": [_pass(verdict) for verdict in run.verdicts],
        "agreement": run.agreement,
        "cannot_show": text(run.cannot_show),
        "notes": [text(note) for note in run.notes],
    }


def _pass(verdict: Verdict) -> Json:
    return {
        "file": text(verdict.file),
        "name": text(verdict.name),
        "path": text(verdict.path),
        "status": verdict.status,
        "reason": text(verdict.reason),
        "created": verdict.created,
        "messages": [_message(row) for row in verdict.agreement if row.verdict != "ours"],
        "ours": [
            {"rule": text(row.rule), "reason": text(row.reason)}
            for row in verdict.agreement
            if row.verdict == "ours"
        ],
        "findings": [text(code) for code in verdict.findings],
        "agrees": verdict.agrees,
        "pixels_equal": verdict.pixels_equal,
        "images": [
            {
                "image": text(image.image),
                "equal": image.equal,
                "differing": image.differing,
                "pixels": image.pixels,
                "first": list(image.first) if image.first is not None else None,
                "tolerance": image.tolerance,
                "says": text(image.text),
            }
            for image in verdict.images
        ],
        "time_ms": _times(verdict.times),
        "model": None if verdict.model is None else dict(verdict.model),
        "notes": [text(note) for note in verdict.notes],
        "pictures": [text(path) for path in verdict.pictures],
    }


def _message(row: AgreementRow) -> Json:
    return {
        "id": text(row.id),
        "family": text(row.family) or None,
        "rule": text(row.rule) or None,
        "text": text(row.text),
        "verdict": row.verdict,
        "reason": text(row.reason) or None,
    }


def _times(times: Times | None) -> Json | None:
    if times is None or times.as_written is None:
        return None
    difference = times.difference
    return {
        "as_written": times.as_written.json(),
        "fixed": times.fixed.json() if times.fixed is not None else None,
        "difference": None
        if difference is None
        else {
            "share": round(difference.share, 6),
            "real": difference.real,
            "says": difference.text,
        },
    }


def _value(value: object) -> object:
    """What the layer states, as JSON."""
    if isinstance(value, str):
        return text(value)
    if isinstance(value, (list, tuple)):
        return [_value(item) for item in value]
    return value if isinstance(value, (bool, int)) else None
