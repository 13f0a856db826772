"""Formatting: whitespace only, the same content, and nothing left to do."""

from __future__ import annotations

import re
from pathlib import Path
from random import Random

import pytest
from hypothesis import given
from hypothesis import strategies as st
from lsprotocol import types

from msaa_lint.cli.lsp import formatting
from msaa_lint.cli.lsp.formatting import layout
from msaa_lint.core.text.edits import apply
from msaa_lint.core.text.node import Limits
from msaa_lint.core.text.source import Source
from msaa_lint.core.text.span import Span
from msaa_lint.core.text.tree import parse
from msaa_lint.linter.rules.front_matter import split
from tests.linter.fixes.linting import comments_of, fix_findings
from tests.linter.fixes.spellings import data_of, plain, written
from tests.lsp.editor import Editor
from tests.lsp.test_diagnostics import play
from tests.lsp.views import descriptions
from tests.pages import RULES, all_examples
from tests.strength import examples

EXAMPLES = {path.stem: path.read_text(encoding="utf-8") for path in descriptions()}
PAGES = {
    str(each): re.sub(r"(?m)^# *\^.*\n", "", each.text)
    for each in all_examples()
    if each.kind == "bad"
}
"""The examples of rule pages without the comments that mark findings, whose columns have a
meaning.
"""
DATA = [data_of(text) for text in (EXAMPLES | PAGES).values() if "\n---\n" not in text]

UNFORMATTED = """\
# A frame
frame:   { width: 16,height : 16 ,  fps: 60 }   # é😀


images:
    # multisampled
    a: {format: D16_UNORM, samples: 4,
            usage: [ SAMPLED ]}
renderPasses:
    p:
      subpasses:
      -   colorAttachments: [  ]
      # the last
      - {}
"""
FORMATTED = """\
# A frame
frame: {width: 16, height: 16, fps: 60}   # é😀

images:
  # multisampled
  a: {format: D16_UNORM, samples: 4,
          usage: [SAMPLED]}
renderPasses:
  p:
    subpasses:
      - colorAttachments: []
      # the last
      - {}
"""


def formatted(text: str) -> str:
    """The formatted text, after a check of what the edits may do."""
    edits, problems = layout(text)
    result = apply(text, edits)
    assert problems == []
    assert all(
        not edit.text.strip()
        and not text[slice(*edit.span)].strip()
        and text[slice(*edit.span)] != edit.text
        for edit in edits
    )
    before, after = (parse(Source("", each), Limits()) for each in (text, result))
    assert (before.problems, after.problems) == ([], [])
    assert list(map(plain, after.documents)) == list(map(plain, before.documents))
    assert comments_of(result) == [comment.rstrip() for comment in comments_of(text)]
    return result


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (UNFORMATTED, FORMATTED),
        (UNFORMATTED.replace("\n", "\r\n"), FORMATTED.replace("\n", "\r\n")),
        ("a:  1   # x \n\n\n\nb: 2", "a: 1   # x\n\nb: 2\n"),
        ("  a:   'x'\n  b : \"y\"\n\n", "a: 'x'\nb: \"y\"\n"),
        (
            "a:\n    - |\n        x\n          y\n\n    - >-\n        z  \n",
            "a:\n  - |\n      x\n        y\n\n  - >-\n      z  \n",
        ),
        ("a: |+\n    x\n\n\n\n# y\n", "a: |+\n  x\n\n\n\n# y\n"),
        ("a:   one\n   two\nb:   'one\n\n   two'\n", "a: one\n   two\nb: 'one\n\n   two'\n"),
        (
            "a:   &x {k: 0x10}\n\n\nb:   *x\nc:   !!str   1\n",
            "a: &x {k: 0x10}\n\nb: *x\nc: !!str   1\n",
        ),
        ("---\na:   1\n---\n\n\nb:   2\n...\n", "---\na: 1\n---\n\nb: 2\n...\n"),
        ('{"a":1.50, "a" : [ 1e3,2 ],\n"b":\n{ }}', '{"a": 1.50, "a": [1e3, 2],\n "b":\n   {}}\n'),
        (
            "a: [1 ,  2 , ]\nb: {c:  1,  # x\n    d: 2 ,\n    }\n",
            "a: [1, 2,]\nb: {c: 1,  # x\n    d: 2,\n    }\n",
        ),
        (
            "a:\n- b:  {\n    c:  1,\n    d: [ 2,\n      3 ],\n  }\n",
            "a:\n  - b: {\n      c: 1,\n      d: [2,\n        3],\n    }\n",
        ),
        ("a:   {\n  b:  'one\n\n  two',\n}\n", "a: {\n  b: 'one\n\n  two',\n}\n"),
        ('{\n    "a": [\n      1,\n    2\n    ]\n}\n', '{\n  "a": [\n    1,\n    2\n  ]\n}\n'),
    ],
)
def test_layouts(text: str, expected: str) -> None:
    result = apply(text, layout(text).edits)
    assert result == expected
    assert layout(expected).edits == []


@pytest.mark.parametrize("name", EXAMPLES)
def test_examples_are_formatted(name: str) -> None:
    assert layout(EXAMPLES[name]) == ([], [])


@pytest.mark.parametrize(
    "page",
    sorted({RULES / f"{each.rule}.md" for each in all_examples()}),
    ids=lambda page: page.stem,
)
def test_front_matter_is_formatted(page: Path) -> None:
    head = split(page.read_text(encoding="utf-8"))[0]
    assert head is not None and layout(head.split("\n", 1)[1]) == ([], [])


@pytest.mark.parametrize("unsafe", [False, True])
@pytest.mark.parametrize("name", EXAMPLES | PAGES)
def test_fixes_keep_a_text_formatted(name: str, unsafe: bool) -> None:
    text = formatted((EXAMPLES | PAGES)[name])
    assert layout(fix_findings(text, unsafe).text) == ([], [])


@given(st.sampled_from(DATA), st.randoms(use_true_random=False), st.sampled_from([0.0, 0.3]))
@examples(3)
def test_random_spellings_keep_their_content(data: object, random: Random, shared: float) -> None:
    result = formatted(written(data, random, shared))
    assert layout(result) == ([], [])


@given(st.sampled_from(sorted(EXAMPLES)), st.integers(2, 4), st.randoms(use_true_random=False))
@examples(3)
def test_layouts_of_an_example_become_its_own(name: str, step: int, random: Random) -> None:
    def blanks(match: re.Match[str]) -> str:
        return match[1] + " " * random.randint(1, 4) + match[2]

    lines = []
    for line in EXAMPLES[name].splitlines():
        content = line.lstrip(" ")
        # Spaces in a comment are its own, and those before it align it.
        code, mark, comment = content.partition("#")
        spaced = re.sub(
            r"([:,]) (\S)",
            blanks,
            re.sub(
                r"([{\[])(\w)", lambda match: match[1] + " " * random.randint(0, 2) + match[2], code
            ),
        )
        spaced = (
            spaced.replace("- ", "-" + " " * (2 * step - 1), 1)
            if spaced.startswith("- ")
            else spaced
        )
        lines.append(
            " " * (len(line) - len(content)) * step
            + spaced
            + mark
            + comment
            + ("" if mark else " " * random.randint(0, 2))
        )
        if not content:
            lines += [""] * random.randint(0, 3)
    assert formatted("\n".join(lines)) == EXAMPLES[name]


@pytest.mark.parametrize("text", ["a: [1,\n", "a:  1\nb: *x\n", "\0", "a:  b:  c", ""])
def test_a_text_with_a_syntax_error_has_no_edits(text: str) -> None:
    assert layout(text).edits == []


@pytest.mark.parametrize(
    "output", ["a: b #x\n", "a: c#x\n", "a:\n  # b#x\n", "a:b#x\n", "a: 'b#x'\n", "a: ,b#x\n", ""]
)
def test_an_output_that_means_something_else_has_no_edits(
    output: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    program = tmp_path / "ryl"
    program.write_text(f"#!/bin/sh\nprintf %s {output!r}\n".replace("\\n", "\n"), encoding="utf-8")
    program.chmod(0o755)
    monkeypatch.setattr(formatting, "ryl", lambda: str(program))
    assert layout("a:   b#x\n").edits == []


def test_a_text_that_is_too_long_has_no_edits() -> None:
    text = "a:  [\n" + "\n" * formatting.MAX_LENGTH + "]\n"
    assert layout(text) == ([], ["the text is longer than 1,048,576 characters"])
    assert apply(text[:99] + "]\n", layout(text[:99] + "]\n").edits) == "a: [\n\n]\n"


def test_a_part_is_formatted_if_it_can_be() -> None:
    text = "a:   1\nb:   2\nc:\n    d:   3\n    e:   4\n"
    second = Span(text.index("b"), text.index("\nc"))
    assert apply(text, layout(text, second).edits) == text.replace("b:   2", "b: 2")
    assert layout(text, Span(text.index("    e"), len(text))) == (
        [],
        ["formatting would change what the text means"],
    )


def applied(text: str, edits: list[types.TextEdit] | None, unit: str = "utf-16-le") -> str:
    """The text after edits, in an editor that counts in 16-bit units."""
    assert edits is not None
    data = text.encode(unit)
    starts = [0, *(match.end() for match in re.finditer("\n".encode(unit), data))]
    for edit in sorted(
        edits, key=lambda edit: (edit.range.start.line, edit.range.start.character), reverse=True
    ):
        start, end = (
            starts[place.line] + 2 * place.character for place in (edit.range.start, edit.range.end)
        )
        data = data[:start] + edit.new_text.encode(unit) + data[end:]
    return data.decode(unit)


OPTIONS = types.FormattingOptions(tab_size=8, insert_spaces=False)


async def asked(
    editor: Editor, name: str, lines: tuple[int, int] | None = None
) -> list[types.TextEdit] | None:
    """The answer to a request to format a document, or its lines up to one that is not included."""
    document = types.TextDocumentIdentifier(editor.uri(name))
    if lines is None:
        found = await editor.client.text_document_formatting_async(
            types.DocumentFormattingParams(document, OPTIONS)
        )
    else:
        place = types.Range(types.Position(lines[0], 0), types.Position(lines[1], 0))
        found = await editor.client.text_document_range_formatting_async(
            types.DocumentRangeFormattingParams(document, place, OPTIONS)
        )
    return list(found) if found is not None else None


def test_an_editor_formats_descriptions_and_rule_pages(tmp_path: Path) -> None:
    page = "---\ncode:   A\nwhen:  b\n---\n\n\n\n# A  page\n"

    async def scenario(editor: Editor) -> None:
        assert (
            editor.server.document_formatting_provider
            and editor.server.document_range_formatting_provider
        )
        await editor.open("a.msaa.yaml", UNFORMATTED)
        edits = await asked(editor, "a.msaa.yaml")
        assert applied(UNFORMATTED, edits) == FORMATTED
        assert edits is not None and all(not edit.new_text.strip() for edit in edits)
        assert await asked(editor, "a.msaa.yaml", (0, 1)) == []
        first = UNFORMATTED.split("\n\n")[0]
        assert applied(
            UNFORMATTED, await asked(editor, "a.msaa.yaml", (0, 2))
        ) == UNFORMATTED.replace(first, FORMATTED.split("\n\n")[0])
        await editor.replace("a.msaa.yaml", FORMATTED)
        assert await asked(editor, "a.msaa.yaml") == []
        await editor.open("a.msaa.json", '{"frame":{}}', "json")
        assert applied('{"frame":{}}', await asked(editor, "a.msaa.json")) == '{"frame": {}}\n'
        await editor.open("page.md", page, "markdown")
        assert applied(page, await asked(editor, "page.md")) == page.replace("   A", " A").replace(
            "  b", " b"
        )
        assert editor.messages == []

    play(tmp_path, scenario)


def test_what_is_not_formatted_stays_as_it_is(tmp_path: Path) -> None:
    async def scenario(editor: Editor) -> None:
        for name, text, language in [
            ("a.msaa.yaml", "a: [1,\n", "yaml"),
            ("b.yaml", "services:   {}\n", "yaml"),
            ("c.md", "#  A\n", "markdown"),
        ]:
            await editor.open(name, text, language)
            assert not await asked(editor, name)
        assert editor.messages == []
        text = "frame:\n    width:   1\n    height:   1\n"
        await editor.open("d.msaa.yaml", text)
        assert await asked(editor, "d.msaa.yaml", (2, 3)) == []
        assert [(each.type, each.message) for each in editor.messages] == [
            (
                types.MessageType.Info,
                "Formatting d.msaa.yaml: formatting would change what the text means",
            )
        ]

    play(tmp_path, scenario)


def test_an_editor_that_takes_a_list_of_files_formats_descriptions_by_it(tmp_path: Path) -> None:
    async def scenario(editor: Editor) -> None:
        assert (
            editor.server.document_formatting_provider is None
            and editor.server.document_range_formatting_provider is None
        )
        await editor.open("a.msaa.yaml", UNFORMATTED)
        registered = {each.method: each.register_options for each in editor.registrations}
        selector = [
            {"pattern": f"**/*{name}"} for name in (".msaa.yaml", ".msaa.yml", ".msaa.json")
        ]
        for method in (types.TEXT_DOCUMENT_FORMATTING, types.TEXT_DOCUMENT_RANGE_FORMATTING):
            assert registered[method] == {"documentSelector": selector}
        assert applied(UNFORMATTED, await asked(editor, "a.msaa.yaml")) == FORMATTED

    play(tmp_path, scenario, "visual-studio-code")
