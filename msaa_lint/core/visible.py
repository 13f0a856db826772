"""Which characters a person sees as they are."""

from __future__ import annotations

# Printable according to Unicode's categories, but invisible: fillers, the Braille blank, variation
# selectors.
_INVISIBLE = frozenset(
    "\u034f\u115f\u1160\u17b4\u17b5\u180b\u180c\u180d\u180f\u2800\u3164\uffa0\U00016fe4\U0001d159"
    + "".join(map(chr, range(0xFE00, 0xFE10)))
    + "".join(map(chr, range(0xE0100, 0xE01F0)))
)


def is_visible(character: str) -> bool:
    """Whether a character is seen where it stands: it is no control, it reorders nothing, and it
    takes space as a space or a glyph.
    """
    return character.isprintable() and character not in _INVISIBLE
