"""Definitions, references, renaming and the outline."""

from __future__ import annotations

import pytest

from msaa_lint.cli.lsp import navigation, rename, symbols
from msaa_lint.cli.lsp.view import View

from .views import at, edited, engine, view

FRAME = """\
images:
  color_ms: {format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT]}
  color: {format: R8G8B8A8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT]}
renderPasses:
  forward:
    attachments:
      source: {image: color_ms, loadOp: CLEAR, storeOp: DONT_CARE}
      target: {image: color, loadOp: DONT_CARE, storeOp: STORE}
    subpasses:
      - {colorAttachments: [source], resolveAttachments: [{attachment: target, layout: GENERAL}]}
      - {colorAttachments: [0]}
    dependencies: [{srcSubpass: EXTERNAL, dstSubpass: 1}]
  other: {attachments: {source: {image: color}}, subpasses: [{colorAttachments: [source]}]}
framebuffers:
  fb: {renderPass: forward, attachments: [color_ms, color]}
pipelines:
  opaque: {renderPass: forward, subpass: 1}
commands:
  - beginRenderPass: {renderPass: forward, framebuffer: fb}
  - draw: {pipeline: opaque}
  - nextSubpass
  - endRenderPass
  - present: {image: color}
"""


def lines(
    text: str, offset_of: str, occurrence: int = 0, with_definition: bool = True
) -> list[int]:
    """The lines that name what is named at an occurrence of a word, counted from 1."""
    offset = [n for n in range(len(text)) if text.startswith(offset_of, n)][occurrence]
    seen = view(text)
    return [
        text.count("\n", 0, span.start) + 1
        for span in navigation.references(seen, offset, with_definition)
    ]


def defined(text: str, offset_of: str, occurrence: int) -> list[int]:
    offset = [n for n in range(len(text)) if text.startswith(offset_of, n)][occurrence]
    return [
        text.count("\n", 0, span.start) + 1 for span in navigation.definition(view(text), offset)
    ]


def test_references() -> None:
    assert lines(FRAME, "color_ms") == [2, 7, 15]
    assert lines(FRAME, "color,", 0) == [3, 8, 13, 15, 23]
    assert lines(FRAME, "color,", 0, with_definition=False) == [8, 13, 15, 23]
    assert lines(FRAME, "forward") == [5, 15, 17, 19]
    assert lines(FRAME, "fb") == [15, 19]
    assert lines(FRAME, "opaque") == [17, 20]


def test_attachments_and_subpasses_belong_to_their_pass() -> None:
    assert lines(FRAME, "source") == [7, 10, 11]
    assert lines(FRAME, "source", 2) == [13, 13]
    assert lines(FRAME, "target", 1) == [8, 10]
    assert defined(FRAME, "1}\n", 0) == [11]
    assert defined(FRAME, "1}]", 0) == [11]
    assert defined(FRAME, "0]", 0) == [7]


def test_anchors_and_aliases() -> None:
    text = "images:\n  a: &base {format: D16_UNORM}\n  b: {<<: *base}\n  c: *base\n"
    assert lines(text, "base") == lines(text, "base", 2) == [2, 3, 4]
    assert defined(text, "base", 1) == [2]
    seen = view(text)
    assert edited(text, rename.rename(seen, text.index("*base") + 2, "one")) == text.replace(
        "base", "one"
    )
    with pytest.raises(rename.Refused, match="blanks"):
        rename.rename(seen, text.index("*base") + 2, "a b")


def test_an_anchor_may_be_defined_again() -> None:
    text = "images:\n  a: &x {samples: 1}\n  b: *x\n  c: &x {samples: 4}\n  d: *x\n"
    assert lines(text, "x") == [2, 3]
    assert lines(text, "x", 3) == [4, 5]


@pytest.mark.parametrize(
    ("name", "new", "quoted"),
    [
        ("color_ms", "a: b", '"a: b"'),
        ("fb", "true", '"true"'),
        ("opaque", "x.y", "x.y"),
        ("forward", "12", '"12"'),
    ],
)
def test_renames_where_it_is_defined_and_named(name: str, new: str, quoted: str) -> None:
    edits = rename.rename(view(FRAME), FRAME.index(name) + 1, new)
    renamed = edited(FRAME, edits)
    assert renamed == FRAME.replace(name, quoted)
    assert not view(renamed).result.documents[0].document.problems  # type: ignore[union-attr]


def test_renames_an_attachment_in_its_pass_only() -> None:
    renamed = edited(FRAME, rename.rename(view(FRAME), FRAME.index("source"), "samples"))
    assert "colorAttachments: [samples], resolve" in renamed
    assert "other: {attachments: {source" in renamed and "colorAttachments: [0]" in renamed


def test_renames_in_quotes() -> None:
    text = """{"images": {"a": {}, 'b': {}}, "commands": [{"present": {"image": 'a'}}, {"present": {"image": b}}]}"""
    assert edited(text, rename.rename(view(text), text.index('"a"') + 1, 'q"')) == text.replace(
        '"a"', '"q\\""'
    ).replace("'a'", "'q\"'")
    assert rename.prepare(view(text), text.index('"a"')) == (slice_of(text, "a"), "a")


def slice_of(text: str, name: str) -> tuple[int, int]:
    start = text.index(f'"{name}"') + 1
    return start, start + len(name)


def test_an_alias_of_a_name_follows_it() -> None:
    text = (
        "images:\n  a: {samples: 1}\ncommands:\n  - present: {image: &it a}\n  - present: "
        "{image: *it}\n"
    )
    assert edited(text, rename.rename(view(text), text.index("a:"), "b")) == text.replace(
        "a:", "b:", 1
    ).replace("imbges", "images").replace("&it a", "&it b")


def test_frames_of_one_program_share_names() -> None:
    text = "frame: {share: 0.5}\nimages: {a: {}}\n---\nframe: {share: 0.5}\nimages: {a: {}}\n"
    assert lines(text, "a:") == [2, 5]
    assert lines(text.replace("frame: {share: 0.5}\n", ""), "a:") == [1]


@pytest.mark.parametrize(
    ("name", "new", "why"),
    [
        ("color_ms", "color", "already `color` in `images`"),
        ("source", "target", "already `target` in `attachments`"),
        ("source", "UNUSED", "VK_ATTACHMENT_UNUSED"),
        ("color_ms", "", "cannot be a name"),
        ("color_ms", "a\nb", "cannot be a name"),
        ("color_ms", "a\u202eb", "cannot be a name"),
        ("format", "x", "no name"),
    ],
)
def test_refuses_names(name: str, new: str, why: str) -> None:
    with pytest.raises(rename.Refused, match=why):
        rename.rename(view(FRAME), FRAME.index(name), new)


def test_refuses_a_document_with_errors() -> None:
    text = FRAME + "images: {}\n"
    with pytest.raises(rename.Refused, match="error"):
        rename.rename(view(text), text.index("fb"), "x")


def test_an_index_is_not_renamed() -> None:
    text, offset = at(FRAME.replace("[0]", "[^0]"))
    assert rename.prepare(view(text), offset) is None


def test_a_text_with_errors_has_names() -> None:
    text = FRAME.replace("pipelines:\n", "pipelines\n")
    assert lines(text, "color_ms") == [2, 7, 15]


def outline(found: list[symbols.Symbol]) -> list[object]:
    return [
        [symbol.name, outline(list(symbol.children))] if symbol.children else symbol.name
        for symbol in found
    ]


def test_outline() -> None:
    found = symbols.symbols(view(FRAME))
    assert outline(found) == [
        ["images", ["color_ms", "color"]],
        [
            "renderPasses",
            [
                ["forward", ["source", "target", "subpass 0", "subpass 1"]],
                ["other", ["source", "subpass 0"]],
            ],
        ],
        ["framebuffers", ["fb"]],
        ["pipelines", ["opaque"]],
        ["commands", [["beginRenderPass", ["draw", "nextSubpass", "endRenderPass"]], "present"]],
    ]
    assert found[0].children[0].detail == "R8G8B8A8_UNORM 4x"


def test_outline_of_several_documents_and_of_metal() -> None:
    metal = (
        "metal:\n  textures: {t: {}}\n  renderPasses: {p: {colorAttachments: [{texture: t}]}}\n"
        "  commands: [{renderPass: p}]\n"
    )
    found = symbols.symbols(view(f"{metal}---\nimages: {{a: {{}}}}\n"))
    parts = [
        ["metal.textures", ["t"]],
        ["metal.renderPasses", [["p", ["colorAttachment 0"]]]],
        ["metal.commands", ["renderPass"]],
    ]
    assert outline(found) == [["document 1", parts], ["document 2", [["images", ["a"]]]]]


def test_nothing_is_named_in_other_texts() -> None:
    seen = View("select = []", "configuration", None, engine().registry)
    assert navigation.definition(seen, 2) == [] and symbols.symbols(seen) == []
