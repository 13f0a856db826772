"""The versioned JSON of `msaa-lint check`; `json_v1.schema.json` next to this file is its
schema.
"""

from __future__ import annotations

from msaa_lint.core.finding import (
    CaptureSummary,
    Finding,
    Fix,
    InputSummary,
    Result,
    Saving,
    Suppressed,
    Undecided,
    Unread,
)
from msaa_lint.core.rendered import RenderedFinding, RenderedPart
from msaa_lint.core.text.span import Label, Span
from msaa_lint.linter.rules.reference_links import rule_address

from . import Options, Write
from .counts import counts, missing
from .data import SEPARATOR, Dumped, Json, dump, head, text, write_object
from .escape import escape_surrogates
from .inputs import COUNTS
from .paths import relative
from .place import Place, place
from .summary import converted_saving, notes_of, tally, usable_price

SCHEMA = "msaa-lint/json-v1"
_COUNTS = (
    "findings", "errors", "warnings", "notes", "fixable", "suppressed", "files",
    "files_with_findings", "undecided", "undecided_rules",
)  # fmt: skip


def render(result: Result, out: Write, options: Options) -> None:
    """Prints one JSON object, with suppressed findings in a list of their own."""
    members: Json = head(SCHEMA, options.version)
    if options.edition:
        members["edition"] = options.edition
    rendered = result.rendered
    if rendered is None:
        members |= {
            "findings": (_finding(finding, result, options) for finding in result.findings),
            "suppressed": (_suppressed(entry, result, options) for entry in result.suppressed),
            "undecided": (_undecided(entry, result, options) for entry in result.undecided),
            "inputs": (_input(entry, result, options) for entry in result.inputs),
        }
    else:
        members |= {
            name: map(Dumped, getattr(rendered, name))
            for name in ("findings", "suppressed", "undecided", "inputs")
        }
    members["summary"] = _summary(result)
    write_object(members, out)


def part(result: Result, options: Options) -> RenderedPart:
    """What one input adds to the lists of the object, and to its summary."""
    return RenderedPart(
        [
            RenderedFinding(dump(_finding(each, result, options)), each.file, each.level)
            for each in result.findings
        ],
        SEPARATOR.join(dump(_suppressed(entry, result, options)) for entry in result.suppressed),
        SEPARATOR.join(dump(_undecided(entry, result, options)) for entry in result.undecided),
        {entry.file: dump(_input(entry, result, options)) for entry in result.inputs},
        counts(result._replace(findings=())),
    )


def _finding(finding: Finding, result: Result, options: Options) -> Json:
    price, fix = usable_price(finding), finding.fix
    return {
        "rule": text(finding.rule),
        "code": text(finding.code),
        "url": rule_address(options.docs_url, finding.code, finding.rule) or None,
        "severity": finding.severity,
        "confidence": finding.confidence,
        "message": text(finding.message),
        "file": escape_surrogates(relative(finding.file, options.root)),
        **_place(result, finding.file, finding.span),
        "subject": text(finding.subject),
        "fixable": bool(fix and fix.edits and not fix.refusal),
        "fix": _fix(fix) if fix else None,
        "price": price._asdict() if price else None,
        "labels": [_label(label, finding, result, options) for label in finding.labels],
        "notes": [text(note) for note in notes_of(finding)],
        "help": text(finding.help),
        "seen": {**finding.capture_location._asdict(), "by": text(finding.capture_location.by)}
        if finding.capture_location
        else None,
    }


def _label(label: Label, finding: Finding, result: Result, options: Options) -> Json:
    file = label.file or finding.file
    return {
        "file": escape_surrogates(relative(file, options.root)),
        **_place(result, file, label.span),
        "text": text(label.text),
    }


def _fix(fix: Fix) -> Json:
    return {
        "title": text(fix.title),
        "safe": fix.safe,
        "shown": fix.shown,
        "choice": fix.choice,
        "refusal": text(fix.refusal) if fix.refusal else None,
    }


def _suppressed(entry: Suppressed, result: Result, options: Options) -> Json:
    return {
        "how": entry.how,
        "reason": text(entry.reason),
        "finding": _finding(entry.finding, result, options),
    }


def _undecided(entry: Undecided, result: Result, options: Options) -> Json:
    return {
        "rule": text(entry.rule),
        "code": text(entry.code),
        "file": escape_surrogates(relative(entry.file, options.root)),
        "subject": text(entry.subject),
        "missing": [text(fact) for fact in entry.missing],
        "keys": [
            {
                "key": text(key.path),
                "values": text(key.values),
                "converted": key.converted,
                **_place(result, entry.file, key.span),
            }
            for key in entry.keys
        ],
    }


def _input(entry: InputSummary, result: Result, options: Options) -> Json:
    unread = entry.unread
    return {
        "file": escape_surrogates(relative(entry.file, options.root)),
        "format": entry.format or None,
        **{name: getattr(entry, name) for name in COUNTS},
        "failed": entry.failed,
        "unread": _unread(unread, entry.file, result) if unread is not None else None,
        "capture": _capture(entry.capture) if entry.capture is not None else None,
    }


def _unread(unread: Unread, file: str, result: Result) -> Json:
    return {
        **_place(result, file, unread.span),
        "message": text(unread.message),
        "unknown": text(unread.unknown) or None,
    }


def _capture(capture: CaptureSummary) -> Json:
    names = ("program", "engine", "device")
    return {
        **{name: text(getattr(capture, name)) or None for name in names},
        "frames": capture.frames,
        "kinds": capture.kinds,
        "passes": {str(samples): count for samples, count in capture.passes.items()},
        "multisampled_images": capture.multisampled_images,
        "multisampled_pipelines": capture.multisampled_pipelines,
        "dropped_frames": capture.dropped_frames,
        "left_out": text(capture.left_out) or None,
    }


def _place(result: Result, file: str, span: Span | None) -> Json:
    at = place(result, file, span)
    return at._asdict() if at is not None else dict.fromkeys(Place._fields)


def _summary(result: Result) -> Json:
    figures, count, converted = counts(result), tally(result), converted_saving(result)
    files = count.savings
    return {
        **{name: getattr(count, name) for name in _COUNTS},
        "missing": {text(fact): rules for fact, rules in count.missing},
        "missing_keys": {text(key): rules for key, rules in missing(figures, "key")},
        "checked": {name: figures.numbers.get(name, 0) for name in COUNTS},
        "unread": figures.numbers.get("unread", 0),
        "price": files.all.price._asdict() if files.all.price else None,
        "savings": {
            "fix": _saving(files.safe),
            "unsafe_fixes": _saving(files.all),
            "converted_fix": _saving(converted.safe),
            "converted_unsafe_fixes": _saving(converted.all),
            "untried": len(result.untried),
        },
    }


def _saving(saving: Saving) -> Json:
    return {"findings": saving.findings, "price": saving.price._asdict() if saving.price else None}
