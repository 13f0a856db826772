"""Pieces of a text and places in it, as messages about its syntax show them."""

from __future__ import annotations

import re

from msaa_lint.core.quote import quoted

from .node import Problem
from .span import Label, Span

MAX_SHOWN = 40
"""Characters of the text in a message."""


def syntax(message: str, start: int, end: int | None = None, *labels: Label) -> Problem:
    """A problem of the syntax at some characters, or at one."""
    return Problem("MSAA901", message, Span(start, start + 1 if end is None else end), labels)


def line_start(text: str, at: int) -> int:
    """The offset at which the line of an offset begins."""
    start = text.rfind("\n", 0, at) + 1
    return max(start, text.rfind("\r", start, at) + 1)


def line_end(text: str, at: int) -> int:
    """The offset at which the line of an offset ends."""
    end = text.find("\n", at)
    end = len(text) if end < 0 else end
    carriage = text.find("\r", at, end)
    return end if carriage < 0 else carriage


def indent_of(text: str, at: int) -> int:
    """The number of spaces that the line of an offset begins with."""
    line = text[line_start(text, at) : line_end(text, at)]
    return len(line) - len(line.lstrip(" "))


def shown(text: str, start: int, end: int | None = None) -> str:
    """A piece of the text in backticks, on one line."""
    end = min(line_end(text, start) if end is None else end, start + 4 * MAX_SHOWN)
    return quoted(" ".join(text[start:end].split()), MAX_SHOWN)


def place(text: str, at: int) -> str:
    """How a message names an offset: `line 3, column 5`."""
    start = line_start(text, at)
    line = len(re.findall(r"\r\n|\r|\n", text[:start])) + 1
    return f"line {line}, column {at - start + 1}"


def unclosed_quote(text: str, begin: int) -> Problem:
    """A text in quotes that begins at an offset and does not end on its line."""
    return syntax(
        f"the quote {shown(text, begin)} is never closed; add the closing `{text[begin]}`", begin
    )
