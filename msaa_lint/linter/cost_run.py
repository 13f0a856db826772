"""Runs `cost`: the costs of the inputs of a request, found and read under the same configuration as for `check`."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from typing import NamedTuple

from msaa_lint.core.finding import Result
from msaa_lint.frame.cost.amounts import FrameCost, Terms
from msaa_lint.frame.cost.input_cost import CostedFrame
from msaa_lint.frame.cost.model import frame_cost
from msaa_lint.frame.cost.variants import variants
from msaa_lint.frame.facts.frame import Frame

from .results import DocumentResult, FileResult
from .workspace import Request, Workspace


class CostResult(NamedTuple):
    """The costs of the frames in order of the inputs; a result with the errors and nothing else; lines for standard error."""

    frames: Sequence[CostedFrame]
    errors: Result
    notes: Sequence[str]

    def of(self, file: str) -> list[CostedFrame]:
        """The frames of one input."""
        return [frame for frame in self.frames if frame.file == file]


def run_costs(request: Request, terms: Terms, counts: Sequence[int]) -> CostResult:
    """The costs of the inputs of a request, with variants at other sample counts and with fixes.

    A problem of an input or the configuration is an error in the result; the other inputs still get their costs.
    """
    workspace = Workspace(request)
    discovered = workspace.discover()
    findings = workspace.findings
    frames: list[CostedFrame] = []
    for path in discovered.files:
        file = workspace.open(path)
        if file is None:
            continue
        result = file.lint()
        errors = [finding for finding in result.findings if finding.fatal]
        findings.extend(errors)
        if result.source is None:
            continue
        workspace.sources[result.file] = result.source
        for document in _valid_documents(result) if errors else result.documents:
            cost = frame_cost(Frame(document.document), document.device, terms)
            others = variants(document.document, document.device, terms, counts)
            fixed = _with_fixes(result, document, terms)
            frames.append(CostedFrame(result.file, document.number, len(result.documents), cost, others, fixed))
    errors = [finding for finding in dict.fromkeys(findings) if finding.fatal]
    files = dict.fromkeys([*map(request.input_name, discovered.files), *(finding.file for finding in errors)])
    return CostResult(frames, Result(errors, [], [], list(files), workspace.sources, []), discovered.notes)


def _valid_documents(result: FileResult) -> list[DocumentResult]:
    """The documents without problems, of an input with errors; none of them if the text itself is broken."""
    spans = {problem.span for document in result.documents for problem in document.document.problems}
    if any(finding.fatal and finding.span not in spans for finding in result.findings):
        return []
    return [document for document in result.documents if not document.document.problems]


def _with_fixes(result: FileResult, document: DocumentResult, terms: Terms) -> FrameCost | None:
    """The cost of a document's frame with all fixes of its findings, including those that are never applied; None if there are none."""
    from .fixes.changes import NoFix
    from .fixes.document_fixes import DocumentFixes
    from .prices import Prices, merge_changes

    fixes = DocumentFixes(document, editable=not result.is_code)
    plans = []
    for finding in filter(fixes.covers, result.findings):
        with suppress(NoFix):
            plans.append(fixes.changes(finding))
    return Prices(fixes, terms).cost_with(merge_changes(plans), None) if plans else None
