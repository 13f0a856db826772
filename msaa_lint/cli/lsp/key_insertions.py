"""The keys that undecided rules lack, and the edits that add them."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from msaa_lint.core.finding import MissingKey
from msaa_lint.core.text.source import Source
from msaa_lint.core.text.span import Edit, Span
from msaa_lint.frame.description.record import Record
from msaa_lint.linter.fixes.changes import NoFix
from msaa_lint.linter.fixes.references import nested_records
from msaa_lint.linter.fixes.text_edits import TextEditor
from msaa_lint.linter.results import DocumentResult, FileResult, unmerged

MAX_RULES = 2
"""The rules that a title names."""

_CHOICES = re.compile(r"[\w-]+(?:, [\w-]+)*(?: or [\w-]+)?")
_DOCUMENT = re.compile(r"documents\[(\d+)\]\.")


class KeyInsertion(NamedTuple):
    """A key to add: the place of the structure that lacks it, what an editor shows, and the edits."""

    structure: Span
    title: str
    edits: tuple[Edit, ...]

    def begins_on(self, source: Source, span: Span) -> bool:
        """Whether the structure begins on one of the lines of a place."""
        return source.position(span.start).line <= source.position(self.structure.start).line <= source.position(span.end).line


def key_insertions(result: FileResult) -> list[KeyInsertion]:
    """The keys that the undecided rules of a description lack, each once, with one insertion for each of the few values of a key."""
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
        if number < len(documents) and not key.converted and key.structure != "commands":
            editor = editors.setdefault(number, _Editor(documents[number]))
            insertions += editor.insertions(key, names)
    return insertions


class _Editor:
    """Adds keys to one document."""

    def __init__(self, result: DocumentResult) -> None:
        description = result.document.description
        records = nested_records(description.metal or description)
        self._records: dict[str, Record] = {record.path: record for record in records}
        self._editor = TextEditor(result.document)
        self._is_json = result.document.source.text.lstrip()[:1] == "{"

    def insertions(self, key: MissingKey, rules: Sequence[str]) -> Iterator[KeyInsertion]:
        """The insertions of a key: one for each of its values if they are few, or else one without a value, which is then an error."""
        record = self._records.get(key.structure)
        if record is None or "[" in key.name:
            return
        name, *inner = key.name.split(".")
        to = f" to {key.structure}" if key.structure else ""
        more = f", and {len(rules) - MAX_RULES} more" if len(rules) > MAX_RULES else ""
        for value in _values(key.values):
            text = self._text(value)
            for member in reversed(inner):
                text = f'{{"{member}": {text}}}'
            try:
                edits = self._editor.insertion(record, name, text)
            except NoFix:
                continue
            stated = f"{key.name}: {value}" if value else key.name
            yield KeyInsertion(key.span, f"Add {stated}{to}, to decide {', '.join(rules[:MAX_RULES])}{more}", edits)

    def _text(self, value: str) -> str:
        if not self._is_json:
            return value
        return value if value in ("true", "false") or value.isdecimal() else f'"{value}"' if value else "null"


def _values(words: str) -> list[str]:
    """The values that a key may hold, if its description in words lists them; or else one that is empty."""
    return re.split(r", | or ", words) if _CHOICES.fullmatch(words) and " or " in words else [""]
