"""Runs `check`: lints every input of a request, and fixes it if asked to. The command line and `msaa_lint.lint` both use it."""

import os
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

from msaa_lint.core.diagnostics import diagnostic
from msaa_lint.core.finding import Finding, InputSummary, Result, Savings, Suppressed, Undecided, is_confident, rank
from msaa_lint.core.garbage import collect_garbage
from msaa_lint.core.text.source import Source
from msaa_lint.input.file_types import STDIN

from .engine import rule_infos
from .input_summary import input_summaries
from .results import FileResult, can_try_fixes, finding_kind, price_order
from .run_part import RunPart
from .settings.settings import Settings
from .source_programs import ProgramInput
from .workspace import InputFile, Request, Workspace

if TYPE_CHECKING:
    from msaa_lint.frame.cost.input_cost import CostedFrame

    from .fixes.file_fixes import FixedText
    from .program_runs import ProgramRuns
    from .savings import Trials
    from .suppress.baseline import Baseline

Results = Callable[[InputFile, FileResult], None]
"""Called with each input that was linted, and its result."""

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
        self.results = results
        self.workspace = Workspace(request)
        self.settings = self.workspace.current.settings
        self.baseline = self._load_baseline()
        outputs = request.formats or [text.partition("=")[0] for text in self.settings.output] or [request.fallback]
        limited = self.settings.fail_on_cost is not None
        self.with_prices = request.by_price or limited or not PRICED_FORMATS.isdisjoint(outputs)
        self.with_savings = limited or request.fix is not None or not SUMMARIZED_FORMATS.isdisjoint(outputs)
        self.with_frames = "html" in outputs
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
        programs = self.workspace.programs(discovered)
        numbers = {path: number for number, program in enumerate(programs) for path in program.inputs}
        done: set[int] = set()
        runs = self._program_runs(programs)
        try:
            for number, path in enumerate(discovered.files):
                if progress is not None:
                    progress(number, len(discovered.files), path)
                if runs is not None and path in numbers and numbers[path] not in done:
                    done.add(numbers[path])
                    self._add(runs.part(numbers[path]))
                name = self.request.input_name(path)
                if name not in self.summaries and path not in self.workspace.failed:
                    with self.workspace.guard(path):
                        self._run_input(path)
                self.summaries.setdefault(name, InputSummary(name, failed=True))
                collect_garbage()
        finally:
            if runs is not None:
                runs.close()
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

    def _program_runs(self, programs: Sequence[ProgramInput]) -> "ProgramRuns | None":
        """The results for programs; None if there are none."""
        if not programs:
            return None
        from .program_runs import ProgramRuns

        return ProgramRuns(self.workspace, programs, self._lint_program, self._result_depends_on())

    def _result_depends_on(self) -> str | None:
        """What the result for an input depends on besides its content and settings; None if it has other effects, or depends on other
        inputs."""
        if self.request.fix is not None or self.settings.fail_on_cost is not None or self.request.log or self.request.traceback:
            return None
        if self.with_frames:
            # The cache does not hold frames.
            return None
        return repr((self.with_prices, self.with_savings, self.request.ignores, self.settings.min_severity))

    def _lint_program(self, program: ProgramInput) -> RunPart:
        """Lints a program; empty if it cannot be read."""
        file = self.workspace.open_program(program)
        return self._lint(file) if file is not None else RunPart()

    def _run_input(self, path: str) -> None:
        file = self.workspace.open(path)
        if file is not None:
            self._add(self._lint(file))

    def _lint(self, file: InputFile) -> RunPart:
        result = file.lint(prices=self.with_prices)
        if not isinstance(file.data, bytes):
            self.notes.extend(file.data.notes)
        if self.request.fix is not None:
            result = self._fix(file, result)
        if self.results is not None:
            self.results(file, result)
        return self._part(file, result)

    def _fix(self, file: InputFile, result: FileResult) -> FileResult:
        """Fixes an input; the result for its new contents, or the old result if it was not written."""
        from msaa_lint.input.source_file import SourceFile

        from .fixes.file_fixes import FixedText, fix_input

        is_stdin = file.path == STDIN
        if not isinstance(file.data, bytes):
            kind = "source code" if isinstance(file.data, SourceFile) else "a capture"
            self.notes.append(f"{file.name} is {kind} and is not fixed: `msaa-lint convert` writes a description that can be fixed")
            if is_stdin and isinstance(file.data, SourceFile):
                # The fixed text of standard input is printed: print it unchanged.
                text = file.data.source.text
                self.fixed.append(FixedText(file.name, text, text, file.data.data, result))
            return result
        if not is_stdin and not any(found.fix is not None for found in result.findings):
            return result
        write = self.request.fix == "write"
        if write and not is_stdin and os.path.exists(file.path) and not os.path.isfile(file.path):
            self.notes.append(f"{file.name} is not a regular file and is not fixed: name `-` to print the fixed text")
            return result
        target = file.path if write and not is_stdin else None
        fixed = fix_input(file.data, result, file.lint, file.fixable(result), self.request.unsafe_fixes, target)
        self.fixed.append(fixed)
        if fixed.write_error:
            self.findings.append(diagnostic("MSAA921", f"cannot write the fixed text: {fixed.write_error}", file.name))
        elif write and fixed.changed:
            return file.lint(fixed.data, prices=True) if self.with_prices else fixed.result
        return result

    def _part(self, file: InputFile, result: FileResult) -> RunPart:
        """What an input adds to the result of the run, after settings and before the baseline."""
        summaries = input_summaries(file.data, result)
        sources = _sources_shown(result)
        diagnostics: list[Finding] = []
        for summary in summaries:
            if summary.unread is not None:
                # The text of an input that creates something multisampled but shows no pass to check.
                source = result.sources.get(summary.file, result.source)
                sources |= {summary.file: source} if source is not None else {}
                if file.resolved.settings.strict_inputs:
                    help = "check a capture or a description of its frame instead, or exclude the file"
                    diagnostics.append(diagnostic("MSAA931", summary.unread.message, summary.file, summary.unread.span, help=help))
        findings = [found for found in map(file.resolved.selection.settle, result.findings) if found is not None]
        part = RunPart(diagnostics, findings, result.undecided, result.suppressed, summaries, sources)
        if not self.with_savings or all(found.fix is None for found in findings):
            return self._with_frames(part, result, None)
        if can_try_fixes(result) or self.settings.fail_on_cost is not None:
            return self._try_fixes(file, result, part)
        return self._with_frames(part._replace(untried={result.file: not isinstance(file.data, bytes)}), result, None)

    def _with_frames(self, part: RunPart, result: FileResult, trials: "Trials | None") -> RunPart:
        """Adds the frames of an input with their costs, if a report shows them; none of an input with errors."""
        if not self.with_frames or any(finding.fatal for finding in result.findings):
            return part
        from msaa_lint.frame.cost.amounts import Terms

        from .costed_frames import costed_frames

        return part._replace(frames=costed_frames(result, result.documents, trials, Terms(), (1,), steps=True))

    def _add(self, part: RunPart) -> None:
        """Adds what an input adds to the result of the run, after the baseline."""
        findings, accepted = self._apply_baseline(part.findings)
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

    def _try_fixes(self, file: InputFile, result: FileResult, part: RunPart) -> RunPart:
        """Determines what fixes of an input save, and adds to its findings the reasons why fixes are not made."""
        from .savings import savings, try_fixes

        description, lint = file.description(result)
        converted = not isinstance(file.data, bytes)
        fixable = file.fixable(result)
        trials = try_fixes(description, lint, fixable)
        part = part._replace(savings={result.file: savings(description, trials, self.with_prices, converted)})
        part = self._with_frames(part, result, trials)
        if self.settings.fail_on_cost is not None:
            findings, _ = self._apply_baseline(part.findings)
            failing = {finding_kind(found) for found in findings if is_confident(found, self.settings.fail_confidence)}
            if len(failing) < len({finding_kind(found) for found in part.findings}):
                trials = try_fixes(description, lint, lambda found: finding_kind(found) in failing and fixable(found))
            part = part._replace(failing={result.file: savings(description, trials, True, converted)})
        refusals = {finding_kind(failed.finding): failed.reason for failed in trials.all.failed_fixes}
        findings = [
            found._replace(fix=found.fix._replace(refusal=refusals.get(finding_kind(found), ""))) if found.fix else found
            for found in part.findings
        ]
        return part._replace(findings=findings)

    def _is_shown(self, found: Finding) -> bool:
        return found.fatal or rank(found.severity) >= rank(self.settings.min_severity)

    def _apply_baseline(self, findings: Sequence[Finding]) -> tuple[Sequence[Finding], Sequence[Suppressed]]:
        if self.baseline is None:
            return findings, ()
        from .suppress import baseline

        return baseline.apply(findings, self.baseline)

    def _stale_entries(self, files: Sequence[str]) -> list[str]:
        """A line for each entry of the baseline that counts more findings than there are."""
        if self.baseline is None:
            return []
        from .suppress import baseline

        findings = [*self.workspace.findings, *self.findings, *(each.finding for each in self.accepted)]
        return list(map(str, baseline.stale(self.baseline, findings, files, self.workspace.current.selection.names())))


def _sources_shown(result: FileResult) -> dict[str, Source]:
    """The texts that the findings of an input are about, of a program those of the files that they name."""
    if not result.sources:
        is_shown = result.findings or result.suppressed or result.undecided
        return {result.file: result.source} if result.source is not None and is_shown else {}
    findings = [*result.findings, *(entry.finding for entry in result.suppressed)]
    names = {file for finding in findings for file in (finding.file, *(label.file for label in finding.labels))}
    return {name: source for name, source in result.sources.items() if name in names}
