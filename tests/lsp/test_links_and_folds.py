"""Links, folds, and selections."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

import pytest

from msaa_lint.cli.lsp.folding import Fold, folds, selection
from msaa_lint.cli.lsp.links import links
from msaa_lint.cli.lsp.view import View
from msaa_lint.core.text.span import Span

from .views import at, descriptions, engine

DOCS = "https://example.com/docs"


def view(text: str, kind: str = "description", folder: Path | None = None) -> View:
    return View(
        text,
        kind,
        None,
        engine().registry,
        docs_url=DOCS,
        folder=str(folder) if folder is not None else None,
    )


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    inside = tmp_path / "project"
    (inside / ".git").mkdir(parents=True)
    for name in ("a.spv", "gpu.json", "base.toml", "r.md", "../outside.spv"):
        (inside / name).write_text("")
    return inside


def linked(text: str, kind: str, folder: Path) -> dict[str, str]:
    return {
        text[link.span.start : link.span.end]: link.target
        for link in links(view(text, kind, folder))
    }


@pytest.mark.parametrize(
    ("text", "kind", "expected"),
    [
        (
            "pipelines: {p: {stages: [{module: a.spv}, {module: 'a.spv'}, {module: b.spv}]}}",
            "description",
            {"a.spv": "a.spv"},
        ),
        ("pipelines: {p: {stages: [{module: ../outside.spv}]}}", "description", {}),
        ("device: ./gpu.json#one", "description", {"./gpu.json#one": "gpu.json"}),
        ("device: mali-g76", "description", {}),
        (
            "extends = 'base.toml'\nrules = ['r.md', 'none.md']",
            "configuration",
            {"base.toml": "base.toml", "r.md": "r.md"},
        ),
        ("[tool.msaa-lint]\nprofile = 'gpu.json'", "configuration", {"gpu.json": "gpu.json"}),
    ],
)
def test_paths_lead_to_files_of_the_project(
    folder: Path, text: str, kind: str, expected: dict[str, str]
) -> None:
    assert linked(text, kind, folder) == {
        name: (folder / file).as_uri() for name, file in expected.items()
    }


def test_rules_lead_to_their_pages(folder: Path) -> None:
    page = f"{DOCS}/rules/multisampled-attachment-stored/"
    comment = "a: 1 # msaa-lint: ignore[MSAA201, multisampled-attachment-stored, none, MSAA911] why"
    assert linked(comment, "description", folder) == {
        "MSAA201": page,
        "multisampled-attachment-stored": page,
    }
    assert linked("int a; // msaa-lint: ignore[MSAA201]", "code", folder) == {"MSAA201": page}
    configuration = (
        "select = ['MSAA201', 'MSAA2']\n[severity]\nmultisampled-attachment-stored = 'off'"
    )
    assert linked(configuration, "configuration", folder) == {
        "MSAA201": page,
        "multisampled-attachment-stored": page,
    }
    without = View(comment, "description", None, engine().registry)
    assert links(without) == []


TEXT = """\
# A frame
# of two images.
images:
  a: {format: D16_UNORM}
  b:
    format: D16_UNORM
    samples: 4

commands:
  - beginRenderPass: {renderPass: p}
  - endRenderPass
  - present: {image: a}
"""


def test_folds_of_a_description() -> None:
    assert folds(view(TEXT)) == [Fold(0, 1, True), Fold(2, 6), Fold(4, 6), Fold(8, 11), Fold(9, 10)]


def test_folds_of_other_texts() -> None:
    assert folds(view("a = 1\n[severity]\nx = 2\n\n[limits]\ndepth = 3\n", "configuration")) == [
        Fold(1, 2),
        Fold(4, 5),
    ]
    assert folds(view("---\ncode: A\nwhen: b\n---\ntext\n", "rule")) == [Fold(0, 3)]
    assert folds(view("// a\n// b\n", "code")) == []


@pytest.mark.parametrize("path", descriptions()[::10], ids=lambda path: path.stem)
def test_folds_of_examples_nest(path: Path) -> None:
    found = folds(view(path.read_text(encoding="utf-8")))
    for one in found:
        for other in found:
            assert (
                one.last < other.first
                or other.last < one.first
                or one.first <= other.first <= other.last <= one.last
                or (other.first <= one.first <= one.last <= other.last)
            )


def test_selection_grows_outward() -> None:
    text, offset = at("images:\n  b: {format: D16_^UNORM, samples: 4}\n")
    found = selection(view(text), offset)
    texts = [text[span.start : span.end].strip() for span in found]
    assert texts[:3] == ["D16_UNORM", "format: D16_UNORM", "{format: D16_UNORM, samples: 4}"]
    assert all(outer.start <= one.start and one.end <= outer.end for one, outer in pairwise(found))
    text, offset = at("images:\n  b: {for^mat: D16_UNORM}\n")
    assert selection(view(text), offset)[0] == Span(text.index("format"), text.index(": D16"))
    assert selection(view("a = 1", "configuration"), 2) == []
