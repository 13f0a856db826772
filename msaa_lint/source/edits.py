"""Edits by span: what is not edited stays as it is, byte for byte."""

from __future__ import annotations

from collections.abc import Iterable

from ..finding import Edit


class Overlap(ValueError):
    """Two edits claim the same text."""


def apply(text: str, edits: Iterable[Edit]) -> str:
    """The text with the edits made, in whatever order they come. Overlap where two claim the same; ValueError outside of the text."""
    out: list[str] = []
    done = 0
    before: Edit | None = None
    for edit in sorted(edits):
        if not 0 <= edit.span.start <= edit.span.end <= len(text):
            raise ValueError(f"{edit.span} is not within the text")
        if before is not None and (edit.span.start < done or edit.span == before.span):
            raise Overlap(f"{before.span} and {edit.span}")
        out += (text[done : edit.span.start], edit.text)
        done = edit.span.end
        before = edit
    out.append(text[done:])
    return "".join(out)
