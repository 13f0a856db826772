"""The part of a source line that fits on a terminal, with the cell of each character.

A line can be 64 MiB long: nothing here looks beyond the window.
"""

import re
from collections.abc import Sequence
from typing import NamedTuple

from .escape import escape, escape_each

CUT = "..."
_LINE_END = re.compile(r"[\r\n]")
_TAB = "    "
# No script has more marks on one letter; more would cover the lines above and below.
_MAX_COMBINING = 4


class Window(NamedTuple):
    """A displayed text. `cells[i]` is where the source character at offset `start + i` begins; the
    last entry is where the text ends.

    `cut` means that the line continues after the window.
    """

    start: int
    text: str
    cells: Sequence[int]
    cut: bool

    @property
    def end(self) -> int:
        """The offset after the last character parts."""
        return self.start + len(self.cells) - 1

    def cell(self, offset: int) -> int:
        """The cell of the character at `offset`, or the nearest edge of the window."""
        return self.cells[max(0, min(offset - self.start, len(self.cells) - 1))]

    def shows(self, offset: int) -> bool:
        """Whether the character at `offset`, or the end of the line there, is inside."""
        return not self.cut or offset < self.end


def line_end(text: str, offset: int, max_length: int) -> int | None:
    """The end of the line that contains `offset`; None if it is more than `max_length` characters
    away.
    """
    match = _LINE_END.search(text, offset, min(len(text), offset + max_length))
    if match:
        return match.start()
    return len(text) if len(text) <= offset + max_length else None


def window(text: str, line_start: int, focus: int, width: int) -> Window:
    """The whole line from `line_start` if it fits into `width` cells (0: always), else the part
    around the character at `focus`, with `...` where it is cut.
    """
    if not width:
        end = line_end(text, line_start, len(text))
        assert end is not None
        return _lay(text, line_start, end, 0, "", "")
    # Combining marks are limited, so a cell holds at most `_MAX_COMBINING` + 1 characters.
    reach = (width + 1) * (_MAX_COMBINING + 1)
    end = line_end(text, line_start, reach)
    if end is not None:
        whole = _lay(text, line_start, end, 0, "", "")
        if whole.cells[-1] <= width:
            return whole
    room = width - len(CUT)
    start = line_start
    if (
        focus - line_start > reach
        or _lay(text, line_start, focus, 0, "", "").cells[-1] > room * 2 // 3
    ):
        start = _back(text, line_start, focus, room // 3)
    before = CUT if start > line_start else ""
    end = line_end(text, start, reach)
    rest = _lay(text, start, start + reach if end is None else end, 0, before, "")
    if end is not None and rest.cells[-1] <= width:
        return rest
    return _lay(text, start, start + reach if end is None else end, room, before, CUT)


def _back(text: str, line_start: int, focus: int, room: int) -> int:
    """The first offset from which the text before `focus` takes at most `room` cells."""
    start = max(line_start, focus - room)
    parts, widths = _measure(text[start:focus])
    total = sum(widths)
    while total > room and start < focus:
        total -= widths[start - focus + len(parts)]
        start += 1
    return start


def _lay(text: str, start: int, end: int, room: int, before: str, after: str) -> Window:
    """The characters from `start` to `end`, or as many as fit before cell `room` (0: all), between
    `before` and `after`.
    """
    raw = text[start:end]
    if raw.isascii() and raw == escape(raw):
        count = min(len(raw), room - len(before)) if room else len(raw)
        return Window(
            start,
            before + raw[:count] + after,
            range(len(before), len(before) + count + 1),
            bool(after),
        )
    parts, widths = _measure(raw)
    cells = [len(before)]
    for width in widths:
        if room and cells[-1] + width > room:
            break
        cells.append(cells[-1] + width)
    return Window(start, before + "".join(parts[: len(cells) - 1]) + after, cells, bool(after))


def _measure(text: str) -> tuple[list[str], list[int]]:
    """The displayed text of each character, and its width in cells."""
    parts = escape_each(text)
    if text.isascii():
        for i, c in enumerate(text if "\t" in text else ""):
            if c == "\t":
                parts[i] = _TAB
        return parts, [len(piece) for piece in parts]
    from unicodedata import category, east_asian_width

    widths = []
    combining = 0
    for i, c in enumerate(text):
        if c == "\t":
            parts[i] = _TAB
        width = len(parts[i])
        if width == 1 and not c.isascii():
            if category(c) in ("Mn", "Me"):
                combining += 1
                # At the start of the window, a mark would be drawn on the gutter.
                if combining > _MAX_COMBINING or i == 0:
                    parts[i] = f"\\u{ord(c):04x}" if ord(c) < 0x10000 else f"\\U{ord(c):08x}"
                    width = len(parts[i])
                else:
                    width = 0
            else:
                combining = 0
                width = 2 if east_asian_width(c) in "WF" else 1
        else:
            combining = 0
        widths.append(width)
    return parts, widths
