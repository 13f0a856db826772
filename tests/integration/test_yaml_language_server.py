"""What an editor without our language server shows: the YAML language server from npm, by the JSON
Schema alone.
"""

from __future__ import annotations

import asyncio
import json
import shutil
import subprocess
from pathlib import Path

import pytest

from msaa_lint.cli.schema import description_schema
from msaa_lint.frame.description.reference.lookup import enumerant_text, path_text

pytest.importorskip("pygls")
from lsprotocol import types
from pygls.lsp.client import LanguageClient

VERSION = "1.25.0"
TEXT = """\
# yaml-language-server: $schema=msaa-lint.schema.json
images:
  color: {format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT]}
renderPasses:
  forward:
    attachments:
      first: {image: color, loadOp: CLEAR, storeOp: STORE}
    subpasses:
      - colorAttachments: [first]
commands:
  - beginRenderPass: {renderPass: forward}
scene: {overdraw: 1.5}
"""
FORWARD = ("renderPasses", "forward")
PATHS: dict[str, tuple[str | int, ...]] = {
    "images:": ("images",),
    "format": ("images", "color", "format"),
    "samples": ("images", "color", "samples"),
    "usage": ("images", "color", "usage"),
    "attachments": (*FORWARD, "attachments"),
    "loadOp": (*FORWARD, "attachments", "first", "loadOp"),
    "storeOp": (*FORWARD, "attachments", "first", "storeOp"),
    "colorAttachments": (*FORWARD, "subpasses", 0, "colorAttachments"),
    "beginRenderPass": ("commands", 0, "beginRenderPass"),
    "overdraw": ("scene", "overdraw"),
}

pytestmark = [
    pytest.mark.network,
    pytest.mark.skipif(
        shutil.which("npm") is None or shutil.which("node") is None,
        reason="Node.js with npm is not installed",
    ),
]


def place(word: str) -> types.Position:
    line = next(
        number
        for number, text in enumerate(TEXT.splitlines())
        if word in text and not text.startswith("#")
    )
    return types.Position(line, TEXT.splitlines()[line].index(word) + 1)


async def hovers(server: Path, folder: Path) -> dict[str, str]:
    """What the server shows for each word, as Markdown."""
    client = LanguageClient("tests", "1")
    await client.start_io("node", str(server), "--stdio")
    await client.initialize_async(
        types.InitializeParams(types.ClientCapabilities(), root_uri=folder.as_uri())
    )
    client.initialized(types.InitializedParams())
    document = types.TextDocumentIdentifier((folder / "frame.msaa.yaml").as_uri())
    client.text_document_did_open(
        types.DidOpenTextDocumentParams(types.TextDocumentItem(document.uri, "yaml", 1, TEXT))
    )
    shown = {}
    for word in PATHS:
        hover = await client.text_document_hover_async(types.HoverParams(document, place(word)))
        assert hover is not None, word
        assert isinstance(hover.contents, types.MarkupContent)
        shown[word] = hover.contents.value
    await client.shutdown_async(None)
    client.exit(None)
    await client.stop()
    return shown


@pytest.fixture(scope="module")
def shown(tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    folder = tmp_path_factory.mktemp("editor")
    command = ["npm", "install", "--no-audit", "--no-fund", f"yaml-language-server@{VERSION}"]
    subprocess.run(command, cwd=folder, check=True, capture_output=True, timeout=300)
    (folder / "msaa-lint.schema.json").write_text(
        json.dumps(description_schema()), encoding="utf-8"
    )
    server = folder / "node_modules" / "yaml-language-server" / "bin" / "yaml-language-server"
    return asyncio.run(asyncio.wait_for(hovers(server, folder), 120))


@pytest.mark.parametrize("word", PATHS)
def test_hover_of_a_key_shows_its_title_and_text(shown: dict[str, str], word: str) -> None:
    text = path_text(PATHS[word])
    assert text is not None
    title, _, rest = shown[word].partition("\n")
    assert title.split(", as ")[0] == f"#### {text.title}"
    assert text.markdown in rest or text.description in rest


def test_hover_lists_the_values_with_their_meanings(shown: dict[str, str]) -> None:
    for value in ("STORE", "DONT_CARE", "NONE"):
        assert f"* `{value}`: {enumerant_text('VkAttachmentStoreOp', value)}" in shown["storeOp"]
