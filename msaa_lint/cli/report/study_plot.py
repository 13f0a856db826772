"""One figure of a study: error against time, a panel for each scene, the Pareto front joined.

matplotlib is an extra and is imported when a plot is drawn; nothing of it that a user configures takes part, so that the same points give
the same SVG.
"""

from __future__ import annotations

import io
import math
import warnings
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from msaa_lint.experiments.study.crops import short_name
from msaa_lint.experiments.study.outcome import Study
from msaa_lint.experiments.study.points import MSAA, SAMPLE_SHADING, SSAA, Point

from .cost_chart import _SETTINGS
from .escape import shown

if TYPE_CHECKING:
    from matplotlib.axes import Axes

FORMATS = ("svg", "png")

STYLES = {MSAA: ("#0072B2", "o", "MSAA"), SAMPLE_SHADING: ("#E69F00", "s", "sample shading"), SSAA: ("#D55E00", "^", "SSAA")}
"""Colours of Okabe and Ito's palette and shapes besides: told apart by everybody, and in grey."""

_COLUMNS = 3
_NARROW = 3.0
"""Errors within so many times each other are drawn on a linear scale: a logarithmic one would have no number to show."""

_WIDE, _HIGH = 4.6, 3.7


def plot(study: Study, format: str) -> bytes:
    """A figure as SVG or PNG. ModuleNotFoundError where matplotlib is not installed."""
    import matplotlib
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    with matplotlib.rc_context(), warnings.catch_warnings():
        # A glyph that the font does not have is a box: no reason to print anything.
        warnings.simplefilter("ignore")
        matplotlib.rcdefaults()
        matplotlib.rcParams.update(_SETTINGS)
        scenes = [scene for scene in study.scenes if drawn(study.of(scene.name))]
        columns = max(1, min(_COLUMNS, len(scenes)))
        rows = max(1, -(-len(scenes) // columns))
        figure = Figure(figsize=(max(6.5, _WIDE * columns), 1.1 + _HIGH * rows), layout="constrained")
        FigureCanvasAgg(figure)
        panels = figure.subplots(rows, columns, squeeze=False)
        for panel in panels.flat[len(scenes) :]:
            panel.set_axis_off()
        for panel, scene in zip(panels.flat, scenes, strict=False):
            _panel(panel, drawn(study.of(scene.name)))
            panel.set_title(shown(scene.name), loc="left", fontsize=10, fontweight="bold")
            panel.set_ylabel("RMSE of coverage" if scene.coverage else "RMSE of linear colour")
        if scenes:
            figure.legend(handles=_legend(), loc="outside lower left", ncols=4, frameon=False)
        title = f"Error against time: {shown(study.device)}" if study.device else "Error against samples: no time is known"
        figure.suptitle(f"{title}, {study.size[0]}x{study.size[1]}", x=0.01, ha="left", fontsize=11)
        out = io.BytesIO()
        about: dict[str, Any] = {"Date": None, "Creator": "msaa-lint"} if format == "svg" else {"Software": "msaa-lint"}
        figure.savefig(out, format=format, metadata=about, dpi=150)
    return out.getvalue()


def drawn(points: Sequence[Point]) -> list[Point]:
    """The points of a scene that have a place: where a time is known of any, those with a time."""
    timed = any(point.time_ms is not None for point in points)
    return [point for point in points if math.isfinite(point.rmse) and (point.time_ms is not None or not timed)]


def place(point: Point) -> tuple[float, float]:
    """Where a point is drawn: its time, else samples and shader invocations of a pixel, and its error."""
    cost = point.time_ms if point.time_ms is not None else float(point.technique.samples + point.technique.shaded)
    return cost, point.rmse


def _panel(axes: Axes, points: Sequence[Point]) -> None:
    for kind, (color, shape, _) in STYLES.items():
        own = [place(point) for point in points if point.technique.kind == kind]
        if own:
            costs, errors = zip(*own, strict=True)
            axes.scatter(costs, errors, color=color, marker=shape, s=34, edgecolors="black", linewidths=0.6, zorder=3)
    places = [place(point) for point in points]
    timed = all(point.time_ms is not None for point in points)
    # Without a time the front is of several costs, and no line in a plane.
    front = sorted(place(point) for point in points if point.best and timed)
    if front:
        costs, errors = zip(*front, strict=True)
        axes.plot(costs, errors, color="black", linewidth=1.2, drawstyle="steps-post", zorder=2)
    least, most = min(error for _, error in places), max(error for _, error in places)
    if least > 0 and most > _NARROW * least:
        axes.set_yscale("log")
    if all(cost > 0 for cost, _ in places):
        axes.set_xscale("log")
    axes.set_xlabel("time, ms" if timed else "samples and shader invocations of a pixel")
    axes.margins(0.14)
    _names(axes, points)
    axes.grid(which="both", color="#DDDDDD", linewidth=0.5)
    axes.set_axisbelow(True)
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_formatter(_plain)
        axis.set_minor_formatter(_minor)
    axes.tick_params(which="both", labelsize=7.5)
    axes.spines[["top", "right"]].set_visible(False)


def _names(axes: Axes, points: Sequence[Point]) -> None:
    """Writes the points' names beside them, where no name is yet."""
    axes.autoscale_view()
    axes.set_xlim(axes.get_xlim())
    axes.set_ylim(axes.get_ylim())
    taken: list[tuple[float, float, float]] = []
    for point in sorted(points, key=lambda each: (not each.best, place(each))):
        name = short_name(point.technique)
        share_x, share_y = (axes.transScale + axes.transLimits).transform(place(point))
        at = share_x * _PANEL[0], share_y * _PANEL[1]
        wide = _LETTER * len(name)
        offset = next((each for each in _OFFSETS if _free(at, each, wide, taken)), _OFFSETS[0])
        taken.append((at[0] + offset[0], at[1] + offset[1], wide))
        weight: Any = "bold" if point.best else "normal"
        axes.annotate(name, place(point), xytext=offset, textcoords="offset points", fontsize=7.5, fontweight=weight, zorder=4)


_PANEL = 270.0, 190.0
"""About how wide and high the inside of a panel is, in points; and what a letter and a line take."""
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
    return [*marks, Line2D([], [], color="black", linewidth=1.2, label="nothing here beats it (names in bold)")]
