"""What is asked at a position, through the protocol."""

from __future__ import annotations

import sys
from collections.abc import AsyncIterator
from pathlib import Path

import pytest

pytest_lsp = pytest.importorskip("pytest_lsp", reason="needs pytest-lsp")
types = pytest.importorskip("lsprotocol.types", reason="needs lsprotocol")

FRAME = """\
frame: {width: 1000, height: 1000, fps: 100}
images:
  color_ms: {format: R8G8B8A8_UNORM, samples: 4}
  "é😀": {format: R8G8B8A8_UNORM, samples: 1}
renderPasses:
  forward:
    attachments:
      "😀": {image: color_ms, loadOp: CLEAR, storeOp: STORE}
      target: {image: "é😀", loadOp: DONT_CARE, storeOp: STORE}
    subpasses:
      - {colorAttachments: ["😀"], resolveAttachments: [target]}
"""


@pytest_lsp.fixture(
    config=pytest_lsp.ClientServerConfig(server_command=[sys.executable, "-m", "msaa_lint", "lsp"])
)
async def client(lsp_client: pytest_lsp.LanguageClient, tmp_path: Path) -> AsyncIterator[None]:
    lsp_client.feature(types.CLIENT_REGISTER_CAPABILITY)(lambda params: None)
    await lsp_client.initialize_session(
        types.InitializeParams(
            capabilities=pytest_lsp.client_capabilities("visual-studio-code"),
            root_uri=tmp_path.as_uri(),
        )
    )
    yield
    await lsp_client.shutdown_session()


@pytest.fixture
def document(client: pytest_lsp.LanguageClient, tmp_path: Path) -> types.TextDocumentIdentifier:
    path = tmp_path / "frame.msaa.yaml"
    path.write_text(FRAME, encoding="utf-8")
    item = types.TextDocumentItem(path.as_uri(), types.LanguageKind.Yaml, 1, FRAME)
    client.text_document_did_open(types.DidOpenTextDocumentParams(item))
    return types.TextDocumentIdentifier(item.uri)


def position(of: str, beyond: int = 0) -> types.Position:
    """The position of a text in the frame, in units of UTF-16."""
    before = FRAME[: FRAME.index(of) + beyond]
    return types.Position(
        before.count("\n"), len(before.rpartition("\n")[2].encode("utf-16-le")) // 2
    )


def covered(place: types.Range) -> str:
    """The text of a range within a line."""
    line = FRAME.split("\n")[place.start.line].encode("utf-16-le")
    return line[2 * place.start.character : 2 * place.end.character].decode("utf-16-le")


@pytest.mark.asyncio
async def test_hover(
    client: pytest_lsp.LanguageClient, document: types.TextDocumentIdentifier
) -> None:
    answer = await client.text_document_hover_async(
        types.HoverParams(document, position("STORE", 2))
    )
    assert "Cost of the whole frame with this value and with others:" in answer.contents.value
    assert (
        "| `DONT_CARE` | 400 (−1,600) |" in answer.contents.value
        and covered(answer.range) == "STORE"
    )
    assert (
        await client.text_document_hover_async(types.HoverParams(document, types.Position(99, 0)))
        is None
    )


@pytest.mark.asyncio
async def test_completion_after_a_change(
    client: pytest_lsp.LanguageClient, document: types.TextDocumentIdentifier
) -> None:
    at = position("STORE}\n      target")
    place = types.Range(at, types.Position(at.line, at.character + 5))
    changed = types.VersionedTextDocumentIdentifier(2, document.uri)
    edit = types.TextDocumentContentChangePartial(text="", range=place)
    client.text_document_did_change(types.DidChangeTextDocumentParams(changed, [edit]))
    answer = await client.text_document_completion_async(types.CompletionParams(document, at))
    assert [item.label for item in answer.items] == ["STORE", "DONT_CARE", "NONE"]
    assert answer.items[1].text_edit == types.TextEdit(types.Range(at, at), "DONT_CARE")
    assert answer.items[1].documentation.value.startswith("Discards the contents")


@pytest.mark.asyncio
async def test_completion_of_keys_in_snippets(
    client: pytest_lsp.LanguageClient, document: types.TextDocumentIdentifier
) -> None:
    answer = await client.text_document_completion_async(
        types.CompletionParams(document, types.Position(11, 0))
    )
    pipelines = next(item for item in answer.items if item.label == "pipelines")
    assert (
        pipelines.insert_text_format == types.InsertTextFormat.Snippet
        and pipelines.text_edit.new_text == "pipelines:\n  $0"
    )


@pytest.mark.asyncio
async def test_definition_references_and_highlights(
    client: pytest_lsp.LanguageClient, document: types.TextDocumentIdentifier
) -> None:
    found = await client.text_document_definition_async(
        types.DefinitionParams(document, position('["😀', 3))
    )
    assert [(place.range.start.line, covered(place.range)) for place in found] == [(7, "😀")]
    at = position('"é😀"', 2)
    context = types.ReferenceContext(include_declaration=False)
    found = await client.text_document_references_async(
        types.ReferenceParams(context, document, at)
    )
    assert [(place.range.start.line, covered(place.range)) for place in found] == [(8, "é😀")]
    marks = await client.text_document_document_highlight_async(
        types.DocumentHighlightParams(document, at)
    )
    assert [mark.kind for mark in marks] == [
        types.DocumentHighlightKind.Write,
        types.DocumentHighlightKind.Read,
    ]


@pytest.mark.asyncio
async def test_rename(
    client: pytest_lsp.LanguageClient, document: types.TextDocumentIdentifier
) -> None:
    at = position('😀": {image', 0)
    prepared = await client.text_document_prepare_rename_async(
        types.PrepareRenameParams(document, at)
    )
    assert prepared.placeholder == "😀" and covered(prepared.range) == "😀"
    answer = await client.text_document_rename_async(types.RenameParams(document, at, "source"))
    edits = answer.changes[document.uri]
    assert [(edit.range.start.line, covered(edit.range), edit.new_text) for edit in edits] == [
        (7, '"😀"', '"source"'),
        (10, '"😀"', '"source"'),
    ]
    with pytest.raises(Exception, match="already `target`"):
        await client.text_document_rename_async(types.RenameParams(document, at, "target"))


@pytest.mark.asyncio
async def test_symbols_and_hints(
    client: pytest_lsp.LanguageClient, document: types.TextDocumentIdentifier
) -> None:
    found = await client.text_document_document_symbol_async(types.DocumentSymbolParams(document))
    assert [symbol.name for symbol in found] == ["frame", "images", "renderPasses"]
    assert [part.name for part in found[2].children[0].children] == ["😀", "target", "subpass 0"]
    whole = types.Range(types.Position(0, 0), types.Position(8, 0))
    hints = await client.text_document_inlay_hint_async(types.InlayHintParams(document, whole))
    assert [(hint.position.line, hint.label) for hint in hints] == [
        (5, "2,000 MB/s, 200 mW"),
        (7, "1,600 MB/s"),
    ]


@pytest.mark.asyncio
async def test_folds_links_and_selections(
    client: pytest_lsp.LanguageClient, document: types.TextDocumentIdentifier, tmp_path: Path
) -> None:
    found = await client.text_document_folding_range_async(types.FoldingRangeParams(document))
    assert [(fold.start_line, fold.end_line) for fold in found] == [
        (1, 3),
        (4, 10),
        (5, 10),
        (6, 8),
        (9, 10),
    ]
    (chain,) = await client.text_document_selection_range_async(
        types.SelectionRangeParams(document, [position("STORE", 2)])
    )
    assert covered(chain.range) == "STORE" and covered(chain.parent.range) == "storeOp: STORE"
    (tmp_path / "a.spv").write_bytes(b"")
    text = "pipelines: {p: {stages: [{stage: FRAGMENT, module: a.spv}]}}\n"
    item = types.TextDocumentItem(
        (tmp_path / "b.msaa.yaml").as_uri(), types.LanguageKind.Yaml, 1, text
    )
    client.text_document_did_open(types.DidOpenTextDocumentParams(item))
    (link,) = await client.text_document_document_link_async(
        types.DocumentLinkParams(types.TextDocumentIdentifier(item.uri))
    )
    assert link.target == (tmp_path / "a.spv").as_uri()


@pytest.mark.asyncio
async def test_settings_are_explained(client: pytest_lsp.LanguageClient, tmp_path: Path) -> None:
    item = types.TextDocumentItem(
        (tmp_path / "msaa-lint.toml").as_uri(), "toml", 1, "strict-inputs = true\nfail-on"
    )
    client.text_document_did_open(types.DidOpenTextDocumentParams(item))
    document = types.TextDocumentIdentifier(item.uri)
    answer = await client.text_document_completion_async(
        types.CompletionParams(document, types.Position(1, 7))
    )
    (cost,) = [each for each in answer.items if each.label == "fail-on-cost"]
    assert (
        cost.detail == "a cost, such as `50MB/s`, `100mW`, or `16MiB`"
        and cost.documentation.value.startswith("**fail-on-cost**")
    )
    hovered = await client.text_document_hover_async(
        types.HoverParams(document, types.Position(0, 3))
    )
    assert hovered.contents.value.endswith(
        "Default: `false`"
    ) and hovered.range.end.character == len("strict-inputs")
