"""Escapes text from an input for display.

What a person reads in a terminal, a log, or a comment must be what is in the file: nothing may move
the cursor, reorder the line (Trojan Source, CVE-2021-42574), be invisible, or command the program
that reads the log.
"""

from __future__ import annotations

import re

from msaa_lint.core.visible import is_visible

MAX_LENGTH = 4096
"""Code points of a message, note, subject, or name; the rest is cut, so that one scalar cannot
inflate a report.
"""

# CI runners obey `##[command]` and `##vso[command]` anywhere in a line of their log.
_RUNNER_COMMAND = re.compile(r"#(?=#\w*\[)")
_SHORT_ESCAPES = {"\n": "\\n", "\r": "\\r", "\t": "\\t"}


def escape_each(text: str) -> list[str]:
    """The displayed form of each character of `text`: itself, or an escape such as `\\x1b` or
    `\\u202e`.
    """
    parts = list(text)
    if not text.isprintable() or not text.isascii():
        parts = [c if is_visible(c) else _escape(c) for c in text]
    for command in _RUNNER_COMMAND.finditer(text) if "##" in text else ():
        parts[command.start()] = "\\x23"
    return parts


def escape(text: str) -> str:
    """`text` on one line, with characters that cannot be seen escaped."""
    if text.isascii() and text.isprintable() and "##" not in text:
        return text
    return "".join(escape_each(text))


def escape_json(text: str) -> str:
    """JSON of ASCII, with what CI runners obey anywhere in a line as an escape of JSON."""
    return _RUNNER_COMMAND.sub(r"\\u0023", text) if "##" in text else text


def escape_commands(text: str) -> str:
    """Lines to print, of which none begins with `::`, after spaces and colors: CI runners obey
    `::command::` there.
    """
    return re.sub(r"(?m)^((?:\x1b\[[0-9;]*m|[ \t])*):(?=:)", r"\1\\x3a", text)


def escape_lines(text: str) -> str:
    """A text of several lines, such as a page: line ends and tabs stay, and everything else is
    escaped.
    """
    lines = text.replace("\r\n", "\n").split("\n")
    return escape_commands("\n".join("\t".join(map(escape, line.split("\t"))) for line in lines))


def display(text: str) -> str:
    """A message, note, or subject as text outputs show it: trimmed, at most `MAX_LENGTH` code
    points, escaped.
    """
    return escape(clip(text.strip()))


def clip(text: str, max_length: int = MAX_LENGTH) -> str:
    """`text`, or its beginning and `...` if it has more than `max_length` code points."""
    return text if len(text) <= max_length else text[: max_length - 3] + "..."


def escape_surrogates(text: str) -> str:
    """`text` with lone surrogates escaped, which UTF-8 cannot hold; everything else unchanged."""
    if text.isascii():
        return text
    return "".join(_escape(c) if "\ud800" <= c <= "\udfff" else c for c in text)


def _escape(c: str) -> str:
    point = ord(c)
    if c in _SHORT_ESCAPES:
        return _SHORT_ESCAPES[c]
    if point < 0x100:
        return f"\\x{point:02x}"
    return f"\\u{point:04x}" if point < 0x10000 else f"\\U{point:08x}"
