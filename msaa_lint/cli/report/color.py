"""Terminal colors and links of the text outputs, as SGR and OSC 8 sequences."""

from __future__ import annotations

BOLD = "1"
SECONDARY = "1;34"
SEVERITY = {"error": "1;31", "warning": "1;33", "note": "1;36"}


def paint(text: str, style: str, color: bool) -> str:
    """`text` in `style`; unchanged without `color` or a style."""
    return f"\x1b[{style}m{text}\x1b[0m" if color and text and style else text


def hyperlink(text: str, address: str) -> str:
    """`text` as a link, for a terminal that shows links; unchanged without an address, which must
    be printable ASCII.
    """
    return f"\x1b]8;;{address}\x1b\\{text}\x1b]8;;\x1b\\" if address else text
