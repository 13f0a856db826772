"""The requests to format a document, or a part of one."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING

from lsprotocol import types

from msaa_lint.core.text.span import Edit, Span
from msaa_lint.input.file_types import DESCRIPTIONS
from msaa_lint.linter.rules.front_matter import split

from .analysis import Analysis, Kind
from .formatting import Layout, layout, ryl

if TYPE_CHECKING:
    from .server import Server

_METHODS = (types.TEXT_DOCUMENT_FORMATTING, types.TEXT_DOCUMENT_RANGE_FORMATTING)


def add_formatting(server: Server) -> None:
    """Adds formatting to a server, unless the editor takes a list of files. Others ask about all
    documents.
    """

    @server.feature(types.INITIALIZE)
    def initialize(_: types.InitializeParams) -> None:
        if ryl() is not None and not _takes_files(server):
            _add_requests(server)


def register_formatting(server: Server) -> None:
    """Registers the formatting of descriptions with an editor that takes a list of files, which
    formats others by what else it has.
    """
    if ryl() is not None and _takes_files(server):
        _add_requests(server)
        files = types.DocumentFormattingRegistrationOptions(
            [types.TextDocumentFilterPattern(f"**/*{name}") for name in DESCRIPTIONS]
        )
        registrations = [
            types.Registration(f"msaa-lint-{method}", method, files) for method in _METHODS
        ]
        server.client_register_capability(types.RegistrationParams(registrations))


def _takes_files(server: Server) -> bool:
    document = server.client_capabilities.text_document
    supports = (document.formatting, document.range_formatting) if document is not None else ()
    return bool(supports) and all(
        support is not None and support.dynamic_registration for support in supports
    )


def _add_requests(server: Server) -> None:
    @server.feature(types.TEXT_DOCUMENT_FORMATTING)
    async def formatting(params: types.DocumentFormattingParams) -> list[types.TextEdit] | None:
        return await _answer(server, params.text_document.uri)

    @server.feature(types.TEXT_DOCUMENT_RANGE_FORMATTING)
    async def range_formatting(
        params: types.DocumentRangeFormattingParams,
    ) -> list[types.TextEdit] | None:
        return await _answer(server, params.text_document.uri, params.range)


async def _answer(
    server: Server, uri: str, range: types.Range | None = None
) -> list[types.TextEdit] | None:
    """The edits of a document; None if it is not formatted. The editor's log has the reason."""
    analysis = server.current(uri) or await server.analysis(uri)
    if analysis is None or analysis.kind not in (Kind.DESCRIPTION, Kind.RULE):
        return None
    formatted = await asyncio.to_thread(document_layout, analysis, range)
    for problem in formatted.problems:
        server.window_log_message(
            types.LogMessageParams(types.MessageType.Info, f"Formatting {analysis.path}: {problem}")
        )
    return [analysis.text_edit(edit) for edit in formatted.edits]


def document_layout(analysis: Analysis, range: types.Range | None = None) -> Layout:
    """The layout of a description, or of a rule page's front matter, in the lines of a range or in
    all of them.
    """
    text, start = analysis.source.text, 0
    within = _lines(analysis, range) if range is not None else None
    if analysis.kind is Kind.RULE:
        head = split(text)[0] or ""
        start = head.find("\n") + 1
        text = head[start:]
        within = Span(within.start - start, within.end - start) if within is not None else None
    edits, problems = layout(text, within)
    return Layout(
        [Edit(Span(edit.span.start + start, edit.span.end + start), edit.text) for edit in edits],
        problems,
    )


def _lines(analysis: Analysis, range: types.Range) -> Span:
    """The lines of a range. One that ends where a line begins is without this line."""
    start, end = analysis.span(range)
    source = analysis.source
    last = source.position(max(start, end - 1)).line
    return Span(
        source.starts[source.position(start).line - 1],
        source.starts[last - 1] + len(source.line(last)),
    )
