"""The report of a run that is rendered input by input, so that what is known of an input need not
leave the process that reads it.
"""

from collections.abc import Callable, Iterator, Mapping

from msaa_lint.core.finding import Finding, InputSummary, Result
from msaa_lint.core.rendered import RenderedFinding, RenderedPart, RenderedReport, no_counts
from msaa_lint.core.spool import SpooledList, SpooledSort

from .workspace import Workspace

Render = Callable[[Result], RenderedPart]
"""What renders what an input adds to a report."""


MAX_TEXTS = 100
"""The number of texts of inputs that stay in memory: those of undecided rules may be longer than
the input.
"""


class RunReport:
    """The texts of the inputs of a run, except their findings."""

    def __init__(self, workspace: Workspace, render: Render) -> None:
        spool = workspace.spool
        self._workspace = workspace
        self._render = render
        self._suppressed: SpooledList[str] = SpooledList(spool, limit=MAX_TEXTS)
        self._undecided: SpooledList[str] = SpooledList(spool, limit=MAX_TEXTS)
        self._inputs: SpooledSort[str] = SpooledSort(spool, 1)
        self._counts = no_counts()

    def add(self, part: RenderedPart, numbers: Mapping[str, int]) -> None:
        """Adds what inputs add to the report, whose numbers are stated by name. Those that it does
        not know could not be read.
        """
        unknown = [InputSummary(name, failed=True) for name in numbers if name not in part.inputs]
        for each in (
            part,
            *([self._render(Result((), (), (), (), {}, (), inputs=unknown))] if unknown else []),
        ):
            self._suppressed.extend(filter(None, [each.suppressed]))
            self._undecided.extend(filter(None, [each.undecided]))
            for name, text in each.inputs.items():
                self._inputs.add((numbers[name],), [text])
            self._counts.add(each.counts)

    def finish(self, findings: Iterator[Finding | RenderedFinding]) -> RenderedReport:
        """The report with these findings, and the inputs in the order of their numbers."""
        texts: SpooledList[str] = SpooledList(self._workspace.spool)
        for finding in findings:
            rendered = self._finding(finding) if isinstance(finding, Finding) else finding
            texts.append(rendered.text)
            self._counts.add_finding(rendered.level, rendered.file)
        inputs = (text for _, texts in self._inputs for text in texts)
        return RenderedReport(texts, self._suppressed, self._undecided, inputs, self._counts)

    def _finding(self, finding: Finding) -> RenderedFinding:
        """A finding about the configuration, a rule page, or an input that could not be read."""
        (rendered,) = self._render(
            Result([finding], (), (), (), self._workspace.sources, ())
        ).findings
        return rendered
