"""`msaa-lint check`."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from functools import partial
from time import perf_counter
from typing import IO

from msaa_lint.core.diagnostics import diagnostic, internal_error
from msaa_lint.core.execution.backend import Unusable
from msaa_lint.core.finding import CONFIDENCES, Result, rank
from msaa_lint.core.spool import SpoolError
from msaa_lint.core.text.node import Limits
from msaa_lint.input.file_types import STDIN
from msaa_lint.linter.request import Request
from msaa_lint.linter.run import Outcome, Progress, run
from msaa_lint.linter.settings.settings import COMMAND_LINE, OUTPUT_FORMATS, TABLE_FORMATS, Settings

from .common import (
    Target,
    input_options,
    note,
    output_width,
    overrides,
    parse_outputs,
    refuse_inputs,
    report_module,
    report_options,
    run_command,
    use_color,
    warn,
    write_output,
)
from .options import CHECK_FORMATS, Arguments
from .progress import input_progress, shows_progress
from .report.by_input import RENDERERS
from .report.summary import ON_TILER, plural
from .table_outputs import check_table, paths_of, write_tables

EXAMPLE = "sarif=findings.sarif"

STDERR = "<standard error>"
"""The `path` of a target that is the standard error stream."""

_ROOTS = {
    "github": "GITHUB_WORKSPACE",
    "sarif": "GITHUB_WORKSPACE",
    "gitlab": "CI_PROJECT_DIR",
    "azure": "BUILD_SOURCESDIRECTORY",
}
"""The environment variables that hold the folder which an output's paths are relative to."""

SUMMARIZED_KEYS = 1000
"""Undecided rules whose missing keys the summary counts; --explain-undecided and JSON list those of
all.
"""


def check(arguments: Arguments) -> int:
    """Lints what the arguments name and prints the result; returns the exit code."""
    return run_command(_check, arguments, (Unusable, SpoolError), terminable="backend" in arguments)


def _check(arguments: Arguments) -> int:
    if arguments.get("watch"):
        from .watch import watch

        return watch(arguments, request(arguments), _check_once)
    return _check_once(arguments)


def _check_once(arguments: Arguments) -> int:
    targets = parse_outputs(arguments.get("output", ()), CHECK_FORMATS, EXAMPLE)
    for target in targets:
        check_table(target)
    refuse_inputs([path for target in targets for path in paths_of(target)], arguments["paths"])
    fallback = "full" if sys.stdout.isatty() else "concise"
    start = perf_counter()
    outcome = _outcome(
        request(arguments, targets, fallback),
        input_progress() if shows_progress(bool(arguments.get("quiet"))) else None,
    )
    if arguments.get("verbose"):
        warn(
            f"checked {plural(len(outcome.result.files), 'input')} in {perf_counter() - start:.2f} "
            "s"
        )
    if not targets:
        targets = parse_outputs(outcome.settings.output, OUTPUT_FORMATS, EXAMPLE) or [
            Target(fallback, None)
        ]
    for text in outcome.notes:
        note(text)
    if arguments.get("diff"):
        return _print_diff(targets, outcome, arguments)
    if arguments.get("fix"):
        targets = _print_fixes(targets, outcome, arguments)
    _print_reports(targets, outcome, arguments)
    code = exit_code(outcome, bool(arguments.get("exit_zero")))
    for line in _over_budget(outcome) if code == 1 else ():
        warn(line)
    for file, savings in outcome.failing.items():
        if savings.all.findings and savings.all.price is None:
            note(
                f"{file}: the sizes or formats that price its fixes are unknown, so --fail-on-cost "
                "does not apply to it"
            )
    return code


def _outcome(asked: Request, progress: Progress | None) -> Outcome:
    """The outcome of a run. If the run itself fails, that is its only finding: the formats that
    programs read are whole.
    """
    try:
        return run(asked, progress)
    except (Unusable, SpoolError):
        raise
    except Exception as error:
        if asked.traceback:
            raise
        finding = diagnostic("MSAA941", internal_error(error), COMMAND_LINE)
        return Outcome(Result([finding], [], [], [], {}, []), Settings(), [])


def _print_diff(targets: Sequence[Target], outcome: Outcome, arguments: Arguments) -> int:
    """Prints what fixes would change, and the reports that go to files; returns the exit code."""
    from .fix_report import fix_summary, print_diff

    changed = print_diff(outcome, use_color(arguments.get("color", "auto"), sys.stdout.isatty()))
    for line in fix_summary(outcome, False, bool(arguments.get("unsafe_fixes"))):
        note(line)
    _print_reports([target for target in targets if target.path is not None], outcome, arguments)
    if any(finding.fatal for finding in outcome.result.findings):
        return 2
    return int(changed and not arguments.get("exit_zero"))


def _print_fixes(targets: Sequence[Target], outcome: Outcome, arguments: Arguments) -> list[Target]:
    """Prints what fixes did. The fixed text of standard input goes to standard output, and what
    would go there to standard error: returns the targets that are left to print.
    """
    from .fix_report import fix_summary, print_text

    stdin = STDIN in arguments["paths"]
    if stdin:
        print_text(outcome, arguments.get("stdin_filename") or "<stdin>")
    for line in fix_summary(outcome, True, bool(arguments.get("unsafe_fixes"))):
        note(line)
    return [
        target._replace(path=STDERR) if stdin and target.path is None else target
        for target in targets
    ]


def request(
    arguments: Arguments, targets: Sequence[Target] = (), fallback: str = "concise"
) -> Request:
    """The request that arguments make. `fallback` is the output format if neither they nor a
    configuration names one.
    """
    settings = overrides(arguments)
    limits = {
        name: arguments[f"max_{name}"] for name in Limits._fields if f"max_{name}" in arguments
    }
    if limits:
        settings["limits"] = limits
    lists_keys = bool(arguments.get("explain_undecided")) or any(
        target.format == "json" for target in targets
    )
    return Request(
        **input_options(arguments),
        overrides=settings,
        ignores=not arguments.get("no_ignores"),
        formats=[
            *(target.format for target in targets),
            *(["statistics"] if arguments.get("statistics") else []),
        ],
        fallback=fallback,
        by_price=arguments.get("sort") == "price",
        fix="show" if arguments.get("diff") else "write" if arguments.get("fix") else None,
        unsafe_fixes=bool(arguments.get("unsafe_fixes")),
        keys=None if lists_keys else SUMMARIZED_KEYS,
        all_keys=lists_keys,
        renderers=RENDERERS,
    )


def exit_code(outcome: Outcome, exit_zero: bool = False) -> int:
    """2 if an input or the configuration cannot be used; 1 if a finding reaches `fail-on`, or an
    input's findings reach `fail-on-cost`, counting only findings that reach `fail-confidence`; else
    0.
    """
    result = outcome.result
    levels = (
        set(result.rendered.counts.levels)
        if result.rendered is not None
        else {finding.level for finding in result.findings}
    )
    if any(fatal for _, _, fatal in levels):
        return 2
    if exit_zero:
        return 0
    least, confidences = (
        rank(outcome.settings.fail_on),
        CONFIDENCES[CONFIDENCES.index(outcome.settings.fail_confidence) :],
    )
    failing = any(
        rank(severity) >= least and confidence in confidences for severity, confidence, _ in levels
    )
    return int(failing or bool(_over_budget(outcome)))


def _over_budget(outcome: Outcome) -> list[str]:
    """A line for each input of which fixes save as much as `fail-on-cost`, with how much that
    is.
    """
    if outcome.settings.fail_on_cost is None:
        return []
    from msaa_lint.linter.settings.cost_limit import budget, figure

    limit = budget(outcome.settings.fail_on_cost)
    lines = []
    for file, savings in outcome.failing.items():
        safe, everything = (
            figure(saving.price, limit) if saving.price is not None else 0.0
            for saving in (savings.safe, savings.all)
        )
        if everything >= limit.most:
            alone = f" ({safe:g} {limit.unit} with --fix alone)" if safe < everything else ""
            on_tiler = "," + ON_TILER if savings.all.assumes_tiler else ""
            lines.append(
                f"{file}: fixes save {everything:g} {limit.unit}{alone}, which reaches "
                f"--fail-on-cost {limit.text}{on_tiler}"
            )
    return lines


def _print_reports(targets: Sequence[Target], outcome: Outcome, arguments: Arguments) -> None:
    refuse_inputs(
        [path for target in targets if target.path != STDERR for path in paths_of(target)],
        outcome.result.files,
    )
    for target in targets:
        if target.format in TABLE_FORMATS:
            write_tables(target, outcome, arguments)
            continue
        render = partial(_render, target.format, outcome, arguments)
        if target.path == STDERR:
            render(sys.stderr)
        else:
            write_output(target.path, render)


def _render(format: str, outcome: Outcome, arguments: Arguments, out: IO[str]) -> None:
    from .report import render

    text = format in ("full", "concise")
    options = report_options(arguments, out, color=text, width=140)._replace(
        root=os.environ.get(_ROOTS.get(format, ""), ""),
        edition=outcome.settings.edition or "",
        show_suppressed=bool(arguments.get("show_suppressed")),
        fail_confidence=outcome.settings.fail_confidence,
        explain_undecided=bool(arguments.get("explain_undecided")),
        docs_url=outcome.settings.docs_url,
    )
    if (
        arguments.get("statistics")
        and text
        and out in (sys.stdout, sys.stderr)
        and outcome.result.findings
    ):
        from .report import statistics
        from .report.concise import line

        for finding in outcome.result.findings:
            if finding.fatal:
                print(line(finding, outcome.result, options), file=sys.stderr)
        statistics.render(outcome.result, out.write, options._replace(width=output_width(out)))
    elif format == "html":
        report_module("check", format).render(outcome.result, out.write, options, outcome.frames)
    else:
        render(
            format,
            outcome.result,
            out.write,
            options._replace(statistics=bool(arguments.get("statistics"))),
        )
