"""The fixes of the findings of one document: what each changes, and the edits that it takes."""

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
from msaa_lint.linter.rules.rule_runner import finding_key

from .aliases import NOBODY, Wishes
from .changes import Change, FixContext, Refused, changes
from .shorthand import Said, Shorthand, shorthand
from .text_edits import Writing


class DocumentFixes:
    """What is made once for the fixes of one document; `format` is the reader that was forced. One that is not `rewritten` was made of a
    text that edits cannot change: of source code."""

    def __init__(self, source: Source, result: DocumentResult, format: str | None = None, rewritten: bool = True) -> None:
        self.source = source
        self.result = result
        self.format = format
        self.rewritten = rewritten
        self._mending = FixContext(result.document)
        self._writing = Writing(source, result.document)

    def changes(self, found: Finding) -> tuple[Change, ...] | Refused | None:
        """What a finding's fix changes, in all places that the finding stands for; None where its rule has no fix for it."""
        mends = self.result.fix_specs.get(finding_key(found))
        if mends is None:
            return None
        made: list[Change] = []
        for mend, subject in mends:
            own = changes(mend, subject, self._mending)
            if isinstance(own, Refused):
                return own
            made += (change for change in own if change not in made)
        return tuple(made)

    def edits(self, made: Sequence[Change], wanted: Wishes = NOBODY) -> tuple[Edit, ...] | Refused:
        """As `text.edits`; what was made of a shorthand is changed in its words, or not at all."""
        if self.result.document.tree is not None:
            said = self._said(made)
            return said if isinstance(said, Refused) else (said.edit,)
        return self._writing.edits(made, wanted)

    def with_edits(self, findings: Iterable[Finding]) -> list[Finding]:
        """The findings of this document with the edits of their fixes; those that are only shown, or cannot be made, have none."""
        out = []
        for found in findings:
            if self.result.document.tree is not None:
                out.append(self._in_shorthand(found))
                continue
            if found.fix is not None and not found.fix.edits and not found.fix.shown:
                made = self.changes(found)
                edits = self.edits(made) if made is not None and not isinstance(made, Refused) else None
                if edits is not None and not isinstance(edits, Refused):
                    found = found._replace(fix=found.fix._replace(edits=edits))
            out.append(found)
        return out

    def _in_shorthand(self, found: Finding) -> Finding:
        """A finding of what was made of a shorthand: its fix in the words of that, or shown alone."""
        made = self.changes(found)
        if found.fix is None or made is None:
            return found
        said = made if isinstance(made, Refused) or found.fix.shown else self._said(made)
        if isinstance(said, Said):
            return found._replace(fix=found.fix._replace(title=said.title, edits=(said.edit,)))
        return found._replace(fix=found.fix._replace(shown=True))

    def _said(self, made: Sequence[Change]) -> Said | Refused:
        """Changes as a word of a shorthand. What else the word changes must be wanted by other fixes, of the same safety."""
        if self._shorthand is None:
            return Refused("the text states this in other words")
        return self._shorthand.edit(made)

    @cached_property
    def _shorthand(self) -> Shorthand | None:
        if not self.rewritten:
            return None
        return shorthand(self.source, self.result.document, self.result.number, self._wanted)

    @cached_property
    def _wanted(self) -> tuple[list[Change], list[Change]]:
        """What the safe fixes of the document change, and what all change that may be made."""
        found: tuple[list[Change], list[Change]] = ([], [])
        for mend, subject in (each for mends in self.result.fix_specs.values() for each in mends):
            made = changes(mend, subject, self._mending) if mend.safety != "shown" else ()
            if not isinstance(made, Refused):
                found[1].extend(made)
                found[0].extend(made if mend.safe else ())
        return found

    def reread(self, made: Sequence[Change]) -> Document | None:
        """The document with changes made in its text, read again; None where they cannot be written, or it then has mistakes."""
        from msaa_lint.input import readers

        if not self.rewritten:
            return None
        edits = self.edits(made)
        if isinstance(edits, Refused):
            return None
        try:
            source = Source(self.source.name, apply(self.source.text, edits))
        except Overlap:
            return None
        parsed = parse(source, Limits())
        if parsed.problems or self.result.number >= len(parsed.documents):
            return None
        document = readers.read(source, parsed.documents[self.result.number], self.format)
        return document if not document.problems else None
