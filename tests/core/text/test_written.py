"""Trees written as YAML: they read back as themselves, in lines that people can read."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, given
from hypothesis import strategies as st

from msaa_lint.core.text.emitter import WIDTH, emit
from msaa_lint.core.text.node import Node
from msaa_lint.core.text.node_builder import mapping, scalar, sequence
from msaa_lint.core.text.source import Source
from msaa_lint.core.text.span import Span
from msaa_lint.core.text.tree import Limits, parse
from tests.paths import ROOT
from tests.strength import examples

HERE = Span(0, 0)
TEXTS = st.one_of(
    st.text(st.characters(codec="utf-8"), max_size=12),
    st.sampled_from(
        [
            "",
            "null",
            "true",
            "No",
            "~",
            "<<",
            "4",
            "0x10",
            "1e3",
            ".nan",
            "- a",
            "? b",
            "a: b",
            "a #b",
            "2D",
            "y",
            "=",
            "\u2028",
            "\x00",
        ]
    ),
)
SCALARS = st.none() | st.booleans() | st.integers(-(10**39), 10**39) | st.floats() | TEXTS
TREES = st.recursive(
    SCALARS,
    lambda inner: st.lists(inner, max_size=5) | st.dictionaries(TEXTS, inner, max_size=5),
    max_leaves=30,
)


def node(value: Any) -> Node:
    """A tree of plain data."""
    if isinstance(value, dict):
        return mapping([(key, HERE, node(each)) for key, each in value.items()], HERE)
    if isinstance(value, list):
        return sequence([node(each) for each in value], HERE)
    return scalar(value, HERE)


def data(tree: Node) -> Any:
    """What a tree holds; floats by their bits, and every scalar with its type."""
    if tree.kind == "mapping":
        return [(key, data(each)) for key, each in tree.value.items()]
    if tree.kind == "sequence":
        return [data(each) for each in tree.value]
    return type(tree.value).__name__, repr(tree.value)


def read(text: str) -> Node:
    parsed = parse(Source("written.yaml", text), Limits())
    assert not parsed.problems, (text, parsed.problems)
    (document,) = parsed.documents
    return document


@given(TREES)
@examples(3, suppress_health_check=[HealthCheck.too_slow])
def test_reads_back_as_itself(value: Any) -> None:
    tree = node(value)
    assert data(read(emit(tree))) == data(tree)


@pytest.mark.parametrize(
    "path", sorted((ROOT / "examples").rglob("*.msaa.yaml")), ids=lambda path: path.name
)
def test_examples_read_back_in_lines_of_a_page(path: Path) -> None:
    for document in parse(Source(path.name, path.read_text(encoding="utf-8")), Limits()).documents:
        text = emit(document)
        assert data(read(text)) == data(document)
        assert max(map(len, text.splitlines())) <= WIDTH
        assert emit(read(text)) == text


def test_sections_are_blocks_and_leaves_are_lines() -> None:
    text = """\
frame: {width: 1920, height: 1080}
images:
  a: {format: R8_UNORM, usage: [SAMPLED, STORAGE]}
  b:
    format: R8_UNORM
    flags: []
commands:
  - endRenderPass
  - draw: {pipeline: p}
  - pipelineBarrier: {images: [a, b], srcStageMask: [TOP_OF_PIPE]}
"""
    wide = text.replace("    flags: []\n", f"    flags: [{', '.join(['MUTABLE_FORMAT'] * 8)}]\n")
    assert emit(read(wide)) == wide


@pytest.mark.parametrize(
    ("value", "text"),
    [
        ({"a": "2D"}, 'a: "2D"\n'),
        ({"a": "yes", "b": "R8 G8"}, 'a: "yes"\nb: R8 G8\n'),
        ({"a": "\u2028\x07\n"}, 'a: "\\u2028\\x07\\n"\n'),
        ({"<<": {}}, '"<<": {}\n'),
        ({"x y": [], "0": None}, '"x y": []\n0: null\n'),
        ([], "[]\n"),
        ([[1, 2], {"a": 1.5, "b": -0.0}], "- [1, 2]\n- {a: 1.5, b: -0.0}\n"),
        ({"k" * 1001: 4}, f"? {'k' * 1001}\n: 4\n"),
    ],
)
def test_spellings(value: Any, text: str) -> None:
    assert emit(node(value)) == text
    assert data(read(text)) == data(node(value))


def test_numbers_keep_their_spelling() -> None:
    text = "mask: [0xF, 1e3, 010, +4, .5]\n"
    assert emit(read(text)) == text


def test_aliases_are_written_out() -> None:
    assert emit(read("a: &x {b: 1}\nc: *x\n")) == "a: {b: 1}\nc: {b: 1}\n"


def test_deep_and_broad_trees_take_no_time() -> None:
    deep = node(1)
    for _ in range(2000):
        deep = sequence([deep], HERE)
    assert emit(deep).count("[") <= 3
    broad = node({str(n): {"a": [n]} for n in range(20_000)})
    assert emit(broad).count("\n") == 20_000
