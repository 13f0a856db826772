"""The plot of `study --plot`: error against time, one panel per scene, with the Pareto front joined."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from msaa_lint.experiments.study.crops import short_name
from msaa_lint.experiments.study.outcome import Study
from msaa_lint.experiments.study.points import MSAA, SAMPLE_SHADING, SSAA, Point

from .escape import display
from .figure import save_figure

STYLES = {MSAA: ("#0072B2", "o", "MSAA"), SAMPLE_SHADING: ("#E69F00", "s", "sample shading"), SSAA: ("#D55E00", "^", "SSAA")}
"""Colors of Okabe and Ito's palette, and shapes: distinct for all kinds of color blindness and in grayscale."""

_COLUMNS = 3
_NARROW = 3.0
"""Errors within this factor of each other are drawn on a linear scale, as a logarithmic one would have no tick label."""

_WIDE, _HIGH = 4.6, 3.7


def plot(study: Study, format: str) -> bytes:
    """The plot as SVG or PNG. ModuleNotFoundError if matplotlib is not installed."""
    scenes = [scene for scene in study.scenes if plotted(study.of(scene.name))]
    columns = max(1, min(_COLUMNS, len(scenes)))
    rows = max(1, -(-len(scenes) // columns))

    def draw(figure: Any) -> None:
        panels = figure.subplots(rows, columns, squeeze=False)
        for panel in panels.flat[len(scenes) :]:
            panel.set_axis_off()
        for panel, scene in zip(panels.flat, scenes, strict=False):
            _panel(panel, plotted(study.of(scene.name)))
            panel.set_title(display(scene.name), loc="left", fontsize=10, fontweight="bold")
            panel.set_ylabel("RMSE of coverage" if scene.coverage else "RMSE of linear color")
        if scenes:
            figure.legend(handles=_legend(), loc="outside lower left", ncols=4, frameon=False)
        title = f"Error against time: {display(study.device)}" if study.device else "Error against samples (no times measured)"
        figure.suptitle(f"{title}, {study.size[0]}x{study.size[1]}", x=0.01, ha="left", fontsize=11)

    return save_figure(max(6.5, _WIDE * columns), 1.1 + _HIGH * rows, draw, format)


def plotted(points: Sequence[Point]) -> list[Point]:
    """The points of a scene that have a place: those with a time if there are any."""
    timed = any(point.time_ms is not None for point in points)
    return [point for point in points if math.isfinite(point.rmse) and (point.time_ms is not None or not timed)]


def place(point: Point) -> tuple[float, float]:
    """Where a point is drawn: its time, else samples plus shader invocations per pixel, and its error."""
    cost = point.time_ms if point.time_ms is not None else float(point.technique.samples + point.technique.shaded)
    return cost, point.rmse


def _panel(axes: Any, points: Sequence[Point]) -> None:
    for kind, (color, shape, _) in STYLES.items():
        places = [place(point) for point in points if point.technique.kind == kind]
        if places:
            costs, errors = zip(*places, strict=True)
            axes.scatter(costs, errors, color=color, marker=shape, s=34, edgecolors="black", linewidths=0.6, zorder=3)
    places = [place(point) for point in points]
    timed = all(point.time_ms is not None for point in points)
    # Without times the front has several dimensions, and is not a line in the plane.
    front = sorted(place(point) for point in points if point.best and timed)
    if front:
        costs, errors = zip(*front, strict=True)
        axes.plot(costs, errors, color="black", linewidth=1.2, drawstyle="steps-post", zorder=2)
    least, most = min(error for _, error in places), max(error for _, error in places)
    if least > 0 and most > _NARROW * least:
        axes.set_yscale("log")
    if all(cost > 0 for cost, _ in places):
        axes.set_xscale("log")
    axes.set_xlabel("time, ms" if timed else "samples and shader invocations per pixel")
    axes.margins(0.14)
    _names(axes, points)
    axes.grid(which="both", color="#DDDDDD", linewidth=0.5)
    axes.set_axisbelow(True)
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_formatter(_plain)
        axis.set_minor_formatter(_minor)
    axes.tick_params(which="both", labelsize=7.5)
    axes.spines[["top", "right"]].set_visible(False)


def _names(axes: Any, points: Sequence[Point]) -> None:
    """Writes the points' names next to them, where there is room."""
    axes.autoscale_view()
    axes.set_xlim(axes.get_xlim())
    axes.set_ylim(axes.get_ylim())
    taken: list[tuple[float, float, float]] = []
    for point in sorted(points, key=lambda point: (not point.best, place(point))):
        name = short_name(point.technique)
        share_x, share_y = (axes.transScale + axes.transLimits).transform(place(point))
        at = share_x * _PANEL[0], share_y * _PANEL[1]
        wide = _LETTER * len(name)
        offset = next((offset for offset in _OFFSETS if _free(at, offset, wide, taken)), _OFFSETS[0])
        taken.append((at[0] + offset[0], at[1] + offset[1], wide))
        weight: Any = "bold" if point.best else "normal"
        axes.annotate(name, place(point), xytext=offset, textcoords="offset points", fontsize=7.5, fontweight=weight, zorder=4)


_PANEL = 270.0, 190.0
"""About the inner width and height of a panel, in points; then the size of a letter and a line."""
_LETTER, _LINE = 4.7, 9.0
_OFFSETS = [(4.0, 4.0), *((dx, dy) for dy in (-11.0, 14.0, -21.0, 24.0, -31.0, 34.0) for dx in (4.0, -8.0))]


def _free(at: tuple[float, float], offset: tuple[float, float], wide: float, taken: Sequence[tuple[float, float, float]]) -> bool:
    x, y = at[0] + offset[0], at[1] + offset[1]
    return not any(x < right + other and right < x + wide and abs(y - above) < _LINE for right, above, other in taken)


def _plain(value: float, _: object = None) -> str:
    return f"{value:g}"


def _minor(value: float, _: object = None) -> str:
    return f"{value:g}" if f"{value:e}"[0] in "25" else ""


def _legend() -> list[Any]:
    from matplotlib.lines import Line2D

    marks = [
        Line2D([], [], color=color, marker=shape, linestyle="none", markeredgecolor="black", markeredgewidth=0.6, label=label)
        for color, shape, label in STYLES.values()
    ]
    return [*marks, Line2D([], [], color="black", linewidth=1.2, label="Pareto-optimal (names in bold)")]
