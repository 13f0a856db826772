"""The frames of a linted input with their costs: as written, after fixes, and with other sample
counts.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from msaa_lint.core.allowance import Allowance
from msaa_lint.core.finding import Finding
from msaa_lint.frame.cost.amounts import Amount, Terms
from msaa_lint.frame.cost.graph import frame_graph
from msaa_lint.frame.cost.input_cost import CostedFrame, FixStep
from msaa_lint.frame.cost.model import difference, frame_cost
from msaa_lint.frame.cost.variants import variants
from msaa_lint.frame.facts.frame import Frame

from .fixes.changes import Change, NoFix, StructuralChange, apply_temporarily, distinct
from .fixes.document_fixes import DocumentFixes, documents_by_key
from .fixes.fixer import FixResult
from .prices import FINDING_WEIGHT, MAX_COSTED, MAX_REREAD, PriceAllowance
from .results import DocumentResult, FileResult, finding_kind, price_order, unmerged
from .rules.rule_runner import finding_key
from .savings import Trials

MAX_STEPS = 25
"""Steps of a waterfall with a row of their own; the others share one."""


def costed_frames(
    result: FileResult,
    documents: Sequence[DocumentResult],
    trials: Trials | None,
    terms: Terms,
    counts: Sequence[int],
    steps: bool = False,
) -> list[CostedFrame]:
    """The costs of some documents of an input. `trials` are the fixes of the input, None if there
    are none to make; `steps` also asks for what each fix adds to those before it.
    """
    frames = [_costed(result, document, trials, terms, counts) for document in documents]
    if trials is None or not steps:
        return frames
    fixed = _fixed_findings(result, trials)
    allowance = PriceAllowance(Allowance(MAX_REREAD), Allowance(MAX_COSTED))
    fixes = [DocumentFixes(document, editable=not result.is_code) for document in documents]
    return [
        frame._replace(
            fix_steps=fix_steps(each, fixed.get(each.result.number, ()), terms, allowance)
        )
        for frame, each in zip(frames, fixes, strict=True)
    ]


def _fixed_findings(result: FileResult, trials: Trials) -> dict[int, list[Finding]]:
    """The findings that fixes remove, by the number of their document.

    One that other fixes have moved is recognized by its rule and subject; those that only appear
    after other fixes are left out.
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


def fix_steps(
    fixes: DocumentFixes, findings: Sequence[Finding], terms: Terms, allowance: PriceAllowance
) -> list[FixStep]:
    """What the fix of each finding changes once those before it are made, the most expensive
    finding first.

    These add up, unlike prices, of which each is that of one fix alone. Only `MAX_STEPS` fixes, and
    as many as the allowance pays for, have a step.
    """
    document = fixes.result.document
    last = frame_cost(Frame(document), fixes.result.device, terms).total
    size = Frame(document).structures
    steps: list[FixStep] = []
    made: list[Change] = []
    for finding in sorted(findings, key=price_order)[:MAX_STEPS]:
        if not allowance.costed.take(FINDING_WEIGHT + size):
            break
        try:
            changes = distinct([*made, *fixes.changes(finding)])
            total = _total(fixes, changes, terms, allowance)
        except NoFix:
            continue
        if total is not None:
            steps.append(FixStep(finding, difference(total, last)))
            made, last = changes, total
    return steps


def _total(
    fixes: DocumentFixes, changes: Sequence[Change], terms: Terms, allowance: PriceAllowance
) -> Amount | None:
    """The cost of a document after changes; None if they cannot be made together, or take too long
    to read.
    """
    try:
        with apply_temporarily(changes):
            return frame_cost(Frame(fixes.result.document), fixes.result.device, terms).total
    except StructuralChange:
        if not allowance.reread.take(len(fixes.result.document.source.text)):
            return None
        document = fixes.reread(changes)
    return (
        frame_cost(Frame(document), fixes.result.device, terms).total
        if document is not None
        else None
    )


def _costed(
    result: FileResult,
    document: DocumentResult,
    trials: Trials | None,
    terms: Terms,
    counts: Sequence[int],
) -> CostedFrame:
    """The costs of one document: as written, after its fixes, and with other sample counts, after
    the same fixes.
    """
    written = Frame(document.document)
    cost = frame_cost(written, document.device, terms)
    others = variants(document.document, document.device, terms, counts)
    frame = CostedFrame(
        result.file,
        document.number,
        len(result.documents),
        cost,
        others,
        graph=frame_graph(written, cost),
    )
    if trials is None:
        return frame
    safe, everything = _document(trials.safe, document), _document(trials.all, document)
    if everything is None:
        return frame
    fixed_frame = Frame(everything.document)
    fixed_cost = frame_cost(fixed_frame, everything.device, terms)
    return frame._replace(
        safely_fixed=frame_cost(Frame(safe.document), safe.device, terms)
        if safe is not None
        else None,
        fixed=fixed_cost,
        fixed_variants=variants(everything.document, everything.device, terms, counts),
        fixed_graph=frame_graph(fixed_frame, fixed_cost),
    )


def _document(fixes: FixResult, document: DocumentResult) -> DocumentResult | None:
    """A document after fixes; None if nothing of its input is fixed."""
    if not fixes.fixed_findings:
        return None
    return next(
        (fixed for fixed in fixes.result.documents if fixed.number == document.number), None
    )
