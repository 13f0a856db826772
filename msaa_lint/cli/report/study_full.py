"""The text report of `msaa-lint study`: a table per scene, its effects and advice, and the origin of the figures."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence

from rich.console import Console
from rich.text import Text

from msaa_lint.experiments.study.outcome import SceneSummary, Study
from msaa_lint.experiments.study.points import Point

from . import Options, Write
from .console import open_console
from .escape import display
from .summary import plural
from .tables import FIGURE, Column, Table, print_tables

MARK = "*"


def render(study: Study, out: Write, options: Options) -> None:
    """Prints each scene, then the origin of the figures."""
    console = open_console(out, options)
    for number, scene in enumerate(study.scenes):
        if number:
            console.print()
        _scene(scene, study, console, out, options)
    if study.scenes:
        console.print()
    for line in () if options.quiet else _summary(study):
        console.print(line, soft_wrap=True)


def _scene(scene: SceneSummary, study: Study, console: Console, out: Write, options: Options) -> None:
    points = study.of(scene.name)
    console.print(display(scene.name), style="bold", soft_wrap=True)
    if scene.description:
        console.print(display(scene.description), soft_wrap=True)
    if points:
        edges = f"{max(point.edge_pixels for point in points):,} of {study.size[0] * study.size[1]:,} pixels"
        console.print(f"{edges} {'are crossed by an edge' if scene.coverage else 'are compared by color'}", soft_wrap=True)
        console.print()
        _print_table(points, scene, out, options)
        console.print()
    for name, reason in scene.effects:
        console.print(f"effect {display(name)}" + (f": {display(reason)}" if reason else ""), soft_wrap=True)
    if not scene.effects:
        console.print("no effects: the scene needs none", soft_wrap=True)
    for failure in study.failed:
        if failure.scene == scene.name:
            console.print(f"{failure.technique.name} failed: {display(failure.reason)}", style="red", soft_wrap=True)
    for advice in study.advice:
        if advice.scene == scene.name:
            console.print(f"- {display(advice.text)} ({display(advice.reason)})", soft_wrap=True)


def _print_table(points: Sequence[Point], scene: SceneSummary, out: Write, options: Options) -> None:
    """Prints the points of a scene: in one table if it fits, else errors and costs in a table each."""
    columns = [name for name, text_of in _COLUMNS.items() if name not in _OPTIONAL or any(text_of(point) != "-" for point in points)]
    parts = [[name for name in columns if (name in _COSTS) is costs] for costs in (False, True)]
    whole = ([_table(points, scene, columns, gap)] for gap in (2, 1))
    print_tables(out, options, *whole, [_table(points, scene, part, 1) for part in parts if part])


def _table(points: Sequence[Point], scene: SceneSummary, columns: Sequence[str], gap: int) -> Table:
    titles = [name if scene.coverage else name.replace("edges", "color") for name in columns]
    rows = []
    for point in points:
        cells = [MARK if point.best else "", point.technique.name, *(_COLUMNS[name](point) for name in columns)]
        rows.append(("green" if point.best else "", [Text(cell) for cell in cells]))
    return Table([Column(""), Column("samples"), *(Column(title, FIGURE) for title in titles)], rows, gap)


def _number(value: float | None, digits: str) -> str:
    if value is None or math.isnan(value):
        return "-"
    if math.isinf(value):
        return "exact" if value > 0 else "-"
    return format(value, digits if abs(value) < 1e7 else ".3g")


_COLUMNS: dict[str, Callable[[Point], str]] = {
    "RMSE\nedges": lambda point: _number(point.rmse, ".4f"),
    "RMSE\nall": lambda point: _number(point.rmse_all, ".5f"),
    "worst": lambda point: _number(point.max_error, ".3f"),
    "bias": lambda point: _number(point.bias, "+.4f"),
    "PSNR dB\nlinear": lambda point: _number(point.psnr_db, ".1f"),
    "PSNR dB\ndisplay": lambda point: _number(point.psnr_display_db, ".1f"),
    "SSIM": lambda point: _number(point.ssim, ".4f"),
    "time\nms": lambda point: _number(point.time_ms, ".3g"),
    "time\nto 1x": lambda point: _number(point.ratio, ".2f"),
    "MB per\nframe": lambda point: _number(point.bytes_per_frame / 1e6 if point.bytes_per_frame is not None else None, ".1f"),
    "mW": lambda point: _number(point.milliwatts, ".0f"),
    "MiB": lambda point: _number(point.memory_mib, ".1f"),
}
_COSTS = frozenset({"time\nms", "time\nto 1x", "MB per\nframe", "mW", "MiB"})
_OPTIONAL = _COSTS | {"SSIM"}
"""Columns that are left out if nothing in them is known."""


def _summary(study: Study) -> Iterator[str]:
    size = f"{study.size[0]}x{study.size[1]}, vertices snapped to {study.bits} bits"
    if study.points:
        if study.device:
            yield f"{size}; times measured by the clock of {display(study.device)}"
            yield f"{MARK} Pareto-optimal: no other technique has less error in as little time"
        else:
            yield f"{size}; no times: --device NAME measures them"
            yield f"{MARK} Pareto-optimal: no other technique has less error for as few samples, shader invocations, and bytes"
        model = f" for {display(study.model)}" if study.model else ""
        yield f"bytes, power, and memory: the cost model{model}, with samples kept on the tile"
    names: dict[str, list[str]] = {}
    for untimed in study.untimed:
        names.setdefault(untimed.reason, []).append(untimed.name)
    for reason, techniques in names.items():
        yield f"not timed: {'; '.join(techniques)}: {display(reason)}"
    for path in (*study.pictures, *study.records):
        yield f"written: {display(path)}"
    failed = f", {len(study.failed)} failed" if study.failed else ""
    yield f"{plural(len(study.points), 'point')} of {plural(len(study.scenes), 'scene')}{failed}"
