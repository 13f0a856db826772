"""New values in the style of the text around them: quotes, spelling and the separator after
keys.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

from msaa_lint.core.text.node import Node
from msaa_lint.core.text.scalars import resolve
from msaa_lint.core.visible import is_visible
from msaa_lint.frame.description.record import Record
from msaa_lint.frame.description.shapes import Shape

from .spelling import Spelling
from .text_scanner import TextScanner

_JSON = re.compile(r"""[{\[][ \t\r\n]*["{\[]""")
_PLAIN = re.compile(r"\.?[A-Za-z0-9_][A-Za-z0-9_.-]*")


class ValueWriter:
    """Writes scalars, lists and structures for one document."""

    def __init__(self, text: TextScanner, root: Node, spelling: Spelling) -> None:
        self._text = text
        self.spelling = spelling
        self._is_json = _JSON.match(text.text, text.content(root)) is not None
        self._default_quote = '"' if self._is_json else ""

    def value(self, shape: Shape, data: Any, record: Record) -> str:
        """Plain data on one line."""
        if data is None:
            return "null"
        if isinstance(data, dict):
            shapes = shape[1].SHAPE if shape[0] == "record" else {}
            entries = [
                f"{quote_scalar(key, self._default_quote)}: "
                f"{self.value(shapes.get(key, ('text',)), item, record)}"
                for key, item in data.items()
            ]
            return "{" + ", ".join(entries) + "}"
        if isinstance(data, (list, tuple)):
            return f"[{', '.join(self.value(shape[1], item, record) for item in data)}]"
        return self._scalar(
            self.spelling.scalar(shape, data, None, record), record, not isinstance(data, str)
        )

    def flags(self, enum: str, names: Sequence[str], record: Record) -> str:
        """A list of flags, or a single text in a tool's dump."""
        names = [self.spelling.name(enum, name, "", record) for name in names]
        if self.spelling.is_dump:
            return self._scalar(" | ".join(names) or "0", record, True)
        return f"[{', '.join(self._scalar(name, record, False) for name in names)}]"

    def _scalar(self, text: str, record: Record, is_literal: bool) -> str:
        """A scalar in the quotes of the record's other texts. A literal is a number or a
        boolean.
        """
        if self._is_json:
            return text if is_literal and not self.spelling.is_dump else quote_scalar(text, '"')
        values = [
            value
            for _, value in record.spelled.values()
            if value.kind == "scalar" and isinstance(value.value, str)
        ]
        all_quoted = bool(values) and not any(value.plain for value in values)
        return quote_scalar(
            text, self._text.quote(values[0]) if all_quoted and not is_literal else "", is_literal
        )

    def item_quote(self, sequence: Node) -> str:
        """The quote of a sequence's items."""
        return self._text.quote(sequence.value[0]) if sequence.value else self._default_quote

    def entry(self, mapping: Node, key: str, value: str) -> str:
        """An entry of a mapping: its key in the quotes of the other keys, and its value after their
        separator.
        """
        first = next(iter(mapping.keys.values()), None)
        quote = self._text.quote(first) if first is not None else self._default_quote
        return f"{quote_scalar(key, quote)}{self._separator(mapping)}{value}"

    def _separator(self, mapping: Node) -> str:
        for name, key in mapping.keys.items():
            between = self._text.text[key.end : mapping.value[name].start]
            if between.strip(" ") == ":" and not key.plain:
                return between
        return ": "


def quote_scalar(text: str, quote: str, is_literal: bool = False) -> str:
    """A scalar in quotes. With an empty `quote` it gets quotes only if it needs them; a literal,
    such as a number, never does.
    """
    if quote == "'":
        return "'" + text.replace("'", "''") + "'"
    if not quote and (
        is_literal or (_PLAIN.fullmatch(text) is not None and isinstance(resolve(text), str))
    ):
        return text
    return '"' + "".join(_escaped(character) for character in text) + '"'


def _escaped(character: str) -> str:
    if character in '"\\':
        return "\\" + character
    if is_visible(character):
        return character
    return f"\\u{ord(character):04x}" if ord(character) < 0x10000 else character
