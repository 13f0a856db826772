"""Lines and columns of findings: 1-based, in code points, the end column after the last
character.
"""

from functools import lru_cache
from typing import NamedTuple

from msaa_lint.core.finding import Result
from msaa_lint.core.text.source import Source
from msaa_lint.core.text.span import Span


class Place(NamedTuple):
    """A range of text."""

    line: int
    column: int
    end_line: int
    end_column: int


@lru_cache(maxsize=256)
def _place(source: Source, span: Span) -> Place | None:
    """The place of a span. Much of what a report says of an input is about the same places."""
    if source.origins is not None:
        origin = source.origin(span.start)
        if origin is None or origin.line is None:
            return None
        column = origin.column or 1
        return Place(origin.line, column, origin.line, column)
    start = max(0, min(span.start, len(source.text)))
    end = max(start, min(span.end, len(source.text)))
    line, column = source.position(start)
    end_line, end_column = source.position(end)
    return Place(line, column, end_line, end_column)


def place(result: Result, file: str, span: Span | None) -> Place | None:
    """The place of `span` in `file`; None for an input without text."""
    source = result.sources.get(file)
    return _place(source, span) if span is not None and source is not None else None
