"""How collections stand in a text, and edits that put entries in and take them out: brackets or lines, commas, comments, line ends.

Of what is taken out the comments stay, each on a line of its own. `Refused` where that cannot be done cleanly.
"""

from __future__ import annotations

import re
from bisect import bisect_left
from collections.abc import Sequence
from functools import cached_property

from ..finding import Edit, Span
from ..source.comments import comments
from ..source.node import Node
from ..source.text import Source
from .changes import Refused

Edits = list[Edit] | Refused

_GAP = re.compile(r"(?:[ \t\r\n]|(?<=[ \t\r\n,\[{])#[^\r\n]*)*")
_PROPERTIES = re.compile(r"(?:[ \t\r\n]|(?<=[ \t\r\n])#[^\r\n]*|&[^\s,\[\]{}]+|!<[^>\s]*>|![^\s,\[\]{}]*)*")
_COLON = re.compile(r"(?:[ \t\r\n]|(?<=[ \t\r\n])#[^\r\n]*)*:")
_BREAK = re.compile(r"\r\n|\r|\n")
_TIGHT = re.compile(r'":["{\[0-9tf]')
_OPENED = re.compile(r" *(?:- +)*")


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


class Collection:
    """The entries of a mapping (a key and its value each) or the items of a sequence, that stand in the collection's own text."""

    def __init__(self, text: Text, node: Node) -> None:
        self.text = text
        self.node = node
        self.start = text.content(node)
        self.flow = text.text[self.start : self.start + 1] in ("{", "[")
        self.items: list[Span] = []
        if node.kind == "mapping":
            own = [(node.keys[name], value) for name, value in node.value.items() if node.start <= node.keys[name].start < node.end]
            self.items = sorted(Span(key.start, max(key.end, value.end)) for key, value in own)
        else:
            self.items = [item.span for item in node.value]

    def index(self, start: int) -> int | None:
        """Which item begins at a place."""
        return next((n for n, item in enumerate(self.items) if item.start == start), None)

    @property
    def explicit(self) -> bool:
        """Whether a key is written with a `?`."""
        return self.node.kind == "mapping" and any(self.text.text[max(0, item.start - 2) : item.start] == "? " for item in self.items)

    def insert(self, new: Sequence[str], after: int | None = None) -> Edits:
        """Puts entries after another, by default the last."""
        if self.explicit:
            return Refused("a key here is written with `?`")
        if after is None and self.items:
            after = len(self.items) - 1
        return self._flow_insert(new, after) if self.flow else self._block_insert(new, after)

    def _flow_insert(self, new: Sequence[str], after: int | None) -> Edits:
        text = self.text
        if after is None:
            inner = self.start + 1
            # A merge key is none of the entries.
            return [_put(inner, ", ".join(new) if text.gap_end(inner) >= self.node.end - 1 else "".join(f"{each}, " for each in new))]
        start, end = self.items[after]
        following = text.gap_end(end)
        comma = text.text[following] == ","
        beside = [_put(end, "".join(f"{self._separator()}{each}" for each in new))]
        if not (text.begins_line(start) and text.line_start(start) > self.start):
            return beside
        lines = [f"{text.line_break(start)}{text.indent(start)}{each}" for each in new]
        if comma:
            at = following + 1
            return [_put(text.line_end(at), "".join(f"{line}," for line in lines))] if text.ends_line(at) else beside
        at = text.line_end(end)
        if following < at:
            return beside
        return [_put(end, "".join(f",{line}" for line in lines))] if at == end else [_put(end, ","), _put(at, ",".join(lines))]

    def _separator(self) -> str:
        """What stands between two entries of a line."""
        for one, other in zip(self.items, self.items[1:], strict=False):
            between = self.text.text[one.end : other.start]
            if between.strip(" \t") == "," and "\n" not in between:
                return between
        return "," if self._tight() else ", "

    def _tight(self) -> bool:
        """Whether a JSON text has no blanks at all."""
        return self.node.kind == "mapping" and _TIGHT.search(self.text.text, self.start, self.node.end) is not None

    def _block_insert(self, new: Sequence[str], after: int | None) -> Edits:
        text = self.text
        column = self.column()
        if column is None:
            return Refused("its lines are indented in a way that is not understood")
        if after is None:
            return [_put(self.start, "".join(f"{each}{text.line_break(self.start)}{' ' * column}" for each in new))]
        end = self.items[after].end
        if not text.ends_line(end) or text.text[text.content(self._value(after))] in "|>":
            return Refused("there is no line to put it on")
        dash = "- " if self.node.kind == "sequence" else ""
        return [_put(text.line_end(end), "".join(f"{text.line_break(end)}{' ' * column}{dash}{each}" for each in new))]

    def _value(self, n: int) -> Node:
        if self.node.kind == "sequence":
            items: list[Node] = self.node.value
            return items[n]
        entries: dict[str, Node] = self.node.value
        return next(value for name, value in entries.items() if self.node.keys[name].start == self.items[n].start)

    def column(self) -> int | None:
        """The column of the keys or dashes of a block collection."""
        at = self.items[0].start if self.items and self.node.kind == "mapping" else self.start
        start = self.text.line_start(at)
        opened = _OPENED.match(self.text.text, start)
        return at - start if opened is not None and opened.end() >= at else None

    def remove(self, numbers: Sequence[int]) -> Edits:
        """Takes entries out; not all of them."""
        if self.explicit:
            return Refused("a key here is written with `?`")
        if len(numbers) == len(self.items):
            return Refused("nothing would be left of it")
        if self.flow and len(numbers) > 1:
            return self._keep([n for n in range(len(self.items)) if n not in numbers])
        edits: list[Edit] = []
        for n in numbers:
            own = self._flow_remove(n) if self.flow else self._block_remove(n)
            if isinstance(own, Refused):
                return own
            edits += own
        return edits

    def _keep(self, numbers: Sequence[int]) -> Edits:
        """Writes the items that stay, with what stands before each of them."""
        items = self.items
        cut = Span(items[0].start, items[-1].end)
        if self.node.kind == "mapping" or self.text.comments_in(*cut):
            return Refused("comments or merge keys may stand in between")
        text = self.text.text
        kept = [text[items[n - 1].end : items[n].end] if place else text[slice(*items[n])] for place, n in enumerate(numbers)]
        return [Edit(cut, "".join(kept))]

    def _flow_remove(self, n: int) -> Edits:
        text, items = self.text, self.items
        start, end = items[n]
        following = text.gap_end(end)
        comma = text.text[following] == ","
        last = n == len(items) - 1
        before = text.gap_end(items[n - 1].end) if n else -1
        # Between entries there is nothing that is none: merge keys are no entries.
        if (n and text.gap_end(before + 1) != start) or (not last and text.gap_end(following + 1) != items[n + 1].start):
            return Refused("a merge key stands beside it")
        behind = following + 1 if comma else end
        if text.begins_line(start) and text.line_start(start) > self.start and text.ends_line(behind):
            edits = [text.without_lines(text.line_start(start), text.next_line(behind), text.indent(start))]
            return edits if comma or not n else [Edit(Span(before, before + 1), ""), *edits]
        if last and n:
            cut = Span(before, following if comma else end)
        elif not last:
            cut = Span(start, items[n + 1].start)
        else:
            cut = Span(start, behind)
        return Refused("a comment stands in between") if text.comments_in(*cut) else [Edit(cut, "")]

    def _block_remove(self, n: int) -> Edits:
        text, column = self.text, self.column()
        start, end = self.items[n]
        if self.node.kind == "sequence":
            start = self._dash(n)
        if column is None or start < 0 or not text.begins_line(start) or not text.ends_line(end) or len(self.items) == 1:
            return Refused("it does not stand on lines of its own")
        return [text.without_lines(text.line_start(start), text.next_line(end), " " * column)]

    def _dash(self, n: int) -> int:
        """Where the `-` of an item stands; -1 where it is not found."""
        column = self.column()
        if n == 0 or column is None:
            return self.start
        at = self.text.line_start(self.items[n].start)
        while at > self.items[n - 1].end - 1:
            if self.text.text[at : at + column + 1] == " " * column + "-":
                return at + column
            at = self.text.line_start(at - 1)
        return -1

    def empty(self, colon: int) -> Edits:
        """Takes the only item of a sequence out, and leaves `[]`, after the `:` at `colon`."""
        if self.flow:
            return self._flow_remove(0)
        start = self.start
        if not self.text.begins_line(start) or not self.text.ends_line(self.items[0].end):
            return Refused("it does not stand on lines of its own")
        lines = self.text.without_lines(self.text.line_start(start), self.text.next_line(self.items[0].end), self.text.indent(start))
        return [_put(colon, " []"), lines]


def _put(at: int, text: str) -> Edit:
    return Edit(Span(at, at), text)
