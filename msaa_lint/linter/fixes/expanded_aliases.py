"""A document with its aliases and merge keys written out: what a fix changes is shared with nothing
else there.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import islice, pairwise

from msaa_lint.core.text.edits import apply
from msaa_lint.core.text.node import Node
from msaa_lint.core.text.source import Source
from msaa_lint.core.text.span import Edit, Span
from msaa_lint.frame.description.document import Document
from msaa_lint.frame.description.record import Record

from .changes import Change, SharedText
from .references import nested_records
from .text_scanner import TextScanner
from .value_writer import quote_scalar

MAX_COPIES = 100
"""Aliases that are written out. Each takes time for each fix."""

MAX_LENGTH = 1 << 18
"""Characters of aliases that are written out; an alias of aliases may stand for any number."""


class _Copy:
    """An alias, or a mapping with merge keys, at its place: the text that states the same, and the
    texts that it is a copy of.
    """

    def __init__(self, span: Span, text: str, sources: Sequence[Span]) -> None:
        self.span = span
        self.text = text
        self.sources = sources
        self.start = 0
        """Where the text begins in the document with all copies."""


class ExpandedAliases:
    """The copies of one document, in order. Raises SharedText if they cannot be made."""

    def __init__(self, document: Document) -> None:
        self._document = document
        root = document.description.node
        self._text = TextScanner(document.source, root)
        self._length = 0
        self._records: dict[tuple[type[Record], str], list[Record]] = {}
        shared = list(islice(self._shared(root), MAX_COPIES + 1))
        if len(shared) > MAX_COPIES:
            raise SharedText("there are too many aliases to write them out")
        self._copies = [self._copy(node) for node in shared]
        shift = 0
        for copy in self._copies:
            copy.start = copy.span.start + shift
            shift += len(copy.text) - (copy.span.end - copy.span.start)
        self.source = Source(
            document.source.name,
            apply(document.source.text, [Edit(copy.span, copy.text) for copy in self._copies]),
        )

    def changes(self, changes: Iterable[Change], document: Document) -> list[Change]:
        """The same changes of the records of the document with all copies."""
        if not self._records:
            for record in nested_records(document.description.metal or document.description):
                self._records.setdefault((type(record), record.path), []).append(record)
        found = []
        for change in changes:
            same = self._records.get((type(change.record), change.record.path), [])
            if len(same) != 1:
                raise SharedText("an anchor shares its structures with others")
            found.append(change._replace(record=same[0]))
        return found

    def edits(self, edits: Iterable[Edit]) -> tuple[Edit, ...]:
        """The edits of the document itself that do the same as edits of the document with all
        copies; other aliases stay.
        """
        inside: dict[int, list[Edit]] = {}
        outside: list[Edit] = []
        for edit in edits:
            start, end = self._original(edit.span.start, False), self._original(edit.span.end, True)
            if isinstance(start, Span) and start == self._original(edit.span.end, False):
                number = next(
                    number for number, copy in enumerate(self._copies) if copy.span == start
                )
                at = self._copies[number].start
                inside.setdefault(number, []).append(
                    Edit(Span(edit.span.start - at, edit.span.end - at), edit.text)
                )
            elif isinstance(start, int) and isinstance(end, int):
                outside.append(Edit(Span(start, end), edit.text))
            else:
                raise SharedText("an alias is part of the text that the fix changes")
        removed = [edit.span for edit in outside if edit.span.start < edit.span.end]
        needed = [
            Edit(copy.span, apply(copy.text, inside.get(number, [])))
            for number, copy in enumerate(self._copies)
            if (number in inside or self._reads(copy, outside))
            and not any(
                span.start <= copy.span.start and copy.span.end <= span.end for span in removed
            )
        ]
        found = sorted([*outside, *needed])
        if any(one.span.end > other.span.start for one, other in pairwise(found)):
            raise SharedText("an alias is part of the text that the fix changes")
        return tuple(found)

    def _original(self, at: int, is_end: bool) -> int | Span:
        """The place in the document of a place in that with all copies; the span of a copy for one
        within it.
        """
        shift = 0
        for copy in self._copies:
            end = copy.start + len(copy.text)
            if at <= copy.start or (is_end and at < copy.start):
                break
            if at < end:
                return copy.span
            shift += len(copy.text) - (copy.span.end - copy.span.start)
        return at - shift

    def _reads(self, copy: _Copy, edits: Iterable[Edit]) -> bool:
        """Whether one of the edits changes a text that a copy is made of."""
        # An insertion after the last entry is at the end of its line.
        ends = [(source.start, self._text.line_end(source.end)) for source in copy.sources]
        return any(
            start <= edit.span.end and edit.span.start <= end
            for edit in edits
            for start, end in ends
        )

    def _shared(self, node: Node) -> Iterator[Node]:
        """The aliases, and the mappings with merge keys, that are in no other one, in order."""
        if node.anchor is not None or (
            node.kind == "mapping" and any(not _is_own(node, key) for key in node.keys.values())
        ):
            yield node
        elif node.kind != "scalar":
            for each in node.value.values() if node.kind == "mapping" else node.value:
                yield from self._shared(each)

    def _copy(self, node: Node) -> _Copy:
        start = node.start if node.anchor is not None else self._text.content(node)
        if self._text.comments_in(start, node.end):
            raise SharedText("comments stand between merged entries")
        return _Copy(
            Span(start, node.end),
            self._flow(node),
            list(_sources(node, Span(node.start, node.end))),
        )

    def _flow(self, node: Node) -> str:
        """A node in flow style, on one line."""
        if node.kind == "scalar":
            text = quote_scalar(
                node.text, "" if node.plain else '"', node.plain and not isinstance(node.value, str)
            )
        elif node.kind == "sequence":
            text = f"[{', '.join(map(self._flow, node.value))}]"
        else:
            entries = (
                f"{self._flow(node.keys[name])}: {self._flow(value)}"
                for name, value in node.value.items()
            )
            text = f"{{{', '.join(entries)}}}"
        self._length += len(text)
        if self._length > MAX_LENGTH:
            raise SharedText("aliases stand for too much text to write it out")
        return text


def _is_own(node: Node, key: Node) -> bool:
    return node.start <= key.start < node.end


def _sources(node: Node, place: Span) -> Iterator[Span]:
    """The texts outside of a place that a node there is read from."""
    origin = node.anchor or node
    if not (place.start <= origin.start and origin.end <= place.end):
        place = Span(origin.start, origin.end)
        yield place
    if node.kind == "mapping":
        for name, key in node.keys.items():
            if not place.start <= key.start < place.end:
                yield Span(key.start, key.end)
            yield from _sources(node.value[name], place)
    elif node.kind == "sequence":
        for each in node.value:
            yield from _sources(each, place)
