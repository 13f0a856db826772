"""Plans the fixes of one document's findings and writes their edits."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import cached_property

from msaa_lint.core.finding import Finding
from msaa_lint.core.text.edits import Overlap, apply
from msaa_lint.core.text.source import Source
from msaa_lint.core.text.span import Edit
from msaa_lint.core.text.tree import Limits, parse
from msaa_lint.frame.description.document import Document
from msaa_lint.linter.results import DocumentResult
from msaa_lint.linter.rules.rule_runner import Key, finding_key

from .actions import PRICE_NOTES
from .aliases import Requests
from .changes import Change, NoFix, SharedText, distinct
from .context import FixContext
from .expanded_aliases import ExpandedAliases
from .planes import BOTH, other_aspect
from .planning import plan
from .shorthand import Shorthand, WordEdit, shorthand
from .text_edits import TextEditor


def documents_by_key(documents: Iterable[DocumentResult]) -> dict[Key, list[int]]:
    """The numbers of the documents that have a fix for a finding, by what identifies the
    finding.
    """
    numbers: dict[Key, list[int]] = {}
    for number, document in enumerate(documents):
        for key in document.fix_specs:
            numbers.setdefault(key, []).append(number)
    return numbers


class DocumentFixes:
    """Plans and writes the fixes of one document.

    `format` is the reader that was forced, if any. `editable` is False for source code, whose text
    is never edited.
    """

    def __init__(
        self, result: DocumentResult, format: str | None = None, editable: bool = True
    ) -> None:
        self.result = result
        self._format = format
        self._editable = editable
        self._context = FixContext(result.document)
        self._editor = TextEditor(result.document)
        self._changes: dict[Key, tuple[Change, ...]] = {}

    def changes(self, finding: Finding) -> tuple[Change, ...]:
        """The changes that fix a finding of the document everywhere it applies. Raises NoFix if it
        cannot be fixed.
        """
        key = finding_key(finding)
        if key not in self._changes:
            changes: list[Change] = []
            for spec, subject in self.result.fix_specs[key]:
                changes += plan(spec, subject, self._context)
            self._changes[key] = tuple(distinct(changes))
        return self._changes[key]

    def price_changes(self, finding: Finding) -> tuple[tuple[Change, ...], tuple[str, ...]]:
        """The changes that a finding's price is of, and notes on what it includes or leaves out.
        Raises NoFix as `changes`.

        They are those of its fix; where depth and stencil move together, also those of the other
        aspect.
        """
        changes = [*self.changes(finding)]
        notes: list[str] = []
        for spec, subject in self.result.fix_specs[finding_key(finding)]:
            note = PRICE_NOTES[spec.do](subject, self._context) if spec.do in PRICE_NOTES else None
            notes += [note] if note is not None else []
            other = other_aspect(spec, subject, self._context, self.result.device)
            if other is not None:
                changes += plan(spec, other, self._context)
                notes.append(BOTH)
        return tuple(distinct(changes)), tuple(dict.fromkeys(notes))

    def edits(
        self, changes: Sequence[Change], requested: Requests | None = None
    ) -> tuple[Edit, ...]:
        """The edits that make the changes, as `TextEditor.edits`; in a shorthand, the edit of one
        of its words.

        Where an anchor shares what changes with structures that do not change, its aliases are
        written out.
        """
        if self._is_expanded:
            return (self._word_edit(changes).edit,)
        try:
            return self._editor.edits(changes, requested)
        except SharedText as shared:
            if self._copies is None:
                raise shared from None
            copies, editor = self._copies
            return copies.edits(editor.edits(copies.changes(changes, editor.document)))

    @cached_property
    def _copies(self) -> tuple[ExpandedAliases, TextEditor] | None:
        """The document with its aliases written out, for changes of what aliases share; None if
        that cannot be done.
        """
        try:
            copies = ExpandedAliases(self.result.document)
        except SharedText:
            return None
        document = self._read(copies.source)
        return (copies, TextEditor(document)) if document is not None else None

    def with_edits(self, finding: Finding) -> Finding:
        """Adds the edits of its fix to a finding of the document. A fix that is only shown or that
        cannot be made has no edits.
        """
        fix = finding.fix
        if fix is None or fix.edits or (fix.shown and not self._is_expanded):
            return finding
        try:
            if not self._is_expanded:
                return finding._replace(fix=fix._replace(edits=self.edits(self.changes(finding))))
            if not fix.shown:
                edit, title = self._word_edit(self.changes(finding))
                return finding._replace(fix=fix._replace(title=title, edits=(edit,)))
        except NoFix:
            pass
        return finding._replace(fix=fix._replace(shown=True)) if self._is_expanded else finding

    @property
    def _is_expanded(self) -> bool:
        """Whether the document is expanded from a shorthand or read from source code."""
        return self.result.document.tree is not None

    def _word_edit(self, changes: Sequence[Change]) -> WordEdit:
        if self._shorthand is None:
            raise NoFix("the change cannot be written in the source text")
        return self._shorthand.edit(changes)

    @cached_property
    def _shorthand(self) -> Shorthand | None:
        return (
            shorthand(self.result.document, self.result.number, self._requested())
            if self._editable
            else None
        )

    def _requested(self) -> tuple[list[Change], list[Change]]:
        """The changes of the document's safe fixes, and of all its fixes except those that are only
        shown.
        """
        safe: list[Change] = []
        applicable: list[Change] = []
        for specs in self.result.fix_specs.values():
            for spec, subject in specs:
                try:
                    changes = plan(spec, subject, self._context) if spec.safety != "shown" else ()
                except NoFix:
                    continue
                applicable += changes
                safe += changes if spec.safe else ()
        return safe, applicable

    def reread(self, changes: Sequence[Change]) -> Document | None:
        """The document after the changes are made in its text, or None if they cannot be made or
        introduce errors.
        """
        if not self._editable:
            return None
        before = self.result.document.source
        try:
            return self._read(Source(before.name, apply(before.text, self.edits(changes))))
        except (NoFix, Overlap):
            return None

    def _read(self, source: Source) -> Document | None:
        """The document in another text, or None if that has errors."""
        from msaa_lint.input import readers

        parsed = parse(source, Limits())
        if parsed.problems or self.result.number >= len(parsed.documents):
            return None
        document = readers.read(source, parsed.documents[self.result.number], self._format)
        return document if not document.problems else None
