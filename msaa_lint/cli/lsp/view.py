"""What all questions about one version of a document need: its tree, its names, its costs. Each is
made once, if asked for.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

from msaa_lint.core.allowance import Allowance
from msaa_lint.core.finding import Finding
from msaa_lint.core.text.node import Limits, Node
from msaa_lint.core.text.source import Source
from msaa_lint.core.text.span import Span
from msaa_lint.core.text.tree import parse
from msaa_lint.frame.cost.amounts import FrameCost
from msaa_lint.frame.cost.model import frame_cost
from msaa_lint.frame.facts.frame import Frame
from msaa_lint.input import readers
from msaa_lint.linter.fixes.document_fixes import DocumentFixes
from msaa_lint.linter.prices import PriceAllowance, Prices
from msaa_lint.linter.results import DocumentResult, FileResult
from msaa_lint.linter.rules.registry import Registry
from msaa_lint.linter.settings.selectors import RuleNames

from .names import Names, names_of
from .recovery import SYNTAX, repaired


class Costs:
    """The cost of one document as written, and after changes of its values. `root` is the document
    in the text.
    """

    def __init__(self, result: DocumentResult, root: Node) -> None:
        self.result = result
        self.root = root

    @property
    def is_expanded(self) -> bool:
        """Whether the document is a shorthand, whose structures are not written in the text."""
        return self.result.document.tree is not None

    @cached_property
    def prices(self) -> Prices:
        return Prices(DocumentFixes(self.result), PriceAllowance(Allowance(), Allowance()))

    @cached_property
    def written(self) -> FrameCost:
        return frame_cost(Frame(self.result.document), self.result.device)

    def with_text(self, span: Span, new: str) -> FrameCost | None:
        """The cost with other text at a place; None if the document then has problems."""
        before = self.result.document.source
        source = Source(before.name, before.text[: span.start] + new + before.text[span.end :])
        parsed = parse(source, Limits())
        if parsed.problems or self.result.number >= len(parsed.documents):
            return None
        document = readers.read(
            source, parsed.documents[self.result.number], self.result.document.format or None
        )
        return frame_cost(Frame(document), self.result.device) if not document.problems else None


class View:
    """One version of a text as the questions at a position see it. Offsets are in code points.

    `kind` is `description`, `configuration`, `rule` or `code`; `result` is None where the text has
    not been linted. `docs_url` is the address of the site with the pages of rules; empty if there
    is none. Paths in the text are relative to `folder`, None if unknown.
    """

    def __init__(
        self,
        text: str,
        kind: str,
        result: FileResult | None,
        registry: Registry,
        findings: Sequence[Finding] = (),
        limits: Limits | None = None,
        docs_url: str = "",
        folder: str | None = None,
    ) -> None:
        self.text = text
        self.kind = kind
        self.result = result
        self.registry = registry
        self.findings = findings
        self.limits = limits or Limits()
        self.docs_url = docs_url
        self.folder = folder

    @cached_property
    def roots(self) -> list[Node]:
        """The documents of the text, without the lines that cannot be read."""
        if self.kind != "description":
            return []
        linted = self._linted
        if linted and all(each.document.tree is None for each in linted):
            return [each.document.description.node for each in linted]
        return repaired(self.text, self.limits)

    @cached_property
    def rule_names(self) -> RuleNames:
        """The rules by name and code."""
        return RuleNames(self.registry.names)

    @cached_property
    def names(self) -> Names:
        """The names of the text's descriptions."""
        return names_of(self.roots)

    @cached_property
    def costs(self) -> Sequence[Costs]:
        """The costs of the documents that were checked."""
        linted = [each for each in self._linted if each.number < len(self.roots)]
        return [
            Costs(each, self.roots[each.number])
            for each in linted
            if each.checked and not each.document.problems
        ]

    @property
    def _linted(self) -> Sequence[DocumentResult]:
        """The documents of the text, if it could be read as a whole: those of a capture are in
        another text.
        """
        result = self.result
        if (
            result is None
            or self.kind != "description"
            or any(found.code in SYNTAX for found in result.findings)
        ):
            return ()
        return (
            result.documents
            if all(each.document.source.text == self.text for each in result.documents)
            else ()
        )
