"""The versioned JSON of `msaa-lint confirm`; `confirm_v1.schema.json` beside this file is its schema.

With one device its keys stand at the top, with several they are in `devices`. Texts are as the input, the driver and the layer have them,
but for lone surrogates and for what is longer than `escape.LONGEST`.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from msaa_lint.core.finding import Finding
from msaa_lint.experiments.confirm.outcome import DeviceRun
from msaa_lint.experiments.confirm.verdict import Said, Times, Verdict

from . import Write
from .data import dump, write_list
from .escape import clip, whole

SCHEMA = "msaa-lint/confirm-v1"

Json = dict[str, Any]


def render(runs: Sequence[DeviceRun], wrong: Sequence[Finding], out: Write, version: str = "") -> None:
    """Prints one JSON object; `wrong` are findings that say why an input could not be used."""
    out("{\n")
    out(f'  "schema": {dump(SCHEMA)},\n')
    if version:
        out(f'  "version": {dump(version)},\n')
    if len(runs) == 1:
        _device(runs[0], out, "  ")
        out(",\n")
    else:
        out('  "devices": [')
        for number, run in enumerate(runs):
            out((",\n" if number else "\n") + "    {\n")
            _device(run, out, "      ")
            out("\n    }")
        out("\n  ],\n" if runs else "],\n")
    out('  "errors": ')
    write_list(({"file": _text(f.file), "code": f.code, "message": _text(f.message)} for f in wrong), out, "  ")
    out("\n}\n")


def _device(run: DeviceRun, out: Write, indent: str) -> None:
    device = run.device
    described = None
    if device is not None:
        described = {
            "name": _text(device.name),
            "type": device.type,
            "api_version": _text(device.api_version),
            "driver": _text(device.driver),
            "software": device.software,
        }
    layer = None if run.layer is None else {str(key): _value(value) for key, value in run.layer.items()}
    for key, value in (("device", described), ("layer", layer), ("unusable", _text(run.unusable) or None)):
        out(f"{indent}{dump(key)}: {dump(value)},\n")
    out(f'{indent}"passes": ')
    write_list((_pass(verdict) for verdict in run.verdicts), out, indent)
    out(f',\n{indent}"agreement": {dump(run.agreement)},\n')
    out(f'{indent}"cannot_show": {dump(_text(run.cannot_show))},\n')
    out(f'{indent}"notes": {dump([_text(note) for note in run.notes])}')


def _pass(verdict: Verdict) -> Json:
    return {
        "file": _text(verdict.file),
        "name": _text(verdict.name),
        "path": _text(verdict.path),
        "status": verdict.status,
        "reason": _text(verdict.reason),
        "created": verdict.created,
        "messages": [_message(each) for each in verdict.said if each.verdict != "ours"],
        "ours": [{"rule": _text(each.rule), "reason": _text(each.reason)} for each in verdict.said if each.verdict == "ours"],
        "findings": [_text(code) for code in verdict.findings],
        "agrees": verdict.agrees,
        "pixels_equal": verdict.pixels_equal,
        "images": [
            {
                "image": _text(each.image),
                "equal": each.equal,
                "differing": each.differing,
                "pixels": each.pixels,
                "first": list(each.first) if each.first is not None else None,
                "tolerance": each.tolerance,
                "says": _text(each.words),
            }
            for each in verdict.images
        ],
        "time_ms": _times(verdict.times),
        "model": None if verdict.model is None else dict(verdict.model),
        "notes": [_text(note) for note in verdict.notes],
        "pictures": [_text(path) for path in verdict.pictures],
    }


def _message(said: Said) -> Json:
    return {
        "id": _text(said.id),
        "family": _text(said.family) or None,
        "rule": _text(said.rule) or None,
        "text": _text(said.text),
        "verdict": said.verdict,
        "reason": _text(said.reason) or None,
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
        else {"share": round(difference.share, 6), "real": difference.real, "says": difference.words},
    }


def _value(value: object) -> object:
    if isinstance(value, str):
        return _text(value)
    if isinstance(value, (list, tuple)):
        return [_value(each) for each in value]
    return value if isinstance(value, (bool, int)) else None


def _text(text: str) -> str:
    return whole(clip(text))
