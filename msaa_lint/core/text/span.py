"""Places in a text, and replacements of what stands there."""

from typing import NamedTuple


class Span(NamedTuple):
    """A place in a text input: half-open, in code points from the start of the decoded text."""

    start: int
    end: int


class Label(NamedTuple):
    """A secondary place of a finding in the same file, with what it has to say."""

    span: Span
    text: str


class Edit(NamedTuple):
    """Replace `text[span.start:span.end]` with `text`."""

    span: Span
    text: str
