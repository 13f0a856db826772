"""Parses TOML with tomllib, and finds the locations of its keys and values, which tomllib does not
give.
"""

from __future__ import annotations

import re
from functools import lru_cache
from typing import Any, NamedTuple

from msaa_lint.core.diagnostics import diagnostic
from msaa_lint.core.finding import Finding
from msaa_lint.core.text.span import Span

MAX_DOTS = 4_000_000
"""The limit on the sum of the squared number of dots of all lines: tomllib takes quadratic time for
a dotted key.
"""
_AT = re.compile(r" \(at (?:line (\d+), column (\d+)|end of document)\)\Z")

_BLANK = re.compile(r"(?:[ \t\r\n]+|#[^\n]*)*")
_SPACE = re.compile(r"[ \t]*")
_STRING = re.compile(
    r'"""[^"\\]*(?:(?:\\.|"{1,2}(?!"))[^"\\]*)*"{3,5}'
    r"|'''.*?'''+"
    r'|"[^"\\\n]*(?:\\.[^"\\\n]*)*"'
    r"|'[^'\n]*'",
    re.DOTALL,
)
_BARE = re.compile(r"[^\s,\]}#](?:[^,\]}#\r\n]*[^\s,\]}#])?")
_KEY = re.compile(r"[A-Za-z0-9_-]+")
_STEP = re.compile(r"[ \t]*\.[ \t]*")


class Location(NamedTuple):
    """The locations of a key and its value. Both are the element for array elements, and the last
    name of the header for tables.
    """

    key: Span
    value: Span


Path = tuple[str | int, ...]


def parsed(text: str, name: str) -> dict[str, Any] | Finding:
    """The table of a TOML text, or a finding if it is invalid."""
    if sum(line.count(".") ** 2 for line in text.split("\n")) > MAX_DOTS:
        return diagnostic("MSAA921", "too many dots in one line of the configuration", name)
    import tomllib

    try:
        return tomllib.loads(text)
    except RecursionError:
        return diagnostic("MSAA921", "the configuration is nested too deeply", name)
    except ValueError as error:
        at = _AT.search(str(error))
        start = len(text)
        if at is not None and at[1]:
            lines = text.split("\n")
            start = min(
                len(text), sum(len(line) + 1 for line in lines[: int(at[1]) - 1]) + int(at[2]) - 1
            )
        from .toml_errors import mistake

        message, span = mistake(text, start, str(error))
        return diagnostic("MSAA921", f"the configuration is not valid TOML: {message}", name, span)


@lru_cache(maxsize=4)
def places(text: str) -> dict[Path, Location]:
    """The first location of each key by its path, with the index for array elements. Arrays of
    tables are treated as tables.

    The text must be one that tomllib accepts: nothing is validated here, and the search stops at
    what it does not understand.
    """
    found: dict[Path, Location] = {}
    table: Path = ()
    # The open arrays and inline tables: path, key, start, and next index (-1 for a table).
    open_: list[tuple[Path, Span, int, int]] = []
    at = 0
    while True:
        at = _skip(_BLANK, text, at)
        if at >= len(text):
            return found
        char = text[at]
        if open_:
            path, key, start, index = open_[-1]
            if char in "]}":
                found.setdefault(path, Location(key, Span(start, at + 1)))
                open_.pop()
                at += 1
                continue
            if char == ",":
                open_[-1] = (path, key, start, index + 1 if index >= 0 else -1)
                at += 1
                continue
            if index >= 0:
                at = _value(text, at, (*path, index), None, found, open_)
                if at < 0:
                    return found
                continue
        elif char == "[":
            at += 2 if text.startswith("[[", at) else 1
            names, at = _dotted(text, _skip(_SPACE, text, at))
            table = ()
            for name, span in names:
                table = (*table, name)
                found.setdefault(table, Location(span, span))
            at = text.find("]", at)
            if not names or at < 0:
                return found
            at += 2 if text.startswith("]]", at) else 1
            continue
        path = open_[-1][0] if open_ else table
        names, at = _dotted(text, at)
        at = _skip(_SPACE, text, at)
        if not names or not text.startswith("=", at):
            return found
        for name, span in names[:-1]:
            path = (*path, name)
            found.setdefault(path, Location(span, span))
        name, span = names[-1]
        at = _value(text, _skip(_SPACE, text, at + 1), (*path, name), span, found, open_)
        if at < 0:
            return found


def _value(
    text: str,
    at: int,
    path: Path,
    key: Span | None,
    found: dict[Path, Location],
    open_: list[tuple[Path, Span, int, int]],
) -> int:
    """Reads a scalar, or opens an array or an inline table. Returns the offset after it, or -1."""
    if text[at : at + 1] in ("[", "{"):
        open_.append((path, key or Span(at, at + 1), at, 0 if text[at] == "[" else -1))
        return at + 1
    match = _STRING.match(text, at) or _BARE.match(text, at)
    if match is None:
        return -1
    span = Span(match.start(), match.end())
    found.setdefault(path, Location(key or span, span))
    return match.end()


def _dotted(text: str, at: int) -> tuple[list[tuple[str, Span]], int]:
    """The names of a key with their locations, and its end."""
    names: list[tuple[str, Span]] = []
    while True:
        match = _KEY.match(text, at) or _STRING.match(text, at)
        if match is None:
            return names, at
        names.append((_unquoted(match[0]), Span(match.start(), match.end())))
        at = match.end()
        step = _STEP.match(text, at)
        if step is None:
            return names, at
        at = step.end()


def _unquoted(name: str) -> str:
    if name[0] == '"' and "\\" in name:
        import tomllib

        try:
            text: str = tomllib.loads("x = " + name)["x"]
        except ValueError:
            # An invalid name has no location.
            return name[1:-1]
        return text
    return name[1:-1] if name[0] in "\"'" else name


def _skip(what: re.Pattern[str], text: str, at: int) -> int:
    match = what.match(text, at)
    return match.end() if match is not None else at
