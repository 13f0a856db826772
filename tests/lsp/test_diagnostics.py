"""Diagnostics: where, what, when, and that they are those of `check`."""

from __future__ import annotations

import asyncio
import json
from collections.abc import Awaitable, Callable
from pathlib import Path

import pytest
from lsprotocol import types

from tests.command import run
from tests.descriptions import CLEAN, STORED
from tests.lsp.editor import Editor, editor
from tests.lsp.texts import CODES

Scenario = Callable[[Editor], Awaitable[None]]


def play(
    tmp_path: Path,
    scenario: Scenario,
    capabilities: types.ClientCapabilities | str = "neovim@v0.7.0",
) -> None:
    """Runs a scenario in an editor with an empty folder open."""
    folder = tmp_path / "folder"
    folder.mkdir()

    async def run_scenario() -> None:
        async with editor(folder, capabilities) as opened:
            await scenario(opened)

    asyncio.run(run_scenario())


def test_a_finding_has_its_place_its_rule_and_related_places(tmp_path: Path) -> None:
    async def scenario(editor: Editor) -> None:
        found, _ = await editor.open("a.msaa.yaml", STORED)
        line = next(
            number
            for number, text in enumerate(STORED.split("\n"))
            if "storeOp: STORE, initialLayout: UNDEFINED, finalLayout: COLOR" in text
        )
        column = STORED.split("\n")[line].index("STORE,")
        assert found.range == types.Range(
            types.Position(line, column), types.Position(line, column + 5)
        )
        assert (found.code, found.source, found.severity) == (
            "MSAA201",
            "msaa-lint",
            types.DiagnosticSeverity.Warning,
        )
        assert (
            "stores 4x samples that nothing reads; set storeOp to DONT_CARE "
            "[multisampled-attachment-stored]" in found.message
        )
        assert found.code_description is None
        assert [each.message for each in found.related_information or ()] == [
            "4 samples",
            "resolved here",
        ]
        assert {each.location.uri for each in found.related_information or ()} == {
            editor.uri("a.msaa.yaml")
        }

    play(tmp_path, scenario)


def test_the_page_of_the_rule_is_linked_if_the_documentation_has_an_address(tmp_path: Path) -> None:
    async def scenario(editor: Editor) -> None:
        (editor.folder / "msaa-lint.toml").write_text(
            'docs-url = "https://lint.example/docs"\n', encoding="utf-8"
        )
        found, _ = await editor.open("a.msaa.yaml", STORED)
        assert found.code_description == types.CodeDescription(
            "https://lint.example/docs/rules/multisampled-attachment-stored/"
        )

    play(tmp_path, scenario)


def test_an_edit_changes_the_diagnostics(tmp_path: Path) -> None:
    async def scenario(editor: Editor) -> None:
        assert await editor.open("a.msaa.yaml", CLEAN) == []
        line = CLEAN.split("\n").index(
            next(text for text in CLEAN.split("\n") if "storeOp: DONT_CARE" in text)
        )
        column = CLEAN.split("\n")[line].index("DONT_CARE, initial")
        place = types.Range(
            types.Position(line, column), types.Position(line, column + len("DONT_CARE"))
        )
        found, _ = await editor.change(
            "a.msaa.yaml", types.TextDocumentContentChangePartial(place, "STORE")
        )
        assert found.code == "MSAA201"
        assert await editor.replace("a.msaa.yaml", CLEAN) == []

    play(tmp_path, scenario)


def test_many_edits_at_once_end_with_the_newest(tmp_path: Path) -> None:
    async def scenario(editor: Editor) -> None:
        await editor.open("a.msaa.yaml", CLEAN)
        for number in range(50):
            editor.send(
                "a.msaa.yaml",
                types.TextDocumentContentChangeWholeDocument(STORED if number % 2 else CLEAN),
            )
        assert [found.code for found in await editor.diagnostics("a.msaa.yaml")] == CODES

    play(tmp_path, scenario)


def test_a_broken_text_is_an_error_and_is_mended(tmp_path: Path) -> None:
    async def scenario(editor: Editor) -> None:
        await editor.open("a.msaa.yaml", CLEAN)
        for broken, code in (
            ("images: {\n", "MSAA901"),
            ("images: {a: {fromat: 1}}\n", "MSAA902"),
            ("\x00", "MSAA901"),
            ("[" * 5000, "MSAA906"),
        ):
            found = await editor.replace("a.msaa.yaml", broken)
            assert code in [each.code for each in found]
        assert await editor.replace("a.msaa.yaml", CLEAN) == []

    play(tmp_path, scenario)


def test_yaml_of_other_tools_has_no_diagnostics_but_a_description_by_its_content_has(
    tmp_path: Path,
) -> None:
    async def scenario(editor: Editor) -> None:
        assert await editor.open("compose.yaml", "services:\n  web: {image: nginx}\n") == []
        assert [found.code for found in await editor.open("frame.yaml", STORED)] == CODES
        # It stays one while it is edited.
        assert [found.code for found in await editor.replace("frame.yaml", "ima: {}\n")] == [
            "MSAA902"
        ]
        assert [
            found.code for found in await editor.open("new.msaa.yaml", STORED, save=False)
        ] == CODES

    play(tmp_path, scenario)


@pytest.mark.parametrize("encoding", list(types.PositionEncodingKind))
def test_positions_are_in_the_units_of_the_editor(
    tmp_path: Path, encoding: types.PositionEncodingKind
) -> None:
    text = "# \U0001f600é\u2028\x85\n" + STORED.replace("color_ms", "m\U0001f600é")
    units = {
        "utf-8": lambda part: len(part.encode()),
        "utf-16": lambda part: len(part.encode("utf-16-le")) // 2,
        "utf-32": len,
    }[encoding.value]

    async def scenario(editor: Editor) -> None:
        assert editor.server.position_encoding == encoding
        found, _ = await editor.open("a.msaa.yaml", text)
        line = next(
            number
            for number, each in enumerate(text.split("\n"))
            if "storeOp: STORE, initialLayout: UNDEFINED, finalLayout: COLOR" in each
        )
        before = text.split("\n")[line].partition("STORE,")[0]
        assert found.range.start == types.Position(line, units(before))
        place = types.Range(found.range.start, types.Position(line, units(before) + 5))
        assert (
            await editor.change(
                "a.msaa.yaml", types.TextDocumentContentChangePartial(place, "DONT_CARE")
            )
            == []
        )

    play(
        tmp_path,
        scenario,
        types.ClientCapabilities(
            general=types.GeneralClientCapabilities(position_encodings=[encoding])
        ),
    )


def test_a_changed_configuration_applies_to_open_documents(tmp_path: Path) -> None:
    capabilities = types.ClientCapabilities(
        workspace=types.WorkspaceClientCapabilities(
            did_change_watched_files=types.DidChangeWatchedFilesClientCapabilities(
                dynamic_registration=True
            )
        )
    )

    async def scenario(editor: Editor) -> None:
        settings = editor.folder / "msaa-lint.toml"
        settings.write_text("", encoding="utf-8")
        assert len(await editor.open("a.msaa.yaml", STORED)) == 2
        assert [each.method for each in editor.registrations] == ["workspace/didChangeWatchedFiles"]
        settings.write_text('ignore = ["MSAA201", "MSAA403"]\n', encoding="utf-8")
        change = types.FileEvent(settings.as_uri(), types.FileChangeType.Changed)
        editor.client.workspace_did_change_watched_files(
            types.DidChangeWatchedFilesParams([change])
        )
        assert await editor.diagnostics("a.msaa.yaml") == []
        # An unsaved configuration applies, too.
        assert (
            await editor.open("msaa-lint.toml", 'ignore = ["MSAA201", "MSAA403"]\n', "toml") == []
        )
        assert await editor.diagnostics("a.msaa.yaml") == []
        editor.send(
            "msaa-lint.toml", types.TextDocumentContentChangeWholeDocument('ignore = ["MSAA403"]\n')
        )
        assert [each.code for each in await editor.diagnostics("a.msaa.yaml")] == ["MSAA201"]

    play(tmp_path, scenario, capabilities)


def test_mistakes_of_a_configuration_and_of_a_rule_page(tmp_path: Path) -> None:
    page = (
        "---\ncode: X001\nsubject: attachment\nwhen: attachment.nothing == 1\nmessage: m\n---\n"
        "# x\n"
    )

    async def scenario(editor: Editor) -> None:
        (found,) = await editor.open("msaa-lint.toml", "select = 3\n", "toml")
        assert (found.code, found.range.start.line) == ("MSAA921", 0)
        found_in_page = await editor.open("my-rule.md", page, "markdown")
        assert {found.code for found in found_in_page} == {"MSAA921"}
        assert await editor.open("README.md", "# Notes\n", "markdown") == []

    play(tmp_path, scenario)


def test_an_editor_that_pulls_gets_a_report(tmp_path: Path) -> None:
    capabilities = types.ClientCapabilities(
        text_document=types.TextDocumentClientCapabilities(
            diagnostic=types.DiagnosticClientCapabilities()
        )
    )

    async def scenario(editor: Editor) -> None:
        (editor.folder / "a.msaa.yaml").write_text(STORED, encoding="utf-8")
        uri = editor.uri("a.msaa.yaml")
        editor.client.text_document_did_open(
            types.DidOpenTextDocumentParams(types.TextDocumentItem(uri, "yaml", 1, STORED))
        )
        report = await editor.client.text_document_diagnostic_async(
            types.DocumentDiagnosticParams(types.TextDocumentIdentifier(uri))
        )
        assert isinstance(report, types.RelatedFullDocumentDiagnosticReport)
        assert [found.code for found in report.items] == CODES
        assert editor.queue.empty()

    play(tmp_path, scenario, capabilities)


def test_source_code_is_linted_as_check_lints_it(tmp_path: Path) -> None:
    pytest.importorskip("tree_sitter")
    code = (Path(__file__).parents[2] / "examples" / "code").glob("*.c*")
    text = next(iter(sorted(code))).read_text(encoding="utf-8")

    async def scenario(editor: Editor) -> None:
        found = await editor.open("main.cpp", text, "cpp")
        expected = json.loads(run(editor.folder, "check", "--output", "json", "main.cpp").stdout)[
            "findings"
        ]
        assert [each.code for each in found] == [each["code"] for each in expected]
        assert found

    play(tmp_path, scenario)
