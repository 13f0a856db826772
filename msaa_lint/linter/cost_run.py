"""Inputs to costs: what `msaa-lint cost` shows. It finds and reads inputs as a run of `check` does, under the same configuration."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from typing import NamedTuple

from msaa_lint.core.finding import Result
from msaa_lint.core.text.source import Unreadable
from msaa_lint.core.text.tree import Limits
from msaa_lint.frame.cost.amounts import FrameCost, Terms
from msaa_lint.frame.cost.input_cost import Costed
from msaa_lint.frame.cost.model import frame_cost
from msaa_lint.frame.cost.variants import variants
from msaa_lint.frame.facts.frame import Frame
from msaa_lint.frame.profiles import device_of
from msaa_lint.input.discovery import STDIN, discover
from msaa_lint.input.opening import load, refused
from msaa_lint.input.readers import looks_like

from .engine import LintOptions
from .results import DocumentResult, FileResult
from .run import Request, Run

Fixed = Callable[[FileResult, DocumentResult, Terms], FrameCost | None]
"""What a document's frame would cost with the fixes of its findings made; None where it has none."""


class CostResult(NamedTuple):
    """The frames in the order of the inputs; a result that holds what could not be used and nothing else; lines for the standard error
    stream."""

    frames: Sequence[Costed]
    wrong: Result
    notes: Sequence[str]

    def of(self, file: str) -> list[Costed]:
        """The frames of one input."""
        return [each for each in self.frames if each.file == file]


def run_costs(request: Request, terms: Terms, counts: Sequence[int], fixed: Fixed | None = None) -> CostResult:
    """What the inputs of a request cost. What an input or the configuration has wrong is a finding, and the other inputs are reckoned."""
    this = Run(request)
    this.governed(os.curdir)
    found = discover(request.paths, this.settings, looks_like)
    this.findings.extend(found.findings)
    frames: list[Costed] = []
    for path in found.files:
        linted = _linted(this, path)
        if linted is None:
            continue
        wrong = [finding for finding in linted.findings if finding.fatal]
        this.findings.extend(wrong)
        if linted.source is None:
            continue
        this.sources[linted.file] = linted.source
        usable = linted.documents if not wrong else _readable(linted)
        frames.extend(_costed(linted, judged, terms, counts, fixed) for judged in usable)
    errors = [finding for finding in dict.fromkeys(this.findings) if finding.fatal]
    files = list(dict.fromkeys([*(name_of(request, path) for path in found.files), *(finding.file for finding in errors)]))
    return CostResult(frames, Result(errors, [], [], files, this.sources, []), found.notes)


def name_of(request: Request, path: str) -> str:
    """What an input is called: standard input by what the request says."""
    return (request.stdin_filename or "<stdin>") if path == STDIN else path


def _linted(this: Run, path: str) -> FileResult | None:
    """An input judged; None where it cannot be read."""
    request, name = this.request, name_of(this.request, path)
    governed = this.governed(request.stdin_filename or os.curdir if path == STDIN else path)
    limits = Limits(**{**Limits()._asdict(), **governed.settings.limits})
    device = device_of(governed.settings.profile)
    try:
        data = load(path, limits, name, request.format, request.data)
    except (OSError, Unreadable) as error:
        this.findings.append(refused(error, name))
        return None
    severity = governed.selection.for_file(name, device.vendor if device is not None else None)
    return governed.engine.lint(data, name, LintOptions(severity, limits, request.format, device, request.ignores))


def _readable(linted: FileResult) -> list[DocumentResult]:
    """Of an input with mistakes the documents that have none; where the text itself is broken, no document can be told."""
    broken = {problem.span for judged in linted.documents for problem in judged.document.problems}
    if any(finding.fatal and finding.span not in broken for finding in linted.findings):
        return []
    return [judged for judged in linted.documents if not judged.document.problems]


def _costed(linted: FileResult, judged: DocumentResult, terms: Terms, counts: Sequence[int], fixed: Fixed | None) -> Costed:
    document, device = judged.document, judged.device
    cost = frame_cost(Frame(document), device, terms)
    others = variants(document, device, terms, counts)
    mended = fixed(linted, judged, terms) if fixed is not None else None
    return Costed(linted.file, judged.number, len(linted.documents), cost, others, mended)


def with_fixes(linted: FileResult, judged: DocumentResult, terms: Terms) -> FrameCost | None:
    """The cost of a document's frame with all fixes of its findings, also those that are only shown; None if there are no fixes."""
    from .fixes.document_fixes import DocumentFixes
    from .prices import cost_with_fixes

    return cost_with_fixes(DocumentFixes(judged, editable=not linted.is_code), linted.findings, terms)
