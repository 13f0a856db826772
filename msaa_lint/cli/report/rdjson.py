"""Reviewdog's diagnostics: one JSON object, with the safe fixes as suggestions."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache, partial
from itertools import chain

from msaa_lint.core.finding import Finding, Fix, Result
from msaa_lint.core.text.source import Source
from msaa_lint.linter.rules.reference_links import rule_address

from . import Options, Write
from .annotations import annotation_lines, unread_notes
from .data import Json, write_object
from .escape import MAX_LENGTH, display, escape, escape_surrogates
from .paths import relative
from .place import place

MAX_POSITIONS = 16
"""The number of texts whose positions stay known, since findings come file by file."""

_SEVERITY = {"note": "INFO", "warning": "WARNING", "error": "ERROR"}


def render(result: Result, out: Write, options: Options) -> None:
    """Prints the object; its list is empty if there are no findings."""
    positions = lru_cache(MAX_POSITIONS)(partial(_positions, result))
    diagnostics = map(
        partial(_diagnostic, result, positions, options),
        chain(result.findings, unread_notes(result)),
    )
    write_object({"source": {"name": "msaa-lint"}, "diagnostics": diagnostics}, out)


def _positions(result: Result, file: str) -> _Positions | None:
    """The positions of the text of a file; None if it has none, or one that was made from a
    capture.
    """
    source = result.sources.get(file)
    return _Positions(source) if source is not None and source.origins is None else None


def _diagnostic(
    result: Result,
    positions: Callable[[str], _Positions | None],
    options: Options,
    finding: Finding,
) -> Json:
    location: Json = {"path": escape(relative(finding.file, options.root))}
    at = place(result, finding.file, finding.span)
    in_text = positions(finding.file)
    if in_text is not None and finding.span is not None:
        location["range"] = in_text.range(finding.span.start, finding.span.end)
    elif at is not None:
        location["range"] = {"start": {"line": at.line}}
    address = rule_address(options.docs_url, finding.code, finding.rule)
    diagnostic: Json = {
        "message": "\n".join(annotation_lines(finding, options)),
        "location": location,
        "severity": _SEVERITY[finding.severity],
        "code": {"value": display(finding.rule), **({"url": address} if address else {})},
    }
    if (
        in_text is not None
        and finding.fix is not None
        and finding.fix.safe
        and not finding.fix.shown
    ):
        diagnostic |= in_text.suggestions(finding.fix)
    return diagnostic


class _Positions:
    """The positions of a text as reviewdog counts them: columns from 1, in bytes of UTF-8."""

    def __init__(self, source: Source) -> None:
        self.source = source
        # Of each line the last offset and its column, so that many findings on one long line take
        # one walk of it.
        self.columns: dict[int, tuple[int, int]] = {}

    def range(self, start: int, end: int) -> Json:
        """A half-open range of offsets."""
        start = max(0, min(start, len(self.source.text)))
        return {
            "start": self._position(start),
            "end": self._position(max(start, min(end, len(self.source.text)))),
        }

    def suggestions(self, fix: Fix) -> Json:
        """All edits of a fix as one suggestion, since reviewdog offers each one alone; nothing if
        they are far apart.
        """
        edits = sorted(fix.edits, key=lambda edit: edit.span)
        if not edits or edits[-1].span.end - edits[0].span.start > MAX_LENGTH:
            return {}
        text, last = "", edits[0].span.start
        for edit in edits:
            text += self.source.text[last : edit.span.start] + edit.text
            last = edit.span.end
        return {
            "suggestions": [
                {"range": self.range(edits[0].span.start, last), "text": escape_surrogates(text)}
            ]
        }

    def _position(self, offset: int) -> Json:
        line, column = self.source.position(offset)
        if not self.source.text.isascii():
            known, column_there = self.columns.get(line, (offset - column + 1, 1))
            between = self.source.text[min(known, offset) : max(known, offset)]
            size = len(between.encode("utf-8", "surrogatepass"))
            column = column_there + (size if offset >= known else -size)
            self.columns[line] = (offset, column)
        return {"line": line, "column": column}
