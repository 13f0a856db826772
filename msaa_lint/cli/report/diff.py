"""What fixes change in a file, as a unified diff."""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterator

from .color import paint
from .escape import visible

_LINE = re.compile(r"[^\r\n]*(?:\r\n|\r|\n)|[^\r\n]+")
_STYLES = {"+": "32", "-": "31", "@": "36"}


def unified(before: str, after: str, name: str, color: bool = False) -> Iterator[str]:
    """The lines of a diff, with line ends. Control characters are shown as escapes, but for tabs and the line's own end."""
    lines = difflib.unified_diff(_LINE.findall(before), _LINE.findall(after), f"a/{name}", f"b/{name}")
    for number, line in enumerate(lines):
        text = line.rstrip("\r\n")
        ended = line[len(text) :]
        shown = "\t".join(visible(part) for part in text.split("\t"))
        style = "1" if number < 2 else _STYLES.get(text[:1], "")
        # A carriage return before the line end stays, so that the diff can be applied.
        yield (paint(shown, style, color) if style else shown) + (ended if ended in ("\r\n", "\n") else "\n")
        if not ended:
            yield "\\ No newline at end of file\n"
