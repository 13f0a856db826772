"""The frames of a linted input with their costs: as written, after fixes, and with other sample counts."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from msaa_lint.core.finding import Finding
from msaa_lint.frame.cost.amounts import Terms
from msaa_lint.frame.cost.graph import frame_graph
from msaa_lint.frame.cost.input_cost import CostedFrame
from msaa_lint.frame.cost.model import frame_cost
from msaa_lint.frame.cost.variants import variants
from msaa_lint.frame.facts.frame import Frame

from .fixes.document_fixes import documents_by_key
from .fixes.fixer import FixResult
from .results import DocumentResult, FileResult, finding_kind, unmerged
from .rules.rule_runner import finding_key
from .savings import Trials


def costed_frames(
    result: FileResult, documents: Sequence[DocumentResult], trials: Trials | None, terms: Terms, counts: Sequence[int]
) -> list[CostedFrame]:
    """The costs of some documents of an input. `trials` are the fixes of the input, None if there are none to make."""
    fixed = _fixed_findings(result, trials) if trials is not None else {}
    return [_costed(result, document, trials, terms, counts, fixed.get(document.number, [])) for document in documents]


def _fixed_findings(result: FileResult, trials: Trials) -> dict[int, list[Finding]]:
    """The findings that fixes remove, with the prices that they have in the result, by the number of their document.

    One that other fixes have moved is recognized by its rule and subject; those that only appear after other fixes are left out.
    """
    documents, findings = unmerged(result).documents, unmerged(result).findings
    keys = {finding_key(finding) for finding in trials.all.fixed_findings}
    moved = Counter(finding_kind(finding) for finding in trials.all.fixed_findings)
    moved.subtract(finding_kind(finding) for finding in findings if finding_key(finding) in keys)
    numbers = documents_by_key(documents)
    fixed: dict[int, list[Finding]] = {}
    for finding in findings:
        if finding_key(finding) not in keys:
            kind = finding_kind(finding)
            if moved[kind] <= 0:
                continue
            moved[kind] -= 1
        for index in numbers.get(finding_key(finding), ()):
            fixed.setdefault(documents[index].number, []).append(finding)
    return fixed


def _costed(
    result: FileResult, document: DocumentResult, trials: Trials | None, terms: Terms, counts: Sequence[int], fixed: Sequence[Finding]
) -> CostedFrame:
    """The costs of one document: as written, after its fixes, and with other sample counts, after the same fixes."""
    written = Frame(document.document)
    cost = frame_cost(written, document.device, terms)
    others = variants(document.document, document.device, terms, counts)
    frame = CostedFrame(result.file, document.number, len(result.documents), cost, others, graph=frame_graph(written, cost))
    if trials is None:
        return frame
    safe, everything = _document(trials.safe, document), _document(trials.all, document)
    if everything is None:
        return frame
    fixed_frame = Frame(everything.document)
    fixed_cost = frame_cost(fixed_frame, everything.device, terms)
    return frame._replace(
        safely_fixed=frame_cost(Frame(safe.document), safe.device, terms) if safe is not None else None,
        fixed=fixed_cost,
        fixed_variants=variants(everything.document, everything.device, terms, counts),
        fixed_graph=frame_graph(fixed_frame, fixed_cost),
        fixed_findings=fixed,
    )


def _document(fixes: FixResult, document: DocumentResult) -> DocumentResult | None:
    """A document after fixes; None if nothing of its input is fixed."""
    if not fixes.fixed_findings:
        return None
    return next((fixed for fixed in fixes.result.documents if fixed.number == document.number), None)
