"""What the editor's questions about one version of a document have in common: its tree, its names, its costs. Each is made once, if asked."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

from msaa_lint.core.allowance import Allowance
from msaa_lint.core.finding import Finding
from msaa_lint.core.text.node import Limits, Node
from msaa_lint.frame.cost.amounts import FrameCost
from msaa_lint.linter.fixes.document_fixes import DocumentFixes
from msaa_lint.linter.prices import PriceAllowance, Prices
from msaa_lint.linter.results import DocumentResult, FileResult
from msaa_lint.linter.rules.registry import Registry

from .names import Names, names_of
from .recovery import SYNTAX, repaired


class Costs:
    """The cost of one document as written, and after changes of its values."""

    def __init__(self, result: DocumentResult) -> None:
        self.result = result
        self.prices = Prices(DocumentFixes(result), PriceAllowance(Allowance(), Allowance()))

    @cached_property
    def written(self) -> FrameCost:
        return self.prices.cost(None)


class View:
    """One version of a text as the questions at a position see it. Offsets are in code points.

    `kind` is `description`, `configuration`, `rule` or `code`; `result` is None where the text has not been linted. `docs_url` is
    the address of the site with the pages of rules; empty if there is none.
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
    ) -> None:
        self.text = text
        self.kind = kind
        self.result = result
        self.registry = registry
        self.findings = findings
        self.limits = limits or Limits()
        self.docs_url = docs_url

    @cached_property
    def roots(self) -> list[Node]:
        """The documents of the text, without the lines that cannot be read."""
        if self.kind != "description":
            return []
        linted = self.result.documents if self.result is not None else ()
        whole = linted and not any(found.code in SYNTAX for found in self.result.findings) if self.result is not None else False
        if whole and all(each.document.tree is None for each in linted):
            return [each.document.description.node for each in linted]
        return repaired(self.text, self.limits)

    @cached_property
    def names(self) -> Names:
        """The names of the text's descriptions."""
        return names_of(self.roots)

    @cached_property
    def costs(self) -> Sequence[Costs]:
        """The costs of the documents that were checked."""
        documents = self.result.documents if self.result is not None and self.kind == "description" else ()
        return [Costs(result) for result in documents if result.checked and not result.document.problems]
