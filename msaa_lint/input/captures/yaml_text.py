"""Plain data as the YAML of a description: a structure a line where it is short, and which call every line is from."""

from __future__ import annotations

import json
import re
from typing import Any

from msaa_lint.core.text.source import Origin

WIDTH = 110
"""Longer structures are written over several lines."""

_PLAIN = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")
_NOT_PLAIN = frozenset(("true", "false", "null", "yes", "no", "on", "off"))


class Alias:
    """A value that stands under an anchor: written whole the first time, as an alias from then on."""

    __slots__ = ("name", "value")

    def __init__(self, name: str, value: Any) -> None:
        self.name = name
        self.value = value


class Lines:
    """The text as it grows. `origins` has one entry a line."""

    def __init__(self) -> None:
        self.text: list[str] = []
        self.origins: list[Origin | None] = []
        self._anchors: set[str] = set()

    def line(self, text: str, origin: Origin | None = None) -> None:
        """Adds a line."""
        self.text.append(text)
        self.origins.append(origin)

    def document(self) -> None:
        """Begins a further document."""
        self.line("---")
        self._anchors.clear()

    def member(self, indent: int, key: str, value: Any, origin: Origin | None, comment: str = "") -> None:
        """`key: value` at an indentation, in one line where it fits."""
        self._put(" " * indent + f"{scalar(key)}:", indent, value, origin, comment)

    def item(self, indent: int, value: Any, origin: Origin | None, comment: str = "") -> None:
        """`- value` at an indentation. A mapping too long for a line has its first member on the dash's line."""
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
                return
            self._anchors.add(value.name)
            head, value = f"{head} &{value.name}", value.value
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
        """Whether a value may stand in the line of its key."""
        if isinstance(value, (dict, list)) and _nested(value) > 2:
            return False
        return len(head) + 1 + len(flow(value)) <= WIDTH


def _nested(value: Any) -> int:
    """How deep structures stand in each other."""
    inner = value.values() if isinstance(value, dict) else value if isinstance(value, list) else ()
    depths = [_nested(each) for each in inner if isinstance(each, (dict, list))]
    return 1 + max(depths, default=0)


def _remark(comment: str) -> str:
    return f"  # {comment}" if comment else ""


def flow(value: Any) -> str:
    """A value in one line."""
    if isinstance(value, dict):
        return "{" + ", ".join(f"{scalar(key)}: {flow(item)}" for key, item in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(flow, value)) + "]"
    return scalar(value)


def scalar(value: Any) -> str:
    """A scalar that reads back as itself: what is not plain in double quotes."""
    if value is None:
        return "null"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(value)
    text = str(value)
    plain = _PLAIN.fullmatch(text) and text.lower() not in _NOT_PLAIN
    return text if plain else json.dumps(text)
