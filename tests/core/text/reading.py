"""Short words for the tests: read a text, and look at what came of it."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import pytest

from msaa_lint.core.text.source import Source
from msaa_lint.core.text.tree import Limits, Node, Parsed, Problem, parse


def reading(text: str, **limits: int) -> Parsed:
    return parse(Source("test.yaml", text), Limits(**limits))


def one(text: str) -> Node:
    """The only document of a text that has nothing wrong with it."""
    documents, problems = reading(text)
    assert problems == []
    assert len(documents) == 1
    return documents[0]


def trouble(text: str, **limits: int) -> Problem:
    """The only problem of a text."""
    problems = reading(text, **limits).problems
    assert len(problems) == 1, problems
    span = problems[0].span
    assert 0 <= span.start <= span.end <= len(text)
    return problems[0]


def plain(node: Node) -> Any:
    """A tree as Python's own values; keys are texts."""
    if node.kind == "mapping":
        assert list(node.keys) == list(node.value)
        return {key: plain(value) for key, value in node.value.items()}
    return [plain(value) for value in node.value] if node.kind == "sequence" else node.value


def nodes(node: Node) -> list[Node]:
    """A node and all below it, keys too, in the order of the text."""
    if node.kind == "mapping":
        return [
            node,
            *(n for key, value in node.value.items() for n in (node.keys[key], *nodes(value))),
        ]
    return (
        [node, *(n for value in node.value for n in nodes(value))]
        if node.kind == "sequence"
        else [node]
    )


def spelled(text: str) -> list[str]:
    """The text of every node's place, in order."""
    return [text[node.start : node.end] for node in nodes(one(text))]


@contextmanager
def without_libyaml() -> Iterator[None]:
    """What a PyYAML that was built without libyaml is like."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setitem(sys.modules, "yaml._yaml", None)
        yield
