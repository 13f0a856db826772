"""The features of the language server: what each message of the protocol does."""

from __future__ import annotations

import gc
import logging
import os

from lsprotocol import types

from .code_actions import KINDS, code_actions, with_edit
from .diagnostics import diagnostics
from .features import add_features
from .format_requests import add_formatting, register_formatting
from .server import Server


def create() -> Server:
    """A server with all features."""
    server = Server()
    _add_documents(server)
    _add_diagnostics(server)
    _add_code_actions(server)
    add_features(server)
    add_formatting(server)
    return server


def serve() -> int:
    """Serves an editor over standard input and output until it ends the connection."""
    # Nothing reads what pygls would log to standard error.
    logging.disable()
    server = create()
    gc.freeze()
    with open(os.dup(0), "rb") as reader, open(os.dup(1), "wb") as writer:
        # What else reads or prints, such as a program that is run, must not take part in the
        # conversation.
        null = os.open(os.devnull, os.O_RDONLY)
        os.dup2(null, 0)
        os.close(null)
        os.dup2(2, 1)
        server.start_io(reader, writer)
    return 0


def _add_documents(server: Server) -> None:
    @server.feature(types.INITIALIZED)
    def initialized(_: types.InitializedParams) -> None:
        server.watch_files()
        register_formatting(server)

    @server.feature(types.TEXT_DOCUMENT_DID_OPEN)
    def did_open(params: types.DidOpenTextDocumentParams) -> None:
        server.open(params.text_document)

    @server.feature(types.TEXT_DOCUMENT_DID_CHANGE)
    def did_change(params: types.DidChangeTextDocumentParams) -> None:
        server.change(params)

    @server.feature(types.TEXT_DOCUMENT_DID_CLOSE)
    def did_close(params: types.DidCloseTextDocumentParams) -> None:
        server.close(params.text_document.uri)

    @server.feature(types.TEXT_DOCUMENT_DID_SAVE)
    def did_save(_: types.DidSaveTextDocumentParams) -> None:
        """Saving changes nothing: the text was linted before."""

    @server.feature(types.WORKSPACE_DID_CHANGE_WATCHED_FILES)
    def files_changed(_: types.DidChangeWatchedFilesParams) -> None:
        server.lint_again()

    @server.feature(types.WORKSPACE_DID_CHANGE_CONFIGURATION)
    def configuration_changed(_: types.DidChangeConfigurationParams) -> None:
        """The settings are those of the project, and not the editor's."""


def _add_diagnostics(server: Server) -> None:
    @server.feature(
        types.TEXT_DOCUMENT_DIAGNOSTIC,
        types.DiagnosticOptions(inter_file_dependencies=True, workspace_diagnostics=False),
    )
    async def diagnostic(params: types.DocumentDiagnosticParams) -> types.DocumentDiagnosticReport:
        analysis = await server.analysis(params.text_document.uri)
        return types.RelatedFullDocumentDiagnosticReport(
            diagnostics(analysis) if analysis is not None else []
        )


def _add_code_actions(server: Server) -> None:
    @server.feature(
        types.TEXT_DOCUMENT_CODE_ACTION, types.CodeActionOptions(KINDS, resolve_provider=True)
    )
    async def code_action(params: types.CodeActionParams) -> list[types.CodeAction]:
        analysis = await server.analysis(params.text_document.uri)
        if analysis is None:
            return []
        at, only = analysis.span(params.range), params.context.only
        actions = await server.worker.call(
            lambda: code_actions(analysis, at, only, server.takes_snippet_edits)
        )
        if server.resolves_edits:
            return actions
        edited = await server.worker.call(
            lambda: [with_edit(analysis, action) for action in actions]
        )
        return [action for action in edited if action.edit is not None]

    @server.feature(types.CODE_ACTION_RESOLVE)
    async def resolve(action: types.CodeAction) -> types.CodeAction:
        uri = action.data.get("uri") if isinstance(action.data, dict) else None
        analysis = await server.analysis(uri) if isinstance(uri, str) else None
        return (
            await server.worker.call(lambda: with_edit(analysis, action))
            if analysis is not None
            else action
        )
