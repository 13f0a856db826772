"""Lines, blanks and comments of a text, and where nodes begin without their anchors and tags."""

from __future__ import annotations

import re
from bisect import bisect_left, bisect_right
from functools import cached_property

from msaa_lint.core.text.comments import comments_within
from msaa_lint.core.text.node import Node
from msaa_lint.core.text.source import Source
from msaa_lint.core.text.span import Edit, Span

_GAP = re.compile(r"(?:[ \t\r\n]|(?<=[ \t\r\n,\[{])#[^\r\n]*)*")
_PROPERTIES = re.compile(
    r"(?:[ \t\r\n]|(?<=[ \t\r\n])#[^\r\n]*|&[^\s,\[\]{}]+|!<[^>\s]*>|![^\s,\[\]{}]*)*"
)
_COLON = re.compile(r"(?:[ \t\r\n]|(?<=[ \t\r\n])#[^\r\n]*)*:")


class TextScanner:
    """A text and one of the documents in it. All places are offsets in code points."""

    def __init__(self, source: Source, root: Node) -> None:
        self.source = source
        self.text = source.text
        self._root = root

    @cached_property
    def _comments(self) -> list[tuple[Span, str]]:
        start, end = self._root.start, self.line_end(self._root.end)
        first = self.line_start(start) if self.begins_line(start) else start
        return [
            (comment.span, comment.text) for comment in comments_within(self.source, first, end)
        ]

    def _break_after(self, at: int) -> Span | None:
        starts = self.source.starts
        index = bisect_right(starts, at)
        if index == len(starts):
            return None
        end = starts[index]
        return Span(end - (2 if self.text.startswith("\r\n", end - 2) else 1), end)

    def comments_in(self, start: int, end: int) -> list[str]:
        """The comments of the document that begin between two places."""
        first = bisect_left(self._comments, (Span(start, start), ""))
        last = bisect_left(self._comments, (Span(end, end), ""), first)
        return [text for _, text in self._comments[first:last]]

    def line_start(self, at: int) -> int:
        """Where the line of a place begins."""
        return self.source.starts[bisect_right(self.source.starts, at) - 1]

    def line_end(self, at: int) -> int:
        """Where the line of a place ends, before its line break."""
        line_break = self._break_after(at)
        return line_break.start if line_break is not None else len(self.text)

    def line_break(self, at: int) -> str:
        """The line break after a place, or the first of the text if there is none."""
        line_break = self._break_after(at) or self._break_after(0)
        return self.text[line_break.start : line_break.end] if line_break is not None else "\n"

    def gap_end(self, at: int) -> int:
        """Where the blanks, line breaks and comments after a place end."""
        match = _GAP.match(self.text, at)
        return match.end() if match is not None else at

    def ends_line(self, at: int) -> bool:
        """Whether only blanks and a comment follow a place in its line."""
        return self.gap_end(at) >= self.line_end(at)

    def begins_line(self, at: int) -> bool:
        """Whether only blanks precede a place in its line."""
        return not self.text[self.line_start(at) : at].strip(" \t")

    def indent(self, at: int) -> str:
        """The blanks at the beginning of a line, up to a place in it."""
        line = self.text[self.line_start(at) : at]
        return line[: len(line) - len(line.lstrip(" \t"))]

    def content(self, node: Node) -> int:
        """Where a node begins, without its anchor and tag."""
        match = _PROPERTIES.match(self.text, node.start, node.end)
        return match.end() if match is not None else node.start

    def quote(self, node: Node) -> str:
        """The quote that a scalar is written in; empty for a plain scalar and for other nodes."""
        before = self.text[self.content(node) : node.end][:1]
        return before if before in ("'", '"') else ""

    def colon_end(self, key: Node) -> int | None:
        """Where the `:` after a key ends."""
        match = _COLON.match(self.text, key.end)
        return match.end() if match is not None else None

    def without_lines(self, first: int, last: int, indent: str | None = None) -> Edit:
        """Removes the lines from that of one place to that of another. Their comments stay, with an
        indent, by default the first line's.
        """
        start = self.line_start(first)
        line_break = self._break_after(last)
        end = line_break.end if line_break is not None else len(self.text)
        indent = self.indent(first) if indent is None else indent
        lines = "".join(
            f"{indent}{comment}{self.line_break(start)}" for comment in self.comments_in(start, end)
        )
        if line_break is None:
            # The text ends without a line break, and so does what remains.
            lines = lines.removesuffix(self.line_break(start))
            if not lines and start > 0:
                start -= 2 if self.text.startswith("\r\n", start - 2) else 1
        return Edit(Span(start, end), lines)
