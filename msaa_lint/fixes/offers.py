"""The fixes of the findings of one document: what each changes, and the edits that it takes."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from ..document.document import Document
from ..engine import Judged
from ..finding import Edit, Finding
from ..judge import key_of
from ..source.edits import Overlap, apply
from ..source.text import Source
from ..source.tree import Limits, parse
from .changes import Change, Mending, Refused, changes
from .sharing import NOBODY, Wishes
from .text import Writing


class Offers:
    """What is made once for the fixes of one document; `format` is the reader that was forced."""

    def __init__(self, source: Source, judged: Judged, format: str | None = None) -> None:
        self.source = source
        self.judged = judged
        self.format = format
        self._mending = Mending(judged.document)
        self._writing = Writing(source, judged.document)

    def changes(self, found: Finding) -> tuple[Change, ...] | Refused | None:
        """What a finding's fix changes, in all places that the finding stands for; None where its rule has no fix for it."""
        mends = self.judged.mends.get(key_of(found))
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
        """As `text.edits`."""
        return self._writing.edits(made, wanted)

    def with_edits(self, findings: Iterable[Finding]) -> list[Finding]:
        """The findings of this document with the edits of their fixes; those that are only shown, or cannot be made, have none."""
        out = []
        for found in findings:
            if found.fix is not None and not found.fix.edits and not found.fix.shown:
                made = self.changes(found)
                edits = self.edits(made) if made is not None and not isinstance(made, Refused) else None
                if edits is not None and not isinstance(edits, Refused):
                    found = found._replace(fix=found.fix._replace(edits=edits))
            out.append(found)
        return out

    def reread(self, made: Sequence[Change]) -> Document | None:
        """The document with changes made in its text, read again; None where they cannot be written, or it then has mistakes."""
        from .. import readers

        edits = self.edits(made)
        if isinstance(edits, Refused):
            return None
        try:
            source = Source(self.source.name, apply(self.source.text, edits))
        except Overlap:
            return None
        parsed = parse(source, Limits())
        if parsed.problems or self.judged.number >= len(parsed.documents):
            return None
        document = readers.read(source, parsed.documents[self.judged.number], self.format)
        return document if not document.problems else None
