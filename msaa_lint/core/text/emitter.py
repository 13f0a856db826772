"""A tree as YAML that reads back as the same tree. Short structures take one line, others
several.
"""

from __future__ import annotations

import re

from msaa_lint.core.visible import is_visible

from .node import Node
from .scalars import WORDS, resolve

WIDTH = 140
"""Columns of a line; only a long scalar exceeds them."""

MAX_KEY = 1000
"""Characters of a key on the line of its value; YAML 1.2 (section 7.4.2) limits them to 1024."""

_PLAIN = re.compile(r"[A-Za-z_][A-Za-z0-9_./-]*(?: [A-Za-z0-9_./-]+)*")
_PLAIN_KEY = re.compile(r"[A-Za-z0-9_][A-Za-z0-9_.-]*")
_WORDS = frozenset(word.lower() for word in (*WORDS, "yes", "no", "on", "off"))
_ESCAPES = {'"': '\\"', "\\": "\\\\", "\n": "\\n", "\r": "\\r", "\t": "\\t", "\0": "\\0"}


def emit(root: Node) -> str:
    """The text of a document, with a line end; aliases are expanded.

    A mapping that contains mappings, or is deep or long, takes one line per member.
    """
    lines: list[str] = []
    # A stack: the line up to a value, the indentation of the lines below it, and the value.
    pending: list[tuple[str, int, Node]] = [("", 0, root)]
    sizes = _sizes(root)
    while pending:
        head, indent, node = pending.pop()
        members = node.value
        if node.kind == "scalar" or not members or _in_line(head, node, sizes, top=not head):
            lines.append(f"{head} {_flow(node)}" if head else _flow(node))
            continue
        # A structure may begin on the line of a dash, but not on the line of a key.
        if head.endswith("-"):
            head += " "
        elif head:
            lines.append(head)
            head = ""
        pad = " " * indent
        below: list[tuple[str, int, Node]] = []
        if node.kind == "mapping":
            for key, value in members.items():
                begin = head if not below and head else pad
                text = _key(key)
                if len(text) <= MAX_KEY:
                    below.append((f"{begin}{text}:", indent + 2, value))
                else:
                    below.append((f"{begin}? {text}\n{pad}:", indent + 2, value))
        else:
            for value in members:
                below.append((f"{head if not below and head else pad}-", indent + 2, value))
        pending.extend(reversed(below))
    return "\n".join(lines) + "\n"


def _sizes(root: Node) -> dict[int, tuple[int, int, bool]]:
    """For each structure by identity: its length on one line (cut off above WIDTH), how deep
    structures nest in it, and whether it contains a mapping.
    """
    order: list[Node] = []
    pending = [root]
    while pending:
        node = pending.pop()
        if node.kind != "scalar":
            order.append(node)
            pending.extend(node.value.values() if node.kind == "mapping" else node.value)
    sizes: dict[int, tuple[int, int, bool]] = {}
    for node in reversed(order):
        length, depth, nested = 2, 1, False
        inner = (
            node.value.items() if node.kind == "mapping" else ((None, item) for item in node.value)
        )
        for key, value in inner:
            length += 2 + (len(key) + 2 if key is not None else 0)
            if value.kind == "scalar":
                length += len(value.text)
            else:
                inner_length, inner_depth, _ = sizes[id(value)]
                length += inner_length
                depth = max(depth, inner_depth + 1)
                nested = nested or value.kind == "mapping"
            if length > WIDTH:
                length = WIDTH + 1
        sizes[id(node)] = (length, depth, nested)
    return sizes


def _in_line(head: str, node: Node, sizes: dict[int, tuple[int, int, bool]], top: bool) -> bool:
    """Whether a structure may continue the line before it. Sections (which contain mappings), list
    items with one member and lists of several mappings may not.
    """
    length, depth, nested = sizes[id(node)]
    section = node.kind == "mapping" and nested and not head.startswith(" ")
    section = section or (node.kind == "mapping" and len(node.value) == 1 and head.endswith("-"))
    section = section or (
        node.kind == "sequence" and sum(item.kind == "mapping" for item in node.value) > 1
    )
    # The length counts neither quotes nor escapes.
    return (
        not (top or section or depth > 2 or length > WIDTH)
        and len(head) + 1 + len(_flow(node)) <= WIDTH
    )


def _flow(node: Node) -> str:
    """A value on one line."""
    if node.kind == "mapping":
        return (
            "{"
            + ", ".join(f"{_key(key)}: {_flow(value)}" for key, value in node.value.items())
            + "}"
        )
    if node.kind == "sequence":
        return "[" + ", ".join(map(_flow, node.value)) + "]"
    return _scalar(node)


def _scalar(node: Node) -> str:
    """The text that reads back as the value of a scalar."""
    value = node.value
    if isinstance(value, str):
        return (
            value
            if _PLAIN.fullmatch(value) and value.lower() not in _WORDS and resolve(value) == value
            else _quoted(value)
        )
    if value is None:
        return "null"
    if isinstance(value, bool):
        return "true" if value else "false"
    if (
        node.text
        and type(resolve(node.text)) is type(value)
        and repr(resolve(node.text)) == repr(value)
        and node.text.isprintable()
    ):
        return node.text
    if isinstance(value, float) and (value != value or value in (float("inf"), float("-inf"))):
        return ".nan" if value != value else ".inf" if value > 0 else "-.inf"
    return repr(value)


def _key(text: str) -> str:
    return text if _PLAIN_KEY.fullmatch(text) and text.lower() not in _WORDS else _quoted(text)


def _quoted(text: str) -> str:
    """The text in double quotes, with the characters escaped that YAML forbids in a stream or that
    cannot be seen.
    """
    return '"' + "".join(_escaped(character) for character in text) + '"'


def _escaped(character: str) -> str:
    if character in _ESCAPES:
        return _ESCAPES[character]
    if is_visible(character):
        return character
    code = ord(character)
    return (
        f"\\x{code:02X}"
        if code < 0x100
        else f"\\u{code:04X}"
        if code < 0x10000
        else f"\\U{code:08X}"
    )
