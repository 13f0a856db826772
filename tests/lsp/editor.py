"""An editor for the tests of the language server: pytest-lsp's client, and a server of its own
process.
"""

from __future__ import annotations

import asyncio
import sys
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager
from pathlib import Path

from lsprotocol import types
from pytest_lsp import LanguageClient, client_capabilities

from tests.command import environment_of

TIMEOUT = 60
"""Seconds for an answer, on a busy machine."""


class Editor:
    """An editor with a folder and open documents."""

    def __init__(
        self,
        client: LanguageClient,
        folder: Path,
        queue: asyncio.Queue[types.PublishDiagnosticsParams],
        server: types.ServerCapabilities,
        registrations: list[types.Registration],
    ) -> None:
        self.client = client
        self.folder = folder
        self.queue = queue
        self.server = server
        self.registrations = registrations
        self.messages: list[types.LogMessageParams] = []
        self.versions: dict[str, int] = {}

        @client.feature(types.WINDOW_LOG_MESSAGE)
        def log(params: types.LogMessageParams) -> None:
            self.messages.append(params)

    def uri(self, name: str) -> str:
        return (self.folder / name).as_uri()

    async def open(
        self, name: str, text: str, language: str = "yaml", save: bool = True
    ) -> list[types.Diagnostic]:
        """Opens a document, of a file with its text unless it is new, and waits for its
        diagnostics.
        """
        if save:
            (self.folder / name).write_bytes(text.encode())
        uri = self.uri(name)
        self.versions[uri] = 1
        self.client.text_document_did_open(
            types.DidOpenTextDocumentParams(types.TextDocumentItem(uri, language, 1, text))
        )
        return await self.diagnostics(name)

    async def change(
        self, name: str, *changes: types.TextDocumentContentChangeEvent
    ) -> list[types.Diagnostic]:
        """Changes a document, and waits for the diagnostics of the new version."""
        self.send(name, *changes)
        return await self.diagnostics(name)

    async def replace(self, name: str, text: str) -> list[types.Diagnostic]:
        """Replaces the whole text of a document."""
        return await self.change(name, types.TextDocumentContentChangeWholeDocument(text))

    def send(self, name: str, *changes: types.TextDocumentContentChangeEvent) -> None:
        """Changes a document."""
        uri = self.uri(name)
        self.versions[uri] += 1
        identifier = types.VersionedTextDocumentIdentifier(uri=uri, version=self.versions[uri])
        self.client.text_document_did_change(
            types.DidChangeTextDocumentParams(identifier, list(changes))
        )

    async def diagnostics(self, name: str) -> list[types.Diagnostic]:
        """The diagnostics of the newest version of a document."""
        uri = self.uri(name)
        return list(
            (
                await self.published(
                    lambda params: params.uri == uri and params.version == self.versions[uri]
                )
            ).diagnostics
        )

    async def published(
        self, matches: Callable[[types.PublishDiagnosticsParams], bool]
    ) -> types.PublishDiagnosticsParams:
        """The next diagnostics that match, which are then forgotten with all before them."""
        while True:
            params = await asyncio.wait_for(self.queue.get(), TIMEOUT)
            if matches(params):
                return params

    async def actions(self, name: str, range: types.Range, *only: str) -> list[types.CodeAction]:
        """The code actions at a place, perhaps without their edits."""
        context = types.CodeActionContext([], only=list(only) or None)
        params = types.CodeActionParams(
            types.TextDocumentIdentifier(self.uri(name)), range, context
        )
        found = await asyncio.wait_for(self.client.text_document_code_action_async(params), TIMEOUT)
        return [action for action in found or () if isinstance(action, types.CodeAction)]


def _client(
    queue: asyncio.Queue[types.PublishDiagnosticsParams], registrations: list[types.Registration]
) -> LanguageClient:
    client = LanguageClient()

    @client.feature(types.TEXT_DOCUMENT_PUBLISH_DIAGNOSTICS)
    def publish(params: types.PublishDiagnosticsParams) -> None:
        queue.put_nowait(params)

    @client.feature(types.CLIENT_REGISTER_CAPABILITY)
    def register(params: types.RegistrationParams) -> None:
        registrations.extend(params.registrations)

    @client.feature(types.WORKSPACE_DIAGNOSTIC_REFRESH)
    def refresh(_: None) -> None:
        client.diagnostic_refresh_count += 1

    return client


@asynccontextmanager
async def editor(
    folder: Path, capabilities: types.ClientCapabilities | str = "neovim@v0.7.0"
) -> AsyncIterator[Editor]:
    """An editor that has a folder open. `capabilities` are its own, or those of a known editor."""
    queue: asyncio.Queue[types.PublishDiagnosticsParams] = asyncio.Queue()
    registrations: list[types.Registration] = []
    client = _client(queue, registrations)
    await client.start_io(
        sys.executable, "-m", "msaa_lint", "lsp", "--stdio", cwd=folder, env=environment_of({})
    )
    assert (
        client._stderr_forwarder is not None
        and client._server is not None
        and client._server.stderr is not None
    )
    client._stderr_forwarder.cancel()
    own = client_capabilities(capabilities) if isinstance(capabilities, str) else capabilities
    folders = [types.WorkspaceFolder(folder.as_uri(), "folder")]
    answer = await client.initialize_session(
        types.InitializeParams(own, root_uri=folder.as_uri(), workspace_folders=folders)
    )
    yield Editor(client, folder, queue, answer.capabilities, registrations)
    await asyncio.wait_for(client.shutdown_session(), TIMEOUT)
    errors = (await client._server.stderr.read()).decode()
    assert errors == "", errors
    assert client._server.returncode == 0
    await client.stop()
