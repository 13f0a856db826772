"""The language server: documents that an editor has open, and what it asks about them."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable

from lsprotocol import types
from pygls.exceptions import JsonRpcException
from pygls.lsp.server import LanguageServer

from msaa_lint.core.package import VERSION

from .analysis import Analysis
from .diagnostics import diagnostics
from .documents import OpenDocument, folder_of
from .json_rpc import Protocol
from .worker import Worker

WATCHED = ("**/*.toml", "**/*.md", "**/*.spv")
"""The files on which findings in other files may depend: configurations, rule pages, and
shaders.
"""

REFRESH_ID = "msaa-lint-watched-files"


class Server(LanguageServer):
    """The server of one editor, and the documents that it has open."""

    protocol: Protocol

    def __init__(self) -> None:
        super().__init__("msaa-lint", VERSION, protocol_cls=Protocol)
        self.worker = Worker(self._done)
        self.documents: dict[str, OpenDocument] = {}

    def report_server_error(self, error: Exception, source: object) -> None:
        """Answers what is not JSON; there is nothing to say about the rest, which has been
        answered.
        """
        if source is JsonRpcException and isinstance(error, (ValueError, RecursionError)):
            self.protocol.answer_unreadable()

    @property
    def pulls(self) -> bool:
        """Whether the editor asks for diagnostics."""
        document = self.client_capabilities.text_document
        return document is not None and document.diagnostic is not None

    @property
    def resolves_edits(self) -> bool:
        """Whether the editor asks for the edit of an action when it is chosen."""
        document = self.client_capabilities.text_document
        support = (
            document.code_action.resolve_support
            if document is not None and document.code_action is not None
            else None
        )
        return support is not None and "edit" in support.properties

    @property
    def takes_snippet_edits(self) -> bool:
        """Whether edits may place the editor's cursor."""
        workspace = self.client_capabilities.workspace
        return (
            workspace is not None
            and workspace.workspace_edit is not None
            and bool(workspace.workspace_edit.snippet_edit_support)
        )

    @property
    def encoding(self) -> types.PositionEncodingKind:
        """The encoding of positions that server and editor use."""
        return types.PositionEncodingKind(
            self.workspace.position_encoding or types.PositionEncodingKind.Utf16
        )

    def open(self, item: types.TextDocumentItem) -> None:
        """Adds a document, and lints it."""
        folders = [folder.uri for folder in self.workspace.folders.values()] or [
            self.workspace.root_uri or ""
        ]
        self._put(
            OpenDocument(
                item.uri, item.version, item.text, item.language_id, folder_of(item.uri, folders)
            )
        )

    def change(self, params: types.DidChangeTextDocumentParams) -> None:
        """Changes a document, and lints it."""
        identifier = params.text_document
        document = self.documents.get(identifier.uri)
        if document is not None:
            self._put(document.changed(identifier.version, params.content_changes, self.encoding))

    def _put(self, document: OpenDocument) -> None:
        self.documents[document.uri] = document
        self.lint([document])
        if document.uri.endswith((".toml", ".md")):
            self.lint(other for other in self.documents.values() if other is not document)

    def close(self, uri: str) -> None:
        """Drops a document and its diagnostics; what depends on its unsaved text is linted
        again.
        """
        document = self.documents.pop(uri, None)
        self.worker.forget(uri)
        if not self.pulls:
            self.text_document_publish_diagnostics(types.PublishDiagnosticsParams(uri, []))
        if document is not None and not uri.endswith((".yaml", ".yml", ".json")):
            self.lint(self.documents.values())

    def lint(self, documents: Iterable[OpenDocument]) -> None:
        """Lints documents."""
        for document in list(documents):
            others = [other for other in self.documents.values() if other is not document]
            self.worker.lint(document, others, self.encoding)

    def lint_again(self) -> None:
        """Lints all documents, after something that they depend on has changed."""
        self.lint(self.documents.values())
        workspace = self.client_capabilities.workspace
        if (
            self.pulls
            and workspace is not None
            and workspace.diagnostics is not None
            and workspace.diagnostics.refresh_support
        ):
            self.workspace_diagnostic_refresh(None)

    def current(self, uri: str) -> Analysis | None:
        """What is known at once of the newest version of a document: its text, and the rest from an
        older version; None if nothing is.
        """
        document, last = self.documents.get(uri), self.worker.results.get(uri)
        if document is None or last is None or last.version == document.version:
            return last if document is not None else None
        return dataclasses.replace(
            last, version=document.version, text=document.text, findings=(), file=None, result=None
        )

    async def analysis(self, uri: str) -> Analysis | None:
        """The analysis of the newest version of a document; None if it is not open."""
        document = self.documents.get(uri)
        return await self.worker.result(document.uri) if document is not None else None

    def watch_files(self) -> None:
        """Asks the editor to report changes of the files that findings depend on."""
        workspace = self.client_capabilities.workspace
        watched = workspace.did_change_watched_files if workspace is not None else None
        if watched is not None and watched.dynamic_registration:
            options = types.DidChangeWatchedFilesRegistrationOptions(
                [types.FileSystemWatcher(pattern) for pattern in WATCHED]
            )
            registration = types.Registration(
                REFRESH_ID, types.WORKSPACE_DID_CHANGE_WATCHED_FILES, options
            )
            self.client_register_capability(types.RegistrationParams([registration]))

    def _done(self, analysis: Analysis) -> None:
        """Sends the diagnostics of a document, unless the editor asks for them or has changed
        it.
        """
        document = self.documents.get(analysis.uri)
        if document is not None and document.version == analysis.version and not self.pulls:
            found = diagnostics(analysis)
            self.text_document_publish_diagnostics(
                types.PublishDiagnosticsParams(analysis.uri, found, analysis.version)
            )
