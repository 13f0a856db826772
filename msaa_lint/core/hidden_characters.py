"""Characters that make a text look other than it is: those that reorder a line (Trojan Source,
CVE-2021-42574), and invisible ones.
"""

from __future__ import annotations

import re
from itertools import groupby
from typing import TYPE_CHECKING

from .diagnostics import HIDDEN_CHARACTER, diagnostic
from .finding import Finding
from .text.span import Label, Span

if TYPE_CHECKING:
    from .text.source import Source

MAX_FINDINGS = 100
MAX_LABELS = 20
"""Of each finding."""

_REORDERING = "\u061c\u200e\u200f\u202a-\u202e\u2066-\u2069"
# Of Persian, Indic scripts, and emoji, and of punctuation in Arabic and Hebrew: next to a letter of
# those, each has its use.
_JOINING = "\u061c\u200c-\u200f"
_ALWAYS = "\u00ad\u115f\u1160\u180e\u200b\u202a-\u202e\u2060-\u206f\u3164\ufeff\uffa0\ufff9-\ufffb\U000e0000-\U000e007f"  # noqa: E501
_LETTER = f"[^\x00-\x7f{_JOINING}{_ALWAYS}]"
_HIDDEN = re.compile(
    # The flag of a part of a country is written with invisible tags.
    f"\U0001f3f4[\U000e0020-\U000e007e]+\U000e007f|([{_ALWAYS}]|(?<!{_LETTER})(?<!{_LETTER}[!-/:-?])[{_JOINING}](?!{_LETTER}))"
)
_REORDERS = re.compile(f"[{_REORDERING}]")


def hidden_characters(source: Source) -> list[Finding]:
    """A note for each line of a text with such a character (MSAA914), at most MAX_FINDINGS. Letters
    that are written from right to left are none.
    """
    if source.text.isascii():
        return []
    places = (match.start() for match in _HIDDEN.finditer(source.text) if match[1])
    findings: list[Finding] = []
    for _, group in groupby(places, lambda place: source.position(place).line):
        first, *others = group
        findings.append(_finding(source, first, others))
        if len(findings) == MAX_FINDINGS:
            findings[-1] = findings[-1]._replace(
                notes=("more findings of this kind are not shown",)
            )
            break
    return findings


def _finding(source: Source, first: int, others: list[int]) -> Finding:
    reorders = next(
        (place for place in (first, *others) if _REORDERS.match(source.text, place)), None
    )
    place = first if reorders is None else reorders
    effect = (
        "which cannot be seen"
        if reorders is None
        else "so that the line is displayed in another order than it is read"
    )
    more = (
        f" and {len(others)} more hidden character{'s' if len(others) > 1 else ''}"
        if others
        else ""
    )
    message = (
        f"the line contains {_name(source.text[place])}{more}, {effect}; remove "
        f"{'them' if others else 'it'}"
    )
    labels = tuple(
        Label(Span(at, at + 1), _name(source.text[at]))
        for at in [first, *others][: MAX_LABELS + 1]
        if at != place
    )
    return diagnostic(HIDDEN_CHARACTER, message, source.name, Span(place, place + 1), labels=labels)


def _name(character: str) -> str:
    from unicodedata import name

    return f"U+{ord(character):04X} {name(character, '')}".rstrip()
