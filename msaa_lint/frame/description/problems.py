"""Mistakes in a description: what they are, and how messages name a place and a value."""

from typing import NamedTuple

from msaa_lint.core.quote import quoted, shortened
from msaa_lint.core.text.node import Node
from msaa_lint.core.text.span import Label, Span

MAX_PROBLEMS = 50
"""Problems that are reported for one document; more would only bury the first ones."""


class Problem(NamedTuple):
    """A mistake in the description itself; it is reported as a finding with a 9xx code."""

    code: str
    message: str
    span: Span
    path: str
    labels: tuple[Label, ...] = ()
    help: str = ""
    foreign: bool = False
    """Whether it is a command, or a key beside known ones, that resembles none: it states something
    that descriptions do not have.
    """


class Mention(NamedTuple):
    """A name that a section must have; checked once the whole description is read."""

    section: str
    name: str
    node: Node
    path: str


def head_of(node: Node) -> Span:
    """The place that stands for a value: a whole scalar, the first key of a mapping, the first
    character of a list.
    """
    if node.kind == "scalar":
        return node.span
    if node.kind == "mapping" and node.keys:
        return next(iter(node.keys.values())).span
    return Span(node.start, min(node.start + 1, node.end))


def member_of(path: str) -> str:
    """How a message names the member at a path: `width`, `usage[1]`."""
    return f"`{path.rpartition('.')[2]}`" if path else "the description"


def structure_of(path: str) -> str:
    """How a message names the structure at a path: `images.color_ms`."""
    return f"`{path}`" if path else "the description"


def found(node: Node) -> str:
    """How a message names a value: a mapping, a list, null, or the scalar as it is written."""
    if node.kind != "scalar":
        return "a mapping" if node.kind == "mapping" else "a list"
    return "null" if node.value is None else quoted(node.text)


def quote_hint(node: Node) -> str:
    """How to write a number or a boolean as a string; nothing for another value."""
    is_literal = (
        node.kind == "scalar" and not isinstance(node.value, str) and node.value is not None
    )
    return f'; write "{shortened(node.text, 20)}"' if is_literal else ""


def list_hint(node: Node) -> str:
    """How to write a value as a list of one item; nothing for null."""
    if node.kind != "scalar":
        return "; write `[{...}]`"
    return f"; write `[{shortened(node.text, 60)}]`" if node.value is not None else ""


def one_of(words: tuple[object, ...]) -> str:
    """The words as a choice: `A or B`, `one of A, B, C`."""
    return (
        " or ".join(map(str, words)) if len(words) <= 2 else f"one of {', '.join(map(str, words))}"
    )
