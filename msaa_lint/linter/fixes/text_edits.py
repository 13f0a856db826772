"""Changes as edits of the text: what is not changed stays byte for byte."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from functools import cached_property
from typing import Any

from msaa_lint.core.text.node import Node
from msaa_lint.core.text.source import Source
from msaa_lint.core.text.span import Edit, Span
from msaa_lint.frame.description.document import Document
from msaa_lint.frame.description.models import MetalRecord
from msaa_lint.frame.description.record import Record
from msaa_lint.frame.description.scalars import enumerant
from msaa_lint.frame.description.shapes import Shape
from msaa_lint.frame.vulkan.enums import VALUES

from .aliases import NOBODY, Member, Sharing, Wishes, records_of, wish, wishes
from .changes import PLAIN, Change, Refused
from .layout import Collection, Edits
from .rendering import Rendering
from .spelling import Spelling, quoted
from .text_places import Text

_MERGE = re.compile(r"<<[\"']?[ \t]*:")
_ANCHOR, _ALIAS = (re.compile(rf"{sign}([^\s\[\]{{}},]+)") for sign in ("&", r"\*"))
_NUMBER = re.compile(r"0[xX][0-9a-fA-F]{1,16}|[0-9]{1,20}")


def edits(changes: Sequence[Change], source: Source, document: Document, wanted: Wishes = NOBODY) -> tuple[Edit, ...] | Refused:
    """The edits that make the changes in a document's text, in their order.

    `wanted` is what other changes that will be made as well want: a text that several members share by an anchor is edited where all of
    them want the same.
    """
    return Writing(source, document).edits(changes, wanted)


class Writing:
    """What is made once for the edits of one document."""

    def __init__(self, source: Source, document: Document) -> None:
        self.document = document
        self.text = Text(source, [document.description.node])
        self.dumped = not document.whole

    @cached_property
    def _records(self) -> list[Record]:
        # What a frame in Metal's words was made into stands at places of those words, and is not written.
        return list(records_of(self.document.description.metal or self.document.description))

    @cached_property
    def _spelling(self) -> Spelling:
        return Spelling(self._records, self.dumped)

    @cached_property
    def _sharing(self) -> Sharing | None:
        text = self.text.text
        return Sharing(self._records) if "*" in text and "&" in text else None

    @cached_property
    def _rendering(self) -> Rendering:
        return Rendering(self.text, self.document.description.node, self._spelling)

    def edits(self, changes: Sequence[Change], wanted: Wishes = NOBODY) -> tuple[Edit, ...] | Refused:
        """As `edits`."""
        groups: dict[Member, list[Change]] = {}
        for change in changes:
            groups.setdefault((id(change.record), change.member), []).append(change)
        asked = _Asked(changes, wanted)
        made: list[Edit] = []
        inserts: dict[int, tuple[Record, list[tuple[str, str]]]] = {}
        for group in groups.values():
            record, member = group[0].record, group[0].member
            own = self._group(group, asked)
            if isinstance(own, str):
                inserts.setdefault(id(record), (record, []))[1].append((member, own))
            elif isinstance(own, Refused):
                return own
            else:
                made += own
        for record, members in inserts.values():
            inserted = self._insert(record, members, asked)
            if isinstance(inserted, Refused):
                return inserted
            made += inserted
        return tuple(sorted(set(self._on_lines_that_stay(made))))

    def _on_lines_that_stay(self, made: Sequence[Edit]) -> Iterator[Edit]:
        """The edits, with what would go in at the end of a line that another of them takes away at the end of the line before it."""
        gone = sorted((each.span for each in made if each.span.start < each.span.end), reverse=True)
        for edit in made:
            at = edit.span.start
            for start, end in gone if edit.text and at == edit.span.end else ():
                if start < at < end and self.text.begins_line(start) and self.text.line_start(start) > 0:
                    at = self.text.line_end(self.text.line_start(self.text.line_start(start) - 1))
            yield edit if at == edit.span.start else Edit(Span(at, at), edit.text)

    def _group(self, group: Sequence[Change], asked: _Asked) -> Edits | str:
        """The edits for the changes of one member; or its value, where it is to be inserted."""
        record, member = group[0].record, group[0].member
        if self.document.metal is not None and not isinstance(record, MetalRecord):
            return Refused("the change is in Vulkan's words, and the frame in Metal's")
        if any(change.action not in PLAIN for change in group):
            return self._structural(group)
        if not record.states(member):
            return self._whole(group)
        key, value = record.spelled[member]
        own = record.node.anchor is None and record.node.start <= key.start < record.node.end
        if self._sharing is not None:
            if not asked.by_all(self._sharing.of_key(record, member), group):
                shared = own or group[-1].action == "unset"
                return Refused(f"others take over this `{member}` by an anchor") if shared else self._whole(group)
            if not asked.by_all(self._sharing.of_value(record, member), group):
                if value.anchor is None:
                    return Refused(f"others take over the value of this `{member}` by an anchor")
                if group[-1].action != "unset":
                    return [Edit(value.span, self._whole(group))]
        value = value.anchor or value
        if group[-1].action == "unset" and self.dumped:
            return [Edit(value.span, '"NULL"')]
        if group[-1].action == "unset":
            if self._sharing is not None and _MERGE.search(self.text.text, record.node.start, record.node.end):
                return Refused(f"a merge key may stand in for `{member}`")
            if self._lends(value):
                return Refused(f"others take over the value of this `{member}` by an anchor")
            collection = Collection(self.text, record.node)
            at = collection.index(key.start)
            return collection.remove([at]) if at is not None and own else Refused(f"`{member}` is stated elsewhere")
        if group[-1].action == "set":
            return self._scalar(value, record.SHAPE[member], group[-1].value, record)
        return self._flags(group, key, value)

    def _lends(self, node: Node) -> bool:
        """Whether something outside of a node may be an alias of something in it: by the names, wherever they stand."""
        text = self.text.text
        names = set(_ANCHOR.findall(text, node.start, node.end)) if self._sharing is not None else set()
        taken = {match[1] for match in _ALIAS.finditer(text) if not node.start <= match.start() < node.end} if names else set()
        return not names.isdisjoint(taken)

    def _scalar(self, node: Node, shape: Shape, value: Any, record: Record) -> Edits:
        """Puts a scalar in another one's place, in its quotes and its spelling."""
        if node.kind != "scalar":
            return Refused("it is no single value")
        start = self.text.content(node)
        before = self.text.text[start : start + 1] if start < node.end else ""
        if before in ("|", ">"):
            return Refused("it is a text of several lines")
        quote = before if before in ("'", '"') else ""
        new = self._spelling.scalar(shape, value, node if before else None, record)
        new = quoted(new, quote, not isinstance(value, str) or new.isdecimal())
        return [Edit(Span(start, node.end), new if before or self.text.text[start - 1 : start] in " \t" else f" {new}")]

    def _flags(self, group: Sequence[Change], key: Node, node: Node) -> Edits:
        record, member = group[0].record, group[0].member
        enum = record.SHAPE[member][1]
        # In the order of the list that comes out.
        gone = [change.value for change in group if change.action == "remove"]
        come = [change.value for change in group if change.action == "add"]
        if node.kind != "sequence":
            return self._flags_text(enum, gone, come, node, record)
        names = [enumerant(enum, item.text) if item.kind == "scalar" else None for item in node.value]
        numbers = [n for n, name in enumerate(names) if name in gone]
        if any(self._lends(node.value[n]) for n in numbers):
            return Refused("others take over a flag in it by an anchor")
        edits: list[Edit] = []
        for n, name in zip(numbers, come, strict=False):
            replaced = self._scalar(node.value[n].anchor or node.value[n], record.SHAPE[member], name, record)
            if isinstance(replaced, Refused) or node.value[n].anchor is not None:
                return Refused("a flag in it is an alias")
            edits += replaced
        left, new = numbers[len(come) :], come[len(numbers) :]
        collection = Collection(self.text, node)
        more: Edits = []
        if left and len(left) == len(names):
            colon = self.text.colon(key)
            more = collection.empty(colon) if len(left) == 1 and colon is not None else Refused("nothing would be left of it")
        elif left:
            more = collection.remove(left)
        elif new:
            like = node.value[0].text if node.value and node.value[0].kind == "scalar" else ""
            quote = self._rendering.item_quote(node)
            more = collection.insert([quoted(self._spelling.name(enum, name, like, record), quote) for name in new])
        return more if isinstance(more, Refused) else [*edits, *more]

    def _flags_text(self, enum: str, gone: Sequence[str], come: Sequence[str], node: Node, record: Record) -> Edits:
        """Flags that are one text: `A | B`, or a number."""
        start, text = self.text.content(node), node.text.strip()
        before = self.text.text[start : start + 1] if start < node.end else ""
        if node.kind != "scalar" or before in ("|", ">", "") or text.endswith(")"):
            return Refused("the flags are written in a way that is not understood")
        quote = before if before in ("'", '"') else ""
        if _NUMBER.fullmatch(text):
            if not self.dumped:
                return [Edit(Span(start, node.end), self._rendering.flags(enum, come, record))]
            mask = int(text, 0)
            for name in gone:
                mask &= ~VALUES[enum][name]
            for name in come:
                mask |= VALUES[enum][name]
            return [Edit(Span(start, node.end), quoted(hex(mask) if text[:2] in ("0x", "0X") else str(mask), quote, True))]
        parts = [part.strip() for part in text.split("|")]
        new = [self._spelling.name(enum, name, parts[0], record) for name in come]
        kept = []
        for part in parts:
            known = enumerant(enum, part)
            if known in gone:
                # As in a list, what comes stands where something went.
                kept += new[:1]
                del new[:1]
            elif known is not None and (enum not in VALUES or VALUES[enum][known]):
                kept.append(part)
        kept += new
        if not kept:
            return [Edit(Span(start, node.end), quoted("0", quote, True) if self.dumped else "[]")]
        joined = ("|" if "|" in text and " |" not in text else " | ").join(kept)
        return [Edit(Span(start, node.end), quoted(joined, quote, True))]

    def _whole(self, group: Sequence[Change]) -> str:
        """The value of a member with changes made, as it is written anew."""
        record, member = group[0].record, group[0].member
        shape = record.SHAPE[member]
        if group[-1].action == "set":
            return self._rendering.data(shape, group[-1].value, record)
        flags = list(getattr(record, member) or ())
        for change in group:
            if change.action == "add" and change.value not in flags:
                flags.append(change.value)
            elif change.action == "remove" and change.value in flags:
                flags.remove(change.value)
        return self._rendering.flags(shape[1], flags, record)

    def _insert(self, record: Record, members: Sequence[tuple[str, str]], asked: _Asked) -> Edits:
        """Puts members into a record that does not state them in its own text."""
        node = record.node
        if node.kind != "mapping" or (self.dumped and any(record.SHAPE[member][0] == "list" for member, _ in members)):
            return Refused("it does not say this in a mapping of its own")
        order = list(record.SHAPE)
        members = sorted(members, key=lambda each: order.index(each[0]))
        quote = self._rendering.key_quote(node)
        entries = [f"{quoted(member, quote)}{self._rendering.colon(node)}{value}" for member, value in members]
        if self._sharing is not None:
            others = self._sharing.of_mapping(record)
            if any(not asked.of((other, member)) for other in others for member, _ in members):
                if node.anchor is None or self._sharing.of_node(record):
                    return Refused("others take over this mapping by an anchor")
                # The alias becomes a mapping that merges what it named.
                alias = self.text.text[node.start : node.end]
                return [Edit(node.span, "{" + ", ".join([f"<<: {alias}", *entries]) + "}")]
            node = node.anchor or node
        collection = Collection(self.text, node)
        # Behind the member that comes before it in Vulkan's structure, else at the end.
        first = order.index(members[0][0])
        before = record.spelled.get(order[first - 1]) if first else None
        return collection.insert(entries, collection.index(before[0].start) if before is not None else None)

    def _structural(self, group: Sequence[Change]) -> Edits | str:
        record, member = group[0].record, group[0].member
        shape = record.SHAPE[member]
        if self.dumped:
            return Refused("structures of a tool's dump are not put together anew")
        if not record.states(member):
            if any(change.action != "append" for change in group):
                return Refused(f"there is no `{member}`")
            return f"[{', '.join(self._rendering.data(shape[1], change.value, record) for change in group)}]"
        key, value = record.spelled[member]
        own = record.node.anchor is None and record.node.start <= key.start < record.node.end and value.anchor is None
        if not own or (self._sharing is not None and (self._sharing.of_key(record, member) or self._sharing.of_value(record, member))):
            return Refused(f"an anchor shares `{member}`")
        edits: list[Edit] = []
        new: list[str] = []
        collection = Collection(self.text, value)
        for change in group:
            if change.action == "append":
                new.append(self._rendering.data(shape[1], change.value, record))
            elif change.action == "entry":
                name, data = change.value
                entry = self._rendering.data(shape[1], data, record)
                if value.kind == "mapping":
                    entry = f"{quoted(name, self._rendering.key_quote(value))}{self._rendering.colon(value)}{entry}"
                new.append(entry)
            elif change.action == "behind":
                number, data = change.value
                put_behind = collection.insert([self._rendering.data(shape[1], data, record)], number)
                if isinstance(put_behind, Refused):
                    return put_behind
                edits += put_behind
            elif change.action == "item":
                number, data = change.value
                edits.append(Edit(value.value[number].span, self._rendering.data(shape[1], data, record)))
        dropped = [change.value for change in group if change.action == "drop"]
        more = collection.remove(dropped) if dropped else []
        put = collection.insert(new) if new else []
        if isinstance(more, Refused) or isinstance(put, Refused):
            return more if isinstance(more, Refused) else put
        return [*edits, *more, *put]


class _Asked:
    """What is wanted of members, by some changes and by others that will be made as well."""

    def __init__(self, changes: Sequence[Change], wanted: Wishes) -> None:
        self._own = wishes(changes)
        self._wanted = wanted

    def of(self, member: Member) -> set[str]:
        return {*self._own.get(member, ()), *self._wanted.get(member, ())}

    def by_all(self, members: Sequence[Member], group: Sequence[Change]) -> bool:
        """Whether all of some members want what a group of changes wants."""
        own = {wish(change) for change in group}
        return all(own <= self.of(member) for member in members)
