"""The figures of `study --plot`: error against added time, one panel per scene and cost of shading,
and the parts of the added time.
"""

from collections.abc import Sequence
from itertools import pairwise
from typing import Any, NamedTuple

from msaa_lint.experiments.study.crops import short_name
from msaa_lint.experiments.study.outcome import Study
from msaa_lint.experiments.study.points import MSAA, SAMPLE_SHADING, SSAA

from .escape import display
from .figure import INK, Figure, Spec, title
from .labels import Box, Label, Place, around, place_labels
from .scales import Scale, from_zero, linear_or_log
from .study_panels import COLUMNS, SOFTWARE, Panel, abbreviation, panels
from .study_parts import add_parts

KINDS = {
    MSAA: ("MSAA", "#0072B2", "circle"),
    SAMPLE_SHADING: ("sample shading", "#E69F00", "square"),
    SSAA: ("SSAA", "#D55E00", "triangle-up"),
}
"""Names, colors of Okabe and Ito's palette, and shapes: distinct for all kinds of color blindness
and in grayscale.
"""

_NARROW = 3.0
"""Errors within this factor of each other are drawn on a linear scale, as a logarithmic one would
have no tick label.
"""

_WIDTHS = {1: 420.0, 2: 280.0}
_WIDTH = 200.0
"""Of a panel in pixels, by the number of columns; and of one of more columns."""

_ROOMS = (
    (170.0, 40.0),
    (200.0, 40.0),
    (240.0, 60.0),
    (300.0, 90.0),
    (380.0, 400.0),
    (480.0, 500.0),
)
"""Heights of a panel, and how far a label may be from its mark: the first at which all labels find
room.
"""

_RADIUS, _AREA = 4.5, 40
"""Half the side of the square that a mark keeps free, and its size in Vega-Lite's terms."""

_AXIS = 40.0
"""What the vertical axis of the first panel takes at least."""

_PALE = 0.35
"""The opacity of marks that are not on the front."""

_HAIR = 1.0
"""Half the width that a line keeps free."""


class Axes(NamedTuple):
    """The scales of a row of panels, and the width and height of its panels in pixels."""

    x: Scale
    y: Scale
    width: float
    height: float

    def pixels(self, x: float, y: float) -> Place:
        """Where a point is in a panel."""
        return self.x.share(x) * self.width, (1 - self.y.share(y)) * self.height

    def values(self, place: Place) -> Place:
        """The inverse of `pixels`."""
        return self.x.value(place[0] / self.width), self.y.value(1 - place[1] / self.height)


def plot(study: Study) -> Spec:
    """The figures of a study that have something to show, below each other."""
    rows, figure = panels(study), Figure()
    _add_accuracy(figure, study, rows)
    add_parts(figure, rows, [SOFTWARE] if study.software else [])
    return figure.spec()


def _add_accuracy(figure: Figure, study: Study, rows: Sequence[Sequence[Panel]]) -> None:
    """Adds the panels of error against added time to a figure."""
    costs = max((len(row) for row in rows), default=1)
    columns = costs if costs > 1 else COLUMNS.get(len(rows), max(COLUMNS.values()))
    width = _WIDTHS.get(columns, _WIDTH)
    charts = []
    # All panels beside each other are as high as one of them needs.
    beside = columns // costs
    for group in (rows[start : start + beside] for start in range(0, len(rows), beside)):
        for row, axes, labels in _with_room(group, width):
            charts += [
                chart_of(panel, axes, labels[n], figure, first=n == 0)
                for n, panel in enumerate(row)
            ]
    lines = [SOFTWARE] if study.software else []
    added = (
        "Error against added time on a software driver"
        if study.software
        else "Error against added time"
    )
    name = (
        f"{added}: {display(study.device)}"
        if study.device
        else "Error against samples (no times measured)"
    )
    if any(panel.by_time for row in rows for panel in row):
        lines.append(
            "line, and names in bold: the Pareto front; pale marks: not on it, nor within the "
            "noise of it"
        )
    else:
        lines.append(
            "names in bold: Pareto-optimal in error, samples, and shader invocations; pale marks: "
            "not optimal"
        )
    if any(panel.interval(point) for row in rows for panel in row for point in panel.points):
        lines.append("horizontal bars: 95 % intervals of the time")
    lines += abbreviation(
        point.technique for row in rows for panel in row for point in panel.points
    )
    heading = title(
        f"{name}, {study.size[0]}x{study.size[1]}", lines, columns * width + _AXIS, size=13
    )
    figure.add(charts, heading, columns=columns, spacing=14)


def _with_room(
    rows: Sequence[Sequence[Panel]], width: float
) -> list[tuple[Sequence[Panel], Axes, list[list[Label | None]]]]:
    """The axes of rows of panels, all as high as their labels need, and the labels."""
    for height, reach in _ROOMS:
        axes = [axes_of(row, width, height) for row in rows]
        labels = [
            [labels_of(panel, of_row, reach) for panel in row]
            for row, of_row in zip(rows, axes, strict=True)
        ]
        if all(label is not None for of_row in labels for of_panel in of_row for label in of_panel):
            break
    return list(zip(rows, axes, labels, strict=True))


def axes_of(row: Sequence[Panel], width: float, height: float) -> Axes:
    """The axes that have room for the points of all panels of a row."""
    places = [panel.place(point) for panel in row for point in panel.points]
    costs = [x for x, _ in places] + [
        time for panel in row for point in panel.points for time in panel.interval(point) or ()
    ]
    related = any(panel.base is not None for panel in row)
    return Axes(
        from_zero(costs) if related else linear_or_log(costs),
        linear_or_log([y for _, y in places], _NARROW),
        width,
        height,
    )


def labels_of(panel: Panel, axes: Axes, reach: float) -> list[Label | None]:
    """The labels of a panel's points. Those of the front are the first to choose."""
    order = sorted(
        range(len(panel.points)),
        key=lambda n: (not panel.points[n].best, panel.place(panel.points[n])),
    )
    places = [axes.pixels(*panel.place(panel.points[n])) for n in order]
    names = [short_name(panel.points[n].technique) for n in order]
    lines = []
    for point in panel.points:
        if interval := panel.interval(point):
            (left, y), (right, _) = (axes.pixels(x, panel.place(point)[1]) for x in interval)
            lines.append(Box(left, y - _HAIR, right, y + _HAIR))
    corners = [axes.pixels(*place) for place in panel.front]
    for (x, y), (next_x, next_y) in pairwise(corners):
        lines += [
            Box(x, y - _HAIR, next_x, y + _HAIR),
            Box(next_x - _HAIR, y, next_x + _HAIR, next_y),
        ]
    marks = [around(place, _RADIUS) for place in places]
    found = dict(
        zip(
            order,
            place_labels(places, names, marks, lines, (axes.width, axes.height), reach=reach),
            strict=True,
        )
    )
    return [found[n] for n in range(len(order))]


def chart_of(
    panel: Panel, axes: Axes, labels: Sequence[Label | None], figure: Figure, *, first: bool
) -> Any:
    """One panel. The first one of a row has the labels of the vertical axis."""
    import altair

    timed = any(point.time_ms is not None for point in panel.points)
    across = (
        "samples and shader invocations per pixel"
        if not timed
        else "time, ms"
        if panel.base is None
        else "added time, ms"
    )
    x_axis = {**axes.x.axis(axes.width, upright=False), "title": across}
    y_axis = {
        **axes.y.axis(axes.height, upright=True),
        "title": panel.measure if first else None,
        "labels": first,
        "ticks": first,
    }

    def x(field: str) -> Any:
        return altair.X(
            field,
            type="quantitative",
            scale=altair.Scale(**axes.x.spec()),
            axis=altair.Axis(**x_axis),
        )

    def y(field: str) -> Any:
        return altair.Y(
            field,
            type="quantitative",
            scale=altair.Scale(**axes.y.spec()),
            axis=altair.Axis(**y_axis),
        )

    front, intervals, leaders, rows, optimal, others = layer_rows(panel, axes, labels)
    kinds = [name for name, _, _ in KINDS.values()]
    color = altair.Color(
        "kind:N", scale=altair.Scale(domain=kinds, range=[color for _, color, _ in KINDS.values()])
    )
    shape = altair.Shape(
        "kind:N", scale=altair.Scale(domain=kinds, range=[shape for _, _, shape in KINDS.values()])
    )
    tooltip = [
        altair.Tooltip(
            field, type="nominal" if field == "technique" else "quantitative", title=name
        )
        for field, name in _TOOLTIPS.items()
        if any(field in row for row in rows)
    ]
    # Vega announces a layer to screen readers even if it is empty, without words.
    line, rule = (
        {"color": INK, **({} if drawn else {"aria": False})} for drawn in (front, intervals)
    )
    layers = [
        figure.chart(front)
        .mark_line(interpolate="step-after", strokeWidth=1.2, **line)
        .encode(x("x"), y("y")),
        figure.chart(intervals)
        .mark_rule(strokeWidth=1, **rule)
        .encode(x("low"), y("y"), x2="high"),
        figure.chart(leaders)
        .mark_rule(color="#888888", strokeWidth=0.6, aria=False)
        .encode(x("x"), y("y"), x2="end_x", y2="end_y"),
        figure.chart(rows)
        .mark_point(filled=True, size=_AREA, opacity=1, stroke=INK, strokeWidth=0.6)
        .encode(
            x("x"),
            y("y"),
            color=color,
            shape=shape,
            fillOpacity=altair.FillOpacity("opacity:Q", scale=None),
            tooltip=tooltip,
        ),
        *(
            figure.chart(names)
            .mark_text(fontWeight=weight, aria=False)
            .encode(x("label_x"), y("label_y"), text="name:N")
            for names, weight in ((optimal, "bold"), (others, "normal"))
        ),
    ]
    return altair.layer(*layers).properties(
        width=axes.width, height=axes.height, title=panel.heading(axes.width)
    )


def layer_rows(
    panel: Panel, axes: Axes, labels: Sequence[Label | None]
) -> list[list[dict[str, Any]]]:
    """What Vega-Lite draws in each layer of a panel, from the back: the front, the intervals of
    times, the lines from labels to points, the points, the labels of the Pareto-optimal ones, and
    the other labels.
    """
    rows, names = _rows(panel), _names(panel, axes, labels)
    return [
        [{"x": x, "y": y} for x, y in panel.front],
        [row for row in rows if "low" in row],
        [row for row in names if "end_x" in row],
        rows,
        [row for row in names if row["best"]],
        [row for row in names if not row["best"]],
    ]


_TOOLTIPS = {
    "technique": "technique",
    "error": "error",
    "time": "time, ms",
    "least": "at least, ms",
    "most": "at most, ms",
}


def _rows(panel: Panel) -> list[dict[str, Any]]:
    """What Vega-Lite draws of each point."""
    rows = []
    # MSAA is drawn last, above points at the same place.
    for point in reversed(panel.points):
        x, y = panel.place(point)
        row: dict[str, Any] = {
            "x": x,
            "y": y,
            "kind": KINDS[point.technique.kind][0],
            "technique": point.technique.name,
            "error": y,
        }
        row["opacity"] = 1.0 if panel.is_optimal(point) else _PALE
        if point.time_ms is not None:
            row["time"] = point.time_ms
        if interval := panel.interval(point):
            row["low"], row["high"] = interval
            row["least"], row["most"] = point.low_ms, point.high_ms
        rows.append(row)
    return rows


def _names(panel: Panel, axes: Axes, labels: Sequence[Label | None]) -> list[dict[str, Any]]:
    """What Vega-Lite draws of each label."""
    rows = []
    for point, label in zip(panel.points, labels, strict=True):
        if label is None:
            continue
        box = label.box
        label_x, label_y = axes.values(((box.left + box.right) / 2, (box.top + box.bottom) / 2))
        row = {
            "name": short_name(point.technique),
            "best": point.best,
            "label_x": label_x,
            "label_y": label_y,
        }
        if label.leader is not None:
            row["x"], row["y"] = axes.values(label.leader[0])
            row["end_x"], row["end_y"] = axes.values(label.leader[1])
        rows.append(row)
    return rows
