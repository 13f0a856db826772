"""`msaa-lint cost`."""

from __future__ import annotations

import os
import sys
from functools import partial
from typing import IO

from msaa_lint.core.execution.backend import Unusable
from msaa_lint.core.finding import Result
from msaa_lint.core.project import shown
from msaa_lint.core.quote import quoted
from msaa_lint.core.spool import SpoolError
from msaa_lint.frame.cost.amounts import Terms
from msaa_lint.frame.cost.input_cost import CostComparison, compare_inputs
from msaa_lint.frame.cost.samples import COUNTS
from msaa_lint.frame.cost.variants import DEFAULT_COUNTS
from msaa_lint.linter.cost_run import CostResult, run_costs
from msaa_lint.linter.request import Request

from .common import (
    Target,
    UsageError,
    figure_format,
    input_options,
    note,
    overrides,
    parse_list,
    parse_outputs,
    parse_size,
    refuse_inputs,
    report_module,
    report_options,
    run_command,
    write_figure,
    write_output,
)  # fmt: skip
from .options import COST_FORMATS, Arguments
from .report.escape import escape

MAX_SIDE = 2**31 - 1
"""Width and height of a frame, in pixels."""


def cost(arguments: Arguments) -> int:
    """Prints what inputs cost; returns 0, or 2 if an input, an option, or the configuration cannot
    be used.
    """
    return run_command(_cost, arguments, (Unusable, SpoolError), terminable="backend" in arguments)


def _cost(arguments: Arguments) -> int:
    targets = parse_outputs(arguments.get("output", ()), COST_FORMATS, "markdown=cost.md") or [
        Target("full", None)
    ]
    terms = parse_terms(arguments)
    counts = (
        parse_list(arguments["samples"], "--samples", {str(n): n for n in COUNTS})
        if "samples" in arguments
        else DEFAULT_COUNTS
    )
    chart = arguments.get("chart")
    if chart is not None:
        figure_format(chart, "--chart")
    formats = [target.format for target in targets]
    request = Request(**input_options(arguments), overrides=overrides(arguments), formats=formats)
    result = run_costs(request, terms, counts)
    comparison = None if arguments.get("each") else _comparison(result, request)
    for text in result.notes:
        note(text)
    _print_errors(result.errors, arguments)
    if comparison is not None:
        _require_figures(comparison)
    refuse_inputs([*(target.path for target in targets), chart], result.errors.files)
    for target in targets:
        write_output(target.path, partial(_render, target.format, result, comparison, arguments))
    if chart is not None:
        _draw_chart(chart, result, comparison)
    return 2 if result.errors.findings else 0


def _comparison(result: CostResult, request: Request) -> CostComparison | None:
    """The comparison of two files; None for other inputs, and if one of the two cannot be used: the
    other is then shown alone.
    """
    if len(request.paths) != 2 or any(os.path.isdir(path) for path in request.paths):
        return None
    old, new = (request.input_name(path) if path == "-" else shown(path) for path in request.paths)
    old_frames, new_frames = result.of(old), result.of(new)
    return compare_inputs(old, old_frames, new, new_frames) if old_frames and new_frames else None


def _require_figures(comparison: CostComparison) -> None:
    """UsageError if what a pass of the two inputs costs is unknown: a difference between lower
    bounds says nothing.
    """
    for frame in (*comparison.old, *comparison.new):
        for costs in frame.cost.passes:
            if costs.unknown:
                reasons = "; ".join(costs.unknown)
                option = ", or give --size WxH" if costs.width is None else ""
                raise UsageError(
                    f"{frame.file}: cannot be compared, because the cost of `{costs.name}` is "
                    f"unknown: {reasons}{option}"
                )


def parse_terms(arguments: Arguments) -> Terms:
    """The terms that the options state."""
    width, height = parse_size(arguments["size"], MAX_SIDE) if "size" in arguments else (None, None)
    return Terms(
        fps=arguments.get("fps"),
        width=width,
        height=height,
        milliwatts_per_gbps=arguments.get("milliwatts_per_gbps"),
        budget_milliwatts=_parse_power(arguments["budget"]) if "budget" in arguments else None,
    )


def _parse_power(text: str) -> float:
    """Milliwatts of `2500mW`, `2.5W`."""
    from msaa_lint.linter.settings.cost_limit import budget

    try:
        return budget(text, ("power",)).most
    except ValueError as error:
        raise UsageError(f"invalid power {quoted(text)} in `--budget`: {error}") from None


def _print_errors(errors: Result, arguments: Arguments) -> None:
    """Prints inputs that cannot be used as `check` prints them, to the standard error stream."""
    if not errors.findings:
        return
    from .report import concise, full

    options = report_options(arguments, sys.stderr, width=0)
    for finding in errors.findings:
        if sys.stderr.isatty():
            print(full.paragraph(finding, errors, options, set()) + "\n", file=sys.stderr)
        else:
            print(concise.line(finding, errors, options), file=sys.stderr)


def _render(
    format: str,
    result: CostResult,
    comparison: CostComparison | None,
    arguments: Arguments,
    out: IO[str],
) -> None:
    options = report_options(arguments, out, color=format == "full")
    report = report_module("cost", format)
    if comparison is not None:
        report.render_comparison(comparison, result.errors, out.write, options)
    else:
        report.render(result.frames, result.errors, out.write, options)


def _draw_chart(path: str, result: CostResult, comparison: CostComparison | None) -> None:
    from .report import cost_chart
    from .report.cost_rows import head
    from .report.paths import display_path

    frames = result.frames
    if comparison is not None and len(comparison.old) == len(comparison.new) == 1:
        bars, frame = cost_chart.compared_bars(comparison), comparison.new[0]
        title = f"{display_path(comparison.old_file, '')} → {display_path(frame.file, '')}"
    elif comparison is None and len(frames) == 1:
        bars, frame = cost_chart.bars(frames[0]), frames[0]
        title = display_path(frame.file, "")
    elif frames:
        raise UsageError(f"--chart draws one frame, or two that are compared, not {len(frames)}")
    else:
        return
    write_figure(
        path,
        "--chart",
        partial(cost_chart.chart, bars, title, escape(head(frame.cost)), frame.cost),
    )
