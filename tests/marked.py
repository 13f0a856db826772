"""Texts that mark the places where something must be found: `images: {a: {⟦formt⟧: D16_UNORM}}`."""

from __future__ import annotations

import textwrap

from msaa_lint.core.text.span import Span

OPEN, CLOSE = "⟦", "⟧"


def unmarked(text: str) -> tuple[str, list[Span]]:
    """The text without its marks, and the marked places in their order."""
    text = textwrap.dedent(text).strip("\n")
    out: list[str] = []
    found: list[Span] = []
    length = 0
    for number, part in enumerate(text.split(OPEN)):
        inside, closed, after = part.partition(CLOSE)
        if number:
            assert closed, "a mark that is not closed"
            found.append(Span(length, length + len(inside)))
        else:
            inside, after = part, ""
        out += [inside, after]
        length += len(inside) + len(after)
    return "".join(out), found
