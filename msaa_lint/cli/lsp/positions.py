"""Where positions of the protocol, which count in units of an encoding, are in a text."""

from __future__ import annotations

from bisect import bisect_right

from lsprotocol import types

from msaa_lint.core.text.source import Source

_UNITS = {
    types.PositionEncodingKind.Utf8: ("utf-8", 1),
    types.PositionEncodingKind.Utf16: ("utf-16-le", 2),
    types.PositionEncodingKind.Utf32: ("utf-32-le", 4),
}
"""The codec of each encoding of positions, and the bytes of its unit."""


class Positions:
    """The positions of a text. Lines end as in YAML, which is as in the protocol."""

    def __init__(self, source: Source, encoding: types.PositionEncodingKind) -> None:
        self.source = source
        self._codec, self._size = _UNITS[encoding]

    def offset(self, position: types.Position) -> int:
        """The offset of a position in code points. One beyond the end of its line, or of the text,
        is at that end.
        """
        source = self.source
        if position.line >= len(source.starts):
            return len(source.text)
        line = source.line(position.line + 1)
        column = (
            min(position.character, len(line))
            if line.isascii()
            else self._count(line, position.character)
        )
        return source.starts[position.line] + column

    def position(self, offset: int) -> types.Position:
        """The position of an offset in code points."""
        text, starts = self.source.text, self.source.starts
        offset = min(max(offset, 0), len(text))
        line = bisect_right(starts, offset) - 1
        start = starts[line]
        return types.Position(
            line, offset - start if text.isascii() else self._units(text[start:offset])
        )

    def _units(self, text: str) -> int:
        return (
            len(text)
            if text.isascii()
            else len(text.encode(self._codec, "surrogatepass")) // self._size
        )

    def _count(self, line: str, units: int) -> int:
        """The number of code points at the beginning of a line that a number of units holds."""
        return (
            bisect_right(range(len(line) + 1), units, key=lambda count: self._units(line[:count]))
            - 1
        )
