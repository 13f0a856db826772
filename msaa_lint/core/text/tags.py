"""Tags: those of YAML's core schema are taken where they agree with what they stand at, all others are refused."""

from __future__ import annotations

import re

from .node import Node, Problem
from .scalars import resolve
from .span import Span

_PREFIX = "tag:yaml.org,2002:"
_KINDS = {"str": "scalar", "int": "scalar", "float": "scalar", "bool": "scalar", "null": "scalar", "map": "mapping", "seq": "sequence"}
_TYPES = {"int": int, "float": float, "bool": bool, "null": type(None)}
_BEFORE = re.compile(r"(?:[ \t\r\n]|(?<=[ \t\r\n])#[^\r\n]*|&[^\s,\[\]{}]+)*")
_TAG = re.compile(r"!<[^>\s]*>|![^\s,\[\]{}]*")


def bare(node: Node, text: str) -> bool:
    """Whether a scalar without quotes has the tag `!`, which makes it a text: parsers do not tell."""
    return _written(node, text) is not None


def tagged(node: Node, tag: str, text: str) -> Problem | None:
    """Gives a node the value that its tag says; the problem where it has none."""
    core = tag.removeprefix(_PREFIX)
    if tag == "!":
        # The same as none, but that a scalar is a text.
        _agrees(node, "str")
        return None
    span = _written(node, text) or Span(node.start, node.start)
    written = text[span.start : span.end]
    shown = written if len(written) <= 80 else written[:79] + "…"
    if core == tag or core not in _KINDS:
        return Problem("MSAA903", f"the tag `{shown}` is not taken here: only those of YAML's core schema are", span)
    if node.kind != _KINDS[core] or not _agrees(node, core):
        return Problem("MSAA903", f"the tag `{shown}` does not agree with what it stands at", span)
    return None


def _agrees(node: Node, core: str) -> bool:
    """Whether a node of the right kind is what its tag says; a scalar then has that value."""
    if node.kind != "scalar":
        return True
    if core == "str":
        node.value, node.plain = node.text, False
        return True
    value = resolve(node.text)
    if core == "float" and type(value) is int:
        value = float(value)
    if type(value) is not _TYPES[core]:
        return False
    node.value = value
    return True


def _written(node: Node, text: str) -> Span | None:
    """Where the tag of a node stands, before or after its anchor."""
    before = _BEFORE.match(text, node.start)
    match = _TAG.match(text, before.end() if before is not None else node.start)
    return Span(*match.span()) if match is not None else None
