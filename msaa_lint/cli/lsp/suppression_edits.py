"""Comments that suppress a finding, each tried before it is offered."""

from __future__ import annotations

from typing import TYPE_CHECKING

from msaa_lint.core.finding import Finding
from msaa_lint.core.text.edits import apply as edited
from msaa_lint.core.text.source import Source
from msaa_lint.core.text.span import Edit, Span
from msaa_lint.core.text.tree import parse
from msaa_lint.input.source_file import SourceFile
from msaa_lint.linter.suppress.suppressions import apply

from .analysis import Analysis, Kind

if TYPE_CHECKING:
    from msaa_lint.core.text.comments import Comment

REASON = "TODO: state why this is intended"


def suppression_edit(analysis: Analysis, found: Finding) -> Edit | None:
    """The edit that suppresses a finding, in a comment on the line before it; None where a comment
    there would not.
    """
    if found.span is None or found.fatal or analysis.kind not in (Kind.DESCRIPTION, Kind.CODE):
        return None
    source = analysis.source
    number = source.position(found.span.start).line
    line = source.line(number)
    if analysis.kind is Kind.CODE and number > 1 and source.line(number - 1).endswith("\\"):
        # The line goes on, in a macro or a text.
        return None
    start = source.starts[number - 1]
    indent = line[: len(line) - len(line.lstrip(" \t"))]
    mark = "#" if analysis.kind is Kind.DESCRIPTION else "//"
    end = next((end for end in ("\r\n", "\r", "\n") if end in source.text), "\n")
    edit = Edit(Span(start, start), f"{indent}{mark} msaa-lint: ignore[{found.rule}] {REASON}{end}")
    return edit if _suppresses(analysis, found, edit) else None


def _suppresses(analysis: Analysis, found: Finding, edit: Edit) -> bool:
    """Whether a finding is suppressed after an edit: the text must still be read, and its new
    comment be one, and be about the finding.
    """
    source = Source(found.file, edited(analysis.source.text, [edit]))
    read = (
        _description_comments(analysis, source)
        if analysis.kind is Kind.DESCRIPTION
        else _code_comments(analysis, edit)
    )
    if read is None or found.span is None:
        return False
    by = len(edit.text)
    moved = found._replace(span=Span(found.span.start + by, found.span.end + by), labels=())
    return not apply([moved], read[0], source, analysis.registry.names, (), read[1])[0]


def _description_comments(analysis: Analysis, source: Source) -> tuple[list[Comment], None] | None:
    from msaa_lint.core.text.comments import comments

    parsed = parse(source, analysis.resolved.limits)
    before = (
        analysis.result.source.text
        if analysis.result is not None and analysis.result.source is not None
        else None
    )
    if parsed.problems or before != analysis.source.text or analysis.path.lower().endswith(".json"):
        return None
    return comments(source, parsed.documents), None


def _code_comments(
    analysis: Analysis, edit: Edit
) -> tuple[tuple[Comment, ...], frozenset[int]] | None:
    from msaa_lint.input.code.comments import comments

    data = analysis.file.data if analysis.file is not None else None
    part = (
        next((each for each in data.files if each.source.name == analysis.path), None)
        if isinstance(data, SourceFile)
        else None
    )
    if part is None:
        return None
    at = edit.span.start
    found = comments(
        [code._replace(text=code.text[:at] + edit.text + code.text[at:]) for code in part.codes]
    )
    return found.comments, found.alone
