"""Runs `cost`: the costs of the inputs of a request, found and read under the same configuration as
for `check`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import NamedTuple

from msaa_lint.core.finding import Finding, Result
from msaa_lint.core.spool import SpooledList
from msaa_lint.core.text.source import Source
from msaa_lint.frame.cost.amounts import Terms
from msaa_lint.frame.cost.input_cost import CostedFrame

from .costed_frames import costed_frames
from .input_file import InputFile
from .input_summary import input_summary
from .request import ALONE, Request
from .results import DocumentResult, FileResult, can_try_fixes
from .rules.budget import Spent
from .savings import Trials
from .unit_parts import parts
from .workspace import Unit, Workspace

MAX_FRAMES = 50
"""The number of frames with their costs that stay in memory: each takes some ten kilobytes."""


class CostResult(NamedTuple):
    """The costs of the frames in order of the inputs; a result with the errors and nothing else;
    lines for standard error.
    """

    frames: Sequence[CostedFrame]
    errors: Result
    notes: Sequence[str]

    def of(self, file: str) -> list[CostedFrame]:
        """The frames of one input."""
        return [frame for frame in self.frames if frame.file == file]


def run_costs(request: Request, terms: Terms, counts: Sequence[int]) -> CostResult:
    """The costs of the inputs of a request, after fixes and with other sample counts.

    A problem of an input or the configuration is an error in the result; the other inputs still get
    their costs.
    """
    workspace = Workspace(request)
    discovered = workspace.discover()
    frames: SpooledList[CostedFrame] = SpooledList(workspace.spool, limit=MAX_FRAMES)
    findings: list[Finding] = []
    notes = list(discovered.notes)
    for part in parts(
        CostLinter(workspace, terms, counts),
        discovered.files,
        ALONE if request.traceback else request.division,
    ):
        frames.extend(part.frames)
        findings.extend(part.errors)
        workspace.sources.update(part.sources)
        notes.extend(part.notes)
    errors = [
        finding for finding in dict.fromkeys([*workspace.findings, *findings]) if finding.fatal
    ]
    files = dict.fromkeys(
        [*map(request.input_name, discovered.files), *(finding.file for finding in errors)]
    )
    return CostResult(
        frames.finished(),
        Result(errors, [], [], list(files), workspace.sources.finished(), []),
        notes,
    )


class CostPart(NamedTuple):
    """What an input adds to the result. `errors` are its problems, `sources` has the text that they
    are about.
    """

    frames: Sequence[CostedFrame] = ()
    errors: Sequence[Finding] = ()
    sources: Mapping[str, Source] = {}
    notes: Sequence[str] = ()
    spent: Spent = Spent()


class CostLinter:
    """Determines the costs of the inputs of a workspace one by one."""

    def __init__(self, workspace: Workspace, terms: Terms, counts: Sequence[int]) -> None:
        self.workspace = workspace
        self._terms = terms
        self._counts = counts

    def part(self, unit: Unit) -> CostPart:
        """The costs of the frames of an input, which is not a program."""
        part = CostPart()
        with self.workspace.reading(unit) as read, self.workspace.guard(str(unit)):
            file = self.workspace.open(str(unit))
            if file is not None:
                part = self._costs(file)
        return part._replace(errors=[*read.findings, *part.errors], spent=read.spent)

    def known(self, units: Sequence[Unit]) -> Mapping[int, CostPart]:
        """Costs are not kept between runs."""
        return {}

    def included(self, part: CostPart) -> bool:
        """Whether custom rules may take what they took for a part in another process, which then
        counts here.
        """
        return self.workspace.include(part.spent)

    def failed(self, unit: Unit, reason: str) -> CostPart:
        """What an input adds that ended the processes that read it."""
        return CostPart(errors=[self.workspace.not_read(unit, reason)])

    def travelling(self) -> Callable[[Workspace], CostLinter]:
        """Creates such a linter in another process."""
        return partial(CostLinter, terms=self._terms, counts=self._counts)

    def _costs(self, file: InputFile) -> CostPart:
        steps = "html" in self.workspace.request.formats
        result = file.lint(prices=steps)
        errors = [finding for finding in result.findings if finding.fatal]
        if result.source is None:
            return CostPart(errors=errors)
        notes = []
        capture = input_summary(file.data, result).capture
        if capture is not None and capture.left_out:
            notes.append(f"{result.file}: the costs do not include {capture.left_out}")
        documents = _valid_documents(result) if errors else list(result.documents)
        trials = _trials(file, result) if not errors and can_try_fixes(result) else None
        if not can_try_fixes(result):
            notes.append(
                f"{result.file} is too large to try fixes: costs are those of the frame as written"
            )
        frames = costed_frames(result, documents, trials, self._terms, self._counts, steps)
        return CostPart(frames, errors, {result.file: result.source} if errors else {}, notes)


def _valid_documents(result: FileResult) -> list[DocumentResult]:
    """The documents without problems, of an input with errors; none of them if the text itself is
    broken.
    """
    spans = {
        problem.span for document in result.documents for problem in document.document.problems
    }
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
