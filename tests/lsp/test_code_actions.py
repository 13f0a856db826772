"""Code actions: fixes, suppressions, and keys that undecided rules lack."""

from __future__ import annotations

from pathlib import Path

import pytest
from lsprotocol import types

from tests.command import run
from tests.descriptions import CLEAN, STORED
from tests.lsp.editor import Editor
from tests.lsp.test_diagnostics import play

EVERYWHERE = types.Range(types.Position(0, 0), types.Position(100, 0))

LAZY = types.ClientCapabilities(
    text_document=types.TextDocumentClientCapabilities(
        code_action=types.CodeActionClientCapabilities(
            resolve_support=types.ClientCodeActionResolveOptions(["edit"])
        )
    )
)


def applied(text: str, action: types.CodeAction) -> str:
    """An ASCII text after an action."""
    assert action.edit is not None and action.edit.document_changes is not None
    (change,) = action.edit.document_changes
    assert isinstance(change, types.TextDocumentEdit)
    starts = [0]
    for line in text.splitlines(keepends=True):
        starts.append(starts[-1] + len(line))
    for edit in sorted(
        change.edits,
        key=lambda edit: (edit.range.start.line, edit.range.start.character),
        reverse=True,
    ):
        assert isinstance(edit, types.TextEdit)
        start, end = (
            starts[place.line] + place.character for place in (edit.range.start, edit.range.end)
        )
        text = text[:start] + edit.new_text + text[end:]
    return text


@pytest.mark.parametrize(
    "capabilities", [types.ClientCapabilities(), LAZY], ids=["at once", "when chosen"]
)
def test_a_fix_is_that_of_check(tmp_path: Path, capabilities: types.ClientCapabilities) -> None:
    async def scenario(editor: Editor) -> None:
        found, *_ = await editor.open("a.msaa.yaml", STORED)
        actions = await editor.actions("a.msaa.yaml", found.range)
        fix = next(action for action in actions if action.is_preferred)
        assert (fix.title, fix.kind) == ("Set storeOp to DONT_CARE", types.CodeActionKind.QuickFix)
        if capabilities is LAZY:
            assert fix.edit is None
            fix = await editor.client.code_action_resolve_async(fix)
        fixed = run(editor.folder, "check", "--fix", "-", stdin=STORED.encode()).stdout
        assert applied(STORED, fix) == fixed == CLEAN

    play(tmp_path, scenario, capabilities)


def test_all_safe_fixes_are_one_action_that_leaves_unsafe_ones_alone(tmp_path: Path) -> None:
    text = STORED.replace(
        "loadOp: DONT_CARE, storeOp: STORE, initialLayout: UNDEFINED",
        "loadOp: LOAD, storeOp: STORE, initialLayout: UNDEFINED",
    )

    async def scenario(editor: Editor) -> None:
        await editor.open("a.msaa.yaml", text)
        (action,) = await editor.actions("a.msaa.yaml", EVERYWHERE, "source.fixAll")
        assert action.kind == "source.fixAll.msaaLint"
        assert (
            applied(text, await editor.client.code_action_resolve_async(action))
            == run(editor.folder, "check", "--fix", "-", stdin=text.encode()).stdout
        )
        assert await editor.actions("a.msaa.yaml", EVERYWHERE, "source.organizeImports") == []
        await editor.open("b.msaa.yaml", CLEAN)
        assert await editor.actions("b.msaa.yaml", EVERYWHERE, "source.fixAll") == []

    play(tmp_path, scenario)


def test_a_suppression_silences_its_finding(tmp_path: Path) -> None:
    async def scenario(editor: Editor) -> None:
        found, other = await editor.open("a.msaa.yaml", STORED)
        actions = await editor.actions("a.msaa.yaml", found.range, "quickfix")
        action = next(
            action
            for action in actions
            if action.title == "Suppress multisampled-attachment-stored here, with a reason"
        )
        suppressed = applied(STORED, await editor.client.code_action_resolve_async(action))
        assert "      # msaa-lint: ignore[multisampled-attachment-stored] TODO" in suppressed
        assert [each.code for each in await editor.replace("a.msaa.yaml", suppressed)] == [
            other.code
        ]

    play(tmp_path, scenario)


def test_json_has_no_comments(tmp_path: Path) -> None:
    import json

    import yaml

    async def scenario(editor: Editor) -> None:
        found, *_ = await editor.open("a.msaa.json", json.dumps(yaml.safe_load(STORED)), "json")
        titles = [
            action.title for action in await editor.actions("a.msaa.json", found.range, "quickfix")
        ]
        assert "Set storeOp to DONT_CARE" in titles
        assert not any("Suppress" in title for title in titles)

    play(tmp_path, scenario)


def test_code_is_suppressed_in_its_own_comments(tmp_path: Path) -> None:
    pytest.importorskip("tree_sitter")
    code = (Path(__file__).parents[2] / "examples" / "code").glob("*.c*")
    text = next(iter(sorted(code))).read_text(encoding="utf-8")

    async def scenario(editor: Editor) -> None:
        first, *others = await editor.open("main.cpp", text, "cpp")
        actions = await editor.actions(
            "main.cpp", types.Range(first.range.start, first.range.start)
        )
        # The code is not edited by fixes.
        assert {action.title.partition(" ")[0] for action in actions} == {"Suppress"}
        suppressed = applied(text, await editor.client.code_action_resolve_async(actions[0]))
        assert "// msaa-lint: ignore[" in suppressed
        assert len(await editor.replace("main.cpp", suppressed)) <= len(others)

    play(tmp_path, scenario)


def test_a_key_that_an_undecided_rule_lacks_is_added(tmp_path: Path) -> None:
    text = CLEAN.replace(", usage: [COLOR_ATTACHMENT, SAMPLED]", "")

    async def scenario(editor: Editor) -> None:
        await editor.open("a.msaa.yaml", text)
        line = types.Position(2, 0)
        actions = await editor.actions("a.msaa.yaml", types.Range(line, line), "refactor.rewrite")
        titles = {action.title.partition(",")[0]: action for action in actions}
        assert "Add usage: [COLOR_ATTACHMENT" in titles and not any(
            ": " not in title for title in titles
        )
        assert {
            "Add sharingMode: EXCLUSIVE to images.color",
            "Add sharingMode: CONCURRENT to images.color",
        } <= titles.keys()
        added = applied(
            text,
            await editor.client.code_action_resolve_async(
                titles["Add sharingMode: EXCLUSIVE to images.color"]
            ),
        )
        assert "sharingMode: EXCLUSIVE" in added.split("\n")[2]
        assert not any(
            each.code.startswith("MSAA9") for each in await editor.replace("a.msaa.yaml", added)
        )

    play(tmp_path, scenario)


def test_an_action_of_an_older_version_has_no_edit(tmp_path: Path) -> None:
    async def scenario(editor: Editor) -> None:
        found, *_ = await editor.open("a.msaa.yaml", STORED)
        action = (await editor.actions("a.msaa.yaml", found.range))[0]
        await editor.replace("a.msaa.yaml", f"# more\n{STORED}")
        assert (await editor.client.code_action_resolve_async(action)).edit is None
        for data in (
            None,
            {"uri": 3},
            {**action.data, "version": 2, "number": -1},
            {**action.data, "version": 2, "number": 10**9},
        ):
            action.data = data
            assert (await editor.client.code_action_resolve_async(action)).edit is None

    play(tmp_path, scenario, LAZY)


IN_A_SCALAR = """\
images:
  color: {format: R8G8B8A8_UNORM, samples: 1, usage:
    "COLOR_ATTACHMENT |
     SAMPELD"}
"""


def test_a_suppression_is_only_offered_where_it_silences(tmp_path: Path) -> None:
    """Each suppression that is offered for a finding of a text is applied, and the finding is
    gone.
    """
    spread = STORED.replace(
        "loadOp: CLEAR, storeOp: STORE", "loadOp: CLEAR,\n        storeOp:\n          STORE"
    )
    anchored = STORED.replace("{image: color_ms", "&ms\n        {image: color_ms")
    texts = [
        STORED,
        spread,
        anchored,
        IN_A_SCALAR,
        STORED.replace("\n", "\r\n"),
        f"# x\n---\n{STORED}...\n",
    ]

    async def scenario(editor: Editor) -> None:
        tried = 0
        for number, text in enumerate(texts):
            name = f"{number}.msaa.yaml"
            found = await editor.open(name, text)
            offered = await editor.actions(name, EVERYWHERE, "quickfix")
            suppressions = [action for action in offered if action.title.startswith("Suppress")]
            for action in [
                await editor.client.code_action_resolve_async(action) for action in suppressions
            ]:
                remaining = await editor.replace(name, applied(text, action))
                (diagnostic,) = action.diagnostics or ()
                assert [each.code for each in remaining].count(diagnostic.code) == [
                    each.code for each in found
                ].count(diagnostic.code) - 1
                tried += 1
        assert tried == 10

    play(tmp_path, scenario)


def test_an_editor_that_takes_snippets_gets_its_cursor_in_the_value(tmp_path: Path) -> None:
    capabilities = types.ClientCapabilities(
        workspace=types.WorkspaceClientCapabilities(
            workspace_edit=types.WorkspaceEditClientCapabilities(snippet_edit_support=True)
        )
    )

    async def scenario(editor: Editor) -> None:
        await editor.open("a.msaa.yaml", CLEAN)
        line = types.Position(1, 0)
        actions = await editor.actions("a.msaa.yaml", types.Range(line, line), "refactor.rewrite")
        action = next(
            action
            for action in actions
            if action.title.startswith("Add mipLevels to images.color_ms,")
        )
        assert action.edit is not None and action.edit.document_changes is not None
        (change,) = action.edit.document_changes
        assert isinstance(change, types.TextDocumentEdit)
        (edit,) = change.edits
        assert isinstance(edit, types.SnippetTextEdit) and edit.snippet.value == ", mipLevels: $0"

    play(tmp_path, scenario, capabilities)
