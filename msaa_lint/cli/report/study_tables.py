"""The tables of a study's text report: errors, times under each cost of shading, and their parts."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence, Set
from itertools import pairwise
from typing import NamedTuple

from rich.text import Text

from msaa_lint.experiments.study.outcome import SceneSummary, Study
from msaa_lint.experiments.study.pareto import tie
from msaa_lint.experiments.study.points import Point, Technique

from . import Options, Write
from .escape import display
from .tables import FIGURE, Column, Table, print_tables

MARK, TIE = "*", "="


class _Figures(NamedTuple):
    """A column of figures: its heading, and the cell of a point."""

    title: str
    cell: Callable[[Point], str]


def figure(value: float | None, digits: str) -> str:
    """A number of a table; `-` for none, and `exact` for infinite PSNR."""
    if value is None or math.isnan(value):
        return "-"
    if math.isinf(value):
        return "exact" if value > 0 else "-"
    return format(value, digits if abs(value) < 1e7 else ".3g")


def _count(value: int | None) -> str:
    return "-" if value is None else f"{value:,}"


_ERRORS = (
    _Figures("RMSE\nedges", lambda point: figure(point.rmse, ".4f")),
    _Figures("RMSE\nall", lambda point: figure(point.rmse_all, ".5f")),
    _Figures("worst", lambda point: figure(point.max_error, ".3f")),
    _Figures("bias", lambda point: figure(point.bias, "+.4f")),
)
_PERCEIVED = (
    _Figures("PSNR dB\nlinear", lambda point: figure(point.psnr_db, ".1f")),
    _Figures("PSNR dB\ndisplay", lambda point: figure(point.psnr_display_db, ".1f")),
    _Figures("SSIM", lambda point: figure(point.ssim, ".4f")),
    _Figures("FLIP", lambda point: figure(point.flip, ".4f")),
    _Figures("flicker", lambda point: figure(point.flicker, ".4f")),
)
_WORK = (
    _Figures("MB per\nframe", lambda point: figure(point.bytes_per_frame / 1e6 if point.bytes_per_frame is not None else None, ".1f")),
    _Figures("mW", lambda point: figure(point.milliwatts, ".0f")),
    _Figures("MiB", lambda point: figure(point.memory_mib, ".1f")),
    _Figures("invocations\ncounted", lambda point: _count(point.invocations)),
    _Figures("invocations\nexpected", lambda point: _count(point.expected_invocations)),
)
_PARTS = (
    _Figures("fill\nms", lambda point: figure(point.fill_ms, ".3g")),
    _Figures("shading\nms", lambda point: figure(point.shading_ms, ".3g")),
    _Figures("resolve\nms", lambda point: figure(point.resolve_ms, ".3g")),
)


_Column = tuple[Column, Mapping[Technique, str]]
"""A column of a table, and its cells by technique."""


def print_errors(study: Study, scene: SceneSummary, out: Write, options: Options) -> None:
    """Prints the errors of a scene's techniques, which are the same under every cost of shading, their traffic and memory, and their
    invocations: in as few tables as fit. Without times of a GPU, the Pareto-optimal ones are marked."""
    points = study.of(scene.name, study.shading_names(scene.name)[0])
    best = set() if has_times(points) and not study.software else {point.technique for point in points if point.best}
    errors = [figures._replace(title=figures.title if scene.coverage else figures.title.replace("edges", "color")) for figures in _ERRORS]
    perceived, work = _known(_PERCEIVED, points), _known(_WORK, points)

    def layout(gap: int, *groups: Sequence[_Figures]) -> list[Table]:
        marks = [(Column(""), dict.fromkeys(best, MARK))]
        return [_table(points, [*marks, *_columns(group, points)], gap, best) for group in groups if group]

    every = [*errors, *perceived, *work]
    apart = layout(1, [*errors, *perceived], work), layout(1, errors, perceived, work)
    print_tables(out, options, layout(2, every), layout(1, every), *apart)


def print_times(study: Study, scene: SceneSummary, out: Write, options: Options) -> None:
    """Prints the times of a scene's techniques, a group of columns for each cost of shading, then their parts."""
    groups = [points for name in study.shading_names(scene.name) if has_times(points := study.of(scene.name, name))]
    if study.software:
        groups = [[point._replace(best=False) for point in points] for points in groups]
    label = "software\ndriver\n" if study.software else ""
    for group_columns in (_time_columns, _part_columns):
        columns = [group_columns(points, label) for points in groups]
        if any(columns):
            best = {point.technique for point in groups[0] if point.best} if len(groups) == 1 else set()
            whole = [[_table(groups[0], [column for group in columns for column in group], gap, best)] for gap in (2, 1)]
            print_tables(out, options, *whole, [_table(groups[0], group, 1, best) for group in columns if group])
            out("\n")


def has_times(points: Sequence[Point]) -> bool:
    """Whether a device timed any of the points."""
    return any(point.time_ms is not None for point in points)


def _time_columns(points: Sequence[Point], label: str) -> list[_Column]:
    """The marks, times, half-widths of their intervals, and times relative to one sample, under one cost of shading."""
    ties = _ties_with_shorter(points)
    marks = {point.technique: MARK * point.best + TIE * (point.technique in ties) for point in points}
    name = display(points[0].shading)
    figures = _known(
        (
            _Figures(f"{label}{name}\nms" if name else f"{label}ms", lambda point: figure(point.time_ms, ".3g")),
            _Figures("±", lambda point: figure(_half_width(point), ".2g")),
            _Figures("to 1x", lambda point: figure(point.ratio, ".2f")),
        ),
        points,
    )
    return [(Column(""), marks), *_columns(figures, points)]


def _part_columns(points: Sequence[Point], label: str) -> list[_Column]:
    """The parts of the times under one cost of shading."""
    name = display(points[0].shading)
    parts = _known(_PARTS, points)
    return _columns([each._replace(title=f"{label}{name}\n{each.title}" if each is parts[0] else each.title) for each in parts], points)


def _ties_with_shorter(points: Sequence[Point]) -> set[Technique]:
    """The techniques whose time differs from the next shorter one by no more than the noise."""
    ordered = sorted((point for point in points if point.time_ms is not None), key=lambda point: (point.time_ms or 0.0, point.technique))
    return {longer.technique for shorter, longer in pairwise(ordered) if tie(shorter, longer)}


def _half_width(point: Point) -> float | None:
    if point.time_ms is None or point.low_ms is None or point.high_ms is None:
        return None
    return max(point.time_ms - point.low_ms, point.high_ms - point.time_ms)


def _known(figures: Sequence[_Figures], points: Sequence[Point]) -> list[_Figures]:
    """The columns in which anything is known."""
    return [each for each in figures if any(each.cell(point) != "-" for point in points)]


def _columns(figures: Sequence[_Figures], points: Sequence[Point]) -> list[_Column]:
    return [(Column(each.title, FIGURE), {point.technique: each.cell(point) for point in points}) for each in figures]


def _table(points: Sequence[Point], columns: Sequence[_Column], gap: int, best: Set[Technique]) -> Table:
    """A row for each technique, with its name before the first column of figures."""
    names = (Column("samples"), {point.technique: point.technique.name for point in points})
    place = 1 if columns[0][0].kind != FIGURE else 0
    ordered = [*columns[:place], names, *columns[place:]]
    rows = [
        (
            "green" if point.technique in best else "",
            [Text(cells.get(point.technique, "-" if column.kind == FIGURE else "")) for column, cells in ordered],
        )
        for point in points
    ]
    return Table([column for column, _ in ordered], rows, gap)
