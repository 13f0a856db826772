"""What is known of one version of an open document, and where positions of the protocol are in its
text.
"""

from __future__ import annotations

import enum
import os
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

from lsprotocol import types
from pygls.uris import to_fs_path

from msaa_lint.core.finding import Finding, Suppressed, Undecided
from msaa_lint.core.text.source import Source
from msaa_lint.core.text.span import Edit, Span
from msaa_lint.linter.input_file import InputFile, ResolvedSettings
from msaa_lint.linter.results import FileResult
from msaa_lint.linter.rules.registry import Registry

from .positions import Positions
from .view import View

_MARK = "\ufeff"


class Kind(enum.Enum):
    """What a document is. Nothing is known of an OTHER one, such as the YAML of another tool."""

    DESCRIPTION = "description"
    CONFIGURATION = "configuration"
    RULE = "rule"
    CODE = "code"
    OTHER = "other"


@dataclass(frozen=True, eq=False)
class Analysis:
    """One version of an open document.

    `path` is that of its file as findings name it. `text` may begin with a byte order mark, which
    `source` lacks: spans are places in the latter. `resolved` are the settings of its folder.
    `findings` are those that `check` reports in it; `file` and `result` are what was linted and its
    result, None for a document that is not an input.
    """

    uri: str
    path: str
    version: int
    kind: Kind
    text: str
    encoding: types.PositionEncodingKind
    resolved: ResolvedSettings
    findings: Sequence[Finding] = ()
    undecided: Sequence[Undecided] = ()
    suppressed: Sequence[Suppressed] = ()
    file: InputFile | None = None
    result: FileResult | None = None

    @cached_property
    def source(self) -> Source:
        """The text without its byte order mark."""
        return Source(self.path, self.text.removeprefix(_MARK))

    @property
    def registry(self) -> Registry:
        """The rules of its folder."""
        return self.resolved.engine.registry

    @cached_property
    def view(self) -> View:
        """What the questions at a position need."""
        resolved = self.resolved
        file = to_fs_path(self.uri) if self.uri.startswith("file:") else None
        folder = os.path.dirname(file) if file is not None else None
        docs_url = resolved.settings.docs_url or ""
        return View(
            self.source.text,
            self.kind.value,
            self.result,
            self.registry,
            self.findings,
            resolved.limits,
            docs_url,
            folder,
        )

    @cached_property
    def positions(self) -> Positions:
        """The positions of the text, with its byte order mark."""
        return Positions(Source(self.path, self.text) if self._mark else self.source, self.encoding)

    @property
    def _mark(self) -> int:
        return len(self.text) - len(self.source.text)

    def offset(self, position: types.Position) -> int:
        """The offset of a position in code points. One beyond the end of its line, or of the text,
        is at that end.
        """
        return max(self.positions.offset(position) - self._mark, 0)

    def position(self, offset: int) -> types.Position:
        """The position of an offset in code points."""
        return self.positions.position(offset + self._mark)

    def range(self, span: Span) -> types.Range:
        """The range of a span."""
        return types.Range(self.position(span.start), self.position(span.end))

    def span(self, range: types.Range) -> Span:
        """The span of a range."""
        start = self.offset(range.start)
        return Span(start, max(self.offset(range.end), start))

    def text_edit(self, edit: Edit) -> types.TextEdit:
        """An edit of the text."""
        return types.TextEdit(self.range(edit.span), edit.text)
