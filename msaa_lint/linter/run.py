"""Runs `check`: lints every input of a request, and fixes it if asked to. The command line and
`msaa_lint.lint` both use it.
"""

import os
from collections.abc import Callable, Iterator, Mapping, Sequence, Set
from functools import partial
from itertools import chain
from typing import TYPE_CHECKING, NamedTuple

from msaa_lint.core.finding import InputSummary, PassTraffic, Result, Savings, Suppressed, Undecided
from msaa_lint.core.garbage import collect_garbage
from msaa_lint.core.spool import SpooledDict, SpooledList

from .engine import rule_infos
from .input_runs import is_worth_keeping
from .part_linter import Contents, PartLinter, Results
from .request import Request
from .run_findings import RunFindings
from .run_part import RunPart
from .run_report import Render, RunReport
from .settings.settings import TABLE_FORMATS, Settings
from .source_programs import units_of
from .unit_parts import parts
from .workspace import Unit, Workspace

if TYPE_CHECKING:
    from msaa_lint.frame.cost.input_cost import CostedFrame

    from .fixes.file_fixes import FixedText
    from .suppress.baseline import Baseline

Progress = Callable[[int, int, str], None]
"""Called before each input with the number of inputs done, the number of all inputs, and the
input's path.
"""

_UNSUMMARIZED_FORMATS = frozenset({"gitlab", "azure", "teamcity", "rdjson", "junit"})

PRICED_FORMATS = _UNSUMMARIZED_FORMATS.union(TABLE_FORMATS) | {
    "full",
    "json",
    "sarif",
    "github",
    "markdown",
    "statistics",
    "html",
}
"""The outputs that show prices; for the others prices are not computed."""

RULE_PAGE_FORMATS = frozenset({"sarif", "html"})
"""The outputs that contain the pages of rules."""

SUMMARIZED_FORMATS = PRICED_FORMATS - _UNSUMMARIZED_FORMATS | {"concise"}
"""The outputs that say what fixes save; for the others fixes are not tried."""


class Outcome(NamedTuple):
    """The result of a run.

    `settings` are those of the current folder, with the outputs and thresholds; `notes` are lines
    for standard error. `fixed` has the fixed text of each input, `failing` by file what fixes save
    of the findings that can fail the run. `frames` are the frames of the inputs with their costs,
    if an output shows them. `passes` is what passes move, `owners` names the inputs whose passes
    findings in other files are about, and `configuration` is a name for the settings of the inputs,
    if an output has rows of them.
    """

    result: Result
    settings: Settings
    notes: Sequence[str]
    fixed: "Sequence[FixedText]" = ()
    failing: Mapping[str, Savings] = {}
    frames: "Sequence[CostedFrame]" = ()
    passes: Sequence[PassTraffic] = ()
    owners: Mapping[str, Sequence[str]] = {}
    configuration: str = ""


def run(
    request: Request, progress: Progress | None = None, results: Results | None = None
) -> Outcome:
    """Lints every input of a request. A problem of an input, a rule page or the configuration is a
    finding, never an exception.
    """
    return _Run(request, results).run(progress)


class _Run:
    def __init__(self, request: Request, results: Results | None) -> None:
        self.request = request
        self.workspace = Workspace(request)
        self.settings = self.workspace.current.settings
        self.baseline = self._load_baseline()
        outputs = set(
            request.formats
            or [text.partition("=")[0] for text in self.settings.output]
            or [request.fallback]
        )
        limited = self.settings.fail_on_cost is not None
        contents = Contents(
            prices=request.by_price or limited or not PRICED_FORMATS.isdisjoint(outputs),
            savings=limited
            or request.fix is not None
            or not SUMMARIZED_FORMATS.isdisjoint(outputs),
            frames="html" in outputs,
            passes=not outputs.isdisjoint(TABLE_FORMATS),
        )
        render = self._render(outputs, results is not None)
        self.linter = PartLinter(self.workspace, contents, self.baseline, results, render)
        self.report = RunReport(self.workspace, render) if render is not None else None
        self.with_pages = request.full_rules or not RULE_PAGE_FORMATS.isdisjoint(outputs)
        self.frames: list[CostedFrame] = []
        spool = self.workspace.spool
        self.findings = RunFindings(self.workspace)
        self.passes: SpooledList[PassTraffic] = SpooledList(spool)
        self.owners: dict[str, list[str]] = {}
        self.undecided: SpooledList[Undecided] = SpooledList(spool)
        self.suppressed: SpooledList[Suppressed] = SpooledList(spool)
        self.accepted: SpooledList[Suppressed] = SpooledList(spool)
        self.summaries: SpooledDict[InputSummary] = SpooledDict(spool)
        self.savings: SpooledDict[Savings] = SpooledDict(spool)
        self.untried: dict[str, bool] = {}
        self.failing: SpooledDict[Savings] = SpooledDict(spool)
        self.fixed: list[FixedText] = []
        self.notes: list[str] = []

    def _render(self, outputs: Set[str], has_callback: bool) -> Render | None:
        """What renders the report input by input, if that is possible: findings need not be known
        all at once.
        """
        request = self.request
        if (
            len(outputs) > 1
            or self.baseline is not None
            or request.by_price
            or request.fix is not None
            or has_callback
        ):
            return None
        renderer = request.renderers.get(next(iter(outputs)))
        return partial(renderer, docs_url=self.settings.docs_url) if renderer is not None else None

    def _load_baseline(self) -> "Baseline | None":
        if self.settings.baseline is None or self.request.without_baseline:
            return None
        from .suppress import baseline

        loaded = baseline.load(self.settings.baseline, self.settings.project("baseline"))
        if isinstance(loaded, baseline.Baseline):
            return loaded
        self.workspace.findings.extend(loaded.findings)
        self.workspace.sources.update(loaded.sources)
        return None

    def run(self, progress: Progress | None) -> Outcome:
        discovered = self.workspace.discover(sources=True)
        files = [self.request.input_name(path) for path in discovered.files]
        self.findings.begin(files)
        units = units_of(discovered.files, self.workspace.programs(discovered))
        done = 0
        parts = self._parts(units)
        for unit in units:
            paths = [unit] if isinstance(unit, str) else unit.inputs
            if progress is not None:
                progress(done, len(files), paths[0])
            names = list(map(self.request.input_name, paths))
            self._add(next(parts), names)
            done += len(paths)
            collect_garbage()
        notes = [
            *discovered.notes,
            *self.notes,
            *self._stale_entries(files),
            *self.workspace.close(),
        ]
        current, spool = self.workspace.current, self.workspace.spool
        if self.report is not None:
            rendered = self.report.finish(self.findings.in_order())
            result = Result(
                (),
                (),
                (),
                files,
                {},
                (),
                self.savings.finished(),
                untried=self.untried,
                rendered=rendered,
            )
            return Outcome(result, self.settings, notes, failing=self.failing.finished())
        rules = rule_infos(
            current.engine.registry, current.selection.for_file(os.curdir), self.with_pages
        )
        findings = self.findings.by_price() if self.request.by_price else self.findings.by_file()
        suppressed = SpooledList(spool, chain(self.suppressed, self.accepted))
        result = Result(
            SpooledList(spool, findings).finished(),
            self.undecided.finished(),
            suppressed.finished(),
            files,
            self.workspace.sources.finished(),
            rules,
            self.savings.finished(),
            self.baseline is not None,
            SpooledList(spool, (self.summaries[file] for file in files)).finished(),
            self.untried,
        )
        passes, configuration = self.passes.finished(), self._configuration()
        return Outcome(
            result,
            self.settings,
            notes,
            self.fixed,
            self.failing.finished(),
            self.frames,
            passes,
            self.owners,
            configuration,
        )

    def _parts(self, units: Sequence[Unit]) -> Iterator[RunPart]:
        """What the units add to the result, in their order."""
        request = self.request
        if (
            request.fix is not None
            or request.log is not None
            or request.traceback
            or self.linter.has_callback
        ):
            # These have effects in this process, in the order of the inputs.
            return parts(self.linter, units)
        depends_on = self._parts_depend_on()
        cache = (
            self.workspace.cache
            if depends_on is not None and is_worth_keeping(self.workspace, units)
            else None
        )
        if cache is None or depends_on is None:
            return parts(self.linter, units, request.division)
        from .kept_parts import KeptParts

        return parts(KeptParts(self.linter, cache, depends_on), units, request.division)

    def _parts_depend_on(self) -> str | None:
        """What the parts of inputs depend on besides their files and settings; None if they are not
        kept, which have no frames.
        """
        if self.linter.contents.frames:
            return None
        request, settings = self.request, self.settings
        accepted = (
            (settings.fail_confidence, self.baseline) if settings.fail_on_cost is not None else None
        )
        stated = (
            request.ignores,
            request.format,
            request.frame_end,
            request.keys,
            request.all_keys,
            request.edits,
            settings.min_severity,
        )
        rendered = self.linter.render is not None and self.settings.docs_url
        return repr((self.linter.contents, stated, accepted, rendered))

    def _add(self, part: RunPart, names: Sequence[str]) -> None:
        """Adds what the inputs of these names add to the result of the run, after the baseline."""
        if self.report is not None and part.rendered is not None:
            self.findings.add(part.problems, part.rendered.findings)
            self.report.add(part.rendered, {name: self.findings.number(name) for name in names})
        else:
            findings, accepted = self.linter.apply_baseline(part.findings)
            self.findings.add(part.problems, [*part.diagnostics, *findings])
            self.accepted.extend(accepted)
            self.undecided.extend(part.undecided)
            self.suppressed.extend(part.suppressed)
            unknown = {
                name: InputSummary(name, failed=True)
                for name in names
                if name not in self.summaries
            }
            self.summaries.update(unknown | {summary.file: summary for summary in part.summaries})
            self.workspace.sources.update(part.sources)
        self.savings.update(part.savings)
        self.failing.update(part.failing)
        self.untried.update(part.untried)
        self.frames.extend(part.frames)
        self.passes.extend(part.passes)
        for file, owner in part.owners.items():
            self.owners.setdefault(file, []).append(owner)
        self.notes.extend(part.notes)
        self.fixed.extend(part.fixed)

    def _configuration(self) -> str:
        """A name for the settings of the inputs, if an output has rows of them."""
        if not self.linter.contents.passes:
            return ""
        from .configuration_digest import configuration_digest

        return configuration_digest(self.request, self.workspace.resolved)

    def _stale_entries(self, files: Sequence[str]) -> list[str]:
        """A line for each entry of the baseline that counts more findings than there are."""
        if self.baseline is None:
            return []
        from .suppress import baseline

        findings = chain(self.findings, (each.finding for each in self.accepted))
        return list(
            map(
                str,
                baseline.stale(
                    self.baseline, findings, files, self.workspace.current.selection.names()
                ),
            )
        )
