"""Lints one input, or the files of a program, and says what it adds to the result of a run."""

import os
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, NamedTuple

from msaa_lint.core.diagnostics import diagnostic
from msaa_lint.core.finding import Finding, Result, Suppressed, is_confident, rank
from msaa_lint.core.text.source import Source
from msaa_lint.core.urls import is_url
from msaa_lint.input.file_types import STDIN

from .input_file import InputFile
from .results import FileResult, can_try_fixes, finding_kind
from .run_part import RunPart
from .source_programs import ProgramInput
from .workspace import Unit, Workspace

if TYPE_CHECKING:
    from .run_report import Render
    from .savings import Trials
    from .suppress.baseline import Baseline

Results = Callable[[InputFile, FileResult], None]
"""Called with each input that was linted, and its result."""


class Contents(NamedTuple):
    """What a run determines of each input besides its findings: what fixes save, in all and as
    prices, its frames with their costs, and what its passes move.
    """

    prices: bool = False
    savings: bool = False
    frames: bool = False
    passes: bool = False


class PartLinter:
    """Lints the inputs of a workspace one by one. What it says of an input does not depend on the
    others, except that custom rules have one budget; `results` are called in this process. `render`
    renders what it says, if the report is rendered input by input.
    """

    def __init__(
        self,
        workspace: Workspace,
        contents: Contents,
        baseline: "Baseline | None" = None,
        results: Results | None = None,
        render: "Render | None" = None,
    ) -> None:
        self.workspace = workspace
        self.request = workspace.request
        self.settings = workspace.current.settings
        self.contents = contents
        self.baseline = baseline
        self.render = render
        self._results = results

    @property
    def has_callback(self) -> bool:
        """Whether this process is told the result of each input."""
        return self._results is not None

    def part(self, unit: Unit) -> RunPart:
        """Lints an input or a program; problems of its files are in the result, not in the
        workspace.
        """
        with self.workspace.reading(unit) as read:
            part = self._input(unit) if isinstance(unit, str) else self._program(unit)
        return self._rendered(part._replace(problems=read.findings, spent=read.spent))

    def known(self, units: Sequence[Unit]) -> Mapping[int, RunPart]:
        """Nothing is known from an earlier run."""
        return {}

    def included(self, part: RunPart) -> bool:
        """Whether custom rules may take what they took for a part in another process, which then
        counts here.
        """
        return self.workspace.include(part.spent)

    def failed(self, unit: Unit, reason: str) -> RunPart:
        """What an input or a program adds that ended the processes that read it."""
        return self._rendered(RunPart(problems=[self.workspace.not_read(unit, reason)]))

    def travelling(self) -> Callable[[Workspace], "PartLinter"]:
        """Creates such a linter in another process."""
        return partial(
            PartLinter, contents=self.contents, baseline=self.baseline, render=self.render
        )

    def _rendered(self, part: RunPart) -> RunPart:
        if self.render is None:
            return part
        least = rank(self.settings.min_severity)
        findings = [
            found
            for found in (*part.diagnostics, *part.findings)
            if found.fatal or rank(found.severity) >= least
        ]
        # A finding may be about a rule page.
        pages = {
            found.file for found in findings
        } - part.sources.keys() & self.workspace.sources.keys()
        sources = {**part.sources, **{page: self.workspace.sources[page] for page in pages}}
        result = Result(
            findings, part.undecided, part.suppressed, (), sources, (), inputs=part.summaries
        )
        return part._replace(
            diagnostics=(),
            findings=(),
            undecided=(),
            suppressed=(),
            summaries=(),
            sources={},
            rendered=self.render(result),
        )

    def _input(self, path: str) -> RunPart:
        with self.workspace.guard(path):
            file = self.workspace.open(path)
            if file is not None:
                return self._lint(file)
        return RunPart()

    def _program(self, program: ProgramInput) -> RunPart:
        """The files of a program, and those of its inputs that cannot be read together with the
        others.
        """
        part = RunPart()
        with self.workspace.guard(program.inputs[0]):
            file = self.workspace.open_program(program)
            if file is not None:
                part = self._lint(file)
        done = {summary.file for summary in part.summaries} | self.workspace.failed
        for path in program.inputs:
            if path not in done:
                part += self._input(path)
        return part

    def _lint(self, file: InputFile) -> RunPart:
        result = file.lint(prices=self.contents.prices)
        part = RunPart(notes=() if isinstance(file.data, bytes) else file.data.notes)
        if self.request.fix is not None:
            result, part = self._fix(file, result, part)
        if self._results is not None:
            self._results(file, result)
        return self._part(file, result, part)

    def _fix(
        self, file: InputFile, result: FileResult, part: RunPart
    ) -> tuple[FileResult, RunPart]:
        """Fixes an input; the result for its new contents, or the old result if it was not written,
        and what fixes add to the part.
        """
        from msaa_lint.input.source_file import SourceFile

        from .fixes.file_fixes import FixedText, fix_input

        is_stdin = file.path == STDIN
        if not isinstance(file.data, bytes):
            kind = "source code" if isinstance(file.data, SourceFile) else "a capture"
            note = (
                f"{file.name} is {kind} and is not fixed: `msaa-lint convert` writes a "
                "description that can be fixed"
            )
            part = part._replace(notes=[*part.notes, note])
            if is_stdin and isinstance(file.data, SourceFile):
                # The fixed text of standard input is printed: print it unchanged.
                text = file.data.source.text
                part = part._replace(
                    fixed=[FixedText(file.name, text, text, file.data.data, result)]
                )
            return result, part
        if not is_stdin and not any(found.fix is not None for found in result.findings):
            return result, part
        write = self.request.fix == "write"
        if write and not is_stdin and os.path.exists(file.path) and not os.path.isfile(file.path):
            note = (
                f"{file.name} is not a regular file and is not fixed: name `-` to print the "
                "fixed text"
            )
            return result, part._replace(notes=[*part.notes, note])
        if write and is_url(file.path):
            note = f"{file.name} is at a URL and is not fixed: `--diff` prints the changes"
            return result, part._replace(notes=[*part.notes, note])
        target = file.path if write and not is_stdin else None
        fixed = fix_input(
            file.data, result, file.lint, file.fixable(result), self.request.unsafe_fixes, target
        )
        part = part._replace(fixed=[fixed])
        if fixed.write_error:
            return result, part._replace(
                diagnostics=[
                    diagnostic(
                        "MSAA921", f"cannot write the fixed text: {fixed.write_error}", file.name
                    )
                ]
            )
        if write and fixed.changed:
            return file.lint(
                fixed.data, prices=True
            ) if self.contents.prices else fixed.result, part
        return result, part

    def _part(self, file: InputFile, result: FileResult, part: RunPart) -> RunPart:
        """What an input adds to the result of the run, after settings and before the baseline."""
        from .input_summary import input_summaries

        summaries = input_summaries(file.data, result)
        sources = _sources_shown(result)
        diagnostics: list[Finding] = [*part.diagnostics]
        for summary in summaries:
            if summary.unread is not None:
                # The text of an input that creates something multisampled but shows no pass to
                # check.
                source = result.sources.get(summary.file, result.source)
                sources |= {summary.file: source} if source is not None else {}
                if file.resolved.settings.strict_inputs:
                    help = (
                        "check a capture or a description of its frame instead, or exclude the file"
                    )
                    diagnostics.append(
                        diagnostic(
                            "MSAA931",
                            summary.unread.message,
                            summary.file,
                            summary.unread.span,
                            help=help,
                        )
                    )
        findings = [
            found
            for found in map(file.resolved.selection.settle, result.findings)
            if found is not None
        ]
        part = part._replace(
            diagnostics=diagnostics,
            findings=findings,
            undecided=result.undecided,
            suppressed=result.suppressed,
            summaries=summaries,
            sources=sources,
        )
        if self.contents.passes:
            from .pass_traffic import pass_traffic

            files = {
                found.file for found in (*findings, *(entry.finding for entry in result.suppressed))
            } - {result.file}
            part = part._replace(
                passes=pass_traffic(result), owners=dict.fromkeys(sorted(files), result.file)
            )
        if not self.contents.savings or all(found.fix is None for found in findings):
            return self._with_frames(part, result, None)
        if can_try_fixes(result) or self.settings.fail_on_cost is not None:
            return self._try_fixes(file, result, part)
        return self._with_frames(
            part._replace(untried={result.file: not isinstance(file.data, bytes)}), result, None
        )

    def _with_frames(self, part: RunPart, result: FileResult, trials: "Trials | None") -> RunPart:
        """Adds the frames of an input with their costs, if a report shows them; none of an input
        with errors.
        """
        if not self.contents.frames or any(finding.fatal for finding in result.findings):
            return part
        from msaa_lint.frame.cost.amounts import Terms

        from .costed_frames import costed_frames

        return part._replace(
            frames=costed_frames(result, result.documents, trials, Terms(), (1,), steps=True)
        )

    def _try_fixes(self, file: InputFile, result: FileResult, part: RunPart) -> RunPart:
        """Determines what fixes of an input save, and adds to its findings the reasons why fixes
        are not made.
        """
        from .savings import savings, try_fixes

        description, lint = file.description(result)
        converted = not isinstance(file.data, bytes)
        fixable = file.fixable(result)
        trials = try_fixes(description, lint, fixable)
        part = part._replace(
            savings={result.file: savings(description, trials, self.contents.prices, converted)}
        )
        part = self._with_frames(part, result, trials)
        if self.settings.fail_on_cost is not None:
            findings, _ = self.apply_baseline(part.findings)
            failing = {
                finding_kind(found)
                for found in findings
                if is_confident(found, self.settings.fail_confidence)
            }
            if len(failing) < len({finding_kind(found) for found in part.findings}):
                trials = try_fixes(
                    description,
                    lint,
                    lambda found: finding_kind(found) in failing and fixable(found),
                )
            part = part._replace(
                failing={result.file: savings(description, trials, True, converted)}
            )
        refusals = {
            finding_kind(failed.finding): failed.reason for failed in trials.all.failed_fixes
        }
        # What only comes about beside an unsafe fix is not made by `--fix` alone.
        only_beside = {
            finding_kind(failed.finding) for failed in trials.safe.failed_fixes
        } - refusals.keys()
        findings = []
        for found in part.findings:
            kind, fix = finding_kind(found), found.fix
            if fix is not None:
                found = found._replace(
                    fix=fix._replace(
                        safe=fix.safe and kind not in only_beside, refusal=refusals.get(kind, "")
                    )
                )
            findings.append(found)
        return part._replace(findings=findings)

    def apply_baseline(
        self, findings: Sequence[Finding]
    ) -> tuple[Sequence[Finding], Sequence[Suppressed]]:
        """The findings of an input that the baseline does not count, and those that it does."""
        if self.baseline is None:
            return findings, ()
        from .suppress import baseline

        return baseline.apply(findings, self.baseline)


def _sources_shown(result: FileResult) -> dict[str, Source]:
    """The texts that the findings of an input are about, of a program those of the files that they
    name.
    """
    if not result.sources:
        is_shown = result.findings or result.suppressed or result.undecided
        return {result.file: result.source} if result.source is not None and is_shown else {}
    findings = [*result.findings, *(entry.finding for entry in result.suppressed)]
    names = {
        file
        for finding in findings
        for file in (finding.file, *(label.file for label in finding.labels))
    }
    return {name: source for name, source in result.sources.items() if name in names}
