"""Runs `cost`: the costs of the inputs of a request, found and read under the same configuration as for `check`."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from msaa_lint.core.finding import Result
from msaa_lint.frame.cost.amounts import Terms
from msaa_lint.frame.cost.input_cost import CostedFrame

from .costed_frames import costed_frames
from .input_summary import input_summary
from .results import DocumentResult, FileResult, can_try_fixes
from .savings import Trials
from .workspace import InputFile, Request, Workspace


class CostResult(NamedTuple):
    """The costs of the frames in order of the inputs; a result with the errors and nothing else; lines for standard error."""

    frames: Sequence[CostedFrame]
    errors: Result
    notes: Sequence[str]

    def of(self, file: str) -> list[CostedFrame]:
        """The frames of one input."""
        return [frame for frame in self.frames if frame.file == file]


def run_costs(request: Request, terms: Terms, counts: Sequence[int]) -> CostResult:
    """The costs of the inputs of a request, after fixes and with other sample counts.

    A problem of an input or the configuration is an error in the result; the other inputs still get their costs.
    """
    workspace = Workspace(request)
    discovered = workspace.discover()
    findings = workspace.findings
    frames: list[CostedFrame] = []
    notes = list(discovered.notes)
    for path in discovered.files:
        with workspace.guard(path):
            frames += _frames(workspace, path, terms, counts, notes)
    errors = [finding for finding in dict.fromkeys(findings) if finding.fatal]
    files = dict.fromkeys([*map(request.input_name, discovered.files), *(finding.file for finding in errors)])
    return CostResult(frames, Result(errors, [], [], list(files), workspace.sources, []), notes)


def _frames(workspace: Workspace, path: str, terms: Terms, counts: Sequence[int], notes: list[str]) -> list[CostedFrame]:
    """The frames of one input."""
    file = workspace.open(path)
    if file is None:
        return []
    steps = "html" in workspace.request.formats
    result = file.lint(prices=steps)
    errors = [finding for finding in result.findings if finding.fatal]
    workspace.findings.extend(errors)
    if result.source is None:
        return []
    workspace.sources[result.file] = result.source
    capture = input_summary(file.data, result).capture
    if capture is not None and capture.left_out:
        notes.append(f"{result.file}: the costs do not include {capture.left_out}")
    documents = _valid_documents(result) if errors else list(result.documents)
    trials = _trials(file, result) if not errors and can_try_fixes(result) else None
    if not can_try_fixes(result):
        notes.append(f"{result.file} is too large to try fixes: costs are those of the frame as written")
    return costed_frames(result, documents, trials, terms, counts, steps)


def _valid_documents(result: FileResult) -> list[DocumentResult]:
    """The documents without problems, of an input with errors; none of them if the text itself is broken."""
    spans = {problem.span for document in result.documents for problem in document.document.problems}
    if any(finding.fatal and finding.span not in spans for finding in result.findings):
        return []
    return [document for document in result.documents if not document.document.problems]


def _trials(file: InputFile, result: FileResult) -> Trials | None:
    """The fixes of an input, as `check` makes them; None if it has none."""
    if not any(finding.fix is not None for finding in result.findings):
        return None
    from .savings import try_fixes

    description, lint = file.description(result)
    return try_fixes(description, lint, file.fixable(result))
