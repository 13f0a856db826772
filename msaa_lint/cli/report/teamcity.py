"""TeamCity: findings as service messages, which become inspections of the build."""

from __future__ import annotations

import re
from itertools import chain

from msaa_lint.core.diagnostics import DIAGNOSTICS
from msaa_lint.core.finding import Finding, Result

from . import Options, Write
from .annotations import annotation_lines, unread_notes
from .escape import clip, display, escape
from .paths import relative
from .place import place

MAX_NAME = 255
"""Characters of an inspection's identifier and name that TeamCity accepts."""

MAX_TEXT = 4000
"""Characters of a description, a message, and a path that TeamCity accepts."""

_SEVERITY = {"note": "INFO", "warning": "WARNING", "error": "ERROR"}
_ESCAPES = {"|": "||", "'": "|'", "[": "|[", "]": "|]", "\n": "|n", "\r": "|r"}


def render(result: Result, out: Write, options: Options) -> None:
    """Prints a message per finding and per input that shows no pass to check, and before the first
    one of each rule what the rule is.
    """
    summaries = {rule.code: rule.summary for rule in (*DIAGNOSTICS.values(), *result.rules)}
    described: set[str] = set()
    for finding in chain(result.findings, unread_notes(result)):
        code = clip(display(finding.code), MAX_NAME)
        if code not in described:
            described.add(code)
            # The code comes first: TeamCity displays a description that begins with `<html>` as a
            # page.
            description = clip(
                f"{code}: {display(summaries.get(finding.code) or finding.rule)}", MAX_TEXT
            )
            name = clip(display(finding.rule), MAX_NAME)
            out(
                _message(
                    "inspectionType",
                    id=code,
                    name=name,
                    category="msaa-lint",
                    description=description,
                )
            )
        out(_inspection(finding, code, result, options))


def _inspection(finding: Finding, code: str, result: Result, options: Options) -> str:
    values = {
        "typeId": code,
        "message": clip("\n".join(annotation_lines(finding, options)), MAX_TEXT),
        "file": clip(escape(relative(finding.file, options.root)), MAX_TEXT),
    }
    at = place(result, finding.file, finding.span)
    if at is not None:
        values["line"] = str(at.line)
    return _message("inspection", **values, SEVERITY=_SEVERITY[finding.severity])


def _message(kind: str, /, **values: str) -> str:
    joined = "".join(f" {name}='{_value(text)}'" for name, text in values.items())
    return f"##teamcity[{kind}{joined}]\n"


def _value(text: str) -> str:
    """`text` in ASCII, since the agent reads the output in the encoding of its machine."""
    return re.sub(r"[|'\[\]\n\r]|[^\x00-\x7f]", _escaped, text)


def _escaped(match: re.Match[str]) -> str:
    character = match[0]
    if character in _ESCAPES:
        return _ESCAPES[character]
    units = character.encode("utf-16-be", "surrogatepass").hex().upper()
    return "".join(f"|0x{units[n : n + 4]}" for n in range(0, len(units), 4))
