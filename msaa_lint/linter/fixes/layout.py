"""Edits that insert entries into the collections of a text and remove entries from them.

Block or flow style, commas, comments, indentation and line breaks stay as they are. The comments of
a removed entry stay as well, each on a line of its own. Raises NoFix for edits that cannot be made
cleanly.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import cached_property
from itertools import pairwise

from msaa_lint.core.text.edits import apply
from msaa_lint.core.text.node import Node
from msaa_lint.core.text.span import Edit, Span

from .changes import NoFix
from .text_scanner import TextScanner

_COMPACT_JSON = re.compile(r'":["{\[0-9tf]')
_LINE_OPENING = re.compile(r" *(?:- +)*")
_NOT_ON_OWN_LINES = "the entry shares its lines with other text"


class CollectionEditor:
    """A mapping or a sequence. `items` are the places of its entries, for a mapping of each key
    with its value, without merged entries.
    """

    def __init__(self, text: TextScanner, node: Node) -> None:
        self.text = text
        self.node = node
        self.start = text.content(node)
        self.flow = text.text[self.start : self.start + 1] in ("{", "[")
        if node.kind == "mapping":
            entries = sorted(
                (key.start, name)
                for name, key in node.keys.items()
                if node.start <= key.start < node.end
            )
            self._values: list[Node] = [node.value[name] for _, name in entries]
            self.items = [
                Span(start, max(node.keys[name].end, node.value[name].end))
                for start, name in entries
            ]
        else:
            self._values = node.value
            self.items = [item.span for item in node.value]

    def index(self, start: int) -> int | None:
        """The index of the entry that begins at a place."""
        return self._indices.get(start)

    @cached_property
    def _indices(self) -> dict[int, int]:
        return {item.start: n for n, item in reversed(list(enumerate(self.items)))}

    def insert(self, entries: Sequence[str], after: int | None = None) -> list[Edit]:
        """Inserts entries after the one at an index, by default after the last."""
        self._check_keys()
        if after is None and self.items:
            after = len(self.items) - 1
        return (
            self._insert_in_flow(entries, after)
            if self.flow
            else self._insert_in_block(entries, after)
        )

    def remove(self, indices: Sequence[int], replacements: Sequence[Edit] = ()) -> list[Edit]:
        """Removes some of the entries, and makes the replacements in others."""
        self._check_keys()
        if len(indices) == len(self.items):
            raise NoFix("no entry would remain")
        if self.flow and len(indices) > 1:
            removed = frozenset(indices)
            return self._keep([n for n in range(len(self.items)) if n not in removed], replacements)
        return [
            *replacements,
            *(
                edit
                for n in indices
                for edit in (self._remove_from_flow(n) if self.flow else self._remove_from_block(n))
            ),
        ]

    def remove_only_item(self, colon: int) -> list[Edit]:
        """Removes the only item of a sequence that is the value of a key whose `:` ends at `colon`.
        `[]` remains.
        """
        if self.flow:
            return self._remove_from_flow(0)
        end = self.items[0].end
        if not self.text.begins_line(self.start) or not self.text.ends_line(end):
            raise NoFix(_NOT_ON_OWN_LINES)
        return [_insertion(colon, " []"), self.text.without_lines(self.start, end)]

    def _check_keys(self) -> None:
        if self._has_question_marks:
            raise NoFix("the mapping has keys that are written with `?`")

    @cached_property
    def _has_question_marks(self) -> bool:
        text = self.text.text
        return self.node.kind == "mapping" and any(
            text.startswith("? ", max(0, item.start - 2), item.start) for item in self.items
        )

    def _insert_in_flow(self, entries: Sequence[str], after: int | None) -> list[Edit]:
        text = self.text
        if after is None:
            inner = self.start + 1
            # There may be merge keys, which are not among the items.
            is_empty = text.gap_end(inner) >= self.node.end - 1
            return [
                _insertion(
                    inner,
                    ", ".join(entries) if is_empty else "".join(f"{entry}, " for entry in entries),
                )
            ]
        start, end = self.items[after]
        comma = text.gap_end(end)
        has_comma = text.text[comma] == ","
        on_same_line = [_insertion(end, "".join(f"{self._separator}{entry}" for entry in entries))]
        if not text.begins_line(start) or text.line_start(start) <= self.start:
            return on_same_line
        lines = [f"{text.line_break(start)}{text.indent(start)}{entry}" for entry in entries]
        if has_comma:
            if not text.ends_line(comma + 1):
                return on_same_line
            return [_insertion(text.line_end(comma + 1), "".join(f"{line}," for line in lines))]
        line_end = text.line_end(end)
        if comma < line_end:
            return on_same_line
        if line_end == end:
            return [_insertion(end, "".join(f",{line}" for line in lines))]
        return [_insertion(end, ","), _insertion(line_end, ",".join(lines))]

    @cached_property
    def _separator(self) -> str:
        """The text between two entries on one line."""
        for one, other in pairwise(self.items):
            between = self.text.text[one.end : other.start]
            if between.strip(" \t") == "," and "\n" not in between:
                return between
        is_compact = (
            self.node.kind == "mapping"
            and _COMPACT_JSON.search(self.text.text, self.start, self.node.end) is not None
        )
        return "," if is_compact else ", "

    def _insert_in_block(self, entries: Sequence[str], after: int | None) -> list[Edit]:
        text, column = self.text, self._column()
        if column is None:
            raise NoFix("the indentation of the entries is not supported")
        if after is None:
            return [
                _insertion(
                    self.start,
                    "".join(
                        f"{entry}{text.line_break(self.start)}{' ' * column}" for entry in entries
                    ),
                )
            ]
        end = self.items[after].end
        if not text.ends_line(end) or text.text[text.content(self._values[after])] in "|>":
            raise NoFix("the entry before the insertion does not end with its line")
        dash = "- " if self.node.kind == "sequence" else ""
        return [
            _insertion(
                text.line_end(end),
                "".join(f"{text.line_break(end)}{' ' * column}{dash}{entry}" for entry in entries),
            )
        ]

    def _column(self) -> int | None:
        """The column of the keys or dashes of a block collection."""
        at = self.items[0].start if self.items and self.node.kind == "mapping" else self.start
        start = self.text.line_start(at)
        opening = _LINE_OPENING.match(self.text.text, start)
        return at - start if opening is not None and opening.end() >= at else None

    def _keep(self, indices: Sequence[int], replacements: Sequence[Edit]) -> list[Edit]:
        """Rewrites the collection with the items at the indices, each with the text before it, and
        with replacements in them.
        """
        items, text = self.items, self.text.text
        whole = Span(items[0].start, items[-1].end)
        between = (text[one.end : other.start].strip() for one, other in pairwise(items))
        if self.text.comments_in(*whole) or any(each != "," for each in between):
            raise NoFix("comments or merge keys stand between the entries")
        first, *others = indices
        spans = [Span(*items[first]), *(Span(items[n - 1].end, items[n].end) for n in others)]
        return [Edit(whole, "".join(_replaced(text, span, replacements) for span in spans))]

    def _remove_from_flow(self, index: int) -> list[Edit]:
        text, items = self.text, self.items
        start, end = items[index]
        is_last = index == len(items) - 1
        comma = text.gap_end(end)
        has_comma = text.text[comma] == ","
        comma_before = text.gap_end(items[index - 1].end) if index else -1
        follows_item = index == 0 or text.gap_end(comma_before + 1) == start
        precedes_item = is_last or text.gap_end(comma + 1) == items[index + 1].start
        if not follows_item or not precedes_item:
            raise NoFix("a merge key stands beside the entry")
        after = comma + 1 if has_comma else end
        if (
            text.begins_line(start)
            and text.line_start(start) > self.start
            and text.ends_line(after)
        ):
            lines = text.without_lines(start, after)
            return (
                [lines]
                if has_comma or not index
                else [Edit(Span(comma_before, comma_before + 1), ""), lines]
            )
        if not is_last:
            removed = Span(start, items[index + 1].start)
        elif index:
            removed = Span(comma_before, comma if has_comma else end)
        else:
            removed = Span(start, after)
        if text.comments_in(*removed):
            raise NoFix("a comment stands between the entries")
        return [Edit(removed, "")]

    def _remove_from_block(self, index: int) -> list[Edit]:
        text, column = self.text, self._column()
        start, end = self.items[index]
        if column is not None and self.node.kind == "sequence":
            start = self._dash(index, column)
        if column is None or start < 0 or not text.ends_line(end) or len(self.items) == 1:
            raise NoFix(_NOT_ON_OWN_LINES)
        if not text.begins_line(start):
            if index or text.line_start(self.items[1].start) <= end:
                raise NoFix(_NOT_ON_OWN_LINES)
            # The next key moves up to the dash that stands before the first one, with comments
            # between them.
            following = self.items[1].start
            lines = "".join(
                f"{comment}{text.line_break(start)}{' ' * column}"
                for comment in text.comments_in(start, following)
            )
            return [Edit(Span(start, following), lines)]
        return [text.without_lines(start, end, " " * column)]

    def _dash(self, index: int, column: int) -> int:
        """The place of the `-` of an item, or -1 if it is not found."""
        if index == 0:
            return self.start
        start = self.text.line_start(self.items[index].start)
        while start > self.items[index - 1].end - 1:
            if self.text.text[start : start + column + 1] == " " * column + "-":
                return start + column
            start = self.text.line_start(start - 1)
        return -1


def _insertion(at: int, text: str) -> Edit:
    return Edit(Span(at, at), text)


def _replaced(text: str, span: Span, replacements: Sequence[Edit]) -> str:
    """A part of a text with the replacements in it made."""
    inside = [
        edit for edit in replacements if span.start <= edit.span.start and edit.span.end <= span.end
    ]
    return apply(
        text[slice(*span)],
        [Edit(Span(*(place - span.start for place in edit.span)), edit.text) for edit in inside],
    )
