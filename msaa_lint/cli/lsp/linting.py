"""Lints open documents as `check` lints their files, by the same run: of unsaved text, with the
same settings and limits.
"""

from __future__ import annotations

import dataclasses
import os
import re
from collections.abc import Sequence

from lsprotocol import types

from msaa_lint.core.diagnostics import diagnostic, internal_error
from msaa_lint.core.finding import Finding
from msaa_lint.core.globs import excluding
from msaa_lint.core.project import NAMES, shown
from msaa_lint.core.text.files import with_buffers
from msaa_lint.input.content import MAX_BYTES, kind_of_text, own_output
from msaa_lint.input.file_types import DATA, DESCRIPTIONS, HEAD_BYTES, INPUT, SOURCES, STDIN
from msaa_lint.input.readers import capture_format
from msaa_lint.linter.input_file import InputFile, ResolvedSettings
from msaa_lint.linter.request import Request
from msaa_lint.linter.results import FileResult, location_order
from msaa_lint.linter.rules.front_matter import split
from msaa_lint.linter.rules.page_files import folder, pages
from msaa_lint.linter.run import run
from msaa_lint.linter.workspace import Workspace

from .analysis import Analysis, Kind
from .documents import OpenDocument

_RULE_KEYS = re.compile(r"(?m)^(?:code|when|subject)[ \t]*:")
"""A key that the front matter of a rule page has, and that of other pages seldom."""


_FORMAT = "lsp"
"""Not an output of `check`: prices are computed, and fixes are tried, only when they are asked for.
So are keys that rules lack.
"""


def analyze(
    document: OpenDocument,
    others: Sequence[OpenDocument],
    encoding: types.PositionEncodingKind,
    known: Kind | None = None,
) -> Analysis:
    """Lints a document; `others` are those open beside it. One that was `known` as a description
    remains one while it is edited.
    """
    if document.folder is not None and os.path.isdir(document.folder):
        # Findings name files relative to the current folder, and its configuration has the settings
        # of a run.
        os.chdir(document.folder)
    buffers = {
        os.path.realpath(file): each.data
        for each in (*others, document)
        if (file := each.file) is not None
    }
    with with_buffers(buffers):
        return _analyze(document, encoding, known)


def _analyze(
    document: OpenDocument, encoding: types.PositionEncodingKind, known: Kind | None
) -> Analysis:
    file = document.file
    path = shown(file) if file is not None else document.uri
    workspace = Workspace(Request([]))
    resolved = workspace.resolve(path if file is not None else os.curdir)
    analysis = Analysis(
        document.uri, path, document.version, Kind.OTHER, document.text, encoding, resolved
    )
    try:
        kind = _kind(document, path, resolved, known)
        analysis = dataclasses.replace(analysis, kind=kind)
        if kind in (Kind.DESCRIPTION, Kind.CODE):
            return _lint_input(analysis, document)
        if kind in (Kind.CONFIGURATION, Kind.RULE):
            return dataclasses.replace(analysis, findings=_about_settings(workspace, analysis))
    except Exception as error:
        return dataclasses.replace(
            analysis, findings=[diagnostic("MSAA941", internal_error(error), path)]
        )
    return analysis


def _kind(
    document: OpenDocument, path: str, resolved: ResolvedSettings, known: Kind | None
) -> Kind:
    """What a document is, by its name, the settings, and its content."""
    name, settings = path.lower(), resolved.settings
    if os.path.basename(path) in NAMES:
        return Kind.CONFIGURATION
    if name.endswith(".md"):
        return Kind.RULE if _is_rule(document.text) else Kind.OTHER
    if document.file is not None and excluding(path, settings.exclude) is not None:
        return Kind.OTHER
    if name.endswith(SOURCES):
        return Kind.CODE if _reads_code() else Kind.OTHER
    if not (name.endswith(DATA) or document.language in ("yaml", "json", "jsonc")):
        return Kind.OTHER
    if (
        known is Kind.DESCRIPTION
        or name.endswith(DESCRIPTIONS)
        or (settings.include and excluding(path, settings.include) is not None)
    ):
        return Kind.DESCRIPTION
    head = document.data[:MAX_BYTES]
    is_input = (
        capture_format(head[:HEAD_BYTES]) is None
        and own_output(head) is None
        and kind_of_text(head) == INPUT
    )
    return Kind.DESCRIPTION if is_input else Kind.OTHER


def _is_rule(text: str) -> bool:
    head = split(text)[0]
    return head is not None and len(set(_RULE_KEYS.findall(head))) > 1


def _reads_code() -> bool:
    from msaa_lint.input.code import installed

    return installed()


def _lint_input(analysis: Analysis, document: OpenDocument) -> Analysis:
    """Runs `check` on a document. One without a file is linted as standard input with its name."""
    linted: list[tuple[InputFile, FileResult]] = []
    exists = document.file is not None and os.path.exists(document.file)
    request = (
        Request([analysis.path], formats=[_FORMAT], keys=0, edits=False)
        if exists
        else Request(
            [STDIN],
            formats=[_FORMAT],
            stdin_filename=analysis.path,
            data=document.data,
            keys=0,
            edits=False,
        )
    )
    result = run(request, results=lambda file, result: linted.append((file, result))).result
    file, of_file = next(
        (
            (file, result)
            for file, result in linted
            if analysis.path in (result.file, *result.sources)
        ),
        (None, None),
    )
    return dataclasses.replace(
        analysis,
        findings=[found for found in result.findings if found.file == analysis.path],
        undecided=[rule for rule in result.undecided if rule.file == analysis.path],
        suppressed=[each for each in result.suppressed if each.finding.file == analysis.path],
        resolved=file.resolved if file is not None else analysis.resolved,
        file=file,
        result=of_file,
    )


def _about_settings(workspace: Workspace, analysis: Analysis) -> list[Finding]:
    """The findings of `check` about a configuration, or about a rule page, which its configuration
    need not name.
    """
    if analysis.kind is Kind.RULE:
        real = os.path.realpath(analysis.path)
        if real in map(os.path.realpath, pages(folder())):
            return []
        named = (
            os.path.realpath(page)
            for path in analysis.resolved.settings.rules
            for page in pages(path)
        )
        if real not in named:
            workspace = Workspace(Request([], overrides={"rules": [analysis.path]}))
    settle = workspace.current.selection.settle
    findings = dict.fromkeys(
        found
        for found in map(settle, workspace.findings)
        if found is not None and found.file == analysis.path
    )
    return sorted(findings, key=location_order)
