"""Edits a document's text. What does not change stays the same, byte for byte."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from functools import cached_property
from typing import Any

from msaa_lint.core.text.node import Node
from msaa_lint.core.text.span import Edit, Span
from msaa_lint.frame.description.document import Document
from msaa_lint.frame.description.models import MetalRecord
from msaa_lint.frame.description.record import Record
from msaa_lint.frame.description.scalars import enumerant
from msaa_lint.frame.description.shapes import Shape
from msaa_lint.frame.vulkan.enums import VALUES

from .aliases import Aliases, Member, Requests, all_request, requests
from .changes import Change, NoFix, SharedText
from .layout import CollectionEditor
from .references import nested_records
from .spelling import Spelling
from .text_scanner import TextScanner
from .value_writer import ValueWriter, quote_scalar

_MERGE = re.compile(r"<<[\"']?[ \t]*:")
_ANCHOR = re.compile(r"&([^\s\[\]{},]+)")
_ALIAS = re.compile(r"\*([^\s\[\]{},]+)")
_NUMBER = re.compile(r"0[xX][0-9a-fA-F]{1,16}|[0-9]{1,20}")


class TextEditor:
    """Makes the edits for changes of one document."""

    def __init__(self, document: Document) -> None:
        self.document = document
        self.text = TextScanner(document.source, document.description.node)
        self.is_dump = not document.whole
        self._collections: dict[int, CollectionEditor] = {}

    @cached_property
    def _records(self) -> list[Record]:
        # The Vulkan records of a Metal description have places in the text, but are not written
        # there.
        return list(nested_records(self.document.description.metal or self.document.description))

    @cached_property
    def _spelling(self) -> Spelling:
        return Spelling(self._records, self.is_dump)

    @cached_property
    def _aliases(self) -> Aliases | None:
        text = self.text.text
        return Aliases(self._records) if "*" in text and "&" in text else None

    @cached_property
    def _writer(self) -> ValueWriter:
        return ValueWriter(self.text, self.document.description.node, self._spelling)

    def _collection(self, node: Node) -> CollectionEditor:
        """The editor of a mapping or a sequence; one for all edits of it."""
        if id(node) not in self._collections:
            self._collections[id(node)] = CollectionEditor(self.text, node)
        return self._collections[id(node)]

    def edits(
        self, changes: Sequence[Change], requested: Requests | None = None
    ) -> tuple[Edit, ...]:
        """The edits that make the changes, in the order of the text. Raises NoFix if the text does
        not allow one of them.

        `requested` is what all fixes that are made together request, by default these changes. A
        text that several members share through an anchor is only edited if the same is requested of
        all of them.
        """
        requested = requests(changes) if requested is None else requested
        groups: dict[Member, list[Change]] = {}
        for change in changes:
            groups.setdefault((id(change.record), change.member), []).append(change)
        edits: list[Edit] = []
        insertions: dict[int, list[tuple[Change, str]]] = {}
        for group in groups.values():
            new = self._member_edits(group, requested)
            if isinstance(new, str):
                insertions.setdefault(id(group[0].record), []).append((group[0], new))
            else:
                edits += new
        for members in insertions.values():
            edits += self._insert(
                members[0][0].record,
                [(change.member, value) for change, value in members],
                requested,
            )
        return tuple(sorted(set(self._on_remaining_lines(edits))))

    def _on_remaining_lines(self, edits: Sequence[Edit]) -> Iterator[Edit]:
        """The edits, with insertions at the end of a line that another edit removes moved to the
        end of the line before.
        """
        removals = sorted(
            (edit.span for edit in edits if edit.span.start < edit.span.end), reverse=True
        )
        for edit in edits:
            at = edit.span.start
            for start, end in removals if edit.text and at == edit.span.end else ():
                if (
                    start < at < end
                    and self.text.begins_line(start)
                    and self.text.line_start(start) > 0
                ):
                    at = self.text.line_end(self.text.line_start(self.text.line_start(start) - 1))
            yield edit if at == edit.span.start else Edit(Span(at, at), edit.text)

    def _member_edits(self, group: Sequence[Change], requested: Requests) -> list[Edit] | str:
        """The edits for the changes of one member, or the member's new value if it has to be
        inserted.
        """
        record, member, action, value = group[-1]
        if self.document.metal is not None and not isinstance(record, MetalRecord):
            raise NoFix("the fix does not apply to Metal descriptions")
        if any(change.structural for change in group):
            return self._entry_edits(group)
        if not record.states(member):
            return self._new_value(group)
        key, node = record.spelled[member]
        is_own = _has_own(record, key)
        if self._aliases is not None:
            if not all_request(self._aliases.of_key(record, member), group, requested):
                if is_own or action == "unset":
                    raise SharedText(f"an anchor shares this `{member}` with other structures")
                return self._new_value(group)
            if not all_request(self._aliases.of_value(record, member), group, requested):
                if node.anchor is None:
                    raise SharedText(
                        f"an anchor shares the value of this `{member}` with other members"
                    )
                if action != "unset":
                    return [Edit(node.span, self._new_value(group))]
        node = node.anchor or node
        if action == "unset":
            return self._unset(record, member, key, node)
        if action == "set":
            return [self._scalar(node, record.SHAPE[member], value, record)]
        return self._flags(group, key, node)

    def _unset(self, record: Record, member: str, key: Node, node: Node) -> list[Edit]:
        if self.is_dump:
            return [Edit(node.span, '"NULL"')]
        if self._aliases is not None and _MERGE.search(
            self.text.text, record.node.start, record.node.end
        ):
            raise SharedText(f"a merge key may state `{member}` as well")
        if self._is_aliased_outside(node):
            raise SharedText(f"an anchor shares the value of this `{member}` with other members")
        collection = self._collection(record.node)
        index = collection.index(key.start)
        if index is None or not _has_own(record, key):
            raise SharedText(f"another structure states `{member}`")
        return collection.remove([index])

    def _is_aliased_outside(self, node: Node) -> bool:
        """Whether an alias outside of a node may name an anchor in it, as far as the names in the
        text tell.
        """
        names = (
            set(_ANCHOR.findall(self.text.text, node.start, node.end))
            if self._aliases is not None
            else set()
        )
        places = [place for name in names if (place := self._alias_places.get(name)) is not None]
        return any(first < node.start or last >= node.end for first, last in places)

    @cached_property
    def _alias_places(self) -> dict[str, tuple[int, int]]:
        """By name: where the first and the last alias of an anchor begin, as far as the names in
        the text tell.
        """
        places: dict[str, tuple[int, int]] = {}
        for match in _ALIAS.finditer(self.text.text):
            first, _ = places.get(match[1], (match.start(), 0))
            places[match[1]] = (first, match.start())
        return places

    def _scalar(self, node: Node, shape: Shape, value: Any, record: Record) -> Edit:
        """Replaces a scalar, in the same quotes and spelling."""
        if node.kind != "scalar":
            raise NoFix("the value is not a scalar")
        start = self.text.content(node)
        is_empty = start >= node.end
        if self._is_block_scalar(node):
            raise NoFix("the value is a block scalar")
        text = self._spelling.scalar(shape, value, None if is_empty else node, record)
        # A number that takes the place of a word, as 1 does of ALL, is not one in quotes.
        is_number = text.isdecimal() and not node.text.isdecimal() and not self.is_dump
        quote = "" if is_number else self.text.quote(node)
        text = quote_scalar(text, quote, not isinstance(value, str) or text.isdecimal())
        needs_blank = is_empty and self.text.text[start - 1 : start] not in (" ", "\t", "")
        return Edit(Span(start, node.end), f" {text}" if needs_blank else text)

    def _is_block_scalar(self, node: Node) -> bool:
        return self.text.text[self.text.content(node) : node.end][:1] in ("|", ">")

    def _flags(self, group: Sequence[Change], key: Node, node: Node) -> list[Edit]:
        """Adds flags to a list and removes flags from it. Added flags replace removed ones where
        possible.
        """
        record, member = group[0].record, group[0].member
        shape = record.SHAPE[member]
        enum = shape[1]
        removals = [change.value for change in group if change.action == "remove"]
        additions = [change.value for change in group if change.action == "add"]
        if node.kind != "sequence":
            return [self._flags_text(enum, removals, additions, node, record)]
        names = [
            enumerant(enum, item.text) if item.kind == "scalar" else None for item in node.value
        ]
        indices = [n for n, name in enumerate(names) if name in removals]
        if any(self._is_aliased_outside(node.value[n]) for n in indices):
            raise SharedText("an anchor shares one of the flags with other members")
        edits = []
        for n, name in zip(indices, additions, strict=False):
            if node.value[n].anchor is not None:
                raise SharedText("one of the flags is an alias")
            edits.append(self._scalar(node.value[n], shape, name, record))
        surplus, missing = indices[len(additions) :], additions[len(indices) :]
        collection = self._collection(node)
        if surplus and len(surplus) == len(names):
            colon = self.text.colon_end(key)
            if len(surplus) > 1 or colon is None:
                raise NoFix("no entry would remain")
            return collection.remove_only_item(colon)
        if surplus:
            return collection.remove(surplus, edits)
        elif missing:
            model = node.value[0].text if node.value and node.value[0].kind == "scalar" else ""
            quote = self._writer.item_quote(node)
            edits += collection.insert(
                [
                    quote_scalar(self._spelling.name(enum, name, model, record), quote)
                    for name in missing
                ]
            )
        return edits

    def _flags_text(
        self,
        enum: str,
        removals: Sequence[str],
        additions: Sequence[str],
        node: Node,
        record: Record,
    ) -> Edit:
        """Changes flags that are one text, `A | B` or a number."""
        start, text = self.text.content(node), node.text.strip()
        if (
            node.kind != "scalar"
            or start >= node.end
            or self._is_block_scalar(node)
            or text.endswith(")")
        ):
            raise NoFix("the form of the flags is not supported")
        span, quote = Span(start, node.end), self.text.quote(node)
        if _NUMBER.fullmatch(text):
            if not self.is_dump:
                return Edit(span, self._writer.flags(enum, additions, record))
            mask = int(text, 0)
            for name in removals:
                mask &= ~VALUES[enum][name]
            for name in additions:
                mask |= VALUES[enum][name]
            return Edit(
                span,
                quote_scalar(hex(mask) if text[:2] in ("0x", "0X") else str(mask), quote, True),
            )
        parts = [part.strip() for part in text.split("|")]
        new = [self._spelling.name(enum, name, parts[0], record) for name in additions]
        remaining = []
        for part in parts:
            flag = enumerant(enum, part)
            if flag in removals:
                remaining += new[:1]
                del new[:1]
            elif flag is not None and (enum not in VALUES or VALUES[enum][flag]):
                remaining.append(part)
        remaining += new
        if not remaining:
            return Edit(span, quote_scalar("0", quote, True) if self.is_dump else "[]")
        separator = "|" if "|" in text and " |" not in text else " | "
        return Edit(span, quote_scalar(separator.join(remaining), quote, True))

    def _new_value(self, group: Sequence[Change]) -> str:
        """The text of a member's value after the changes."""
        record, member, action, value = group[-1]
        shape = record.SHAPE[member]
        if action == "set":
            return self._writer.value(shape, value, record)
        flags = getattr(record, member)
        for change in group:
            flags = change.applied_to(flags)
        return self._writer.flags(shape[1], flags or (), record)

    def insertion(self, record: Record, member: str, value: str) -> tuple[Edit, ...]:
        """The edits that add a member with the text of its value to a record. Raises NoFix if the
        text does not allow it.
        """
        return tuple(self._insert(record, [(member, value)], {}))

    def addition(self, record: Record, member: str, item: str) -> tuple[Edit, ...]:
        """The edits that add an entry, `key: value`, to the end of a list of mappings. Raises NoFix
        if the text does not allow it.
        """
        key, node = record.spelled[member]
        if (
            self.is_dump
            or node.kind != "sequence"
            or node.anchor is not None
            or not _has_own(record, key)
        ):
            raise SharedText(f"`{member}` is not written as a list of its own")
        collection = self._collection(node)
        return tuple(collection.insert([f"{{{item}}}" if collection.flow else item]))

    def _insert(
        self, record: Record, members: Sequence[tuple[str, str]], requested: Requests
    ) -> list[Edit]:
        """Inserts members, with the text of their values, into a record's own mapping."""
        node = record.node
        if node.kind != "mapping" or (
            self.is_dump and any(record.SHAPE[member][0] == "list" for member, _ in members)
        ):
            raise NoFix("the structure is not written as a mapping of its own")
        order = list(record.SHAPE)
        members = sorted(members, key=lambda entry: order.index(entry[0]))
        entries = [self._writer.entry(node, member, value) for member, value in members]
        if self._aliases is not None:
            others = self._aliases.of_mapping(record)
            if any((other, member) not in requested for other in others for member, _ in members):
                if node.anchor is None or self._aliases.has_same_node(record):
                    raise SharedText("an anchor shares this structure with others")
                # The alias becomes a mapping that merges what it named.
                alias = self.text.text[node.start : node.end]
                return [Edit(node.span, "{" + ", ".join([f"<<: {alias}", *entries]) + "}")]
            node = node.anchor or node
        collection = self._collection(node)
        # After the member that precedes it in the API's structure, else at the end.
        first = order.index(members[0][0])
        preceding = record.spelled.get(order[first - 1]) if first else None
        return collection.insert(
            entries, collection.index(preceding[0].start) if preceding is not None else None
        )

    def _entry_edits(self, group: Sequence[Change]) -> list[Edit] | str:
        """The edits for structural changes of one member, or the member's new value if it has to be
        inserted.
        """
        record, member = group[0].record, group[0].member
        shape = record.SHAPE[member]
        if self.is_dump:
            raise NoFix("entries of a tool's dump are not edited")
        if not record.states(member):
            if any(change.action != "append" for change in group):
                raise NoFix(f"there is no `{member}`")
            return f"[{', '.join(self._writer.value(shape[1], change.value, record) for change in group)}]"  # noqa: E501
        key, node = record.spelled[member]
        aliases = self._aliases
        is_shared = aliases is not None and (
            aliases.of_key(record, member) or aliases.of_value(record, member)
        )
        if is_shared or not _has_own(record, key) or node.anchor is not None:
            raise SharedText(f"an anchor shares `{member}` with other structures")
        edits: list[Edit] = []
        new: list[str] = []
        drops: list[int] = []
        collection = self._collection(node)
        for change in group:
            if change.action == "drop":
                drops.append(change.value)
            elif change.action == "append":
                new.append(self._writer.value(shape[1], change.value, record))
            elif change.action == "entry":
                name, data = change.value
                entry = self._writer.value(shape[1], data, record)
                new.append(
                    self._writer.entry(node, name, entry) if node.kind == "mapping" else entry
                )
            else:
                index, data = change.value
                text = self._writer.value(shape[1], data, record)
                edits += (
                    collection.insert([text], index)
                    if change.action == "insert-after"
                    else [Edit(node.value[index].span, text)]
                )
        if drops:
            edits += collection.remove(drops)
        if new:
            edits += collection.insert(new)
        return edits


def _has_own(record: Record, key: Node) -> bool:
    """Whether a key stands in the text of a record's own mapping, and is not merged or aliased."""
    return record.node.anchor is None and record.node.start <= key.start < record.node.end
