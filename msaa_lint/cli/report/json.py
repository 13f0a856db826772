"""The versioned JSON for other programs; `json_v1.schema.json` beside this file is its schema.

Texts are as the input has them but for lone surrogates, which JSON text cannot carry, and for what is longer than `escape.LONGEST`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from .data import dump, write_list
from .escape import clip, whole
from .paths import relative
from .place import place
from .summary import tally, together, usable_price

if TYPE_CHECKING:
    from msaa_lint.core.finding import Finding, Result
    from msaa_lint.core.text.span import Span

    from . import Options, Write

SCHEMA = "msaa-lint/json-v1"


def render(result: Result, out: Write, options: Options) -> None:
    """Prints one JSON object, silenced findings in a list of their own."""
    head: dict[str, object] = {"schema": SCHEMA}
    if options.version:
        head["version"] = options.version
    if options.edition:
        head["edition"] = options.edition
    out("{\n" + "".join(f"  {dump(key)}: {dump(value)},\n" for key, value in head.items()) + '  "findings": ')
    write_list((_finding(finding, result, options) for finding in result.findings), out, "  ")
    out(',\n  "suppressed": ')
    suppressed = (
        {"how": entry.how, "reason": _text(entry.reason), "finding": _finding(entry.finding, result, options)}
        for entry in result.suppressed
    )
    write_list(suppressed, out, "  ")
    out(',\n  "undecided": ')
    undecided = (
        {
            "rule": _text(entry.rule),
            "code": _text(entry.code),
            "file": whole(relative(entry.file, options.root)),
            "subject": _text(entry.subject),
            "missing": [_text(fact) for fact in entry.missing],
        }
        for entry in result.undecided
    )
    write_list(undecided, out, "  ")
    out(f',\n  "summary": {dump(_summary(result))}\n}}\n')


def _finding(finding: Finding, result: Result, options: Options) -> dict[str, object]:
    price, fix = usable_price(finding), finding.fix
    return {
        "rule": _text(finding.rule),
        "code": _text(finding.code),
        "severity": finding.severity,
        "confidence": finding.confidence,
        "message": _text(finding.message),
        "file": whole(relative(finding.file, options.root)),
        **_place(result, finding.file, finding.span),
        "subject": _text(finding.subject),
        "fixable": bool(fix and fix.edits),
        "fix": {"title": _text(fix.title), "safe": fix.safe, "shown": fix.shown} if fix else None,
        "price": price._asdict() if price else None,
        "labels": [{**_place(result, finding.file, label.span), "text": _text(label.text)} for label in finding.labels],
        "notes": [_text(note) for note in finding.notes],
        "help": _text(finding.help),
        "seen": {**finding.seen._asdict(), "by": _text(finding.seen.by)} if finding.seen else None,
    }


def _place(result: Result, file: str, span: Span | None) -> dict[str, int | None]:
    at = place(result, file, span)
    if at is None:
        return {"line": None, "column": None, "end_line": None, "end_column": None}
    return {"line": at.line, "column": at.column, "end_line": at.end_line, "end_column": at.end_column}


def _summary(result: Result) -> dict[str, object]:
    count, price = tally(result), together(result)
    return {
        "findings": count.findings,
        "errors": count.errors,
        "warnings": count.warnings,
        "notes": count.notes,
        "fixable": count.safe_fixes + count.unsafe_fixes,
        "suppressed": count.suppressed,
        "files": count.files,
        "files_with_findings": count.files_with_findings,
        "undecided": count.undecided,
        "undecided_rules": count.undecided_rules,
        "missing": {_text(fact): rules for fact, rules in count.missing},
        "price": price._asdict() if price else None,
    }


def _text(text: str) -> str:
    return whole(clip(text))
