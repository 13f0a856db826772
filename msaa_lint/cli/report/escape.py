"""Text of an input made safe to show.

What a person reads in a terminal, a log or a comment must be what is in the file: nothing that moves the cursor, reorders the line
(Trojan Source, CVE-2021-42574), hides, or gives an order to the program that reads the log.
"""

from __future__ import annotations

import re

LONGEST = 4096
"""Code points of one message, note, subject or name that are shown; the rest is cut, so that one scalar cannot swell a report."""

# Printable by Unicode's categories, and yet nothing is seen: fillers, the Braille blank, variation selectors.
_INVISIBLE = frozenset(
    "\u034f\u115f\u1160\u17b4\u17b5\u180b\u180c\u180d\u180f\u2800\u3164\uffa0"
    + "".join(map(chr, range(0xFE00, 0xFE10)))
    + "".join(map(chr, range(0xE0100, 0xE01F0)))
)
# `##[command]` and `##vso[command]` are orders to a CI runner wherever they stand in a line of its log.
_ORDER = re.compile(r"#(?=#\w*\[)")
_NAMED = {"\n": "\\n", "\r": "\\r", "\t": "\\t"}


def pieces(text: str) -> list[str]:
    """What to show for each character of `text`: itself, or an escape such as `\\x1b` or `\\u202e`."""
    shown = list(text)
    if not text.isprintable() or not text.isascii():
        shown = [c if c.isprintable() and c not in _INVISIBLE else _escape(c) for c in text]
    for order in _ORDER.finditer(text) if "##" in text else ():
        shown[order.start()] = "\\x23"
    return shown


def visible(text: str) -> str:
    """`text` on one line, with every character that is not plainly seen as an escape."""
    if text.isascii() and text.isprintable() and "##" not in text:
        return text
    return "".join(pieces(text))


def shown(text: str) -> str:
    """A message, note or subject as every text output shows it: trimmed, at most `LONGEST` code points, visible."""
    return visible(clip(text.strip()))


def clip(text: str, longest: int = LONGEST) -> str:
    """`text`, or its beginning and `...` where it is longer than `longest` code points."""
    return text if len(text) <= longest else text[: longest - 3] + "..."


def whole(text: str) -> str:
    """`text` with lone surrogates as escapes, which no UTF-8 output can hold; everything else as it is."""
    if text.isascii():
        return text
    return "".join(_escape(c) if "\ud800" <= c <= "\udfff" else c for c in text)


def _escape(c: str) -> str:
    point = ord(c)
    if c in _NAMED:
        return _NAMED[c]
    if point < 0x100:
        return f"\\x{point:02x}"
    return f"\\u{point:04x}" if point < 0x10000 else f"\\U{point:08x}"
