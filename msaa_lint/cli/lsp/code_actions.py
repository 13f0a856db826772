"""What an editor offers at a place: fixes, suppressions, and the keys that undecided rules lack.

An action is offered quickly, and its edit is computed when it is chosen: a fix is tried as `check
--fix` tries it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any

from lsprotocol import types

from msaa_lint.core.allowance import Allowance
from msaa_lint.core.finding import Finding
from msaa_lint.core.text.source import encode
from msaa_lint.core.text.span import Edit, Span
from msaa_lint.linter.fixes.fixer import fix_text
from msaa_lint.linter.results import FileResult, finding_kind, unmerged

from .analysis import Analysis, Kind
from .diagnostics import diagnostic
from .key_insertions import KeyInsertion, as_snippet, key_insertions
from .line_edits import line_edits
from .recovery import MARK
from .suppression_edits import suppression_edit

FIX_ALL = f"{types.CodeActionKind.SourceFixAll.value}.msaaLint"

KINDS = (types.CodeActionKind.QuickFix.value, types.CodeActionKind.RefactorRewrite.value, FIX_ALL)


def code_actions(
    analysis: Analysis,
    span: Span,
    only: Sequence[types.CodeActionKind | str] | None,
    snippets: bool = False,
) -> list[types.CodeAction]:
    """The actions at a place, without edits, of the kinds `only` names, or of all; `snippets` says
    that the editor takes them as edits.
    """
    actions = [*_quick_fixes(analysis, span), *_fix_all(analysis), *_keys(analysis, span, snippets)]
    return [
        action
        for action in actions
        if only is None or any(_is_kind(_name(action.kind), _name(kind)) for kind in only)
    ]


def with_edit(analysis: Analysis, action: types.CodeAction) -> types.CodeAction:
    """An action with its edit; without one if it cannot be done, as where a fix would cause another
    finding.
    """
    edits = _edits(analysis, action.data) if isinstance(action.data, dict) else None
    if edits:
        document = types.OptionalVersionedTextDocumentIdentifier(analysis.uri, analysis.version)
        changes = types.TextDocumentEdit(document, [_edit(analysis, edit) for edit in edits])
        action.edit = types.WorkspaceEdit(document_changes=[changes])
    return action


def _edit(analysis: Analysis, edit: Edit) -> types.TextEdit | types.SnippetTextEdit:
    if MARK not in edit.text:
        return analysis.text_edit(edit)
    return types.SnippetTextEdit(
        analysis.range(edit.span), types.StringValue(as_snippet(edit.text))
    )


def _name(kind: types.CodeActionKind | str | None) -> str:
    return kind.value if isinstance(kind, types.CodeActionKind) else kind or ""


def _is_kind(kind: str, asked: str) -> bool:
    return asked == "" or kind == asked or kind.startswith(f"{asked}.")


def _at(analysis: Analysis, found: Finding, span: Span) -> bool:
    """Whether a finding has a part on the lines of a place."""
    position, at = analysis.source.position, found.span or Span(0, 0)
    return (
        position(at.start).line <= position(span.end).line
        and position(span.start).line <= position(at.end).line
    )


def _quick_fixes(analysis: Analysis, span: Span) -> Iterator[types.CodeAction]:
    fixable = _fixable(analysis)
    for number, found in enumerate(analysis.findings):
        if not _at(analysis, found, span):
            continue
        diagnostics = [diagnostic(analysis, found)]
        kind = types.CodeActionKind.QuickFix
        if fixable(found) and found.fix is not None:
            title = (
                found.fix.title
                if found.fix.safe
                else f"{found.fix.title} (unsafe: it may change the picture)"
            )
            data = _data(analysis, "fix", number)
            yield types.CodeAction(
                _capitalized(title),
                kind,
                diagnostics,
                is_preferred=found.fix.safe or None,
                data=data,
            )
        if suppression_edit(analysis, found) is not None:
            data = _data(analysis, "suppress", number)
            yield types.CodeAction(
                f"Suppress {found.rule} here, with a reason", kind, diagnostics, data=data
            )


def _fix_all(analysis: Analysis) -> Iterator[types.CodeAction]:
    fixable = _fixable(analysis)
    if any(
        fixable(found) and found.fix is not None and found.fix.safe for found in analysis.findings
    ):
        yield types.CodeAction(
            "Apply all safe fixes of msaa-lint", FIX_ALL, data=_data(analysis, "fix-all")
        )


def _keys(analysis: Analysis, span: Span, snippets: bool) -> Iterator[types.CodeAction]:
    for number, key in enumerate(_insertions(analysis)):
        if key.begins_on(analysis.source, span) and (snippets or not key.is_snippet):
            yield types.CodeAction(
                key.title, types.CodeActionKind.RefactorRewrite, data=_data(analysis, "key", number)
            )


def _insertions(analysis: Analysis) -> list[KeyInsertion]:
    """The keys that undecided rules lack, determined once for a version."""
    known: list[KeyInsertion] | None = vars(analysis).get("key_insertions")
    if known is None:
        known = []
        if (
            analysis.file is not None
            and analysis.result is not None
            and analysis.kind is Kind.DESCRIPTION
        ):
            options = analysis.file.options._replace(keys=Allowance(), all_keys=True)
            known = key_insertions(analysis.file._replace(options=options, log=None).lint())
        vars(analysis)["key_insertions"] = known
    return known


def _fixable(analysis: Analysis) -> Callable[[Finding], bool]:
    """Whether a finding has a fix that is made in the text."""
    if analysis.file is None or analysis.result is None or analysis.kind is not Kind.DESCRIPTION:
        return lambda found: False
    is_shown = analysis.file.fixable(analysis.result)
    return lambda found: found.fix is not None and not found.fix.shown and is_shown(found)


def _data(analysis: Analysis, action: str, number: int = 0) -> dict[str, Any]:
    return {"uri": analysis.uri, "version": analysis.version, "action": action, "number": number}


def _capitalized(title: str) -> str:
    return title[:1].upper() + title[1:]


def _edits(analysis: Analysis, data: dict[str, Any]) -> Sequence[Edit] | None:
    """The edits of an action, None if there are none or if it is of another version."""
    action, number = data.get("action"), data.get("number")
    if data.get("version") != analysis.version or not isinstance(number, int) or number < 0:
        return None
    if action == "fix-all":
        return _fix(analysis, lambda found: True, unsafe=False)
    if action == "key":
        keys = _insertions(analysis)
        return keys[number].edits if number < len(keys) else None
    if number >= len(analysis.findings):
        return None
    chosen = analysis.findings[number]
    if action == "suppress":
        edit = suppression_edit(analysis, chosen)
        return [edit] if edit is not None else None
    return _fix(
        analysis,
        lambda found: (*finding_kind(found), found.span) == (*finding_kind(chosen), chosen.span),
        unsafe=True,
    )


def _fix(
    analysis: Analysis, selects: Callable[[Finding], bool], unsafe: bool
) -> Sequence[Edit] | None:
    """The edits that fix findings, as `--fix` does."""
    file, result = analysis.file, analysis.result
    if file is None or result is None or not isinstance(file.data, bytes):
        return None
    data, fixable = file.data, _fixable(analysis)

    def lint(text: str) -> FileResult:
        return unmerged(file.lint(encode(text, data)))

    fixed = fix_text(
        unmerged(result), lint, unsafe, lambda found: fixable(found) and selects(found)
    )
    return line_edits(analysis.source.text, fixed.text)
