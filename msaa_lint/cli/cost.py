"""`msaa-lint cost`."""

from __future__ import annotations

import math
import os
import sys
from collections.abc import Mapping
from functools import partial
from typing import IO, Any, NamedTuple

from msaa_lint.core.finding import Result
from msaa_lint.core.package import VERSION
from msaa_lint.core.project import shown
from msaa_lint.frame.cost.amounts import Terms
from msaa_lint.frame.cost.input_cost import Compared, compared
from msaa_lint.frame.cost.samples import COUNTS
from msaa_lint.frame.cost.variants import DEFAULT_COUNTS
from msaa_lint.linter.cost_run import CostResult, name_of, run_costs, with_fixes
from msaa_lint.linter.run import Request

from .common import Mistake, Target, colored, ended, outputs, size, utf_8, written
from .report import Options
from .report.escape import visible

FORMATS = ("full", "json", "markdown")
MOST = 2**31 - 1
"""Pixels a side."""


def cost(given: Mapping[str, Any]) -> int:
    """Prints what inputs cost; 0, or 2 where an input, an option or the configuration could not be used."""
    return ended(_cost, given)


class Shown(NamedTuple):
    """What is printed: the frames, or the two inputs that are compared."""

    reckoned: CostResult
    compared: Compared | None


def _cost(given: Mapping[str, Any]) -> int:
    targets = outputs(given.get("output", ()), FORMATS, "markdown=cost.md") or [Target("full", None)]
    terms = terms_of(given)
    counts = sample_counts(given["samples"]) if "samples" in given else DEFAULT_COUNTS
    chart = given.get("chart")
    if chart is not None:
        chart_format(chart)
    request = Request(
        paths=given["paths"],
        overrides={"profile": given["profile"]} if "profile" in given else {},
        config=given.get("config"),
        isolated=bool(given.get("isolated")),
        format=given.get("input_format"),
        stdin_filename=given.get("stdin_filename"),
    )
    reckoned = run_costs(request, terms, counts, with_fixes)
    made = Shown(reckoned, _compared(reckoned, request, bool(given.get("each"))))
    for note in reckoned.notes:
        print(f"msaa-lint: {visible(note)}", file=sys.stderr)
    _print_errors(reckoned.wrong, given)
    for target in targets:
        written(target.path, partial(_render, target.format, made, given))
    if chart is not None:
        _draw(chart, made)
    return 2 if reckoned.wrong.findings else 0


def _compared(reckoned: CostResult, request: Request, each: bool) -> Compared | None:
    """Two inputs that are named and no folders are compared; where one of them cannot be used, the other is shown alone."""
    if each or len(request.paths) != 2 or any(os.path.isdir(path) for path in request.paths):
        return None
    old, new = (name_of(request, path) if path == "-" else shown(path) for path in request.paths)
    frames = reckoned.of(old), reckoned.of(new)
    return compared(old, frames[0], new, frames[1]) if all(frames) else None


def terms_of(given: Mapping[str, Any]) -> Terms:
    """How to reckon, by the options."""
    width, height = size(given["size"], MOST) if "size" in given else (None, None)
    return Terms(
        fps=_above_zero(given["fps"], "--fps") if "fps" in given else None,
        width=width,
        height=height,
        milliwatts_per_gbps=_above_zero(given["milliwatts_per_gbps"], "--milliwatts-per-gbps") if "milliwatts_per_gbps" in given else None,
        budget_milliwatts=_power(given["budget"]) if "budget" in given else Terms().budget_milliwatts,
    )


def sample_counts(text: str) -> list[int]:
    """The counts of `1,2,4`."""
    words = [word.strip() for word in text.split(",")]
    known = {str(count): count for count in COUNTS}
    wrong = [word for word in words if word not in known]
    if wrong:
        raise Mistake(f"--samples '{visible(text)}': numbers of {', '.join(known)} are due, with commas between")
    return [known[word] for word in words]


def _above_zero(value: float, option: str) -> float:
    if not (math.isfinite(value) and value > 0):
        raise Mistake(f"{option}: a number above 0 is due")
    return value


def _power(text: str) -> float:
    """Milliwatts of `2500`, `2500mW`, `2.5W`."""
    from msaa_lint.linter.settings.cost_limit import budget

    try:
        return _above_zero(float(text), "--budget")
    except ValueError:
        pass
    try:
        found = budget(text)
    except ValueError:
        found = None
    if found is None or found.measures != "power":
        raise Mistake(f"--budget '{visible(text)}': a power above 0 is due, as in 2500, 2500mW or 2.5W")
    return found.most


def _print_errors(wrong: Result, given: Mapping[str, Any]) -> None:
    """What could not be used, as `check` prints it, on the standard error stream."""
    if not wrong.findings:
        return
    terminal = sys.stderr.isatty()
    options = _options(given, sys.stderr, True)
    if terminal:
        from .report.full import paragraph

        lines = [paragraph(found, wrong, options, set()) + "\n" for found in wrong.findings]
    else:
        from .report.concise import line

        lines = [line(found, wrong, options) for found in wrong.findings]
    utf_8(sys.stderr)
    for text in lines:
        print(text, file=sys.stderr)


def _render(format: str, made: Shown, given: Mapping[str, Any], out: IO[str]) -> None:
    options = _options(given, out, format == "full")
    frames, wrong, both = made.reckoned.frames, made.reckoned.wrong, made.compared
    if format == "json":
        from .report import cost_json

        if both is not None:
            cost_json.render_comparison(both, wrong, out.write, options)
        else:
            cost_json.render(frames, wrong, out.write, options)
    elif format == "markdown":
        from .report import cost_markdown

        if both is not None:
            cost_markdown.render_comparison(both, out.write, options)
        else:
            cost_markdown.render(frames, wrong, out.write, options)
    else:
        from .report import cost_full

        if both is not None:
            cost_full.render_comparison(both, out.write, options)
        else:
            cost_full.render(frames, out.write, options)


def _options(given: Mapping[str, Any], out: IO[str], paints: bool) -> Options:
    terminal = out.isatty()
    width = 0
    if terminal:
        import shutil

        width = shutil.get_terminal_size().columns
    return Options(color=paints and colored(given.get("color", "auto"), terminal), width=width, version=VERSION)


def chart_format(path: str) -> str:
    """The format of a chart, by its file's ending."""
    from .report.cost_chart import FORMATS as KNOWN

    ending = os.path.splitext(path)[1].lower().removeprefix(".")
    if ending not in KNOWN:
        raise Mistake(f"--chart '{visible(path)}': the name of an .svg or .png file is due")
    return ending


def _draw(path: str, made: Shown) -> None:
    from .report import cost_chart as chart
    from .report.cost_rows import head
    from .report.paths import shown_path

    frames = made.reckoned.frames
    if made.compared is not None and len(made.compared.old) == len(made.compared.new) == 1:
        found, costed = chart.compared_bars(made.compared), made.compared.new[0]
        title = f"{shown_path(made.compared.old_file, '')} → {shown_path(costed.file, '')}"
    elif made.compared is None and len(frames) == 1:
        found, costed = chart.bars(frames[0]), frames[0]
        title = shown_path(costed.file, "")
    elif frames:
        raise Mistake(f"--chart: it is of one frame, or of two that are compared, not of {len(frames)}")
    else:
        return
    try:
        data = chart.draw(found, title, visible(head(costed.cost)), costed.cost, chart_format(path))
    except ModuleNotFoundError as error:
        if (error.name or "").partition(".")[0] != "matplotlib":
            raise
        raise Mistake("--chart needs matplotlib, which is not installed: pip install 'msaa-lint[chart]'") from None
    try:
        with open(path, "wb") as file:
            file.write(data)
    except OSError as error:
        raise Mistake(f"{visible(path)} cannot be written: {error.strerror}") from None
