"""Runs `check`: lints every input of a request, and fixes it if asked to. The command line and `msaa_lint.lint` both use it."""

import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

from msaa_lint.core.finding import Finding, InputSummary, Result, Savings, Suppressed, Undecided, rank
from msaa_lint.core.garbage import collect_garbage

from .engine import rule_infos
from .input_runs import is_worth_keeping
from .part_linter import Contents, PartLinter, Results
from .results import price_order
from .run_part import RunPart
from .settings.settings import Settings
from .source_programs import units_of
from .unit_parts import parts
from .workspace import Request, Unit, Workspace

if TYPE_CHECKING:
    from msaa_lint.frame.cost.input_cost import CostedFrame

    from .fixes.file_fixes import FixedText
    from .suppress.baseline import Baseline

Progress = Callable[[int, int, str], None]
"""Called before each input with the number of inputs done, the number of all inputs, and the input's path."""

_UNSUMMARIZED_FORMATS = frozenset({"gitlab", "azure", "teamcity", "rdjson", "junit"})

PRICED_FORMATS = _UNSUMMARIZED_FORMATS | {"full", "json", "sarif", "github", "markdown", "statistics", "html"}
"""The outputs that show prices; for the others prices are not computed."""

RULE_PAGE_FORMATS = frozenset({"sarif", "html"})
"""The outputs that contain the pages of rules."""

SUMMARIZED_FORMATS = PRICED_FORMATS - _UNSUMMARIZED_FORMATS | {"concise"}
"""The outputs that say what fixes save; for the others fixes are not tried."""


class Outcome(NamedTuple):
    """The result of a run.

    `settings` are those of the current folder, with the outputs and thresholds; `notes` are lines for standard error. `fixed` has the
    fixed text of each input, `failing` by file what fixes save of the findings that can fail the run. `frames` are the frames of the
    inputs with their costs, if an output shows them.
    """

    result: Result
    settings: Settings
    notes: Sequence[str]
    fixed: "Sequence[FixedText]" = ()
    failing: Mapping[str, Savings] = {}
    frames: "Sequence[CostedFrame]" = ()


def run(request: Request, progress: Progress | None = None, results: Results | None = None) -> Outcome:
    """Lints every input of a request. A problem of an input, a rule page or the configuration is a finding, never an exception."""
    return _Run(request, results).run(progress)


class _Run:
    def __init__(self, request: Request, results: Results | None) -> None:
        self.request = request
        self.workspace = Workspace(request)
        self.settings = self.workspace.current.settings
        self.baseline = self._load_baseline()
        outputs = request.formats or [text.partition("=")[0] for text in self.settings.output] or [request.fallback]
        limited = self.settings.fail_on_cost is not None
        contents = Contents(
            prices=request.by_price or limited or not PRICED_FORMATS.isdisjoint(outputs),
            savings=limited or request.fix is not None or not SUMMARIZED_FORMATS.isdisjoint(outputs),
            frames="html" in outputs,
        )
        self.linter = PartLinter(self.workspace, contents, self.baseline, results)
        self.with_pages = request.full_rules or not RULE_PAGE_FORMATS.isdisjoint(outputs)
        self.frames: list[CostedFrame] = []
        self.findings: list[Finding] = []
        self.undecided: list[Undecided] = []
        self.suppressed: list[Suppressed] = []
        self.accepted: list[Suppressed] = []
        self.summaries: dict[str, InputSummary] = {}
        self.savings: dict[str, Savings] = {}
        self.untried: dict[str, bool] = {}
        self.failing: dict[str, Savings] = {}
        self.fixed: list[FixedText] = []
        self.notes: list[str] = []

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
        units = units_of(discovered.files, self.workspace.programs(discovered))
        done = 0
        parts = self._parts(units)
        for unit in units:
            paths = [unit] if isinstance(unit, str) else unit.inputs
            if progress is not None:
                progress(done, len(discovered.files), paths[0])
            self._add(next(parts))
            for name in map(self.request.input_name, paths):
                self.summaries.setdefault(name, InputSummary(name, failed=True))
            done += len(paths)
            collect_garbage()
        self.workspace.close()
        files = [self.request.input_name(path) for path in discovered.files]
        notes = [*discovered.notes, *self.notes, *self._stale_entries(files)]
        # A broken rule page comes first: other findings of the configuration may be due to it.
        order = {**{file: number for number, file in enumerate(files)}, **dict.fromkeys(self.workspace.broken_pages(), -2)}
        # Two configurations may name the same broken rule page.
        settle = self.workspace.current.selection.settle
        of_run = [found for found in map(settle, self.workspace.findings) if found is not None]
        findings = [found for found in dict.fromkeys([*of_run, *self.findings]) if self._is_shown(found)]
        findings.sort(key=lambda found: (order.get(found.file, -1), found.file))
        if self.request.by_price:
            findings.sort(key=price_order)
        current = self.workspace.current
        rules = rule_infos(current.engine.registry, current.selection.for_file(os.curdir), self.with_pages)
        result = Result(
            findings,
            self.undecided,
            [*self.suppressed, *self.accepted],
            files,
            self.workspace.sources,
            rules,
            self.savings,
            self.baseline is not None,
            [self.summaries[file] for file in files],
            self.untried,
        )
        return Outcome(result, self.settings, notes, self.fixed, self.failing, self.frames)

    def _parts(self, units: Sequence[Unit]) -> Iterator[RunPart]:
        """What the units add to the result, in their order."""
        request = self.request
        if request.fix is not None or request.log is not None or request.traceback or self.linter.has_callback:
            # These have effects in this process, in the order of the inputs.
            return parts(self.linter, units)
        depends_on = self._parts_depend_on()
        cache = self.workspace.cache if depends_on is not None and is_worth_keeping(self.workspace, units) else None
        if cache is None or depends_on is None:
            return parts(self.linter, units, request.division)
        from .kept_parts import KeptParts

        return parts(KeptParts(self.linter, cache, depends_on), units, request.division)

    def _parts_depend_on(self) -> str | None:
        """What the parts of inputs depend on besides their files and settings; None if they are not kept, which have no frames."""
        if self.linter.contents.frames:
            return None
        request, settings = self.request, self.settings
        accepted = (settings.fail_confidence, self.baseline) if settings.fail_on_cost is not None else None
        stated = (request.ignores, request.format, request.frame_end, request.keys, request.all_keys, request.edits, settings.min_severity)
        return repr((self.linter.contents, stated, accepted))

    def _add(self, part: RunPart) -> None:
        """Adds what an input adds to the result of the run, after the baseline."""
        findings, accepted = self.linter.apply_baseline(part.findings)
        self.findings.extend([*part.diagnostics, *findings])
        self.accepted.extend(accepted)
        self.undecided.extend(part.undecided)
        self.suppressed.extend(part.suppressed)
        self.summaries.update((summary.file, summary) for summary in part.summaries)
        self.workspace.sources.update(part.sources)
        self.workspace.findings.extend(part.problems)
        self.workspace.failed.update(part.failed)
        self.savings.update(part.savings)
        self.failing.update(part.failing)
        self.untried.update(part.untried)
        self.frames.extend(part.frames)
        self.notes.extend(part.notes)
        self.fixed.extend(part.fixed)

    def _is_shown(self, found: Finding) -> bool:
        return found.fatal or rank(found.severity) >= rank(self.settings.min_severity)

    def _stale_entries(self, files: Sequence[str]) -> list[str]:
        """A line for each entry of the baseline that counts more findings than there are."""
        if self.baseline is None:
            return []
        from .suppress import baseline

        findings = [*self.workspace.findings, *self.findings, *(each.finding for each in self.accepted)]
        return list(map(str, baseline.stale(self.baseline, findings, files, self.workspace.current.selection.names())))
