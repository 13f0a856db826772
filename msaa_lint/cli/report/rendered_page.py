"""Pages of Markdown in a terminal."""

from __future__ import annotations

from collections.abc import Iterator

from rich.console import Console, ConsoleOptions
from rich.markdown import Markdown
from rich.segment import Segment

from .escape import escape_lines


class _Rendered:
    """Markdown as rich renders it, escaped afterwards: a character reference such as `&#27;` is a
    character by then.
    """

    def __init__(self, markdown: str) -> None:
        # A link whose text is not its address would lead elsewhere than it says.
        self._markdown = Markdown(markdown, hyperlinks=False)

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> Iterator[Segment]:
        for segment in console.render(self._markdown, options):
            yield Segment(escape_lines(segment.text), segment.style)


def print_markdown(text: str) -> None:
    """Prints a page of Markdown, which may be a stranger's, to a terminal."""
    Console(highlight=False, markup=False, emoji=False).print(_Rendered(escape_lines(text)))
