"""The keys that undecided rules lack, and the edits that add them."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from msaa_lint.core.finding import MissingKey
from msaa_lint.core.text.source import Source
from msaa_lint.core.text.span import Edit, Span
from msaa_lint.frame.description.record import Record
from msaa_lint.frame.description.shapes import Shape
from msaa_lint.linter.fixes.changes import NoFix
from msaa_lint.linter.fixes.references import nested_records
from msaa_lint.linter.fixes.text_edits import TextEditor
from msaa_lint.linter.fixes.value_writer import quote_scalar
from msaa_lint.linter.results import DocumentResult, FileResult, unmerged

from .recovery import MARK

MAX_RULES = 2
"""The rules that a title names."""

MAX_VALUES = 7
"""The values of a key that have an insertion each."""

_CHOICES = re.compile(r"[\w-]+(?:, [\w-]+)*(?: or [\w-]+)?")
_DOCUMENT = re.compile(r"documents\[(\d+)\]\.")
_PLAIN = re.compile(r"[^\r\n&*#]*")
"""The text of a value that may be written in another place."""


class KeyInsertion(NamedTuple):
    """A key to add: the place of the structure that lacks it, what an editor shows, and the edits.

    With `is_snippet`, MARK stands in them for the value, which the user writes.
    """

    structure: Span
    title: str
    edits: tuple[Edit, ...]
    is_snippet: bool = False

    def begins_on(self, source: Source, span: Span) -> bool:
        """Whether the structure begins on one of the lines of a place."""
        return (
            source.position(span.start).line
            <= source.position(self.structure.start).line
            <= source.position(span.end).line
        )


def key_insertions(result: FileResult) -> list[KeyInsertion]:
    """The keys that the undecided rules of a description lack, each with one insertion for each of
    its few values, and one without.
    """
    documents = unmerged(result).documents
    rules: dict[tuple[int, MissingKey], list[str]] = {}
    for undecided in unmerged(result).undecided:
        match = _DOCUMENT.match(undecided.subject)
        for key in undecided.keys:
            named = rules.setdefault((int(match[1]) if match else 0, key), [])
            if undecided.rule not in named:
                named.append(undecided.rule)
    editors: dict[int, _Editor] = {}
    insertions: list[KeyInsertion] = []
    for (number, key), names in rules.items():
        if number < len(documents) and not key.converted:
            editor = editors.setdefault(number, _Editor(documents[number]))
            insertions += editor.insertions(key, names)
    return insertions


def as_snippet(text: str) -> str:
    """The text of an insertion with the cursor at the mark."""
    return re.sub(r"[\\$}]", r"\\\g<0>", text).replace(MARK, "$0")


class _Editor:
    """Adds keys to one document."""

    def __init__(self, result: DocumentResult) -> None:
        description = result.document.description
        self._root: Record = description.metal or description
        self._description = description
        self._records: dict[str, Record] = {
            record.path: record for record in nested_records(self._root)
        }
        self._editor = TextEditor(result.document)
        self._text = result.document.source.text
        self._quote = '"' if self._text.lstrip()[:1] == "{" else ""

    def insertions(self, key: MissingKey, rules: Sequence[str]) -> Iterator[KeyInsertion]:
        """The insertions of a key: one for each of its values if they are few, and one for the user
        to write the value.
        """
        more = f", and {len(rules) - MAX_RULES} more" if len(rules) > MAX_RULES else ""
        to = f" to {key.structure}" if key.structure else ""
        about = f"{to}, to decide {', '.join(rules[:MAX_RULES])}{more}"
        for value, text, edits in (
            self._commands(key) if key.structure == "commands" else self._members(key)
        ):
            title = f"Add {key.name}: {value}{about}" if value else f"Add {key.name}{about}"
            yield KeyInsertion(key.span, title, edits, MARK in text)

    def _members(self, key: MissingKey) -> Iterator[tuple[str, str, tuple[Edit, ...]]]:
        """The values of a member of a structure, their texts, and the edits that state them."""
        record = self._records.get(key.structure)
        shape = _shape(type(record), key.name) if record is not None else None
        if record is None or shape is None:
            return
        name, *inner = key.name.split(".")
        for value, stated in [*self._values(key, record, shape), ("", self._empty(shape))]:
            text = stated
            for member in reversed(inner):
                text = f"{{{self._quoted(member.removesuffix('[0]'))}: {_item(member, text)}}}"
            try:
                yield (
                    value,
                    text,
                    self._editor.insertion(record, name.removesuffix("[0]"), _item(name, text)),
                )
            except NoFix:
                continue

    def _values(self, key: MissingKey, record: Record, shape: Shape) -> list[tuple[str, str]]:
        """A few values of a key, and their texts: the words that it may hold, the names that are
        defined, or what others state for it.
        """
        if _CHOICES.fullmatch(key.values) and " or " in key.values:
            return [(word, self._scalar(word)) for word in re.split(r", | or ", key.values)]
        if shape[0] == "name":
            return [(name, quote_scalar(name, self._quote)) for name in self._names(shape[1])]
        return (
            [(text, text) for text in self._stated(key.name, type(record))]
            if "." not in key.name
            else []
        )

    def _names(self, section: str) -> list[str]:
        """The first names of a section, such as `images` or `metal.textures`."""
        entries: object = self._description
        for part in section.split("."):
            entries = getattr(entries, part, None)
        return list(entries)[:MAX_VALUES] if isinstance(entries, dict) else []

    def _stated(self, name: str, kind: type[Record]) -> list[str]:
        """The texts that structures of one kind state for a member."""
        nodes = (
            each.spelled[name][1]
            for each in self._records.values()
            if type(each) is kind and each.states(name)
        )
        texts = (self._text[node.start : node.end] for node in nodes if node.anchor is None)
        return list(dict.fromkeys(text for text in texts if text and _PLAIN.fullmatch(text)))[
            :MAX_VALUES
        ]

    def _commands(self, key: MissingKey) -> Iterator[tuple[str, str, tuple[Edit, ...]]]:
        """The commands at the end of the frame that present one of its images. Where others belong
        depends on what they are for.
        """
        if key.name != "present" or not self._root.states("commands"):
            return
        for name, image in self._description.images.items():
            if image.samples in (None, 1):
                text = f"{{{self._quoted('image')}: {quote_scalar(name, self._quote)}}}"
                try:
                    yield (
                        name,
                        text,
                        self._editor.addition(
                            self._root, "commands", f"{self._quoted('present')}: {text}"
                        ),
                    )
                except NoFix:
                    continue

    def _empty(self, shape: Shape) -> str:
        """A value for the user to write."""
        kind = shape[0]
        if kind in ("list", "flags", "counted"):
            return f"[{MARK}]"
        if kind in ("record", "map", "numbered"):
            return f"{{{MARK}}}"
        return (
            MARK
            if kind in ("int", "number", "bool", "samples", "share", "null", "either")
            else f"{self._quote}{MARK}{self._quote}"
        )

    def _scalar(self, word: str) -> str:
        return (
            word
            if not self._quote or word in ("true", "false") or word.isdecimal()
            else f'"{word}"'
        )

    def _quoted(self, name: str) -> str:
        return f"{self._quote}{name}{self._quote}"


def _item(member: str, text: str) -> str:
    """The text of a member's value, in a list if its first item is meant."""
    return f"[{text}]" if member.endswith("[0]") else text


def _shape(kind: type[Record], path: str) -> Shape | None:
    """The shape of the value at the end of a path; None if there is none."""
    shape: Shape = ("record", kind)
    for part in path.split("."):
        if shape[0] != "record" or part.removesuffix("[0]") not in shape[1].SHAPE:
            return None
        shape = shape[1].SHAPE[part.removesuffix("[0]")]
        while shape[0] == "null" or (part.endswith("[0]") and shape[0] == "list"):
            shape = shape[1]
    return shape
