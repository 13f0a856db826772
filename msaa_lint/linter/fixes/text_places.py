"""Places in a text: lines, blanks, comments, where a node begins without its anchor and tag."""

from __future__ import annotations

import re
from bisect import bisect_left
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


class Text:
    """A text, and places in it."""

    def __init__(self, source: Source, roots: Sequence[Node]) -> None:
        self.source = source
        self.text = source.text
        self._roots = roots

    @cached_property
    def _comments(self) -> list[tuple[Span, str]]:
        return [(comment.span, comment.text) for comment in comments(self.source, self._roots)]

    def comments_in(self, start: int, end: int) -> list[str]:
        """The comments that begin there."""
        at = bisect_left(self._comments, (Span(start, start), ""))
        found = []
        while at < len(self._comments) and self._comments[at][0].start < end:
            found.append(self._comments[at][1])
            at += 1
        return found

    def line_start(self, at: int) -> int:
        return max(self.text.rfind("\n", 0, at), self.text.rfind("\r", 0, at)) + 1

    def line_end(self, at: int) -> int:
        match = _BREAK.search(self.text, at)
        return match.start() if match is not None else len(self.text)

    def next_line(self, at: int) -> int:
        match = _BREAK.search(self.text, at)
        return match.end() if match is not None else len(self.text)

    def line_break(self, at: int) -> str:
        """The line end after a place; the first of the text where none is."""
        match = _BREAK.search(self.text, at) or _BREAK.search(self.text)
        return match[0] if match is not None else "\n"

    def gap_end(self, at: int) -> int:
        """Where the blanks, line ends and comments after a place end."""
        match = _GAP.match(self.text, at)
        return match.end() if match is not None else at

    def ends_line(self, at: int) -> bool:
        """Whether nothing but blanks and a comment comes after a place in its line."""
        return self.gap_end(at) >= self.line_end(at)

    def content(self, node: Node) -> int:
        """Where a node begins, without its anchor and tag."""
        match = _PROPERTIES.match(self.text, node.start, node.end)
        return match.end() if match is not None else node.start

    def colon(self, key: Node) -> int | None:
        """Where the `:` of a key ends."""
        match = _COLON.match(self.text, key.end)
        return match.end() if match is not None else None

    def indent(self, at: int) -> str:
        """The blanks that a line begins with, up to a place."""
        start = self.line_start(at)
        line = self.text[start:at]
        return line[: len(line) - len(line.lstrip(" \t"))]

    def begins_line(self, at: int) -> bool:
        """Whether nothing but blanks comes before a place in its line."""
        return not self.text[self.line_start(at) : at].strip(" \t")

    def without_lines(self, start: int, end: int, indent: str) -> Edit:
        """Takes whole lines out, from the beginning of one to the beginning of another; their comments stay."""
        left = "".join(f"{indent}{comment}{self.line_break(start)}" for comment in self.comments_in(start, end))
        ended = end < len(self.text) or self.text[end - 1 : end] in ("\r", "\n")
        if not ended:
            # The last line, without a line end: so is what is left.
            left = left.removesuffix(self.line_break(start))
            if not left and start > 0:
                start -= 2 if self.text.startswith("\r\n", start - 2) else 1
        return Edit(Span(start, end), left)
