"""Writes plain data as the YAML of a description, short structures on one line, and records the
call behind each line.
"""

from __future__ import annotations

import json
import re
from typing import Any

from msaa_lint.core.text.source import Origin

WIDTH = 110
"""Maximum line width; longer structures take several lines."""

MAX_NODES = 900_000
"""Maximum number of nodes of a description: other commands accept 1,000,000."""

MAX_BYTES = 48 << 20
"""Maximum size of a description: other commands accept 64 MiB."""

_PLAIN = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")
_NOT_PLAIN = frozenset(("true", "false", "null", "yes", "no", "on", "off"))


class Alias:
    """A value with an anchor: written in full the first time, then as an alias."""

    __slots__ = ("name", "value")

    def __init__(self, name: str, value: Any) -> None:
        self.name = name
        self.value = value


class Lines:
    """The lines written so far. `origins` has one entry per line."""

    def __init__(self) -> None:
        self.text: list[str] = []
        self.origins: list[Origin | None] = []
        self._size = 0
        self.nodes = 0
        """An upper bound of the number of nodes, those of aliases included."""
        self._anchors: dict[str, int] = {}
        """The anchors of the document, with the number of nodes of each."""

    def line(self, text: str, origin: Origin | None = None) -> None:
        """Adds a line."""
        self.text.append(text)
        self._size += len(text.encode("utf-8", "replace")) + 1
        self.nodes += 2 * text.count(":") + text.count(",") + text.count("{") + text.count("[") + 2
        self.origins.append(origin)

    @property
    def is_full(self) -> bool:
        """Whether more lines might make the description too large to be read."""
        return self.nodes > MAX_NODES or self._size > MAX_BYTES

    def cut(self, count: int) -> None:
        """Leaves the first lines and nothing else. The limits still count the others."""
        del self.text[count:], self.origins[count:]

    def document(self) -> None:
        """Begins another document."""
        self.line("---")
        self._anchors.clear()

    def member(
        self, indent: int, key: str, value: Any, origin: Origin | None, comment: str = ""
    ) -> None:
        """Writes `key: value`, on one line if it fits."""
        self._put(" " * indent + f"{scalar(key)}:", indent, value, origin, comment)

    def item(self, indent: int, value: Any, origin: Origin | None, comment: str = "") -> None:
        """Writes `- value`. A mapping that is too long for one line has its first member on the
        line of the dash.
        """
        head = " " * indent + "-"
        if isinstance(value, dict) and value and (len(value) == 1 or not self._fits(head, value)):
            (key, first), *rest = value.items()
            self._put(f"{head} {scalar(key)}:", indent + 2, first, origin, comment)
            for key, each in rest:
                self.member(indent + 2, key, each, origin)
        else:
            self._put(head, indent, value, origin, comment)

    def _put(self, head: str, indent: int, value: Any, origin: Origin | None, comment: str) -> None:
        if isinstance(value, Alias):
            if value.name in self._anchors:
                self.line(f"{head} *{value.name}{_remark(comment)}", origin)
                self.nodes += self._anchors[value.name]
                return
            before = self.nodes
            self._put(f"{head} &{value.name}", indent, value.value, origin, comment)
            self._anchors[value.name] = self.nodes - before
            return
        if not isinstance(value, (dict, list)) or not value or self._fits(head, value):
            self.line(f"{head} {flow(value)}{_remark(comment)}", origin)
            return
        self.line(head + _remark(comment), origin)
        if isinstance(value, dict):
            for key, each in value.items():
                self.member(indent + 2, key, each, origin)
        else:
            for each in value:
                self.item(indent + 2, each, origin)

    @staticmethod
    def _fits(head: str, value: Any) -> bool:
        """Whether a value fits on the line of its key."""
        if isinstance(value, (dict, list)) and _nested(value) > 2:
            return False
        return len(head) + 1 + len(flow(value)) <= WIDTH


def _nested(value: Any) -> int:
    """The nesting depth of a value."""
    inner = value.values() if isinstance(value, dict) else value if isinstance(value, list) else ()
    depths = [_nested(each) for each in inner if isinstance(each, (dict, list))]
    return 1 + max(depths, default=0)


def _remark(comment: str) -> str:
    return f"  # {comment}" if comment else ""


def flow(value: Any) -> str:
    """A value in flow style."""
    if isinstance(value, dict):
        return "{" + ", ".join(f"{scalar(key)}: {flow(item)}" for key, item in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(flow, value)) + "]"
    return scalar(value)


def scalar(value: Any) -> str:
    """A scalar that parses back to the same value; strings are quoted where necessary."""
    if value is None:
        return "null"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(value)
    text = str(value)
    plain = _PLAIN.fullmatch(text) and text.lower() not in _NOT_PLAIN
    return text if plain else json.dumps(text)
