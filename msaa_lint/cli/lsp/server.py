"""The language server: documents that an editor has open, and what it asks about them."""

from __future__ import annotations

import gc
import logging

from lsprotocol import types
from pygls.lsp.server import LanguageServer

from msaa_lint.core.package import VERSION

from .analysis import Analysis
from .diagnostics import diagnostics
from .documents import OpenDocument, folder_of
from .features import add_features
from .worker import Worker


class Server(LanguageServer):
    """The server of one editor, and the documents that it has open."""

    def __init__(self) -> None:
        super().__init__("msaa-lint", VERSION)
        self.worker = Worker(self._publish)
        self.documents: dict[str, OpenDocument] = {}

    def report_server_error(self, error: Exception, source: object) -> None:
        """Says nothing: a message that cannot be read is answered with an error of the protocol."""

    @property
    def pulls(self) -> bool:
        """Whether the editor asks for diagnostics."""
        document = self.client_capabilities.text_document
        return document is not None and document.diagnostic is not None

    @property
    def encoding(self) -> types.PositionEncodingKind:
        """The encoding of positions that server and editor use."""
        return types.PositionEncodingKind(self.workspace.position_encoding or types.PositionEncodingKind.Utf16)

    def open(self, item: types.TextDocumentItem) -> None:
        """Adds a document, and lints it."""
        folders = [folder.uri for folder in self.workspace.folders.values()] or [self.workspace.root_uri or ""]
        document = OpenDocument(item.uri, item.version, item.text, item.language_id, folder_of(item.uri, folders))
        self.documents[item.uri] = document
        self.lint(document)

    def change(self, params: types.DidChangeTextDocumentParams) -> None:
        """Changes a document, and lints it."""
        identifier = params.text_document
        if identifier.uri in self.documents:
            document = self.documents[identifier.uri].changed(identifier.version, params.content_changes, self.encoding)
            self.documents[identifier.uri] = document
            self.lint(document)

    def close(self, uri: str) -> None:
        """Drops a document and its diagnostics."""
        self.documents.pop(uri, None)
        self.worker.forget(uri)
        if not self.pulls:
            self.text_document_publish_diagnostics(types.PublishDiagnosticsParams(uri, []))

    def lint(self, document: OpenDocument) -> None:
        """Lints a document."""
        others = [other for other in self.documents.values() if other is not document]
        self.worker.lint(document, others, self.encoding)

    async def analysis(self, uri: str) -> Analysis | None:
        """The analysis of the newest version of a document; None if it is not open."""
        document = self.documents.get(uri)
        return await self.worker.result(document) if document is not None else None

    def _publish(self, analysis: Analysis) -> None:
        """Sends the diagnostics of a document, unless the editor asks for them or has changed it."""
        document = self.documents.get(analysis.uri)
        if document is not None and document.version == analysis.version and not self.pulls:
            self.text_document_publish_diagnostics(types.PublishDiagnosticsParams(analysis.uri, diagnostics(analysis), analysis.version))


def create() -> Server:
    """A server with all features."""
    server = Server()

    @server.feature(types.TEXT_DOCUMENT_DID_OPEN)
    def did_open(params: types.DidOpenTextDocumentParams) -> None:
        server.open(params.text_document)

    @server.feature(types.TEXT_DOCUMENT_DID_CHANGE)
    def did_change(params: types.DidChangeTextDocumentParams) -> None:
        server.change(params)

    @server.feature(types.TEXT_DOCUMENT_DID_CLOSE)
    def did_close(params: types.DidCloseTextDocumentParams) -> None:
        server.close(params.text_document.uri)

    add_features(server)
    return server


def serve() -> int:
    """Serves an editor over standard input and output until it ends the connection."""
    # Nothing reads what pygls would log to standard error.
    logging.disable()
    server = create()
    gc.freeze()
    server.start_io()
    return 0
