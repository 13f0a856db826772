"""What a person reads of `msaa-lint study`: a table by scene, what ran and why, and what it comes to."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from typing import Any

from msaa_lint.experiments.study.outcome import SceneSummary, Study
from msaa_lint.experiments.study.points import Point

from . import Options, Write
from .console import opened
from .escape import shown

MARK = "*"


def render(study: Study, out: Write, options: Options) -> None:
    """Prints every scene's table, effects and advice, then where the figures are from."""
    console = opened(out, options)
    for number, scene in enumerate(study.scenes):
        if number:
            console.print()
        _scene(scene, study, console)
    if study.scenes:
        console.print()
    for line in _about(study):
        console.print(line, soft_wrap=True)


def _scene(scene: SceneSummary, study: Study, console: Any) -> None:
    points = study.of(scene.name)
    console.print(shown(scene.name), style="bold", soft_wrap=True)
    if scene.description:
        console.print(shown(scene.description), soft_wrap=True)
    if points:
        of = "pixels that an edge crosses" if scene.coverage else "pixels that are looked at for their colour"
        console.print(f"{max(point.edge_pixels for point in points):,} of {study.size[0] * study.size[1]:,} are {of}", soft_wrap=True)
        console.print()
        console.print(_table(points, scene))
        console.print()
    for name, why in scene.effects:
        console.print(f"ran {shown(name)}: {shown(why)}" if why else f"ran {shown(name)}", soft_wrap=True)
    if not scene.effects:
        console.print("no effect ran: the scene calls for none", soft_wrap=True)
    for failed in study.failed:
        if failed.scene == scene.name:
            console.print(f"{failed.technique.name} failed: {shown(failed.reason)}", style="red", soft_wrap=True)
    for each in study.advice:
        if each.scene == scene.name:
            console.print(f"- {shown(each.text)} ({shown(each.reason)})", soft_wrap=True)


def _table(points: Sequence[Point], scene: SceneSummary) -> Any:
    from rich import box
    from rich.table import Table

    table = Table(box=box.SIMPLE_HEAD, pad_edge=False, show_edge=False)
    table.add_column("")
    table.add_column("samples", no_wrap=True)
    columns = [name for name, of in _COLUMNS.items() if name not in _OPTIONAL or any(of(point) not in ("-", "") for point in points)]
    for name in columns:
        table.add_column(name.replace("edges", "edges" if scene.coverage else "colour"), justify="right", overflow="fold")
    for point in points:
        style = "green" if point.best else ""
        table.add_row(MARK if point.best else "", point.technique.name, *(_COLUMNS[name](point) for name in columns), style=style)
    return table


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
    "MB a\nframe": lambda point: _number(point.bytes_per_frame / 1e6 if point.bytes_per_frame is not None else None, ".1f"),
    "mW": lambda point: _number(point.milliwatts, ".0f"),
    "MiB": lambda point: _number(point.memory_mib, ".1f"),
}
_OPTIONAL = frozenset({"SSIM", "time\nms", "time\nto 1x", "MB a\nframe", "mW", "MiB"})
"""Columns that are left out where nothing of them is known."""


def _about(study: Study) -> Iterator[str]:
    size = f"{study.size[0]}x{study.size[1]}, vertices snapped to {study.bits} bits"
    if study.points:
        if study.device:
            yield f"{size}; time: {shown(study.device)}, by its own clock"
            yield f"{MARK} nothing here has less error for as little time"
        else:
            yield f"{size}; no time is known: --device NAME measures it"
            yield f"{MARK} nothing here has less error for as few samples, shader invocations and bytes"
        yield f"bytes, power and memory: the cost model{f' for {shown(study.model)}' if study.model else ''}, samples kept on the tile"
    reasons: dict[str, list[str]] = {}
    for each in study.untimed:
        reasons.setdefault(each.reason, []).append(each.name)
    for reason, names in reasons.items():
        yield f"not timed: {'; '.join(names)}: {shown(reason)}"
    for path in (*study.pictures, *study.records):
        yield f"written: {shown(path)}"
    failed = f", {len(study.failed)} failed" if study.failed else ""
    yield f"{_counted(len(study.points), 'point')} of {_counted(len(study.scenes), 'scene')}{failed}"


def _counted(count: int, word: str) -> str:
    return f"{count} {word}{'' if count == 1 else 's'}"
