"""The server finds what `check` finds, through random edits of a document."""

from __future__ import annotations

import asyncio
import json
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import pytest
import yaml
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from lsprotocol import types

from tests.command import run
from tests.descriptions import CLEAN, STORED
from tests.lsp.editor import Editor, editor

SEVERITIES = {
    types.DiagnosticSeverity.Error: "error",
    types.DiagnosticSeverity.Warning: "warning",
    types.DiagnosticSeverity.Information: "note",
}

PIECES = (
    "STORE", "DONT_CARE", "4", "1", "}", "{", "[", "]", ",", ": ", "\n", "\r\n", "  ",
    "# msaa-lint: ignore[MSAA201] why\n", "é\U0001f600",
    "\u2028", "\t", "&a ", "*a", "---\n", "usage: ", "samples: 8", "'", '"', "\x00", "",
)  # fmt: skip

CODE = Path(__file__).parents[2] / "examples" / "code" / "forward.cpp"


def position(text: str, offset: int) -> types.Position:
    before = text[:offset].replace("\r\n", "\n").replace("\r", "\n")
    line = before.rpartition("\n")[2]
    return types.Position(before.count("\n"), len(line.encode("utf-16-le")) // 2)


def offset_between_characters(text: str, offset: int) -> int:
    """An offset that is not within a line end, which no position of the protocol names."""
    return offset - 1 if text[offset - 1 : offset + 1] == "\r\n" else offset


class Session:
    """An editor that stays open from one example to the next."""

    def __init__(self, folder: Path) -> None:
        self.runner = asyncio.Runner()
        self.context = editor(folder)
        self.editor: Editor = self.runner.run(self.context.__aenter__())
        self.documents = 0

    def close(self) -> None:
        self.runner.run(self.context.__aexit__(None, None, None))
        self.runner.close()


@pytest.fixture(scope="module")
def session(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Session]:
    folder = tmp_path_factory.mktemp("edits") / "folder"
    folder.mkdir()
    opened = Session(folder)
    yield opened
    opened.close()


class Kind(NamedTuple):
    """A kind of documents: its name in a folder, its language in an editor, texts to begin with,
    what is likely in them, and the input that is checked with it, if it is none itself.
    """

    name: str
    language: str
    starts: tuple[str, ...]
    pieces: tuple[str, ...] = ()
    checked: str = ""


JSON = tuple(
    json.dumps(yaml.safe_load(text), indent=indent) for text, indent in ((STORED, 1), (CLEAN, None))
)
TOML = (
    'select = ["MSAA2", "MSAA403"]\nfail-on = "warning"\n[severity]\nMSAA201 = "note"\n'
    "[limits]\ndepth = 50\n"
)
KINDS = [
    Kind("frame.msaa.yaml", "yaml", (CLEAN, STORED)),
    Kind("frame.msaa.json", "json", JSON, ('"samples": 8', '"STORE"', "null", ": ")),
    Kind(
        "msaa-lint.toml",
        "toml",
        (TOML, f'extends = "base.toml"\n{TOML}'),
        ("= ", "[limits]\n", "depth = 0\n", '"off"', "true"),
        "input",
    ),
    Kind(
        "main.cpp",
        "cpp",
        (CODE.read_text(encoding="utf-8"),),
        ("VK_SAMPLE_COUNT_1_BIT", ";", "// ", "/*", "(", "#if 1\n"),
    ),
]


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.language)
@settings(max_examples=10, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(data=st.data())
def test_findings_are_those_of_check_after_edits(
    session: Session, kind: Kind, data: st.DataObject
) -> None:
    if kind.language == "cpp":
        pytest.importorskip("tree_sitter")
    pieces = st.sampled_from(PIECES + kind.pieces)
    edits = st.lists(st.tuples(st.floats(0, 1), st.integers(0, 40), pieces), max_size=4)
    start, steps = (
        data.draw(st.sampled_from(kind.starts)),
        data.draw(st.lists(edits, min_size=1, max_size=3)),
    )
    session.documents += 1
    folder = session.editor.folder / str(session.documents)
    folder.mkdir()
    if kind.checked:
        (folder / "input.msaa.yaml").write_text(STORED, encoding="utf-8")
        (folder / "base.toml").write_text("min-severity = 'warning'\n", encoding="utf-8")
    session.runner.run(
        edited(session.editor, f"{session.documents}/{kind.name}", kind, start, steps)
    )


async def edited(
    opened: Editor, name: str, kind: Kind, text: str, steps: list[list[tuple[float, int, str]]]
) -> None:
    """Edits a document step by step, and compares its diagnostics after each."""
    await opened.open(name, text, kind.language)
    for step in steps:
        changes: list[types.TextDocumentContentChangeEvent] = []
        for share, length, piece in step:
            begin = offset_between_characters(text, int(share * len(text)))
            end = max(begin, offset_between_characters(text, min(begin + length, len(text))))
            place = types.Range(position(text, begin), position(text, end))
            changes.append(types.TextDocumentContentChangePartial(place, piece))
            text = text[:begin] + piece + text[end:]
        found = await opened.change(name, *changes)
        (opened.folder / name).write_bytes(text.encode())
        checked = f"{name.partition('/')[0]}/input.msaa.yaml" if kind.checked else name
        report = json.loads(run(opened.folder, "check", "--output", "json", checked).stdout)
        expected = [of_report(each, text) for each in report["findings"] if each["file"] == name]
        assert [plain(each) for each in found] == expected
    opened.client.text_document_did_close(
        types.DidCloseTextDocumentParams(types.TextDocumentIdentifier(opened.uri(name)))
    )


def plain(found: types.Diagnostic) -> tuple[object, ...]:
    return (
        found.code,
        found.message.split("\n")[0],
        SEVERITIES[found.severity],
        found.range.start.line,
        found.range.start.character,
    )


def of_report(found: dict[str, object], text: str) -> tuple[object, ...]:
    line, column = (found["line"] or 1, found["column"] or 1)
    lines = text.replace("\r\n", "\n").replace("\r", "\n").split("\n")
    before = lines[line - 1][: column - 1]
    return (
        found["code"],
        f"{found['message']} [{found['rule']}]",
        found["severity"],
        line - 1,
        len(before.encode("utf-16-le")) // 2,
    )
