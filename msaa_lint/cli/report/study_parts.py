"""What each technique adds to the time of one sample, by part: a bar per technique, one panel per
scene and cost of shading.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from msaa_lint.experiments.study.crops import short_name
from msaa_lint.experiments.study.points import MSAA, Point, Technique
from msaa_lint.linter.study_record import AS_DESCRIBED

from .figure import INK, Figure, title
from .study_panels import Panel

FILL, SHADING, RESOLVE, BOTH = "fill", "shading", "resolve", "fill and shading"
PARTS = {FILL: "#56B4E9", SHADING: "#D55E00", RESOLVE: "#F0E442"}
"""The parts of a time, and their colors of Okabe and Ito's palette, none as light as another. A
frame's own shaders are not timed apart from what they fill.
"""

_WIDTHS = {1: 300.0, 2: 170.0}
_WIDTH = 110.0
"""Of a panel in pixels, by the number of columns, without the figures to the right of its bars; and
of one of more columns.
"""

_NAMES = 50
"""What the names of the techniques take at least."""

_STEP = 14
"""From bar to bar."""


def add_parts(figure: Figure, rows: Sequence[Sequence[Panel]], lines: Sequence[str]) -> None:
    """Adds the panels to a figure, with these lines above them, if parts of times are known."""
    known = [row for row in rows if any(_bars(panel) for panel in row)]
    if known:
        width = _WIDTHS.get(len(known[0]), _WIDTH)
        shown = {bar["part"] for row in known for panel in row for bar in _bars(panel)}
        colors = {
            part: color for part, color in {BOTH: PARTS[FILL], **PARTS}.items() if part in shown
        }
        charts = [
            _chart(panel, width, figure, colors, first=number == 0)
            for row in known
            for number, panel in enumerate(row)
        ]
        heading = title(
            "What each technique adds to the time of one sample, by part",
            lines,
            len(known[0]) * (width + 80) + _NAMES,
            size=13,
        )
        figure.add(charts, heading, columns=len(known[0]), spacing=14)


def _bars(panel: Panel) -> list[dict[str, Any]]:
    """The parts of the time that each technique adds, in milliseconds."""
    as_described = panel.shading.name == AS_DESCRIBED
    base = next(
        (
            _parts(point, as_described)
            for point in panel.points
            if point.technique == Technique(MSAA, 1)
        ),
        None,
    )
    return [
        {
            "technique": short_name(point.technique),
            "part": part,
            "order": number,
            "added": value - base[part],
        }
        for point in panel.points
        if base is not None and point.technique != Technique(MSAA, 1)
        for number, (part, value) in enumerate((_parts(point, as_described) or {}).items())
    ]


def _parts(point: Point, as_described: bool) -> dict[str, float] | None:
    fill, shading, resolve = point.fill_ms, point.shading_ms, point.resolve_ms
    if fill is None or shading is None or resolve is None:
        return None
    return (
        {BOTH: fill + shading, RESOLVE: resolve}
        if as_described
        else {FILL: fill, SHADING: shading, RESOLVE: resolve}
    )


def _totals(panel: Panel, bars: Sequence[dict[str, Any]]) -> list[dict[str, Any]]:
    """The figure beside each bar, and where the bar ends."""
    rows = []
    for name in dict.fromkeys(bar["technique"] for bar in bars):
        values = [bar["added"] for bar in bars if bar["technique"] == name]
        total, base = sum(values), panel.base
        share = f" ({100 * total / base:+.0f} %)" if base else ""
        rows.append(
            {
                "technique": name,
                "end": sum(value for value in values if value > 0),
                "text": f"{total:+.3g} ms{share}",
            }
        )
    return rows


def _chart(
    panel: Panel, width: float, figure: Figure, colors: Mapping[str, str], *, first: bool
) -> Any:
    import altair

    bars = _bars(panel)
    totals = _totals(panel, bars)
    names = [row["technique"] for row in totals]
    y = altair.Y(
        "technique:N",
        sort=names,
        title=None,
        axis=altair.Axis(ticks=False, labels=first, domain=first),
    )
    # The bars have figures beside them, which lines would cross.
    x_axis = altair.Axis(tickCount=3, grid=False)
    color = altair.Color(
        "part:N", scale=altair.Scale(domain=list(colors), range=list(colors.values()))
    )
    drawn = figure.chart(bars).mark_bar(stroke=INK, strokeWidth=0.6)
    figures = figure.chart(totals).mark_text(align="left", dx=4, aria=False)
    layers = [
        drawn.encode(
            altair.X("added:Q", title="added time, ms", axis=x_axis), y, color=color,
            order="order:O",
            tooltip=["technique:N", "part:N", altair.Tooltip("added:Q", title="ms")],
        ),
        figures.encode(altair.X("end:Q", title="added time, ms", axis=x_axis), y, text="text:N"),
    ]  # fmt: skip
    no_border = altair.ViewBackground(stroke=None)
    return altair.layer(*layers).properties(
        width=width, height=altair.Step(_STEP), title=panel.heading(width + 80), view=no_border
    )
