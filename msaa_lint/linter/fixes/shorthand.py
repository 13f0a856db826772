"""Fixes in the words of render targets: another word, where what it expands to has the changes of the fix, and none that is not wanted.

A word of theirs stands for several members of several structures. What a word does is not told here again: each that may stand in its place
is tried, expanded, and compared.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Any, NamedTuple

from msaa_lint.core.text.node import Node
from msaa_lint.core.text.node_builder import scalar
from msaa_lint.core.text.source import Source
from msaa_lint.core.text.span import Edit, Span
from msaa_lint.core.text.tree import Limits, parse
from msaa_lint.frame.description.document import Document
from msaa_lint.frame.description.models import AttachmentConfig, AttachmentConfigMSAA, Description, Metal, RenderTarget
from msaa_lint.frame.description.record import Record

from .aliases import records_of
from .changes import PLAIN, Change, Refused

MOST_PLACES = 4
"""Words that one fix may be about; more are no matter of one word."""

_CONFIGS = {"colorAttachmentConfig": AttachmentConfigMSAA, "stencilAttachmentConfig": AttachmentConfig}

Place = tuple[str, str, int]
"""A structure's path, its member, and which of the structures of that path it is."""


class Said(NamedTuple):
    """The edit of one word, and what it says."""

    edit: Edit
    title: str


class Word(NamedTuple):
    """A word of a render target: the keys that lead to it from the target's name on, and the words that may stand in its place."""

    keys: tuple[str, ...]
    others: tuple[str, ...]


class Shorthand:
    """One description with render targets. A target is expanded by itself: what a word does, it does to its own.

    `wanted` are all changes that the document's safe fixes make, and all that its fixes make.
    """

    def __init__(self, source: Source, document: Document, root: Node, wanted: tuple[Sequence[Change], Sequence[Change]]) -> None:
        self.source = source
        self.root = root
        self.words = _words(root, source.text)
        self.places: dict[int, Place] = {}
        self.members: dict[Place, Any] = {}
        for path, nth, record in _records(document.description):
            self.places.setdefault(id(record), (path, "", nth))
            self.members.update(_members(path, nth, record))
        self.wanted = [self._after(changes) for changes in wanted]
        self._before: dict[str, dict[Place, Any]] = {}

    def edit(self, made: Sequence[Change]) -> Said | Refused:
        """The edit of one word that makes some changes, and of others only such as other fixes want, safe ones where these are."""
        own = self._after(made)
        if not own or len(own) < len({(id(change.record), change.member) for change in made}):
            return Refused("no word of the render target's does that")
        allowed = next((each for each in self.wanted if own.items() <= each.items()), own)
        spans = {change.record.spelled[change.member][1].span for change in made if change.record.states(change.member)}
        for span in sorted(spans)[:MOST_PLACES]:
            word = self.words.get(span)
            for other in word.others if word is not None else ():
                changed = self._changed(word, other) if word is not None else None
                if word is not None and changed is not None and own.items() <= changed.items() <= allowed.items():
                    return Said(Edit(span, other), f"{word.keys[-1]}: {other}")
        return Refused("no other word of the render target's does that alone")

    def _after(self, changes: Iterable[Change]) -> dict[Place, Any]:
        """What members are to be with some changes, as far as those are of one member."""
        found: dict[Place, Any] = {}
        for change in changes:
            path, _, nth = self.places.get(id(change.record), ("", "", -1))
            place = (path, change.member, nth)
            if change.action not in PLAIN or change.action == "unset" or place not in self.members:
                continue
            if change.action == "set":
                found[place] = change.value
                continue
            flags = found.get(place, self.members[place]) or frozenset()
            found[place] = flags | {change.value} if change.action == "add" else flags - {change.value}
        return found

    def _changed(self, word: Word, other: str) -> dict[Place, Any] | None:
        """What members are otherwise with another word; None where there are others then."""
        name = word.keys[0]
        if name not in self._before:
            self._before[name] = self._expanded(_alone(self.root, name))
        before, after = self._before[name], self._expanded(_alone(self.root, name, word, other))
        return {place: value for place, value in after.items() if value != before[place]} if after.keys() == before.keys() else None

    def _expanded(self, root: Node) -> dict[Place, Any]:
        from msaa_lint.input.readers import description

        made = description.read(self.source, root).description
        return {place: value for path, nth, record in _records(made) for place, value in _members(path, nth, record).items()}


def shorthand(source: Source, document: Document, number: int, wanted: tuple[Sequence[Change], Sequence[Change]]) -> Shorthand | None:
    """The shorthand that a document, by its number in the text, was made of; None where it was made of something else: of source code."""
    documents = parse(source, Limits()).documents
    root = documents[number] if number < len(documents) else None
    if root is None or root.kind != "mapping" or "renderTargets" not in root.value:
        return None
    return Shorthand(source, document, root, wanted)


def _records(description: Description) -> Iterator[tuple[str, int, Record]]:
    """The structures that are compared, each with its path and which of that path it is: of a frame in Metal's words those, as the others
    are made of them."""
    metal: Metal | None = description.metal
    counts: dict[str, int] = {}
    for record in records_of(metal if metal is not None else description):
        counts[record.path] = nth = counts.get(record.path, -1) + 1
        yield record.path, nth, record


def _members(path: str, nth: int, record: Record) -> dict[Place, Any]:
    """The members of a structure that hold no further ones; of flags the set."""
    found: dict[Place, Any] = {}
    for member in record.SHAPE:
        value = getattr(record, member, None)
        if isinstance(value, tuple) and not any(isinstance(each, Record) for each in value):
            found[path, member, nth] = frozenset(value)
        elif not isinstance(value, (Record, tuple, dict)):
            found[path, member, nth] = value
    return found


def _words(root: Node, text: str) -> dict[Span, Word]:
    """The words of a description's render targets by their places; none that has an anchor, or that two targets share by one."""
    found: dict[Span, Word] = {}
    shared: set[Span] = set()
    for name, target in root.value["renderTargets"].value.items():
        structures: list[tuple[tuple[str, ...], type[Record], Node]] = [((name,), RenderTarget, target)]
        structures += [((name, member), _CONFIGS[member], node) for member, node in target.value.items() if member in _CONFIGS]
        for keys, kind, node in structures:
            for member, value in node.value.items():
                shape = kind.SHAPE[member]
                if shape[0] != "word" or not member.endswith(("Mode", "Action")) or text[value.start : value.end] != value.text:
                    continue
                if value.span in found:
                    shared.add(value.span)
                found[value.span] = Word((*keys, member), tuple(word for word in shape[1] if word != value.value))
    return {span: word for span, word in found.items() if span not in shared}


def _alone(root: Node, name: str, word: Word | None = None, other: str = "") -> Node:
    """A description with one render target alone, and perhaps another word in it."""
    targets = root.value["renderTargets"]
    target = targets.value[name]
    if word is not None:
        target = _with(target, word.keys[1:], other)
    alone = Node("mapping", targets.start, targets.end, {name: target}, {name: targets.keys[name]})
    return Node("mapping", root.start, root.end, {**root.value, "renderTargets": alone}, root.keys)


def _with(node: Node, keys: tuple[str, ...], text: str) -> Node:
    """A structure with another word where some keys lead to."""
    if not keys:
        return scalar(text, node.span)
    key, *rest = keys
    return Node("mapping", node.start, node.end, {**node.value, key: _with(node.value[key], tuple(rest), text)}, node.keys)
