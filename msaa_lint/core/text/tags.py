"""Tags: those of YAML's core schema are accepted if they match their value; all others are
rejected.
"""

from __future__ import annotations

import re

from msaa_lint.core.quote import quoted

from .node import Node, Problem
from .scalars import resolve
from .span import Span

_PREFIX = "tag:yaml.org,2002:"
_KINDS = {
    "str": "scalar",
    "int": "scalar",
    "float": "scalar",
    "bool": "scalar",
    "null": "scalar",
    "map": "mapping",
    "seq": "sequence",
}
_TYPES = {"int": int, "float": float, "bool": bool, "null": type(None)}
_BEFORE = re.compile(r"(?:[ \t\r\n]|(?<=[ \t\r\n])#[^\r\n]*|&[^\s,\[\]{}]+)*")
_TAG = re.compile(r"!<[^>\s]*>|![^\s,\[\]{}]*")


def apply_bare_tag(node: Node, text: str) -> None:
    """Makes an unquoted scalar with the tag `!` a string; parsers do not report that tag."""
    if _tag_place(node, text) is not None:
        node.value, node.plain = node.text, False


def apply_tag(node: Node, tag: str, text: str) -> Problem | None:
    """Gives a node the value that its tag asks for; returns the problem if it cannot have it."""
    core = tag.removeprefix(_PREFIX)
    if tag == "!":
        # It only makes a scalar a string.
        _matches(node, "str")
        return None
    span = _tag_place(node, text) or Span(node.start, node.start)
    shown = quoted(text[span.start : span.end])
    if core == tag or core not in _KINDS:
        return Problem(
            "MSAA903",
            f"the tag {shown} is not supported; put the value in quotes if `!` is part of it, or "
            "use a tag of YAML's core schema",
            span,
        )
    if node.kind != _KINDS[core] or not _matches(node, core):
        return Problem("MSAA903", f"the tag {shown} does not match its value", span)
    return None


def _matches(node: Node, core: str) -> bool:
    """Whether a node of the right kind matches its tag; a scalar then gets that value."""
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


def _tag_place(node: Node, text: str) -> Span | None:
    """The place of the tag of a node, before or after its anchor."""
    before = _BEFORE.match(text, node.start)
    match = _TAG.match(text, before.end() if before is not None else node.start)
    return Span(*match.span()) if match is not None else None
