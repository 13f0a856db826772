"""Values that are written anew, as the text around them is written."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

from msaa_lint.core.text.node import Node
from msaa_lint.frame.description.record import Record
from msaa_lint.frame.description.shapes import Shape

from .spelling import Spelling, quoted
from .text_places import Text

_JSON = re.compile(r"""[{\[][ \t\r\n]*["{\[]""")


class Rendering:
    """How a document's text writes scalars, keys and lists."""

    def __init__(self, text: Text, root: Node, spelling: Spelling) -> None:
        self._text = text.text
        self.spelling = spelling
        self.json = _JSON.match(text.text, text.content(root)) is not None

    def data(self, shape: Shape, data: Any, record: Record) -> str:
        """Plain data on one line."""
        if data is None:
            return "null"
        if isinstance(data, dict):
            shapes = shape[1].SHAPE if shape[0] == "record" else {}
            quote = '"' if self.json else ""
            inner = [f"{quoted(key, quote)}: {self.data(shapes.get(key, ('text',)), value, record)}" for key, value in data.items()]
            return "{" + ", ".join(inner) + "}"
        if isinstance(data, (list, tuple)):
            return f"[{', '.join(self.data(shape[1], each, record) for each in data)}]"
        text = self.spelling.scalar(shape, data, None, record)
        return self.quoted(text, record, not isinstance(data, str))

    def flags(self, enum: str, names: Sequence[str], record: Record) -> str:
        """A list of flags; in a tool's dump, one text."""
        if self.spelling.dumped:
            return self.quoted(" | ".join(self.spelling.name(enum, name, "", record) for name in names) or "0", record, True)
        return f"[{', '.join(self.quoted(self.spelling.name(enum, name, '', record), record) for name in names)}]"

    def quoted(self, text: str, record: Record, plain: bool = False) -> str:
        """A scalar of a record, in the quotes of its others; `plain` is one that is no text."""
        if self.json:
            return text if plain and not self.spelling.dumped else quoted(text, '"')
        values = [value for _, value in record.spelled.values() if value.kind == "scalar" and isinstance(value.value, str)]
        quote = self._text[values[0].end - 1] if values and not any(value.plain for value in values) else ""
        return quoted(text, quote if quote in ("'", '"') and not plain else "", plain)

    def item_quote(self, node: Node) -> str:
        """The quotes of a list's items."""
        if not node.value:
            return '"' if self.json else ""
        last = self._text[node.value[0].end - 1]
        return last if last in ("'", '"') and not node.value[0].plain else ""

    def key_quote(self, node: Node) -> str:
        """The quotes of a mapping's keys."""
        first = next(iter(node.keys.values()), None)
        if first is None:
            return '"' if self.json else ""
        last = self._text[first.end - 1]
        return last if not first.plain and last in ("'", '"') else ""

    def colon(self, node: Node) -> str:
        """What stands between a key and its value in a mapping."""
        for name, key in node.keys.items():
            between = self._text[key.end : node.value[name].start]
            if between.strip(" ") == ":" and not key.plain:
                return between
        return ": "
