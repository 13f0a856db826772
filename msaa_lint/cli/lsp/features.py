"""The features of the server that answer what an editor asks at a position."""

from __future__ import annotations

from typing import TYPE_CHECKING

from lsprotocol import types
from pygls.exceptions import JsonRpcException

from . import answers
from .rename import Refused

if TYPE_CHECKING:
    from .server import Server

_REQUEST_FAILED = types.LSPErrorCodes.RequestFailed.value


def add_features(server: Server) -> None:
    """Adds what is asked at a position, and about a whole document, to a server."""

    @server.feature(types.TEXT_DOCUMENT_HOVER)
    async def hover(params: types.HoverParams) -> types.Hover | None:
        analysis = await server.analysis(params.text_document.uri)
        return answers.hover(analysis, params.position) if analysis is not None else None

    @server.feature(
        types.TEXT_DOCUMENT_COMPLETION, types.CompletionOptions(trigger_characters=answers.TRIGGERS)
    )
    async def completion(params: types.CompletionParams) -> types.CompletionList | None:
        uri = params.text_document.uri
        analysis = server.current(uri) or await server.analysis(uri)
        return (
            answers.completion(analysis, params.position, takes_snippets(server))
            if analysis is not None
            else None
        )

    @server.feature(types.TEXT_DOCUMENT_DEFINITION)
    async def definition(params: types.DefinitionParams) -> list[types.Location]:
        analysis = await server.analysis(params.text_document.uri)
        return answers.definition(analysis, params.position) if analysis is not None else []

    @server.feature(types.TEXT_DOCUMENT_REFERENCES)
    async def references(params: types.ReferenceParams) -> list[types.Location]:
        analysis = await server.analysis(params.text_document.uri)
        return (
            answers.references(analysis, params.position, params.context.include_declaration)
            if analysis is not None
            else []
        )

    @server.feature(types.TEXT_DOCUMENT_DOCUMENT_HIGHLIGHT)
    async def highlights(params: types.DocumentHighlightParams) -> list[types.DocumentHighlight]:
        analysis = await server.analysis(params.text_document.uri)
        return answers.highlights(analysis, params.position) if analysis is not None else []

    @server.feature(types.TEXT_DOCUMENT_PREPARE_RENAME)
    async def prepare_rename(
        params: types.PrepareRenameParams,
    ) -> types.PrepareRenamePlaceholder | None:
        analysis = await server.analysis(params.text_document.uri)
        return answers.prepare_rename(analysis, params.position) if analysis is not None else None

    @server.feature(types.TEXT_DOCUMENT_RENAME, types.RenameOptions(prepare_provider=True))
    async def rename(params: types.RenameParams) -> types.WorkspaceEdit | None:
        analysis = await server.analysis(params.text_document.uri)
        try:
            return (
                answers.rename(analysis, params.position, params.new_name)
                if analysis is not None
                else None
            )
        except Refused as error:
            raise JsonRpcException(str(error), _REQUEST_FAILED) from None

    @server.feature(types.TEXT_DOCUMENT_DOCUMENT_SYMBOL)
    async def symbols(params: types.DocumentSymbolParams) -> list[types.DocumentSymbol]:
        analysis = await server.analysis(params.text_document.uri)
        return answers.symbols(analysis) if analysis is not None else []

    @server.feature(types.TEXT_DOCUMENT_INLAY_HINT)
    async def inlay_hints(params: types.InlayHintParams) -> list[types.InlayHint]:
        analysis = await server.analysis(params.text_document.uri)
        return answers.inlay_hints(analysis, params.range) if analysis is not None else []

    @server.feature(types.TEXT_DOCUMENT_FOLDING_RANGE)
    async def folding_ranges(params: types.FoldingRangeParams) -> list[types.FoldingRange] | None:
        analysis = await server.analysis(params.text_document.uri)
        # Without an answer, an editor folds as it does by itself.
        return (answers.folding_ranges(analysis) or None) if analysis is not None else None

    @server.feature(types.TEXT_DOCUMENT_DOCUMENT_LINK)
    async def document_links(params: types.DocumentLinkParams) -> list[types.DocumentLink]:
        analysis = await server.analysis(params.text_document.uri)
        return answers.document_links(analysis) if analysis is not None else []

    @server.feature(types.TEXT_DOCUMENT_SELECTION_RANGE)
    async def selection_ranges(params: types.SelectionRangeParams) -> list[types.SelectionRange]:
        analysis = await server.analysis(params.text_document.uri)
        return (
            [answers.selection_range(analysis, position) for position in params.positions]
            if analysis is not None
            else []
        )


def takes_snippets(server: Server) -> bool:
    """Whether the editor takes completions that place its cursor."""
    document = server.client_capabilities.text_document
    item = (
        document.completion.completion_item
        if document is not None and document.completion is not None
        else None
    )
    return bool(item is not None and item.snippet_support)
