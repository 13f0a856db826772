"""Edits by span. The rest of the text stays as it is, byte for byte."""

from __future__ import annotations

from collections.abc import Iterable

from .span import Edit


class Overlap(ValueError):
    """Two edits replace the same text, or insert at the same place."""


def apply(text: str, edits: Iterable[Edit]) -> str:
    """The text with the edits applied; their order does not matter.

    An insertion where another edit begins or ends goes before or after that edit's text. Raises
    Overlap if two edits replace the same text, and ValueError if one is not within the text.
    """
    out: list[str] = []
    done = 0
    last: Edit | None = None
    for edit in sorted(edits):
        span = edit.span
        if not 0 <= span.start <= span.end <= len(text):
            raise ValueError(f"{span} is not within the text, which has {len(text)} characters")
        if last is not None and (span.start < done or span == last.span):
            raise Overlap(f"{last.span} and {span}")
        out += (text[done : span.start], edit.text)
        done = span.end
        last = edit
    out.append(text[done:])
    return "".join(out)
