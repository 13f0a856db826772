"""The tables of a study's text report: errors and work, which are the same under every cost of
shading, and times.
"""

from __future__ import annotations

import math
import textwrap
from collections.abc import Callable, Mapping, Sequence, Set
from itertools import pairwise
from typing import NamedTuple

from rich.text import Text

from msaa_lint.experiments.study.outcome import SceneSummary, Study
from msaa_lint.experiments.study.pareto import has_time, tie
from msaa_lint.experiments.study.points import Point, Technique
from msaa_lint.linter.study_record import AS_DESCRIBED

from . import Options, Write
from .escape import display
from .tables import FIGURE, SHORT, TEXT, Column, Table, print_tables

MARK, TIE = "*", "="

_MAX_HEADING = 12
"""Cells in a line of a heading that holds a name."""

_MAX_DECIMALS = 6
_EXACT_MS = 0.05
"""Times with half-widths below this have two decimals at least."""


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
    text = format(value, digits if abs(value) < 1e7 else ".3g")
    # What is rounded to zero has no sign of its own.
    return text.replace("-", "+") if "+" in digits and not float(text) else text


def _count(value: int | None) -> str:
    return "-" if value is None else f"{value:,}"


_RMSE_ALL = _Figures("RMSE\nall", lambda point: figure(point.rmse_all, ".5f"))
_WORST = _Figures("worst", lambda point: figure(point.max_error, ".3f"))
_BIAS = _Figures("bias", lambda point: figure(point.bias, "+.4f"))
_PSNR = _Figures("PSNR dB\nlinear", lambda point: figure(point.psnr_db, ".1f"))
_PSNR_DISPLAY = _Figures("PSNR dB\ndisplay", lambda point: figure(point.psnr_display_db, ".1f"))
_BYTES = _Figures(
    "MB per\nframe",
    lambda point: figure(
        point.bytes_per_frame / 1e6 if point.bytes_per_frame is not None else None, ".1f"
    ),
)
_POWER = _Figures("mW", lambda point: figure(point.milliwatts, ".0f"))
_MEMORY = _Figures("MiB", lambda point: figure(point.memory_mib, ".1f"))
_COUNTED = _Figures("invocations\ncounted", lambda point: _count(point.invocations))
_EXPECTED = _Figures("invocations\nexpected", lambda point: _count(point.expected_invocations))
_ERRORS = (
    _Figures("RMSE\nedges", lambda point: figure(point.rmse, ".4f")),
    _RMSE_ALL,
    _WORST,
    _BIAS,
    _PSNR,
    _PSNR_DISPLAY,
    _Figures("SSIM", lambda point: figure(point.ssim, ".4f")),
    _Figures("FLIP", lambda point: figure(point.flip, ".4f")),
    _Figures("flicker", lambda point: figure(point.flicker, ".4f")),
    _BYTES,
    _POWER,
    _MEMORY,
    _COUNTED,
    _EXPECTED,
)
_LEFT_OUT = (
    _POWER,
    _MEMORY,
    _RMSE_ALL,
    _PSNR,
    _BIAS,
    _BYTES,
    _WORST,
    _EXPECTED,
    _COUNTED,
    _PSNR_DISPLAY,
)
"""The columns that a narrow table is without, the first one first."""

_Column = tuple[Column, Mapping[Technique, str]]
"""A column of a table, and its cells by technique."""


def row_name(technique: Technique) -> str:
    """The name of a technique, as short as a table needs it: `8x, quarter shaded`."""
    return technique.name.replace(" of them", "").replace(", a ", ", ")


def print_errors(study: Study, scene: SceneSummary, out: Write, options: Options) -> list[str]:
    """Prints the table of errors; returns the names of the columns for which the output is too
    narrow.
    """
    columns = _error_columns(study, scene)
    optional = [figures for figures in _LEFT_OUT if figures in columns]
    layouts = (
        [error_table(study, scene, 1, optional[:number])] for number in range(len(optional) + 1)
    )
    chosen = print_tables(out, options, [error_table(study, scene)], *layouts)
    return [figures.title.replace("\n", " ") for figures in optional[: max(chosen - 1, 0)]]


def error_table(
    study: Study, scene: SceneSummary, gap: int = 2, left_out: Sequence[_Figures] = ()
) -> Table:
    """The errors, traffic, memory, and invocations of a scene's techniques, which are the same
    under every cost of shading. Without times of a GPU, the Pareto-optimal techniques are
    marked.
    """
    points = study.of(scene.name, study.shading_names(scene.name)[0])
    best = (
        set()
        if has_times(points) and not study.software
        else {point.technique for point in points if point.best}
    )
    marks = [(Column(""), dict.fromkeys(best, MARK))] if best else []
    shown = [figures for figures in _error_columns(study, scene) if figures not in left_out]
    if not scene.coverage:
        shown = [
            figures._replace(title=figures.title.replace("edges", "color")) for figures in shown
        ]
    return _table(points, [*marks, *_columns(shown, points)], gap, best)


def _error_columns(study: Study, scene: SceneSummary) -> list[_Figures]:
    points = study.of(scene.name, study.shading_names(scene.name)[0])
    return [figures for figures in _ERRORS if _is_known(figures, points)]


def print_times(study: Study, scene: SceneSummary, out: Write, options: Options) -> bool:
    """Prints the times of a scene's techniques, a group of columns for each cost of shading, and
    the parts of these times; returns whether it shows what shading takes under each cost.
    """
    groups, best = _timed_groups(study, scene)

    def table(gap: int, *parts: Sequence[_Column], kind: str = TEXT) -> Table:
        return _table(groups[0], [column for part in parts for column in part], gap, best, kind)

    fill, shading = (
        _fill_columns(groups),
        [column for points in groups for column in _shading_columns(points)],
    )
    times = [_time_columns(points, _decimals(points)) for points in groups]
    together = [
        [time_table(study, scene)],
        [time_table(study, scene, 1)],
        [table(1, *times, fill, shading)],
    ]
    parts = [table(1, fill, shading)] if fill or shading else []
    apart = [
        [
            *(table(1, *times[start : start + number]) for start in range(0, len(times), number)),
            *parts,
        ]
        for number in range(len(times), 0, -1)
    ]
    folded = [table(1, *times, kind=SHORT), *parts]
    chosen = print_tables(
        out, options, *together, [table(1, *times, fill)], apart[0], folded, *apart[1:]
    )
    return not shading or chosen != len(together)


def time_table(study: Study, scene: SceneSummary, gap: int = 2) -> Table:
    """The times of a scene's techniques in full: under each cost of shading with their intervals
    and ratios, and their parts.
    """
    groups, best = _timed_groups(study, scene)
    related = [
        [*_time_columns(points, _decimals(points)), *_ratio_columns(points)] for points in groups
    ]
    columns = [*(column for of_cost in related for column in of_cost), *_fill_columns(groups)]
    return _table(
        groups[0],
        [*columns, *(column for points in groups for column in _shading_columns(points))],
        gap,
        best,
    )


def _timed_groups(study: Study, scene: SceneSummary) -> tuple[list[list[Point]], set[Technique]]:
    """The points by cost of shading, and the Pareto-optimal techniques where there is a single
    one.
    """
    groups = [
        points
        for name in study.shading_names(scene.name)
        if has_times(points := study.of(scene.name, name))
    ]
    if study.software:
        groups = [[point._replace(best=False) for point in points] for points in groups]
    return groups, {point.technique for point in groups[0] if point.best} if len(
        groups
    ) == 1 else set()


def has_times(points: Sequence[Point]) -> bool:
    """Whether a device timed any of the points."""
    return any(point.time_ms is not None for point in points)


def _time_columns(points: Sequence[Point], decimals: int) -> list[_Column]:
    """The marks, times, and half-widths of their intervals, under one cost of shading."""
    ties = _ties_with_shorter(points)
    marks = {
        point.technique: MARK * point.best + TIE * (point.technique in ties) for point in points
    }
    figures = [
        _Figures(
            _heading(points[0].shading, "ms"), lambda point: figure(point.time_ms, f".{decimals}f")
        ),
        _Figures("±", lambda point: _interval(point, decimals)),
    ]
    known = _columns([each for each in figures if _is_known(each, points)], points)
    return [(Column(""), marks), *known] if any(marks.values()) else known


def _ratio_columns(points: Sequence[Point]) -> list[_Column]:
    """The times relative to those of one sample, under one cost of shading."""
    ratio = _Figures("to 1x", lambda point: figure(point.ratio, ".2f"))
    return _columns([ratio], points) if _is_known(ratio, points) else []


def _fill_columns(groups: Sequence[Sequence[Point]]) -> list[_Column]:
    """The parts of the times that are the same under every cost of shading. A frame's own shaders
    are not timed apart from what they fill.
    """
    described = {points[0].shading for points in groups} == {AS_DESCRIBED}
    decimals = max(map(_decimals, groups))
    parts = (
        _Figures(
            "fill and\nshading\nms" if described else "fill\nms",
            lambda point: figure(point.fill_ms, f".{decimals}f"),
        ),
        _Figures("resolve\nms", lambda point: figure(point.resolve_ms, f".{decimals}f")),
    )
    return _columns([part for part in parts if _is_known(part, groups[0])], groups[0])


def _shading_columns(points: Sequence[Point]) -> list[_Column]:
    """What one cost of shading adds to the times; nothing where it adds nothing."""
    if not any(point.shading_ms for point in points):
        return []
    decimals, name = _decimals(points), points[0].shading
    part = _Figures(
        _heading(f"shading {name}", "ms"), lambda point: figure(point.shading_ms, f".{decimals}f")
    )
    return _columns([part], points)


def _heading(name: str, unit: str) -> str:
    """The heading of a column of times: a cost's name, broken where it is long."""
    return "\n".join([*textwrap.wrap(display(name), _MAX_HEADING), unit])


def _decimals(points: Sequence[Point]) -> int:
    """The decimals with which the shortest of the times has three significant digits; two where all
    intervals are narrower than these show.
    """
    times = [point.time_ms for point in points if point.time_ms is not None and has_time(point)]
    widths = [_half_width(point) for point in points]
    exact = all(width is not None and width < _EXACT_MS for width in widths)
    return min(
        max(2 - math.floor(math.log10(min(times, default=1.0))), 2 if exact else 0), _MAX_DECIMALS
    )


def _ties_with_shorter(points: Sequence[Point]) -> set[Technique]:
    """The techniques whose time differs from the next shorter one by no more than the noise."""
    ordered = sorted(
        (point for point in points if point.time_ms is not None),
        key=lambda point: (point.time_ms or 0.0, point.technique),
    )
    return {longer.technique for shorter, longer in pairwise(ordered) if tie(shorter, longer)}


def _half_width(point: Point) -> float | None:
    """The distance from a time to the farther bound of its interval; None where that is not
    known.
    """
    if point.time_ms is None or point.low_ms is None or point.high_ms is None:
        return None
    width = max(point.time_ms - point.low_ms, point.high_ms - point.time_ms)
    return width if math.isfinite(width) else None


def _interval(point: Point, decimals: int) -> str:
    """The half-width of an interval; `<0.001` where that is less than the time's digits show."""
    width, least = _half_width(point), 10.0**-decimals
    return (
        "-"
        if width is None
        else f"<{least:.{decimals}f}"
        if 0 <= width < least
        else f"{width:.{decimals}f}"
    )


def _is_known(figures: _Figures, points: Sequence[Point]) -> bool:
    """Whether anything is known of a column."""
    return any(figures.cell(point) != "-" for point in points)


def _columns(figures: Sequence[_Figures], points: Sequence[Point]) -> list[_Column]:
    return [
        (Column(each.title, FIGURE), {point.technique: each.cell(point) for point in points})
        for each in figures
    ]


def _table(
    points: Sequence[Point],
    columns: Sequence[_Column],
    gap: int,
    best: Set[Technique],
    kind: str = TEXT,
) -> Table:
    """A row for each technique, with its name before the first column of figures."""
    names = (
        Column("samples", kind),
        {point.technique: row_name(point.technique) for point in points},
    )
    place = 1 if columns and columns[0][0].kind != FIGURE else 0
    ordered = [*columns[:place], names, *columns[place:]]
    rows = [
        (
            "green" if point.technique in best else "",
            [
                Text(cells.get(point.technique, "-" if column.kind == FIGURE else ""))
                for column, cells in ordered
            ],
        )
        for point in points
    ]
    return Table([column for column, _ in ordered], rows, gap)
