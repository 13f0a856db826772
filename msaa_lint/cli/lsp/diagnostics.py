"""Findings as diagnostics of the protocol."""

from __future__ import annotations

from lsprotocol import types
from pygls.uris import from_fs_path

from msaa_lint.core.finding import Finding
from msaa_lint.core.text.span import Label, Span
from msaa_lint.linter.rules.reference_links import rule_address

from .analysis import Analysis
from .positions import Positions

SOURCE = "msaa-lint"

_SEVERITIES = {
    "error": types.DiagnosticSeverity.Error,
    "warning": types.DiagnosticSeverity.Warning,
    "note": types.DiagnosticSeverity.Information,
}

_UNNECESSARY = frozenset({"MSAA911", "MSAA915"})
"""The codes of comments that have no effect."""


def diagnostics(analysis: Analysis) -> list[types.Diagnostic]:
    """The diagnostics of a document, in the order of its findings."""
    return [diagnostic(analysis, found) for found in analysis.findings]


def diagnostic(analysis: Analysis, found: Finding) -> types.Diagnostic:
    """A finding as a diagnostic. `data` identifies it, and says whether it has a fix."""
    address = rule_address(analysis.resolved.settings.docs_url, found.code, found.rule)
    related = [_related(analysis, label) for label in found.labels]
    has_fix = found.fix is not None and not found.fix.shown
    return types.Diagnostic(
        analysis.range(found.span or Span(0, 0)),
        message(found),
        severity=_SEVERITIES[found.severity],
        code=found.code,
        code_description=types.CodeDescription(address) if address else None,
        source=SOURCE,
        tags=[types.DiagnosticTag.Unnecessary] if found.code in _UNNECESSARY else None,
        related_information=[each for each in related if each is not None] or None,
        data={"rule": found.rule, "subject": found.subject, "hasFix": has_fix},
    )


def message(found: Finding) -> str:
    """The message of a finding, with what it says besides on lines below."""
    help = (f"help: {found.help}",) if found.help else ()
    return "\n".join([f"{found.message} [{found.rule}]", *found.notes, *help])


def _related(analysis: Analysis, label: Label) -> types.DiagnosticRelatedInformation | None:
    if label.file is None or label.file == analysis.path:
        return types.DiagnosticRelatedInformation(
            types.Location(analysis.uri, analysis.range(label.span)), label.text
        )
    source = analysis.result.sources.get(label.file) if analysis.result is not None else None
    if source is None:
        return None
    positions = Positions(source, analysis.encoding)
    range = types.Range(positions.position(label.span.start), positions.position(label.span.end))
    return types.DiagnosticRelatedInformation(
        types.Location(from_fs_path(label.file) or label.file, range), label.text
    )
