"""Places in a text, and replacements of the text there."""

from typing import NamedTuple


class Span(NamedTuple):
    """A place in a text: a half-open range in code points from the start of the decoded text."""

    start: int
    end: int


class Label(NamedTuple):
    """A secondary place of a finding, and a note about it. `file` is None if the place is in the
    file of the finding.
    """

    span: Span
    text: str
    file: str | None = None


class Edit(NamedTuple):
    """Replace `text[span.start:span.end]` with `text`."""

    span: Span
    text: str
