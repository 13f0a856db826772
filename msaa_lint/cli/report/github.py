"""GitHub Actions: findings as workflow commands, which become annotations, and a table in the step
summary.
"""

from __future__ import annotations

import os
from collections import Counter

from msaa_lint.core.finding import Finding, Result
from msaa_lint.core.text.source import Source

from . import Options, Write
from .annotations import annotation_lines, most_important, unread_notes
from .escape import display, escape
from .markdown import escape_markdown, table
from .paths import relative
from .place import place
from .summary import plural, summary

MAX_ANNOTATIONS = 10
"""Annotations of one level that GitHub keeps for a step; it silently drops the rest."""

MAX_SUMMARY_BYTES = 1 << 20
"""The size from which GitHub drops the whole summary of a step."""

_LEVEL = {"error": "error", "warning": "warning", "note": "notice"}


def render(result: Result, out: Write, options: Options) -> None:
    """Prints at most ten commands per level, the most important first, and appends the summary to
    the file `options.step_summary`.
    """
    room = dict.fromkeys(_LEVEL, MAX_ANNOTATIONS)
    if (
        max(Counter(finding.severity for finding in result.findings).values(), default=0)
        > MAX_ANNOTATIONS
    ):
        room["note"] -= 1  # for the last one, which counts the others
    left_out = len(result.findings)
    for finding in most_important(result.findings, MAX_ANNOTATIONS):
        if room[finding.severity] > 0:
            room[finding.severity] -= 1
            left_out -= 1
            out(_command(finding, result, options) + "\n")
    for finding in unread_notes(result)[: max(room["note"] - bool(left_out), 0)]:
        out(_command(finding, result, options) + "\n")
    path = (
        os.environ.get("GITHUB_STEP_SUMMARY", "")
        if options.step_summary is None
        else options.step_summary
    )
    problem = _append(path, result, options) if path else ""
    if left_out:
        where = (
            "see the summary of this step"
            if path and not problem
            else "GitHub shows at most ten per level and step"
        )
        out(f"::notice title=msaa-lint::{plural(left_out, 'more finding')}, {where}\n")
    if problem:
        out(
            "::warning "
            f"title=msaa-lint::{_data('cannot write the summary of this step: ' + display(problem))}\n"  # noqa: E501
        )


def _command(finding: Finding, result: Result, options: Options) -> str:
    properties: dict[str, str | int] = {"file": escape(relative(finding.file, options.root))}
    source = result.sources.get(finding.file)
    if finding.span is not None and source is not None and source.origins is not None:
        at = place(result, finding.file, finding.span)
        properties |= {"line": at.line, "endLine": at.line} if at is not None else {}
    elif finding.span is not None and source is not None:
        properties |= _region(source, finding.span.start, finding.span.end)
    properties["title"] = f"{display(finding.rule)} ({display(finding.code)})"
    joined = ",".join(f"{name}={_property(str(value))}" for name, value in properties.items())
    return (
        f"::{_LEVEL[finding.severity]} "
        f"{joined}::{_data(chr(10).join(annotation_lines(finding, options)))}"
    )


def _region(source: Source, start: int, end: int) -> dict[str, str | int]:
    """Lines, and columns if it is one line, in GitHub's terms; never below the last line with text,
    where it shows nothing.
    """
    text = source.text
    start = min(start, len(text))
    end = max(start, min(end, len(text)))
    end = start + len(text[start:end].rstrip("\r\n \t"))
    if start == end and not text[start : start + 1].strip():
        start = end = len(text[:start].rstrip("\r\n \t"))
    line, column = source.position(start)
    end_line, end_column = source.position(end)
    if line == end_line:
        return {"line": line, "endLine": end_line, "col": column, "endColumn": end_column}
    return {"line": line, "endLine": end_line}


def _append(path: str, result: Result, options: Options) -> str:
    """Appends the table to the summary, as far as it fits; returns the error, or an empty
    string.
    """
    try:
        with open(path, "ab") as file:
            room = MAX_SUMMARY_BYTES - file.seek(0, os.SEEK_END)
            head = "".join(f"{escape_markdown(line)}\n\n" for line in summary(result, options))
            head = f"### msaa-lint\n\n{head}"
            rows = table(result, options, room - _size(head), _size) if result.findings else ()
            text = head + "".join(rows) + "\n"
            if _size(text) > room:
                return "it is full"
            file.write(text.encode())
    except (OSError, ValueError) as error:
        return str(error)
    return ""


def _size(text: str) -> int:
    return len(text.encode())


def _data(text: str) -> str:
    return text.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A")


def _property(text: str) -> str:
    return _data(text).replace(":", "%3A").replace(",", "%2C")
