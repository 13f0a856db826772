"""Fixes of render targets: replaces a word if another one expands to what the fix changes, and to
nothing else.

A word of a render target stands for several members of several structures. This module does not
repeat which: it tries each alternative, expands it, and compares the result.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Any, NamedTuple

from msaa_lint.core.text.node import Node
from msaa_lint.core.text.node_builder import scalar
from msaa_lint.core.text.span import Edit, Span
from msaa_lint.core.text.tree import Limits, parse
from msaa_lint.frame.description.document import Document
from msaa_lint.frame.description.models import (
    AttachmentConfig,
    AttachmentConfigMSAA,
    Description,
    RenderTarget,
)
from msaa_lint.frame.description.record import Record

from .changes import Change, NoFix
from .references import nested_records

MAX_WORDS = 4
"""How many words of one fix are tried. A fix that concerns more cannot be made by a single word."""

_CONFIGS = {
    "colorAttachmentConfig": AttachmentConfigMSAA,
    "stencilAttachmentConfig": AttachmentConfig,
}

Place = tuple[str, str, int]
"""The path of a structure, a member, and the structure's number among those of the same path."""

Values = dict[Place, Any]
"""The values of members, by place. Lists of flags are sets."""


class WordEdit(NamedTuple):
    """The edit of one word, and the title of the fix: the key and the new word."""

    edit: Edit
    title: str


class _Word(NamedTuple):
    """A word of a render target: the keys that lead to it, from the target's name on, and the words
    that may replace it.
    """

    keys: tuple[str, ...]
    alternatives: tuple[str, ...]


class Shorthand:
    """One description with render targets. Each target is expanded by itself, because a word only
    affects its own target.

    `requested` are all changes that the document's safe fixes make, and all that its fixes make.
    """

    def __init__(
        self, document: Document, root: Node, requested: tuple[Sequence[Change], Sequence[Change]]
    ) -> None:
        self._source = document.source
        self._root = root
        self._words = _words(root, self._source.text)
        self._records: dict[int, tuple[str, int]] = {}
        self._members: Values = {}
        for path, number, record in _compared_records(document.description):
            self._records.setdefault(id(record), (path, number))
            self._members.update(_members(path, number, record))
        self._requested = [self._values_after(changes) for changes in requested]
        self._before: dict[str, Values] = {}

    def edit(self, changes: Sequence[Change]) -> WordEdit:
        """The edit of one word that makes the changes.

        The word may also make changes that other fixes request: safe fixes if those request all of
        the given changes. Raises NoFix if no word does that.
        """
        after = self._values_after(changes)
        if not after or len(after) < len(
            {(id(change.record), change.member) for change in changes}
        ):
            raise NoFix("render targets cannot express the change")
        allowed = next(
            (values for values in self._requested if after.items() <= values.items()), after
        )
        spans = {
            change.record.spelled[change.member][1].span
            for change in changes
            if change.record.states(change.member)
        }
        for span in sorted(spans)[:MAX_WORDS]:
            word = self._words.get(span)
            if word is None:
                continue
            for alternative in word.alternatives:
                difference = self._difference(word, alternative)
                if (
                    difference is not None
                    and after.items() <= difference.items() <= allowed.items()
                ):
                    return WordEdit(Edit(span, alternative), f"{word.keys[-1]}: {alternative}")
        raise NoFix("no other word of the render target makes only this change")

    def _values_after(self, changes: Iterable[Change]) -> Values:
        """The values of members after the changes that concern a single member."""
        values: Values = {}
        for change in changes:
            path, number = self._records.get(id(change.record), ("", -1))
            place = (path, change.member, number)
            if change.structural or change.action == "unset" or place not in self._members:
                continue
            if change.action == "set":
                values[place] = change.value
                continue
            flags = values.get(place, self._members[place]) or frozenset()
            values[place] = (
                flags | {change.value} if change.action == "add" else flags - {change.value}
            )
        return values

    def _difference(self, word: _Word, alternative: str) -> Values | None:
        """The values that differ with another word, or None if there are other members then."""
        name = word.keys[0]
        if name not in self._before:
            self._before[name] = self._expanded(_only_target(self._root, name))
        before, after = (
            self._before[name],
            self._expanded(_only_target(self._root, name, word, alternative)),
        )
        if after.keys() != before.keys():
            return None
        return {place: value for place, value in after.items() if value != before[place]}

    def _expanded(self, root: Node) -> Values:
        from msaa_lint.input.readers import description

        values: Values = {}
        for path, number, record in _compared_records(
            description.read(self._source, root).description
        ):
            values |= _members(path, number, record)
        return values


def shorthand(
    document: Document, number: int, requested: tuple[Sequence[Change], Sequence[Change]]
) -> Shorthand | None:
    """The render targets that a document is expanded from, by its number in the text, or None if it
    comes from source code.
    """
    documents = parse(document.source, Limits()).documents
    root = documents[number] if number < len(documents) else None
    if root is None or root.kind != "mapping" or "renderTargets" not in root.value:
        return None
    return Shorthand(document, root, requested)


def _compared_records(description: Description) -> Iterator[tuple[str, int, Record]]:
    """The records of a description, each with its path and its number among those of the path;
    Metal's alone if there are any.
    """
    counts: dict[str, int] = {}
    for record in nested_records(
        description.metal if description.metal is not None else description
    ):
        counts[record.path] = number = counts.get(record.path, -1) + 1
        yield record.path, number, record


def _members(path: str, number: int, record: Record) -> Values:
    """The values of the members that hold no further structures."""
    values: Values = {}
    for member in record.SHAPE:
        value = getattr(record, member, None)
        if isinstance(value, tuple) and not any(isinstance(item, Record) for item in value):
            values[path, member, number] = frozenset(value)
        elif not isinstance(value, (Record, tuple, dict)):
            values[path, member, number] = value
    return values


def _words(root: Node, text: str) -> dict[Span, _Word]:
    """The words of a description's render targets by place, without those that have an anchor or
    that several targets share.
    """
    words: dict[Span, _Word] = {}
    repeated_places: set[Span] = set()
    for name, target in root.value["renderTargets"].value.items():
        structures: list[tuple[tuple[str, ...], type[Record], Node]] = [
            ((name,), RenderTarget, target)
        ]
        structures += [
            ((name, member), _CONFIGS[member], node)
            for member, node in target.value.items()
            if member in _CONFIGS
        ]
        for keys, kind, node in structures:
            for member, value in node.value.items():
                shape = kind.SHAPE[member]
                if (
                    shape[0] != "word"
                    or not member.endswith(("Mode", "Action"))
                    or text[value.start : value.end] != value.text
                ):
                    continue
                if value.span in words:
                    repeated_places.add(value.span)
                words[value.span] = _Word(
                    (*keys, member), tuple(word for word in shape[1] if word != value.value)
                )
    return {span: word for span, word in words.items() if span not in repeated_places}


def _only_target(root: Node, name: str, word: _Word | None = None, alternative: str = "") -> Node:
    """A description with one of its render targets, and with an alternative in place of a word of
    it.
    """
    targets = root.value["renderTargets"]
    target = targets.value[name]
    if word is not None:
        target = _with_word(target, word.keys[1:], alternative)
    only = Node("mapping", targets.start, targets.end, {name: target}, {name: targets.keys[name]})
    return Node("mapping", root.start, root.end, {**root.value, "renderTargets": only}, root.keys)


def _with_word(node: Node, keys: tuple[str, ...], word: str) -> Node:
    """A structure with another word at the end of a path of keys."""
    if not keys:
        return scalar(word, node.span)
    key, *rest = keys
    return Node(
        "mapping",
        node.start,
        node.end,
        {**node.value, key: _with_word(node.value[key], tuple(rest), word)},
        node.keys,
    )
