"""Lines, blanks and comments of a text, and where nodes begin without their anchors and tags."""

from __future__ import annotations

import re
from bisect import bisect_left, bisect_right
from collections.abc import Sequence
from functools import cached_property

from msaa_lint.core.text.comments import comments
from msaa_lint.core.text.node import Node
from msaa_lint.core.text.source import Source
from msaa_lint.core.text.span import Edit, Span

_GAP = re.compile(r"(?:[ \t\r\n]|(?<=[ \t\r\n,\[{])#[^\r\n]*)*")
_PROPERTIES = re.compile(r"(?:[ \t\r\n]|(?<=[ \t\r\n])#[^\r\n]*|&[^\s,\[\]{}]+|!<[^>\s]*>|![^\s,\[\]{}]*)*")
_COLON = re.compile(r"(?:[ \t\r\n]|(?<=[ \t\r\n])#[^\r\n]*)*:")
_BREAK = re.compile(r"\r\n|\r|\n")


class TextScanner:
    """A text with the documents in it. All places are offsets in code points."""

    def __init__(self, source: Source, roots: Sequence[Node]) -> None:
        self.source = source
        self.text = source.text
        self._roots = roots

    @cached_property
    def _comments(self) -> list[tuple[Span, str]]:
        return [(comment.span, comment.text) for comment in comments(self.source, self._roots)]

    @cached_property
    def _breaks(self) -> list[re.Match[str]]:
        return list(_BREAK.finditer(self.text))

    @cached_property
    def _line_starts(self) -> list[int]:
        return [0, *(match.end() for match in self._breaks)]

    @cached_property
    def _line_ends(self) -> list[int]:
        return [*(match.start() for match in self._breaks), len(self.text)]

    def _break_after(self, at: int) -> re.Match[str] | None:
        index = bisect_left(self._line_ends, at)
        return self._breaks[index] if index < len(self._breaks) else None

    def comments_in(self, start: int, end: int) -> list[str]:
        """The comments that begin between two places."""
        first = bisect_left(self._comments, (Span(start, start), ""))
        last = bisect_left(self._comments, (Span(end, end), ""), first)
        return [text for _, text in self._comments[first:last]]

    def line_start(self, at: int) -> int:
        """Where the line of a place begins."""
        return self._line_starts[bisect_right(self._line_starts, at) - 1]

    def line_end(self, at: int) -> int:
        """Where the line of a place ends, before its line break."""
        match = self._break_after(at)
        return match.start() if match is not None else len(self.text)

    def line_break(self, at: int) -> str:
        """The line break after a place, or the first of the text if there is none."""
        match = self._break_after(at) or (self._breaks[0] if self._breaks else None)
        return match[0] if match is not None else "\n"

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
        """Removes the lines from that of one place to that of another. Their comments stay, with an indent, by default the first line's."""
        start = self.line_start(first)
        match = self._break_after(last)
        end = match.end() if match is not None else len(self.text)
        indent = self.indent(first) if indent is None else indent
        lines = "".join(f"{indent}{comment}{self.line_break(start)}" for comment in self.comments_in(start, end))
        if match is None:
            # The text ends without a line break, and so does what remains.
            lines = lines.removesuffix(self.line_break(start))
            if not lines and start > 0:
                start -= 2 if self.text.startswith("\r\n", start - 2) else 1
        return Edit(Span(start, end), lines)
