"""How collections stand in a text, and edits that put entries in and take them out: brackets or lines, commas, comments, line ends.

Of what is taken out the comments stay, each on a line of its own. `Refused` where that cannot be done cleanly.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from msaa_lint.core.text.node import Node
from msaa_lint.core.text.span import Edit, Span

from .changes import Refused
from .text_places import Text

Edits = list[Edit] | Refused

_TIGHT = re.compile(r'":["{\[0-9tf]')
_OPENED = re.compile(r" *(?:- +)*")


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
